// Contacts two and four at a time: impulses, tangents, equal bits.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <functional>

#include "base/random.hpp"
#include "solver/newton.hpp"
#include "solver/one_contact.hpp"
#include "solver/row_groups.hpp"
#include "unit/step/rows_of_island.hpp"

namespace {

using talus::ContactRow;
using talus::ContactState;
using talus::Evaluation;
using talus::Mat6;
using talus::Vec3;
using talus::Vec6;
using talus::test::row_at;
using talus::test::row_numbers;

Vec3 random_vector(talus::Random& random) {
  Vec3 v;
  for (int k = 0; k < 3; ++k) v[k] = random.uniform(-1, 1);
  return v;
}

Vec3 random_tangent(const Vec3& normal, talus::Random& random) {
  const Vec3 v = random_vector(random);
  return v - normal.dot(v) * normal;
}

// Rows of all kinds: springs, bonds, no friction, no start direction.
ContactRow random_row(talus::Random& random) {
  ContactRow row;
  row.normal = random_vector(random).normalized();
  row.arm = random_vector(random);
  if (random.uniform() < 0.5) row.shear_velocity = random_tangent(row.normal, random);
  if (random.uniform() < 0.5) row.slip_start = random_tangent(row.normal, random).normalized();
  row.bias = random.uniform(-1, 0.5);
  row.normal_damping = random.uniform(0.1, 2);
  row.shear_damping = random.uniform(0.1, 2);
  row.friction = random.uniform() < 0.2 ? 0 : random.uniform(0.05, 1);
  if (random.uniform() < 0.3) row.cohesion = random.uniform();
  if (random.uniform() < 0.3) row.tension = random.uniform();
  if (random.uniform() < 0.3) row.normal_limit = random.uniform();
  return row;
}

talus::Island island_of(const std::vector<ContactRow>& rows) {
  talus::Island island;
  open_pair(0, -1, island);
  for (const ContactRow& row : rows) add_row(row, island);
  return island;
}

// Of the only pair of the island.
Vec6 impulse_at(const Vec6& u, Evaluation evaluation, talus::Island& island) {
  talus::PairEvaluation pair;
  pair.groups = island.rows;
  pair.motion = u;
  talus::evaluate_pairs({&pair, 1}, evaluation, 0);
  return pair.impulse();
}

struct Evaluated {
  std::vector<ContactRow> rows;
  talus::Island island;
  Vec6 f;
};

Evaluated evaluate(const std::vector<ContactRow>& rows, const Vec6& u) {
  Evaluated e;
  e.island = island_of(rows);
  e.f = impulse_at(u, Evaluation::coupled, e.island);
  for (const int r : row_numbers(e.island)) e.rows.push_back(row_at(e.island, r));
  return e;
}

Vec6 random_velocity(talus::Random& random) {
  Vec6 u;
  for (int k = 0; k < 6; ++k) u[k] = random.uniform(-1, 1);
  return u;
}

// One contact and lanes of them, at 5,000 contacts of all kinds: one template, but for how the slip
// direction is rounded.
TEST(EvaluatePairs, GivesTheImpulsesOfOneContactAfterTheOther) {
  talus::Random random(11, "law");
  int n_slip = 0, n_stick = 0, n_open = 0;
  for (int round = 0; round < 1000; ++round) {
    std::vector<ContactRow> rows(1 + random.below(9));
    for (ContactRow& row : rows) row = random_row(random);
    const Vec6 u = random_velocity(random);
    const Evaluated e = evaluate(rows, u);
    Vec6 f = Vec6::Zero();
    for (std::size_t r = 0; r < rows.size(); ++r) {
      ContactRow expected = rows[r];
      talus::evaluate(talus::point_velocity<6>(u, rows[r].arm), expected);
      EXPECT_LT((e.rows[r].impulse - expected.impulse).norm(), 1e-14);
      EXPECT_EQ(e.rows[r].state, expected.state);
      f += talus::generalised<6>(rows[r].arm, expected.impulse);
      n_open += expected.state == ContactState::open;
      n_slip += expected.state == ContactState::slip;
      n_stick += expected.state == ContactState::stick;
    }
    EXPECT_LT((e.f - f).norm(), 1e-13);
  }
  EXPECT_GT(std::min({n_open, n_slip, n_stick}), 500);
}

// Groups of other pairs share a register there.
TEST(EvaluatePairs, HaveTheSameBitsFourRowsAtATime) {
  if (!talus::has_four_lanes()) GTEST_SKIP() << "no AVX2";
  talus::Random random(13, "width");
  for (int round = 0; round < 500; ++round) {
    std::vector<talus::Island> by_two(1 + random.below(5));
    for (talus::Island& island : by_two) {
      std::vector<ContactRow> rows(1 + random.below(7));
      for (ContactRow& row : rows) row = random_row(random);
      island = island_of(rows);
    }
    std::vector<talus::Island> by_four = by_two;
    std::vector<talus::PairEvaluation> two(by_two.size()), four(by_two.size());
    for (const Evaluation evaluation : {Evaluation::coupled, Evaluation::inherited}) {
      for (std::size_t p = 0; p < two.size(); ++p) {
        two[p].motion = four[p].motion = random_velocity(random);
        two[p].groups = by_two[p].rows;
        four[p].groups = by_four[p].rows;
      }
      talus::evaluate_pairs(two, evaluation, 0.5, talus::RowWidth::two);
      talus::evaluate_pairs(four, evaluation, 0.5, talus::RowWidth::four);
      for (std::size_t p = 0; p < two.size(); ++p) {
        EXPECT_EQ(two[p].impulse(), four[p].impulse());
        EXPECT_EQ(two[p].changed, four[p].changed);
        for (const int r : row_numbers(by_two[p])) {
          const auto a = row_of(by_two[p], r), b = row_of(by_four[p], r);
          EXPECT_EQ(a.impulse(), b.impulse());
          EXPECT_EQ(a.state(), b.state());
          EXPECT_EQ(a.value(&talus::RowGroup::slip_tangent),
                    b.value(&talus::RowGroup::slip_tangent));
          EXPECT_EQ(a.value(&talus::RowGroup::normal_tangent),
                    b.value(&talus::RowGroup::normal_tangent));
        }
      }
    }
  }
}

// The exact tangent is minus the derivative of the summed impulse (central differences); the
// symmetric one is positive semidefinite and equals it as far as nothing slips.
TEST(SumTangents, IsTheDerivativeOfTheImpulse) {
  talus::Random random(12, "tangent");
  for (int round = 0; round < 300; ++round) {
    std::vector<ContactRow> rows(1 + random.below(6));
    for (ContactRow& row : rows) row = random_row(random);
    const Vec6 u = random_velocity(random);
    Evaluated e = evaluate(rows, u);
    talus::Packed<6> W;
    Mat6 rest = Mat6::Zero();
    talus::sum_tangents(e.island.rows, W, &rest);
    const Mat6 exact = talus::unpacked(W) + rest;
    const double h = 1e-6;
    bool smooth = true;
    for (int k = 0; k < 6; ++k) {
      const Evaluated up = evaluate(rows, u + h * Vec6::Unit(k));
      const Evaluated down = evaluate(rows, u - h * Vec6::Unit(k));
      for (std::size_t r = 0; r < rows.size(); ++r)
        smooth &= up.rows[r].state == down.rows[r].state;
      if (smooth) {
        EXPECT_LT((exact.col(k) + (up.f - down.f) / (2 * h)).norm(), 1e-6 * (1 + exact.norm()));
      }
    }
    talus::Packed<6> symmetric;
    talus::sum_tangents(e.island.rows, symmetric, nullptr);
    const Mat6 S = talus::unpacked(symmetric);
    EXPECT_GE(Eigen::SelfAdjointEigenSolver<Mat6>(S).eigenvalues().minCoeff(), -1e-13 * S.norm());
    bool slips = false;
    for (const ContactRow& row : e.rows) slips |= row.state == ContactState::slip;
    if (!slips) {
      EXPECT_LT((S - exact).norm(), 1e-14 * (1 + S.norm()));
    }
  }
}

// First iteration: a bound from the predicted overlap would have no limit.
// The row that slips at an impulse of 2 and is pressed with 5 now, or as `change` makes it.
Vec6 inherited_impulse(const std::function<void(ContactRow&)>& change) {
  ContactRow row;
  row.normal = Vec3::UnitZ();
  row.bias = -5;
  row.normal_damping = row.shear_damping = 1;
  row.friction = 0.5;
  row.impulse = Vec3(0, 0, 2);
  row.state = ContactState::slip;
  change(row);
  talus::Island island = island_of({row});
  Vec6 u = Vec6::Zero();
  u[0] = 10;
  return impulse_at(u, Evaluation::inherited, island);
}

TEST(EvaluatePairs, BoundsInheritedFrictionByTheLastImpulse) {
  const Vec6 slips = inherited_impulse([](ContactRow&) {});
  EXPECT_EQ(slips[0], -1);  // 0.5 x 2, not 0.5 x 5
  EXPECT_EQ(slips[2], 5);
  const Vec6 sticks = inherited_impulse([](ContactRow& row) { row.state = ContactState::stick; });
  EXPECT_EQ(sticks[0], -10);
}

TEST(EvaluatePairs, TakesNewContactsByTheLaw) {
  const Vec6 f = inherited_impulse([](ContactRow& row) { row.state = ContactState::open; });
  EXPECT_EQ(f[0], -2.5);
  EXPECT_EQ(f[2], 5);
}

TEST(EvaluatePairs, KeepsAnInheritedContactUntilItWouldPullMoreThanItPressed) {
  EXPECT_EQ(inherited_impulse([](ContactRow& row) { row.bias = 1.5; })[2], -1.5);
  EXPECT_TRUE(inherited_impulse([](ContactRow& row) { row.bias = 2.5; }).isZero(0));
}

}  // namespace
