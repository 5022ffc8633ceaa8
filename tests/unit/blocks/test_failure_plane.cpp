// Failure planes: closed-form wedges, feet, assumed joint sets, rising beds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "blocks/failure_plane.hpp"
#include "blocks/mass_outline.hpp"
#include "scenes.hpp"

namespace {

using namespace talus;
using namespace talus::test;

Area rectangle(double x0, double y0, double x1, double y1) {
  return {{{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}}};
}

// 45 degrees down to the south.
Trn even_slope() {
  return grid(60, 60, 2, [](double, double y) { return y; });
}

const FailurePlane& only(const FailurePlanes& found) { return found.planes.at(0); }

}  // namespace

// The foot lies on nodes: the plane comes out of the ground there.
TEST(FailurePlane, WedgeOverAPlaneThroughTheFootHasItsClosedForm) {
  const double width = 40, length = 30;
  const Area area = rectangle(31, 40, 31 + width, 40 + length);
  const FailurePlanes found =
      find_failure_planes(even_slope(), area, {joint_set(30, 180, 4)}, 25 * degree, "", {"s.toml"});
  ASSERT_EQ(found.best, 0);
  const FailurePlane& plane = only(found);
  EXPECT_NEAR(found.slope.dip, 45 * degree, 1e-12);
  EXPECT_NEAR(found.slope.dip_direction, 180 * degree, 1e-12);
  EXPECT_NEAR(plane.point.y(), 40, 1e-12);
  EXPECT_NEAR(plane.point.z(), 40, 1e-12);
  EXPECT_NEAR(plane.volume, width * length * length / 2 * (1 - std::tan(30 * degree)), 1e-8);
  EXPECT_NEAR(plane.foot.free_share, 1, 1e-12);
  EXPECT_EQ(plane.foot.largest_step, 0);
  EXPECT_NEAR(plane.foot.exit_low, 40, 1e-9);
  EXPECT_NEAR(plane.foot.exit_high, 40, 1e-9);
  EXPECT_EQ(plane.rising_share, 0);
}

// The same turned by the compass: down to 060, the rectangle along the fall line.
TEST(FailurePlane, FootIsFoundWhicheverDirectionTheSlopeFalls) {
  const double azimuth = 60 * degree;
  const Vec2 down(std::sin(azimuth), std::cos(azimuth)), across(down.y(), -down.x());
  const Trn ground = grid(80, 80, 2, [&](double x, double y) { return -down.dot(Vec2(x, y)); });
  const Vec2 foot(100, 90);
  const auto corner = [&](double back, double side) -> Vec2 {
    return foot - back * down + side * across;
  };
  for (const bool is_clockwise : {false, true}) {
    Area area{{{corner(0, 0), corner(0, 30), corner(40, 30), corner(40, 0)}}};
    if (is_clockwise) std::reverse(area.rings[0].begin(), area.rings[0].end());
    const FailurePlanes found =
        find_failure_planes(ground, area, {joint_set(35, 60, 4)}, 25 * degree, "", {});
    ASSERT_EQ(found.best, 0);
    EXPECT_NEAR(found.slope.dip_direction, azimuth, 1e-9);
    EXPECT_NEAR((only(found).point.head<2>() - foot).dot(down), 0, 1e-9);
    EXPECT_NEAR(only(found).point.z(), -down.dot(foot), 1e-9);
    EXPECT_NEAR(only(found).foot.free_share, 1, 1e-12);
  }
}

// A bump 6 m high on a tenth of the foot: the plane leaves it as a step; on a quarter, the plane
// goes above it.
TEST(FailurePlane, TenthOfTheFootMayHaveSteps) {
  const auto with_bump = [](double bump_width) {
    return grid(80, 80, 1, [=](double x, double y) {
      return y + (std::abs(x - 40) < bump_width / 2 && y < 25 ? 6 : 0);
    });
  };
  const Area area = rectangle(20, 20, 60, 60);
  const std::vector<JointSet> sets = {joint_set(35, 180, 4)};
  const FailurePlane few = only(find_failure_planes(with_bump(3), area, sets, 0.3, "", {}));
  EXPECT_NEAR(few.point.z() - few.point.y(), 0, 1e-9);
  EXPECT_GE(few.foot.free_share, least_free_foot);
  EXPECT_LT(few.foot.free_share, 1);
  EXPECT_GT(few.foot.largest_step, 4);
  const FailurePlane many = only(find_failure_planes(with_bump(10), area, sets, 0.3, "", {}));
  EXPECT_NEAR(many.point.z() - many.point.y(), 6, 1e-9);
  EXPECT_LT(many.volume, few.volume);
}

