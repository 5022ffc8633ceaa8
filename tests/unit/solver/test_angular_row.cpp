// Angular rows: a couple bounded by the normal impulses of its pair. A disc that rolls on a plane
// with rolling resistance M <= e N, its radius R, slows down by e g / R / (1 + J / (m R^2)), and
// rests on a slope up to tan(dip) = e / R.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

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
  turn.damping = damping;
  turn.inertia = inertia;
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
  std::array<RowArm, 1> arms = {RowArm{arm, arm}};

  Vec6 step_from(const Vec6& v, double dip) {
    system.mass = mass_of_disc();
    system.free_velocity = system.velocity = v + pull(dip);
    system.tolerance = 1e-12;
    system.angular = turns;
    system.arms = arms;
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
    island.arms = {RowArm{arm, arm}};
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
  EXPECT_EQ(disc.turns[0].rolling.state, ContactState::stick);
}

TEST(AngularRow, CarriesNothingWhereNothingPresses) {
  Lone disc;
  Vec6 v = rolling(1);
  v[2] = 1;
  EXPECT_EQ(disc.step_from(v, 0), v + pull(0));
  EXPECT_TRUE(disc.turns[0].couple.isZero(0));
  EXPECT_EQ(disc.turns[0].rolling.state, ContactState::open);
}

// In the step in which it stops, Newton's method finds that in few passes.
TEST(AngularRow, StopsADiscInFewPasses) {
  for (const double speed : {0.2, 0.5, 0.9, 1.0, 1.2}) {
    Lone disc;
    disc.system.mass = mass_of_disc();
    const double loss = arm / radius * mass * g * step / rolling_mass;
    disc.system.free_velocity = disc.system.velocity = rolling(speed * loss) + pull(0);
    disc.system.tolerance = 1e-12;
    disc.system.angular = disc.turns;
    disc.system.arms = disc.arms;
    const NewtonResult result = solve_contacts(disc.system, std::span(disc.rows), 60);
    EXPECT_TRUE(result.converged) << speed;
    EXPECT_LE(result.passes, 12) << speed;
  }
}

// Rolling across the normal and pivoting along it have bounds of their own.
TEST(AngularRow, BoundsRollingAndPivotingApart) {
  AngularRow row;
  row.damping = 2;
  CoupleBounds bounds;
  bounds.add({0.02, 0.05}, 60, Vec3::UnitZ());
  bounds.add({0.02, 0.05}, 40, Vec3::UnitZ());
  bounds.add({0.02, 0.05}, -1, Vec3::UnitZ());  // pulls
  evaluate(Vec3(0, 0.5, 0), bounds, row);
  EXPECT_EQ(row.couple, Vec3(0, -1, 0));
  EXPECT_EQ(row.rolling.state, ContactState::stick);
  evaluate(Vec3(0, 3, 10), bounds, row);
  EXPECT_EQ(row.couple, Vec3(0, -2, -5));
  EXPECT_EQ(row.rolling.state, ContactState::slip);
  EXPECT_EQ(row.spinning.state, ContactState::slip);
  evaluate(Vec3(0, 0, -1), bounds, row);
  EXPECT_EQ(row.couple, Vec3(0, 0, 2));
}

// The disc rolls on a plate that is free to move: the plate takes the momentum that it loses.
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

// --- a ball ------------------------------------------------------------------------------------

constexpr double earth = 9.80665;

/// A ball that rolls or pivots on a plane in steps of `h`.
struct Ball {
  double h, dip = 0, rolling = 0, spinning = 0, friction = 1;
  Vec6 velocity = Vec6::Zero();
  double path = 0;

  static Mat6 mass_matrix() {
    Mat6 M = Mat6::Zero();
    M.diagonal() << Vec3::Constant(mass), Vec3::Constant(0.4 * mass * radius * radius);
    return M;
  }
  void advance() {
    BlockSystem<6> system;
    std::array<ContactRow, 1> rows = {contact_of_disc()};
    rows[0].friction = friction;
    std::array<AngularRow, 1> turns = {resistance()};
    const std::array<RowArm, 1> arms = {RowArm{rolling * radius, spinning * radius}};
    Vec6 pulled = Vec6::Zero();
    pulled[0] = earth * std::sin(dip) * h, pulled[2] = -earth * std::cos(dip) * h;
    system.mass = mass_matrix();
    system.free_velocity = system.velocity = velocity + pulled;
    system.tolerance = 1e-12;
    system.angular = turns;
    system.arms = arms;
    EXPECT_TRUE(solve_contacts(system, std::span(rows), 60).converged);
    path += h / 2 * (velocity[0] + system.velocity[0]);
    velocity = system.velocity;
  }
};

