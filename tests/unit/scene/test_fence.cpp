// Fences: energy, deflection, hits, rocks one by one.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <random>

#include "base/units.hpp"
#include "scene/fence.hpp"
#include "step/step.hpp"
#include "verify/cases/cases.hpp"

namespace {

using namespace talus;
using namespace talus::cases;

constexpr double cube_mass = 2500;

Body cube_at(const Vec3& low, const Vec3& velocity) {
  Body body;
  body.parts = {box(low, low + Vec3::Ones())};
  body.velocity = velocity;
  return body;
}

// Fence of two panels along x = 5, y from -10 to 10 on a smooth plane, to be hit along +x.
StandingFence fence_across(double capacity, double deflection, double restitution = 0) {
  StandingFence fence;
  fence.posts = {Vec3(5, -10, 0), Vec3(5, 0, 0), Vec3(5, 10, 0)};
  fence.depth = {0.5, 0.5};
  fence.height = 4;
  fence.capacity = capacity;
  fence.deflection = deflection;
  fence.contact.restitution = restitution;
  return fence;
}

Scene smooth_plane(const std::vector<Body>& bodies, const StandingFence& fence,
                   const Settings& settings = {}) {
  Scene scene = scene_of(plane_trn(slope_frame(0, 0), 1, 40), {}, bodies, settings);
  add_fence(scene, fence);
  return scene;
}

Settings one_by_one() {
  Settings settings;
  settings.block_contacts = false;
  return settings;
}

State run(const Scene& scene, double time) {
  State state = start(scene);
  Work work = make_work(scene);
  while (state.time < time - 1e-9) step(scene, state, work);
  return state;
}

double kinetic(const Scene& scene, const State& state) {
  const Energies e = energies(scene, state);
  return e.translation + e.rotation;
}

double energy_of(double speed) { return 0.5 * cube_mass * speed * speed; }

// The block stops where force times path is its energy, after m v / F.
TEST(Fence, TakesTheEnergyOfABlockOverItsDeflection) {
  const double energy = energy_of(10), capacity = 2 * energy, deflection = 3;
  const Scene scene =
      smooth_plane({cube_at(Vec3(0, -5.5, 0), Vec3(10, 0, 0))}, fence_across(capacity, deflection));
  const double force = capacity / deflection;
  const double stopped = 3.9 / 10 + cube_mass * 10 / force;
  const State before = run(scene, stopped - 0.01), after = run(scene, stopped + 0.1);
  EXPECT_GT(before.motion[0].velocity.x(), 0.05);
  EXPECT_LT(after.motion[0].velocity.norm(), 0.05);  // 1e-5 of its energy
  EXPECT_NEAR(met_by(after.yielding, 0, 0).work, energy, 1e-5 * energy);
  EXPECT_NEAR(-met_by(after.yielding, 0, 0).deflection, energy / force, 1e-3);
  EXPECT_EQ(met_by(after.yielding, 0, 1).work, 0);
  EXPECT_EQ(met_by(after.yielding, 0, 0).broken_by, -1);
  ASSERT_EQ(after.fence.hits.size(), 1u);
  const FenceHit& hit = after.fence.hits[0];
  EXPECT_EQ(hit.panel, 0);
  EXPECT_NEAR(hit.time, 0.39, 1e-6);
  EXPECT_NEAR(hit.chainage, 5, 0.6);
  EXPECT_NEAR(hit.translational_energy, energy, 1e-6 * energy);
  EXPECT_NEAR(hit.energy_after, 0, 1e-4 * energy);
  EXPECT_NEAR(hit.top_height, 1, 1e-3);
  EXPECT_NEAR(hit.bottom_height, 0, 1e-3);
}

class FenceCapacity : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Fence, FenceCapacity, testing::Values(0.5, 1 - 1e-4, 1 + 1e-4, 1.5, 10));

