// Joint sets: drawn planes and discs, expected cells, sets from measured poles.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "base/error.hpp"
#include "blocks/cut.hpp"
#include "blocks/joint_sets.hpp"
#include "scenes.hpp"

namespace {

using namespace talus;
using namespace talus::test;

}  // namespace

TEST(Pole, FollowsTheGeologistsConvention) {
  // Dipping 30 degrees to the east: the normal leans east, water runs east.
  const Vec3 east = pole(30 * degree, 90 * degree);
  EXPECT_LT((east - Vec3(0.5, 0, std::sqrt(0.75))).norm(), 1e-15);
  EXPECT_EQ(pole(90 * degree, 90 * degree), Vec3(1, 0, 0));  // exactly: a grid line is a grid line
  EXPECT_EQ(pole(90 * degree, 0), Vec3(0, 1, 0));
  EXPECT_EQ(pole(0, 123 * degree), Vec3(0, 0, 1));
  Random random(1);
  for (int trial = 0; trial < 200; ++trial) {
    const double dip = random.uniform(0.01, 89.9) * degree,
                 azimuth = random.uniform(0, 360) * degree;
    const Attitude found = attitude(-pole(dip, azimuth));
    EXPECT_NEAR(found.dip, dip, 1e-12);
    EXPECT_NEAR(found.dip_direction, azimuth, 1e-11);
  }
}

TEST(DrawSpacing, HasTheMeanAndTheSpreadOfItsDistribution) {
  Random random(2);
  constexpr int n = 100000;
  struct Case {
    Spacing kind;
    double a, b, mean, deviation;
  };
  for (const Case& c :
       {Case{Spacing::fixed, 0, 0, 3, 0}, Case{Spacing::uniform, 1, 5, 3, 4 / std::sqrt(12.0)},
        Case{Spacing::exponential, 0, 0, 3, 3}, Case{Spacing::lognormal, 2, 0, 3, 2}}) {
    JointSet set;
    set.spacing = c.kind, set.mean_spacing = 3, set.spacing_a = c.a, set.spacing_b = c.b;
    double sum = 0, sum_sq = 0;
    for (int i = 0; i < n; ++i) {
      const double s = draw_spacing(set, random);
      EXPECT_GE(s, 0);
      sum += s, sum_sq += s * s;
    }
    EXPECT_NEAR(sum / n, c.mean, 0.03);
    EXPECT_NEAR(std::sqrt(std::max(0.0, sum_sq / n - sum * sum / n / n)), c.deviation, 0.06);
  }
}

// Mean resultant of the Fisher density: coth k - 1 / k.
TEST(DrawFisher, HasTheConcentrationAskedFor) {
  Random random(3);
  const Vec3 mean = Vec3(1, 2, 3).normalized();
  for (const double k : {2.0, 20.0, 500.0}) {
    Vec3 sum = Vec3::Zero();
    constexpr int n = 40000;
    for (int i = 0; i < n; ++i) {
      const Vec3 drawn = draw_fisher(mean, k, random);
      ASSERT_NEAR(drawn.norm(), 1, 1e-14);
      sum += drawn;
    }
    EXPECT_NEAR(sum.norm() / n, 1 / std::tanh(k) - 1 / k, 0.01);
    EXPECT_GT(sum.normalized().dot(mean), 1 - 1e-3);
  }
}

TEST(DrawJoints, AreFixedBySeedAndName) {
  JointSet set = joint_set(40, 120, 3, "a");
  set.spacing = Spacing::exponential, set.fisher_k = 50;
  const auto offsets = [&](const JointSet& s, std::uint64_t seed) {
    std::vector<double> all;
    for (const Joint& joint : draw_joints(s, 0, {1, 2, 3}, 50, seed))
      all.push_back(joint.plane.offset);
    return all;
  };
  EXPECT_EQ(offsets(set, 7), offsets(set, 7));
  EXPECT_NE(offsets(set, 7), offsets(set, 8));
  JointSet other = set;
  other.name = "b";
  EXPECT_NE(offsets(set, 7), offsets(other, 7));
}

TEST(DrawJoints, FixedSpacingAndOffsetAreExact) {
  JointSet set = joint_set(90, 90, 4);
  set.offset = 1;
  std::vector<double> x;
  for (const Joint& joint : draw_joints(set, 0, {10, 0, 0}, 9, 1)) x.push_back(joint.plane.offset);
  std::sort(x.begin(), x.end());
  EXPECT_EQ(x, (std::vector<double>{3, 7, 11, 15}));
}

TEST(DrawJoints, APlaneFarAwayIsOneOfTheSameSet) {
  JointSet set = joint_set(90, 90, 4);
  set.offset = 4e12 + 3;
  std::vector<double> x;
  for (const Joint& joint : draw_joints(set, 0, {10, 0, 0}, 9, 1)) x.push_back(joint.plane.offset);
  std::sort(x.begin(), x.end());
  EXPECT_EQ(x, (std::vector<double>{5, 9, 13, 17}));
}

