// Block LU against dense elimination.
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "base/random.hpp"
#include "solver/block_lu.hpp"
#include "solver/packed_matrix.hpp"

namespace {

template <int N>
Eigen::Matrix<double, N, N> random_block(talus::Random& random) {
  Eigen::Matrix<double, N, N> A;
  for (int k = 0; k < N * N; ++k) A(k) = random.uniform(-1, 1);
  return A;
}

template <int Dof>
void expect_dense_solution(std::uint64_t seed) {
  using Lu = talus::BlockLu<Dof>;
  talus::Random random(seed, "lu");
  Lu lu;
  for (int round = 0; round < 30; ++round) {
    const int n = 1 + static_cast<int>(random.below(20));
    std::vector<std::pair<int, int>> edges;
    for (int a = 1; a < n; ++a)
      for (int b = 0; b < a; ++b)
        if (random.uniform() < 0.2) edges.emplace_back(a, b);
    talus::analyse_pattern(n, edges, lu.pattern);
    clear_matrix(lu);
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n * Dof, n * Dof);
    for (int i = 0; i < n; ++i) {
      auto& block =
          lu.diagonal[static_cast<std::size_t>(lu.pattern.place[static_cast<std::size_t>(i)])];
      block = random_block<Dof>(random) + 5.0 * Dof * Lu::Mat::Identity();
      A.block<Dof, Dof>(i * Dof, i * Dof) = block;
    }
    for (const auto& [a, b] : edges) {
      const auto ab = random_block<Dof>(random), ba = random_block<Dof>(random);
      talus::add_blocks<Dof>(lu, a, b, ab, ba);
      A.block<Dof, Dof>(a * Dof, b * Dof) += ab;
      A.block<Dof, Dof>(b * Dof, a * Dof) += ba;
    }
    std::vector<typename Lu::Vec> b(static_cast<std::size_t>(n)), x(b.size());
    Eigen::VectorXd dense(n * Dof);
    for (int i = 0; i < n; ++i) {
      for (int k = 0; k < Dof; ++k) b[static_cast<std::size_t>(i)][k] = random.uniform(-1, 1);
      dense.segment<Dof>(i * Dof) = b[static_cast<std::size_t>(i)];
    }
    factor(lu);
    talus::solve<Dof>(lu, b, x);
    const Eigen::VectorXd expected = A.partialPivLu().solve(dense);
    for (int i = 0; i < n; ++i)
      EXPECT_LT((x[static_cast<std::size_t>(i)] - expected.segment<Dof>(i * Dof)).norm(),
                1e-13 * expected.norm());
  }
}

TEST(BlockLu, SolvesUnsymmetricSystemsAsDenseEliminationDoes) {
  expect_dense_solution<6>(1);
  expect_dense_solution<12>(2);
}

// Rows of random matrices in another order, one of them scaled far down: no pivot on the diagonal
// is any good.
TEST(BlockLu, InvertsWhereTheDiagonalIsZero) {
  talus::Random random(3, "invert");
  for (int round = 0; round < 50; ++round) {
    Eigen::Matrix<double, 6, 6> A = random_block<6>(random), B;
    A.diagonal().setZero();
    A.row(2) *= 1e-8;
    B = A;
    talus::invert<6>(B);
    const Eigen::Matrix<double, 6, 6> expected = A.fullPivLu().inverse();
    EXPECT_LT((B - expected).norm(), 1e-10 * expected.norm());
  }
  Eigen::Matrix<double, 6, 6> singular = Eigen::Matrix<double, 6, 6>::Zero();
  talus::invert<6>(singular);
  EXPECT_FALSE(singular.allFinite());
}

// A chain has no fill whatever the numbering of its links.
TEST(BlockLu, OrdersAChainWithoutFill) {
  talus::BlockPattern pattern;
  std::vector<std::pair<int, int>> edges;
  for (int i = 1; i < 50; ++i) edges.emplace_back(i * 7 % 50, (i - 1) * 7 % 50);
  talus::analyse_pattern(50, edges, pattern);
  EXPECT_EQ(pattern.row.size(), edges.size());
}

TEST(Packed, InverseIsThatOfTheFullMatrix) {
  talus::Random random(5, "packed");
  for (int round = 0; round < 50; ++round) {
    const auto A = random_block<6>(random);
    const Eigen::Matrix<double, 6, 6> S =
        A * A.transpose() + Eigen::Matrix<double, 6, 6>::Identity();
    const talus::Packed<6> P = talus::packed<6>(S);
    EXPECT_LT(
        (talus::unpacked(talus::inverse(P)) * S - Eigen::Matrix<double, 6, 6>::Identity()).norm(),
        1e-13);
  }
}

}  // namespace