class BallOnSoil : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Steps, BallOnSoil, testing::Values(5e-3, 2.5e-3, 1.25e-3));

Ball rolling_ball(double h, double dip_deg, double resistance, double speed) {
  Ball ball{h};
  ball.dip = dip_deg * std::numbers::pi / 180;
  ball.rolling = ball.spinning = resistance;
  ball.velocity = rolling(speed);
  return ball;
}

TEST_P(BallOnSoil, StopsOnTheFlat) {
  const double resistances[] = {0.05, 0.1, 0.17, 0.3};
  const double ways[] = {142.760, 71.380, 41.988, 23.793};
  for (int i = 0; i < 4; ++i) {
    Ball ball = rolling_ball(GetParam(), 0, resistances[i], 10);
    double time = 0;
    for (; ball.velocity[0] > 1e-3 && time < 60; time += GetParam()) ball.advance();
    EXPECT_NEAR(ball.path, ways[i], 1e-3 * ways[i]);
    if (resistances[i] == 0.17) {
      EXPECT_NEAR(time, 8.398, 1e-3 * 8.398);
    }
  }
}

TEST_P(BallOnSoil, AcceleratesDownASlope) {
  const double resistances[] = {0.05, 0.1, 0.17, 0.3};
  const double accelerations[] = {2.06665, 1.73753, 1.27677, 0.42107};
  for (int i = 0; i < 4; ++i) {
    Ball ball = rolling_ball(GetParam(), 20, resistances[i], 0);
    for (int k = 0; k < 200; ++k) ball.advance();
    EXPECT_NEAR(ball.velocity[0] / (200 * GetParam()), accelerations[i], 1e-4);
  }
  Ball held = rolling_ball(GetParam(), 20, 0.36397 * 1.001, 0);
  for (int k = 0; k < 200; ++k) held.advance();
  EXPECT_LT(held.velocity.norm(), 1e-6);
}

TEST_P(BallOnSoil, StopsDownAGentleSlope) {
  Ball ball = rolling_ball(GetParam(), 8, 0.17, 10);
  for (int k = 0; ball.velocity[0] > 1e-3 && k < 100000; ++k) ball.advance();
  EXPECT_NEAR(ball.path, 244.683, 1e-3 * 244.683);
}

TEST_P(BallOnSoil, PivotsToItsStop) {
  Ball ball{GetParam()};
  ball.spinning = 0.1;
  ball.friction = 0;
  ball.velocity[5] = 10;
  double time = 0;
  for (; ball.velocity[5] > 1e-3 && time < 60; time += GetParam()) ball.advance();
  const double expected = 0.4 * radius * 10 / (0.1 * earth);
  EXPECT_NEAR(time, expected, GetParam());
}

// --- a pendulum --------------------------------------------------------------------------------

// A cube of 1 m that hangs on two points 0.3 m above its centre, let go at 10 degrees.
struct Pendulum {
  double h, resistance, angle = 10 * std::numbers::pi / 180, rate = 0;
  static constexpr double m = 1000, lever = 0.3;

