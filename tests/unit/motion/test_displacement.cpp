// Displacement, mass and elastic matrices against their integrals.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "base/random.hpp"
#include "geometry/polyhedron.hpp"
#include "motion/displacement.hpp"

namespace {

using talus::Mat12;
using talus::Mat3;
using talus::Vec12;
using talus::Vec3;

// Theory 1.1: rotations are right-handed, u = u0 + r x xi + eps xi with eps_xy = g_xy / 2.
TEST(DisplacementMatrix, IsTranslationRotationAndStrain) {
  const Vec3 xi(0.3, -1.2, 2.5), u0(1, 2, 3), r(0.1, -0.2, 0.3);
  Vec12 D;
  D << u0, r, 0.01, 0.02, 0.03, 0.04, 0.05, 0.06;
  Mat3 eps;
  eps << 0.01, 0.03, 0.025, 0.03, 0.02, 0.02, 0.025, 0.02, 0.03;
  const Vec3 expected = u0 + r.cross(xi) + eps * xi;
  EXPECT_LT((talus::displacement_matrix(xi) * D - expected).norm(), 1e-15);
}

TEST(StrainLoad, IsTheStrainPartOfTTransposed) {
  const Vec3 xi(0.3, -1.2, 2.5), f(4, -5, 6);
  const Vec12 full = talus::displacement_matrix(xi).transpose() * f;
  EXPECT_LT((full.tail<6>() - talus::strain_load(xi, f)).norm(), 1e-15);
}

// The closed form against the integral of rho T^T T over a tetrahedron by an exact quadrature:
// T is linear, so the 4-point rule of degree 2 integrates T^T T without error.
TEST(MassMatrix, IsTheIntegralOverABlock) {
  talus::Random random(7, "mass");
  const Vec3 corner[4] = {{0, 0, 0}, {2, 0.3, 0.1}, {0.2, 3, -0.4}, {0.5, 0.6, 1.7}};
  const Vec3 centroid = (corner[0] + corner[1] + corner[2] + corner[3]) / 4;
  const double volume =
      (corner[1] - corner[0]).dot((corner[2] - corner[0]).cross(corner[3] - corner[0])) / 6;
  const double a = 0.5854101966249685, b = 0.1381966011250105, density = 2500;
  Mat3 S = Mat3::Zero();
  Mat12 expected = Mat12::Zero();
  for (int i = 0; i < 4; ++i) {
    Vec3 xi = -centroid;
    for (int j = 0; j < 4; ++j) xi += (i == j ? a : b) * corner[j];
    S += volume / 4 * xi * xi.transpose();
    const auto T = talus::displacement_matrix(xi);
    expected += density * volume / 4 * T.transpose() * T;
  }
  const Mat12 M = talus::mass_matrix(density, volume, S);
  EXPECT_LT((M - expected).norm() / expected.norm(), 3e-16 * 12);
  EXPECT_EQ(M, M.transpose());
}

TEST(ElasticMatrix, GivesYoungsModulusInUniaxialStress) {
  const auto C = talus::elastic_matrix(5e10, 0.25);
  Eigen::Matrix<double, 6, 1> strain;
  strain << 1e-5, -0.25e-5, -0.25e-5, 0, 0, 0;
  const Eigen::Matrix<double, 6, 1> stress = C * strain;
  EXPECT_NEAR(stress[0], 5e5, 1e-6);
  EXPECT_NEAR(stress.tail<5>().norm(), 0, 1e-6);
}

}  // namespace
