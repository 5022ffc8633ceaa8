// Phases of a block: questions, transitions, unborn blocks.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "scene/phase.hpp"
#include "solver/law_numbers.hpp"
#include "step/substep.hpp"
#include "verify/cases/case_run.hpp"
#include "verify/cases/cases.hpp"

namespace {

using namespace talus;
using namespace talus::cases;

struct Answers {
  Phase phase;
  bool takes_part, does_not_move, exists, carries_nothing;
};

TEST(Phase, QuestionsOfEachState) {
  const std::array<Answers, 8> table = {{{Phase::near_ground, true, false, true, false},
                                         {Phase::flight, true, false, true, false},
                                         {Phase::asleep, true, true, true, false},
                                         {Phase::left_domain, false, true, true, false},
                                         {Phase::stopped, false, true, true, false},
                                         {Phase::unborn, false, true, false, true},
                                         {Phase::crushed, false, true, true, true},
                                         {Phase::broken, false, true, false, true}}};
  EXPECT_EQ(table.size(), static_cast<std::size_t>(last_phase) + 1);
  for (std::size_t k = 0; k < table.size(); ++k) {
    EXPECT_EQ(static_cast<std::size_t>(table[k].phase), k);
    EXPECT_EQ(takes_part(table[k].phase), table[k].takes_part) << k;
    EXPECT_EQ(does_not_move(table[k].phase), table[k].does_not_move) << k;
    EXPECT_EQ(exists(table[k].phase), table[k].exists) << k;
    EXPECT_EQ(carries_nothing(table[k].phase), table[k].carries_nothing) << k;
  }
}

TEST(Phase, ABlockFliesLandsSleepsAndWakes) {
  BlockLives lives = start_lives(std::vector<Pose>(2));
  take_off(lives, 1, 2.5);
  EXPECT_EQ(lives.phase[1], Phase::flight);
  EXPECT_EQ(lives.flight_end[1], 2.5);
  land(lives, 1, 2);
  EXPECT_EQ(lives.phase[1], Phase::near_ground);
  EXPECT_EQ(lives.local_time[1], 2);
  lives.rest_steps[1] = 200;
  go_to_sleep(lives, 1);
  EXPECT_EQ(lives.phase[1], Phase::asleep);
  wake(lives, 1, 7);
  EXPECT_EQ(lives.phase[1], Phase::near_ground);
  EXPECT_EQ(lives.rest_steps[1], 0);
  EXPECT_EQ(lives.local_time[1], 7);
  leave_domain(lives, 1);
  EXPECT_FALSE(takes_part(lives, 1));
  EXPECT_EQ(lives.phase[0], Phase::near_ground);
}

// Cube 0 slides down a slope or rests on it; with `with_fragment` cube 1 is half inside it.
Scene cubes(bool with_fragment, double dip_deg, const Settings& settings) {
  const SlopeFrame slope = slope_frame(dip_deg, 30);
  const auto cube_at = [&](double along) {
    return body_of(box_in(slope, along * slope.dip, Vec3(-0.5, -0.5, 0), Vec3(0.5, 0.5, 1)));
  };
  std::vector<Body> bodies = {cube_at(0)};
  if (with_fragment) bodies.push_back(cube_at(0.5));
  return scene_of(plane_trn(slope, 1, 60), ground_of(20, 0.5), bodies, settings);
}

void expect_equal(const Motion& a, const Motion& b) {
  EXPECT_EQ(a.pose.position, b.pose.position);
  EXPECT_EQ(a.pose.attitude.coeffs(), b.pose.attitude.coeffs());
  EXPECT_EQ(a.velocity, b.velocity);
  EXPECT_EQ(a.angular_momentum, b.angular_momentum);
}

class UnbornBlock : public testing::TestWithParam<bool> {};

// One that slides, with an unborn block inside of it, moves to the bit as without that.
TEST_P(UnbornBlock, MovesNothingIsMovedByNothingAndWeighsNothing) {
  Settings settings;
  RunLaw law, law_alone;
  if (GetParam()) law = law_alone = PaperLaw{}, settings.normal_stiffness = 1e8, settings.dt = 1e-3;
  const Scene scene = cubes(true, 30, settings), alone = cubes(false, 30, settings);
  Work work = make_work(scene), work_alone = make_work(alone);
  State state = start_by(law, scene, work), state_alone = start_by(law_alone, alone, work_alone);
  keep_unborn(state, 1);
  const Motion before = state.motion[1];
  for (int i = 0; i < 100; ++i) {
    step_by(law, scene, state, work);
    step_by(law_alone, alone, state_alone, work_alone);
    for (const Segment& segment : work.segments) EXPECT_EQ(segment.block, 0);
  }
  EXPECT_GT((state.motion[0].pose.position - scene.blocks.rest[0].position).norm(), 5e-3);
  expect_equal(state.motion[0], state_alone.motion[0]);
  expect_equal(state.motion[1], before);
  EXPECT_EQ(energies(scene, state).potential, energies(alone, state_alone).potential);
  EXPECT_EQ(state.phase[1], Phase::unborn);
}

INSTANTIATE_TEST_SUITE_P(BothLaws, UnbornBlock, testing::Values(false, true));

// Asleep on its slope, a block is not woken by one that is not there.
TEST(UnbornBlock, WakesNoSleeper) {
  const Scene scene = cubes(true, 5, {});
  State state = start(scene);
  Work work = make_work(scene);
  keep_unborn(state, 1);
  for (int i = 0; i < 2 * law::steps_before_sleep; ++i) step(scene, state, work);
  EXPECT_EQ(state.phase[0], Phase::asleep);
}

TEST(UnbornBlock, MovesFromItsBirthOn) {
  const SlopeFrame slope = slope_frame(30, 0);
  const auto cube_at = [&](double along) {
    return body_of(box_in(slope, along * slope.dip, Vec3(-0.5, -0.5, 0), Vec3(0.5, 0.5, 1)));
  };
  const Scene scene =
      scene_of(plane_trn(slope, 1, 60), ground_of(20), {cube_at(0), cube_at(20)}, {});
  State state = start(scene);
  Work work = make_work(scene);
  keep_unborn(state, 1);
  for (int i = 0; i < 20; ++i) step(scene, state, work);
  be_born(state, 1, state.time);
  const double born = state.time;
  for (int i = 0; i < 100; ++i) step(scene, state, work);
  const double a = 10 * (std::sin(30 * degree) - std::tan(20 * degree) * std::cos(30 * degree));
  const double t = state.time - born;
  const Vec3 path = state.motion[1].pose.position - scene.blocks.rest[1].position;
  EXPECT_NEAR(path.norm(), a * t * t / 2, 1e-3 * a * t * t / 2);
}

}  // namespace