// Share of a plane that the discs of the Boolean model cover, by random points.
TEST(DrawJoints, DiscsLeaveTheAskedShareOpen) {
  for (const double persistence : {0.2, 0.6, 0.9}) {
    JointSet set = joint_set(0, 0, 1);
    set.persistence = persistence, set.disc_diameter = 4;
    Random random(5);
    int n_open = 0, n_all = 0;
    for (const Joint& joint : draw_joints(set, 0, {0, 0, 0}, 30, 3)) {
      EXPECT_FALSE(joint.is_through);
      for (int i = 0; i < 200; ++i) {
        const double radius = std::sqrt(900 - joint.plane.offset * joint.plane.offset);
        const double reach = radius / std::sqrt(2.0);
        const Vec3 p(random.uniform(-reach, reach), random.uniform(-reach, reach),
                     joint.plane.offset);
        ++n_all;
        n_open += std::any_of(joint.discs.begin(), joint.discs.end(), [&](const Disc& disc) {
          return (p - disc.centre).norm() <= disc.radius;
        });
      }
    }
    EXPECT_NEAR(static_cast<double>(n_open) / n_all, persistence, 0.02);
  }
}

// Against the number of joint cells in a box, counted by cutting it.
// Before they are drawn, so that a slip of the pen is refused and not computed.
TEST(ExpectedDiscs, AreAsManyAsAreDrawn) {
  JointSet set;
  set.name = "J";
  set.mean_spacing = 2;
  set.persistence = 0.6;
  set.disc_diameter = 3;
  double n = 0;
  constexpr int n_seeds = 30;
  for (int seed = 0; seed < n_seeds; ++seed)
    for (const Joint& joint : draw_joints(set, 0, Vec3::Zero(), 20, seed))
      n += static_cast<double>(joint.discs.size());
  const double expected = n_seeds * expected_discs(set, 20);
  EXPECT_NEAR(n, expected, 0.06 * expected);  // planes in the ball: 19 or 20 of 20
  set.disc_diameter = 1e-3;
  EXPECT_GT(expected_discs(set, 20), 1e9);
  set.persistence = 1;
  EXPECT_EQ(expected_discs(set, 20), 0);
}

TEST(DrawFisher, IsUniformWhereTheConcentrationVanishes) {
  for (const double k : {1e-300, 1e-12, 9e-4}) {
    Random random(4);
    Vec3 sum = Vec3::Zero();
    constexpr int n = 20000;
    for (int i = 0; i < n; ++i) sum += draw_fisher(Vec3::UnitZ(), k, random);
    EXPECT_LT(sum.norm() / n, 4 / std::sqrt(double{n})) << k;
  }
}

TEST(ExpectedCells, IsThatOfTheArrangement) {
  const std::vector<JointSet> four = {joint_set(30, 90, 3, "a"), joint_set(80, 20, 4, "b"),
                                      joint_set(70, 200, 5, "c"), joint_set(50, 300, 6, "d")};
  std::vector<JointSet> wide = four;
  for (const size_t s : {2, 3}) wide[s].mean_spacing = 1000, wide[s].offset = 500;
  struct Case {
    std::vector<JointSet> sets;
    Vec3 half;       // of the box [m]
    double largest;  // cells to those expected: cells cut off at the sides come on top
  };
  for (const auto& [sets, half, largest] :
       std::vector<Case>{{four, Vec3::Constant(20), 1.6},
                         {{four[0]}, {20, 30, 40}, 1.1},
                         {{four[0], four[1]}, {20, 30, 40}, 1.3},
                         {wide, {20, 30, 40}, 1.3}}) {
    std::vector<Polyhedron> cells = {box(-half, half)};
    MassMeasure mass{moments(cells[0]).volume, cells[0].vertices, {}};
    for (int f = 0; f < 6; ++f) mass.area_vectors.push_back(face_area_vector(cells[0], f));
    for (const Joint& joint : draw_all(sets, Vec3(0.3, 0.1, 0.2), 90)) {
      std::vector<Polyhedron> next;
      for (const Polyhedron& cell : cells)
        for (const Plane& plane : {joint.plane, flipped(joint.plane)}) {
          Polyhedron half_cell = clip_convex(cell, plane, 0, 1e-9);
          if (n_faces(half_cell) > 0) next.push_back(std::move(half_cell));
        }
      cells = std::move(next);
    }
    const double expected = expected_cells(sets, mass);
    EXPECT_GT(static_cast<double>(cells.size()), expected);
    EXPECT_LT(static_cast<double>(cells.size()), largest * expected);
  }
  EXPECT_EQ(expected_cells({}, {}), 1);
}

TEST(GroupPoles, FindsTheSetsThatWereMixed) {
  Random random(6);
  const std::vector<Vec3> means = {pole(44 * degree, 144 * degree), pole(82 * degree, 324 * degree),
                                   pole(85 * degree, 234 * degree)};
  const std::vector<int> sizes = {600, 400, 200};
  const double k = 80;
  std::vector<Vec3> poles;
  for (size_t m = 0; m < means.size(); ++m)
    for (int i = 0; i < sizes[m]; ++i) {
      const Vec3 p = draw_fisher(means[m], k, random);
      poles.push_back(random.uniform() < 0.5 ? p : Vec3(-p));  // axes have no direction
    }
  const auto groups = group_poles(poles, 3);
  ASSERT_EQ(groups.size(), 3u);
  for (size_t g = 0; g < 3; ++g) {
    EXPECT_EQ(groups[g].members.size(), static_cast<size_t>(sizes[g]));
    EXPECT_GT(std::abs(groups[g].mean.dot(means[g])), std::cos(3 * degree));
    EXPECT_NEAR(groups[g].fisher_k, k, 20);
  }
  EXPECT_THROW(static_cast<void>(group_poles({means[0]}, 2)), InputError);
}