// A block with less energy is stopped, one with more continues with the rest.
TEST_P(FenceCapacity, HoldsExactly) {
  const double energy = energy_of(12), capacity = energy / GetParam();
  const Scene scene =
      smooth_plane({cube_at(Vec3(0, 2, 0), Vec3(12, 0, 0))}, fence_across(capacity, 2));
  const State state = run(scene, 1.5);
  const double left = std::max(0.0, energy - capacity);
  EXPECT_NEAR(kinetic(scene, state), left, 1e-5 * energy);
  EXPECT_NEAR(met_by(state.yielding, 0, 1).work, energy - left, 1e-5 * energy);
  EXPECT_EQ(met_by(state.yielding, 0, 1).broken_by, GetParam() > 1 ? 0 : -1);
  EXPECT_NEAR(state.ledger.fence, energy - left, 1e-5 * energy);
  EXPECT_EQ(state.counters.unconverged, 0);
}

// Two blocks that one panel holds one by one break it together.
TEST(Fence, HitsAtTheSameTimeAddUp) {
  const double energy = energy_of(10), capacity = 1.5 * energy;
  const Scene scene = smooth_plane(
      {cube_at(Vec3(0, -8, 0), Vec3(10, 0, 0)), cube_at(Vec3(0, -3, 0), Vec3(10, 0, 0))},
      fence_across(capacity, 2));
  const State state = run(scene, 1.5);
  EXPECT_GE(met_by(state.yielding, 0, 0).broken_by, 0);
  EXPECT_NEAR(met_by(state.yielding, 0, 0).work, capacity, 1e-6 * capacity);
  EXPECT_NEAR(kinetic(scene, state), 2 * energy - capacity, 1e-4 * energy);
  ASSERT_EQ(state.fence.hits.size(), 2u);
  EXPECT_NEAR(state.fence.hits[0].work + state.fence.hits[1].work, capacity, 1e-6 * capacity);
}

// A broken panel no longer stops the second block, which passes with all its energy.
TEST(Fence, LetsThroughWhatComesAfterItBroke) {
  const double energy = energy_of(10);
  const Scene scene = smooth_plane(
      {cube_at(Vec3(0, -8, 0), Vec3(10, 0, 0)), cube_at(Vec3(-12, -4, 0), Vec3(10, 0, 0))},
      fence_across(0.5 * energy, 2));
  const State state = run(scene, 3);
  EXPECT_EQ(met_by(state.yielding, 0, 0).broken_by, 0);
  EXPECT_NEAR(state.motion[1].velocity.x(), 10, 1e-6);
  EXPECT_EQ(state.fence.hits.size(), 1u);
}

// Rocks that fall one by one meet each a whole fence: a panel that one broke is whole for the next.
TEST(Fence, EachRockThatFallsAloneBreaksItsOwnPanel) {
  const double energy = energy_of(10), capacity = 0.5 * energy;
  const Scene scene = smooth_plane(
      {cube_at(Vec3(0, -8, 0), Vec3(10, 0, 0)), cube_at(Vec3(-12, -8, 0), Vec3(10, 0, 0))},
      fence_across(capacity, 2), one_by_one());
  const State state = run(scene, 3);
  for (const int rock : {0, 1}) {
    EXPECT_EQ(met_by(state.yielding, rock, 0).broken_by, rock);
    EXPECT_NEAR(met_by(state.yielding, rock, 0).work, capacity, 1e-6 * capacity);
    EXPECT_NEAR(energy_of(state.motion[rock].velocity.norm()), energy - capacity, 1e-4 * energy);
  }
  EXPECT_EQ(state.fence.hits.size(), 2u);
  EXPECT_NEAR(state.ledger.fence, 2 * capacity, 1e-5 * energy);
}

