// Strength of small blocks under point loads.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "motion/rotation.hpp"
#include "setup/crushing.hpp"
#include "verify/cases/cases.hpp"

namespace {

using namespace talus;
using namespace talus::cases;

constexpr double pi = std::numbers::pi;

// A core of 50 mm fails at I_s50 D_e^2, I_s50 a 23rd of the uniaxial strength; ten times the size
// carries 10^1.55 times the load.
TEST(PointLoadStrength, IsThatOfTheStandardCoreAndGrowsWithSizeToThePower155) {
  EXPECT_NEAR(point_load_strength(100e6, 0.05), 100e6 / 23 * 0.0025, 1e-6);
  EXPECT_NEAR(point_load_strength(100e6, 0.5) / point_load_strength(100e6, 0.05),
              std::pow(10, 1.55), 1e-12);
  EXPECT_NEAR(point_load_strength(100e6, 1), 1.1292e6, 1e2);
}

TEST(SectionArea, OfABoxAtAnyTiltIsExact) {
  const Polyhedron body = box(Vec3(-1, -2, -3), Vec3(1, 2, 3));
  EXPECT_NEAR(section_area(body, {Vec3::UnitZ(), 0.7}), 8, 1e-12);
  EXPECT_NEAR(section_area(body, {Vec3::UnitX(), -0.3}), 24, 1e-12);
  const Vec3 tilted = Vec3(0, 1, 1).normalized();  // across y and z, 2 wide in x
  EXPECT_NEAR(section_area(body, {tilted, 0}), 2 * 4 * std::sqrt(2.0), 1e-12);
  EXPECT_EQ(section_area(body, {Vec3::UnitZ(), 3.1}), 0);
}

// Of a body that is not convex: a U with two legs of 1 m2.
TEST(SectionArea, OfABodyThatIsNotConvexSumsItsPieces) {
  Polyhedron legs = box(Vec3(0, 0, 0), Vec3(1, 1, 4));
  const Polyhedron other = box(Vec3(3, 0, 0), Vec3(4, 1, 4));
  for (int f = 0; f < n_faces(other); ++f) {
    std::vector<int> loop;
    for (const int v : face(other, f)) loop.push_back(v + 8);
    add_face(legs, loop, 0);
  }
  legs.vertices.insert(legs.vertices.end(), other.vertices.begin(), other.vertices.end());
  EXPECT_NEAR(section_area(legs, {Vec3::UnitZ(), 2}), 2, 1e-12);
}

TEST(EquivalentCoreDiameter, IsOfTheLeastSectionWhateverTheAttitude) {
  const Mat3 turn = rotation_by(Vec3(0.3, -1.1, 0.7)).toRotationMatrix();
  const Polyhedron plate = moved(box(Vec3(0, 0, 0), Vec3(3, 2, 0.5)), turn, Vec3::Zero());
  BlockSet set;
  set.material_names = {"rock"};
  add_body(set, body_of(plate));
  Scene scene;
  add_blocks(scene, set, std::vector<Material>(1));
  EXPECT_NEAR(equivalent_core_diameter(block_shell(set, 0), scene.blocks.rest[0]),
              std::sqrt(4 * 1.0 / pi), 1e-9);
}

/// Five blocks of 8 m3 and one cube of `side`.
struct Six {
  explicit Six(double side) {
    set.material_names = {"rock"};
    for (int i = 0; i < 5; ++i)
      add_body(set, body_of(box(Vec3(5 * i, 0, 0), Vec3(5 * i + 2, 2, 2))));
    add_body(set, body_of(box(Vec3(0, 10, 0), Vec3(side, 10 + side, side))));
    add_blocks(scene, set, std::vector<Material>(1));
  }
  BlockSet set;
  Scene scene;
};

TEST(CrushLoads, OnlyBlocksBelowTheShareOfTheMedianAreCrushed) {
  const Six small(0.5), larger(1);
  const std::vector<Crushing> rock = {{100e6, 0.1}};
  const std::vector<double> loads = crush_loads(small.set, small.scene.blocks, rock, 6);
  ASSERT_EQ(loads.size(), 6u);
  for (int b = 0; b < 5; ++b) EXPECT_TRUE(std::isinf(loads[b])) << b;
  EXPECT_NEAR(loads[5], point_load_strength(100e6, std::sqrt(4 * 0.25 / pi)), 1e-3);
  EXPECT_TRUE(crush_loads(larger.set, larger.scene.blocks, rock, 6).empty());
  const std::vector<Crushing> never = {{0, 0.1}};
  EXPECT_TRUE(crush_loads(small.set, small.scene.blocks, never, 6).empty());
}

// The median of 8 and 0.125 m3 is 4.06 m3.
TEST(CrushLoads, TheMedianOfTwoBlocksIsTheirMean) {
  BlockSet set;
  Scene scene;
  add_body(set, body_of(box(Vec3(0, 0, 0), Vec3(2, 2, 2))));
  add_body(set, body_of(box(Vec3(0, 10, 0), Vec3(0.5, 10.5, 0.5))));
  add_blocks(scene, set, std::vector<Material>(1));
  // 0.02 of 8 m3 is more than the small block has, 0.02 of 4.06 m3 is less.
  EXPECT_TRUE(crush_loads(set, scene.blocks, std::vector<Crushing>{{100e6, 0.02}}, 2).empty());
  EXPECT_FALSE(crush_loads(set, scene.blocks, std::vector<Crushing>{{100e6, 0.04}}, 2).empty());
}

}  // namespace
