// The island solver against Gauss-Seidel.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cstdlib>
#include <limits>

#include "solver/island_solver.hpp"
#include "solver/one_contact.hpp"
#include "unit/solver/island_scenes.hpp"
#include "unit/step/rows_of_island.hpp"

namespace {

using talus::BodyPair;
using talus::ContactRow;
using talus::ContactState;
using talus::Island;
using talus::IslandResult;
using talus::IslandSettings;
using talus::IslandWork;
using talus::Mat3;
using talus::RowGroup;
using talus::Vec3;
using talus::Vec6;
using talus::scenes::LawOfScene;
using talus::test::row_at;
using talus::test::row_numbers;

/// The same island as one dense system: row c of the map is w_c = B_c v (theory 1.6).
struct Dense {
  Eigen::MatrixXd mass, map;
  Eigen::VectorXd free;

  explicit Dense(const Island& island) {
    const int n = talus::n_bodies(island), m = 2 * static_cast<int>(island.rows.size());
    mass = Eigen::MatrixXd::Zero(n * 6, n * 6);
    map = Eigen::MatrixXd::Zero(3 * m, n * 6);
    free.resize(n * 6);
    for (int i = 0; i < n; ++i) {
      mass.block<6, 6>(i * 6, i * 6) = island.mass[static_cast<std::size_t>(i)];
      free.segment<6>(i * 6) = island.free_velocity[static_cast<std::size_t>(i)];
    }
    for (const BodyPair& pair : island.pairs)
      for (int r = pair.row_begin; r < pair.row_end; ++r) {
        const Vec3 arm = row_of(island, r).arm();
        map.block<3, 6>(3 * r, pair.a * 6) = talus::displacement_matrix(arm).leftCols<6>();
        if (pair.b < 0) continue;
        const Vec3 arm_b = arm + island.position[static_cast<std::size_t>(pair.a)] -
                           island.position[static_cast<std::size_t>(pair.b)];
        map.block<3, 6>(3 * r, pair.b * 6) = -talus::displacement_matrix(arm_b).leftCols<6>();
      }
  }
};

Eigen::VectorXd stacked(const std::vector<Vec6>& v) {
  Eigen::VectorXd out(static_cast<Eigen::Index>(v.size()) * 6);
  for (std::size_t i = 0; i < v.size(); ++i)
    out.segment<6>(static_cast<Eigen::Index>(i) * 6) = v[i];
  return out;
}

/// p = law(w + W p) of one contact: Newton, and where that cycles a relaxed iteration.
Vec3 local_impulse(ContactRow row, const Vec3& w, const Mat3& W, Vec3 p) {
  for (int k = 0; k < 300; ++k) {
    talus::evaluate(w + W * p, row);
    const Vec3 error = p - row.impulse;
    if (error.norm() <= 1e-14 * (1 + p.norm())) break;
    Mat3 J = Mat3::Identity();
    if (row.state != ContactState::open) J += talus::tangent(row) * W;
    p -= k < 20 ? Vec3(J.partialPivLu().solve(error)) : Vec3(0.2 * error);
  }
  return p;
}

/// Gauss-Seidel over the contacts, each solved alone with the law of one block: slow, and
/// shares nothing with the island solver but the law.
Eigen::VectorXd gauss_seidel(const Island& island, int sweeps) {
  const Dense dense(island);
  const Eigen::MatrixXd response = dense.mass.ldlt().solve(dense.map.transpose());
  Eigen::VectorXd v = dense.free;
  std::vector<Vec3> impulse(2 * island.rows.size(), Vec3::Zero());
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    double change = 0;
    for (const int r : row_numbers(island)) {
      const auto c = static_cast<std::size_t>(r);
      const auto at = 3 * static_cast<Eigen::Index>(c);
      const Mat3 own = dense.map.middleRows(at, 3) * response.middleCols(at, 3);
      const Vec3 others = dense.map.middleRows(at, 3) * v - own * impulse[c];
      const Vec3 p = local_impulse(row_at(island, r), others, own, impulse[c]);
      v += response.middleCols(at, 3) * (p - impulse[c]);
      change = std::max(change, (p - impulse[c]).norm());
      impulse[c] = p;
    }
    if (change < 1e-13) break;
  }
  return v;
}

