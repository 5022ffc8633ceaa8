// Failure wedges: closed forms and refusals.
#include <gtest/gtest.h>

#include <cmath>

#include "blocks/failure_wedge.hpp"
#include "scenes.hpp"

namespace {

using namespace talus;
using namespace talus::test;

// 60 degrees down to the south.
Trn even_slope(double cell) {
  const int n = static_cast<int>(120 / cell) + 1;
  return grid(n, n, cell, [](double, double y) { return std::tan(60 * degree) * y; });
}

Area rectangle(double x0, double y0, double x1, double y1) {
  return {{{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}}};
}

const std::vector<JointSet> flanks = {joint_set(60, 130, 4, "east"), joint_set(60, 230, 4, "west")};

}  // namespace

// Two flanks of the same dip over a level foot. The line lies so deep that a tenth of the foot is
// blocked; the mass is a pyramid with its tip cut off there.
TEST(FailureWedge, OfTwoEvenFlanksHasItsClosedForm) {
  const double across = std::tan(60 * degree) * std::sin(50 * degree);
  const double along = std::tan(60 * degree) * (1 - std::cos(50 * degree));
  const double length = 30, half_width = 17;
  const double tip = (1 - least_free_foot) * half_width * across;
  const double exact =
      (std::pow(along * length + tip, 3) - std::pow(tip, 3)) / (3 * along * across);
  ASSERT_LT((along * length + tip) / across, half_width);  // the sides cut nothing off
  for (const double cell : {2.0, 1.0}) {
    const auto wedges = find_failure_wedges(
        even_slope(cell), rectangle(60 - half_width, 40, 60 + half_width, 40 + length), flanks,
        30 * degree, {});
    ASSERT_EQ(wedges.size(), 1u);
    ASSERT_EQ(wedges[0].why_not, "");
    EXPECT_NEAR(wedges[0].line.trend / degree, 180, 1e-9);
    EXPECT_NEAR(wedges[0].line.factor, 0.6930475, 5e-8);
    EXPECT_GE(wedges[0].free_share, least_free_foot - 1e-9);
    EXPECT_NEAR(wedges[0].volume / exact, 1, 0.05 * cell);
  }
}

TEST(FailureWedge, BedIsTheHigherOfItsPlanes) {
  const Trn ground = even_slope(2);
  const Area area = rectangle(30, 40, 90, 80);
  const auto wedges = find_failure_wedges(ground, area, flanks, 30 * degree, {});
  ASSERT_EQ(wedges[0].why_not, "");
  const SourceMass mass = find_source(ground, area, source_on_wedge(wedges[0]), {});
  EXPECT_NEAR(mass.volume, wedges[0].volume, 1e-9 * mass.volume);
  const auto height = [](const Attitude& plane, const Vec3& point, const Vec3& at) {
    const Vec3 n = pole(plane.dip, plane.dip_direction);
    return point.z() - n.head<2>().dot((at - point).head<2>()) / n.z();
  };
  for (const int node : mass.nodes) {
    const Vec3 at = node_point(ground, node / ground.n_cols, node % ground.n_cols);
    const double higher = std::max(height(wedges[0].first_plane, wedges[0].first_point, at),
                                   height(wedges[0].second_plane, wedges[0].second_point, at));
    EXPECT_NEAR(mass.bed.elevation[node], higher, 1e-9);
  }
}

TEST(FailureWedge, EachPairThatCannotGoSaysWhy) {
  const std::vector<JointSet> sets = {joint_set(60, 130, 4, "east"), joint_set(60, 230, 4, "west"),
                                      joint_set(60, 130, 4, "again"), joint_set(40, 0, 4, "into"),
                                      joint_set(80, 180, 4, "steep")};
  const auto wedges =
      find_failure_wedges(even_slope(2), rectangle(30, 40, 90, 80), sets, 30 * degree, {});
  const auto why = [&](const std::string& pair) {
    for (const FailureWedge& wedge : wedges)
      if (pair_name(wedge) == pair) return wedge.why_not;
    return std::string("no such pair");
  };
  EXPECT_EQ(why("east + again"), "are parallel");
  EXPECT_EQ(why("east + west"), "");
  EXPECT_NE(why("east + into").find("dips"), std::string::npos) << why("east + into");
  const int best = best_wedge(wedges, "west + east");
  ASSERT_GE(best, 0);
  EXPECT_EQ(pair_name(wedges[best]), "east + west");
  EXPECT_EQ(best_wedge(wedges, "east + into"), -1);
  const auto rough =
      find_failure_wedges(even_slope(2), rectangle(30, 40, 90, 80), flanks, 50 * degree, {});
  EXPECT_NE(rough[0].why_not.find("factor of safety is"), std::string::npos) << rough[0].why_not;
}
