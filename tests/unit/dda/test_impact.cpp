#include <gtest/gtest.h>

#include "dda/impact.hpp"
#include "dda/step.hpp"
#include "verify/cases.hpp"

namespace {

using namespace talus;
using namespace talus::cases;

// A cube of 1 m that touches a level ground with its lower face.
Scene cube_on_ground(double friction_deg, double restitution) {
  return scene_of(plane_trn(slope_frame(0, 0), 1, 10), ground_of(friction_deg, restitution),
                  {body_of(box(Vec3(-0.5, -0.5, 0), Vec3(0.5, 0.5, 1)))}, {});
}

ImpactResult hit(const Scene& scene, double resting_speed, Motion& motion) {
  Work work = make_work(scene);
  return apply_impact(scene, 0, 1e-6, resting_speed, motion, work);
}

TEST(Impact, AFaceReboundsByTheRestitution) {
  for (const double e : {0.0, 0.5, 1.0}) {
    const Scene scene = cube_on_ground(30, e);
    Motion motion = start(scene).motion[0];
    motion.velocity = Vec3(0, 0, -3);
    const ImpactResult result = hit(scene, 0.1, motion);
    EXPECT_TRUE(result.hit && result.converged);
    EXPECT_NEAR(motion.velocity.z(), 3 * e, 1e-9);
    EXPECT_LT(motion.angular_momentum.norm(), 1e-6 * scene.blocks.mass[0]);
    EXPECT_NEAR(result.dissipated, 4.5 * (1 - e * e) * scene.blocks.mass[0],
                1e-7 * scene.blocks.mass[0]);
  }
}

TEST(Impact, BelowTheRestingSpeedNothingIsHit) {
  const Scene scene = cube_on_ground(30, 0.5);
  Motion motion = start(scene).motion[0];
  motion.velocity = Vec3(0, 0, -0.09);
  const Motion before = motion;
  EXPECT_FALSE(hit(scene, 0.1, motion).hit);
  EXPECT_EQ(motion.velocity, before.velocity);
}

// Whatever the friction, an impact adds no energy.
TEST(Impact, NeverGainsEnergy) {
  for (const double friction_deg : {0.0, 20.0, 50.0})
    for (const double e : {0.0, 0.7, 1.0}) {
      const Scene scene = cube_on_ground(friction_deg, e);
      Motion motion = start(scene).motion[0];
      motion.velocity = Vec3(4, 1, -3);
      motion.angular_momentum = scene.blocks.inertia[0].cwiseProduct(Vec3(3, -5, 2));
      EXPECT_GE(hit(scene, 0.1, motion).dissipated, 0) << friction_deg << ", " << e;
    }
}

}  // namespace
