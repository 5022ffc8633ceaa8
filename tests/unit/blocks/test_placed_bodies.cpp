// Bodies set on the ground: scale, place, overlaps, shapes.
#include <gtest/gtest.h>

#include <cmath>

#include "base/random.hpp"
#include "blocks/placed_bodies.hpp"
#include "blocks/placement.hpp"
#include "blocks/shapes.hpp"

using namespace talus;

namespace {

// z = 100 - slope x, nodes 2 m apart, known over 40 x 40 m.
Trn plane(double slope) {
  Trn trn;
  trn.n_rows = trn.n_cols = 21;
  trn.cell_size = 2;
  trn.node0 = Vec2(0, 40);
  for (int row = 0; row < trn.n_rows; ++row)
    for (int col = 0; col < trn.n_cols; ++col) trn.elevation.push_back(100 - slope * 2 * col);
  return trn;
}

Body box_body(const Vec3& low, const Vec3& high) {
  Body body;
  body.parts = {box(low, high, face_terrain)};
  return body;
}

}  // namespace

TEST(PlacedBodies, ScaleAndMoveAsOne) {
  std::vector<Body> pair = {box_body({0, 0, 0}, {1, 1, 1}), box_body({3, 0, 0}, {5, 1, 1})};
  scale_to_volume(pair, 24);  // 3 m3 before: lengths twice as large
  EXPECT_NEAR(volume_of(pair[0]), 8, 1e-12);
  EXPECT_NEAR(volume_of(pair[1]), 16, 1e-12);
  centre(pair);  // centroids at x = 1 and 8, of 8 and 16 m3
  EXPECT_NEAR(pair[0].parts[0].vertices[0].x(), -17.0 / 3, 1e-12);
  EXPECT_NEAR(pair[0].parts[0].vertices[0].z(), -1, 1e-12);
}

// A body hangs by its height above the ground, the lowest of a group decides, and a turn comes
// first; by its own elevation it may reach into the ground, which is told.
TEST(PlacedBodies, StandOnTheGroundOrSayHowDeepTheyReach) {
  const Trn ground = plane(0.5);
  const std::vector<Body> group = {box_body({-1, -1, -1}, {1, 1, 1}),
                                   box_body({-1, -1, 2}, {1, 1, 3})};
  std::vector<Body> bodies = group;
  EXPECT_EQ(put_on_ground(bodies, ground, {Mat3::Identity(), Vec3(20, 20, NAN), NAN}), 0);
  EXPECT_NEAR(clearance(bodies[0], ground), 0, 1e-9);
  EXPECT_NEAR(clearance(bodies[1], ground), 3, 1e-9);

  bodies = group;
  const Mat3 upside_down = rotation(0, 0, std::acos(-1.0));
  EXPECT_EQ(put_on_ground(bodies, ground, {upside_down, Vec3(20, 20, 7), 2.5}), 0);
  EXPECT_NEAR(clearance(bodies[1], ground), 2.5, 1e-9);

  bodies = group;  // ground 90 m at x = 20, 90.5 at its upper side: the corners at 89.5
  EXPECT_NEAR(put_on_ground(bodies, ground, {Mat3::Identity(), Vec3(20, 20, 90.5), NAN}), 1, 1e-9);
  bodies = group;
  EXPECT_EQ(put_on_ground(bodies, ground, {Mat3::Identity(), Vec3(20, 20, 95), NAN}), 0);
  EXPECT_EQ(bodies[0].parts[0].vertices[0].z(), 94);
}

TEST(PlacedBodies, AreToldToLieOffKnownGround) {
  const Trn ground = plane(0);
  const std::vector<Body> group = {box_body({-1, -1, -1}, {1, 1, 1})};
  for (const Vec3& place : {Vec3(60, 20, NAN), Vec3(39.5, 20, 105)}) {
    std::vector<Body> bodies = group;
    EXPECT_TRUE(std::isnan(put_on_ground(bodies, ground, {Mat3::Identity(), place, NAN})));
  }
  EXPECT_TRUE(is_below(box_body({1, 1, 90}, {2, 2, 99}), ground));
  EXPECT_FALSE(is_below(box_body({1, 1, 90}, {2, 2, 101}), ground));
}

TEST(PlacedBodies, OverlapByTheShareOfTheSmallerOne) {
  const std::vector<Body> bodies = {box_body({0, 0, 0}, {4, 4, 4}),
                                    box_body({3, 0, 0}, {5, 4, 4}),       // half of the second
                                    box_body({-2, 0, 0}, {0, 4, 4}),      // touches the first
                                    box_body({4.9, 0, 0}, {5.9, 4, 4})};  // a tenth of it
  const BodyOverlaps found = find_overlaps(bodies, std::vector<bool>(4, false));
  EXPECT_EQ(found.n, 2);
  EXPECT_NEAR(found.largest_share, 0.5, 1e-12);
  EXPECT_EQ(found.worst, (std::array<int, 2>{0, 1}));
  EXPECT_FALSE(found.cavity);
}

TEST(PlacedBodies, NameACavityAndWhatItIsIn) {
  const std::vector<Body> bodies = {box_body({1, 1, 1}, {2, 2, 2}),
                                    box_body({9, 9, 9}, {10, 10, 10}),
                                    box_body({0, 0, 0}, {4, 4, 4})};
  EXPECT_EQ(find_overlaps(bodies, {true, false, false}).cavity, (std::array<int, 2>{0, 2}));
  EXPECT_FALSE(find_overlaps(bodies, {false, true, true}).cavity);
}

// The table of shapes: each makes a body of the extents that it is given.
TEST(Shapes, EachRowMakesABodyOfItsExtents) {
  for (const ShapeKind& kind : shape_kinds()) {
    if (kind.n_extents == 1) continue;  // have their proportions: test_rock_draws.cpp
    Random random(1, "shapes");
    ShapeSize size;
    size.extents = {3, 2, 1.5};
    size.n_sides = 8;
    size.n_points = 400;
    const Polyhedron body = kind.make(size, random);
    Vec3 low = body.vertices[0], high = low;
    for (const Vec3& v : body.vertices) low = low.cwiseMin(v), high = high.cwiseMax(v);
    EXPECT_NEAR(high.y() - low.y(), 2, 0.1) << kind.name;
    EXPECT_NEAR(high.x() - low.x(), 3, 0.25) << kind.name;
    EXPECT_NEAR(moments(body).centroid.norm(), 0, 1e-9) << kind.name;
    EXPECT_EQ(&shape_kind(kind.name), &kind);
  }
}
