// Factor of safety by strength reduction against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <vector>

#include "base/units.hpp"
#include "blocks/limit_equilibrium.hpp"
#include "run/stability.hpp"
#include "scene/joint_water.hpp"
#include "verify/cases/cases.hpp"

namespace {

using namespace talus;
using namespace talus::cases;

constexpr double water_weight = 1e4;  // [N/m3]

Scene box_on_slope(double dip_deg, double friction_deg, double cohesion = 0) {
  GroundClass ground = ground_of(friction_deg);
  ground.cohesion = cohesion;
  const SlopeFrame frame = slope_frame(dip_deg, 20);
  return scene_of(plane_trn(frame, 1, 30), ground,
                  {body_of(box_in(frame, Vec3::Zero(), Vec3(-3, -2, 0), Vec3(3, 2, 1.5)))}, {});
}

// tan(phi) / tan(dip), and with cohesion c A / (W sin(dip)) on top.
TEST(Stability, ABlockOnAPlaneHasItsFactor) {
  for (const double friction : {25.0, 40.0}) {
    const double dip = 33 * degree, weight = 2500 * 10 * 24 * 1.5;
    for (const double cohesion : {0.0, 8e3}) {
      const Stability found = find_stability(box_on_slope(33, friction, cohesion), {});
      const double exact =
          std::tan(friction * degree) / std::tan(dip) + cohesion * 24 / (weight * std::sin(dip));
      EXPECT_NEAR(found.mass.value() / exact, 1, 0.01) << friction << " " << cohesion;
      EXPECT_LE(found.mass.moves - found.mass.holds, 0.01);
      EXPECT_EQ(found.first.moves, found.mass.moves);
      EXPECT_EQ(found.of_block[0], found.mass.moves);
    }
  }
}

// The head of a level of water below the mass takes its uplift off the normal force.
TEST(Stability, WaterLowersIt) {
  const double dip = 33 * degree, weight = 2500 * 10 * 24 * 1.5;
  for (const double depth : {1.0, 0.5}) {
    Scene scene = box_on_slope(33, 40);
    scene.ground.trn.elevation = plane_trn(slope_frame(33, 20), 1, 30).elevation;
    JointWater water;
    water.unit_weight = water_weight;
    water.surface = scene.ground.trn.elevation;
    for (double& z : water.surface) z += depth;
    add_joint_water(water, scene);
    scene.drained_at = 1e-6;  // not while the factor is looked for
    const double uplift = water_weight * depth * 24;
    const double exact =
        (weight * std::cos(dip) - uplift) * std::tan(40 * degree) / (weight * std::sin(dip));
    EXPECT_NEAR(find_stability(scene, {}).mass.value() / exact, 1, 0.01) << depth;
  }
}

TEST(Stability, HardlyDependsOnDurationAndStep) {
  Scene scene = box_on_slope(33, 40, 4e3);
  const double value = find_stability(scene, {}).mass.value();
  StabilitySettings longer;
  longer.duration = 2;
  EXPECT_NEAR(find_stability(scene, longer).mass.value(), value, 0.01);
  scene.settings.dt /= 2;
  EXPECT_NEAR(find_stability(scene, {}).mass.value(), value, 0.01);
}

// A pulse of base motion that a factor of 1.3 does not resist lets the block slip and come to rest:
// friction holds as much afterwards as before, while a bond that it breaks is gone. Newmark: a
// pulse of acceleration a for a time t above the resistance r slips by a (a / r - 1) t^2 / 2.
TEST(Stability, ShakingThatEndsLeavesFrictionAndTakesBonds) {
  const double dip = 25 * degree, g = 10, pulse = 6, length = 0.2;
  Scene scene = box_on_slope(25, 35);
  scene.base.harmonic = {Vec3::Zero(), 1, 0, 0};
  const SlopeFrame frame = slope_frame(25, 20);
  // up the slope and level with it, so that the normal force stays
  scene.base.time = {0, 0.1, 0.1 + 1e-9, 0.1 + length, 0.1 + length + 1e-9, 5};
  const Vec3 a = -pulse * frame.dip;
  scene.base.acceleration = {Vec3::Zero(), Vec3::Zero(), a, a, Vec3::Zero(), Vec3::Zero()};
  const double still = std::tan(35 * degree) / std::tan(dip);
  const Stability shaken = find_stability(scene, {});
  EXPECT_NEAR(shaken.mass.value() / still, 1, 0.01);
  const double resists = g * (std::cos(dip) * std::tan(35 * degree) - std::sin(dip));
  const double slip = pulse * (pulse / resists - 1) * length * length / 2;
  EXPECT_NEAR(run_reduced(scene, 1, {}).displacement / slip, 1, 0.03);

  Scene bonded = box_on_slope(25, 20, 8e3);
  const double with_bond = find_stability(bonded, {}).mass.value();
  ASSERT_GT(with_bond, 1.1);
  bonded.base = scene.base;
  for (Vec3& base : bonded.base.acceleration) base *= 3;
  EXPECT_LT(find_stability(bonded, {}).mass.value(), 1.01 * std::tan(20 * degree) / std::tan(dip));
}

// Rough ground before it stops what slides before the earthquake ends: it has moved all the same.
TEST(Stability, ShakingMakesNothingSafer) {
  const SlopeFrame frame = slope_frame(33, 0);
  Scene scene =
      scene_of(plane_trn(frame, 1, 30), ground_of(25),
               {body_of(box_in(frame, Vec3::Zero(), Vec3(-3, -8, 0), Vec3(3, 8, 1.5)))}, {});
  scene.ground.classes.push_back(ground_of(70));
  const Trn& trn = scene.ground.trn;
  for (int row = 0; row + 1 < trn.n_rows; ++row)
    for (int col = 0; col + 1 < trn.n_cols; ++col)
      scene.ground.cell_class.push_back(node_point(trn, row, col).x() >= 4 ? 1 : 0);
  const double still = find_stability(scene, {}).mass.value();
  EXPECT_NEAR(still / (std::tan(25 * degree) / std::tan(33 * degree)), 1, 0.01);
  scene.base.time = {0, 1, 5};
  scene.base.acceleration = {Vec3::Zero(), Vec3(0.1, 0, 0), Vec3::Zero()};
  const ReducedRun run = run_reduced(scene, 1, {});
  EXPECT_LT(run.displacement, 5);  // and comes to rest less than its size away
  EXPECT_EQ(run.moved_share, 1);
  EXPECT_LE(find_stability(scene, {}).mass.value(), still + 0.005);
}

// Two blocks apart on one slope, one with less friction on its own part of it: it goes first, the
// other one, the larger, is the mass.
TEST(Stability, SaysWhichBlocksGoFirst) {
  const SlopeFrame frame = slope_frame(30, 0);
  Scene scene = scene_of(plane_trn(frame, 1, 30), ground_of(40),
                         {body_of(box_in(frame, Vec3(0, -10, 0), Vec3(-1, -1, 0), Vec3(1, 1, 1))),
                          body_of(box_in(frame, Vec3(0, 10, 0), Vec3(-3, -2, 0), Vec3(3, 2, 1.5)))},
                         {});
  scene.ground.classes.push_back(ground_of(30));
  const Trn& trn = scene.ground.trn;
  for (int row = 0; row + 1 < trn.n_rows; ++row)
    for (int col = 0; col + 1 < trn.n_cols; ++col)
      scene.ground.cell_class.push_back(node_point(trn, row, col).y() < 0 ? 1 : 0);
  const Stability found = find_stability(scene, {});
  EXPECT_NEAR(found.first.value(), 1, 0.01);
  EXPECT_NEAR(found.mass.value(), std::tan(40 * degree) / std::tan(30 * degree), 0.02);
  EXPECT_LT(found.of_block[0], found.of_block[1]);
}

Scene columns_on_slope(const std::vector<double>& heights) {
  const SlopeFrame frame = slope_frame(20, 0);
  std::vector<Body> columns;
  for (size_t n = 0; n < heights.size(); ++n) {
    const auto rear = -static_cast<double>(n + 1);
    columns.push_back(
        body_of(box_in(frame, Vec3::Zero(), Vec3(rear, -1, 0), Vec3(rear + 1, 1, heights[n]))));
  }
  return scene_of(plane_trn(frame, 1, 30), ground_of(40), columns, {});
}

// Columns of 1 m on a plane of 20 degrees: the upper ones topple, the lowest one slides. Where more
// than one topples, the formula has them meet at their tops alone. They turn alike, press on each
// other lower down too, and hold better.
TEST(Stability, ARowOfColumnsHasTheFactorOfGoodmanAndBray) {
  const std::vector<std::vector<double>> rows = {
      {0.8, 3.2}, {0.8, 3.6}, {1, 3.4}, {0.8, 2.5, 3.3}, {0.8, 3, 3.2}, {0.6, 2.9, 2.9, 2.9}};
  for (const std::vector<double>& heights : rows) {
    const double exact = toppling_factor({20 * degree, 1, 0, heights}, std::tan(40 * degree));
    const double found = find_stability(columns_on_slope(heights), {}).mass.value();
    std::cout << heights.size() << " columns: " << found / exact << " of the formula's factor\n";
    EXPECT_GT(found / exact, 0.99) << heights.size();
    EXPECT_LT(found / exact, heights.size() == 2 ? 1.01 : 1.6) << heights.size();
  }
}

// A block that falls into a gap and stops there does not move; one that slides without strength has
// no factor.
TEST(Stability, WhatSettlesDoesNotMove) {
  const Scene gap = scene_of(plane_trn(slope_frame(0, 0), 1, 10), ground_of(30),
                             {body_of(box(Vec3(-1, -1, 0.02), Vec3(1, 1, 1.02)))}, {});
  const Stability found = find_stability(gap, {});
  EXPECT_EQ(found.mass.holds, 16);
  EXPECT_TRUE(std::isinf(found.mass.moves));
  const Stability smooth = find_stability(box_on_slope(30, 0), {});
  EXPECT_EQ(smooth.mass.holds, 0);
}

}  // namespace
