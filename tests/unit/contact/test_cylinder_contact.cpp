// Contact of convex parts with a vertical cylinder, against brute force.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "contact/cylinder_contact.hpp"
#include "unit/contact/convex_bodies.hpp"

namespace {

using namespace talus;
using namespace talus::test;

// One body of one part, placed.
struct PlacedBody {
  Hulls hulls;
  PlacedHulls placed;

  PlacedBody(const Polyhedron& body, const Pose& pose) {
    const Vec3 centroid = moments(body).centroid;
    add_hulls(hulls, std::span(&body, 1), centroid, Mat3::Identity());
    place_hulls(hulls, std::span(&pose, 1), {}, {}, placed);
  }
};

constexpr int n_directions = 20000;
constexpr double half_step = std::numbers::pi / n_directions;  // [rad]

// Gap by brute force: the largest, over all directions, of how far the body lies off the axis. It
// misses the largest by half a step times the body's distance at most.
double gap_by_directions(const PlacedBody& body, const VerticalCylinder& cylinder) {
  double gap = -1e300;
  for (int k = 0; k < n_directions; ++k) {
    const double angle = 2 * std::numbers::pi * k / n_directions;
    const Vec2 n(std::cos(angle), std::sin(angle));
    double low = 1e300;
    for (const Vec3& v : body.placed.vertices)
      low = std::min(low, n.dot(v.head<2>() - cylinder.axis));
    gap = std::max(gap, low - cylinder.radius);
  }
  return gap;
}

// Of random bodies, with the axis beside or in them: the gap is that of all directions, the normal
// is horizontal, and no point of the body is nearer than the gap says.
TEST(CylinderContact, HasTheGapThatBruteForceFinds) {
  Draws random(17);
  int n_inside = 0;
  for (int k = 0; k < 300; ++k) {
    const PlacedBody body(convex_body(random, Vec3(0.6, 0.4, 0.5), 5),
                          {Vec3(3, -2, 5), attitude(random)});
    const double angle = uniform(random, 0, 6.3), off = uniform(random, 0, 1.2);
    const VerticalCylinder cylinder{Vec2(3 + off * std::cos(angle), -2 + off * std::sin(angle)),
                                    0.15, 20};
    Vec3 normal = Vec3::Zero();
    std::vector<PairPoint> points;
    ASSERT_GT(find_cylinder_contact(body.hulls, body.placed, 0, cylinder, 2, normal, points), 0);
    double gap = 1e300;
    for (const PairPoint& point : points) gap = std::min(gap, point.gap);
    const double found = gap_by_directions(body, cylinder);
    EXPECT_GE(gap, found - 1e-9);
    EXPECT_LE(gap, found + half_step * (1.2 + body.hulls.radius[0]));
    EXPECT_EQ(normal.z(), 0);
    EXPECT_NEAR(normal.norm(), 1, 1e-12);
    for (const PairPoint& point : points) {
      EXPECT_NEAR((point.point_b.head<2>() - cylinder.axis).norm(), 0.15, 1e-9);
      EXPECT_GE(point.gap, gap);
    }
    n_inside += gap < -0.15;
  }
  EXPECT_GT(n_inside, 30);
}

// A vertical face touches along a line: two points, its upper and its lower edge.
TEST(CylinderContact, AFaceTouchesAtItsEdges) {
  const PlacedBody body(box(Vec3::Constant(-0.5), Vec3::Constant(0.5)),
                        {Vec3(0, 0, 2), Quat::Identity()});
  Vec3 normal;
  std::vector<PairPoint> points;
  ASSERT_EQ(find_cylinder_contact(body.hulls, body.placed, 0, {Vec2(1, 0.1), 0.2, 20}, 0.5, normal,
                                  points),
            2);
  EXPECT_NEAR((normal - Vec3(-1, 0, 0)).norm(), 0, 1e-12);
  for (const PairPoint& point : points) {
    EXPECT_NEAR(point.gap, 0.3, 1e-12);
    EXPECT_NEAR(std::abs(point.point_b.z() - 2), 0.5, 1e-12);
  }
  EXPECT_NE(points[0].key.feature_a, points[1].key.feature_a);
}

TEST(CylinderContact, EndsAtTheTopAndBeyondTheMargin) {
  const PlacedBody body(box(Vec3::Constant(-0.5), Vec3::Constant(0.5)),
                        {Vec3(0, 0, 2), Quat::Identity()});
  Vec3 normal;
  std::vector<PairPoint> points;
  const auto n_at = [&](double x, double top) {
    points.clear();
    return find_cylinder_contact(body.hulls, body.placed, 0, {Vec2(x, 0), 0.2, top}, 0.1, normal,
                                 points);
  };
  EXPECT_EQ(n_at(0.75, 20), 2);
  EXPECT_EQ(n_at(0.85, 20), 0);
  EXPECT_EQ(n_at(0.75, 2), 1);
  EXPECT_EQ(n_at(0.75, 1.4), 0);
}

}  // namespace
