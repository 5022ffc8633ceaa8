#include <gtest/gtest.h>

#include "dda/start_overlaps.hpp"
#include "verify/cases.hpp"

namespace {

using namespace talus;
using namespace talus::cases;

BlockSet cubes_at(const std::vector<Vec3>& lows) {
  BlockSet set;
  set.material_names = {"rock"};
  for (const Vec3& low : lows) {
    Body body;
    body.parts = {box(low, low + Vec3::Ones())};
    add_body(set, body);
  }
  return set;
}

// Cube 1 stands 0.02 m inside cube 0; cube 2 touches both by a millionth less than the tolerance.
TEST(StartOverlaps, SayHowDeepWhichTwoAndWhere) {
  const BlockSet set = cubes_at({{0, 0, 0}, {0.98, 0, 0}, {0, 0.999001, 0}});
  const std::vector<StartOverlap> found = start_overlaps(set, {}, true, 1e-3);
  ASSERT_EQ(found.size(), 1u);
  const BlockOverlap& o = found[0].overlap;
  EXPECT_EQ(o.block_a, 0);
  EXPECT_EQ(o.block_b, 1);
  EXPECT_NEAR(o.depth, 0.02, 1e-12);
  EXPECT_LT((o.point - Vec3(0.99, 0.5, 0.5)).norm(), 1e-9);
  EXPECT_LT((o.normal + Vec3::UnitX()).norm(), 1e-12);  // from B to A
  EXPECT_NEAR(found[0].limit, 0.05, 1e-12);
  EXPECT_TRUE(found[0].is_small);
  EXPECT_TRUE(start_overlaps(set, {}, false, 1e-3).empty());
}

TEST(StartOverlaps, AreLargeBeyondATwentiethOfTheThickness) {
  EXPECT_TRUE(start_overlaps(cubes_at({{0, 0, 0}, {0.951, 0, 0}}), {}, true, 1e-3)[0].is_small);
  EXPECT_FALSE(start_overlaps(cubes_at({{0, 0, 0}, {0.949, 0, 0}}), {}, true, 1e-3)[0].is_small);
}

TEST(StartOverlaps, OfABlockWithAFenceAreNeverSmall) {
  StandingFence fence;
  fence.posts = {Vec3(-5, 1.05, 0), Vec3(5, 1.05, 0)};
  fence.depth = {0.5};
  fence.height = 3;
  const std::vector<StartOverlap> found =
      start_overlaps(cubes_at({{0, 0, 0}, {3, -4, 0}}), {fence}, true, 1e-3);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].overlap.block_a, 0);
  EXPECT_EQ(found[0].overlap.block_b, 2);  // the panel after two blocks
  EXPECT_NEAR(found[0].overlap.depth, 0.05, 1e-9);
  EXPECT_FALSE(found[0].is_small);
}

// A row of five cubes, each 0.03 m inside the next: the outer ones go by as much as all between.
TEST(MoveApart, LeavesNoOverlapAndTheCentreOfMassInPlace) {
  std::vector<Vec3> lows;
  for (int i = 0; i < 5; ++i) lows.push_back(Vec3(0.97 * i, 0, 0));
  BlockSet set = cubes_at(lows);
  Vec3 before = Vec3::Zero(), after = Vec3::Zero();
  for (const Vec3& c : set.centroid) before += c / 5;
  const MovedApart moved = move_apart(set, 1e-4);
  for (const Vec3& c : set.centroid) after += c / 5;
  EXPECT_TRUE(moved.done);
  EXPECT_TRUE(start_overlaps(set, {}, true, 1e-4).empty());
  EXPECT_LT((after - before).norm(), 1e-12);
  EXPECT_NEAR(moved.farthest, 0.06, 2e-3);
  EXPECT_NEAR(set.vertices[0].x(), set.centroid[0].x() - 0.5, 1e-12);
}

}  // namespace
