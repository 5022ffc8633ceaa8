// Overlaps of blocks at the start, and moving them apart.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "setup/start_depth.hpp"
#include "setup/start_overlaps.hpp"
#include "verify/cases/cases.hpp"

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

// Cube 1 is 0.02 m inside cube 0; cube 2 touches both by a millionth less than the tolerance.
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

// Rocks that fall one by one are released in one place by the thousand: eight million pairs that do
// not matter.
TEST(StartOverlaps, OfRocksThatDoNotMeetAreSoughtWithFencesAlone) {
  StandingFence fence;
  fence.posts = {Vec3(-5, 1.05, 0), Vec3(5, 1.05, 0)};
  fence.depth = {0.5};
  fence.height = 3;
  std::vector<Vec3> lows(4000, Vec3::Zero());
  lows.push_back({3, -4, 0});
  EXPECT_EQ(start_overlaps(cubes_at(lows), {fence}, false, 1e-3).size(), 4000u);
}

Trn flat_ground() {
  Trn trn;
  trn.n_rows = trn.n_cols = 11;
  trn.cell_size = 2;
  trn.node0 = {-10, 10};
  trn.elevation.assign(121, 0);
  return trn;
}

double deepest(const std::vector<double>& depths) {
  return *std::max_element(depths.begin(), depths.end());
}

// A row of five cubes, each 0.03 m inside the next: the outer ones go by as much as all between.
TEST(Settle, MovesARowApartAndLeavesItsCentreOfMassInPlace) {
  std::vector<Vec3> lows;
  for (int i = 0; i < 5; ++i) lows.push_back(Vec3(0.97 * i, 0, 0));
  BlockSet set = cubes_at(lows);
  Vec3 before = Vec3::Zero(), after = Vec3::Zero();
  for (const Vec3& c : set.centroid) before += c / 5;
  const Settled settled = settle(set, flat_ground(), true, 1e-6);
  for (const Vec3& c : set.centroid) after += c / 5;
  EXPECT_TRUE(settled.done);
  EXPECT_TRUE(start_overlaps(set, {}, true, 1e-6).empty());
  EXPECT_LT((after - before).norm(), 1e-12);
  EXPECT_NEAR(settled.farthest, 0.06, 2e-3);
  EXPECT_NEAR(set.vertices[0].x(), set.centroid[0].x() - 0.5, 1e-12);
}

// The lowest cube is on the ground and stays; each cube above rises by the overlaps below it.
TEST(Settle, LiftsAStackOffTheBlockThatStandsOnTheGround) {
  BlockSet set = cubes_at({{0, 0, 0.97}, {0, 0, 0}, {0, 0, 1.94}});
  const Settled settled = settle(set, flat_ground(), true, 1e-6);
  EXPECT_TRUE(settled.done);
  EXPECT_NEAR(set.centroid[1].z(), 0.5, 1e-12);
  EXPECT_NEAR(set.centroid[0].z(), 1.5, 1e-6);
  EXPECT_NEAR(set.centroid[2].z(), 2.5, 2e-6);
  EXPECT_NEAR(settled.farthest, 0.06, 2e-6);
  EXPECT_TRUE(start_overlaps(set, {}, true, 1e-6).empty());
}

TEST(Settle, CarriesWhatLiesOnABlockThatIsLiftedOutOfTheGround) {
  BlockSet set = cubes_at({{0, 0, -0.3}, {0, 0, 0.7}, {0, 0, 1.7}, {3, 0, 0}});
  const Settled settled = settle(set, flat_ground(), true, 1e-6);
  EXPECT_TRUE(settled.done);
  EXPECT_LT(deepest(depths_below_ground(flat_ground(), set)), 1e-6);
  EXPECT_NEAR(set.centroid[2].z(), 2.5, 1e-6);
  EXPECT_EQ(set.centroid[3], Vec3(3.5, 0.5, 0.5));
}

// Two blocks with a common face that leans by 10 degrees from the vertical: the one below it is in
// the ground, and the one above it rises with it, and is not pushed aside.
TEST(Settle, CarriesWhatLeansOnABlockThatIsLifted) {
  const double lean = std::tan(10 * std::numbers::pi / 180);
  BlockSet set;
  set.material_names = {"rock"};
  for (Polyhedron part : {box({0, 0, -0.02}, {1, 1, 0.98}), box({1, 0, 0}, {2, 1, 1})}) {
    for (Vec3& at : part.vertices)
      if (at.x() == 1) at.x() += lean * (0.5 - at.z());
    Body body;
    body.parts = {part};
    add_body(set, body);
  }
  const Vec3 before = set.centroid[1];
  EXPECT_TRUE(settle(set, flat_ground(), true, 1e-6).done);
  EXPECT_LT((set.centroid[1] - before - Vec3(0, 0, 0.02)).norm(), 1e-6);
}

// Three beams about a middle, each with its raised end on the next one: lifts would go round.
TEST(Settle, PartsBeamsThatLieOnOneAnotherInACircle) {
  BlockSet set;
  set.material_names = {"rock"};
  for (int k = 0; k < 3; ++k) {
    const Mat3 turn = (Eigen::AngleAxisd(2 * std::numbers::pi / 3 * k, Vec3::UnitZ()) *
                       Eigen::AngleAxisd(-std::atan(0.113), Vec3::UnitY()))
                          .toRotationMatrix();
    Body body;
    body.parts = {moved(box({-1.5, -0.1, -0.1}, {1.5, 0.1, 0.1}), turn, Vec3::Zero(),
                        turn * Vec3(0, -0.5, 0) + Vec3(0, 0, 1))};
    add_body(set, body);
  }
  ASSERT_EQ(start_overlaps(set, {}, true, 1e-6).size(), 3u);
  const Settled settled = settle(set, flat_ground(), true, 1e-6);
  EXPECT_TRUE(settled.done);
  EXPECT_TRUE(start_overlaps(set, {}, true, 2e-6).empty());
}

TEST(Settle, LiftsEachBlockAloneWhereBlocksDoNotMeet) {
  BlockSet set = cubes_at({{0, 0, -0.3}, {0, 0, 0.6}});
  EXPECT_TRUE(settle(set, flat_ground(), false, 1e-6).done);
  EXPECT_NEAR(set.centroid[0].z(), 0.5, 1e-12);
  EXPECT_EQ(set.centroid[1].z(), 1.1);
}

}  // namespace
