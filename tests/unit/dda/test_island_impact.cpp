#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "dda/island_impact.hpp"
#include "unit/dda/island_scenes.hpp"

namespace {

using talus::BodyPair;
using talus::ImpactSettings;
using talus::ImpactWork;
using talus::Island;
using talus::IslandImpactResult;
using talus::IslandRow;
using talus::Vec3;
using talus::scenes::LawOfScene;
using Vec6 = Eigen::Matrix<double, 6, 1>;

LawOfScene weightless(double friction) {
  LawOfScene law;
  law.gravity = 0;
  law.friction = friction;
  return law;
}

Vec3 point_velocity_of(const Island<6>& island, const std::vector<Vec6>& v, const BodyPair& pair,
                       const IslandRow& row) {
  const auto a = static_cast<std::size_t>(pair.a);
  Vec3 w = talus::point_velocity<6>(v[a], row.arm);
  if (pair.b < 0) return w;
  const auto b = static_cast<std::size_t>(pair.b);
  const Vec3 arm_b = row.arm + island.position[a] - island.position[b];
  return w - talus::point_velocity<6>(v[b], arm_b);
}

template <class Restitution>
void ask_restitution(Island<6>& island, const Restitution& restitution) {
  for (const BodyPair& pair : island.pairs)
    for (int r = pair.row_begin; r < pair.row_end; ++r) {
      IslandRow& row = island.rows[static_cast<std::size_t>(r)];
      const double v_n = row.normal.dot(point_velocity_of(island, island.free_velocity, pair, row));
      row.bias = v_n < 0 ? restitution() * v_n : 0;
    }
}

double kinetic_energy(const Island<6>& island, const std::vector<Vec6>& v) {
  double sum = 0;
  for (std::size_t i = 0; i < v.size(); ++i) sum += 0.5 * v[i].dot(island.mass[i] * v[i]);
  return sum;
}

/// n unit cubes in a row along x, faces touching; the first moves at 1 m/s.
Island<6> row_of_cubes(int n, const LawOfScene& law) {
  Island<6> island;
  for (int i = 0; i < n; ++i) {
    talus::scenes::add_box<6>({Vec3(i, 0, 0), Vec3::Constant(0.5)}, law, island);
    if (i > 0)
      talus::scenes::add_contacts<6>(
          i, i - 1, Vec3::UnitX(),
          talus::scenes::rectangle(Vec3(i - 0.5, 0, 0), Vec3(0, 0.5, 0), Vec3(0, 0, 0.5)), 0, law,
          island);
  }
  island.free_velocity[0][0] = 1;
  return island;
}

// Closed form of two equal blocks: the centre of mass goes on, the difference turns to e times
// itself.
TEST(ApplyIslandImpact, TwoBlocksPartWithTheirRestitution) {
  for (const double e : {0.0, 0.3, 0.7, 1.0}) {
    Island<6> island = row_of_cubes(2, weightless(0.5));
    ask_restitution(island, [&] { return e; });
    ImpactWork<6> work;
    const auto result = apply_island_impact(island, ImpactSettings{.tolerance = 1e-9}, work);
    ASSERT_TRUE(result.converged);
    EXPECT_NEAR(island.velocity[0][0], (1 - e) / 2, 1e-8);
    EXPECT_NEAR(island.velocity[1][0], (1 + e) / 2, 1e-8);
    EXPECT_NEAR(result.dissipated, 0.25 * 2500 * (1 - e * e), 1e-4);
  }
}

// theory 4, case 13: p = (1 + e)(-v_n) / (n^T W n), at a corner of a turned cube, without friction.
TEST(ApplyIslandImpact, CornerHitHasItsClosedForm) {
  const LawOfScene law = weightless(0);
  Island<6> island;
  talus::scenes::add_box<6>({Vec3(0, 0, 0.5), Vec3(0.5, 0.3, 0.4)}, law, island);
  const Vec3 normal = Vec3(0.2, -0.1, 1).normalized();
  talus::scenes::add_contacts<6>(0, -1, normal, {Vec3(0.5, 0.3, 0.1)}, 0, law, island);
  island.free_velocity[0] << 1, 2, -3, 0.4, -0.5, 0.6;
  ask_restitution(island, [] { return 0.6; });
  const IslandRow& row = island.rows[0];
  const Vec6 q = talus::generalised<6>(row.arm, normal);
  const double v_n = q.dot(island.free_velocity[0]);
  const double expected = 1.6 * -v_n / q.dot(island.mass[0].llt().solve(q));
  ImpactWork<6> work;
  ASSERT_TRUE(apply_island_impact(island, ImpactSettings{.tolerance = 1e-10}, work).converged);
  EXPECT_NEAR(island.rows[0].impulse.dot(normal), expected, 1e-8 * expected);
}

// Newton's law for all contacts at once: the first block bounces off the others, which go on as one
// (the outcome of Moreau's law; the impulse wave of elastic spheres is another model).
TEST(ApplyIslandImpact, CradleIsSolvedAsAWhole) {
  for (const double e : {0.0, 0.5, 1.0}) {
    Island<6> island = row_of_cubes(5, weightless(0.5));
    ask_restitution(island, [&] { return e; });
    ImpactWork<6> work;
    ASSERT_TRUE(apply_island_impact(island, ImpactSettings{.tolerance = 1e-8}, work).converged);
    EXPECT_NEAR(island.velocity[0][0], (1 - 4 * e) / 5, 1e-6);
    for (std::size_t i = 1; i < 5; ++i) EXPECT_NEAR(island.velocity[i][0], (1 + e) / 5, 1e-6);
  }
}

// A block driven against one that leans on the ground: the one between is not pushed through.
TEST(ApplyIslandImpact, BlockBetweenBlockAndGroundStops) {
  const LawOfScene law = weightless(0.5);
  Island<6> island = talus::scenes::stack<6>(2, law);
  island.free_velocity[0].setZero();
  island.free_velocity[1] << 0, 0, -4, 0, 0, 0;
  ask_restitution(island, [] { return 0.5; });
  ImpactWork<6> work;
  const auto result = apply_island_impact(island, ImpactSettings{.tolerance = 1e-9}, work);
  ASSERT_TRUE(result.converged);
  EXPECT_NEAR(island.velocity[0][2], 0, 1e-7);
  EXPECT_NEAR(island.velocity[1][2], 2, 1e-7);
}

// Random piles with random velocities and an own e in 0..1 for every contact: energy never grows,
// impulses stay in their cones, nothing approaches, momentum is kept; and it converges as a rule.
TEST(ApplyIslandImpact, NeverCreatesEnergyAndKeepsMomentum) {
  talus::Random random(81, "impact");
  ImpactWork<6> work;
  int n_lowered = 0, n_unconverged = 0;
  const int rounds = 80;
  for (int round = 0; round < rounds; ++round) {
    LawOfScene law;
    law.friction = random.uniform(0.2, 1.2);
    const auto size = [&](std::uint64_t most) { return 1 + static_cast<int>(random.below(most)); };
    Island<6> island = talus::scenes::pile<6>({size(3), size(3), size(4)}, law, random);
    const bool closed = round % 2 == 0 && island.mass.size() > 1;
    if (closed) std::erase_if(island.pairs, [](const BodyPair& pair) { return pair.b < 0; });
    for (Vec6& v : island.free_velocity)
      for (int k = 0; k < 6; ++k) v[k] = random.uniform(-1, 1);
    ask_restitution(island, [&] { return random.uniform(); });
    const ImpactSettings settings{.tolerance = 1e-4};
    const IslandImpactResult result = apply_island_impact(island, settings, work);
    const double before = kinetic_energy(island, island.free_velocity);
    EXPECT_LE(kinetic_energy(island, island.velocity), before * (1 + 1e-14));
    n_lowered += result.restitution_part < 1;
    n_unconverged += !result.converged;
    Vec3 P = Vec3::Zero(), L = Vec3::Zero();
    double scale = 1;
    for (std::size_t i = 0; closed && i < island.mass.size(); ++i) {
      const Vec6 change = island.mass[i] * (island.velocity[i] - island.free_velocity[i]);
      P += change.head<3>();
      L += change.tail<3>() + island.position[i].cross(change.head<3>());
      scale += change.norm();
    }
    EXPECT_LT(P.norm() + L.norm(), 1e-12 * scale);
    for (const BodyPair& pair : island.pairs)
      for (int r = pair.row_begin; r < pair.row_end; ++r) {
        const IslandRow& row = island.rows[static_cast<std::size_t>(r)];
        const double p_n = row.normal.dot(row.impulse);
        const double v_n = row.normal.dot(point_velocity_of(island, island.velocity, pair, row));
        EXPECT_GE(p_n, -1e-12);
        EXPECT_LE((row.impulse - p_n * row.normal).norm(), law.friction * p_n * (1 + 1e-9) + 1e-9);
        if (result.converged) {
          EXPECT_GT(v_n, -5e-4);
        }
      }
  }
  EXPECT_GT(n_lowered, 2);  // the guard has been at work
  EXPECT_LT(n_unconverged, rounds / 10);
}

}  // namespace
