// Resultants of pressure on faces, against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "base/random.hpp"
#include "geometry/face_pressure.hpp"

namespace {

using namespace talus;

constexpr double no_limit = std::numeric_limits<double>::infinity();

// A wall of height h and width b with water up to w: w^2 b / 2, a third of w above its foot.
TEST(FacePressure, IsThatOfWaterAgainstAWall) {
  const std::vector<Vec3> wall{{0, 0, 0}, {0, 3, 0}, {0, 3, 4}, {0, 0, 4}};
  for (const double w : {1.0, 2.5, 4.0, 6.0}) {
    const FacePressure sum = pressure_on(wall, no_limit, [&](const Vec3& x) { return w - x.z(); });
    const double top = std::min(w, 4.0), force = 3 * (w * top - top * top / 2);
    EXPECT_NEAR(sum.force, force, 1e-12) << w;
    const double lever = 3 * (w * top * top / 2 - top * top * top / 3) / force;
    EXPECT_NEAR((sum.centre() - Vec3(0, 1.5, lever)).norm(), 0, 1e-12) << w;
  }
  EXPECT_EQ(pressure_on(wall, no_limit, [](const Vec3& x) { return -1 - x.z(); }).force, 0);
}

// Of any polygon and any linear pressure: the sum over many small pieces of the plane.
TEST(FacePressure, IsTheSumOverSmallPieces) {
  Random random(5);
  for (int trial = 0; trial < 20; ++trial) {
    const int n = 3 + trial % 5;
    const Vec3 u = Vec3(random.normal(), random.normal(), random.normal()).normalized(),
               v = u.unitOrthogonal();
    std::vector<Vec3> polygon;
    for (int k = 0; k < n; ++k) {
      const double angle = 6.283185307179586 * k / n;
      polygon.push_back(Vec3(1, 2, 3) + 2 * std::cos(angle) * u + std::sin(angle) * v);
    }
    const Vec3 gradient(random.normal(), random.normal(), random.normal());
    const auto pressure = [&](const Vec3& x) { return gradient.dot(x - polygon[0] * 0.9); };
    const FacePressure sum = pressure_on(polygon, no_limit, pressure);
    FacePressure pieces;
    constexpr int fine = 400;
    for (int i = 0; i < fine; ++i)
      for (int k = 0; k < fine; ++k) {
        const double a = 2 * (2 * (i + 0.5) / fine - 1), b = 2 * (k + 0.5) / fine - 1;
        const Vec3 x = Vec3(1, 2, 3) + a * u + b * v;
        bool inside = true;
        for (int c = 0; c < n && inside; ++c) {
          const Vec3 &from = polygon[c], &to = polygon[(c + 1) % n];
          inside = u.cross(v).dot((to - from).cross(x - from)) > 0;
        }
        const double p = std::max(0.0, pressure(x));
        if (!inside || p == 0) continue;
        pieces.force += p * 8.0 / (fine * fine);
        pieces.first_moment += p * 8.0 / (fine * fine) * x;
      }
    EXPECT_NEAR(sum.force, pieces.force, 0.01 * (pieces.force + 0.1)) << trial;
    EXPECT_NEAR((sum.first_moment - pieces.first_moment).norm(), 0,
                0.01 * (pieces.first_moment.norm() + 0.4))
        << trial;
  }
}

// The sum of a linear pressure does not depend on the parts of the face; one that is not linear
// comes nearer to the integral of x^2 with each halving.
TEST(FacePressure, SumsPartsAsShortAsAsked) {
  const std::vector<Vec3> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const auto linear = [](const Vec3& x) { return 1 + 2 * x.x() - x.y(); };
  EXPECT_NEAR(pressure_on(square, no_limit, linear).force, pressure_on(square, 0.1, linear).force,
              1e-12);
  double before = 1;
  for (const double resolution : {1.0, 0.5, 0.25, 0.125}) {
    const double error = std::abs(
        pressure_on(square, resolution, [](const Vec3& x) { return x.x() * x.x(); }).force -
        1.0 / 3);
    EXPECT_LT(error, before / 3) << resolution;
    before = error;
  }
}

}  // namespace
