// Incomplete elimination of an island's matrix and conjugate gradients with it.
#include "solver/incomplete_factor.hpp"

#include <algorithm>
#include <atomic>

#include "base/make_room.hpp"

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

// Names the blocks of the row at the last place of `lower_begin`.
void list_row_of(const Island& island, const IslandMatrix& matrix, int body,
                 IncompleteFactor& factor) {
  const int own = factor.place[static_cast<size_t>(body)];
  for (const int p : pairs_of(matrix, static_cast<size_t>(body))) {
    const auto k = static_cast<size_t>(p);
    const BodyPair& pair = island.pairs[k];
    const int other = pair.a == body ? pair.b : pair.a;
    if (other < 0 || !matrix.pair_closed[k]) continue;
    const int before = factor.place[static_cast<size_t>(other)];
    if (before < 0 || before > own) continue;
    const size_t at = factor.lower_pair.size();
    if (at == factor.lower.size()) {
      make_room(factor.lower);
      factor.lower.emplace_back();
    }
    factor.lower[at].before = before;
    factor.lower_pair.push_back(p);
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
  factor.pivot[k] = D;
  factor.per_pivot[k] = per_pivot;
  factor.rest[k] = A - 2 * D;
}

// --- rows that depend on earlier rows ----------------------------------------------------------

bool has_workers(const IncompleteFactor& factor) {
  return are_shared(factor.workers, factor.order.size());
}

// Calls row(k) for each place, as if one by one: in several threads each row waits for those that
// it needs, which for_needed(k, use) names. They were begun before it: no row waits in vain.
template <class ForNeeded, class Row>
void sweep(IncompleteFactor& factor, bool upwards, const ForNeeded& for_needed, const Row& row) {
  const size_t n = factor.order.size();
  if (!has_workers(factor)) {
    for (size_t i = 0; i < n; ++i) row(upwards ? i : n - 1 - i);
    return;
  }
  if (factor.done.size() < n) factor.done.resize(n, 0);
  const std::uint64_t number = ++factor.n_sweeps;
  in_chunks(factor.workers, n, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      const size_t k = upwards ? i : n - 1 - i;
      for_needed(k, [&](int needed) {
        const std::atomic_ref done(factor.done[static_cast<size_t>(needed)]);
        for (int w = 0; done.load(std::memory_order_acquire) != number; ++w) wait_a_moment(w);
      });
      row(k);
      std::atomic_ref(factor.done[k]).store(number, std::memory_order_release);
    }
  });
}

// From the lowest row up; each needs those of its blocks.
template <class Row>
void sweep_up(IncompleteFactor& factor, const Row& row) {
  const auto for_needed = [&](size_t k, const auto& use) {
    for (const LowerBlock& lower : row_at(factor, k)) use(lower.before);
  };
  sweep(factor, true, for_needed, row);
}

// Calls work(k) for each place: in any order.
template <class Work>
void for_rows(const IncompleteFactor& factor, const Work& work) {
  in_chunks(factor.workers, factor.order.size(), [&](size_t begin, size_t end) {
    for (size_t k = begin; k < end; ++k) work(k);
  });
}

// The sum of work(k), in the order of places.
template <class Work>
double sum_rows(IncompleteFactor& factor, const Work& work) {
  const size_t n = factor.order.size();
  double sum = 0;
  if (!has_workers(factor)) {
    for (size_t k = 0; k < n; ++k) sum += work(k);
    return sum;
  }
  factor.terms.resize(n);
  for_rows(factor, [&](size_t k) { factor.terms[k] = work(k); });
  for (size_t k = 0; k < n; ++k) sum += factor.terms[k];
  return sum;
}

// (D + L) y = b(k).
template <class RightSide>
void solve_lower(IncompleteFactor& factor, const RightSide& b, std::span<Vec6> y) {
  sweep_up(factor, [&](size_t k) {
    Vec6 sum = b(k);
    for (const LowerBlock& lower : row_at(factor, k))
      sum.noalias() -= lower.block.lazyProduct(y[static_cast<size_t>(lower.before)]);
    y[k].noalias() = factor.per_pivot[k].lazyProduct(sum);
  });
}

// The blocks column by column, each column in the order in which solve_upper() meets its blocks.
void list_columns(IncompleteFactor& factor) {
  const size_t n = factor.order.size(), n_blocks = factor.lower_pair.size();
  std::vector<int>& begin = factor.upper_begin;
  begin.assign(n + 1, 0);
  for (size_t i = 0; i < n_blocks; ++i) ++begin[static_cast<size_t>(factor.lower[i].before)];
  int sum = 0;
  for (int& at : begin) at = sum += at;
  if (factor.upper.size() < n_blocks) factor.upper.resize(n_blocks);
  for (size_t k = 0; k < n; ++k)
    for (int i = factor.lower_begin[k + 1]; i-- > factor.lower_begin[k];) {
      const auto column = static_cast<size_t>(factor.lower[static_cast<size_t>(i)].before);
      factor.upper[static_cast<size_t>(--begin[column])] = {static_cast<int>(k), i};
    }
}

