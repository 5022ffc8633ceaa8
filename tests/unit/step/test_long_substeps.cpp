#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "step/step.hpp"
#include "unit/step/rough_scene.hpp"
#include "verify/cases/cases.hpp"

namespace {

using namespace talus;
using namespace talus::cases;

// Two planes that meet at x = 40: a cube slides down the first one in a few long substeps, and in
// short ones where it may meet the other.
TEST(Step, SlidesFarInASubstepOnlyWhileThereIsOnePlaneAhead) {
  const auto bend = [](double x, double) { return -0.4 * std::min(x, 40.0) - 0.1 * x; };
  const SlopeFrame frame = slope_frame(180 / std::numbers::pi * std::atan(0.5), 0);
  const auto slide = [&](double dt, const auto& each_step) {
    Settings settings;
    settings.dt = dt;
    const Body cube = body_of(box_in(frame, Vec3::Zero(), Vec3(-0.5, -0.5, 0), Vec3(0.5, 0.5, 1)));
    const Scene scene = scene_of(make_trn(bend, 1, 100), ground_of(10, 0), {cube}, settings);
    State state = start(scene);
    Work work = make_work(scene);
    while (state.time < 6 - dt / 2) {
      const Vec3 from = motion_at(scene, state, 0, state.time).pose.position;
      const StepReport report = step(scene, state, work);
      each_step(from.x(), motion_at(scene, state, 0, state.time), report.substeps);
    }
    return motion_at(scene, state, 0, state.time);
  };
  int long_steps = 0, short_steps = 0;
  const Motion coarse = slide(0.2, [&](double from, const Motion& m, int substeps) {
    const double way = m.velocity.norm() * 0.2;
    if (way > 1 && m.pose.position.x() < 34) {
      ++long_steps;
      EXPECT_EQ(substeps, 1);
    } else if (from > 37 && from < 40) {
      ++short_steps;
      EXPECT_GE(substeps, way / 0.55);
    }
  });
  EXPECT_GT(long_steps, 5);
  EXPECT_GT(short_steps, 0);
  const Motion fine = slide(0.005, [](double, const Motion&, int) {});
  EXPECT_GT(fine.pose.position.x(), 43);
  EXPECT_LT((coarse.pose.position - fine.pose.position).norm(), 0.05);
}

// How far a load or a shaken base takes a block in the meantime is not bounded by gravity.
TEST(Step, SlidesFarInASubstepOnlyUnderGravityAlone) {
  const SlopeFrame frame = slope_frame(25, 0);
  const auto substeps = [&](double share_of_weight) {
    Settings settings;
    settings.dt = 0.2;
    const Body cube = body_of(box_in(frame, Vec3::Zero(), Vec3(-0.5, -0.5, 0), Vec3(0.5, 0.5, 1)),
                              10 * frame.dip);
    Scene scene = scene_of(plane_trn(frame, 1, 120), ground_of(10, 0), {cube}, settings);
    if (share_of_weight > 0)
      scene.loads = {{0, Vec3::Zero(), share_of_weight * scene.blocks.mass[0] * 10 * frame.dip}};
    State state = start(scene);
    Work work = make_work(scene);
    step(scene, state, work);
    return step(scene, state, work).substeps;
  };
  EXPECT_EQ(substeps(0), 1);
  EXPECT_GE(substeps(1e-3), 4);
}

// The same on one plane that is rougher beyond x = 40: the block feels that where it comes there.
TEST(Step, SlidesFarInASubstepOnlyOverGroundOfOneKind) {
  const SlopeFrame frame = slope_frame(25, 0);
  const auto slide = [&](double dt) {
    Settings settings;
    settings.dt = dt;
    const Body cube = body_of(box_in(frame, Vec3::Zero(), Vec3(-0.5, -0.5, 0), Vec3(0.5, 0.5, 1)));
    Scene scene = scene_of(plane_trn(frame, 1, 120), ground_of(10, 0), {cube}, settings);
    scene.ground.classes.push_back(ground_of(35, 0));
    const Trn& trn = scene.ground.trn;
    for (int row = 0; row < trn.n_rows - 1; ++row)
      for (int col = 0; col < trn.n_cols - 1; ++col)
        scene.ground.cell_class.push_back(trn.node0.x() + col * trn.cell_size >= 40);
    State state = start(scene);
    Work work = make_work(scene);
    while (state.time < 8 - dt / 2) step(scene, state, work);
    return motion_at(scene, state, 0, state.time);
  };
  const Motion coarse = slide(0.2), fine = slide(0.005);
  EXPECT_GT(fine.pose.position.x(), 60);
  EXPECT_NEAR(coarse.pose.position.x(), fine.pose.position.x(), 0.3);
  EXPECT_NEAR(coarse.velocity.norm(), fine.velocity.norm(), 0.15);
}

}  // namespace
