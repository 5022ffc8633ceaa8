// Points at one place, against a search of all pairs.
#include <gtest/gtest.h>

#include <cmath>

#include "base/random.hpp"
#include "geometry/repeated_points.hpp"

using namespace talus;

TEST(RepeatedPoints, AreThoseThatAPairwiseSearchFinds) {
  Random random(2);
  std::vector<Vec3> points;
  for (int i = 0; i < 400; ++i)
    points.emplace_back(random.uniform(-1, 1), random.uniform(-1, 1), NAN);
  constexpr double within = 0.05;
  std::vector<int> expected(points.size(), -1);
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = 0; j < i && expected[i] < 0; ++j)
      if (expected[j] < 0 && (points[i] - points[j]).head<2>().norm() <= within)
        expected[i] = static_cast<int>(j);
  EXPECT_EQ(repeated_points(points, within), expected);
  EXPECT_TRUE(repeated_points({}, within).empty());
}

TEST(RepeatedPoints, HeightsCountWhereBothAreKnown) {
  const std::vector<Vec3> points = {
      {5e5, 5e6, 100}, {5e5, 5e6, 101}, {5e5, 5e6, NAN}, {5e5, 5e6, 101}};
  EXPECT_EQ(repeated_points(points, 1e-3), (std::vector<int>{-1, -1, 0, 1}));
}
