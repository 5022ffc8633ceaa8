// Yielding bodies: pushes, worlds, search by place.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "scene/yielding.hpp"
#include "step/step.hpp"
#include "verify/cases/cases.hpp"

namespace {

using namespace talus;
using namespace talus::cases;

constexpr double cube_mass = 2500, speed = 10, energy = 0.5 * cube_mass * speed * speed;

// A post without an axis on a smooth plane, hit in the middle of a face by a cube that slides
// `heading` to the left of east [rad].
Scene post_in_the_path(double capacity, double force, double heading) {
  const Mat3 turn = Eigen::AngleAxisd(heading, Vec3::UnitZ()).toRotationMatrix();
  Body cube;
  cube.parts = {moved(box(Vec3(-0.5, -0.5, 0), Vec3(0.5, 0.5, 1)), turn, Vec3::Zero(),
                      turn * Vec3(-5, 0, 0))};
  cube.velocity = turn * Vec3(speed, 0, 0);
  Scene scene = scene_of(plane_trn(slope_frame(0, 0), 1, 60), {}, {cube}, {});
  scene.fixed.classes = {{}};
  const int post = add_fixed_body(
      scene, moved(box(Vec3(-0.4, -0.4, -1), Vec3(0.4, 0.4, 3)), turn, Vec3::Zero(), Vec3::Zero()),
      0);
  Yielding yielding;
  yielding.capacity = capacity;
  yielding.force = force;
  let_yield(scene, post, yielding);
  return scene;
}

State run(const Scene& scene, double time) {
  State state = start(scene);
  Work work = make_work(scene);
  while (state.time < time - 1e-9) step(scene, state, work);
  return state;
}

class Heading : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Yielding, Heading, testing::Values(0.0, 0.7, 2.5));

// A body without an axis takes its energy and breaks, whichever side it is hit from; the block
// continues with the rest, and no fence has met anything.
TEST_P(Heading, ABodyWithoutAnAxisTakesItsCapacityAndBreaks) {
  const double capacity = 0.4 * energy;
  const Scene scene = post_in_the_path(capacity, capacity / 0.5, GetParam());
  const State state = run(scene, 1.5);
  const Yielded& met = met_by(state.yielding, 0, 0);
  EXPECT_EQ(met.broken_by, 0);
  EXPECT_GT(met.broken_at, 0.41);
  EXPECT_LT(met.broken_at, 0.6);
  EXPECT_NEAR(met.work, capacity, 1e-6 * capacity);
  EXPECT_NEAR(0.5 * cube_mass * state.motion[0].velocity.squaredNorm(), energy - capacity,
              1e-4 * energy);
  EXPECT_TRUE(state.fence.hits.empty());
}

// One that holds is pushed along with the block, in the block's direction: energy over force.
TEST_P(Heading, ABodyWithoutAnAxisGivesWayAlongThePush) {
  const double force = energy / 0.8;
  const Scene scene = post_in_the_path(10 * energy, force, GetParam());
  const State state = run(scene, 1);
  const Yielded& met = met_by(state.yielding, 0, 0);
  EXPECT_EQ(met.broken_by, -1);
  EXPECT_NEAR(met.work, energy, 1e-4 * energy);
  EXPECT_LT(state.motion[0].velocity.norm(), 0.1);
  const Vec3 along = scene.blocks.velocity[0].normalized();
  EXPECT_LT((met.shift - 0.8 * along).norm(), 2e-3);
  EXPECT_EQ(met.deflection, 0);
  EXPECT_EQ(state.yielding.shifted, std::vector<int>{0});
  EXPECT_LT(
      (fixed_pose(scene, state, 0, 0).position - scene.fixed.pose[0].position - met.shift).norm(),
      1e-15);
}

// Two blocks push one post from two sides: it goes as far as each of them pushes it.
TEST(Yielding, ABodyWithoutAnAxisFollowsPushesFromTwoSides) {
  Scene scene = post_in_the_path(10 * energy, energy / 0.8, 0);
  State state = start(scene);
  YieldPush east, north;
  east.along = -Vec3::UnitX(), east.shift = -0.2, east.to = -0.2, east.work = 1;
  north.along = -Vec3::UnitY(), north.shift = -0.1, north.to = -0.1, north.work = 1;
  const std::vector<YieldPush> pushes = {east, north};
  push_bodies(scene, pushes, 1, state);
  EXPECT_LT((met_by(state.yielding, 0, 0).shift - Vec3(0.2, 0.1, 0)).norm(), 1e-15);
  push_bodies(scene, pushes, 2, state);  // it is there already
  EXPECT_LT((met_by(state.yielding, 0, 0).shift - Vec3(0.2, 0.1, 0)).norm(), 1e-15);
}

// --- whose bodies they are ---------------------------------------------------------------------

