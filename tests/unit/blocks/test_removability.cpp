// Removable blocks: joint pyramids, modes, order of removal.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "blocks/joint_sets.hpp"
#include "blocks/removability.hpp"
#include "scenes.hpp"

namespace {

using namespace talus;
using namespace talus::test;

Vec3 random_unit(Random& random) {
  return Vec3(random.normal(), random.normal(), random.normal()).normalized();
}

RestPlane on(double dip_deg, double direction_deg, double phi_deg) {
  return {pole(dip_deg * degree, direction_deg * degree), std::tan(phi_deg * degree), 0};
}

const Vec3 weight = -Vec3::UnitZ();

// The projection of a force on the pyramid, by trying all sets of up to three planes in contact:
// the remaining force points into no plane, and no plane pulls.
Vec3 projected(const Vec3& force, const std::vector<Vec3>& normals) {
  constexpr double tiny = 1e-9;
  for (unsigned set = 0; set < 1u << normals.size(); ++set) {
    if (std::popcount(set) > 3) continue;
    Eigen::Matrix<double, 3, Eigen::Dynamic> bearing(3, std::popcount(set));
    for (size_t k = 0, at = 0; k < normals.size(); ++k)
      if (set >> k & 1) bearing.col(static_cast<Eigen::Index>(at++)) = normals[k];
    Vec3 left = force;
    if (set != 0) {
      const Eigen::VectorXd forces =
          (bearing.transpose() * bearing).ldlt().solve(-bearing.transpose() * force);
      if (forces.minCoeff() < -tiny) continue;
      left += bearing * forces;
    }
    const bool goes_into_none = std::all_of(normals.begin(), normals.end(),
                                            [&](const Vec3& n) { return n.dot(left) >= -tiny; });
    if (goes_into_none) return left;
  }
  ADD_FAILURE() << "no projection";
  return force;
}

double trend_deg(const Vec3& v) { return std::fmod(std::atan2(v.x(), v.y()) / degree + 360, 360); }
double plunge_deg(const Vec3& v) { return std::asin(-v.z() / v.norm()) / degree; }

// n cubes of weight 1 in a row on a plane that dips `dip`, each resting on the plane and against
// the one in front; `ahead` is before the first.
std::vector<std::vector<BlockContact>> row_of_cubes(int n, double dip_deg,
                                                    const std::vector<BlockContact>& ahead) {
  const double tangent = std::tan(30 * degree), dip = dip_deg * degree;
  const Vec3 down(0, -std::cos(dip), -std::sin(dip));
  std::vector<std::vector<BlockContact>> contacts(n);
  for (int b = 0; b < n; ++b) {
    contacts[b].push_back({-1, {pole(dip, 180 * degree), tangent, 0}, 1});
    if (b > 0) contacts[b].push_back({b - 1, {-down, tangent, 0}, 1});
    if (b + 1 < n) contacts[b].push_back({b + 1, {down, tangent, 0}, 1});
  }
  contacts[0].insert(contacts[0].end(), ahead.begin(), ahead.end());
  return contacts;
}

}  // namespace

// K planes in general position part space into K^2 - K + 2 pyramids that are not empty.
TEST(JointPyramid, AsManyAreNotEmptyAsPlanesMakeRegions) {
  Random random(5, "pyramids");
  for (const int n : {3, 4, 5}) {
    std::vector<Vec3> planes;
    for (int k = 0; k < n; ++k) planes.push_back(random_unit(random));
    int count = 0;
    for (int code = 0; code < 1 << n; ++code) {
      std::vector<Vec3> normals;
      for (int k = 0; k < n; ++k) normals.push_back(code >> k & 1 ? planes[k] : Vec3(-planes[k]));
      count += can_leave(normals);
    }
    EXPECT_EQ(count, n * n - n + 2);
  }
}

