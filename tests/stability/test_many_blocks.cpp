// Many blocks on each other: stable scenes stay, and blocks slide, topple or collide as rigid
// bodies do; with any stiffness and step, the outcome is bounded. Long forms:
// unit/step/test_many_blocks_long.cpp.
#include <gtest/gtest.h>

#include <thread>

#include "base/workers.hpp"
#include "stability/block_scenes.hpp"
#include "verify/cases/block_cases.hpp"

namespace {

using namespace talus;
using namespace talus::cases;
using namespace talus::stability;

// A pile of four cubes is 4 high and 1 wide: it topples where tan(dip) > 1/4, dip > 14.04 degrees.
TEST(ManyBlocks, PileTopplesWhereItsWeightLeavesItsBase) { EXPECT_LT(pile_topples({}).error, 0.5); }

// The engine finds the forces between the columns, and which of them slide.
TEST(ManyBlocks, ColumnsToppleAsGoodmanAndBraySay) {
  const CaseResult result = columns_topple({});
  EXPECT_NEAR(result.expected, 38.146, 1e-3);
  EXPECT_LT(result.error, 0.5);
}

TEST(ManyBlocks, BlockSlidesOnABlock) { EXPECT_LT(block_on_block({}).error, 2e-3); }

TEST(ManyBlocks, WedgeSlidesInAGrooveOfTwoBlocks) { EXPECT_LT(groove({}).error, 5e-3); }

TEST(ManyBlocks, DominoesFallAsARigidComputationSays) {
  CaseSettings settings;
  settings.dt = 1e-3;
  EXPECT_LT(dominoes(settings).error, 0.02);
}

TEST(ManyBlocks, CollidingBlocksKeepMomentum) {
  for (const double restitution : {0.0, 0.5, 1.0}) {
    const CaseResult result = collision({}, restitution);
    EXPECT_LT(result.error, 1e-10) << restitution;
    EXPECT_LT(result.value, -0.05) << restitution;  // they met, and friction took its share
  }
}

// A 10 m cube on four cubes of 0.1 m: not pushed through the ground, nor squeezed out.
TEST(ManyBlocks, SmallBlocksBearALargeOne) {
  for (const double dt : {1e-3, 5e-3, 1e-2}) {
    std::vector<Body> bodies = {body_of(box(Vec3(-5, -5, 0.1), Vec3(5, 5, 10.1)))};
    for (const double x : {-4.0, 4.0})
      for (const double y : {-4.0, 4.0})
        bodies.push_back(body_of(box(Vec3(x - 0.05, y - 0.05, 0), Vec3(x + 0.05, y + 0.05, 0.1))));
    Settings settings;
    settings.dt = dt;
    const Scene scene = on_plane(slope_frame(0, 0), bodies, 30, 30, settings, 2, 40);
    State state = start(scene);
    const std::vector<Vec3> before = places(scene, state);
    run(scene, 2, state);
    EXPECT_LT(farthest(before, places(scene, state)), 1e-3) << dt;
    EXPECT_EQ(state.counters.unconverged, 0);
  }
}

// A 4 m cube on 25 of 0.4 m that touch each other, a thousandth of its mass each.
std::vector<Body> large_on_a_layer(const SlopeFrame& frame) {
  const auto in_frame = [&](const Vec3& low, const Vec3& high) {
    return body_of(box_in(frame, Vec3::Zero(), low, high));
  };
  std::vector<Body> bodies = {in_frame(Vec3(-2, -2, 0.4), Vec3(2, 2, 4.4))};
  for (int i = 0; i < 25; ++i) {
    const double x = 0.4 * (i % 5) - 1, y = 0.4 * (i / 5) - 1;
    bodies.push_back(in_frame(Vec3(x, y, 0), Vec3(x + 0.4, y + 0.4, 0.4)));
  }
  return bodies;
}

// A large block falls on small ones that lie on the ground: impulses on a small one are large and
// balance. No step displaces it farther than the speeds that it has would take it.
TEST(ManyBlocks, ImpulsesThatBalanceDisplaceNothing) {
  for (const double speed : {4.0, 8.0, 12.0}) {
    std::vector<Body> bodies = large_on_a_layer(slope_frame(0, 0));
    Settings settings;
    settings.dt = 5e-3;
    Scene scene = on_plane(slope_frame(0, 0), bodies, 30, 30, settings, 2, 40);
    State state = start(scene);
    state.motion[0].pose.position.z() += 0.3;
    state.motion[0].pose.attitude = Quat(Eigen::AngleAxisd(0.01, Vec3(1, 2, 0).normalized()));
    state.motion[0].velocity = Vec3(1, 0, -speed);
    double farther = 0;
    for (int k = 0; k < 100; ++k) {
      const State before = state;
      run(scene, settings.dt, state);
      for (size_t b = 1; b < state.motion.size(); ++b) {
        const Motion &from = before.motion[b], &to = state.motion[b];
        const double path = (to.pose.position - from.pose.position).norm();
        const double fastest = std::max({from.velocity.norm(), to.velocity.norm(), speed});
        farther = std::max(farther, path - settings.dt * fastest);
      }
    }
    EXPECT_LE(farther, 0) << speed;
  }
}

// Contacts of small blocks among large ones are as stiff as their loads need: a large one sinks in
// by no more than 2 g dt^2 a contact, slides on them as one with them, and no step is repeated
// because of stiff contacts without load, but the first two, while the loads are unknown.
TEST(ManyBlocks, ALayerOfSmallBlocksCarriesALargeOne) {
  for (const double dt : {1e-3, 5e-3, 1e-2}) {
    Settings settings;
    settings.dt = dt;
    const SlopeFrame flat = slope_frame(0, 0), slope = slope_frame(30, 25);
    const auto moved = [](const Scene& scene, State& state) {
      const std::vector<Vec3> before = places(scene, state);
      run(scene, 2 * scene.settings.dt, state);
      const RunCounters settling = state.counters;
      EXPECT_LT(settling.cut_back, 20);
      run(scene, 2 - 2 * scene.settings.dt, state);
      EXPECT_EQ(state.counters.unconverged, 0);
      EXPECT_EQ(state.counters.cut_back, settling.cut_back);
      EXPECT_LT(state.counters.passes - settling.passes, 15 * state.counters.steps);
      return (places(scene, state)[0] - before[0]).norm();
    };
    const Scene rests = on_plane(flat, large_on_a_layer(flat), 30, 30, settings, 2, 40);
    State resting = start(rests);
    const double g = rests.gravity.norm();
    EXPECT_LT(moved(rests, resting), 4 * g * dt * dt) << dt;

    const Scene slides = on_plane(slope, large_on_a_layer(slope), 40, 20, settings, 2, 40);
    State sliding = start(slides);
    const double a = g * (std::sin(30 * degree) - std::tan(20 * degree) * std::cos(30 * degree));
    EXPECT_NEAR(moved(slides, sliding), 2 * a, 2e-3 * 2 * a) << dt;
  }
}

// It rests on the cube, none goes through the other.
TEST(ManyBlocks, ThinPlateRestsOnABlock) { EXPECT_LT(thin_plate({}).error, 1e-6); }

TEST(ManyBlocks, ArchOfSevenStands) { EXPECT_LT(arch_stands({}).error, 1e-6); }

// Long form: the whole range of stiffness and step, more heaps.
TEST(ManyBlocks, AnyStiffnessAndStepIsBounded) {
  for (const double stiffness : {0.0, 1e6})
    for (const double dt : {5e-3, 1e-2, 5e-2}) expect_bounded(stiffness, dt, 2, 10);
  for (const double stiffness : {0.0, 1e6, 1e14}) expect_bounded(stiffness, 1e-3, 2, 1);
}

// The energy lost by heaps is the work of friction, impacts and contacts, to a half per cent of the
// initial energy.
TEST(ManyBlocks, EnergyBalanceCloses) {
  for (int number = 0; number < 10; ++number) {
    const Scene scene = heap({}, number);
    State state = start(scene);
    const Energies e = energies(scene, state);
    const double before = mechanical_energy(scene, state);
    run(scene, 2, state);
    const EnergyLedger& l = state.ledger;
    const double taken = l.friction + l.impact + l.contact;
    EXPECT_GT(l.impact, 0.05 * (e.translation + e.rotation));
    EXPECT_NEAR(before - mechanical_energy(scene, state), taken,
                5e-3 * (e.translation + e.rotation))
        << number;
  }
}

void expect_same_bits(const State& a, const State& b) {
  ASSERT_EQ(a.motion.size(), b.motion.size());
  for (std::size_t i = 0; i < a.motion.size(); ++i) {
    const Motion &p = a.motion[i], &q = b.motion[i];
    EXPECT_EQ(p.pose.position, q.pose.position) << i;
    EXPECT_EQ(p.pose.attitude.coeffs(), q.pose.attitude.coeffs()) << i;
    EXPECT_EQ(p.velocity, q.velocity) << i;
    EXPECT_EQ(p.angular_momentum, q.angular_momentum) << i;
  }
}

// A run that continues from a copy of its state, with new scratch, gives the same bits.
TEST(ManyBlocks, ResumedRunHasTheSameBits) {
  const Scene scene = heap({});
  State whole = start(scene);
  run(scene, 1, whole);
  State resumed = whole;
  Work used = make_work(scene);
  State other = start(scene);
  run(scene, 0.7, other, used);
  run(scene, 1, whole);
  Work fresh = make_work(scene);
  for (int i = 0; i < 200; ++i) step(scene, resumed, i < 100 ? used : fresh);
  EXPECT_GT(whole.counters.impacts, 20);
  expect_same_bits(whole, resumed);
}

// Runs side by side are those one after the other, to the bit.
TEST(ManyBlocks, RunsInTwoThreadsHaveTheSameBits) {
  const Scene scene = heap({});
  State alone = start(scene), beside[2] = {start(scene), start(scene)};
  run(scene, 1, alone);
  std::thread first([&] { run(scene, 1, beside[0]); });
  run(scene, 1, beside[1]);
  first.join();
  EXPECT_GT(alone.counters.impacts, 20);
  for (const State& state : beside) expect_same_bits(alone, state);
}

// Stones of a wall on a slope that is too steep for them: a step shared by threads has the bits of
// one thread, also where it continues in another number of them.
void expect_bits_of_one_thread(int n_courses, int n_long, double duration) {
  const Scene scene =
      on_plane(slope_frame(35, 30), wall_of(n_courses, n_long, 1), 25, 25, {}, 2, 40);
  State alone = start(scene);
  run(scene, duration, alone);
  for (const int n_threads : {2, 3, 8}) {
    Workers workers(n_threads);
    Work work = make_work(scene, &workers);
    State shared = start(scene);
    run(scene, duration / 2, shared, work);
    State resumed = shared;
    run(scene, duration - duration / 2, shared, work);
    expect_same_bits(alone, shared);
    run(scene, duration - duration / 2, resumed);
    expect_same_bits(alone, resumed);
  }
}

TEST(ManyBlocks, SharedByThreadsInTwoThreadsAndMoreHaveTheSameBits) {
  expect_bits_of_one_thread(6, 6, 0.3);
}

TEST(ManyBlocks, HundredsInTwoThreadsAndMoreHaveTheSameBits) {
  expect_bits_of_one_thread(12, 12, 0.05);
}

}  // namespace