// Hits that a net takes one by one do not add up, and each pushes it from its first place.
TEST(Fence, HitsOfRocksThatFallAloneDoNotAddUp) {
  const double energy = energy_of(10), force = 1.5 * energy / 2;
  std::vector<Body> cubes;
  for (int k = 0; k < 6; ++k)
    cubes.push_back(cube_at(Vec3(-3 * k, -8 + 0.2 * k, 0), Vec3(10, 0, 0)));
  const Scene scene = smooth_plane(cubes, fence_across(1.5 * energy, 2), one_by_one());
  const State state = run(scene, 4);
  for (int rock = 0; rock < 6; ++rock) {
    const Yielded& met = met_by(state.yielding, rock, 0);
    EXPECT_EQ(met.broken_by, -1) << rock;
    EXPECT_NEAR(met.work, energy, 1e-4 * energy) << rock;
    EXPECT_NEAR(-met.deflection, energy / force, 2e-3) << rock;
    EXPECT_LT(state.motion[rock].velocity.norm(), 0.05) << rock;
  }
}

// However many rocks fall, each moves as in a run of its own: along and through panels that other
// rocks have pushed or broken, hit askew, rolling and asleep.
TEST(Fence, ARockThatFallsAloneMovesAsInARunOfItsOwn) {
  std::mt19937 draw(4);
  std::uniform_real_distribution<double> of(0, 1);
  const double capacity = energy_of(9);
  std::vector<Body> cubes;
  for (int k = 0; k < 8; ++k) {
    Body cube = cube_at(Vec3(-8 * of(draw), -9 + 16 * of(draw), 0.3 * of(draw)), Vec3::Zero());
    cube.velocity = Vec3(6 + 8 * of(draw), 4 * of(draw) - 2, 0);
    cube.spin = Vec3(of(draw), 2 * of(draw), of(draw));
    cubes.push_back(cube);
  }
  const auto scene_with = [&](const std::vector<Body>& bodies) {
    Scene scene =
        scene_of(plane_trn(slope_frame(0, 0), 1, 60), ground_of(20, 0.3), bodies, one_by_one());
    add_fence(scene, fence_across(capacity, 1.5, 0.2));
    return scene;
  };
  const Scene all = scene_with(cubes);
  const State together = run(all, 3);
  int n_broken = 0, n_pushed = 0;
  for (int rock = 0; rock < 8; ++rock) {
    const State alone = run(scene_with({cubes[static_cast<std::size_t>(rock)]}), 3);
    EXPECT_LT((together.motion[rock].pose.position - alone.motion[0].pose.position).norm(), 1e-6)
        << rock;
    for (const int panel : {0, 1}) {
      const Yielded &met = met_by(together.yielding, rock, panel),
                    &met_alone = met_by(alone.yielding, 0, panel);
      EXPECT_NEAR(met.work, met_alone.work, 1e-6 * capacity) << rock;
      EXPECT_NEAR(met.deflection, met_alone.deflection, 1e-6) << rock;
      EXPECT_EQ(met.broken_by < 0, met_alone.broken_by < 0) << rock;
      n_broken += met.broken_by >= 0;
      n_pushed += met.deflection != 0 && met.broken_by < 0;
    }
  }
  EXPECT_GT(n_broken, 0);
  EXPECT_GT(n_pushed, 2);
}

TEST(Fence, RigidPanelThrowsBackByItsRestitution) {
  const Scene scene = smooth_plane({cube_at(Vec3(0, -5.5, 0), Vec3(10, 0, 0))},
                                   fence_across(Yielding::no_limit, 0, 0.4));
  const State state = run(scene, 1);
  EXPECT_NEAR(state.motion[0].velocity.x(), -4, 1e-6);
  EXPECT_EQ(met_by(state.yielding, 0, 0).deflection, 0);
  ASSERT_EQ(state.fence.hits.size(), 1u);
  EXPECT_NEAR(state.fence.hits[0].energy_after, 0.16 * energy_of(10), 1e-6 * energy_of(10));
  EXPECT_NEAR(state.ledger.impact, 0.84 * energy_of(10), 1e-6 * energy_of(10));
}