// A pyramid is empty when the projections of all six directions of the axes vanish.
TEST(JointPyramid, IsEmptyWhereNothingProjectsOnIt) {
  Random random(6, "projections");
  int n_empty = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    std::vector<RestPlane> planes;
    std::vector<Vec3> normals;
    const int n = 2 + static_cast<int>(random.below(7));
    for (int k = 0; k < n; ++k) {
      normals.push_back(random_unit(random));
      planes.push_back({normals.back(), 0, 0});
    }
    bool is_empty = true;
    for (int axis = 0; axis < 3; ++axis)
      for (const double side : {-1.0, 1.0})
        is_empty &= !block_mode(side * Vec3::Unit(axis), planes).is_free();
    EXPECT_EQ(can_leave(normals), !is_empty);
    n_empty += is_empty;
  }
  EXPECT_GT(n_empty, 300);
  EXPECT_LT(n_empty, 2700);
}

TEST(JointPyramid, OfParallelPlanesLeavesTheirOwnDirections) {
  EXPECT_TRUE(can_leave(std::array<Vec3, 2>{Vec3::UnitX(), -Vec3::UnitX()}));
  EXPECT_TRUE(can_leave(std::vector<Vec3>{}));
}

// Of the eight kinds of blocks of three sets one alone is finite at the face and can leave it.
TEST(JointPyramid, OneKindOfBlockCanLeaveTheFace) {
  const std::array<Vec3, 3> sets = {pole(45 * degree, 120 * degree),
                                    pole(50 * degree, 220 * degree),
                                    pole(80 * degree, 350 * degree)};
  const Vec3 rock_side = -pole(65 * degree, 170 * degree);
  std::vector<int> removable;
  for (int code = 0; code < 8; ++code) {  // bit k set: below set k
    std::vector<Vec3> joints;
    for (int k = 0; k < 3; ++k) joints.push_back(code >> k & 1 ? Vec3(-sets[k]) : sets[k]);
    std::vector<Vec3> block = joints;
    block.push_back(rock_side);
    if (!can_leave(block) && can_leave(joints)) removable.push_back(code);
  }
  ASSERT_EQ(removable, std::vector<int>{4});
  const std::array<RestPlane, 3> planes = {
      on(45, 120, 30), on(50, 220, 30), {-sets[2], std::tan(30 * degree), 0}};
  const BlockMode mode = block_mode(weight, planes);
  EXPECT_EQ(mode.bearing, (std::vector<int>{0, 1}));
  EXPECT_NEAR(trend_deg(mode.direction), 165.8, 0.05);
  EXPECT_NEAR(plunge_deg(mode.direction), 34.9, 0.05);
  EXPECT_NEAR(mode.factor(), 1.0017, 5e-5);
}

TEST(BlockMode, WedgesHaveTheirKnownFactors) {
  const auto of = [](RestPlane one, RestPlane other) {
    return block_mode(weight, std::array<RestPlane, 2>{one, other});
  };
  const BlockMode first = of(on(45, 105, 20), on(52, 235, 30));
  EXPECT_NEAR(trend_deg(first.direction), 166.72, 0.005);
  EXPECT_NEAR(plunge_deg(first.direction), 25.35, 0.005);
  EXPECT_NEAR(first.factor(), 1.325319, 5e-7);
  const BlockMode second = of(on(45, 105, 30), on(70, 235, 20));
  EXPECT_NEAR(trend_deg(second.direction), 157.73, 0.005);
  EXPECT_NEAR(plunge_deg(second.direction), 31.20, 0.005);
  EXPECT_NEAR(second.factor(), 1.233509, 5e-7);
  const BlockMode symmetric = of(on(60, 130, 30), on(60, 230, 30));
  EXPECT_NEAR(symmetric.factor(), 0.6930475, 5e-8);
  const BlockMode single = of(on(40, 180, 30), on(70, 150, 30));
  EXPECT_EQ(single.bearing, std::vector<int>{0});
  EXPECT_NEAR(single.factor(), std::tan(30 * degree) / std::tan(40 * degree), 1e-12);
}

