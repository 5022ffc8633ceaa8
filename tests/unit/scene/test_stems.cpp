// Stems: capacity, stops, hits, energy balance.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "scene/stems.hpp"
#include "step/step.hpp"
#include "verify/cases/cases.hpp"

namespace {

using namespace talus;
using namespace talus::cases;

constexpr double capacity = 91111;    // [J]
constexpr double side = 0.584803548;  // of a cube of 500 kg [m]

Stem stem_at(const Vec3& foot, double holds = capacity) {
  Stem stem;
  stem.foot = foot;
  stem.height = 20;
  stem.radius = 0.15;
  stem.capacity = holds;
  stem.deflection = 0.5;
  return stem;
}

GroundClass smooth() { return {}; }

Body cube_at(const Vec3& centre, const Vec3& velocity, const Mat3& turn = Mat3::Identity()) {
  Body body;
  body.parts = {
      moved(box(Vec3::Constant(-side / 2), Vec3::Constant(side / 2)), turn, Vec3::Zero(), centre)};
  body.velocity = velocity;
  return body;
}

// Cubes on a smooth plane, which carries them without friction.
Scene forest_on_plane(const std::vector<Body>& bodies, const std::vector<Stem>& stems,
                      double friction = 0, const Settings& settings = {}) {
  Scene scene = scene_of(plane_trn(slope_frame(0, 0), 1, 120), smooth(), bodies, settings);
  GroundClass face;
  face.friction = friction;
  add_forest(scene, stems, {face});
  return scene;
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

TEST(Stems, CapacityFollowsTheDiameter) {
  const double kj[][2] = {
      {0.10, 7.90}, {0.20, 39.18}, {0.30, 99.97}, {0.40, 194.30}, {0.60, 495.72}};
  for (const auto& [dbh, energy] : kj)
    EXPECT_NEAR(stem_capacity(1, dbh) / 1e3, energy, 1e-3 * energy);
}

// The mass of the cubes scales the speed at which the stem yields.
class CentralHit : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Stems, CentralHit, testing::Values(10.0, 15.0, 20.0, 25.0));

// A stem takes its energy over its deflection; the block is stopped, or continues with the rest.
TEST_P(CentralHit, TakesTheCapacityAndNoMore) {
  const double v = GetParam();
  for (const double dt : {0.005, 0.0025}) {
    Scene scene = forest_on_plane({cube_at(Vec3(-1, 0.013, side / 2), Vec3(v, 0, 0))},
                                  {stem_at(Vec3(0, 0.013, 0))});
    scene.settings.dt = dt;
    const double mass = scene.blocks.mass[0], energy = 0.5 * mass * v * v;
    const State state = run(scene, 0.5);
    const double left = std::sqrt(std::max(0.0, v * v - 2 * capacity / mass));
    ASSERT_EQ(state.stem_hits.size(), 1u);
    const StemHit& hit = state.stem_hits[0];
    const Yielded& met = met_by_stem(scene, state, 0, 0);
    EXPECT_NEAR(state.motion[0].velocity.x(), left, 1e-3 * (left > 0 ? left : v));
    EXPECT_NEAR(hit.work, std::min(energy, capacity), 1e-3 * energy);
    EXPECT_EQ(met.broken_by, energy > capacity ? 0 : -1);
    EXPECT_NEAR(met.shift.x(), std::min(energy, capacity) / (capacity / 0.5), 1e-2 * 0.1372);
    EXPECT_NEAR(hit.time, (1 - 0.15 - side / 2) / v, 1e-5);
    EXPECT_NEAR(hit.translational_energy, energy, 1e-6 * energy);
    EXPECT_NEAR(state.ledger.fence, hit.work, 1e-9 * energy);
  }
}

// The stop takes m v / F: 0.0274 s for 500 kg at 10 m/s.
TEST(Stems, AStopTakesTheTimeOfItsForce) {
  const Scene scene =
      forest_on_plane({cube_at(Vec3(-1, 0, side / 2), Vec3(10, 0, 0))}, {stem_at(Vec3::Zero())});
  const double touch = (1 - 0.15 - side / 2) / 10;
  const double stop = scene.blocks.mass[0] * 10 / (capacity / 0.5);
  EXPECT_NEAR(stop, 0.0274, 1e-4);
  State state = start(scene);
  Work work = make_work(scene);
  double stopped = 0;
  while (state.time < 0.3 && stopped == 0) {
    step(scene, state, work);
    for (const Segment& segment : work.segments) {
      const double before = segment.start.velocity.x(), after = segment.end.velocity.x();
      if (after > 0.05 || before <= 0.05) continue;
      stopped = segment.t_start + (segment.t_end - segment.t_start) * before / (before - after);
    }
  }
  EXPECT_NEAR(stopped, touch + stop, 0.01 * stop);
}

// Whatever the stiffness, a stop takes few substeps: a soft contact, which slows a block down more
// and more gently, is not cut again and again at the end that it never comes to.
TEST(Stems, AStopIsReachedInFewSubsteps) {
  for (const double stiffness : {0.0, 1e7, 1e8, 1e9, 5e10})
    for (const double dt : {0.005, 0.001}) {
      Scene scene = forest_on_plane({cube_at(Vec3(-1, 0, side / 2), Vec3(10, 0, 0))},
                                    {stem_at(Vec3::Zero())});
      scene.settings.normal_stiffness = stiffness;
      scene.settings.dt = dt;
      State state = start(scene);
      Work work = make_work(scene);
      while (state.time < 0.2) ASSERT_LT(step(scene, state, work).substeps, 100);
      EXPECT_LT(std::abs(state.motion[0].velocity.x()), 0.02) << stiffness << " " << dt;
      EXPECT_NEAR(met_by_stem(scene, state, 0, 0).work, 0.5 * 500 * 100, 0.01 * 25e3);
    }
}

// The next block meets only the energy that the one before left of a stem.
TEST(Stems, HitsOneAfterTheOtherAddUp) {
  const Scene scene = forest_on_plane({cube_at(Vec3(-1, 0, side / 2), Vec3(10, 0, 0)),
                                       cube_at(Vec3(1, 40, side / 2), Vec3(0, -20, 0))},
                                      {stem_at(Vec3::Zero()), stem_at(Vec3(1, 20, 0), 20e3)});
  const State state = run(scene, 2.5);
  EXPECT_EQ(met_by_stem(scene, state, 0, 1).broken_by, 1);
  EXPECT_EQ(met_by_stem(scene, state, 0, 0).broken_by, -1);
  EXPECT_NEAR(met_by_stem(scene, state, 0, 1).work, 20e3, 1);
  double sum = 0;
  for (const StemHit& hit : state.stem_hits) sum += hit.work;
  EXPECT_NEAR(sum, state.ledger.fence, 1e-6 * sum);
}

// Rocks that fall one by one find each stem whole, whatever earlier rocks did to it.
TEST(Stems, EachRockThatFallsAloneMeetsTheWholeStem) {
  Settings settings;
  settings.block_contacts = false;
  std::vector<Body> cubes;
  for (int k = 0; k < 5; ++k)
    cubes.push_back(cube_at(Vec3(-1 - 4 * k, 0, side / 2), Vec3(15, 0, 0)));
  const Scene scene =
      forest_on_plane(cubes, {stem_at(Vec3::Zero(), 40e3), stem_at(Vec3(4, 0, 0))}, 0, settings);
  const State state = run(scene, 2.5);
  for (int rock = 0; rock < 5; ++rock) {
    EXPECT_EQ(met_by_stem(scene, state, rock, 0).broken_by, rock);
    EXPECT_NEAR(met_by_stem(scene, state, rock, 0).work, 40e3, 1) << rock;
    EXPECT_EQ(met_by_stem(scene, state, rock, 1).broken_by, -1);
    EXPECT_NEAR(met_by_stem(scene, state, rock, 1).work, 0.5 * 500 * 225 - 40e3, 30) << rock;
    EXPECT_EQ(state.yielding.worlds[static_cast<std::size_t>(rock)].size(), 2u);
  }
  EXPECT_EQ(state.stem_hits.size(), 10u);
}

TEST(Stems, TwoBlocksUseUpOneStemTogether) {
  const Scene scene = forest_on_plane({cube_at(Vec3(-1, 0, side / 2), Vec3(15, 0, 0)),
                                       cube_at(Vec3(0, -1, side / 2), Vec3(0, 15, 0))},
                                      {stem_at(Vec3::Zero(), 80e3)});
  const State state = run(scene, 0.5);
  EXPECT_GE(met_by_stem(scene, state, 0, 0).broken_by, 0);
  ASSERT_EQ(state.stem_hits.size(), 2u);
  EXPECT_NEAR(state.stem_hits[0].work + state.stem_hits[1].work, 80e3, 1);
}

// A stem that is hit beside its middle turns the block, and takes less of it the farther out the
// hit is; one beside the block's path is not touched.
TEST(Stems, AHitOffTheMiddleTurnsTheBlockAndTakesLess) {
  const auto taken_at = [](double offset) {
    const Scene scene = forest_on_plane({cube_at(Vec3(-1, offset, side / 2), Vec3(20, 0, 0))},
                                        {stem_at(Vec3::Zero(), 300e3)});
    const State state = run(scene, 0.25);
    if (offset == 0.2) {
      EXPECT_GT(std::abs(state.motion[0].angular_momentum.z()), 100);
    }
    const double lost = 0.5 * scene.blocks.mass[0] * 400 - kinetic(scene, state);
    const EnergyLedger& l = state.ledger;
    EXPECT_NEAR(lost, l.fence + l.friction + l.impact + l.contact, 1e-3 * 100e3) << offset;
    return l.fence;
  };
  // on the face, then on its edge, where the arm is shorter to begin with
  EXPECT_NEAR(taken_at(0), 0.5 * 500 * 400, 1);
  EXPECT_LT(taken_at(0.1), taken_at(0));
  EXPECT_LT(taken_at(0.2), taken_at(0.1));
  EXPECT_LT(taken_at(0.28), taken_at(0.2));
  EXPECT_LT(taken_at(0.42), taken_at(0.36));
  EXPECT_LT(taken_at(0.42), 0.2 * taken_at(0));
  EXPECT_EQ(taken_at(side / 2 + 0.15 + 1e-3), 0);
}

// Tumbling blocks of two sizes, thrown through a stand on a slope: all energy is accounted for.
TEST(Stems, CloseTheEnergyBalanceOfTumblingBlocks) {
  GroundClass ground;
  ground.friction = 0.6;
  ground.restitution = 0.3;
  std::vector<Body> bodies;
  for (int k = 0; k < 4; ++k) {
    const Mat3 turn = Eigen::AngleAxisd(0.5 + k, Vec3(1, 2, 3).normalized()).toRotationMatrix();
    bodies.push_back(cube_at(Vec3(-6 - 2 * k, 0.7 * k, 1.5), Vec3(18, 0, 1), turn));
    bodies.back().spin = Vec3(3, -8, 2);
  }
  Scene scene = scene_of(plane_trn(slope_frame(0, 0), 1, 120), ground, bodies, {});
  std::vector<Stem> stems;
  for (int i = 0; i < 8; ++i)
    for (int j = -3; j < 6; ++j) stems.push_back(stem_at(Vec3(2.1 * i, 0.9 * j, 0), 5e3 + 4e3 * i));
  GroundClass face;
  face.friction = 0.3;
  add_forest(scene, stems, {face});
  const Energies e = energies(scene, start(scene));
  const State state = run(scene, 3);
  const Energies end = energies(scene, state);
  const double lost =
      e.translation + e.rotation + e.potential - (end.translation + end.rotation + end.potential);
  const EnergyLedger& l = state.ledger;
  EXPECT_GT(l.fence, 0.1 * e.translation);
  EXPECT_NEAR(l.fence + l.friction + l.impact + l.contact, lost, 5e-3 * lost);
  EXPECT_EQ(state.counters.unconverged, 0);
  double sum = 0;
  for (const StemHit& hit : state.stem_hits) sum += hit.work;
  EXPECT_NEAR(sum, l.fence, 1e-9 * l.fence);
}

// A block is not kicked when the stem that it presses on goes: it keeps the velocity that it has.
TEST(Stems, ABrokenStemIsGoneWithoutAKick) {
  const Scene scene = forest_on_plane({cube_at(Vec3(-1, 0, side / 2), Vec3(25, 0, 0))},
                                      {stem_at(Vec3::Zero(), 20e3)});
  State state = start(scene);
  Work work = make_work(scene);
  while (met_by_stem(scene, state, 0, 0).broken_by < 0 && state.time < 0.5)
    step(scene, state, work);
  const Vec3 v = state.motion[0].velocity;
  for (int k = 0; k < 20; ++k) step(scene, state, work);
  // the ground supports its weight again, so that it moves up and down by less than 1 mm/s
  EXPECT_NEAR((state.motion[0].velocity - v).head<2>().norm(), 0, 1e-9);
  EXPECT_NEAR(state.motion[0].angular_momentum.norm(), 0, 1e-9);
  EXPECT_LT(v.x(), 25);
}

// Stems out of every block's reach are not looked at, however many they are.
TEST(Stems, CostNothingUntilABlockIsNear) {
  const std::vector<Body> bodies = {cube_at(Vec3(-40, 0, side / 2), Vec3(15, 0, 0)),
                                    cube_at(Vec3(-40, 5, 9), Vec3(5, 0, 4))};
  std::vector<Stem> stems;
  for (int i = 0; i < 400; ++i)
    for (int j = 0; j < 250; ++j) stems.push_back(stem_at(Vec3(1.6 * i, 1.6 * (j - 125), 0)));
  for (const std::size_t n : {std::size_t(1), std::size_t(2)}) {
    const std::vector<Body> some(bodies.begin(), bodies.begin() + static_cast<std::ptrdiff_t>(n));
    const Scene with = forest_on_plane(some, stems), without = forest_on_plane(some, {});
    ASSERT_EQ(n_stems(with), 100000);
    State state = start(with), bare = start(without);
    Work work = make_work(with), work_bare = make_work(without);
    while (state.time < 1.5) {
      step(with, state, work);
      step(without, bare, work_bare);
    }
    EXPECT_EQ(work.search.n_fixed_near, 0);
    EXPECT_EQ(state.counters.substeps, bare.counters.substeps);
    EXPECT_EQ(state.counters.passes, bare.counters.passes);
    for (std::size_t b = 0; b < n; ++b) {
      EXPECT_EQ(state.motion[b].pose.position, bare.motion[b].pose.position);
      EXPECT_EQ(state.motion[b].velocity, bare.motion[b].velocity);
    }
    while (state.time < 3.5) step(with, state, work);
    EXPECT_GT(work.search.n_fixed_near, 0);
    EXPECT_FALSE(state.stem_hits.empty());
  }
}

// A stem ends at its height, and a block above it flies on.
TEST(Stems, AreNotHitAboveTheirTop) {
  Stem low = stem_at(Vec3::Zero());
  low.height = 2;
  const Scene scene = forest_on_plane({cube_at(Vec3(-5, 0, 6), Vec3(20, 0, 1))}, {low});
  const State state = run(scene, 0.5);
  EXPECT_TRUE(state.stem_hits.empty());
  EXPECT_NEAR(state.motion[0].velocity.x(), 20, 1e-9);
}

}  // namespace
