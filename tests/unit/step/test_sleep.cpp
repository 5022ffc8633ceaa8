// Blocks that fall asleep and wake, alone and in islands.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/workers.hpp"
#include "motion/rotation.hpp"
#include "scene/fence.hpp"
#include "scene/sleep.hpp"
#include "solver/law_numbers.hpp"
#include "step/step.hpp"
#include "step/substep.hpp"
#include "verify/cases/cases.hpp"

namespace {

using namespace talus;
using namespace talus::cases;

TEST(Step, SleepingBlockStaysWhereItWouldStayAwake) {
  const SlopeFrame frame = slope_frame(20, 20);
  const GroundClass ground = ground_of(35);
  const Body cube = body_of(box_in(frame, Vec3::Zero(), Vec3(-0.5, -0.5, 0), Vec3(0.5, 0.5, 1)));
  Vec3 end[2];
  for (const bool sleep : {false, true}) {
    Settings settings;
    settings.sleep = sleep;
    const Scene scene = scene_of(plane_trn(frame, 0.5, 10), ground, {cube}, settings);
    State state = start(scene);
    Work work = make_work(scene);
    for (int i = 0; i < 400; ++i) step(scene, state, work);
    EXPECT_EQ(state.phase[0] == Phase::asleep, sleep);
    end[sleep] = state.motion[0].pose.position;
  }
  EXPECT_LT((end[0] - end[1]).norm(), 1e-12);
}

Scene cube_at_rest(const Settings& settings) {
  const Body cube = body_of(box(Vec3(-0.5, -0.5, 0), Vec3(0.5, 0.5, 1)));
  return scene_of(plane_trn(slope_frame(0, 0), 0.5, 10), ground_of(30), {cube}, settings);
}

// 1 m thick, 5 ms: it stays while no point goes farther than g dt^2 = 0.25 mm.
TEST(WatchRest, CountsStepsWithinWhatContactsResolve) {
  const Scene scene = cube_at_rest({});
  State state = start(scene);
  Pose& pose = state.motion[0].pose;
  const Pose from = pose;
  for (int i = 0; i < 10; ++i) {
    pose.position.x() = from.position.x() + (i % 2 == 0 ? 2.4e-4 : -2.4e-4);
    watch_rest(scene, 0, state);
  }
  EXPECT_EQ(state.rest_steps[0], 10);
  for (int i = 0; i < 10; ++i) {  // a block that creeps on in one direction does not stay
    pose.position.x() = from.position.x() + 1e-4 * i;
    watch_rest(scene, 0, state);
    EXPECT_LT(state.rest_steps[0], 14);
  }
  state.rest_steps[0] = 5;
  pose.attitude = rotation_by(Vec3(0, 0, 4e-4)) * pose.attitude;  // corners are 0.87 m off
  watch_rest(scene, 0, state);
  EXPECT_EQ(state.rest_steps[0], 0);
}

// A block that something shakes by micrometres for good is at rest; its remaining energy is lost,
// and said to be.
TEST(Step, BlockThatIsShakenByMicrometresFallsAsleep) {
  const Scene scene = cube_at_rest({});
  State state = start(scene);
  Work work = make_work(scene);
  for (int i = 0; i <= law::steps_before_sleep && state.phase[0] != Phase::asleep; ++i) {
    state.motion[0].velocity.x() += i % 2 == 0 ? 1e-3 : -1e-3;
    step(scene, state, work);
  }
  EXPECT_EQ(state.phase[0], Phase::asleep);
  EXPECT_EQ(state.motion[0].velocity.norm(), 0);
  State moving = start(scene);
  moving.motion[0].velocity = Vec3(0, 2, 0);
  fall_asleep(scene, 0, moving);
  EXPECT_NEAR(moving.ledger.contact, 2 * scene.blocks.mass[0], 1e-9 * scene.blocks.mass[0]);
}

// A heap of bricks that falls on its foot: more blocks than are factored. Once it lies it lies
// still, and falls asleep.
TEST(StepIsland, MassThatCameToRestFallsAsleep) {
  std::vector<Body> bricks;
  for (int row = 0; row < 6; ++row)
    for (int k = 0; k < 6 - row; ++k) {
      const double x = k + 0.5 * row + 0.003 * ((7 * k + 3 * row) % 5),
                   z = 0.3 + 0.52 * row + 0.004 * ((5 * k + row) % 4);
      bricks.push_back(body_of(box(Vec3(x, -0.5, z), Vec3(x + 0.97, 0.5, z + 0.5))));
    }
  const Scene scene = scene_of(plane_trn(slope_frame(0, 0), 0.5, 20), ground_of(30), bricks, {});
  State state = start(scene);
  Work work = make_work(scene);
  double fastest = 0;  // from 3 s on
  while (state.time < 6) {
    step(scene, state, work);
    if (state.time < 3) continue;
    for (const Motion& motion : state.motion) fastest = std::max(fastest, motion.velocity.norm());
  }
  const auto n_asleep = std::count(state.phase.begin(), state.phase.end(), Phase::asleep);
  EXPECT_EQ(n_asleep, std::ssize(state.phase));
  EXPECT_LT(fastest, 1e-3);
}

// --- blocks asleep beside awake ones -----------------------------------------------------------

constexpr double g = 10;

long n_asleep(const State& state) {
  return std::count(state.phase.begin(), state.phase.end(), Phase::asleep);
}

// A pyramid of square layers of bricks, each on four bricks, that settles when it begins.
std::vector<Body> pyramid(int bricks_along, int layers) {
  std::vector<Body> bricks;
  for (int k = 0; k < layers; ++k)
    for (int j = 0; j < bricks_along - k; ++j)
      for (int i = 0; i < bricks_along - k; ++i) {
        const Vec3 low(i + 0.5 * k + 0.002 * ((7 * i + 3 * j + k) % 5),
                       j + 0.5 * k + 0.002 * ((5 * j + i) % 4), 0.52 * k);
        bricks.push_back(body_of(box(low, low + Vec3(0.985, 0.985, 0.5))));
      }
  return bricks;
}

std::vector<Body> column(int n) {
  std::vector<Body> cubes;
  for (int k = 0; k < n; ++k)
    cubes.push_back(body_of(box(Vec3(-0.5, -0.5, k), Vec3(0.5, 0.5, k + 1))));
  return cubes;
}

Scene on_level_ground(const std::vector<Body>& bodies, double restitution = 0) {
  return scene_of(plane_trn(slope_frame(0, 0), 0.5, 40), ground_of(30, restitution), bodies, {});
}

void run_until(const Scene& scene, double time, State& state, Workers* workers = nullptr) {
  Work work = make_work(scene, workers);
  while (state.time < time - 1e-9) step(scene, state, work);
}

// How far the blocks of two runs are apart at most [m].
double distance(const Scene& scene, const State& one, const State& other) {
  double apart = 0;
  for (int b = 0; b < n_blocks(scene); ++b)
    apart = std::max(apart, (motion_at(scene, one, b, one.time).pose.position -
                             motion_at(scene, other, b, other.time).pose.position)
                                .norm());
  return apart;
}

// Where the blocks are after `time` of a run from `state`, as it is and with all blocks awake: how
// far they are apart.
struct Pair {
  State slept, awake;
  double apart = 0;  // [m]
};
Pair with_and_without_sleep(const Scene& scene, const State& state, double time) {
  Pair runs{state, state};
  Scene sleepless = scene;
  sleepless.settings.sleep = false;
  for (int b = 0; b < n_blocks(scene); ++b)
    if (phase_of(state, b) == Phase::asleep) wake(runs.awake, b, state.time);
  runs.awake.carried.clear();
  run_until(scene, state.time + time, runs.slept);
  run_until(sleepless, state.time + time, runs.awake);
  runs.apart = distance(scene, runs.slept, runs.awake);
  return runs;
}

// Error in `time` of blocks that would move were they not asleep: the accelerations that do not
// wake them [m].
double missed_in(double time) { return law::least_speed * g * time * time / 2; }

// Layers of bricks that sag while their contacts grow soft come to rest as one layer does.
TEST(Sleepers, AHighPileFallsAsleep) {
  const Scene scene = on_level_ground(pyramid(8, 8));
  State state = start(scene);
  run_until(scene, 2, state);
  EXPECT_EQ(n_asleep(state), n_blocks(scene));
}

// The last of the bodies is dragged by a force along the foot of the rest, and presses them.
void drag_last(Scene& scene) {
  scene.ground.classes[0].drag_per_time = 5;
  PointLoad load;
  load.block = n_blocks(scene) - 1;
  load.force = scene.blocks.mass[load.block] *
               Vec3(0.075 + 1.02 * g * scene.ground.classes[0].friction, 0.02 * g, 0);
  scene.loads = {load};
}
std::vector<Body> pyramid_and_creeper(int along) {
  std::vector<Body> bodies = pyramid(along, 2);
  bodies.push_back(body_of(box(Vec3(0.5, -1, 0), Vec3(1.5, 0, 0.5))));
  return bodies;
}

// A force drags a block along the foot of bricks that rest. Work is that of the block and of the
// bricks that it touches, whatever else sleeps, and it creeps as far as if all were awake.
TEST(Sleepers, OneThatCreepsKeepsItsNeighboursAwakeAlone) {
  for (const int along : {8, 14}) {
    Scene scene = on_level_ground(pyramid_and_creeper(along));
    drag_last(scene);
    const int creeper = n_blocks(scene) - 1;
    State state = start(scene);
    run_until(scene, 2, state);
    const State before = state;
    Work work = make_work(scene);
    int moved = 0;
    for (int i = 0; i < 200; ++i) moved += step(scene, state, work).substeps;
    EXPECT_LE(moved, 10 * 200) << along;
    EXPECT_GE(n_asleep(state), creeper - 8) << along;
    EXPECT_GT(state.motion[creeper].pose.position.x(),
              before.motion[creeper].pose.position.x() + 0.02)
        << along;
    const double resolved = g * scene.settings.dt * scene.settings.dt;
    EXPECT_LT(with_and_without_sleep(scene, before, 1).apart, resolved) << along;
  }
}

double mechanical(const Scene& scene, const State& state) {
  const Energies e = energies(scene, state);
  return e.translation + e.rotation + e.potential;
}
double booked(const EnergyLedger& l) {
  return l.friction + l.impact + l.contact + l.fence + l.drag + l.removed - l.base;
}

// Energy that the run from `state` lost and did not book, of the work of friction [-].
double imbalance(const Scene& scene, const State& state, double time) {
  State next = state;
  run_until(scene, state.time + time, next);
  const double lost = mechanical(scene, state) - mechanical(scene, next),
               friction = next.ledger.friction - state.ledger.friction;
  EXPECT_GT(friction, 0);
  return std::abs(lost - (booked(next.ledger) - booked(state.ledger))) / friction;
}

TEST(Sleepers, TheLedgerClosesBesideThem) {
  Scene scene = on_level_ground(pyramid_and_creeper(8));
  drag_last(scene);
  State state = start(scene);
  run_until(scene, 2, state);
  EXPECT_GT(n_asleep(state), 100);
  EXPECT_LT(imbalance(scene, state, 1), 1e-6);
}

// Ground whose friction falls with the slid distance, below a block that creeps beside sleepers.
TEST(Sleepers, GroundThatGivesWayBesideThem) {
  Scene scene = on_level_ground(pyramid_and_creeper(8));
  drag_last(scene);
  scene.ground.classes[0].scar_friction = 0.9 * scene.ground.classes[0].friction;
  scene.ground.classes[0].scar_rate = 0.5;
  State state = start(scene);
  run_until(scene, 2, state);
  EXPECT_GT(n_asleep(state), 100);
  const Pair runs = with_and_without_sleep(scene, state, 1);
  EXPECT_GT(n_asleep(runs.slept), 100);
  EXPECT_LT(runs.apart, g * scene.settings.dt * scene.settings.dt);
  EXPECT_LT(imbalance(scene, state, 1), 1e-6);
}

// Two bricks that a bond holds together sleep and wake together; the creeper presses one of them.
TEST(Sleepers, BondedBlocksWakeTogether) {
  std::vector<Body> bodies = {body_of(box(Vec3(0, 0, 0), Vec3(1, 1, 0.5))),
                              body_of(box(Vec3(0, 1, 0), Vec3(1, 2, 0.5))),
                              body_of(box(Vec3(-1.5, -1, 0), Vec3(-0.5, 0, 0.5)))};
  for (Body& body : bodies) body.parts[0].face_tag.assign(6, 0);
  Scene scene = on_level_ground(bodies);
  scene.joints.of_set = {ground_of(20)};
  scene.joints.of_set[0].cohesion = scene.joints.of_set[0].tension = 1e6;
  State state = start(scene);
  ASSERT_EQ(std::ssize(state.bonds), 1);
  run_until(scene, 2, state);
  ASSERT_EQ(n_asleep(state), 3);
  wake_bonded(2, state.time, state);
  state.motion[2].velocity = Vec3(4, 0.05, 0);
  long fewest = 3;
  const State before = state;
  Work work = make_work(scene);
  for (int i = 0; i < 100; ++i) {
    step(scene, state, work);
    fewest = std::min(fewest, n_asleep(state));
    EXPECT_EQ(state.phase[0] == Phase::asleep, state.phase[1] == Phase::asleep) << i;
  }
  EXPECT_EQ(fewest, 0);
  EXPECT_LT(with_and_without_sleep(scene, before, 0.5).apart, missed_in(0.5));
}

// A block that leans on a fence sleeps; one that hits the same panel moves it, and wakes the block.
TEST(Sleepers, AFenceThatGivesWayWakesWhatTouchesIt) {
  std::vector<Body> bodies = {body_of(box(Vec3(-1.25, -2, 0), Vec3(-0.25, -1, 1))),
                              body_of(box(Vec3(-9, 1, 0), Vec3(-8, 2, 1)))};
  Scene scene = on_level_ground(bodies);
  StandingFence fence;
  fence.posts = {Vec3(0, -5, 0), Vec3(0, 5, 0)};
  fence.depth = {0.5};
  fence.height = 4;
  fence.capacity = 2e5;
  fence.deflection = 2;
  add_fence(scene, fence);
  State state = start(scene);
  run_until(scene, 2, state);
  ASSERT_EQ(n_asleep(state), 2);
  wake_bonded(1, state.time, state);
  state.motion[1].velocity = Vec3(12, 0, 0);
  const Pair runs = with_and_without_sleep(scene, state, 1.5);
  EXPECT_GT(runs.awake.ledger.fence, 1e3);
  EXPECT_LT(runs.apart, missed_in(0.1));
  EXPECT_NEAR(runs.slept.ledger.fence, runs.awake.ledger.fence, 1e-3 * runs.awake.ledger.fence);
}

// Blocks on a foot that is pulled away wake in that step, and fall as if they had not slept.
TEST(Sleepers, AColumnWhoseFootIsPulledAwayWakes) {
  const Scene scene = on_level_ground(column(10));
  State state = start(scene);
  run_until(scene, 2, state);
  ASSERT_EQ(n_asleep(state), 10);
  wake_bonded(0, state.time, state);
  state.motion[0].velocity.x() = 20;
  State next = state;
  run_until(scene, next.time + scene.settings.dt, next);
  EXPECT_EQ(n_asleep(next), 0);
  EXPECT_LT(with_and_without_sleep(scene, state, 0.4).apart, missed_in(0.4));
}

// A block falls on a pile that sleeps: the pile wakes before, and moves as if it had not slept.
TEST(Sleepers, APileThatIsHitWakesBeforeTheHit) {
  std::vector<Body> bodies = pyramid(4, 4);
  bodies.push_back(body_of(box(Vec3(1.2, 1.3, 45), Vec3(2.2, 2.3, 46))));
  const Scene scene = on_level_ground(bodies, 0.5);
  State state = start(scene), before;
  run_until(scene, 2.8, state);
  ASSERT_EQ(n_asleep(state), 30);
  Work work = make_work(scene);
  for (const std::int64_t impacts = state.counters.impacts; state.counters.impacts == impacts;) {
    ASSERT_LT(state.time, 4);
    before = state;
    step(scene, state, work);
  }
  EXPECT_EQ(n_asleep(state), 0);
  ASSERT_EQ(n_asleep(before), 30);
  EXPECT_EQ(with_and_without_sleep(scene, before, 0.5).apart, 0);
}

// A plate that leans on a block falls when that goes.
TEST(Sleepers, WhatLeansOnABlockThatLeavesWakes) {
  const Mat3 lean = rotation_by(Vec3(0, std::numbers::pi / 6, 0)).toRotationMatrix();
  const std::vector<Body> bodies = {
      body_of(box(Vec3(0.2, -1, 0), Vec3(1.2, 1, 1))),
      body_of(moved(box(Vec3(-1.2, -0.5, 0), Vec3(-1, 0.5, 2.2)), lean, Vec3(-1, 0, 0)))};
  const Scene scene = on_level_ground(bodies);
  State state = start(scene);
  run_until(scene, 4, state);
  ASSERT_EQ(n_asleep(state), 2);
  wake_bonded(0, state.time, state);
  state.motion[0].velocity.x() = 10;
  const Pair runs = with_and_without_sleep(scene, state, 0.5);
  EXPECT_LT(runs.awake.motion[1].pose.position.z(), state.motion[1].pose.position.z() - 0.1);
  EXPECT_LT(runs.apart, missed_in(0.5));
}

TEST(Sleepers, AreNoneWhereTheGroundShakes) {
  Scene scene = on_level_ground(column(3));
  scene.base = {{0, 9}, {Vec3(1e-3, 0, 0), Vec3(1e-3, 0, 0)}, {}};
  State state = start(scene);
  run_until(scene, 2, state);
  EXPECT_EQ(n_asleep(state), 0);
}

// The state is sufficient to continue a run, and threads change no bit.
TEST(Sleepers, GoOnFromTheStateWithTheSameBits) {
  std::vector<Body> bodies = pyramid(8, 2);
  bodies.push_back(body_of(box(Vec3(3.2, 3.3, 16), Vec3(4.2, 4.3, 17))));
  const Scene scene = on_level_ground(bodies, 0.5);
  const auto run_in = [&](unsigned threads, bool resumes) {
    Workers workers(threads);
    State state = start(scene);
    if (resumes)
      for (double t = 0.3; t < 2.6; t += 0.3) run_until(scene, t, state, &workers);
    run_until(scene, 2.6, state, &workers);
    return state;
  };
  const State once = run_in(1, false);
  EXPECT_GT(n_asleep(once) + once.counters.impacts, 0);
  for (const auto& [threads, resumes] :
       {std::pair{1U, true}, {2U, false}, {3U, false}, {8U, true}}) {
    const State other = run_in(threads, resumes);
    EXPECT_EQ(other.phase, once.phase);
    for (std::size_t b = 0; b < once.motion.size(); ++b)
      EXPECT_EQ(other.motion[b].pose.position, once.motion[b].pose.position) << threads << ' ' << b;
  }
}

}  // namespace
