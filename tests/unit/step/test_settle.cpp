// Static start of blocks, with and without strains.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "motion/rotation.hpp"
#include "step/step.hpp"
#include "verify/cases/cases.hpp"
#include "verify/cases/closed_form.hpp"

namespace {

using namespace talus;
using namespace talus::cases;

// Its vertices rest on the ground while its centroid sinks: they are not about to hit it.
TEST(Step, BlockThatSagsIsNotHitByTheGroundThatCarriesIt) {
  Material soft;
  soft.young = 1e7;
  Settings settings;
  settings.strains = true;
  settings.static_start = false;  // which would begin it sagged
  const SlopeFrame frame = slope_frame(30, 37);
  const Body cube = body_of(box_in(frame, Vec3::Zero(), Vec3(-2, -2, 0), Vec3(2, 2, 4)));
  const Scene scene =
      scene_of(plane_trn(frame, 2, 100), ground_of(20, 0.3), {cube}, settings, soft);
  State state = start(scene);
  Work work = make_work(scene);
  double deepest = 0, strained = 0;
  for (int i = 0; i < 200; ++i) {
    deepest = std::max(deepest, step(scene, state, work).largest_penetration);
    strained = std::max(strained, state.strain[0].norm());
  }
  EXPECT_GT(strained, 5e-3);
  EXPECT_EQ(state.counters.substeps, 200);
  EXPECT_EQ(state.counters.impacts, 0);
  EXPECT_LT(deepest, 1e-5);
}

// At rest or sliding off, a block begins with the strains that its contacts and its weight give it:
// nothing of it swings, whatever its stiffness and the step. (Soft, and within a tenth of a degree
// of the friction that would hold it, it does not find its equilibrium.)
TEST(Step, BlockThatStrainsBeginsInEquilibrium) {
  const SlopeFrame frame = slope_frame(30, 37);
  const Body cube = body_of(box_in(frame, Vec3::Zero(), Vec3(-0.5, -0.5, 0), Vec3(0.5, 0.5, 1)));
  const std::pair<double, double> young_and_friction[] = {
      {1e7, 20}, {1e8, 29.9}, {5e10, 20}, {5e10, 29.9}, {5e10, 30.1}};
  for (const auto& [young, friction] : young_and_friction)
    for (const double dt : {1e-3, 5e-3, 2e-2}) {
      Material material;
      material.young = young;
      Settings settings;
      settings.strains = true;
      settings.sleep = false;
      settings.dt = dt;
      const Scene scene =
          scene_of(plane_trn(frame, 0.5, 10), ground_of(friction), {cube}, settings, material);
      State state = start(scene);
      Work work = make_work(scene);
      const Vec6 begin = state.strain[0];
      const double by_weight = 2500 * 10.0 / 2 / young;
      EXPECT_GT(begin.norm(), by_weight / 2);
      for (int i = 0; i < 40; ++i) (void)step(scene, state, work);
      EXPECT_LT((state.strain[0] - begin).norm(), 1e-4 * by_weight)
          << young << " Pa, " << friction << " degrees, " << dt << " s";
      const double tangent = std::tan(friction * std::numbers::pi / 180);
      const double speed = 10 * std::max(0.0, 0.5 - tangent * std::sqrt(0.75)) * state.time;
      EXPECT_NEAR(state.motion[0].velocity.norm(), speed, 1e-3 * speed + 1e-12)
          << young << " Pa, " << friction << " degrees, " << dt << " s";
    }
}

// Blocks that may touch a neighbour are computed rigid where they do, and have no strains until
// they are seen to be alone.
TEST(Step, BlocksThatMayMeetBeginWithoutStrains) {
  const SlopeFrame frame = slope_frame(0, 0);
  std::vector<Body> cubes;
  for (const double x : {-5.0, 5.0})
    cubes.push_back(
        body_of(box_in(frame, Vec3::Zero(), Vec3(x - 0.5, -0.5, 0), Vec3(x + 0.5, 0.5, 1))));
  Settings settings;
  settings.strains = true;
  for (const bool meet : {false, true}) {
    settings.block_contacts = meet;
    const State state = start(scene_of(plane_trn(frame, 0.5, 10), ground_of(30), cubes, settings));
    for (const Vec6& strain : state.strain) EXPECT_EQ(strain.isZero(0), meet);
  }
}

// Near its critical friction a block that strains slips at some corners for a moment. With the slip
// of its straining in the direction that friction has, one run in seven took thousands of passes.
TEST(Step, BlockThatStrainsAndAllButSticksSettlesInFewPasses) {
  Settings settings;
  settings.strains = true;
  settings.sleep = settings.static_start = false;
  const SlopeFrame frame = slope_frame(30, 37);
  const Body cube = body_of(box_in(frame, Vec3::Zero(), Vec3(-0.5, -0.5, 0), Vec3(0.5, 0.5, 1)));
  for (double friction_deg = 29.8; friction_deg < 30.5; friction_deg += 0.02) {
    const Scene scene =
        scene_of(plane_trn(frame, 0.5, 20), ground_of(friction_deg), {cube}, settings);
    State state = start(scene);
    Work work = make_work(scene);
    for (int i = 0; i < 60; ++i) step(scene, state, work);
    EXPECT_LT(state.counters.passes, 60 * 8) << friction_deg;
    EXPECT_EQ(state.counters.cut_back, 0) << friction_deg;
  }
}

}  // namespace
