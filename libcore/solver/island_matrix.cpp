// Matrix of a Newton step of an island: tangents pair by pair, and its solution by block LU.
#include "solver/island_matrix.hpp"

#include <algorithm>
#include <numeric>

#include "solver/one_contact.hpp"

namespace talus {
namespace {

using std::size_t;

// D += X^T W X, the pair's part of the diagonal block of B.
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

// The pairs of each body, ascending.
void list_pairs(const Island& island, IslandMatrix& matrix) {
  matrix.pair_begin.assign(island.mass.size() + 1, 0);
  const auto for_each = [&](auto&& use) {
    for (size_t p = 0; p < island.pairs.size(); ++p)
      for (const int body : {island.pairs[p].a, island.pairs[p].b})
        if (body >= 0) use(static_cast<size_t>(body), static_cast<int>(p));
  };
  for_each([&](size_t i, int) { ++matrix.pair_begin[i]; });
  std::exclusive_scan(matrix.pair_begin.begin(), matrix.pair_begin.end(), matrix.pair_begin.begin(),
                      0);
  matrix.pairs_of.resize(matrix.pair_begin.back());
  for_each([&](size_t i, int p) { matrix.pairs_of[matrix.pair_begin[i]++] = p; });
  std::shift_right(matrix.pair_begin.begin(), matrix.pair_begin.end(), 1);
  matrix.pair_begin.front() = 0;
}

// Nothing is summed yet.
void begin_sums(const Island& island, IslandMatrix& matrix) {
  matrix.changed_pairs.fill();
  matrix.pair_closed.assign(island.pairs.size(), 0);
  for (size_t i = 0; i < island.mass.size(); ++i)
    matrix.diagonal[i] = packed<6>(matrix.mass_scale * island.mass[i]);
}

void add_to_diagonals(const BodyPair& pair, const Packed<6>& W, const Vec3& shift,
                      IslandMatrix& matrix) {
  add(W, matrix.diagonal[static_cast<size_t>(pair.a)]);
  if (pair.b >= 0) add_carried(W, shift, matrix.diagonal[static_cast<size_t>(pair.b)]);
}

// Reads the rows and neighbours of the active bodies.
void read_active(const Island& island, IslandMatrix& matrix) {
  ActiveBodies& active = matrix.active;
  active.pairs.clear();
  active.others.clear();
  for (const int body : active.bodies.items)
    for (const int p : pairs_of(matrix, static_cast<size_t>(body))) {
      const BodyPair& pair = island.pairs[p];
      const int other = pair.a == body ? pair.b : pair.a;
      const bool both = other >= 0 && active.bodies.contains(other);
      if (both && other < body) continue;  // that one brings the pair
      active.pairs.push_back(p);
      if (other >= 0 && !both) active.others.add(other);
    }
}

}  // namespace

void prepare_pair(const Island& island, size_t p, IslandMatrix& matrix) {
  const BodyPair& pair = island.pairs[p];
  matrix.changed_pairs.add(static_cast<int>(p));
  if (matrix.tangent == Tangent::symmetric && matrix.pair_closed[p]) {
    Packed<6> change;  // its part at the shift before
    subtract(matrix.pair[p], change);
    add_to_diagonals(pair, change, matrix.shift[p], matrix);
    matrix.pair_closed[p] = 0;
  }
  matrix.shift[p] = pair.shift;
}

void prepare_matrix(const Island& island, IslandMatrix& matrix) {
  const size_t n = island.mass.size(), n_pairs = island.pairs.size();
  list_pairs(island, matrix);
  matrix.tangent = Tangent::none;
  matrix.pair_closed.assign(n_pairs, 0);
  matrix.shift.resize(n_pairs);
  matrix.pair.resize(n_pairs);
  matrix.changed_pairs.reset(n_pairs);
  for (size_t p = 0; p < n_pairs; ++p) prepare_pair(island, p, matrix);
  matrix.active.bodies.reset(n);
  matrix.active.others.reset(n);
  activate_all(island, matrix);
  matrix.diagonal.resize(n);
}

namespace {

// W, and with `rest` the change of the bounds, of the angular row of a pair.
void add_couple(const Island& island, const BodyPair& pair, Packed<6>& W, Mat6* rest) {
  const AngularRow& turn = island.angular[pair.angular];
  const Mat3 across = tangent(turn);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j <= i; ++j) W(3 + i, 3 + j) += across(i, j);
  if (rest == nullptr) return;
  for (int r = pair.row_begin; r < pair.row_end; ++r) {
    const RowIn<const RowGroup> row = row_of(island, r);
    if (row.state() == ContactState::open || row.normal_impulse() <= 0) continue;
    const RowArm& arm = island.arms[turn.arm_begin + r - pair.row_begin];
    rest->bottomRows<3>() -= (row.value(&RowGroup::normal_tangent) * by_bound(turn, arm)) *
                             generalised<6>(row.arm(), row.normal()).transpose();
  }
}

// The tangent of a pair's rows and of its angular row; false where no contact presses.
bool sum_pair(Island& island, const BodyPair& pair, Packed<6>& W, Mat6* rest) {
  const std::span<RowGroup> groups = groups_of(island, pair);
  const bool closed = sum_tangents(groups, W, rest);
  if (pair.angular >= 0) add_couple(island, pair, W, rest);
  return closed;
}

// Symmetric tangents of `pairs`, and by how much they changed: each is its pair's alone.
void renew_tangents(Island& island, std::span<const int> pairs, IslandMatrix& matrix) {
  if (matrix.change.size() < pairs.size()) matrix.change.resize(pairs.size());
  in_chunks(matrix.workers, pairs.size(), [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      const auto p = static_cast<size_t>(pairs[i]);
      const BodyPair& pair = island.pairs[p];
      Packed<6> change;
      if (matrix.pair_closed[p]) subtract(matrix.pair[p], change);
      matrix.pair_closed[p] = sum_pair(island, pair, matrix.pair[p], nullptr);
      add(matrix.pair[p], change);
      matrix.change[i] = change;
    }
  });
}

}  // namespace

