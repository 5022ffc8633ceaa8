// Depth of bodies in the ground, against closed forms and sampling.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "contact/ground_depth.hpp"
#include "convex_bodies.hpp"

namespace {

using namespace talus;
using namespace talus::test;

// Nodes `cell` apart around the local zero, heights by a function.
Trn trn_of(const std::function<double(double, double)>& height, double cell, int half) {
  Trn trn;
  trn.n_rows = trn.n_cols = 2 * half + 1;
  trn.cell_size = cell;
  trn.node0 = Vec2(-half * cell, half * cell);
  for (int row = 0; row < trn.n_rows; ++row)
    for (int col = 0; col < trn.n_cols; ++col)
      trn.elevation.push_back(height(cell * (col - half), cell * (half - row)));
  return trn;
}

double depth_of(const Trn& trn, const Bodies& bodies) {
  GroundDepthScratch scratch;
  return depth_in_ground(trn, bodies.hulls, bodies.placed, 0, scratch);
}

Bodies placed_box(const Vec3& half, const Pose& pose) {
  Bodies bodies;
  add(bodies, box(-half, half), pose);
  place(bodies);
  return bodies;
}

// Above the ground 0; below a slope along its normal.
TEST(GroundDepth, IsThatAlongTheNormalOfAPlane) {
  for (const double fall : {0.0, 0.4, 1.4}) {
    const Trn trn =
        trn_of([fall](double x, double y) { return -fall * (0.6 * x + 0.8 * y); }, 1, 20);
    const Vec3 normal = Vec3(0.6 * fall, 0.8 * fall, 1).normalized();
    const Quat turn = Quat::FromTwoVectors(Vec3::UnitZ(), normal);
    for (const double deep : {-0.1, 0.0, 0.05, 0.3}) {
      const Bodies bodies = placed_box({1, 1, 0.5}, {(0.5 - deep) * normal, turn});
      EXPECT_NEAR(depth_of(trn, bodies), std::max(deep, 0.0), 2e-6) << fall;
    }
  }
}

// A corner just below the brink of a step of 3 m is as deep as it is behind the wall, not as the
// top is above it.
TEST(GroundDepth, OfACornerBehindAWallIsTheDistanceFromTheWall) {
  const auto step = [](double x, double) { return x < 0 ? 3.0 : 0.0; };  // falls from x = -1 to 0
  const Trn trn = trn_of(step, 1, 20);
  const double normal_x = 3 / std::sqrt(10.0), normal_z = 1 / std::sqrt(10.0);
  const Vec3 corner = Vec3(-0.6, 0, 1.8) - 0.05 * Vec3(normal_x, 0, normal_z);
  const Bodies bodies = placed_box({1, 0.2, 0.2}, {corner + Vec3(1, 0.2, 0.2), Quat::Identity()});
  EXPECT_NEAR(depth_of(trn, bodies), 0.05, 1e-6);
}

// A ridge in a plate, whose corners are all above the ground, and a peak in it.
TEST(GroundDepth, CountsWhatStandsInTheBody) {
  const Trn ridge = trn_of([](double x, double) { return -std::abs(x); }, 2, 20);
  const Trn peak = trn_of([](double x, double y) { return -std::abs(x) - std::abs(y); }, 2, 20);
  const Bodies plate = placed_box({1.5, 1.5, 0.3}, {Vec3(0, 0, 0.3 - 0.12), Quat::Identity()});
  EXPECT_NEAR(depth_of(ridge, plate), 0.12, 1e-6);
  EXPECT_NEAR(depth_of(peak, plate), 0.12, 1e-6);
}

// A ridge under the seam between two parts is not outside of them.
TEST(GroundDepth, InsideABodyOfTwoPartsIsNotBesideThem) {
  const Trn ridge = trn_of([](double x, double) { return -std::abs(x); }, 2, 20);
  const Vec3 shift(0, 0, -0.12);
  Bodies bodies;
  const std::vector<Polyhedron> halves = {box(Vec3(-1.5, -1.5, 0), Vec3(0.01, 1.5, 0.6)),
                                          box(Vec3(0.01, -1.5, 0), Vec3(1.5, 1.5, 0.6))};
  add(bodies, halves, {shift, Quat::Identity()});
  place(bodies);
  EXPECT_NEAR(depth_of(ridge, bodies), 0.12, 2e-6);
}

// Never less than any point found by sampling, and not more than the lift that frees the body.
TEST(GroundDepth, HoldsAgainstSampling) {
  Draws random(5);
  const auto rough = [](double x, double y) {
    return std::sin(12.9898 * x) * std::cos(78.233 * y);
  };
  const Trn trn = trn_of(rough, 1, 20);
  int n_deep = 0;
  for (int i = 0; i < 200; ++i) {
    const Vec3 half(uniform(random, 0.1, 1), uniform(random, 0.1, 1), uniform(random, 0.1, 1));
    const Pose pose{Vec3(uniform(random, -5, 5), uniform(random, -5, 5), uniform(random, 0, 1.5)),
                    attitude(random)};
    const double depth = depth_of(trn, placed_box(half, pose));
    double sampled = 0;
    for (double x = -2; x <= 2; x += 0.1)
      for (double y = -2; y <= 2; y += 0.1) {
        const Vec2 at = pose.position.head<2>() + Vec2(x, y);
        const Vec3 ground(at.x(), at.y(), elevation_at(trn, at.x(), at.y()));
        const Vec3 inside =
            half - (pose.attitude.conjugate() * (ground - pose.position)).cwiseAbs();
        sampled = std::max(sampled, inside.minCoeff());
      }
    EXPECT_GE(depth, sampled - 1e-5) << i;
    n_deep += sampled > 0.02;
  }
  EXPECT_GT(n_deep, 50);
}

}  // namespace