// A wall on the ground two cells before the foot holds the mass as the foot itself would.
TEST(FailurePlane, GroundThatRisesBeforeTheFootLiftsThePlane) {
  const Trn ground =
      grid(60, 60, 2, [](double, double y) { return y + (y < 38.5 && y > 35.5 ? 9 : 0); });
  const FailurePlane plane = only(
      find_failure_planes(ground, rectangle(31, 41, 71, 91), {joint_set(30, 180, 4)}, 0.3, "", {}));
  EXPECT_NEAR(plane.point.z(), 38 + 9, 1e-9);
}

TEST(FailurePlane, EachSetThatCannotGoSaysWhy) {
  const Area area = rectangle(31, 41, 71, 71);
  const std::vector<JointSet> sets = {
      joint_set(30, 0, 4, "into"),    joint_set(30, 225, 4, "across"),
      joint_set(50, 180, 4, "steep"), joint_set(44, 150, 4, "steep aside"),
      joint_set(25, 180, 4, "flat"),  joint_set(30, 200, 4, "goes")};
  const FailurePlanes found = find_failure_planes(even_slope(), area, sets, 28 * degree, "", {});
  const auto says = [&](int k, const char* words) {
    EXPECT_NE(found.planes[k].why_not.find(words), std::string::npos) << found.planes[k].why_not;
  };
  says(0, "into the slope");
  says(1, "across the slope, 45 degrees off");
  says(2, "steeper than the slope, which dips 45 degrees");
  says(3, "steeper than the slope, which dips 40.9 degrees");
  says(4, "friction angle of 28 degrees");
  EXPECT_EQ(found.planes[5].why_not, "");
  EXPECT_EQ(found.best, 5);
}

TEST(FailurePlane, LargestMassIsTakenUnlessASetIsWanted) {
  const Area area = rectangle(31, 41, 71, 71);
  const std::vector<JointSet> sets = {joint_set(40, 180, 4, "steep"), joint_set(30, 180, 4, "flat"),
                                      joint_set(80, 0, 4, "rear")};
  const auto best = [&](const char* wanted) {
    return find_failure_planes(even_slope(), area, sets, 0.3, wanted, {}).best;
  };
  EXPECT_EQ(best(""), 1);
  EXPECT_EQ(best("steep"), 0);
  EXPECT_EQ(best("rear"), -1);
}

TEST(FailurePlane, UnevenFootThatLeavesNoRockIsARefusal) {
  // A quarter of the foot is on a rib 40 m high, which ends just inside the area.
  const Trn ground =
      grid(60, 60, 2, [](double x, double y) { return y + (x > 50 && y < 15 ? 40 : 0); });
  const FailurePlanes found =
      find_failure_planes(ground, rectangle(21, 11, 61, 111), {joint_set(30, 180, 4)}, 0.3, "", {});
  EXPECT_EQ(found.best, -1);
  EXPECT_NE(only(found).why_not.find("the foot is uneven by 40 m"), std::string::npos)
      << only(found).why_not;
}

TEST(FailurePlane, AreaThatFindSourceRefusesIsRefused) {
  EXPECT_THROW(static_cast<void>(find_failure_planes(even_slope(), rectangle(31, 41, 300, 71),
                                                     {joint_set(30, 180, 4)}, 0.3, "", {})),
               InputError);
}