/// Largest violation of the balance of momentum and of the law, with both written out densely.
double dense_error(const Island& island) {
  const Dense dense(island);
  const Eigen::VectorXd v = stacked(island.velocity), w = dense.map * v;
  Eigen::VectorXd p = Eigen::VectorXd::Zero(w.size());
  double error = 0;
  for (const int r : row_numbers(island)) {
    const auto at = 3 * static_cast<Eigen::Index>(r);
    ContactRow row = row_at(island, r);
    const Vec3 impulse = row_of(island, r).impulse();
    p.segment(at, 3) = impulse;
    talus::evaluate(w.segment(at, 3), row);
    error = std::max(error, (row.impulse - impulse).norm() / row.normal_damping);
  }
  const Eigen::VectorXd balance =
      v - dense.free - dense.mass.ldlt().solve(dense.map.transpose() * p);
  return std::max(error, balance.cwiseAbs().maxCoeff());
}

LawOfScene soft_law(talus::Random& random) {
  LawOfScene law;
  law.stiffness_ratio = std::pow(10, random.uniform(-1, 0));
  law.friction = random.uniform(0, 0.6);
  return law;
}

Island random_pile(talus::Random& random, const LawOfScene& law) {
  const auto size = [&](std::uint64_t most) { return 1 + static_cast<int>(random.below(most)); };
  Island island = talus::scenes::pile({size(3), size(2), size(2)}, law, random);
  for (const int r : row_numbers(island)) {
    if (random.uniform() >= 0.2) continue;  // a bond
    row_of(island, r).set(&RowGroup::cohesion, 1e9);
    row_of(island, r).set(&RowGroup::tension, 1e9);
  }
  return island;
}

void expect_gauss_seidel(std::uint64_t seed, int rounds, int direct_bodies) {
  talus::Random random(seed, "solver");
  IslandWork work;
  IslandSettings settings;
  settings.direct_bodies = direct_bodies;
  for (int round = 0; round < rounds; ++round) {
    const LawOfScene law = soft_law(random);
    settings.tolerance = 1e-12 * law.gravity * law.step;
    Island island = random_pile(random, law);
    const Eigen::VectorXd expected = gauss_seidel(island, 1000);
    const IslandResult result = solve_island(island, settings, work);
    ASSERT_TRUE(result.converged) << result.residual;
    EXPECT_LT(dense_error(island), 1e-11 * law.gravity * law.step);
    EXPECT_LT((stacked(island.velocity) - expected).cwiseAbs().maxCoeff(),
              1e-9 * law.gravity * law.step);
  }
}

TEST(SolveIsland, AgreesWithGaussSeidelWhenFactored) { expect_gauss_seidel(21, 20, 30); }

TEST(SolveIsland, AgreesWithGaussSeidelByConjugateGradients) { expect_gauss_seidel(22, 20, 0); }

// p_n >= 0 and |p_t| <= tan(phi) p_n, p_n v_n + ... complementary up to the contact's compliance.
TEST(SolveIsland, KeepsImpulsesInTheirCones) {
  talus::Random random(31, "cone");
  IslandWork work;
  for (int round = 0; round < 50; ++round) {
    const LawOfScene law = soft_law(random);
    Island island = talus::scenes::pile({3, 3, 2}, law, random);
    IslandSettings settings;
    settings.tolerance = 1e-10 * law.gravity * law.step;
    ASSERT_TRUE(solve_island(island, settings, work).converged);
    const Dense dense(island);
    const Eigen::VectorXd w = dense.map * stacked(island.velocity);
    for (const int r : row_numbers(island)) {
      const ContactRow row = row_at(island, r);
      const double p_n = row.normal.dot(row.impulse);
      const double v_n = row.normal.dot(w.segment<3>(3 * static_cast<Eigen::Index>(r)));
      const double p_t = (row.impulse - p_n * row.normal).norm();
      EXPECT_GE(p_n, 0);
      EXPECT_LE(p_t, row.friction * p_n * (1 + 1e-12) + 1e-12);
      EXPECT_NEAR(p_n, std::max(0.0, -row.normal_damping * (v_n + row.bias)),
                  1e-8 * row.normal_damping * law.gravity * law.step);
    }
  }
}

