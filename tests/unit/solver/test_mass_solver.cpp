// The mass solver: law of contact, equal bits, limits.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "base/random.hpp"
#include "solver/mass_solver.hpp"

namespace {

using talus::MassPair;
using talus::MassRow;
using talus::MassSystem;
using talus::Vec3;

const talus::MassSettings usual{
    .sweeps = 12, .most_sweeps = 12, .settled = 0, .compliance = 1e-3, .shear_ratio = 0.4};

Vec3 of_floats(const float (&from)[3]) { return {from[0], from[1], from[2]}; }

Vec3 random_vector(talus::Random& random) {
  return {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
}

void set(const Vec3& from, float (&to)[3]) {
  for (int k = 0; k < 3; ++k) to[k] = static_cast<float>(from[k]);
}

void add_body(double mass, MassSystem& system) {
  talus::MassInertia inertia;
  inertia.inverse_mass = static_cast<float>(1 / mass);
  inertia.xx = inertia.yy = inertia.zz = static_cast<float>(6 / mass);  // of a cube of 1 m
  system.inertia.push_back(inertia);
}

void add_row(const Vec3& normal, const Vec3& arm_a, const Vec3& arm_b, const Vec3& velocity,
             MassSystem& system) {
  MassRow row;
  set(normal, row.normal);
  set(arm_a, row.arm_a);
  set(arm_b, row.arm_b);
  set(velocity, row.velocity);
  const Vec3 slip = velocity - normal.dot(velocity) * normal;
  if (slip.norm() > 0) set(slip.normalized(), row.slip_start);
  row.friction = 0.5F;
  row.limit = 1e30F;
  system.rows.push_back(row);
}

// Bodies of masses over so many decades, each with a few partners, some with several pairs, and
// with the ground.
MassSystem random_mass(int n, int most_rows, double decades) {
  talus::Random random(3, "mass");
  MassSystem system;
  for (int k = 0; k < n; ++k) add_body(std::pow(10, random.uniform(0, decades)), system);
  for (int k = 0; k < 3 * n; ++k) {
    MassPair pair;
    pair.a = static_cast<int>(random.uniform(0, n));
    pair.b = k % 7 == 0 ? -1 : static_cast<int>(random.uniform(0, n));
    if (pair.a == pair.b) continue;
    pair.row_begin = static_cast<int>(system.rows.size());
    const Vec3 normal = random_vector(random).normalized();
    const int n_rows = 1 + static_cast<int>(random.uniform(0, most_rows));
    for (int r = 0; r < n_rows; ++r) {
      const Vec3 arm_b = pair.b < 0 ? Vec3(Vec3::Zero()) : random_vector(random);
      add_row(normal, random_vector(random), arm_b, random_vector(random), system);
      set(random.uniform(0, 0.1) * normal, system.rows.back().impulse);
    }
    pair.row_end = static_cast<int>(system.rows.size());
    system.pairs.push_back(pair);
  }
  return system;
}

// Change of the velocity of A's point relative to B's by all impulses, in doubles.
std::vector<Vec3> changes(const MassSystem& system) {
  std::vector<Vec3> velocity(system.inertia.size(), Vec3::Zero()), spin = velocity, out;
  const auto push = [&](int k, const Vec3& arm, const Vec3& impulse) {
    velocity[k] += static_cast<double>(system.inertia[k].inverse_mass) * impulse;
    spin[k] += static_cast<double>(system.inertia[k].xx) * arm.cross(impulse);
  };
  for (const MassPair& pair : system.pairs)
    for (int r = pair.row_begin; r < pair.row_end; ++r) {
      const MassRow& row = system.rows[r];
      push(pair.a, of_floats(row.arm_a), of_floats(row.impulse));
      if (pair.b >= 0) push(pair.b, of_floats(row.arm_b), -of_floats(row.impulse));
    }
  for (const MassPair& pair : system.pairs)
    for (int r = pair.row_begin; r < pair.row_end; ++r) {
      const MassRow& row = system.rows[r];
      Vec3 v = velocity[pair.a] + spin[pair.a].cross(of_floats(row.arm_a));
      if (pair.b >= 0) v -= velocity[pair.b] + spin[pair.b].cross(of_floats(row.arm_b));
      out.push_back(v);
    }
  return out;
}

// Whatever the lanes computed at a time, the bits are the same.
TEST(MassSolver, HasTheSameBitsAtAnyWidth) {
  if (talus::widest_mass_lanes() < 8) GTEST_SKIP() << "no AVX2";
  MassSystem four = random_mass(100, 6, 3), eight = four;
  const talus::MassResult a = solve_mass(usual, four, 4), b = solve_mass(usual, eight, 8);
  EXPECT_EQ(a.change, b.change);
  EXPECT_GT(a.change, 0);
  for (std::size_t r = 0; r < four.rows.size(); ++r)
    for (int k = 0; k < 3; ++k) ASSERT_EQ(four.rows[r].impulse[k], eight.rows[r].impulse[k]) << r;
}

// Bodies in a row fly at a wall. Too few sweeps leave them closing on one another, not on the wall.
TEST(MassSolver, WhatStandsIsNotEnteredByAnUnfinishedSolution) {
  MassSystem system;
  const Vec3 away(-1, 0, 0), speed(1, 0, 0), none = Vec3::Zero();
  for (int k = 0; k < 8; ++k) {
    add_body(1, system);
    system.pairs.push_back({k, k - 1, k, k + 1});  // the first one with the wall
    add_row(away, none, none, k == 0 ? speed : none, system);
  }
  talus::MassSettings settings = usual;
  settings.sweeps = settings.most_sweeps = 4;
  solve_mass(settings, system, talus::widest_mass_lanes());
  const std::vector<Vec3> dv = changes(system);
  EXPECT_GT(away.dot(speed + dv[0]), -0.01);
  double largest = 0;
  for (std::size_t r = 1; r < dv.size(); ++r) largest = std::max(largest, -away.dot(dv[r]));
  EXPECT_GT(largest, 0.1);
}

// A pressed contact does not move or yields by its compliance, an open one parts, friction is
// bounded.
TEST(MassSolver, FulfilsTheLawOfContact) {
  MassSystem system = random_mass(200, 1, 1);
  talus::MassSettings settings = usual;
  settings.sweeps = settings.most_sweeps = 3000;
  solve_mass(settings, system, talus::widest_mass_lanes());
  const std::vector<Vec3> dv = changes(system);
  int n_stick = 0, n_slip = 0, n_open = 0;
  for (std::size_t r = 0; r < system.rows.size(); ++r) {
    const MassRow& row = system.rows[r];
    const Vec3 n = of_floats(row.normal), p = of_floats(row.impulse);
    const Vec3 w = of_floats(row.velocity) + dv[r];
    const double p_n = n.dot(p), w_n = n.dot(w);
    const Vec3 p_t = p - p_n * n, w_t = w - w_n * n;
    if (p_n == 0) {
      ++n_open;
      EXPECT_GT(w_n, -2e-3);
      continue;
    }
    EXPECT_NEAR(p_n, -static_cast<double>(row.damping) * w_n, 0.05 * p_n + 2e-3 * row.damping);
    EXPECT_LT(p_t.norm(), 0.5 * p_n * (1 + 1e-4) + 1e-6);
    if (p_t.norm() > 0.5 * p_n * (1 - 1e-4)) {
      ++n_slip;
      EXPECT_LT(p_t.dot(w_t), 1e-3);
    } else {
      ++n_stick;
      EXPECT_LT(w_t.norm(), 0.02);
    }
  }
  EXPECT_GT(n_open, 50);
  EXPECT_GT(n_slip, 50);
  EXPECT_GT(n_stick, 5);
}

// A body with more neighbours than there are colours.
TEST(MassSolver, SolvesABodyOnAHundredOthers) {
  MassSystem system;
  const int n = 100;
  for (int k = 0; k < n; ++k) add_body(1, system);
  add_body(1000, system);
  const Vec3 up = Vec3::UnitZ(), half = up / 2, down(0, 0, -0.05);
  for (int k = 0; k < n; ++k) {
    const int first = static_cast<int>(system.rows.size());
    add_row(up, -half, Vec3::Zero(), down, system);
    system.pairs.push_back({k, -1, first, first + 1});
  }
  for (int k = 0; k < n; ++k) {
    const int first = static_cast<int>(system.rows.size());
    add_row(up, -half, half, Vec3::Zero(), system);
    system.pairs.push_back({n, k, first, first + 1});
  }
  talus::MassSettings settings = usual;
  settings.sweeps = settings.most_sweeps = 96;
  settings.compliance = 1e-5;
  solve_mass(settings, system, talus::widest_mass_lanes());
  double on_ground = 0, on_small = 0;
  for (int r = 0; r < n; ++r) {
    on_ground += static_cast<double>(system.rows[r].impulse[2]);
    on_small += static_cast<double>(system.rows[n + r].impulse[2]);
  }
  EXPECT_NEAR(on_small, 1000 * 0.05, 0.5);
  EXPECT_NEAR(on_ground, 1100 * 0.05, 0.5);
}

// The other side yields: no more than its limit.
TEST(MassSolver, StaysBelowTheLimitOfARow) {
  MassSystem system;
  add_body(2, system);
  add_row(Vec3::UnitX(), Vec3::Zero(), Vec3::Zero(), Vec3(-3, 0, 0), system);
  system.rows[0].limit = 4;
  system.pairs.push_back({0, -1, 0, 1});
  solve_mass(usual, system, 4);
  EXPECT_EQ(system.rows[0].impulse[0], 4);
}

// A couple up to the arm times the normal impulse; up to that it stops the spin.
TEST(MassSolver, ResistsRolling) {
  for (const double arm : {0.01, 1.0}) {
    MassSystem system;
    add_body(6, system);  // inertia 1
    add_row(Vec3::UnitZ(), Vec3::Zero(), Vec3::Zero(), Vec3(0, 0, -1), system);
    system.pairs.push_back({0, -1, 0, 1});
    talus::MassTurn turn;
    turn.damping = 1e4;
    turn.inertia = 1;
    turn.spin = Vec3(0.5, 0, 0);
    system.turns.push_back(turn);
    system.arms.push_back({arm, 0});
    solve_mass(usual, system, 4);
    const double p_n = static_cast<double>(system.rows[0].impulse[2]);
    EXPECT_NEAR(p_n, 6, 0.01);
    EXPECT_NEAR(system.turns[0].couple.x(), -std::min(0.5, arm * p_n), 1e-3) << arm;
  }
}

// Two columns on the ground, the second held up by the first too; a body that touches nothing.
TEST(MassSolver, LayersAreCountedFromTheGround) {
  MassSystem system;
  for (int k = 0; k < 8; ++k) add_body(1, system);
  const auto touch = [&](int a, int b) { system.pairs.push_back({.a = a, .b = b}); };
  EXPECT_EQ(talus::layers_on_ground(system), 0);
  touch(3, 2), touch(1, 2), touch(1, 0), touch(0, -1);
  EXPECT_EQ(talus::layers_on_ground(system), 4);
  touch(4, -1), touch(4, 5), touch(6, 5);
  EXPECT_EQ(talus::layers_on_ground(system), 4);
  touch(6, 3);
  EXPECT_EQ(talus::layers_on_ground(system), 4);
  touch(3, -1);
  EXPECT_EQ(talus::layers_on_ground(system), 2);
}

}  // namespace
