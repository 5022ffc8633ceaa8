// What the scene plan leaves out, against the same scene with it kept: docs/verification.md,
// Leaving out.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dda/fence.hpp"
#include "dda/step.hpp"
#include "verify/cases.hpp"

namespace {

using namespace talus;
using namespace talus::cases;

constexpr double degree = std::numbers::pi / 180;

double bumps(double x, double y) { return 0.8 * std::sin(0.4 * x) * std::cos(0.5 * y) - 0.5 * x; }

// Slabs that tumble down rough ground, 40 m from one another.
Scene tumbling(const Settings& settings, const GroundClass& ground, int n = 3) {
  std::vector<Body> bodies;
  for (int i = 0; i < n; ++i) {
    const double y = 40.0 * (i - 1);
    const Vec3 low(-60, y, bumps(-60, y) + 2);
    bodies.push_back(body_of(box(low, low + Vec3(1.6, 1.1, 0.7)), Vec3(3, 0.1 * i, 0)));
    bodies.back().spin = Vec3(0.4, 1 + i, 0.2);
  }
  return scene_of(make_trn(bumps, 1, 90), ground, bodies, settings);
}

GroundClass rough() { return ground_of(30, 0.4); }

State run(const Scene& scene, int n_steps) {
  State state = start(scene);
  Work work = make_work(scene);
  for (int i = 0; i < n_steps; ++i) step(scene, state, work);
  return state;
}

void expect_same_bits(const Scene& a, const State& sa, const Scene& b, const State& sb) {
  for (int k = 0; k < n_blocks(a); ++k) {
    const Motion ma = motion_at(a, sa, k, sa.time), mb = motion_at(b, sb, k, sb.time);
    EXPECT_EQ(ma.pose.position, mb.pose.position) << "block " << k;
    EXPECT_EQ(ma.pose.attitude.coeffs(), mb.pose.attitude.coeffs()) << "block " << k;
    EXPECT_EQ(ma.velocity, mb.velocity) << "block " << k;
  }
}

// The search of pairs finds none: each block goes the way of a lone one.
TEST(LeavingOut, ContactsOfBlocksThatDoNotMeet) {
  Settings alone;
  alone.block_contacts = false;
  const Scene a = tumbling({}, rough()), b = tumbling(alone, rough());
  const State sa = run(a, 1200), sb = run(b, 1200);
  EXPECT_GT(sa.counters.impacts, 20);
  expect_same_bits(a, sa, b, sb);
}

// A fence that nothing comes near: panels are fixed bodies of the same search.
TEST(LeavingOut, AFenceThatNothingReaches) {
  Scene a = tumbling({}, rough(), 1);
  const Scene b = tumbling({}, rough(), 1);
  StandingFence fence;
  fence.posts = {Vec3(80, -80, bumps(80, -80)), Vec3(80, -60, bumps(80, -60))};
  fence.depth = {0.5};
  fence.height = 4;
  add_fence(a, fence);
  ASSERT_GT(n_fixed(a), 0);
  const State sa = run(a, 800), sb = run(b, 800);
  EXPECT_GT(sa.counters.impacts, 5);
  expect_same_bits(a, sa, b, sb);
}

// Rocks that pass through each other, seen as balls until they come near a fence, then as they are:
// against the full plan, which follows their turning in every step.
TEST(LeavingOut, RocksAsBallsFarFromAFence) {
  const auto scene_with = [](bool all) {
    Settings settings;
    settings.block_contacts = false;
    settings.flight = !all;
    Scene scene = tumbling(settings, rough());
    StandingFence fence;
    for (double y = -60; y <= 60; y += 10) {
      fence.posts.push_back(Vec3(-25, y, bumps(-25, y)));
      if (y < 60) fence.depth.push_back(0.5);
    }
    fence.height = 4;
    add_fence(scene, fence);
    return scene;
  };
  const Scene a = scene_with(false), b = scene_with(true);
  const State sa = run(a, 1500), sb = run(b, 1500);
  EXPECT_GE(sa.fence.hits.size(), 2U);
  EXPECT_EQ(sa.fence.hits.size(), sb.fence.hits.size());
  EXPECT_GT(sa.counters.flight_skips, 100);
  EXPECT_EQ(sb.counters.flight_skips, 0);
  expect_same_bits(a, sa, b, sb);
}

// A face bonded with no strength to speak of breaks in the first step.
TEST(LeavingOut, CohesionOfNothing) {
  const SlopeFrame frame = slope_frame(30, 37);
  const Body cube = body_of(box_in(frame, Vec3::Zero(), Vec3(-0.5, -0.5, 0), Vec3(0.5, 0.5, 1)));
  GroundClass bare = rough(), bonded = rough();
  bare.friction = bonded.friction = std::tan(20 * degree);
  bonded.cohesion = 1e-9;
  const Scene a = scene_of(plane_trn(frame, 0.5, 20), bare, {cube}, {});
  const Scene b = scene_of(plane_trn(frame, 0.5, 20), bonded, {cube}, {});
  const State sa = run(a, 200), sb = run(b, 200);
  EXPECT_GT(sa.motion[0].velocity.norm(), 1.5);
  EXPECT_LT((sa.motion[0].pose.position - sb.motion[0].pose.position).norm(), 1e-9);
}

// Shear terms of a friction of nothing.
TEST(LeavingOut, FrictionOfNothing) {
  const SlopeFrame frame = slope_frame(30, 37);
  const Body cube = body_of(box_in(frame, Vec3::Zero(), Vec3(-0.5, -0.5, 0), Vec3(0.5, 0.5, 1)));
  GroundClass smooth, nearly;
  nearly.friction = 1e-14;
  const Scene a = scene_of(plane_trn(frame, 0.5, 20), smooth, {cube}, {});
  const Scene b = scene_of(plane_trn(frame, 0.5, 20), nearly, {cube}, {});
  const State sa = run(a, 200), sb = run(b, 200);
  EXPECT_GT(sa.motion[0].velocity.norm(), 4);
  EXPECT_LT((sa.motion[0].pose.position - sb.motion[0].pose.position).norm(), 1e-11);
}

// Ground that might shake and does not: paths are followed step by step instead of in one flight.
// Before the first hit they agree to rounding; bouncing magnifies that afterwards.
TEST(LeavingOut, BaseMotionOfNothing) {
  const Scene a = tumbling({}, rough(), 1);
  Scene b = a;
  b.base.time = {0, 1e9};
  b.base.acceleration = {Vec3::Zero(), Vec3::Zero()};
  const State sa = run(a, 50), sb = run(b, 50);
  EXPECT_EQ(sa.counters.impacts, 0);
  const Motion ma = motion_at(a, sa, 0, sa.time), mb = motion_at(b, sb, 0, sb.time);
  EXPECT_LT((ma.pose.position - mb.pose.position).norm(), 1e-12);
}

}  // namespace