// Linear and angular momentum of blocks that touch only each other, at the slide's loose tolerance.
TEST(SolveIsland, ConservesMomentumOfAClosedSystemToRounding) {
  talus::Random random(41, "momentum");
  IslandWork work;
  for (int round = 0; round < 50; ++round) {
    const LawOfScene law = soft_law(random);
    Island island = talus::scenes::pile({4, 3, 2}, law, random);
    std::erase_if(island.pairs, [](const BodyPair& pair) { return pair.b < 0; });
    IslandSettings settings;
    settings.tolerance = 1e-2 * law.gravity * law.step;
    ASSERT_TRUE(solve_island(island, settings, work).converged);
    Vec3 P = Vec3::Zero(), L = Vec3::Zero();
    double scale = 0;
    for (std::size_t i = 0; i < island.mass.size(); ++i) {
      const Vec6 change = island.mass[i] * (island.velocity[i] - island.free_velocity[i]);
      P += change.head<3>();
      L += change.tail<3>() + island.position[i].cross(change.head<3>());
      scale += change.norm();
    }
    EXPECT_GT(scale, 1);
    EXPECT_LT(P.norm(), 1e-13 * scale);
    EXPECT_LT(L.norm(), 1e-12 * scale);
  }
}

IslandResult solve_at_rest(Island& island, const LawOfScene& law, double tolerance) {
  IslandWork work;
  IslandSettings settings;
  settings.tolerance = tolerance * law.gravity * law.step;
  return solve_island(island, settings, work);
}

double pressed_on_ground(const Island& island) {
  double sum = 0;
  for (const BodyPair& pair : island.pairs)
    for (int r = pair.row_begin; r < pair.row_end && pair.b < 0; ++r)
      sum += row_of(island, r).impulse().z();
  return sum;
}

// The impulses of a stack at rest are the weights above: closed form.
TEST(SolveIsland, StackOf50CarriesTheWeightsAbove) {
  for (const double ratio : {1.0, 100.0, 1e4, 1e6}) {
    LawOfScene law;
    law.stiffness_ratio = ratio;
    Island island = talus::scenes::stack(50, law);
    const double weight = 2500 * law.gravity * law.step;
    for (const BodyPair& pair : island.pairs)  // overlaps of the static state
      for (int r = pair.row_begin; r < pair.row_end; ++r) {
        const auto row = row_of(island, r);
        row.set(&RowGroup::bias, -weight * (50 - pair.a) / 4 / row.normal_damping());
      }
    const IslandResult result = solve_at_rest(island, law, 1e-9);
    EXPECT_TRUE(result.converged) << ratio << ' ' << result.residual;
    for (const BodyPair& pair : island.pairs) {
      double sum = 0;
      for (int r = pair.row_begin; r < pair.row_end; ++r) sum += row_of(island, r).impulse().z();
      EXPECT_NEAR(sum, weight * (50 - pair.a), 1e-6 * weight);
    }
  }
}

