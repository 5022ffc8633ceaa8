// Deep blocks and first faults of a run.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "step/deep_blocks.hpp"
#include "step/step.hpp"
#include "verify/cases/cases.hpp"

namespace {

using namespace talus;
using namespace talus::cases;

/// Blocks on a slope that dips to +x, and their steps.
struct OnASlope {
  OnASlope(double dip_deg, const std::vector<Body>& bodies)
      : scene(scene_of(plane_trn(slope_frame(dip_deg, 90), 5, 50), ground_of(60), bodies, {})),
        state(start(scene)),
        work(make_work(scene)) {}
  StepReport go() { return step(scene, state, work); }

  Scene scene;
  State state;
  Work work;
};

Body cube_at(const Vec3& low, double width = 1) {
  return body_of(box(low, low + Vec3::Constant(width)));
}

// A contact's report that a block is deep counts only when its body overlaps another.
TEST(DeepBlocks, ASuspectThatHardlyOverlapsAnythingIsNotDeep) {
  OnASlope stack(0, {cube_at({0, 0, 0}), cube_at({0, 0, 1}), cube_at({5, 0, 30})});
  for (int i = 0; i < 20; ++i) {
    StepReport before;
    for (int b = 0; b < 3; ++b) note_overlap(b, 0.8, 1, stack.work.deep, before);
    const StepReport report = stack.go();
    EXPECT_FALSE(has(report.flags, StepFlag::deep));
    EXPECT_LT(report.largest_penetration, 1e-3);
  }
  for (const DeepBlock& deep : stack.state.deep) EXPECT_EQ(deep.steps, 0);
}

// Two cubes that overlap by 0.2 m far above the ground: the smaller one is in the larger one.
TEST(DeepBlocks, TheThinnerOfTwoBlocksIsInTheOther) {
  for (const int small : {0, 1}) {
    std::vector<Body> bodies = {cube_at({-1.5, -1.5, 30}, 3), cube_at({-1.5, -1.5, 30}, 3)};
    bodies[static_cast<std::size_t>(small)] = cube_at({-0.5, -0.5, 32.8});
    OnASlope pair(0, bodies);
    const StepReport report = pair.go();
    EXPECT_TRUE(has(report.flags, StepFlag::deep));
    EXPECT_NEAR(report.largest_penetration, 0.2, 0.01);
    const DeepBlock& deep = pair.state.deep[static_cast<std::size_t>(small)];
    EXPECT_EQ(deep.partner, 1 - small);
    EXPECT_EQ(deep.steps, 1);
    EXPECT_EQ(deep.time, pair.state.time);
    EXPECT_NEAR(deep.depth, 0.2, 0.01);
    EXPECT_LT((deep.place - Vec3(0, 0, 33.3)).norm(), 0.02);
    EXPECT_EQ(pair.state.deep[static_cast<std::size_t>(1 - small)].steps, 0);
  }
}

// Set 0.2 m into a slope along its normal: that is its depth, not the vertical one.
TEST(DeepBlocks, DepthInTheGroundIsThatAlongItsNormal) {
  for (const double dip : {0.0, 35.0}) {
    const SlopeFrame frame = slope_frame(dip, 90);
    OnASlope slope(dip,
                   {body_of(box_in(frame, Vec3::Zero(), Vec3(-0.5, -0.5, 0), Vec3(0.5, 0.5, 1)))});
    slope.state.motion[0].pose.position -= 0.2 * frame.normal;
    slope.go();
    EXPECT_EQ(slope.state.deep[0].partner, -1);
    const Vec3 down = slope.scene.blocks.rest[0].position - slope.state.motion[0].pose.position;
    const double expected = frame.normal.dot(down);  // it is pressed out already
    EXPECT_GT(expected, 0.15);
    EXPECT_NEAR(slope.state.deep[0].depth, expected, 1e-6) << dip;
  }
}

// How far block 0 has gone down.
double gone_down(const Scene& scene, const State& state) {
  return scene.blocks.rest[0].position.z() - state.motion[0].pose.position.z();
}

// A ridge goes into a plate whose corners are all above the ground.
TEST(DeepBlocks, ARidgeInAPlateCounts) {
  const auto ridge = [](double x, double) { return -0.8 * std::abs(x); };
  const Body plate = body_of(box(Vec3(-2, -2, 0), Vec3(2, 2, 0.4)));
  const Scene scene = scene_of(make_trn(ridge, 5, 50), ground_of(60), {plate}, {});
  State state = start(scene);
  Work work = make_work(scene);
  state.motion[0].pose.position.z() -= 0.1;
  step(scene, state, work);
  EXPECT_EQ(state.deep[0].steps, 1);
  const double expected = gone_down(scene, state);
  EXPECT_GT(expected, 0.08);
  EXPECT_NEAR(state.deep[0].depth, expected, 1e-6);
}

// A block that something threw out is faster than its fall can have made it; one that fell is not.
TEST(DeepBlocks, ABlockThatWasDeepIsWatchedForItsSpeed) {
  for (const double thrown : {0.0, 12.0}) {
    OnASlope pair(0, {cube_at({-1.5, -1.5, 30}, 3), cube_at({-0.5, -0.5, 32.8})});
    pair.go();
    EXPECT_EQ(pair.state.deep[1].steps, 1);
    EXPECT_FALSE(pair.state.deep[1].is_too_fast);
    pair.state.motion[1].pose.position.x() += 4;
    pair.state.motion[1].velocity.x() += thrown;
    for (int i = 0; i < 20; ++i) pair.go();
    EXPECT_EQ(pair.state.deep[1].is_too_fast, thrown > 0);
    EXPECT_FALSE(pair.state.deep[1].is_deep);
    EXPECT_FALSE(pair.state.deep[0].is_too_fast);
  }
}

// A wedge in a narrow notch: each of its walls reads a fifth of the edge's depth.
TEST(DeepBlocks, AnEdgeInANotchIsInByItsDistanceFromTheGround) {
  const double half = std::tan(10 * std::numbers::pi / 180) * 3;
  const Body wedge = body_of(polyhedron(
      {{0, -1, 0}, {half, -1, 3}, {-half, -1, 3}, {0, 1, 0}, {half, 1, 3}, {-half, 1, 3}},
      {{0, 1, 2}, {3, 5, 4}, {0, 3, 4, 1}, {1, 4, 5, 2}, {2, 5, 3, 0}}));
  const double steep = 1 / std::tan(15 * std::numbers::pi / 180);
  const auto notch = [steep](double x, double) { return steep * std::abs(x); };
  const Scene scene = scene_of(make_trn(notch, 1, 20), ground_of(60), {wedge}, {});
  State state = start(scene);
  Work work = make_work(scene);
  state.motion[0].pose.position.z() -= 0.13;
  const StepReport report = step(scene, state, work);
  const double sunk = gone_down(scene, state);
  ASSERT_GT(sunk, 0.1 * scene.blocks.shapes.thickness[0]);
  EXPECT_NEAR(report.largest_penetration, sunk, 1e-6);
  EXPECT_EQ(state.deep[0].steps, 1);
}

// An overlap that is not deep is named too where it is the deepest of the run: block, partner,
// time, place.
TEST(DeepBlocks, TheDeepestOverlapOfARunIsNamed) {
  OnASlope pair(0,
                {cube_at({0, 0, 0}), cube_at({-1.5, -1.5, 30}, 3), cube_at({-0.5, -0.5, 32.99})});
  pair.go();
  const NumericalFault first = pair.state.numerical_faults.deepest;
  EXPECT_EQ(first.block, 2);
  EXPECT_EQ(first.partner, 1);
  EXPECT_NEAR(first.depth, 0.01, 1e-3);
  EXPECT_EQ(first.time, pair.state.time);
  EXPECT_LT((first.place - Vec3(0, 0, 33.49)).norm(), 0.02);
  pair.state.motion[2].pose.position.z() += 1;
  for (int i = 0; i < 3; ++i) pair.go();
  EXPECT_EQ(pair.state.numerical_faults.deepest.time, first.time);  // they are apart
  pair.state.motion[0].pose.position.z() -= 0.03;
  pair.go();
  EXPECT_EQ(pair.state.numerical_faults.deepest.block, 0);
  EXPECT_EQ(pair.state.numerical_faults.deepest.partner, -1);
  EXPECT_EQ(pair.state.deep[0].steps, 0);
}

// So is the first block that leaves the terrain.
TEST(NumericalFaults, NameTheFirstBlockThatLeft) {
  std::vector<Body> bodies = {cube_at({0, 0, 0}), cube_at({40, 0, 0}), cube_at({45, 3, 5})};
  bodies[2].velocity = Vec3(20, 0, 0);
  OnASlope slope(0, bodies);
  for (int i = 0; i < 100; ++i) slope.go();
  ASSERT_EQ(slope.state.counters.left_domain, 1) << slope.state.motion[2].pose.position.transpose();
  const NumericalFault& left = slope.state.numerical_faults.left_domain;
  EXPECT_EQ(left.block, 2);
  EXPECT_GT(left.place.x(), 46);
  EXPECT_GT(left.time, 0);
  EXPECT_EQ(slope.state.numerical_faults.fell_through.block, -1);
  EXPECT_EQ(slope.state.numerical_faults.not_finite.block, -1);
}

}  // namespace
