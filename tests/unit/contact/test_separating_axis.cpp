// Separating axes: penetration depth, covered faces, seams, edges.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "bent_body.hpp"
#include "contact/separating_axis.hpp"
#include "convex_bodies.hpp"

namespace {

using namespace talus;
using namespace talus::test;

Vec3 random_half(Draws& random) {
  switch (std::uniform_int_distribution<int>(0, 3)(random)) {
    case 0:
      return Vec3(1, 1, 1);
    case 1:
      return Vec3(uniform(random, 0.3, 2), uniform(random, 0.3, 2), uniform(random, 0.3, 2));
    case 2:
      return Vec3(2, 0.01, 0.01);  // needle 1:200
    default:
      return Vec3(1, 1, 0.01);  // plate 1:100
  }
}

Bodies random_pair(Draws& random, double spread) {
  Bodies bodies;
  for (int k = 0; k < 2; ++k)
    add(bodies,
        convex_body(random, random_half(random), std::uniform_int_distribution<int>(0, 6)(random)),
        {spread * uniform(random, 0, 1) * direction(random), attitude(random)});
  place(bodies);
  return bodies;
}

double thickness(const Bodies& bodies) {
  return std::min(bodies.hulls.thickness[0], bodies.hulls.thickness[1]);
}

TEST(FindAxis, GivesThePenetrationDepthOfTheMinkowskiDifference) {
  Draws random(11);
  AxisScratch scratch;
  int n_overlap = 0, n_edges = 0;
  for (int k = 0; k < 4000; ++k) {
    const Bodies bodies = random_pair(random, 1.5);
    const double brute = brute_separation(bodies.hulls, bodies.placed, 0, 1);
    const AxisChoice choice = find_axis(bodies.hulls, bodies.placed, 0, 1, 0, {}, scratch);
    ASSERT_EQ(!choice.touches, brute > 0) << "pair " << k << ": " << brute;
    if (brute > 0) {
      EXPECT_LE(choice.separation, brute + 1e-12);
      continue;
    }
    ++n_overlap;
    // a face is taken before edges that are better by up to a thousandth of the thickness, and a
    // face of A before one of B alike
    EXPECT_LE(choice.separation, brute + 1e-12);
    EXPECT_GE(choice.separation, brute - 2e-3 * thickness(bodies) - 1e-12) << "pair " << k;
    EXPECT_NEAR(choice.separation,
                separation_along(bodies.hulls, bodies.placed, 0, 1, choice.normal), 1e-12);
    if (choice.axis.kind == AxisKind::edges) {
      ++n_edges;
      EXPECT_NEAR(choice.separation, brute, 1e-12);
    }
    EXPECT_EQ(choice.normal, axis_normal(bodies.hulls, bodies.placed, 0, 1, choice.axis));
  }
  EXPECT_GT(n_overlap, 1000);
  EXPECT_GT(n_edges, 300);
}

// Cubes that overlap edge on edge by a micrometre: the direction across both edges, not a face's at
// 45 degrees to it; edges parallel to rounding leave the faces.
TEST(FindAxis, EdgesThatHardlyCrossAreAnAxis) {
  AxisScratch scratch;
  for (const double degrees : {0.0, 0.001, 0.01, 0.1, 0.9, 1.1, 5.0}) {
    Bodies bodies;
    const Quat on_edge(Eigen::AngleAxisd(std::numbers::pi / 4, Vec3::UnitY()));
    const Quat turned(Eigen::AngleAxisd(degrees * std::numbers::pi / 180, Vec3::UnitX()));
    for (const Pose& pose : {Pose{Vec3::Zero(), on_edge}, Pose{Vec3::Zero(), turned * on_edge}})
      add(bodies, box(Vec3::Constant(-0.5), Vec3::Constant(0.5)), pose);
    place(bodies);
    press(bodies, 0, 1, -Vec3::UnitX(), 1e-6);
    const AxisChoice choice = find_axis(bodies.hulls, bodies.placed, 0, 1, 0, {}, scratch);
    ASSERT_TRUE(choice.touches);
    EXPECT_EQ(choice.axis.kind == AxisKind::edges, degrees >= 0.01) << degrees;
    if (degrees < 0.01) continue;
    EXPECT_NEAR(std::abs(choice.normal.x()), 1, 1e-9);
    EXPECT_NEAR(choice.separation, -1e-6, 1e-9);
  }
}

// Within `hold` the chosen axis must remain as good as any, up to the bonus that keeps it.
RC_GTEST_PROP(FindAxis, HoldsItsAxisForTheMotionItSays, ()) {
  Draws random(*rc::gen::arbitrary<std::uint64_t>());
  Bodies bodies = random_pair(random, 1.0);
  AxisScratch scratch;
  const AxisChoice first = find_axis(bodies.hulls, bodies.placed, 0, 1, 0, {}, scratch);
  RC_PRE(first.touches);
  const double turned = bodies.placed.turned[0];
  const double share = uniform(random, 0, 1);
  bodies.poses[0].position += share * first.hold * direction(random);
  bodies.poses[0].attitude =
      Quat(Eigen::AngleAxisd(0.4 * (1 - share) * first.hold / bodies.hulls.radius[0],
                             direction(random))) *
      bodies.poses[0].attitude;
  place(bodies);
  RC_ASSERT(bodies.placed.turned[0] - turned <= (1 - share) * first.hold + 1e-15);
  const AxisChoice next =
      find_axis(bodies.hulls, bodies.placed, 0, 1, first.hold, first.axis, scratch);
  const Vec3 kept = axis_normal(bodies.hulls, bodies.placed, 0, 1, first.axis);
  RC_ASSERT(kept.dot(next.normal) >= same_axis_cos || !next.touches ||
            separation_along(bodies.hulls, bodies.placed, 0, 1, kept) >=
                next.separation -
                    std::max(0.1 * std::abs(first.separation), 3e-3 * thickness(bodies)));
}

// Cubes face to face: rounding must not choose between the two faces, and a held face stays.
TEST(FindAxis, FlatContactTakesTheFaceOfAAndKeepsIt) {
  AxisScratch scratch;
  for (const double tilt : {0.0, 1e-12, -1e-9, 1e-6}) {
    Bodies bodies;
    add(bodies, box(Vec3(-1, -1, -1), Vec3(1, 1, 1)), {});
    add(bodies, box(Vec3(-1, -1, -1), Vec3(1, 1, 1)),
        {Vec3(0.3, 0.2, 2 - 1e-5), Quat(Eigen::AngleAxisd(tilt, Vec3(1, 2, 0).normalized()))});
    place(bodies);
    const AxisChoice choice = find_axis(bodies.hulls, bodies.placed, 0, 1, 0, {}, scratch);
    EXPECT_EQ(choice.axis.kind, AxisKind::face_a);
    EXPECT_NEAR(choice.normal.z(), -1, 1e-12);
    EXPECT_NEAR(choice.separation, -1e-5, 1e-5 + 2 * std::abs(tilt));
    const PairAxis of_b{AxisKind::face_b, -1, 4};
    EXPECT_EQ(find_axis(bodies.hulls, bodies.placed, 0, 1, 0, of_b, scratch).axis, of_b);
  }
}

TEST(FindAxis, IdenticalBodiesInTheSamePlaceOverlapByTheirThickness) {
  Draws random(5);
  const Polyhedron body = convex_body(random, Vec3(1, 1, 1), 5);
  Bodies bodies;
  add(bodies, body, {});
  add(bodies, body, {});
  place(bodies);
  AxisScratch scratch;
  const AxisChoice choice = find_axis(bodies.hulls, bodies.placed, 0, 1, 0, {}, scratch);
  EXPECT_TRUE(choice.normal.allFinite());
  EXPECT_NEAR(choice.separation, brute_separation(bodies.hulls, bodies.placed, 0, 1),
              2e-3 * bodies.hulls.thickness[0]);
}

// A step of two parts: of the tall part's side, only the part above the low one stops a body,
// though the cutting named all of it a face in the rock.
TEST(FindAxis, BareRestOfACoveredFaceStops) {
  const Vec2 tall[] = {{0, 0}, {1, 0}, {1, 2}, {0, 2}}, low[] = {{1, 0}, {2, 0}, {2, 1}, {1, 1}};
  const int tall_tags[] = {0, face_internal, 0, 0}, low_tags[] = {0, 0, 0, face_internal};
  const std::vector<Polyhedron> step = {prism(tall, tall_tags), prism(low, low_tags)};
  Bodies bodies;
  add(bodies, step, {});
  add(bodies, box(Vec3(0.95, -0.5, 1.2), Vec3(1.95, 0.5, 1.8)), {});
  place(bodies);
  const Hulls& hulls = bodies.hulls;
  const auto n_with = [&](int part, FaceCover cover) {
    return std::count(hulls.cover.begin() + hulls.face_begin[part],
                      hulls.cover.begin() + hulls.face_begin[part] + hulls.n_faces[part], cover);
  };
  EXPECT_EQ(n_with(0, FaceCover::part), 1);
  EXPECT_EQ(n_with(1, FaceCover::all), 1);
  AxisScratch scratch;
  const AxisChoice choice = find_axis(hulls, bodies.placed, 0, 2, 0, {}, scratch);
  EXPECT_TRUE(choice.touches);
  EXPECT_NEAR(choice.separation, -0.05, 1e-12);
  EXPECT_LT((choice.normal - Vec3(-1, 0, 0)).norm(), 1e-12);
}

// A box of two parts, the second one set against the first for `covered` to both sides of y = 0,
// tops flush; and a bar at y = `across` that leans on the edge between the tops, which is none of
// the body's where they meet. Its own lower edge is `gap` above that one and continues for `past`.
Bodies bar_over_a_seam(double covered, double across, double gap, double past = 2.8) {
  Bodies bodies;
  const std::vector<Polyhedron> step = {box(Vec3(-1, -5, 0), Vec3(0, 5, 1)),
                                        box(Vec3(0, -covered, 0), Vec3(0.1, covered, 1))};
  add(bodies, step, {});
  const Vec3 up = Vec3(1, 0, 1).normalized(), along = Vec3(1, 0, -1).normalized();
  Mat3 turn;
  turn.col(0) = along;
  turn.col(1) = (up + Vec3::UnitY()).normalized();
  turn.col(2) = turn.col(0).cross(turn.col(1));
  const double half = 0.2, height = gap + half * std::sqrt(2.0);
  add(bodies, box(Vec3(-2, -half, -half), Vec3(2, half, half)),
      {Vec3(0, across, 1) + height * up + (past - 2) * along, Quat(turn)});
  place(bodies);
  return bodies;
}

// An edge of the seam keeps the bar apart from the part on the far side.
TEST(FindAxis, EdgeOfASeamKeepsAPartApart) {
  const double gap = 0.5 - 0.2 * std::sqrt(2.0);
  const Bodies bodies = bar_over_a_seam(5, 0, gap);
  AxisScratch scratch;
  const AxisChoice choice = find_axis(bodies.hulls, bodies.placed, 0, 2, 0.01, {}, scratch);
  EXPECT_FALSE(choice.touches);
  EXPECT_EQ(choice.axis.kind, AxisKind::edges);
  EXPECT_NEAR(choice.separation, gap, 1e-12);
}

// Also where its end dips below the top of that part by less than a seam is given. Taken for an
// overlap with the top, it supported a block 5 cm away, which rattled for good.
TEST(FindAxis, EdgeOfASeamKeepsAPartApartThatSeemsToOverlapByLittle) {
  const double gap = 0.05, dip = 0.003;
  const Bodies bodies = bar_over_a_seam(5, 0, gap, gap + dip * std::sqrt(2.0));
  AxisScratch scratch;
  const AxisChoice choice = find_axis(bodies.hulls, bodies.placed, 0, 2, 0.01, {}, scratch);
  EXPECT_FALSE(choice.touches);
  EXPECT_NEAR(choice.separation, gap, 1e-12);
}

// The edge is covered in its middle and bare at its ends: there it keeps a bar apart, and carries
// it.
TEST(FindAxis, EdgeCoveredInItsMiddleCarriesAtItsEnds) {
  for (const double gap : {0.2, 0.005, -0.01}) {
    const Bodies bodies = bar_over_a_seam(2, 3, gap);
    AxisScratch scratch;
    const AxisChoice choice = find_axis(bodies.hulls, bodies.placed, 0, 2, 0.01, {}, scratch);
    EXPECT_EQ(choice.touches, gap < 0.01);
    EXPECT_EQ(choice.axis.kind, AxisKind::edges);
    EXPECT_NEAR(choice.separation, gap, 1e-12);
  }
}

// A body of two parts whose undersides rise by `rise` from the seam between them, 0.6 thick, and a
// ridge with sides that fall by `steep` below it, in by `sunk` and off the seam by `aside`.
Bodies saddle_on_a_ridge(double rise, double steep, double sunk, double aside) {
  const int tags[] = {0, 0, 0, 0}, three_tags[] = {0, 0, 0};
  const Vec2 right[] = {{0, 0}, {3, 3 * rise}, {3, 3 * rise + 0.6}, {0, 0.6}};
  const Vec2 left[] = {{-3, 3 * rise}, {0, 0}, {0, 0.6}, {-3, 3 * rise + 0.6}};
  const Vec2 ridge[] = {{-3, -3 * steep}, {3, -3 * steep}, {0, 0}};
  Bodies bodies;
  const std::vector<Polyhedron> saddle = {prism(right, tags), prism(left, tags)};
  add(bodies, saddle, {});
  add(bodies, prism(ridge, three_tags), {Vec3(aside, 0, sunk), Quat::Identity()});
  place(bodies);
  return bodies;
}

// An edge in a concave seam, or under a flat one, is in contact with both parts, however far it is
// in: neither leaves it to the other.
TEST(FindAxis, AnEdgeUnderASeamIsSupportedByBothParts) {
  AxisScratch scratch;
  for (const double rise : {-0.6, -0.1, 0.0})
    for (const double steep : {2.7, 8.0})
      for (const double sunk : {1e-5, 1e-3, 0.01, 0.04})
        for (const double aside : {0.0, 0.05 * sunk}) {
          const Bodies bodies = saddle_on_a_ridge(rise, steep, sunk, aside);
          for (const int part : {0, 1}) {
            const AxisChoice choice =
                find_axis(bodies.hulls, bodies.placed, part, 2, 1e-3, {}, scratch);
            const Vec3 up = Vec3(part == 0 ? -rise : rise, 0, 1).normalized();
            const double depth = up.z() * sunk + up.x() * aside;
            EXPECT_TRUE(choice.touches) << rise << " " << steep << " " << sunk << " " << part;
            EXPECT_NEAR(choice.separation, -depth, 1e-9) << rise << " " << steep << " " << part;
            EXPECT_GT(choice.normal.dot(up), 1 - 1e-12) << rise << " " << steep << " " << part;
          }
        }
}

// A plate on the convex edge of a seam, tipped to one side: that side's part supports it.
TEST(FindAxis, APlateOnAConvexSeamIsNotDeepInThePartBehindIt) {
  AxisScratch scratch;
  const double rise = 0.5;
  const int tags[] = {0, 0, 0, 0};
  const Vec2 right[] = {{0, 0}, {0, -3}, {3, -3}, {3, -3 * rise}};
  const Vec2 left[] = {{0, 0}, {-3, -3 * rise}, {-3, -3}, {0, -3}};
  for (const double tipped : {0.0, 0.2, 1.0}) {
    Bodies bodies;
    const std::vector<Polyhedron> roof = {prism(right, tags), prism(left, tags)};
    add(bodies, roof, {});
    const double angle = -tipped * std::atan(rise);
    const Mat3 turn = Eigen::AngleAxisd(angle, Vec3::UnitY()).toRotationMatrix();
    add(bodies, box(Vec3(-2, -0.9, 0), Vec3(2, 0.9, 0.5)), {Vec3(0, 0, -1e-4), Quat(turn)});
    place(bodies);
    for (const int part : {0, 1}) {
      const AxisChoice choice = find_axis(bodies.hulls, bodies.placed, part, 2, 1e-3, {}, scratch);
      EXPECT_TRUE(!choice.touches || choice.separation > -2e-4) << tipped << " " << part;
    }
  }
}

}  // namespace