TEST(SolveIsland, LargeBlockOnFourSmallOnesPressesWithItsWeight) {
  for (const double density : {2.5e-3, 2500.0, 25000.0})  // mass ratios 1, 1e6, 1e7
    for (const double ratio : {0.3, 100.0}) {
      LawOfScene law;
      law.stiffness_ratio = ratio;
      Island island = talus::scenes::block_on_feet(density, law);
      // Feet carry the large block's weight: the ground's stiffness is set for that.
      for (const int r : row_numbers(island))
        for (const auto field : {&RowGroup::normal_damping, &RowGroup::shear_damping})
          row_of(island, r).set(field, ratio * island.mass[0](0, 0));
      const IslandResult result = solve_at_rest(island, law, 1e-10);
      EXPECT_TRUE(result.converged) << density << ' ' << ratio << ' ' << result.residual;
      EXPECT_LE(result.passes, 4);
      const Dense dense(island);
      const Eigen::VectorXd v = stacked(island.velocity);
      const double momentum = (dense.mass * (v - dense.free)).dot(Eigen::VectorXd::Ones(v.size()));
      EXPECT_NEAR(pressed_on_ground(island), momentum, 1e-9 * momentum);
      for (std::size_t i = 1; i < island.mass.size(); ++i)  // feet are not squeezed out
        EXPECT_LT(island.velocity[i].head<2>().norm(), 1e-9 * law.gravity * law.step);
    }
}

TEST(SolveIsland, WallOf400BlocksConverges) {
  LawOfScene law;
  Island island = talus::scenes::wall(20, 20, law);
  const IslandResult result = solve_at_rest(island, law, 1e-9);
  EXPECT_TRUE(result.converged);
  EXPECT_EQ(result.factorisations, 0);
  EXPECT_LT(dense_error(island), 2e-9 * law.gravity * law.step);
}

// Elimination from the lowest body up adds nothing between bodies of a column: each linear solution
// is exact after one iteration, whatever the stiffness.
TEST(SolveIsland, AColumnIsEliminatedExactly) {
  for (const double ratio : {1.0, 1e3, 1e6}) {
    LawOfScene law;
    law.stiffness_ratio = ratio;
    Island island = talus::scenes::stack(100, law);
    IslandWork work;
    IslandSettings settings;
    settings.direct_bodies = settings.direct_fallback = 0;
    settings.tolerance = 1e-6 * law.gravity * law.step;
    const IslandResult result = solve_island(island, settings, work);
    EXPECT_TRUE(result.converged) << ratio << ' ' << result.residual;
    EXPECT_LE(result.linear_iterations, result.passes) << ratio;
  }
}

// Contacts that stick, slide and open at random, up to a hundred times as stiff as masses ask for.
TEST(SolveIsland, PilesConvergeByRelaxing) {
  struct Try {
    double ratio;
    int passes;
  };
  talus::Random random(53, "held");
  for (const auto& [ratio, passes] : {Try{10, 200}, Try{100, 1000}})
    for (const int direct_bodies : {0, 100}) {
      LawOfScene law;
      law.stiffness_ratio = ratio;
      law.friction = 0.7;
      Island island = talus::scenes::pile({3, 3, 4}, law, random);
      IslandWork work;
      IslandSettings settings;
      settings.direct_bodies = direct_bodies;
      settings.max_passes = passes;
      settings.tolerance = 1e-6 * law.gravity * law.step;
      const IslandResult result = solve_island(island, settings, work);
      EXPECT_TRUE(result.converged) << ratio << ' ' << direct_bodies << ' ' << result.residual;
      EXPECT_LT(dense_error(island), 2 * settings.tolerance) << ratio;
    }
}

