// Neighbours that are not touched change nothing: a block beside them moves as it does alone, to
// the bit.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "base/random.hpp"
#include "scene/stems.hpp"
#include "scene/yielding.hpp"
#include "step/flight.hpp"
#include "step/step.hpp"
#include "verify/cases/cases.hpp"

namespace {

using namespace talus;
using namespace talus::cases;

// Rough in x alone, so that boxes that turn about y alone keep their distance in y.
double waves(double x, double /*y*/) {
  return 0.8 * std::sin(0.7 * x) + 0.3 * std::sin(2.1 * x + 0.4) - 0.5 * x;
}

// A box of 1 m in y with its middle at (x, y), that turns about y.
Body rock_at(double x, double y, Random& random) {
  const auto draw = [&random](double low, double high) { return random.uniform(low, high); };
  const Vec3 half(draw(0.2, 0.6), 0.5, draw(0.2, 0.6));
  const Mat3 turn = Eigen::AngleAxisd(draw(0, 3), Vec3::UnitY()).toRotationMatrix();
  return body_of(
      moved(box(-half, half), turn, Vec3::Zero(), Vec3(x, y, waves(x, y) + draw(0.9, 1.5))),
      Vec3(draw(0, 6), 0, 0), Vec3(0, draw(-5, 5), 0));
}

Scene rough(const std::vector<Body>& bodies) {
  GroundClass ground;
  ground.friction = 0.5;
  ground.restitution = 0.4;
  return scene_of(make_trn(waves, 1, 40), ground, bodies, {});
}

bool is_same(const Motion& a, const Motion& b) {
  return a.pose.position == b.pose.position &&
         a.pose.attitude.coeffs() == b.pose.attitude.coeffs() && a.velocity == b.velocity &&
         a.angular_momentum == b.angular_momentum;
}

// The span of block b in y at the end of a step [m].
std::array<double, 2> span_in_y(const Scene& scene, const State& state, int b) {
  const Pose pose = motion_at(scene, state, b, state.time).pose;
  double low = 1e9, high = -1e9;
  for (const Vec3& x : vertices_of(scene.blocks.shapes, b)) {
    const double y = place(pose, x).y();
    low = std::min(low, y), high = std::max(high, y);
  }
  return {low, high};
}

constexpr double near_m = 5e-4;  // so near a rock that hits have turned may touch within a step

// Steps in which block 0 was within reach of something and moved alone all the same, up to the
// first that differs from the scene without that. Ends where `touches` says that it may.
template <class Touches>
int steps_as_alone(const Scene& alone, const Scene& beside, int n_steps, const Touches& touches) {
  State of_alone = start(alone), of_beside = start(beside);
  Work work_alone = make_work(alone), work_beside = make_work(beside);
  int n_close = 0;
  for (int i = 0; i < n_steps; ++i) {
    step(alone, of_alone, work_alone);
    step(beside, of_beside, work_beside);
    if (touches(of_beside)) break;
    n_close += work_beside.untouched.alone[0];
    const double t = of_alone.time;
    const bool same = is_same(motion_at(alone, of_alone, 0, t), motion_at(beside, of_beside, 0, t));
    EXPECT_TRUE(same) << "step " << i;
    if (!same) break;
  }
  return n_close;
}

TEST(Untouched, RocksMoveAsEachAloneToTheBit) {
  Random random(3, "rocks side by side");
  int n_close = 0;
  for (int i = 0; i < 1000; ++i) {
    const double gap = random.uniform(0.001, 0.02);
    const double x = random.uniform(-30, -10);
    const Body one = rock_at(x, 0.3, random), other = rock_at(x, 1.3 + gap, random);
    const Scene beside = rough({one, other});
    const auto touches = [&beside](const State& state) {
      return span_in_y(beside, state, 1)[0] - span_in_y(beside, state, 0)[1] < near_m;
    };
    n_close += steps_as_alone(rough({one}), beside, 60, touches) > 0;
  }
  EXPECT_GT(n_close, 800);
}

TEST(Untouched, APanelBesideTheirPathChangesNothing) {
  Random random(4, "rocks along a panel");
  int n_close = 0;
  for (int i = 0; i < 200; ++i) {
    const double face = 0.8 + random.uniform(0.001, 0.02);
    const Scene alone = rough({rock_at(random.uniform(-30, -10), 0.3, random)});
    Scene beside = alone;
    beside.fixed.classes.push_back({});
    (void)add_fixed_body(beside, box(Vec3(-40, face, -60), Vec3(40, face + 0.1, 60)), 0);
    const auto touches = [&beside, face](const State& state) {
      return face - span_in_y(beside, state, 0)[1] < near_m;
    };
    n_close += steps_as_alone(alone, beside, 100, touches) > 0;
  }
  EXPECT_GT(n_close, 150);
}

TEST(Untouched, StemsBesideTheirPathChangeNothing) {
  Random random(5, "rocks between stems");
  int n_close = 0;
  for (int i = 0; i < 200; ++i) {
    const double gap = random.uniform(0.001, 0.02);
    const Scene alone = rough({rock_at(random.uniform(-30, -10), 0.3, random)});
    Scene beside = alone;
    std::vector<Stem> stems;
    for (int k = 0; k < 60; ++k) {
      Stem stem;
      stem.radius = 0.2;
      stem.foot = Vec3(k - 30, 0.3 + (k % 2 == 0 ? 1 : -1) * (0.7 + gap), waves(k - 30, 0) - 2);
      stem.height = 20;
      stem.capacity = 1e5;
      stem.deflection = 0.4;
      stems.push_back(stem);
    }
    add_forest(beside, stems, {GroundClass{}});
    const auto touches = [&beside, gap](const State& state) {
      const auto [low, high] = span_in_y(beside, state, 0);
      return std::max(high - 0.3, 0.3 - low) > 0.5 + gap - near_m;
    };
    n_close += steps_as_alone(alone, beside, 100, touches) > 0;
  }
  EXPECT_GT(n_close, 150);
}

// A prism rolls past a stack 1 cm beside it.
TEST(Untouched, APrismRollsPastAStackAsAlone) {
  const SlopeFrame frame = slope_frame(10, 0);
  const Body prism = body_of(prism_on(frame, Vec3::Zero(), 24, 0.5, 1));
  const auto cube_at = [&](double down, double up) {
    return body_of(box_in(frame, frame.dip * down + frame.strike * 1.51, Vec3(-0.5, -0.5, up),
                          Vec3(0.5, 0.5, up + 1)));
  };
  const auto scene = [&](const std::vector<Body>& bodies) {
    return scene_of(plane_trn(frame, 5, 50), ground_of(40), bodies, {});
  };
  const Scene alone = scene({prism}),
              beside = scene({prism, cube_at(0, 0), cube_at(0, 1), cube_at(2, 0)});
  EXPECT_GT(steps_as_alone(alone, beside, 400, [](const State&) { return false; }), 100);
}

// A cube hangs at the side of a larger one by a bond across a narrow gap.
TEST(Untouched, WhatIsBondedAcrossAGapIsTouched) {
  const SlopeFrame flat = slope_frame(0, 0);
  constexpr double gap = 5e-5;
  Body large = body_of(box_in(flat, Vec3::Zero(), Vec3(-3, -1.5, 0), Vec3(0, 1.5, 3)));
  Body small = body_of(box_in(flat, Vec3(gap, 0, 1), Vec3(0, -0.5, 0), Vec3(1, 0.5, 1)));
  for (Body* body : {&large, &small}) body->parts[0].face_tag.assign(6, 0);
  Scene scene = scene_of(plane_trn(flat, 1, 30), ground_of(40), {large, small}, {});
  scene.joints.of_set = {ground_of(20)};
  scene.joints.of_set[0].cohesion = scene.joints.of_set[0].tension = 1e7;
  State state = start(scene);
  ASSERT_EQ(state.bonds.size(), 1u);
  Work work = make_work(scene);
  while (state.time < 0.5) step(scene, state, work);
  EXPECT_NEAR(state.motion[1].pose.position.z(), 1.5, 1e-3);
}

// Two prisms that touch by smooth end faces roll side by side as each does alone: slow hits of
// their edges are located in a small island too.
TEST(Untouched, PrismsThatTouchBySmoothFacesRollAsAlone) {
  for (const int n_sides : {24, 64}) {
    const SlopeFrame frame = slope_frame(10, 0);
    const auto prism_at = [&](double y) {
      return body_of(prism_on(frame, y * frame.strike, n_sides, 0.5, 1));
    };
    const auto scene = [&](const std::vector<Body>& bodies) {
      Scene out = scene_of(plane_trn(frame, 5, 50), ground_of(40), bodies, {});
      out.joint = ground_of(0);
      return out;
    };
    const Scene alone = scene({prism_at(0)}), beside = scene({prism_at(0), prism_at(2)});
    State of_alone = start(alone), of_beside = start(beside);
    Work work_alone = make_work(alone), work_beside = make_work(beside);
    for (int i = 0; i < 600; ++i) {
      step(alone, of_alone, work_alone);
      step(beside, of_beside, work_beside);
    }
    const double path = of_alone.motion[0].pose.position.x();
    EXPECT_GT(path, 3);
    for (const Motion& m : of_beside.motion)
      EXPECT_NEAR(m.pose.position.x(), path, 2e-3 * path) << n_sides;
  }
}

}  // namespace
