// Areas, prepared areas and the source: volumes, depths, refusals.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "base/error.hpp"
#include "base/random.hpp"
#include "blocks/prepared_area.hpp"
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

// A star of n tips about (50, 50), with a hole.
Area star(int n) {
  Area area;
  area.rings.resize(2);
  for (int k = 0; k < 2 * n; ++k) {
    const double angle = std::numbers::pi * k / n, radius = k % 2 == 0 ? 40 : 20;
    area.rings[0].emplace_back(50 + radius * std::cos(angle), 50 + radius * std::sin(angle));
  }
  area.rings[1] = {{45, 45}, {55, 45}, {55, 55}, {45, 55}};
  return area;
}

TEST(PreparedArea, HoldsWhatTheAreaHolds) {
  Random random(9);
  for (const Area& area : {rectangle(0, 0, 10, 10), star(3), star(50), star(1000), Area{}}) {
    const PreparedArea prepared(area);
    const auto same = [&](const Vec2& p) { EXPECT_EQ(prepared.contains(p), contains(area, p)); };
    for (int i = 0; i < 2000; ++i) same({random.uniform(-10, 110), random.uniform(-10, 110)});
    for (const auto& ring : area.rings)
      for (size_t k = 0; k < ring.size(); ++k) {  // corners, and points of sides
        const Vec2 &a = ring[k], &b = ring[(k + 1) % ring.size()];
        same(a);
        same(a + random.uniform() * (b - a));
        same({a.x() - 1, a.y()});
      }
    same({5, 1e300});
    same({std::nan(""), 5});
  }
}

TEST(PreparedArea, LooksAtFewSidesHoweverManyThereAre) {
  Random random(9);
  for (const int n : {100, 1000, 10000, 100000}) {
    Area circle;
    circle.rings.resize(1);
    for (int k = 0; k < n; ++k) {
      const double angle = 2 * std::numbers::pi * k / n;
      circle.rings[0].emplace_back(50 + 40 * std::cos(angle), 50 + 40 * std::sin(angle));
    }
    const PreparedArea prepared(circle);
    double sum = 0;
    for (int i = 0; i < 1000; ++i)
      sum += static_cast<double>(prepared.n_looked_at({50, random.uniform(10, 90)}));
    EXPECT_LT(sum / 1000, 8) << n;
  }
}

TEST(Area, OutlinesThatCrossThemselvesAreRefused) {
  const Area bow_tie{{{{0, 0}, {10, 10}, {10, 0}, {0, 5}}}};
  EXPECT_NE(refusal([&] {
              check_area(bow_tie, Vec3(500000, 0, 0), {"s.toml", 7});
            }).find("s.toml:7: the source area crosses itself between (500000, 0)"),
            std::string::npos);
  const Area even{{{{0, 0}, {10, 10}, {10, 0}, {0, 10}}}};  // halves that cancel
  EXPECT_NE(refusal([&] { check_area(even, Vec3::Zero(), {}); }).find("crosses itself"),
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

// The bed goes down at the corners of all cells that the polygon overlaps; the mass ends at it.
TEST(FindSource, VerticalDepthIsAreaTimesDepth) {
  const Trn ground = grid(12, 14, 2, [](double x, double y) { return 0.7 * x - 0.2 * y; });
  SourceOptions options;
  options.kind = FailureSurface::vertical_depth;
  options.depth = 3;
  const SourceMass mass = find_source(ground, rectangle(7, 5, 17, 13), options, {});
  // Of 7 x 6 nodes around it two belong only to triangles that a corner of it touches.
  EXPECT_EQ(mass.nodes.size(), 7u * 6u - 2u);
  EXPECT_NEAR(mass.volume, 10 * 8 * 3, 1e-10);
  EXPECT_NEAR(mass.area, 10 * 8, 1e-10);
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
  // Depth 0.4 (y - 10) over 5..35 x 10..30.
  EXPECT_NEAR(mass.volume, 30 * 0.4 * 20 * 20 / 2, 1e-6);
  EXPECT_NEAR(mass.area, 30 * 20, 1e-9);
}

// Where a plane comes out between two rows of nodes, the mass runs out to zero at the row behind:
// the wedge gains at most (cell / its length)^2 / 4 of its volume.
TEST(FindSource, APlaneThatDaylightsBetweenNodesGainsASecondOrderShare) {
  const double length = 60;
  for (const double cell : {1.0, 2.5, 5.0, 10.0})
    for (const double share : {0.0, 0.25, 0.5, 0.9}) {
      const int n = static_cast<int>(std::lround(150 / cell)) + 1;
      const Trn ground = grid(n, n, cell, [](double, double y) { return 0.9 * y; });
      const double comes_out = 40 + share * cell;
      SourceOptions options;
      options.kind = FailureSurface::plane;
      options.plane_dip = std::atan(0.5);
      options.plane_dip_direction = 180 * degree;
      options.plane_point = {0, comes_out, 0.9 * comes_out};
      const Area area = rectangle(50, 20, 90, comes_out + length);
      const double wedge = 40 * 0.4 * length * length / 2;
      const double gain = find_source(ground, area, options, {}).volume / wedge - 1;
      EXPECT_NEAR(gain, share * (1 - share) * std::pow(cell / length, 2), 1e-6);
    }
}

// A raster that ends at the polygon: beside it the depth of the nearest node continues, so that the
// mass is as deep at its walls as within.
TEST(FindSource, ARasterIsExtendedBesideThePolygon) {
  const Trn ground = grid(31, 31, 5, [](double x, double y) { return 0.8 * y + 0.1 * x; });
  const Area area{{{{41, 43}, {101, 52}, {88, 104}, {60, 70}, {39, 99}}}};
  SourceOptions options;
  options.kind = FailureSurface::raster;
  for (int r = 0; r < 31; ++r)
    for (int c = 0; c < 31; ++c) {
      const Vec3 p = node_point(ground, r, c);
      options.raster.push_back(contains(area, p.head<2>()) ? p.z() - 7 : std::nan(""));
    }
  const SourceMass mass = find_source(ground, area, options, {});
  EXPECT_GT(mass.n_extended, 20);
  EXPECT_NEAR(mass.volume, 7 * area_of(area), 1e-6 * mass.volume);
  options.raster[node_index(ground, 15, 11)] = std::nan("");  // (55, 75) lies inside
  EXPECT_NE(refusal([&] {
              static_cast<void>(find_source(ground, area, options, {}));
            }).find("the failure surface has no data at (55, 75)"),
            std::string::npos);
}

// The base level comes back to the ground at the first nodes outside: the part cut off at the
// polygon is thin.
TEST(FindSource, TheBaseLevelMeetsTheGroundBesideThePolygon) {
  const Trn ground = grid(61, 61, 2, [](double, double y) { return 0.7 * y; });
  SourceOptions options;
  options.kind = FailureSurface::slbl;
  options.slbl_curvature = 0.05;
  const Area area = rectangle(31, 31, 89, 81);
  const SourceMass mass = find_source(ground, area, options, {});
  for (const int node : mass.nodes) {
    const Vec3 p = node_point(ground, node / 61, node % 61);
    EXPECT_TRUE(contains(area, p.head<2>()));
  }
  EXPECT_NEAR(mass.area, area_of(area), 1e-6);
  EXPECT_LT(mass.volume, prism_volume(ground, mass.bed));
  EXPECT_GT(mass.volume, 0.97 * prism_volume(ground, mass.bed));
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

// A long profile takes more sweeps than are made; the remaining error is told to within a factor of
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