// Cobbles between the ground and an overhanging face of a block 5,000 times as heavy, which presses
// them into the wedge of the two: friction jams them, so that forces are a thousand times as large
// in one solution as in another that is next to it.
Island jammed_cobbles(talus::Random& random, int n_cobbles) {
  LawOfScene law;
  law.step = 5e-3;
  law.friction = random.uniform(0.36, 1.2);
  Island island;
  const int heavy = add_box({Vec3(0, 0, 2.2), Vec3::Constant(2)}, law, island);
  const auto velocity = [&] { return Vec3(random.normal(), random.normal(), random.normal()); };
  island.free_velocity[0].head<3>() = velocity() - Vec3(0, 0, 0.5);
  island.free_velocity[0].tail<3>() = 0.2 * velocity();
  for (int i = 0; i < n_cobbles; ++i) {
    const double angle = random.uniform(0, 6.283), tilt = random.uniform(0.35, 1.0);
    const Vec3 outwards(std::cos(angle), std::sin(angle), 0);
    const Vec3 centre = 2.2 * outwards + Vec3(0, 0, 0.15);
    const int cobble = add_box({centre, Vec3(0.12, 0.11, 0.13)}, law, island);
    const auto k = static_cast<std::size_t>(cobble);
    island.free_velocity[k].head<3>() = 0.5 * velocity();
    island.free_velocity[k].tail<3>() = 2 * velocity();
    const auto near = [&](double height) {
      return Vec3(centre + Vec3(random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), height));
    };
    const Vec3 face = std::sin(tilt) * outwards - std::cos(tilt) * Vec3::UnitZ();
    const double overlap = 1e-5 * random.uniform();
    add_contacts(cobble, -1, Vec3::UnitZ(), {near(-0.13), near(-0.13), near(-0.13)}, overlap, law,
                 island);
    add_contacts(cobble, heavy, face, {near(0.12), near(0.12)}, overlap, law, island);
  }
  for (const int r : row_numbers(island)) {
    const double stiffness = 3e5 * island.mass[1](0, 0);
    row_of(island, r).set(&RowGroup::normal_damping, stiffness);
    row_of(island, r).set(&RowGroup::shear_damping, 0.4 * stiffness);
  }
  return island;
}

TEST(SolveIsland, FindsWhatJamsLightBlocksUnderAHeavyOne) {
  talus::Random random(51, "jam");
  IslandWork work;
  int n_found = 0;
  for (int round = 0; round < 60; ++round) {
    Island island = jammed_cobbles(random, 1 + round % 4);
    IslandSettings settings;
    settings.tolerance = 5e-10;
    if (!solve_island(island, settings, work).converged) continue;
    ++n_found;
    EXPECT_LT(dense_error(island), 1e-6) << round;
  }
  EXPECT_GE(n_found, 58);
}

// A push at one end of 200 blocks in a row travels through all of them in one step when they are
// hard.
TEST(SolveIsland, PushTravelsThroughALongChain) {
  LawOfScene law;
  law.gravity = 0;
  law.stiffness_ratio = 1e6;
  Island island;
  for (int i = 0; i < 200; ++i) {
    talus::scenes::add_box({Vec3(i, 0, 0), Vec3::Constant(0.5)}, law, island);
    if (i > 0)
      talus::scenes::add_contacts(
          i - 1, i, -Vec3::UnitX(),
          talus::scenes::rectangle(Vec3(i - 0.5, 0, 0), Vec3(0, 0.5, 0), Vec3(0, 0, 0.5)), 0, law,
          island);
  }
  island.free_velocity[0][0] = 200;
  IslandWork work;
  IslandSettings settings;
  settings.tolerance = 1e-7;
  const IslandResult result = solve_island(island, settings, work);
  EXPECT_TRUE(result.converged) << result.residual;
  for (const auto& v : island.velocity) EXPECT_NEAR(v[0], 1, 0.1);  // compliance 200 x 200 / 1e6
}

// Whatever the stiffness, the outcome is finite, and either satisfies the law or says that it does
// not.
TEST(SolveIsland, StaysFiniteAndHonestOver20DecadesOfStiffness) {
  talus::Random random(51, "stiffness");
  IslandWork work;
  int n_converged = 0, n = 0;
  for (int decade = -6; decade <= 14; ++decade)
    for (int round = 0; round < 10; ++round) {
      LawOfScene law;
      law.stiffness_ratio = std::pow(10.0, decade);
      Island island = talus::scenes::pile({2, 2, 2}, law, random);
      IslandSettings settings;
      settings.tolerance = 1e-6 * law.gravity * law.step;
      const IslandResult result = solve_island(island, settings, work);
      ++n;
      for (const auto& v : island.velocity) ASSERT_TRUE(v.allFinite());
      for (const int r : row_numbers(island)) ASSERT_TRUE(row_of(island, r).impulse().allFinite());
      if (decade != 8) {
        EXPECT_EQ(result.n_lowered > 0, decade > 8);
      }
      if (!result.converged) {
        EXPECT_GT(result.residual, settings.tolerance);
        continue;
      }
      ++n_converged;
      if (decade <= 3) {
        EXPECT_LT(dense_error(island), 2 * settings.tolerance) << decade;
      }
    }
  EXPECT_GT(n_converged, n / 2);
}

