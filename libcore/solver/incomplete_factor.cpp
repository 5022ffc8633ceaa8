#include "solver/incomplete_factor.hpp"

#include <algorithm>

namespace talus {
namespace {

using std::size_t;

// L_ij of the pair `p`, the row being that of its body `row`.
Mat6 coupling_of(const Island& island, const IslandMatrix& matrix, size_t p, int row) {
  const Mat3 T = displacement_matrix(matrix.shift[p]).middleCols<3>(3);  // X = [I, T; 0, I]
  Mat6 block = -unpacked(matrix.pair[p]);
  if (island.pairs[p].a == row)  // -W X
    block.rightCols<3>() += block.leftCols<3>().lazyProduct(T);
  else  // -X^T W
    block.bottomRows<3>() += T.transpose().lazyProduct(block.topRows<3>());
  return block;
}

void set_order(const IslandMatrix& matrix, IncompleteFactor& factor) {
  factor.order = matrix.active.bodies.items;
  std::sort(factor.order.begin(), factor.order.end(), [&](int i, int j) {
    const double a = factor.height[static_cast<size_t>(i)];
    const double b = factor.height[static_cast<size_t>(j)];
    return a < b || (a == b && i < j);
  });
  factor.place.assign(factor.height.size(), -1);
  for (size_t k = 0; k < factor.order.size(); ++k)
    factor.place[static_cast<size_t>(factor.order[k])] = static_cast<int>(k);
}

// The row at the last place of `lower_begin`.
void add_row_of(const Island& island, const IslandMatrix& matrix, int body,
                IncompleteFactor& factor) {
  const int own = factor.place[static_cast<size_t>(body)];
  for (const int p : pairs_of(matrix, static_cast<size_t>(body))) {
    const auto k = static_cast<size_t>(p);
    const BodyPair& pair = island.pairs[k];
    const int other = pair.a == body ? pair.b : pair.a;
    if (other < 0 || !matrix.pair_closed[k]) continue;
    const int before = factor.place[static_cast<size_t>(other)];
    if (before < 0 || before > own) continue;
    factor.lower.push_back({before, coupling_of(island, matrix, k, body)});
  }
}

[[nodiscard]] std::span<const LowerBlock> row_at(const IncompleteFactor& factor, size_t k) {
  return std::span(factor.lower)
      .subspan(static_cast<size_t>(factor.lower_begin[k]),
               static_cast<size_t>(factor.lower_begin[k + 1] - factor.lower_begin[k]));
}

// A pivot that rounding made negative, where contacts are 1e12 times as stiff as a body is heavy,
// is taken as that of the body alone.
void set_pivot(const Packed<6>& diagonal, size_t k, IncompleteFactor& factor) {
  const Mat6 A = unpacked(diagonal);
  Mat6 D = A;
  for (const LowerBlock& lower : row_at(factor, k)) {
    const auto j = static_cast<size_t>(lower.before);
    const Mat6 carried = lower.block.lazyProduct(factor.per_pivot[j]);
    D.noalias() -= carried.lazyProduct(lower.block.transpose());
  }
  Mat6 per_pivot = unpacked(inverse(packed<6>(D)));
  if (!(per_pivot.diagonal().minCoeff() > 0)) {
    D = A;
    per_pivot = unpacked(inverse(diagonal));
  }
  factor.pivot.push_back(D);
  factor.per_pivot.push_back(per_pivot);
  factor.rest.push_back(A - 2 * D);
}

// (D + L) y = b.
void solve_lower(const IncompleteFactor& factor, std::span<const Vec6> b, std::span<Vec6> y) {
  for (size_t k = 0; k < y.size(); ++k) {
    Vec6 sum = b[k];
    for (const LowerBlock& lower : row_at(factor, k))
      sum.noalias() -= lower.block.lazyProduct(y[static_cast<size_t>(lower.before)]);
    y[k].noalias() = factor.per_pivot[k].lazyProduct(sum);
  }
}

// (D + L)^T y = b; `scratch` has their size.
void solve_upper(const IncompleteFactor& factor, std::span<const Vec6> b, std::span<Vec6> scratch,
                 std::span<Vec6> y) {
  std::copy(b.begin(), b.end(), scratch.begin());
  for (size_t k = y.size(); k-- > 0;) {
    y[k].noalias() = factor.per_pivot[k].lazyProduct(scratch[k]);
    for (const LowerBlock& lower : row_at(factor, k))
      scratch[static_cast<size_t>(lower.before)].noalias() -=
          lower.block.transpose().lazyProduct(y[k]);
  }
}

double dot(std::span<const Vec6> a, std::span<const Vec6> b) {
  double sum = 0;
  for (size_t k = 0; k < a.size(); ++k) sum += a[k].dot(b[k]);
  return sum;
}

}  // namespace

void set_heights(const Island& island, const Vec3& down, IncompleteFactor& factor) {
  factor.height.clear();
  for (const Vec3& x : island.position) factor.height.push_back(-x.dot(down));
}

void eliminate(const Island& island, const IslandMatrix& matrix, IncompleteFactor& factor) {
  set_order(matrix, factor);
  factor.lower.clear();
  factor.lower_begin.assign(1, 0);
  for (auto* blocks : {&factor.pivot, &factor.per_pivot, &factor.rest}) blocks->clear();
  for (size_t k = 0; k < factor.order.size(); ++k) {
    const int body = factor.order[k];
    add_row_of(island, matrix, body, factor);
    factor.lower_begin.push_back(static_cast<int>(factor.lower.size()));
    set_pivot(matrix.diagonal[static_cast<size_t>(body)], k, factor);
  }
}

// In the variables (D + L)^T x, for which K is (D + L)^-1 K (D + L)^-T: with L its own part of K,
// that costs one solution with each triangle and no product (Eisenstat 1981).
LinearResult solve_conjugate_gradients(IncompleteFactor& factor, std::span<const Vec6> b,
                                       double tolerance, int max_iterations, std::span<Vec6> x) {
  const size_t n = factor.order.size();
  auto &r = factor.residual, &p = factor.direction, &q = factor.product, &t = factor.by_upper;
  auto &sum = factor.sum, &scratch = factor.scratch;
  for (auto* vectors : {&r, &p, &q, &t, &scratch}) vectors->resize(n);
  sum.assign(n, Vec6::Zero());
  for (size_t k = 0; k < n; ++k) scratch[k] = -b[static_cast<size_t>(factor.order[k])];
  solve_lower(factor, scratch, r);
  const auto precondition = [&](size_t k) -> Vec6 { return factor.pivot[k].lazyProduct(r[k]); };
  double rz = 0;
  for (size_t k = 0; k < n; ++k) {
    p[k] = precondition(k);
    rz += r[k].dot(p[k]);
  }
  const double goal = tolerance * tolerance * rz;
  LinearResult result;
  while (rz > goal && result.iterations < max_iterations) {
    ++result.iterations;
    solve_upper(factor, p, scratch, t);
    for (size_t k = 0; k < n; ++k) scratch[k] = p[k] + factor.rest[k].lazyProduct(t[k]);
    solve_lower(factor, scratch, q);
    for (size_t k = 0; k < n; ++k) q[k] += t[k];
    const double curvature = dot(p, q);
    if (!(curvature > 0)) break;
    const double step = rz / curvature;
    double rz_next = 0;
    for (size_t k = 0; k < n; ++k) {
      sum[k] += step * t[k];
      r[k] -= step * q[k];
      scratch[k] = precondition(k);
      rz_next += r[k].dot(scratch[k]);
    }
    const double ratio = rz_next / rz;
    rz = rz_next;
    for (size_t k = 0; k < n; ++k) p[k] = scratch[k] + ratio * p[k];
  }
  for (size_t k = 0; k < n; ++k) x[static_cast<size_t>(factor.order[k])] = sum[k];
  result.converged = rz <= goal;
  return result;
}

}  // namespace talus