[[nodiscard]] std::span<const UpperBlock> column_at(const IncompleteFactor& factor, size_t k) {
  return std::span(factor.upper)
      .subspan(static_cast<size_t>(factor.upper_begin[k]),
               static_cast<size_t>(factor.upper_begin[k + 1] - factor.upper_begin[k]));
}

// The same as solve_upper(), with its sums in the same order: each row collects the contributions
// of those after it.
void solve_upper_by_columns(IncompleteFactor& factor, std::span<const Vec6> b, std::span<Vec6> y) {
  const auto for_needed = [&](size_t k, const auto& use) {
    for (const UpperBlock& upper : column_at(factor, k)) use(upper.after);
  };
  sweep(factor, false, for_needed, [&](size_t k) {
    Vec6 sum = b[k];
    for (const UpperBlock& upper : column_at(factor, k))
      sum.noalias() -= factor.lower[static_cast<size_t>(upper.block)].block.transpose().lazyProduct(
          y[static_cast<size_t>(upper.after)]);
    y[k].noalias() = factor.per_pivot[k].lazyProduct(sum);
  });
}

// (D + L)^T y = b; `scratch` has their size.
void solve_upper(IncompleteFactor& factor, std::span<const Vec6> b, std::span<Vec6> scratch,
                 std::span<Vec6> y) {
  if (has_workers(factor)) return solve_upper_by_columns(factor, b, y);
  std::copy(b.begin(), b.end(), scratch.begin());
  for (size_t k = y.size(); k-- > 0;) {
    y[k].noalias() = factor.per_pivot[k].lazyProduct(scratch[k]);
    for (const LowerBlock& lower : row_at(factor, k))
      scratch[static_cast<size_t>(lower.before)].noalias() -=
          lower.block.transpose().lazyProduct(y[k]);
  }
}

}  // namespace

void set_heights(const Island& island, const Vec3& down, IncompleteFactor& factor) {
  factor.height.clear();
  for (const Vec3& x : island.position) factor.height.push_back(-x.dot(down));
}

void eliminate(const Island& island, const IslandMatrix& matrix, IncompleteFactor& factor) {
  factor.workers = matrix.workers;
  set_order(matrix, factor);
  factor.lower_pair.clear();
  factor.lower_begin.assign(1, 0);
  for (const int body : factor.order) {
    list_row_of(island, matrix, body, factor);
    factor.lower_begin.push_back(static_cast<int>(factor.lower_pair.size()));
  }
  for (auto* blocks : {&factor.pivot, &factor.per_pivot, &factor.rest})
    if (blocks->size() < factor.order.size()) blocks->resize(factor.order.size());
  sweep_up(factor, [&](size_t k) {
    const int body = factor.order[k];
    for (int i = factor.lower_begin[k]; i < factor.lower_begin[k + 1]; ++i)
      factor.lower[static_cast<size_t>(i)].block =
          coupling_of(island, matrix, static_cast<size_t>(factor.lower_pair[i]), body);
    set_pivot(matrix.diagonal[static_cast<size_t>(body)], k, factor);
  });
  if (has_workers(factor)) list_columns(factor);
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
  solve_lower(
      factor, [&](size_t k) -> Vec6 { return -b[static_cast<size_t>(factor.order[k])]; }, r);
  const auto precondition = [&](size_t k) -> Vec6 { return factor.pivot[k].lazyProduct(r[k]); };
  double rz = sum_rows(factor, [&](size_t k) {
    p[k] = precondition(k);
    return r[k].dot(p[k]);
  });
  const double goal = tolerance * tolerance * rz;
  LinearResult result;
  while (rz > goal && result.iterations < max_iterations) {
    ++result.iterations;
    solve_upper(factor, p, scratch, t);
    solve_lower(
        factor, [&](size_t k) -> Vec6 { return p[k] + factor.rest[k].lazyProduct(t[k]); }, q);
    const double curvature = sum_rows(factor, [&](size_t k) {
      q[k] += t[k];
      return p[k].dot(q[k]);
    });
    if (!(curvature > 0)) break;
    const double step = rz / curvature;
    const double rz_next = sum_rows(factor, [&](size_t k) {
      sum[k] += step * t[k];
      r[k] -= step * q[k];
      scratch[k] = precondition(k);
      return r[k].dot(scratch[k]);
    });
    const double ratio = rz_next / rz;
    rz = rz_next;
    for_rows(factor, [&](size_t k) { p[k] = scratch[k] + ratio * p[k]; });
  }
  for (size_t k = 0; k < n; ++k) x[static_cast<size_t>(factor.order[k])] = sum[k];
  result.converged = rz <= goal;
  return result;
}

}  // namespace talus