// In a substep of a few nanoseconds contacts hardly press, and the tolerance asked for is below the
// rounding of the velocities.
TEST(SolveIsland, IsNotAskedForMoreThanTheRoundingOfItsVelocities) {
  talus::Random random(91, "rounding");
  LawOfScene law;
  law.stiffness_ratio = 1e-9;
  for (int round = 0; round < 100; ++round) {
    Island island = talus::scenes::stack(1, law);
    for (int k = 0; k < 3; ++k) island.free_velocity[0][k] = random.uniform(-30, 30);
    IslandWork work;
    EXPECT_TRUE(solve_island(island, IslandSettings{.tolerance = 1e-20}, work).converged);
  }
}

// ... nor below that of the velocity of the other body, or of its points.
TEST(SolveIsland, IsNotAskedForMoreThanTheRoundingOfABlockThatSlidesOrSpinsOnAnother) {
  talus::Random random(92, "rounding");
  LawOfScene law;
  law.stiffness_ratio = 2e4;
  for (const int first : {0, 3})
    for (int round = 0; round < 100; ++round) {
      Island island = talus::scenes::stack(2, law);
      for (int k = 0; k < 3; ++k) island.free_velocity[1][first + k] += random.uniform(-30, 30);
      IslandWork work;
      EXPECT_TRUE(solve_island(island, IslandSettings{.tolerance = 1e-20}, work).converged);
    }
}

