#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "motion/rotation.hpp"
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
  for (int i = 0; i < 10; ++i) {  // what creeps on in one direction does not stay
    pose.position.x() = from.position.x() + 1e-4 * i;
    watch_rest(scene, 0, state);
    EXPECT_LT(state.rest_steps[0], 14);
  }
  state.rest_steps[0] = 5;
  pose.attitude = rotation_by(Vec3(0, 0, 4e-4)) * pose.attitude;  // corners are 0.87 m off
  watch_rest(scene, 0, state);
  EXPECT_EQ(state.rest_steps[0], 0);
}

// A block that something shakes by micrometres for good is at rest; what it still moves by is lost,
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

}  // namespace
