// Impact of one block on the ground: restitution, resting speed, energy.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/random.hpp"
#include "motion/rotation.hpp"
#include "step/impact.hpp"
#include "step/step.hpp"
#include "verify/cases/cases.hpp"

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
  return apply_impact(scene, 0, 1e-6, {resting_speed, resting_speed}, motion, work);
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

TEST(Impact, LargestShareIsWhereTheEnergyIsKept) {
  EXPECT_NEAR(largest_share(1, 1, -0.75), 0.5, 1e-15);  // f^2 + f = 0.75
  EXPECT_EQ(largest_share(1, 1, 0), 0);
  EXPECT_EQ(largest_share(2, -2, 1), 0.5);  // none: the least of it
  EXPECT_EQ(largest_share(1, -3, 1.9), 1);
}

// Boxes that fall on one corner, turning, with friction: Newton's law with e = 1 would often gain
// energy. They keep theirs, and most of their rebound, whatever their friction.
TEST(Impact, AReboundThatWouldGainEnergyIsLoweredNoFurtherThanItMust) {
  Random random(3, "impacts");
  int n_lowered = 0;
  for (int i = 0; i < 2000; ++i) {
    const auto number = [&random](double low, double high) { return random.uniform(low, high); };
    const Vec3 half(number(0.2, 1), number(0.2, 1), number(0.2, 1));
    const Vec3 axis = Vec3(random.normal(), random.normal(), random.normal()).normalized();
    const Mat3 turn = Eigen::AngleAxisd(number(0, 3), axis).toRotationMatrix();
    Polyhedron shape = moved(box(-half, half), turn, Vec3::Zero());
    const auto lowest =
        std::min_element(shape.vertices.begin(), shape.vertices.end(),
                         [](const Vec3& a, const Vec3& b) { return a.z() < b.z(); });
    const Vec3 corner = *lowest;
    shape = moved(shape, Mat3::Identity(), Vec3::Zero(), Vec3(0.3, 0.2, -corner.z()));
    const Vec3 velocity(number(-5, 5), number(-5, 5), number(-6, -2)),
        spin(number(-4, 4), number(-4, 4), number(-4, 4));
    const double approach = velocity.z() + spin.cross(corner).z();
    if (approach > -0.5) continue;
    const Scene scene = scene_of(plane_trn(slope_frame(0, 0), 5, 50), ground_of(number(20, 50), 1),
                                 {body_of(shape, velocity, spin)}, {});
    Work work = make_work(scene);
    Motion motion = start(scene).motion[0];
    motion.velocity = velocity;
    const Energies before = energies(scene, start(scene));
    const double energy = before.translation + before.rotation;
    const ImpactResult hit = apply_impact(scene, 0, 1e-4, {0.01, 0.01}, motion, work);
    ASSERT_TRUE(hit.hit) << i;
    const Vec3 after =
        motion.velocity +
        angular_velocity(motion.pose.attitude, motion.angular_momentum, scene.blocks.inertia[0])
            .cross(corner);
    EXPECT_GT(hit.dissipated, -1e-7 * energy) << i;
    EXPECT_GT(after.z(), 0.6 * -approach) << i;
    if (after.z() > 0.999 * -approach) continue;
    ++n_lowered;
    EXPECT_LT(hit.dissipated, 1e-6 * energy) << i;
  }
  EXPECT_GT(n_lowered, 20);
}

}  // namespace
