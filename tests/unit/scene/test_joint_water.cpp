// Water pressure in joints: closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/units.hpp"
#include "scene/joint_water.hpp"
#include "verify/cases/cases.hpp"

namespace {

using namespace talus;
using namespace talus::cases;

constexpr double weight = 1e4;  // of water [N/m3]

std::vector<double> level(const Scene& scene, double z) {
  return std::vector<double>(scene.ground.trn.elevation.size(), z);
}

Polyhedron tagged(Polyhedron body, int tag) {
  body.face_tag.assign(body.face_tag.size(), tag);
  return body;
}

Vec3 force_on(const Scene& scene, int b) {
  Vec3 sum = Vec3::Zero();
  for (const PointLoad& load : scene.loads)
    if (load.block == b) sum += load.force;
  return sum;
}

Vec3 couple_on(const Scene& scene, int b) {
  Vec3 sum = Vec3::Zero();
  for (const PointLoad& load : scene.loads)
    if (load.block == b) sum += (scene.blocks.rest[b].attitude * load.point).cross(load.force);
  return sum;
}

Scene two_cubes() {
  return scene_of(plane_trn(slope_frame(0, 0), 1, 10), ground_of(30),
                  {body_of(tagged(box(Vec3(-2, -1, 0), Vec3(0, 1, 2)), 0)),
                   body_of(tagged(box(Vec3(0, -1, 0), Vec3(2, 1, 2)), 0))},
                  {});
}

// Two cubes of side 2 side by side on level ground, water to 1.5 m: 1.5 m of head on either base of
// 4 m2, and w 1.5^2 / 2 on 2 m of the joint, half a metre above its foot.
TEST(JointWater, LiftsAndThrusts) {
  Scene scene = two_cubes();
  JointWater water;
  water.unit_weight = weight;
  water.surface = level(scene, 1.5);
  add_joint_water(water, scene);
  EXPECT_EQ(scene.wet_faces.size(), 3u);
  const double thrust = weight * 1.5 * 1.5 / 2 * 2, lift = weight * 1.5 * 4;
  EXPECT_NEAR((force_on(scene, 0) - Vec3(-thrust, 0, lift)).norm(), 0, 1e-8 * lift);
  EXPECT_NEAR((force_on(scene, 1) - Vec3(thrust, 0, lift)).norm(), 0, 1e-8 * lift);
  // half a metre below the centroids
  EXPECT_NEAR((couple_on(scene, 1) - Vec3(0, -0.5 * thrust, 0)).norm(), 0, 1e-8 * lift);
}

// Dry where it leaves the base, full where it stands at the top of the joint, 2 m above.
TEST(JointWater, HasARange) {
  JointWater water;
  water.unit_weight = weight;
  const Scene dry = two_cubes();
  water.surface = level(dry, 1.5);
  const WaterRange range = water_range(water, dry);
  EXPECT_NEAR(range.dry, -1.5, 1e-12);
  EXPECT_NEAR(range.full, 0.5, 1e-12);
  for (const double beyond : {-1e-6, 1e-6}) {
    Scene scene = two_cubes();
    water.surface = level(scene, 1.5 + range.dry + beyond);
    add_joint_water(water, scene);
    EXPECT_EQ(scene.wet_faces.empty(), beyond < 0);
  }
  water.of_set = {JointFill::crack};
  water.crack_fill = 0.5;
  water.surface.clear();
  EXPECT_NEAR(water_range(water, dry).full, 1.5, 1e-12);
}

TEST(JointWater, IsNotInDrainedSets) {
  Scene scene = two_cubes();
  JointWater water;
  water.unit_weight = weight;
  water.surface = level(scene, 1.5);
  water.of_set = {JointFill::drained};
  add_joint_water(water, scene);
  EXPECT_TRUE(scene.loads.empty());
}

// Cracks are filled above their own lowest point, whatever the piezometric surface: the joint of
// two piles of two cubes is one crack, and its upper half has the head that is left there.
TEST(JointWater, StandsInACrackAboveItsFoot) {
  std::vector<Body> bodies;
  for (const double x : {-2.0, 0.0})
    for (const double z : {0.0, 2.0}) {
      Body body = body_of(box(Vec3(x, -1, z), Vec3(x + 2, 1, z + 2)));
      for (int f = 0; f < 6; ++f) body.parts[0].face_tag[f] = f < 2 ? 1 : 0;  // x: set 1
      bodies.push_back(body);
    }
  Scene scene = scene_of(plane_trn(slope_frame(0, 0), 1, 10), ground_of(30), bodies, {});
  JointWater water;
  water.unit_weight = weight;
  water.of_set = {JointFill::surface, JointFill::crack};
  water.crack_fill = 3;
  add_joint_water(water, scene);
  EXPECT_EQ(scene.wet_faces.size(), 2u);
  const double below = weight * (3 * 2 - 2) * 2, above = weight * 0.5 * 2;
  EXPECT_NEAR((force_on(scene, 0) - Vec3(-below, 0, 0)).norm(), 0, 1e-8 * below);
  EXPECT_NEAR((force_on(scene, 1) - Vec3(-above, 0, 0)).norm(), 0, 1e-8 * below);
  EXPECT_NEAR((force_on(scene, 2) - Vec3(below, 0, 0)).norm(), 0, 1e-8 * below);
}

// What is poured into a full crack runs over.
TEST(JointWater, RunsOverTheTopOfACrack) {
  for (const double fill : {2.0, 7.0}) {
    Scene scene = two_cubes();
    JointWater water;
    water.unit_weight = weight;
    water.of_set = {JointFill::crack};
    water.crack_fill = fill;
    add_joint_water(water, scene);
    EXPECT_NEAR(std::abs(force_on(scene, 0).x()), weight * 2 * 2 / 2 * 2, 1e-6 * weight);
    EXPECT_NEAR(water_range(water, scene).full, 2 - fill, 1e-12);
  }
}

// A mass of even upright thickness on a slope, piezometric surface at a depth below its top: the
// head on its base is the rest of the thickness, all over it; the top and the sides are dry.
TEST(JointWater, IsSoDeepBelowTheTop) {
  const SlopeFrame frame = slope_frame(25, 30);
  const double thick = 2, depth = 0.7;
  Polyhedron mass = tagged(box(Vec3(-3, -2, 0), Vec3(3, 2, thick)), face_terrain);
  for (Vec3& v : mass.vertices)
    v = v.x() * frame.dip + v.y() * frame.strike + v.z() * Vec3::UnitZ();
  Scene scene = scene_of(plane_trn(frame, 0.5, 10), ground_of(30), {body_of(mass)}, {});
  JointWater water;
  water.unit_weight = weight;
  water.depth = depth;
  add_joint_water(water, scene);
  const Vec3 exact = weight * (thick - depth) * 24 * frame.normal;
  EXPECT_NEAR((force_on(scene, 0) - exact).norm(), 0, 1e-6 * exact.norm());
}

// Ground of 45 degrees over a bed of 25 that comes out at x = 0; the tension crack 20 m behind is
// filled to 3 m, and under the mass the head falls from there to none at the toe. Walls to the
// sides press against each other.
TEST(WaterOnMass, IsTheUpliftAndTheThrustOfHoekAndBray) {
  const double fill = 3, length = 20, width = 16;
  const auto bed_at = [](double x) { return -x * std::tan(25 * degree); };
  const Trn ground = make_trn([](double x, double) { return -x; }, 2, 40);
  const Trn bed = make_trn([&](double x, double) { return std::min(-x, bed_at(x)); }, 2, 40);
  JointWater water;
  water.unit_weight = weight;
  water.of_side = JointFill::crack;
  water.crack_fill = fill;
  water.surface =
      make_trn([&](double x, double) { return bed_at(x) - fill * x / length; }, 2, 40).elevation;
  const Area area{{{{-length, -8}, {0, -8}, {0, 8}, {-length, 8}}}};
  const Vec3 lift = weight * fill / 2 * length * width * Vec3(std::tan(25 * degree), 0, 1);
  const Vec3 thrust = weight * fill * fill / 2 * width * Vec3::UnitX();
  Area clockwise = area;
  std::reverse(clockwise.rings[0].begin(), clockwise.rings[0].end());
  for (const Area& drawn : {area, clockwise}) {
    const Vec3 found = water_on_mass(water, ground, bed, drawn);
    EXPECT_NEAR((found - lift - thrust).norm() / lift.norm(), 0, 1e-9) << found.transpose();
  }
  // a crack runs over at its top
  water.crack_fill = 100;
  const double wall = length * (1 - std::tan(25 * degree));
  const Vec3 full = weight * wall * wall / 2 * width * Vec3::UnitX();
  EXPECT_NEAR((water_on_mass(water, ground, bed, area) - lift - full).norm() / full.norm(), 0,
              1e-9);
  water.of_side = JointFill::drained;
  EXPECT_NEAR((water_on_mass(water, ground, bed, area) - lift).norm() / lift.norm(), 0, 1e-9);
}

}  // namespace
