#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "base/error.hpp"
#include "blocks/source.hpp"
#include "scenes.hpp"

namespace {

using namespace talus;
using namespace talus::test;

Area rectangle(double x0, double y0, double x1, double y1) {
  return {{{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}}};
}

std::string refusal(const std::function<void()>& work) {
  try {
    work();
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace

TEST(Area, HolesAndBordersCount) {
  Area area = rectangle(0, 0, 10, 10);
  area.rings.push_back({{4, 4}, {6, 4}, {6, 6}, {4, 6}});
  EXPECT_DOUBLE_EQ(area_of(area), 96);
  EXPECT_TRUE(contains(area, {1, 1}));
  EXPECT_TRUE(contains(area, {10, 5}));
  EXPECT_FALSE(contains(area, {5, 5}));
  EXPECT_FALSE(contains(area, {11, 5}));
  EXPECT_EQ(refusal([&] { check_area(area, Vec3::Zero(), {}); }), "accepted");
}

TEST(Area, OutlinesThatCrossThemselvesAreRefused) {
  const Area bow_tie{{{{0, 0}, {10, 10}, {10, 0}, {0, 5}}}};
  EXPECT_NE(refusal([&] {
              check_area(bow_tie, Vec3(500000, 0, 0), {"s.toml", 7});
            }).find("s.toml:7: the source area crosses itself between (500000, 0)"),
            std::string::npos);
  const Area flat{{{{0, 0}, {1, 1}, {2, 2}}}};
  EXPECT_NE(refusal([&] { check_area(flat, Vec3::Zero(), {}); }).find("no area"),
            std::string::npos);
  const Area spike{{{{0, 0}, {10, 0}, {10, 10}, {10, -5}, {0, 10}}}};
  EXPECT_NE(refusal([&] { check_area(spike, Vec3::Zero(), {}); }).find("crosses itself"),
            std::string::npos);
}

TEST(Area, RepeatedCornersAreTakenOnce) {
  Area area{{{{0, 0}, {0, 0}, {10, 0}, {10, 10}, {10, 10}, {10, 10}, {0, 10}, {0, 0}, {0, 0}}}};
  EXPECT_NE(refusal([&] { check_area(area, Vec3::Zero(), {}); }), "accepted");
  area = without_repeated_corners(area);
  EXPECT_EQ(area.rings[0].size(), 4u);
  EXPECT_EQ(refusal([&] { check_area(area, Vec3::Zero(), {}); }), "accepted");
}

TEST(Area, OutlinesThatMeetAreToldFromOneThatCrossesItself) {
  Area area = rectangle(0, 0, 10, 10);
  area.rings.push_back(rectangle(10, 0, 20, 10).rings[0]);
  EXPECT_NE(refusal([&] { check_area(area, Vec3::Zero(), {}); }).find("two outlines of the source"),
            std::string::npos);
}

// A vertical depth over k x m nodes: the rim runs out over one cell, so each node stands for a
// cell.
TEST(FindSource, VerticalDepthIsNodesTimesCellTimesDepth) {
  const Trn ground = grid(12, 14, 2, [](double x, double y) { return 0.7 * x - 0.2 * y; });
  SourceOptions options;
  options.kind = FailureSurface::vertical_depth;
  options.depth = 3;
  const SourceMass mass = find_source(ground, rectangle(7, 5, 17, 13), options, {});
  EXPECT_EQ(mass.nodes.size(), 5u * 4u);
  EXPECT_NEAR(mass.volume, 20 * 4 * 3, 1e-10);
  EXPECT_NEAR(mass.mean_depth, 3, 1e-12);
  EXPECT_EQ(mass.bed.elevation[0], ground.elevation[0]);
}

TEST(FindSource, NormalDepthIsDeeperOnSlopes) {
  const double slope = 40 * degree;
  const Trn ground = grid(12, 12, 1, [&](double x, double) { return std::tan(slope) * x; });
  SourceOptions options;
  options.depth = 2;
  const SourceMass mass = find_source(ground, rectangle(3, 3, 8, 8), options, {});
  EXPECT_NEAR(mass.max_depth, 2 / std::cos(slope), 1e-12);
}

// A plane that daylights: the mass is the wedge above it, and ends where it comes out.
TEST(FindSource, APlaneThatDaylightsLeavesAWedge) {
  const Trn ground = grid(81, 81, 0.5, [](double, double y) { return 0.9 * y; });
  SourceOptions options;
  options.kind = FailureSurface::plane;
  options.plane_dip = std::atan(0.5);
  options.plane_dip_direction = 180 * degree;  // dips south, as the slope
  options.plane_point = {0, 10, 9};            // comes out at y = 10
  const SourceMass mass = find_source(ground, rectangle(5, 2, 35, 30), options, {});
  EXPECT_GT(mass.n_above_ground, 0);
  // Depth 0.4 (y - 10) on nodes of 5..35 x 10..30; each node stands for a cell of 0.25 m2.
  double expected = 0;
  for (int i = 0; i <= 60; ++i)
    for (double y = 10; y <= 30; y += 0.5) expected += 0.25 * 0.4 * (y - 10);
  EXPECT_NEAR(mass.volume, expected, 1e-9 * expected);
}

// Along a profile the base level is the parabola with second derivative 2 C / cell^2 through its
// ends.
TEST(FindSource, SlopingLocalBaseLevelIsAParabolaAlongAProfile) {
  const int n = 41;
  const Trn ground = grid(5 * n, n, 1, [](double x, double) { return 100 + 2 * x; });
  SourceOptions options;
  options.kind = FailureSurface::slbl;
  options.slbl_curvature = 0.02;
  // A strip along x in the middle of a wide slope, lowered over its whole width: a profile.
  const SourceMass mass = find_source(ground, rectangle(1, 1, n - 2, 5 * n - 2), options, {});
  const int middle = 5 * n / 2;
  for (int c = 1; c + 1 < n; ++c) {
    const double z = mass.bed.elevation[node_index(ground, middle, c)];
    EXPECT_NEAR(z, 100 + 2 * c - 0.02 * c * (n - 1 - c), 0.02);
  }
  options.slbl_max_depth = 3;
  EXPECT_NEAR(find_source(ground, rectangle(1, 1, n - 2, 5 * n - 2), options, {}).max_depth, 3,
              1e-9);
}

// A long profile takes more sweeps than are made; what is missing is told to within a factor of
// two.
TEST(FindSource, ABaseLevelThatHasNotSettledSaysHowFar) {
  const int n = 401;
  const Trn ground = grid(5, n, 1, [](double x, double) { return 100 * x; });
  SourceOptions options;
  options.kind = FailureSurface::slbl;
  options.slbl_curvature = 0.001;
  const SourceMass mass = find_source(ground, rectangle(1, 1, n - 2, 3), options, {});
  double missing = 0;
  for (int c = 1; c + 1 < n; ++c) {
    const double profile = 100 * c - 0.001 * c * (n - 1 - c);
    missing = std::max(missing, mass.bed.elevation[node_index(ground, 2, c)] - profile);
  }
  EXPECT_GT(missing, 1);
  EXPECT_GT(mass.slbl_unsettled, missing / 2);
  EXPECT_LT(mass.slbl_unsettled, missing * 2);
}

TEST(FindSource, RefusesWhatCannotBeMeant) {
  Trn ground = grid(10, 10, 1, [](double x, double) { return x; });
  ground.origin = Vec3(1000, 2000, 0);
  SourceOptions options;
  options.depth = 1;
  const auto found = [&](const Area& area) {
    return refusal([&] { static_cast<void>(find_source(ground, area, options, {"s.toml", 4})); });
  };
  EXPECT_EQ(found(rectangle(2, 2, 6, 6)), "accepted");
  EXPECT_NE(found(rectangle(2, 2, 16, 6)).find("outside the terrain at (1016, 2002)"),
            std::string::npos);
  EXPECT_NE(found(rectangle(2.1, 2.1, 2.4, 2.4)).find("no node of the terrain"), std::string::npos);
  EXPECT_NE(found(rectangle(0, 2, 6, 6)).find("the edge of the terrain"), std::string::npos);
  options.depth = -1;
  EXPECT_NE(found(rectangle(2, 2, 6, 6)).find("nowhere below the ground"), std::string::npos);
  options.depth = 1;
  ground.elevation[node_index(ground, 5, 5)] = std::nan("");
  EXPECT_NE(found(rectangle(2, 2, 6, 6)).find("nodata"), std::string::npos);
}