// V-shaped bed: half of the mass over the flank that rises towards the east.
// A bank before the outline holds a mass that reaches the outline, and none that comes out above
// it.
TEST(StepsAtFoot, AreMeasuredWhereTheRockEnds) {
  const auto slope = [](double y) { return y < 20 ? 25.0 : y; };  // the bank lies south of y = 20
  const Trn ground = grid(60, 60, 2, [&](double, double y) { return slope(y); });
  const Area area = rectangle(30, 21, 90, 100);
  const auto largest = [&](double exit) {
    const Trn bed = grid(
        60, 60, 2, [&](double, double y) { return std::min(slope(y), exit + 0.8 * (y - exit)); });
    double step = 0;
    for (const FootStep& at : steps_at_foot(ground, bed, area, std::numbers::pi))
      step = std::max(step, at.height);
    return step;
  };
  EXPECT_NEAR(largest(60), 0, 1e-9);
  EXPECT_NEAR(largest(22), 3, 1e-9);
  EXPECT_NEAR(largest(12), 25 - 19.2, 1e-9);
  EXPECT_EQ(largest(200), 0) << "no rock";
}

TEST(ShareOverRisingBed, HalfOfASymmetricHollow) {
  const Trn ground = grid(31, 31, 1, [](double, double) { return 20.0; });
  const Trn bed = grid(31, 31, 1, [](double x, double) { return std::abs(x - 15); });
  const Area area = rectangle(5, 5, 25, 25);
  EXPECT_NEAR(share_over_rising_bed(ground, bed, area, 90 * degree), 0.5, 1e-12);
  EXPECT_NEAR(share_over_rising_bed(ground, bed, area, 0), 0, 1e-12);
}

TEST(AssumedJointSets, DipBetweenFrictionAndSlopeAndMakeAboutThatManyBlocks) {
  const Area area = rectangle(31, 41, 71, 71);
  const auto sets = assumed_joint_sets(even_slope(), area, 30 * degree, 64, {});
  ASSERT_EQ(sets.size(), 3u);
  EXPECT_NEAR(sets[0].dip, 40 * degree, 1e-9);
  EXPECT_NEAR(sets[0].dip_direction, 180 * degree, 1e-9);
  EXPECT_NEAR(sets[2].dip_direction, 270 * degree, 1e-9);
  const double volume = 40 * 30 * 15 * (1 - std::tan(40 * degree));
  // A cell of three sets is spacing^3 / |n1 . n2 x n3|; 64 blocks are 27 cells and those that the
  // outline cuts; the spacing is rounded to 0.1 m.
  const double skew = std::sin(40 * degree) * std::sin(85 * degree);
  EXPECT_NEAR(sets[0].mean_spacing, std::cbrt(volume / 27 * skew), 0.05);
  EXPECT_TRUE(assumed_joint_sets(even_slope(), area, 40 * degree, 64, {}).empty());
}

// The plane comes out between two rows of nodes, at y = 51.
TEST(MassOutline, EndsWhereThePlaneComesOutOfTheGround) {
  const double rise = 1 - std::tan(30 * degree);
  double area = 0, volume = 0;
  for (const MassPiece& piece : mass_above(even_slope(), rectangle(31, 40, 71, 70.5),
                                           {{{30 * degree, 180 * degree}, {10, 51, 51}}})) {
    volume += piece.volume;
    area += area_of(Area{{piece.outline}});
    for (const Vec2& p : piece.outline) {
      EXPECT_GE(p.y(), 51 - 1e-9);
      EXPECT_LE(p.y(), 70.5 + 1e-9);
    }
  }
  EXPECT_NEAR(area, 40 * 19.5, 1e-9);
  EXPECT_NEAR(volume, 40 * rise * 19.5 * 19.5 / 2, 1e-9);
}

// Two planes that meet in a level line along the fall: the higher one carries the mass, and each
// half of it is a wedge with its closed form.
TEST(MassOutline, LiesOnTheHigherOfItsPlanes) {
  const Trn ground = grid(60, 60, 2, [](double, double) { return 20.0; });
  double volume[2] = {0, 0};
  for (const MassPiece& piece : mass_above(
           ground, rectangle(20, 33, 80, 77),
           {{{45 * degree, 90 * degree}, {50, 0, 5}}, {{45 * degree, 270 * degree}, {50, 0, 5}}}))
    volume[piece.plane] += piece.volume;
  for (const double half : volume) EXPECT_NEAR(half, 44 * 15 * 15 / 2.0, 1e-8);
}
