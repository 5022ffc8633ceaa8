#include <gtest/gtest.h>

#include <cmath>

#include "base/units.hpp"
#include "step/step.hpp"
#include "verify/cases/case_run.hpp"
#include "verify/cases/cases.hpp"

namespace {

using namespace talus;
using namespace talus::cases;

constexpr double g = 10, density = 2500, jrc = 8, jcs = 50e6;

GroundClass rough(double residual_deg) {
  GroundClass made = ground_of(residual_deg);
  made.roughness = jrc * degree;
  made.wall_strength = jcs;
  made.residual = residual_deg * degree;
  return made;
}

// Angle of friction at the stress of a height of rock on a slope, as printed [deg].
double barton_deg(double residual_deg, double height, double slope_deg) {
  const double stress = density * g * height * std::cos(slope_deg * degree);
  return residual_deg + jrc * std::log10(jcs / stress);
}

/// On a slope: a box of 40 x 10 m, so high.
Scene box_on_slope(double slope_deg, double height, const GroundClass& ground) {
  const SlopeFrame frame = slope_frame(slope_deg, 0);
  return scene_of(plane_trn(frame, 2, 60), ground,
                  {body_of(box_in(frame, Vec3::Zero(), Vec3(-20, -5, 0), Vec3(20, 5, height)))},
                  {});
}

/// On a box that friction holds, another one of 8 x 6 m; what is a slope is gravity that is turned.
Scene box_on_box(double slope_deg, double height, const GroundClass& joint) {
  Scene scene = scene_of(plane_trn(slope_frame(0, 0), 2, 60), ground_of(80),
                         {body_of(box(Vec3(-15, -6, 0), Vec3(15, 6, 4))),
                          body_of(box(Vec3(-4, -3, 4), Vec3(4, 3, 4 + height)))},
                         {});
  scene.joint = joint;
  scene.gravity = g * Vec3(std::sin(slope_deg * degree), 0, -std::cos(slope_deg * degree));
  return scene;
}

Vec3 velocity_after(const Scene& scene, double time, size_t b) {
  State state = start(scene);
  Work work = make_work(scene);
  while (state.time < time - 1e-9) step(scene, state, work);
  return state.motion[b].velocity;
}

// At the same residual angle the low block holds and the high one slides: each at its own stress.
TEST(RoughJoint, HoldsToTheAngleOfBartonAndBandisAtItsStress) {
  const double slope = 45;
  for (const double height : {2.0, 16.0}) {
    const double limit = slope - barton_deg(0, height, slope);
    EXPECT_NEAR(limit, height == 2 ? 19.80 : 27.02, 0.01);
    for (const double off : {-0.3, 0.3}) {
      const bool slides = off < 0;
      const Vec3 v = velocity_after(box_on_slope(slope, height, rough(limit + off)), 0.5, 0);
      EXPECT_EQ(v.norm() > 0.01, slides) << height << " " << off << " " << v.norm();
    }
  }
}

TEST(RoughJoint, BetweenBlocksHoldsToTheSameAngle) {
  const double slope = 40;
  for (const double height : {0.5, 4.0}) {
    const double limit = slope - barton_deg(0, height, slope);
    for (const double off : {-0.3, 0.3}) {
      const Vec3 v = velocity_after(box_on_box(slope, height, rough(limit + off)), 0.5, 1);
      EXPECT_EQ(v.norm() > 0.01, off < 0) << height << " " << off << " " << v.norm();
    }
  }
}

// What friction leaves accelerates it; the energies of motion, height and friction add up.
TEST(RoughJoint, SlidesAsItsFrictionLets) {
  const double slope = 45, height = 3, time = 0.5;
  const double tangent = std::tan(barton_deg(15, height, slope) * degree);
  const double a = g * (std::sin(slope * degree) - tangent * std::cos(slope * degree));
  ASSERT_GT(a, 0.5);
  EXPECT_NEAR(velocity_after(box_on_slope(slope, height, rough(15)), time, 0).norm() / (a * time),
              1, 5e-3);
  for (const bool on_box : {false, true}) {
    const Scene scene =
        on_box ? box_on_box(slope, height, rough(15)) : box_on_slope(slope, height, rough(15));
    State state = start(scene);
    Work work = make_work(scene);
    const auto mechanical = [&] {
      const Energies e = energies(scene, state);
      return e.translation + e.rotation + e.potential;
    };
    const double before = mechanical();
    while (state.time < time - 1e-9) step(scene, state, work);
    const double lost = before - mechanical();
    ASSERT_GT(lost, 0);
    EXPECT_NEAR(state.ledger.friction / lost, 1, 0.01) << on_box;
  }
}

// On an edge the wall is crushed: what is left is the residual angle.
TEST(RoughFriction, EndsAtTheResidualAngleAndAtSeventyDegrees) {
  const GroundClass joint = rough(28);
  EXPECT_EQ(rough_friction(joint, jcs), joint.friction);
  EXPECT_EQ(rough_friction(joint, 1e12), joint.friction);
  EXPECT_NEAR(rough_friction(joint, jcs / 100), std::tan(44 * degree), 1e-12);
  EXPECT_NEAR(rough_friction(joint, 0), std::tan(70 * degree), 1e-12);
  GroundClass reduced = joint;
  reduced.friction /= 1.5;
  EXPECT_NEAR(rough_friction(reduced, jcs / 100), std::tan(44 * degree) / 1.5, 1e-12);
}

}  // namespace
