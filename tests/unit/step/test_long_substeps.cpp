// Errors of long substeps against the required accuracy.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "step/step.hpp"
#include "unit/step/rough_scene.hpp"
#include "verify/cases/cases.hpp"
#include "verify/cases/closed_form.hpp"

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

// --- accuracy ----------------------------------------------------------------------------------

CaseSettings with_accuracy(double dt, double accuracy) {
  CaseSettings settings;
  settings.dt = dt;
  settings.accuracy = accuracy;
  return settings;
}

// The error of law talus at long steps is that of [solver] accuracy: closed forms.
TEST(Accuracy, ASmallerOneErrsLess) {
  const auto slab = [](double accuracy) {
    return bouncing_slab(with_accuracy(0.05, accuracy), 0.5).error;
  };
  EXPECT_LT(slab(0.02), slab(1) / 3);
  EXPECT_LT(slab(0.005), slab(0.02) / 3);
  const auto lifted = [](double accuracy) {
    return lifted_slab(with_accuracy(0.02, accuracy)).error;
  };
  EXPECT_LT(lifted(0.005), lifted(0.05) / 10);
  const auto of_5_sides = [](double accuracy) {
    return prism_rolls(with_accuracy(0.05, accuracy), rolling_prisms[2], 2).error;
  };
  EXPECT_LT(of_5_sides(0.00125), of_5_sides(0.005) / 2);
  const auto of_64_sides = [](double accuracy) {
    return prism_rolls(with_accuracy(0.02, accuracy), rolling_prisms[8], 2).error;
  };
  EXPECT_LT(of_64_sides(0.005), of_64_sides(1) / 10);
}

// A cube that slides along a wall's top, and one that slides over the edge of another, 30 m away.
Body wall_at(double y) { return body_of(box(Vec3(-40, y - 2, 0), Vec3(0, y + 2, 4))); }
Body cube_at(double x, double y) {
  return body_of(box(Vec3(x - 0.5, y - 0.5, 4), Vec3(x + 0.5, y + 0.5, 5)), Vec3(3, 0, 0));
}
Scene walls(const std::vector<Body>& bodies, const Settings& settings) {
  Scene scene = scene_of(plane_trn(slope_frame(0, 0), 5, 100), ground_of(60), bodies, settings);
  scene.joint = ground_of(15);
  return scene;
}

/// Substeps and errors of 0.9 s of a scene, and where a corner of its last block is then.
struct Course {
  long substeps = 0, cuts = 0;
  double largest_error = 0;
  Vec3 corner;
};
Course course_of(const Scene& scene) {
  State state = start(scene);
  Work work = make_work(scene);
  Course out;
  while (state.time < 0.9 - scene.settings.dt / 2) {
    const StepReport report = step(scene, state, work);
    out.substeps += report.substeps;
    out.cuts += report.cuts[static_cast<std::size_t>(SubstepCut::inaccurate)];
    out.largest_error = std::max(out.largest_error, report.largest_error);
  }
  const Pose pose = motion_at(scene, state, n_blocks(scene) - 1, state.time).pose;
  out.corner = pose.position + pose.attitude * Vec3(0.5, 0.5, 0.5);
  return out;
}

// Short substeps are made by the island that needs them; the needs of another one cost it nothing.
TEST(Accuracy, AnIslandThatNeedsShortSubstepsGetsThemAlone) {
  const Settings settings = with_accuracy(0.05, 0.005);
  const std::vector<Body> slides = {wall_at(0), cube_at(-20, 0)},
                          tips = {wall_at(30), cube_at(-1.5, 30)};
  const Course alone = course_of(walls(slides, settings)),
               over_edge = course_of(walls(tips, settings)),
               both = course_of(walls({slides[0], slides[1], tips[0], tips[1]}, settings));
  EXPECT_EQ(alone.cuts, 0);
  EXPECT_GT(over_edge.cuts, 0);
  EXPECT_EQ(both.cuts, over_edge.cuts);
  EXPECT_EQ(both.substeps, alone.substeps + over_edge.substeps);
}

// ... and errs less by them; a larger accuracy takes fewer.
TEST(Accuracy, OfAnIslandDecidesItsErrorAndItsSubsteps) {
  const std::vector<Body> tips = {wall_at(0), cube_at(-1.5, 0)};
  const auto at = [&](double dt, double accuracy) {
    return course_of(walls(tips, with_accuracy(dt, accuracy)));
  };
  const Course exact = at(0.001, 0.005), loose = at(0.05, 0.1), usual = at(0.05, 0.005),
               strict = at(0.05, 0.00125);
  const auto error = [&](const Course& of) { return (of.corner - exact.corner).norm(); };
  EXPECT_LT(error(usual), error(loose) / 2);
  EXPECT_LE(error(strict), error(usual));
  EXPECT_LT(loose.substeps, usual.substeps);
  EXPECT_LT(usual.substeps, strict.substeps);
  EXPECT_LE(usual.largest_error, 0.005);
  EXPECT_LE(strict.largest_error, 0.00125);
}

}  // namespace