TEST(BlockMode, IsTheProjectionOnWhatIsLeftFree) {
  Random random(8, "modes");
  for (int trial = 0; trial < 500; ++trial) {
    std::vector<RestPlane> planes;
    std::vector<Vec3> normals;
    const int n = 1 + static_cast<int>(random.below(6));
    for (int k = 0; k < n; ++k) {
      normals.push_back(random_unit(random));
      planes.push_back({normals.back(), random.uniform(0, 1), 0});
    }
    const Vec3 slip = projected(weight, normals);
    const BlockMode mode = block_mode(weight, planes);
    ASSERT_NEAR((mode.direction - slip).norm(), 0, 1e-8) << trial;
    // The forces on the planes in contact close the balance, and none pulls.
    if (!mode.is_free()) continue;
    const Vec3 missing = mode.direction - weight;
    Eigen::Matrix<double, 3, Eigen::Dynamic> bearing(3, mode.bearing.size());
    for (size_t k = 0; k < mode.bearing.size(); ++k)
      bearing.col(static_cast<Eigen::Index>(k)) = normals[mode.bearing[k]];
    if (mode.bearing.empty()) continue;
    const Eigen::VectorXd forces =
        (bearing.transpose() * bearing).ldlt().solve(bearing.transpose() * missing);
    EXPECT_NEAR((bearing * forces - missing).norm(), 0, 1e-9);
    EXPECT_GE(forces.minCoeff(), -1e-9);
    double resistance = 0;
    for (size_t k = 0; k < mode.bearing.size(); ++k)
      resistance += forces[static_cast<Eigen::Index>(k)] * planes[mode.bearing[k]].friction;
    EXPECT_NEAR(mode.resistance, resistance, 1e-9);
  }
}

TEST(BlockMode, CohesionHoldsWhatFrictionDoesNot) {
  RestPlane plane = on(40, 180, 30);
  EXPECT_TRUE(block_mode(weight, std::array<RestPlane, 1>{plane}).goes());
  plane.cohesion = 0.3;
  EXPECT_FALSE(block_mode(weight, std::array<RestPlane, 1>{plane}).goes());
  EXPECT_TRUE(block_mode(weight, {}).goes());  // nothing under it: it falls
}

TEST(Merged, NearlyTheSameNormalsAreOnePlane) {
  const std::vector<BlockContact> contacts = {
      {1, on(40, 180, 30), 3}, {2, on(40.5, 180, 20), 1}, {3, on(45, 180, 20), 1}};
  const std::vector<RestPlane> planes = merged(contacts);
  ASSERT_EQ(planes.size(), 2u);
  EXPECT_NEAR(planes[0].friction, (3 * std::tan(30 * degree) + std::tan(20 * degree)) / 4, 1e-12);
}

TEST(PeelOff, CubesInARowGoOneAfterTheOther) {
  const std::vector<double> weights(5, 1.0);
  const PeelOff free = peel_off(row_of_cubes(5, 35, {}), weights);
  EXPECT_EQ(free.round, (std::vector<int>{0, 1, 2, 3, 4}));
  EXPECT_NEAR(free.share, 1, 1e-12);
  EXPECT_NEAR(free.mode[0].factor(), 0.824542, 5e-7);
  EXPECT_TRUE(free.locks.empty());
  EXPECT_EQ(peel_off(row_of_cubes(5, 25, {}), weights).share, 0);
}

TEST(PeelOff, WhatStandsBeforeTheFirstHoldsThemAll) {
  const std::vector<double> weights(5, 1.0);
  const double dip = 35 * degree;
  const Vec3 wall(0, std::cos(dip), std::sin(dip));
  const PeelOff held = peel_off(row_of_cubes(5, 35, {{-1, {wall, 1, 0}, 1}}), weights);
  EXPECT_EQ(held.share, 0);
  ASSERT_FALSE(held.locks.empty());
  EXPECT_EQ(held.locks[0].block, 0);
  EXPECT_NEAR(held.locks[0].freed, 0.8, 1e-12);
  // a bed at the foot turned up against the motion
  const auto turned = [&](double by_deg) {
    return peel_off(row_of_cubes(5, 35, {{-1, on(35 - by_deg, 180, 30), 1}}), weights);
  };
  EXPECT_EQ(turned(20).share, 0);
  EXPECT_NEAR(turned(20).mode[0].factor(), 2.1547, 5e-5);
  EXPECT_FALSE(turned(40).mode[0].is_free());
  EXPECT_EQ(turned(40).share, 0);
}
