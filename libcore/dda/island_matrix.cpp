#include "dda/island_matrix.hpp"

namespace talus {
namespace {

using std::size_t;

// D += X^T W X, what the pair adds to the diagonal block of B.
// X = [I, -S; 0, I] with S = [shift]x: W = [K, .; L, C] becomes
// [K, .; L' = L + S K, C' = C - L S + S L'^T].
void add_carried(const Packed<6>& W, const Vec3& shift, Packed<6>& D) {
  const double x = shift.x(), y = shift.y(), z = shift.z();
  const double K[3][3] = {
      {W(0, 0), W(1, 0), W(2, 0)}, {W(1, 0), W(1, 1), W(2, 1)}, {W(2, 0), W(2, 1), W(2, 2)}};
  double L[3][3];
#pragma GCC unroll 3
  for (int j = 0; j < 3; ++j) {
    L[0][j] = W(3, j) + (y * K[2][j] - z * K[1][j]);
    L[1][j] = W(4, j) + (z * K[0][j] - x * K[2][j]);
    L[2][j] = W(5, j) + (x * K[1][j] - y * K[0][j]);
  }
  D(0, 0) += K[0][0], D(1, 0) += K[1][0], D(1, 1) += K[1][1];
  D(2, 0) += K[2][0], D(2, 1) += K[2][1], D(2, 2) += K[2][2];
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i)
#pragma GCC unroll 3
    for (int j = 0; j < 3; ++j) D(3 + i, j) += L[i][j];
  // S L'^T, entry (i, j), less (L S), entry (i, j)
  D(3, 3) += W(3, 3) + (y * L[0][2] - z * L[0][1]) - (W(3, 1) * z - W(3, 2) * y);
  D(4, 3) += W(4, 3) + (z * L[0][0] - x * L[0][2]) - (W(4, 1) * z - W(4, 2) * y);
  D(4, 4) += W(4, 4) + (z * L[1][0] - x * L[1][2]) - (W(4, 2) * x - W(4, 0) * z);
  D(5, 3) += W(5, 3) + (x * L[0][1] - y * L[0][0]) - (W(5, 1) * z - W(5, 2) * y);
  D(5, 4) += W(5, 4) + (x * L[1][1] - y * L[1][0]) - (W(5, 2) * x - W(5, 0) * z);
  D(5, 5) += W(5, 5) + (x * L[2][1] - y * L[2][0]) - (W(5, 0) * y - W(5, 1) * x);
}

}  // namespace

void prepare_matrix(const Island& island, bool only_changed, IslandMatrix& matrix) {
  const size_t n = island.mass.size(), n_pairs = island.pairs.size();
  matrix.shift.resize(n_pairs);
  matrix.pair_changed.resize(n_pairs);
  for (size_t p = 0; p < n_pairs; ++p) {
    const BodyPair& pair = island.pairs[p];
    if (only_changed && !pair.changed) continue;
    matrix.pair_changed[p] = 1;
    matrix.shift[p] = pair.b < 0 ? Vec3(Vec3::Zero())
                                 : Vec3(island.position[static_cast<size_t>(pair.a)] -
                                        island.position[static_cast<size_t>(pair.b)]);
  }
  if (!only_changed) matrix.body_changed.assign(n, 1);
  matrix.pair.resize(n_pairs);
  matrix.pair_closed.resize(n_pairs);
  for (auto* blocks : {&matrix.own, &matrix.diagonal}) blocks->resize(n);
  for (auto* blocks : {&matrix.single_own, &matrix.inverse}) blocks->resize(n);
  for (auto* vectors :
       {&matrix.residual, &matrix.preconditioned, &matrix.direction, &matrix.product, &matrix.sum})
    vectors->resize(n);
}