TEST(SolveIsland, NeverHidesWhatItCannotSolve) {
  LawOfScene law;
  Island island = talus::scenes::stack(4, law);
  IslandWork work;
  IslandSettings settings;
  settings.tolerance = 1e-9;
  settings.max_passes = 2;
  talus::Random random(61, "hidden");
  Island pile = talus::scenes::pile({3, 3, 3}, law, random);
  const IslandResult few = solve_island(pile, settings, work);
  EXPECT_FALSE(few.converged);
  EXPECT_GT(few.residual, settings.tolerance);

  island.free_velocity[2][1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(solve_island(island, IslandSettings{.tolerance = 1e-9}, work).converged);

  island = talus::scenes::stack(4, law);
  island.velocity[1][0] = std::numeric_limits<double>::quiet_NaN();  // a bad guess does no harm
  EXPECT_TRUE(solve_island(island, IslandSettings{.tolerance = 1e-9}, work).converged);
}

// Two bodies that fall side by side, a centimetre apart: the free motion is the solution, and
// neither evaluated twice nor factored.
TEST(SolveIsland, TakesTheFreeMotionOfBodiesThatDoNotTouch) {
  const LawOfScene law;
  Island island;
  const int a = talus::scenes::add_box({Vec3(0, 0, 5), Vec3(1, 1, 1)}, law, island);
  const int b = talus::scenes::add_box({Vec3(2.01, 0, 5), Vec3(1, 1, 1)}, law, island);
  talus::scenes::add_contacts(a, b, -Vec3::UnitX(), {Vec3(1, 0, 5)}, -0.01, law, island);
  island.velocity = island.free_velocity;
  IslandWork work;
  const IslandResult result = solve_island(island, IslandSettings{.tolerance = 1e-12}, work);
  EXPECT_TRUE(result.converged);
  EXPECT_EQ(result.passes, 1);
  EXPECT_EQ(result.factorisations, 0);
  for (const int body : {a, b})
    EXPECT_EQ(island.velocity[static_cast<std::size_t>(body)],
              island.free_velocity[static_cast<std::size_t>(body)]);
}

// A solution that continues after a few rows changed is that of the changed island, and its cost
// grows with the changes; without a change, it is the same to the bit.
TEST(SolveIsland, GoesOnFromItsLastSolution) {
  talus::Random random(81, "continues");
  const LawOfScene law;
  for (const int direct_bodies : {0, 100}) {
    Island island = talus::scenes::pile({4, 4, 3}, law, random);
    IslandWork work;
    IslandSettings settings;
    settings.direct_bodies = direct_bodies;
    settings.tolerance = 1e-12 * law.gravity * law.step;
    ASSERT_TRUE(solve_island(island, settings, work).converged);
    settings.continues = true;
    const std::vector<Vec6> before = island.velocity;
    EXPECT_EQ(solve_island(island, settings, work).passes, 1);
    EXPECT_EQ(work.touched_bodies.items.size(), 0);
    EXPECT_EQ(stacked(island.velocity), stacked(before));

    for (const std::size_t p : {std::size_t{3}, island.pairs.size() / 2}) {
      BodyPair& pair = island.pairs[p];
      const auto row = row_of(island, pair.row_begin);
      row.set(&RowGroup::bias, row.bias() - law.gravity * law.step);
      island.free_velocity[static_cast<std::size_t>(pair.a)][0] += 0.1 * law.gravity * law.step;
      pair.changed = true;
    }
    Island afresh = island;
    ASSERT_TRUE(solve_island(island, settings, work).converged);
    for (const BodyPair& pair : island.pairs) EXPECT_FALSE(pair.changed);
    IslandWork other;
    settings.continues = false;
    ASSERT_TRUE(solve_island(afresh, settings, other).converged);
    EXPECT_LT(dense_error(island), 1e-11 * law.gravity * law.step);
    EXPECT_LT((stacked(island.velocity) - stacked(afresh.velocity)).cwiseAbs().maxCoeff(),
              1e-9 * law.gravity * law.step);
    EXPECT_GT((stacked(island.velocity) - stacked(before)).cwiseAbs().maxCoeff(),
              1e-2 * law.gravity * law.step);
  }
}

TEST(SolveIsland, GivesTheSameBitsWithNewAndUsedScratch) {
  talus::Random random(71, "bits");
  const LawOfScene law;
  const Island start = talus::scenes::pile({4, 4, 4}, law, random);
  Island first = start, second = start, other = talus::scenes::wall(5, 7, law);
  IslandWork fresh, used;
  IslandSettings settings;
  settings.tolerance = 1e-6;
  (void)solve_island(other, settings, used);
  const IslandResult a = solve_island(first, settings, fresh);
  const IslandResult b = solve_island(second, settings, used);
  EXPECT_EQ(a.passes, b.passes);
  EXPECT_EQ(a.linear_iterations, b.linear_iterations);
  for (std::size_t i = 0; i < first.velocity.size(); ++i)
    EXPECT_EQ(first.velocity[i], second.velocity[i]);
}

// A wall that moves: laws, tangents, factor and conjugate gradients are all shared.
TEST(SolveIsland, SharedInTwoThreadsAndMoreGivesTheSameBits) {
  talus::Random random(72, "threads");
  const LawOfScene law;
  Island start = talus::scenes::wall(20, 20, law);
  for (Vec6& v : start.free_velocity)
    for (int k = 0; k < 3; ++k) v[k] += law.gravity * law.step * (random.uniform() - 0.5);
  IslandSettings settings;
  settings.tolerance = 1e-9 * law.gravity * law.step;
  Island alone = start;
  IslandWork work;
  const IslandResult one = solve_island(alone, settings, work);
  EXPECT_TRUE(one.converged);
  EXPECT_GT(one.linear_iterations, 10);
  for (const int n_threads : {2, 3, 4}) {
    talus::Workers workers(n_threads);
    IslandWork shared_work;
    shared_work.matrix.workers = &workers;
    Island shared = start;
    const IslandResult result = solve_island(shared, settings, shared_work);
    EXPECT_EQ(result.passes, one.passes) << n_threads;
    EXPECT_EQ(result.linear_iterations, one.linear_iterations) << n_threads;
    for (std::size_t i = 0; i < alone.velocity.size(); ++i)
      ASSERT_EQ(shared.velocity[i], alone.velocity[i]) << n_threads << " threads, body " << i;
  }
}

}  // namespace