// Blocks that meet share one world; else each rock has its own, which its pieces share.
TEST(Yielding, AWorldIsOfAllBlocksOrOfOneRock) {
  Scene scene;
  scene.blocks.mass.resize(5);
  for (int b = 0; b < 5; ++b) EXPECT_EQ(world_of(scene, b), 0);
  scene.settings.block_contacts = false;
  for (int b = 0; b < 5; ++b) EXPECT_EQ(world_of(scene, b), b);
  scene.fragments.resize(5);
  for (int b = 0; b < 5; ++b) scene.fragments[static_cast<std::size_t>(b)].released = b < 2 ? b : 1;
  const int worlds[] = {0, 1, 1, 1, 1};
  for (int b = 0; b < 5; ++b) EXPECT_EQ(world_of(scene, b), worlds[b]);
}

// A hundred thousand rocks among as many stems: a stem that a rock did not touch costs nothing, one
// that it touched 64 bytes and the room that lists grow by.
TEST(Yielding, ARockKeepsOnlyWhatItTouched) {
  constexpr int n = 100000, touched = 5;
  Scene scene;
  scene.blocks.mass.resize(n);
  scene.settings.block_contacts = false;
  scene.forest.stems.resize(n);
  scene.forest.yieldings.resize(n);
  for (int s = 0; s < n; ++s) {
    scene.forest.yieldings[static_cast<std::size_t>(s)] = {50e3, 1e5, Vec3::Zero(), s};
    scene.forest.stems[static_cast<std::size_t>(s)].capacity = 50e3;
  }
  State state;
  state.phase.assign(n, Phase::near_ground);
  state.memory.resize(n);
  state.yielding = start_yielding(scene);
  std::vector<YieldPush> pushes(1);
  for (int k = 0; k < touched; ++k)
    for (int rock = 0; rock < n; ++rock) {
      pushes[0].block = rock;
      pushes[0].yielding = static_cast<int>((7919LL * rock + 104729LL * k) % n);
      pushes[0].work = k == 0 ? 50e3 : 1e3;
      push_bodies(scene, pushes, 1, state);
    }
  std::size_t bytes = sizeof(std::vector<MetBody>) * state.yielding.worlds.size(), n_met = 0;
  for (const std::vector<MetBody>& world : state.yielding.worlds) {
    bytes += sizeof(MetBody) * world.capacity();
    n_met += world.size();
  }
  EXPECT_EQ(n_met, static_cast<std::size_t>(n) * touched);
  EXPECT_LT(bytes, static_cast<std::size_t>(n) * (24 + 2 * 64 * touched));  // 10^6: 0.66 GB
  EXPECT_EQ(met_by(state.yielding, 3, 3 * 7919).broken_by, 3);
  EXPECT_EQ(met_by(state.yielding, 4, 3 * 7919).broken_by, -1);
  EXPECT_TRUE(stands(scene, state, 4, 3 * 7919));
  EXPECT_FALSE(stands(scene, state, 3, 3 * 7919));
}

// --- many fixed bodies -------------------------------------------------------------------------

// Twenty cubes that tumble down a plane, and 100 x 100 posts of which the nearest is `apart` away.
Scene cubes_and_posts(double apart, bool block_contacts) {
  const SlopeFrame slope = slope_frame(30, 0);
  std::vector<Body> cubes;
  for (int k = 0; k < 20; ++k)
    cubes.push_back(
        body_of(box_in(slope, (1.6 * (k / 4)) * slope.dip + 1.5 * (k % 4) * slope.strike,
                       Vec3(-0.5, -0.5, 0.01), Vec3(0.5, 0.5, 1.01)),
                Vec3(0.5 * (k % 3), 0.1, 0)));
  Settings settings;
  settings.block_contacts = block_contacts;
  Scene scene = scene_of(plane_trn(slope, 5, 500), ground_of(20, 0.4), cubes, settings);
  scene.fixed.classes = {{}};
  for (int i = 0; i < 100; ++i)
    for (int j = 0; j < 100; ++j) {
      const Vec3 foot = (apart + 3 * i) * slope.dip + (-150.0 + 3 * j) * slope.strike;
      add_fixed_body(scene, box(foot - Vec3(0.2, 0.2, 1), foot + Vec3(0.2, 0.2, 6)), 0);
    }
  return scene;
}

std::int64_t fixed_bodies_looked_at(const Scene& scene, int n_steps) {
  State state = start(scene);
  Work work = make_work(scene);
  for (int k = 0; k < n_steps; ++k) step(scene, state, work);
  EXPECT_GT(state.motion[0].velocity.norm(), 0.5);  // they slide: 0.92 m/s by the slope alone
  EXPECT_TRUE(state.yielding.shifted.empty());
  return work.search.n_fixed_near;
}

// Of ten thousand fixed bodies those far away are never looked at; near ones are, a few
// for each block, not all.
TEST(FixedBodies, AreFoundByPlaceAndNeverInALoop) {
  for (const bool block_contacts : {true, false}) {
    EXPECT_EQ(fixed_bodies_looked_at(cubes_and_posts(120, block_contacts), 100), 0);
    const std::int64_t near = fixed_bodies_looked_at(cubes_and_posts(5, block_contacts), 100);
    EXPECT_GT(near, 0);
    EXPECT_LT(near, 100 * 20 * 20);  // steps, blocks; all would be 10,000 each
  }
}

}  // namespace