void update_tangents(Island& island, Tangent tangent, IslandMatrix& matrix) {
  if (tangent != matrix.tangent) begin_sums(island, matrix);
  matrix.tangent = tangent;
  const bool exact = tangent == Tangent::exact;
  if (exact) matrix.rest.resize(island.pairs.size());
  const std::vector<int>& changed = matrix.changed_pairs.items;
  if (exact) {
    for (const int p : changed) {
      matrix.rest[p].setZero();
      matrix.pair_closed[p] = sum_pair(island, island.pairs[p], matrix.pair[p], &matrix.rest[p]);
    }
    return matrix.changed_pairs.clear();
  }
  // all at once where threads share the work, else so few that they stay near
  const size_t batch = matrix.workers == nullptr ? size_t{32} : changed.size();
  for (size_t begin = 0; begin < changed.size(); begin += batch) {
    const auto some = std::span(changed).subspan(begin, std::min(batch, changed.size() - begin));
    renew_tangents(island, some, matrix);
    for (size_t i = 0; i < some.size(); ++i)
      add_to_diagonals(island.pairs[some[i]], matrix.change[i], matrix.shift[some[i]], matrix);
  }
  matrix.changed_pairs.clear();
}

void scale_masses(double scale, IslandMatrix& matrix) {
  matrix.mass_scale = scale;
  matrix.tangent = Tangent::none;
}

void activate(const Island& island, std::span<const int> bodies, IslandMatrix& matrix) {
  matrix.active.bodies.clear();
  for (const int body : bodies) matrix.active.bodies.add(body);
  read_active(island, matrix);
}

void activate_all(const Island& island, IslandMatrix& matrix) {
  ActiveBodies& active = matrix.active;
  active.bodies.fill();
  active.others.clear();
  active.pairs.resize(island.pairs.size());
  std::iota(active.pairs.begin(), active.pairs.end(), 0);
}

namespace {

void sum_blocks(const Island& island, IslandMatrix& matrix) {
  BlockLu<6>& lu = matrix.lu;
  const auto diagonal_of = [&](int body) -> Mat6& { return lu.diagonal[lu.pattern.place[body]]; };
  for (int i = 0; i < n_bodies(island); ++i) diagonal_of(i) = matrix.mass_scale * island.mass[i];
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
  for (size_t p = 0; p < island.pairs.size(); ++p)
    if (matrix.pair_closed[p] && island.pairs[p].b >= 0)
      matrix.edges.emplace_back(island.pairs[p].a, island.pairs[p].b);
  analyse_pattern(n_bodies(island), matrix.edges, matrix.lu.pattern);
  clear_matrix(matrix.lu);
  sum_blocks(island, matrix);
  factor(matrix.lu);
  solve<6>(matrix.lu, b, x);
  for (Vec6& step : x) step = -step;
}

}  // namespace talus
