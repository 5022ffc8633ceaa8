// Joint faces and overlaps before anything moves.
#include <gtest/gtest.h>

#include "contact/start_contacts.hpp"
#include "convex_bodies.hpp"

namespace {

using namespace talus;
using namespace talus::test;

// 3 x 2 x 2 unit boxes: every inner face is shared, with its area, once.
TEST(JointContacts, LatticeOfBoxesSharesItsInnerFaces) {
  Bodies bodies;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 2; ++j)
      for (int k = 0; k < 2; ++k)
        add(bodies, box(Vec3(0, 0, 0), Vec3(1, 1, 1), i), {Vec3(i, j, k), Quat::Identity()});
  place(bodies);
  const std::vector<JointContact> contacts =
      joint_contacts(bodies.hulls, bodies.placed, 1e-6, 1e-3);
  EXPECT_EQ(contacts.size(), 2u * 4 + 3u * 2 + 3u * 2);
  for (const JointContact& c : contacts) {
    EXPECT_LT(c.block_a, c.block_b);
    EXPECT_NEAR(c.area, 1, 1e-12);
    const Vec3 from_b = bodies.poses[c.block_a].position - bodies.poses[c.block_b].position;
    EXPECT_LT((c.normal - from_b).norm(), 1e-12);
    const Vec3 middle = (bodies.poses[c.block_a].position + bodies.poses[c.block_b].position) / 2 +
                        Vec3(0.5, 0.5, 0.5);
    EXPECT_LT((c.point - middle).norm(), 1e-12);
    EXPECT_EQ(c.joint_set_a, c.block_a / 4);
  }
}

// A body cut by a plane: the halves share exactly the cut, whose area is that of the new face.
TEST(JointContacts, HalvesOfACutBodyShareTheCut) {
  Draws random(41);
  for (int k = 0; k < 50; ++k) {
    const Polyhedron whole = convex_body(random, Vec3(1, 1, 1), 5);
    const Plane plane{direction(random), uniform(random, -0.2, 0.2)};
    const Polyhedron low = clip_convex(whole, plane, 7, 1e-9),
                     high = clip_convex(whole, flipped(plane), 7, 1e-9);
    Bodies bodies;
    add(bodies, low, {});
    add(bodies, high, {});
    place(bodies);
    const std::vector<JointContact> contacts =
        joint_contacts(bodies.hulls, bodies.placed, 1e-6, 1e-3);
    ASSERT_EQ(contacts.size(), 1u);
    EXPECT_EQ(contacts[0].joint_set_a, 7);
    EXPECT_NEAR(contacts[0].area, face_area(low, n_faces(low) - 1), 1e-9);
    EXPECT_LT((contacts[0].normal + plane.normal).norm(), 1e-9);
    EXPECT_TRUE(block_overlaps(bodies.hulls, bodies.placed, 1e-6).empty());
  }
}

TEST(BlockOverlaps, GiveDepthVolumeAndPlaceDeepestFirst) {
  Bodies bodies;
  add(bodies, box(Vec3(0, 0, 0), Vec3(1, 1, 1)), {});
  add(bodies, box(Vec3(0, 0, 0), Vec3(1, 1, 1)), {Vec3(0.9, 0.5, 0), Quat::Identity()});
  add(bodies, box(Vec3(0, 0, 0), Vec3(1, 1, 1)), {Vec3(0, 0, 0.7), Quat::Identity()});
  place(bodies);
  const std::vector<BlockOverlap> overlaps = block_overlaps(bodies.hulls, bodies.placed, 1e-6);
  ASSERT_EQ(overlaps.size(), 3u);
  EXPECT_EQ(overlaps[0].block_b, 2);
  EXPECT_NEAR(overlaps[0].depth, 0.3, 1e-12);
  EXPECT_NEAR(overlaps[0].volume, 0.3, 1e-12);
  EXPECT_NEAR(overlaps[1].depth, 0.1, 1e-12);
  EXPECT_NEAR(overlaps[1].volume, 0.1 * 0.5, 1e-12);
  EXPECT_LT((overlaps[1].point - Vec3(0.95, 0.75, 0.5)).norm(), 1e-12);
  EXPECT_NEAR(overlaps[2].volume, 0.1 * 0.5 * 0.3, 1e-12);
  EXPECT_EQ(block_overlaps(bodies.hulls, bodies.placed, 0.2).size(), 1u);
  const std::vector<BlockOverlap> with_first = block_overlaps(bodies.hulls, bodies.placed, 1e-6, 1);
  ASSERT_EQ(with_first.size(), 2u);  // bodies 1 and 2 are fixed
  EXPECT_EQ(with_first[0].block_a, 0);
  EXPECT_EQ(with_first[1].block_a, 0);
  EXPECT_EQ(block_overlaps(bodies.hulls, bodies.placed, 1e-6, 1, false).size(), 2u);
  EXPECT_EQ(block_overlaps(bodies.hulls, bodies.placed, 1e-6, 2, false).size(), 2u);  // not 0 and 1
  EXPECT_TRUE(block_overlaps(bodies.hulls, bodies.placed, 1e-6, 3, false).empty());
}

// The common volume of random bodies against counting points of a fine lattice.
TEST(BlockOverlaps, VolumeAgreesWithCountedPoints) {
  Draws random(42);
  for (int k = 0; k < 20; ++k) {
    Bodies bodies;
    for (int i = 0; i < 2; ++i)
      add(bodies, convex_body(random, Vec3(1, 1, 1), 4),
          {uniform(random, 0, 0.8) * direction(random), attitude(random)});
    place(bodies);
    const std::vector<BlockOverlap> overlaps = block_overlaps(bodies.hulls, bodies.placed, 0);
    ASSERT_EQ(overlaps.size(), 1u);
    const int n = 60;
    const double cell = 4.0 / n;
    int inside = 0;
    for (int x = 0; x < n; ++x)
      for (int y = 0; y < n; ++y)
        for (int z = 0; z < n; ++z) {
          const Vec3 p = Vec3(-2, -2, -2) + cell * Vec3(x + 0.5, y + 0.5, z + 0.5);
          inside += outside_by(bodies.hulls, bodies.placed, 0, p) < 0 &&
                            outside_by(bodies.hulls, bodies.placed, 1, p) < 0
                        ? 1
                        : 0;
        }
    EXPECT_NEAR(inside * cell * cell * cell, overlaps[0].volume, 0.05);
    EXPECT_NEAR(overlaps[0].depth, -brute_separation(bodies.hulls, bodies.placed, 0, 1), 3e-3);
  }
}

}  // namespace