// A cube falls along a fence onto the slope, which throws it at the fence within the same step.
struct Throw {
  double dt, bounce, room;
};
class FenceThrow : public testing::TestWithParam<Throw> {};
INSTANTIATE_TEST_SUITE_P(Fence, FenceThrow,
                         testing::Values(Throw{0.02, 0.985, 0.05}, Throw{0.05, 0.96, 0.3}));

TEST_P(FenceThrow, IsMetWithinTheStep) {
  const auto [dt, bounce, room] = GetParam();
  const double speed = 10 * bounce, half_thickness = 0.1;
  const SlopeFrame slope = slope_frame(45, 0);
  const double x = 5 - half_thickness - room - 1.5 / std::numbers::sqrt2;  // of its lowest face
  const Vec3 base(x, 3, 5 * bounce * bounce - x);
  Body cube;
  cube.parts = {box_in(slope, base, Vec3(-0.5, -0.5, 0), Vec3(0.5, 0.5, 1))};
  StandingFence fence = fence_across(Yielding::no_limit, 0, 0.4);
  for (Vec3& post : fence.posts) post.z() = -5;
  Settings settings;
  settings.dt = dt;
  Scene scene = scene_of(plane_trn(slope, 1, 40), ground_of(0, 1), {cube}, settings);
  add_fence(scene, fence);
  State state = start(scene);
  Work work = make_work(scene);
  double deepest = 0;
  while (state.time < 1 - 1e-9)
    deepest = std::max(deepest, step(scene, state, work).largest_penetration);
  EXPECT_LT(deepest, 1e-6);
  ASSERT_EQ(state.fence.hits.size(), 1u);
  const FenceHit& hit = state.fence.hits[0];
  EXPECT_NEAR(hit.time, bounce + room / speed, 1e-6);
  EXPECT_NEAR(hit.velocity.x(), speed, 1e-4);
  EXPECT_NEAR(state.motion[0].velocity.x(), -0.4 * speed, 1e-4);
  // the recorded path is the path: each piece begins where the last one ended
  for (std::size_t i = 1; i < work.segments.size(); ++i)
    EXPECT_LT(
        (work.segments[i].start.pose.position - work.segments[i - 1].end.pose.position).norm(),
        1e-9);
  for (const Segment& segment : work.segments) {
    const double h = segment.t_end - segment.t_start;
    const Vec3 end =
        segment.start.pose.position + h * (segment.start.velocity + h / 2 * segment.acceleration);
    EXPECT_LT((end - segment.end.pose.position).norm(), 1e-9);
  }
}

// Fast rocks that spin meet the top edge of a panel with any of their features, some of them where
// cubes lean on the panel. No rock gets deeper in than it moves in a substep, a tenth of its
// thickness.
TEST(Fence, RocksThatMeetItsTopEdgeAreNotDeepInIt) {
  std::mt19937_64 random(7);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * std::generate_canonical<double, 53>(random);
  };
  StandingFence fence = fence_across(Yielding::no_limit, 0, 0.4);
  fence.contact.friction = std::tan(20 * degree);
  std::vector<Body> bodies;
  for (const double y : {-8.0, -3.0, 2.0, 7.0})
    bodies.push_back(cube_at(Vec3(3.9, y, 0), Vec3::Zero()));
  for (int i = 0; i < 2000; ++i) {
    const double after = uniform(0.05, 0.15);
    Body rock;
    rock.velocity = Vec3(uniform(10, 60), uniform(-5, 5), uniform(-25, 5));
    rock.spin = uniform(0, 50) * Vec3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)).normalized();
    const Quat attitude =
        Quat(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)).normalized();
    const Vec3 meets(4.6, uniform(-9, 9), 4 + uniform(-0.2, 0.5));
    rock.parts = {moved(box(Vec3(-0.6, -0.5, -0.4), Vec3(0.6, 0.5, 0.4)),
                        attitude.toRotationMatrix(), Vec3::Zero(), meets - after * rock.velocity)};
    bodies.push_back(rock);
  }
  Settings settings;
  settings.block_contacts = false;
  Scene scene = scene_of(plane_trn(slope_frame(0, 0), 1, 40), ground_of(30, 0.3), bodies, settings);
  add_fence(scene, fence);
  State state = start(scene);
  Work work = make_work(scene);
  double deepest = 0;
  while (state.time < 0.5 - 1e-9)
    deepest = std::max(deepest, step(scene, state, work).largest_penetration);
  EXPECT_GT(state.fence.hits.size(), 500u);
  EXPECT_LT(deepest, 0.1 * 0.8);
}