void update_tangents(const Island& island, Tangent tangent, RowGroups& rows, IslandMatrix& matrix) {
  const size_t n_pairs = island.pairs.size();
  if (tangent != matrix.tangent) matrix.pair_changed.assign(n_pairs, 1);
  matrix.tangent = tangent;
  const bool exact = tangent == Tangent::exact;
  if (exact)
    matrix.rest.resize(n_pairs);
  else
    matrix.coupling.resize(n_pairs);
  matrix.coupled.clear();
  for (size_t p = 0; p < n_pairs; ++p) {
    const BodyPair& pair = island.pairs[p];
    if (matrix.pair_changed[p]) {
      if (exact) matrix.rest[p].setZero();
      matrix.pair_closed[p] =
          sum_tangents(groups_of(rows, p), matrix.pair[p], exact ? &matrix.rest[p] : nullptr);
      if (!exact && pair.b >= 0)
        matrix.coupling[p] = {single(matrix.pair[p]), single(matrix.shift[p])};
      matrix.pair_changed[p] = 0;
      matrix.body_changed[static_cast<size_t>(pair.a)] = 1;
      if (pair.b >= 0) matrix.body_changed[static_cast<size_t>(pair.b)] = 1;
    }
    if (pair.b >= 0 && matrix.pair_closed[p]) matrix.coupled.push_back(static_cast<int>(p));
  }
}

[[gnu::flatten]] void update_diagonals(const Island& island, IslandMatrix& matrix) {
  for (size_t i = 0; i < island.mass.size(); ++i)
    if (matrix.body_changed[i]) matrix.own[i] = matrix.diagonal[i] = packed<6>(island.mass[i]);
  for (size_t p = 0; p < island.pairs.size(); ++p) {
    if (!matrix.pair_closed[p]) continue;
    const BodyPair& pair = island.pairs[p];
    const auto a = static_cast<size_t>(pair.a);
    if (matrix.body_changed[a]) {
      add(matrix.pair[p], matrix.diagonal[a]);
      if (pair.b < 0) add(matrix.pair[p], matrix.own[a]);
    }
    if (pair.b >= 0 && matrix.body_changed[static_cast<size_t>(pair.b)])
      add_carried(matrix.pair[p], matrix.shift[p], matrix.diagonal[static_cast<size_t>(pair.b)]);
  }
  for (size_t i = 0; i < island.mass.size(); ++i) {
    if (!matrix.body_changed[i]) continue;
    matrix.single_own[i] = single(matrix.own[i]);
    matrix.inverse[i] = single(inverse(matrix.diagonal[i]));
    matrix.body_changed[i] = 0;
  }
}

void choose_active(const Island& island, std::span<const std::uint8_t> moves,
                   IslandMatrix& matrix) {
  matrix.is_active.assign(moves.begin(), moves.end());
  for (const int p : matrix.coupled) {
    const BodyPair& pair = island.pairs[static_cast<size_t>(p)];
    const auto a = static_cast<size_t>(pair.a), b = static_cast<size_t>(pair.b);
    if (moves[a] || moves[b]) matrix.is_active[a] = matrix.is_active[b] = 1;
  }
  matrix.active.clear();
  for (size_t i = 0; i < moves.size(); ++i)
    if (matrix.is_active[i]) matrix.active.push_back(static_cast<int>(i));
  matrix.active_coupled.clear();
  for (const int p : matrix.coupled) {
    const BodyPair& pair = island.pairs[static_cast<size_t>(p)];
    if (matrix.is_active[static_cast<size_t>(pair.a)] ||
        matrix.is_active[static_cast<size_t>(pair.b)])
      matrix.active_coupled.push_back(p);
  }
}

[[gnu::flatten]] void multiply(const Island& island, const IslandMatrix& matrix,
                               std::span<const SingleVector> x, std::span<SingleVector> y) {
  for (const int body : matrix.active) {
    const auto i = static_cast<size_t>(body);
    y[i] = product(matrix.single_own[i], x[i]);
  }
  for (const int p : matrix.active_coupled) {
    const auto k = static_cast<size_t>(p);
    const auto a = static_cast<size_t>(island.pairs[k].a);
    const auto b = static_cast<size_t>(island.pairs[k].b);
    const SingleCoupling& pair = matrix.coupling[k];
    SingleVector u = x[a] - x[b];  // relative_motion()
    u.linear -= cross(x[b].angular, pair.shift);
    SingleVector f = product(pair.W, u);
    y[a] = y[a] + f;
    f.angular += cross(pair.shift, f.linear);  // carried_to_b()
    y[b] = y[b] - f;
  }
}

