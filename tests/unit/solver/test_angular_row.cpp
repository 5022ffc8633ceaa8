// Angular rows: a couple bounded by the normal impulses of its pair. A disc that rolls on a plane
// with rolling resistance M <= e N, its radius R, slows down by e g / R / (1 + J / (m R^2)), and
// stands on a slope up to tan(dip) = e / R.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "solver/island_solver.hpp"
#include "solver/newton.hpp"
#include "solver/one_contact.hpp"

namespace {

using namespace talus;

constexpr double g = 10, step = 1e-2, radius = 0.5, arm = 0.02, mass = 3;
constexpr double inertia = 0.5 * mass * radius * radius;
constexpr double damping = 1e7;  // of the contact [kg], which then hardly gives
const double rolling_mass = mass + inertia / (radius * radius);

Mat6 mass_of_disc() {
  Mat6 M = Mat6::Zero();
  M.diagonal() << Vec3::Constant(mass), Vec3::Constant(inertia);
  return M;
}

// Rolls along x: its spin is about y.
ContactRow contact_of_disc() {
  ContactRow row;
  row.normal = Vec3::UnitZ();
  row.arm = Vec3(0, 0, -radius);
  row.normal_damping = row.shear_damping = damping;
  row.friction = 1;
  return row;
}

AngularRow resistance() {
  AngularRow turn;
  turn.row_end = 1;
  turn.arm = arm;
  turn.damping = damping;
  return turn;
}

Vec6 rolling(double speed) {
  Vec6 v = Vec6::Zero();
  v[0] = speed, v[4] = speed / radius;
  return v;
}

Vec6 pull(double dip) {
  Vec6 v = Vec6::Zero();
  v[0] = g * std::sin(dip) * step, v[2] = -g * std::cos(dip) * step;
  return v;
}

// A step of the disc alone from velocity `v`.
struct Lone {
  BlockSystem<6> system;
  std::array<ContactRow, 1> rows = {contact_of_disc()};
  std::array<AngularRow, 1> turns = {resistance()};

  Vec6 step_from(const Vec6& v, double dip) {
    system.mass = mass_of_disc();
    system.free_velocity = system.velocity = v + pull(dip);
    system.tolerance = 1e-12;
    system.angular = turns;
    EXPECT_TRUE(solve_contacts(system, std::span(rows), 60).converged);
    return system.velocity;
  }
};

// The same as an island: the disc on the ground, or on a body of its own.
struct InIsland {
  Island island;
  IslandWork work;
  int direct_bodies = 8;

  Vec6 step_from(const Vec6& v, double dip) {
    island = {};
    island.mass = {mass_of_disc()};
    island.free_velocity = island.velocity = {Vec6(v + pull(dip))};
    island.position = {Vec3::Zero()};
    island.radius = {radius};
    return solved(-1);
  }
  Vec6 solved(int other) {
    open_pair(0, other, island);
    add_row(contact_of_disc(), island);
    island.angular = {resistance()};
    island.pairs[0].angular = 0;
    IslandSettings settings;
    settings.tolerance = 1e-12;
    settings.direct_bodies = direct_bodies;
    EXPECT_TRUE(solve_island(island, settings, work).converged);
    return island.velocity[0];
  }
};

template <class Disc>
void expect_to_slow_down(Disc disc) {
  const double loss = arm / radius * mass * g * step / rolling_mass;
  Vec6 v = rolling(1);
  for (int i = 1; i <= 20; ++i) {
    v = disc.step_from(v, 0);
    EXPECT_NEAR(v[0], 1 - i * loss, 1e-6);
    EXPECT_NEAR(v[4], v[0] / radius, 1e-5);
  }
}

TEST(AngularRow, SlowsADiscThatRollsAsInClosedForm) { expect_to_slow_down(Lone()); }
TEST(AngularRow, SlowsItInAnIslandThatIsFactored) { expect_to_slow_down(InIsland()); }
TEST(AngularRow, SlowsItInAnIslandByConjugateGradients) {
  InIsland disc;
  disc.direct_bodies = 0;
  expect_to_slow_down(disc);
}

template <class Disc>
void expect_to_stand_up_to_its_slope(Disc disc) {
  const double steepest = std::atan(arm / radius);
  Vec6 v = Vec6::Zero();
  for (int i = 0; i < 20; ++i) v = disc.step_from(v, 0.99 * steepest);
  EXPECT_LT(v.norm(), 1e-6);
  v = disc.step_from(Vec6::Zero(), 1.01 * steepest);
  const double dip = 1.01 * steepest;
  const double pulled = std::sin(dip) - arm / radius * std::cos(dip);
  EXPECT_NEAR(v[0], mass * g * step * pulled / rolling_mass, 1e-7);
}

TEST(AngularRow, HoldsADiscUpToTheSlopeOfItsArm) { expect_to_stand_up_to_its_slope(Lone()); }
TEST(AngularRow, HoldsItInAnIsland) { expect_to_stand_up_to_its_slope(InIsland()); }

TEST(AngularRow, StopsADiscAndDoesNotTurnItBack) {
  Lone disc;
  EXPECT_LT(disc.step_from(rolling(1e-3), 0).norm(), 1e-6);
  EXPECT_EQ(disc.turns[0].state, ContactState::stick);
}

TEST(AngularRow, BearsNothingWhereNothingPresses) {
  Lone disc;
  Vec6 v = rolling(1);
  v[2] = 1;
  EXPECT_EQ(disc.step_from(v, 0), v + pull(0));
  EXPECT_TRUE(disc.turns[0].couple.isZero(0));
  EXPECT_EQ(disc.turns[0].state, ContactState::open);
}

TEST(AngularRow, TakesItsSpringForSpin) {
  AngularRow row = resistance();
  row.damping = 2;
  row.spring_spin = Vec3(0, 0.25, 0);
  evaluate(Vec3(0, 0.5, 0), 100, row);
  EXPECT_EQ(row.couple, Vec3(0, -1.5, 0));
  evaluate(Vec3(0, 0.75, 0), 100, row);  // 2 x 1 is what it bears
  EXPECT_EQ(row.state, ContactState::stick);
  evaluate(Vec3(0, 0.76, 0), 100, row);
  EXPECT_EQ(row.state, ContactState::slip);
  EXPECT_EQ(row.couple, Vec3(0, -2, 0));
}

// The disc rolls on a plate that is free to move: what it loses the plate has.
TEST(AngularRow, KeepsMomentumBetweenTwoBodies) {
  InIsland disc;
  Island& island = disc.island;
  Mat6 plate = 10 * mass_of_disc();
  island.mass = {mass_of_disc(), plate};
  Vec6 down = rolling(1);
  down[2] = -0.1;
  island.free_velocity = island.velocity = {down, Vec6(Vec6::Zero())};
  island.position = {Vec3(0, 0, radius), Vec3(0.1, 0, -0.2)};
  island.radius = {radius, 1};
  const auto momentum = [&] {
    Vec6 sum = Vec6::Zero();
    for (std::size_t i = 0; i < 2; ++i) {
      const Vec6 p = times_mass(island.mass[i], island.velocity[i]);
      sum += p;
      sum.tail<3>() += island.position[i].cross(p.head<3>());
    }
    return sum;
  };
  const Vec6 before = momentum();
  (void)disc.solved(1);
  EXPECT_LT((momentum() - before).norm(), 1e-13);
  const double pressed = row_of(island, 0).normal_impulse();
  EXPECT_GT(pressed, 0.1);
  EXPECT_NEAR(island.angular[0].couple.norm(), arm * pressed, 1e-12);
}

}  // namespace