// Blocks beside the fence meet no obstacle.
TEST(Fence, DoesNotReachBeyondItsEnds) {
  const Scene scene = smooth_plane({cube_at(Vec3(0, 10.5, 0), Vec3(10, 0, 0))},
                                   fence_across(Yielding::no_limit, 0));
  const State state = run(scene, 1);
  EXPECT_NEAR(state.motion[0].velocity.x(), 10, 1e-9);
  EXPECT_TRUE(state.fence.hits.empty());
}

// A rotated block that is thrown at a panel: all energy is accounted for.
TEST(Fence, ClosesTheEnergyBalanceOfATumblingBlock) {
  GroundClass ground;
  ground.friction = std::tan(30 * degree);
  ground.restitution = 0.3;
  Body body = cube_at(Vec3(0, -5.5, 2), Vec3(15, 1, 2));
  body.parts[0] =
      moved(body.parts[0], Eigen::AngleAxisd(0.5, Vec3(1, 2, 3).normalized()).toRotationMatrix(),
            Vec3(0.5, -5, 2.5));
  body.spin = Vec3(1, -3, 2);
  Scene scene = scene_of(plane_trn(slope_frame(0, 0), 1, 40), ground, {body}, {});
  StandingFence fence = fence_across(energy_of(10), 2);
  fence.contact.friction = std::tan(20 * degree);
  add_fence(scene, fence);
  const State before = start(scene);
  const Energies e = energies(scene, before);
  const State state = run(scene, 3);
  const Energies end = energies(scene, state);
  const double lost =
      e.translation + e.rotation + e.potential - (end.translation + end.rotation + end.potential);
  const EnergyLedger& l = state.ledger;
  EXPECT_GT(l.fence, 0.1 * energy_of(10));
  EXPECT_NEAR(l.fence + l.friction + l.impact + l.contact, lost, 2e-3 * lost);
}

// A block on a fixed slab is a block on the ground.
TEST(FixedBodies, BearAndRubAsTheGroundDoes) {
  const SlopeFrame frame = slope_frame(25, 30);
  Body body;
  body.parts = {box_in(frame, Vec3::Zero(), Vec3(-0.5, -0.5, 0), Vec3(0.5, 0.5, 1))};
  GroundClass rough;
  rough.friction = std::tan(15 * degree);
  Scene scene = scene_of(plane_trn(slope_frame(0, 0), 1, 40, Vec3(0, 0, -60)), rough, {body}, {});
  scene.fixed.classes = {rough};
  add_fixed_body(scene, box_in(frame, Vec3::Zero(), Vec3(-10, -5, -3), Vec3(20, 5, 0)), 0);
  const State state = run(scene, 2);
  const double a = 10 * (std::sin(25 * degree) - std::tan(15 * degree) * std::cos(25 * degree));
  const Vec3 moved = state.motion[0].pose.position - scene.blocks.rest[0].position;
  EXPECT_NEAR(frame.dip.dot(moved), 2 * a, 1e-3 * 2 * a);
  EXPECT_NEAR(frame.strike.dot(moved), 0, 1e-6);
}

}  // namespace
