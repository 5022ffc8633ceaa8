// The contact law: damping, tension, friction, tangents.
#include <gtest/gtest.h>

#include <algorithm>

#include "base/random.hpp"
#include "solver/one_contact.hpp"

namespace {

using talus::ContactRow;
using talus::ContactState;
using talus::Mat3;
using talus::Vec3;

// On level ground: D_n = 2 kg, D_t = 3 kg, tan(phi) = 0.5.
ContactRow on_the_level() {
  ContactRow row;
  row.normal = Vec3::UnitZ();
  row.normal_damping = 2;
  row.shear_damping = 3;
  row.friction = 0.5;
  return row;
}

ContactRow at(const Vec3& velocity, ContactRow row) {
  talus::evaluate(velocity, row);
  return row;
}

TEST(ContactLaw, PressesByDampingTimesWhatClosesItAndNeverPulls) {
  ContactRow row = on_the_level();
  row.bias = -0.25;
  EXPECT_EQ(at(Vec3(0, 0, -1), row).impulse, Vec3(0, 0, 2.5));
  EXPECT_EQ(at(Vec3(0, 0, 0.25), row).state, ContactState::open);
  EXPECT_EQ(at(Vec3(0, 0, 1), row).impulse, Vec3(Vec3::Zero()));
}

TEST(ContactLaw, TensionHoldsUpToItsLimit) {
  ContactRow row = on_the_level();
  row.tension = 1;
  EXPECT_EQ(at(Vec3(0, 0, 0.49), row).impulse.z(), -0.98);
  EXPECT_EQ(at(Vec3(0, 0, 0.51), row).state, ContactState::open);
}

TEST(ContactLaw, GivesWayAtTheLimitOfItsOtherSide) {
  ContactRow row = on_the_level();
  row.normal_limit = 1.5;
  EXPECT_EQ(at(Vec3(0, 0, -10), row).impulse.z(), 1.5);
  EXPECT_TRUE(talus::tangent(at(Vec3(0, 0, -10), row)).row(2).isZero(0));
}

TEST(ContactLaw, SticksUpToFrictionAndCohesion) {
  ContactRow row = on_the_level();  // presses with 2 N s: friction holds 1 N s
  const Vec3 slow(0.33, 0, -1), fast(0.34, 0, -1);
  EXPECT_EQ(at(slow, row).state, ContactState::stick);
  EXPECT_EQ(at(slow, row).impulse.x(), -3 * 0.33);
  EXPECT_EQ(at(fast, row).state, ContactState::slip);
  row.cohesion = 0.1;
  EXPECT_EQ(at(fast, row).state, ContactState::stick);
  row.shear_velocity = Vec3(0.1, 0, 0);  // the spring of the step before
  EXPECT_EQ(at(fast, row).state, ContactState::slip);
}

// Friction acts along the mean of the directions at both ends, the start's weighted by how far the
// contact is beyond sticking: e = t + share (start . t) start.
TEST(ContactLaw, SlipsWithItsBoundAlongTheMeanDirection) {
  ContactRow row = on_the_level();
  row.slip_start = Vec3(1, 0, 0);
  const Vec3 end = Vec3(1, 1, 0).normalized();
  const double speed = 4, share = 1 - 1 / (3 * speed);
  const Vec3 mean = (end + share * end.x() * row.slip_start).normalized();
  const Vec3 impulse = at(speed * end - Vec3::UnitZ(), row).impulse;
  EXPECT_LT((impulse - Vec3(-mean.x(), -mean.y(), 2)).norm(), 1e-15);
}

TEST(ContactLaw, SlipsAgainstTheEndWhereItHasTurnedBack) {
  ContactRow row = on_the_level();
  row.slip_start = Vec3(-1, 0, 0);
  EXPECT_LT((at(Vec3(4, 0, -1), row).impulse - Vec3(-1, 0, 2)).norm(), 1e-15);
}

TEST(ContactLaw, IsContinuousWhereSlipBegins) {
  ContactRow row = on_the_level();
  row.slip_start = Vec3(0, 1, 0);
  const Vec3 along = Vec3(1, 1, 0).normalized() / 3;
  const Vec3 before = at((1 - 1e-9) * along - Vec3::UnitZ(), row).impulse,
             after = at((1 + 1e-9) * along - Vec3::UnitZ(), row).impulse;
  EXPECT_LT((before - after).norm(), 1e-8);
}

// Of kinds whose direction of slip does not turn with the bound: either the bound is constant, or
// no direction is known from the start.
ContactRow random_row(bool has_start, talus::Random& random) {
  const auto vector = [&] {
    return Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
  };
  ContactRow row;
  row.normal = vector().normalized();
  const Vec3 start = vector();
  if (has_start) row.slip_start = (start - row.normal.dot(start) * row.normal).normalized();
  row.bias = random.uniform(-1, 0);
  row.normal_damping = random.uniform(0.5, 2);
  row.shear_damping = random.uniform(0.5, 2);
  row.friction = has_start ? 0 : random.uniform(0.1, 1);
  row.cohesion = random.uniform(0, 0.2);
  return row;
}

// Against central differences, where both ends are in the state of the middle. (That the mean
// direction turns with the bound is left out: Newton takes a step more, the solution is the same.)
TEST(ContactLaw, TheTangentIsItsDerivative) {
  talus::Random random(5, "tangent");
  constexpr double h = 1e-6;
  int n_stick = 0, n_slip = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    const ContactRow row = random_row(trial % 2 == 0, random);
    const Vec3 w(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    const ContactRow here = at(w, row);
    if (here.state == ContactState::open) continue;
    Mat3 differences;
    bool same = true;
    for (int k = 0; k < 3; ++k) {
      const ContactRow low = at(w - h * Vec3::Unit(k), row), high = at(w + h * Vec3::Unit(k), row);
      same &= low.state == here.state && high.state == here.state;
      differences.col(k) = -(high.impulse - low.impulse) / (2 * h);
    }
    if (!same) continue;
    EXPECT_LT((talus::tangent(here) - differences).norm(), 1e-6) << trial;
    n_stick += here.state == ContactState::stick;
    n_slip += here.state == ContactState::slip;
  }
  EXPECT_GT(std::min(n_stick, n_slip), 300);
}

}  // namespace