[[gnu::flatten]] LinearResult solve_conjugate_gradients(const Island& island, IslandMatrix& matrix,
                                                        std::span<const Vec6> b, double tolerance,
                                                        int max_iterations, std::span<Vec6> x) {
  auto& r = matrix.residual;
  auto& z = matrix.preconditioned;
  auto& p = matrix.direction;
  auto& q = matrix.product;
  auto& sum = matrix.sum;
  for (auto& v : p) v = {};  // bodies that are not active stand
  for (auto& v : sum) v = {};
  double rz = 0;
  for (const int body : matrix.active) {
    const auto i = static_cast<size_t>(body);
    r[i] = single(b[i]);
    p[i] = product(matrix.inverse[i], r[i]);
    rz += dot(r[i], p[i]);
  }
  const double goal = tolerance * tolerance * rz;
  LinearResult result;
  while (rz > goal && result.iterations < max_iterations) {
    ++result.iterations;
    multiply(island, matrix, p, q);
    double curvature = 0;
    for (const int body : matrix.active)
      curvature += dot(p[static_cast<size_t>(body)], q[static_cast<size_t>(body)]);
    if (!(curvature > 0)) break;
    const auto step = static_cast<float>(rz / curvature);
    double rz_next = 0;
    for (const int body : matrix.active) {
      const auto i = static_cast<size_t>(body);
      sum[i] = sum[i] + step * p[i];
      r[i] = r[i] - step * q[i];
      z[i] = product(matrix.inverse[i], r[i]);
      rz_next += dot(r[i], z[i]);
    }
    const auto ratio = static_cast<float>(rz_next / rz);
    rz = rz_next;
    for (const int body : matrix.active) {
      const auto i = static_cast<size_t>(body);
      p[i] = z[i] + ratio * p[i];
    }
  }
  for (size_t i = 0; i < x.size(); ++i) x[i] = in_double(sum[i]);
  result.converged = rz <= goal;
  return result;
}

namespace {

void sum_blocks(const Island& island, IslandMatrix& matrix) {
  BlockLu<6>& lu = matrix.lu;
  const auto diagonal_of = [&](int body) -> Mat6& {
    return lu.diagonal[static_cast<size_t>(lu.pattern.place[static_cast<size_t>(body)])];
  };
  for (int i = 0; i < n_bodies(island); ++i) diagonal_of(i) = island.mass[static_cast<size_t>(i)];
  for (size_t p = 0; p < island.pairs.size(); ++p) {
    if (!matrix.pair_closed[p]) continue;
    const BodyPair& pair = island.pairs[p];
    Mat6 W = unpacked(matrix.pair[p]);
    if (matrix.tangent == Tangent::exact) W += matrix.rest[p];
    diagonal_of(pair.a) += W;
    if (pair.b < 0) continue;
    // X = [I, T; 0, I]
    const Mat3 T = displacement_matrix(matrix.shift[p]).middleCols<3>(3);
    Mat6 XtW = W;
    XtW.bottomRows<3>() += T.transpose().lazyProduct(W.topRows<3>());
    W.rightCols<3>() += W.leftCols<3>().lazyProduct(T);  // W X
    add_blocks<6>(lu, pair.a, pair.b, -W, -XtW);
    W.bottomRows<3>() += T.transpose().lazyProduct(W.topRows<3>());
    diagonal_of(pair.b) += W;
  }
}

}  // namespace

void solve_direct(const Island& island, IslandMatrix& matrix, std::span<const Vec6> b,
                  std::span<Vec6> x) {
  matrix.edges.clear();
  for (const int p : matrix.coupled) {
    const BodyPair& pair = island.pairs[static_cast<size_t>(p)];
    matrix.edges.emplace_back(pair.a, pair.b);
  }
  analyse_pattern(n_bodies(island), matrix.edges, matrix.lu.pattern);
  clear_matrix(matrix.lu);
  sum_blocks(island, matrix);
  factor(matrix.lu);
  solve<6>(matrix.lu, b, x);
}

}  // namespace talus