  void advance() {
    const double middle = angle + h / 2 * rate;
    const Vec3 up(std::sin(middle), 0, std::cos(middle));  // to the points
    const Vec3 axis = Vec3::UnitY();
    std::array<ContactRow, 2> rows;
    for (int i = 0; i < 2; ++i) {
      rows[i].normal = Vec3::UnitZ();
      rows[i].arm = lever * up + (i == 0 ? 0.2 : -0.2) * axis;
      rows[i].normal_damping = rows[i].shear_damping = 1e11;
      rows[i].friction = 100;
    }
    BlockSystem<6> system;
    system.mass.setZero();
    system.mass.diagonal() << Vec3::Constant(m), Vec3::Constant(m / 6);
    const Vec3 v = -(rate * axis).cross(lever * up);
    system.free_velocity << v - h * earth * Vec3::UnitZ(), rate * axis;
    system.velocity = system.free_velocity;
    system.tolerance = 1e-11;
    AngularRow turn;
    turn.row_end = 2;
    turn.damping = 1e9;
    turn.inertia = m / 6;
    std::array<AngularRow, 1> turns = {turn};
    const double lever_arm = resistance * std::cbrt(3 / (4 * std::numbers::pi));
    const std::array<RowArm, 2> arms = {RowArm{lever_arm, lever_arm}, RowArm{lever_arm, lever_arm}};
    system.angular = turns;
    system.arms = arms;
    EXPECT_TRUE(solve_contacts(system, std::span(rows), 60).converged);
    const double next = system.velocity[4];
    angle += h / 2 * (rate + next);
    rate = next;
  }
};

// The pivoting of such a block changes sign with the mean normal, which follows the impulses: a
// rock at 13 m/s on meadow, which no other method of solving gets through.
TEST(CouplesOfALoneBlock, AreFoundWhereItSlidesAndSpinsAcrossItsMeanNormal) {
  BlockSystem<6> system;
  system.mass.setZero();
  system.mass.diagonal() << Vec3::Constant(815.8), Vec3(73.035, 65.304, 48.846);
  system.free_velocity << 1.794775, 14.1603, -1.3546176, 1.992653, 1.336305, 1.70297;
  system.velocity = system.free_velocity;
  system.tolerance = 2e-8;
  std::array<ContactRow, 2> rows;
  rows[0].normal = Vec3(0.797001, -0.193332, -0.572199).normalized();
  rows[0].arm = Vec3(-0.412776, -0.150606, 0.226805);
  rows[0].drift = Vec3(0.00228985, 0.00044574, -0.00303367);
  rows[0].slip_start = Vec3(0.178072, 0.980489, -0.0832504).normalized();
  rows[0].normal_damping = 204465, rows[0].shear_damping = 48843;
  rows[0].bias = -3.096e-5;
  rows[1].normal = Vec3(0.667943, -0.1906, -0.719391).normalized();
  rows[1].arm = Vec3(-0.0103292, 0.0824979, 0.57896);
  rows[1].drift = Vec3(0.002216994, 0.000720308, -0.003164177);
  rows[1].slip_start = Vec3(0.183666, 0.978966, -0.0888428).normalized();
  rows[1].normal_damping = 134791, rows[1].shear_damping = 46939;
  rows[1].bias = -3.553e-5;
  for (ContactRow& row : rows) {
    row.friction = 0.598753;
    row.slip_speed = 13.25;
  }
  AngularRow turn;
  turn.row_end = 2;
  turn.damping = 34672.8;
  turn.inertia = 48.846;
  std::array<AngularRow, 1> turns = {turn};
  const std::array<RowArm, 2> arms = {RowArm{0.105385, 0.105385}, RowArm{0.105385, 0.105385}};
  system.angular = turns;
  system.arms = arms;
  EXPECT_TRUE(solve_contacts(system, std::span(rows), 200).converged);
  EXPECT_GT(turns[0].couple.norm(), 0);
  EXPECT_TRUE(turns[0].held_normal.isZero(0));
}

TEST_P(BallOnSoil, APendulumOnTwoPointsComesToRest) {
  const double resistances[] = {0.01, 0.02}, times[] = {3.712, 1.856};
  const double rest = 0.522 * std::numbers::pi / 180;
  for (int i = 0; i < 2; ++i) {
    Pendulum swing{GetParam(), resistances[i]};
    double time = 0, rested = 0;
    for (; time < 8; time += GetParam()) {
      swing.advance();
      if (std::abs(swing.rate) > 1e-4) rested = time + GetParam();
    }
    EXPECT_NEAR(rested, times[i], 0.02 * times[i]);
    EXPECT_NEAR(swing.angle, rest, 0.02 * 10 * std::numbers::pi / 180) << resistances[i];
  }
}

}  // namespace
