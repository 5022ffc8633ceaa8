// The solver of one block: falls, friction, mobility.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "solver/newton.hpp"

namespace {

using namespace talus;

// A cube of 1 kg and 1 m on four corners; k_n h tau = 50 kg a corner.
struct CubeOnCorners {
  BlockSystem<6> system;
  std::array<ContactRow, 4> rows;

  explicit CubeOnCorners(double friction) {
    system.mass.setZero();
    system.mass.diagonal() << Vec3::Constant(1), Vec3::Constant(1.0 / 6);
    system.free_velocity.setZero();
    system.tolerance = 1e-12;
    for (std::size_t i = 0; i < 4; ++i) {
      rows[i].normal = Vec3::UnitZ();
      rows[i].arm = Vec3(i % 2 == 0 ? -0.5 : 0.5, i < 2 ? -0.5 : 0.5, -0.5);
      rows[i].normal_damping = rows[i].shear_damping = 50;
      rows[i].friction = friction;
    }
  }
  NewtonResult solve() {
    system.velocity = system.free_velocity;
    return solve_contacts(system, std::span(rows), 50);
  }
  [[nodiscard]] Vec6 impulse() const {
    Vec6 sum = Vec6::Zero();
    for (const ContactRow& row : rows) sum += generalised<6>(row.arm, row.impulse);
    return sum;
  }
};

// m (v - v_free) = -4 D v: v = v_free / (1 + 200).
TEST(SolveContacts, StopsAFallingCubeAsItsDampersDo) {
  CubeOnCorners cube(0.5);
  cube.system.free_velocity[2] = -2.01;
  EXPECT_TRUE(cube.solve().converged);
  EXPECT_NEAR(cube.system.velocity[2], -0.01, 1e-11);
  for (const ContactRow& row : cube.rows) EXPECT_NEAR(row.impulse.z(), 0.5, 1e-10);
}

TEST(SolveContacts, LetsACubeThatRisesGo) {
  CubeOnCorners cube(0.5);
  cube.system.free_velocity[2] = 1;
  EXPECT_TRUE(cube.solve().converged);
  EXPECT_EQ(cube.system.velocity, cube.system.free_velocity);
  for (const ContactRow& row : cube.rows) EXPECT_EQ(row.state, ContactState::open);
}

// A push that friction cannot hold loses tan(phi) of the normal impulse.
TEST(SolveContacts, FrictionTakesItsShareOfTheNormalImpulse) {
  CubeOnCorners cube(0.1);
  cube.system.free_velocity.head<3>() = Vec3(3, 0, -2.01);
  EXPECT_TRUE(cube.solve().converged);
  EXPECT_NEAR(cube.system.velocity[0], 3 - 0.1 * cube.impulse()[2], 1e-10);
  EXPECT_NEAR(cube.impulse()[2], 2, 0.02);
}

TEST(SolveContacts, ImpulsesBalanceTheMomentum) {
  for (const double friction : {0.0, 0.2, 0.8}) {
    CubeOnCorners cube(friction);
    cube.system.free_velocity << 0.7, -0.3, -1.5, 0.4, -0.8, 0.3;
    EXPECT_TRUE(cube.solve().converged);
    const Vec6 change = cube.system.mass * (cube.system.velocity - cube.system.free_velocity);
    EXPECT_LT((change - cube.impulse()).norm(), 1e-11) << friction;
  }
}

// One contact: the mobility along its normal is the velocity that its impulse gives its point.
TEST(Mobility, IsTheVelocityOfThePointPerImpulse) {
  const Vec3 inverse_inertia(1, 2, 3), arm(0.4, -0.7, 0.2), normal = Vec3(1, 2, 2) / 3;
  const Vec3 spin = inverse_inertia.cwiseProduct(arm.cross(normal));
  const double along = normal.dot(0.5 * normal + spin.cross(arm));
  EXPECT_NEAR(mobility(0.5, inverse_inertia, arm, normal).normal, along, 1e-15);
}

}  // namespace
