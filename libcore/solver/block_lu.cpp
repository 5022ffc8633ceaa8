// LU factorisation of a sparse matrix of dense blocks with a symmetric pattern.
#include "solver/block_lu.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace talus {
namespace {

using std::size_t;

void erase_value(std::vector<int>& sorted, int value) {
  const auto at = std::lower_bound(sorted.begin(), sorted.end(), value);
  if (at != sorted.end() && *at == value) sorted.erase(at);
}

void make_graph(int n, std::span<const std::pair<int, int>> edges,
                std::vector<std::vector<int>>& neighbours) {
  if (neighbours.size() < static_cast<size_t>(n)) neighbours.resize(n);
  for (int i = 0; i < n; ++i) neighbours[i].clear();
  for (const auto& [a, b] : edges) {
    neighbours[a].push_back(b);
    neighbours[b].push_back(a);
  }
  for (int i = 0; i < n; ++i) {
    std::vector<int>& list = neighbours[i];
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
}

// The unknown left with the fewest neighbours; of several the lowest.
int next_unknown(int n, const std::vector<int>& place,
                 const std::vector<std::vector<int>>& neighbours) {
  int best = -1;
  for (int i = 0; i < n; ++i) {
    if (place[i] >= 0) continue;
    if (best < 0 || neighbours[i].size() < neighbours[best].size()) best = i;
  }
  return best;
}

// Takes `gone` out of the graph: its neighbours become neighbours of each other.
void eliminate(int gone, std::vector<std::vector<int>>& neighbours, std::vector<int>& merged) {
  const std::vector<int>& around = neighbours[gone];
  for (const int i : around) {
    std::vector<int>& own = neighbours[i];
    merged.clear();
    std::set_union(own.begin(), own.end(), around.begin(), around.end(),
                   std::back_inserter(merged));
    erase_value(merged, gone);
    erase_value(merged, i);
    own.assign(merged.begin(), merged.end());  // swapped, the arrays would never all have grown
  }
}

}  // namespace

void analyse_pattern(int n, std::span<const std::pair<int, int>> edges, BlockPattern& pattern) {
  if (pattern.n == n && std::ranges::equal(edges, pattern.edges)) return;
  pattern.n = n;
  pattern.edges.assign(edges.begin(), edges.end());
  pattern.order.clear();
  pattern.place.assign(n, -1);
  pattern.column_begin.assign(1, 0);
  pattern.row.clear();
  make_graph(n, edges, pattern.neighbours);
  for (int j = 0; j < n; ++j) {
    const int i = next_unknown(n, pattern.place, pattern.neighbours);
    pattern.place[i] = j;
    pattern.order.push_back(i);
    const std::vector<int>& below = pattern.neighbours[i];
    // Numbers of unknowns; they become places when all of these are known.
    pattern.row.insert(pattern.row.end(), below.begin(), below.end());
    pattern.column_begin.push_back(static_cast<int>(pattern.row.size()));
    eliminate(i, pattern.neighbours, pattern.merged);
  }
  for (int& row : pattern.row) row = pattern.place[row];
  for (int j = 0; j < n; ++j)
    std::sort(pattern.row.begin() + pattern.column_begin[j],
              pattern.row.begin() + pattern.column_begin[j + 1]);
}

int entry_of(const BlockPattern& pattern, int row_place, int column_place) {
  const auto begin = pattern.row.begin() + pattern.column_begin[column_place];
  const auto end = pattern.row.begin() + pattern.column_begin[column_place + 1];
  return static_cast<int>(std::lower_bound(begin, end, row_place) - pattern.row.begin());
}

// By columns, which are contiguous: the pivot of row k is the largest entry left in that row.
template <int Dof>
void invert(Eigen::Matrix<double, Dof, Dof>& matrix) {
  std::array<int, Dof> swapped;
  for (int k = 0; k < Dof; ++k) {
    int pivot = k;
    for (int j = k + 1; j < Dof; ++j)
      if (std::abs(matrix(k, j)) > std::abs(matrix(k, pivot))) pivot = j;
    swapped[k] = pivot;
    if (pivot != k) matrix.col(k).swap(matrix.col(pivot));
    const double per_pivot = 1 / matrix(k, k);
    matrix(k, k) = 1;
    matrix.col(k) *= per_pivot;
    for (int j = 0; j < Dof; ++j) {
      if (j == k) continue;
      const double factor = matrix(k, j);
      matrix(k, j) = 0;
      matrix.col(j) -= factor * matrix.col(k);
    }
  }
  for (int k = Dof; k-- > 0;) {
    const int pivot = swapped[k];
    if (pivot != k) matrix.row(k).swap(matrix.row(pivot));
  }
}

template <int Dof>
void clear_matrix(BlockLu<Dof>& matrix) {
  using Mat = typename BlockLu<Dof>::Mat;
  matrix.diagonal.assign(matrix.pattern.n, Mat::Zero());
  matrix.lower.assign(matrix.pattern.row.size(), Mat::Zero());
  matrix.upper.assign(matrix.pattern.row.size(), Mat::Zero());
}

template <int Dof>
void add_blocks(BlockLu<Dof>& matrix, int i, int j, const Eigen::Matrix<double, Dof, Dof>& ij,
                const Eigen::Matrix<double, Dof, Dof>& ji) {
  const int pi = matrix.pattern.place[i];
  const int pj = matrix.pattern.place[j];
  const auto entry =
      static_cast<size_t>(entry_of(matrix.pattern, std::max(pi, pj), std::min(pi, pj)));
  matrix.lower[entry] += pi > pj ? ij : ji;
  matrix.upper[entry] += pi > pj ? ji : ij;
}

namespace {

// Subtracts L_ij U_jk for all rows i and columns k of column j. Column k holds all rows of column j
// that come later.
template <int Dof>
void subtract_column(BlockLu<Dof>& matrix, int begin, int end) {
  const std::vector<int>& row = matrix.pattern.row;
  for (int e = begin; e < end; ++e) {
    const auto ee = static_cast<size_t>(e);
    const auto k = static_cast<size_t>(row[ee]);
    matrix.diagonal[k].noalias() -= matrix.lower[ee].lazyProduct(matrix.upper[ee]);
    auto target = static_cast<size_t>(matrix.pattern.column_begin[k]);
    for (int f = e + 1; f < end; ++f) {
      const auto ff = static_cast<size_t>(f);
      while (row[target] != row[ff]) ++target;
      matrix.lower[target].noalias() -= matrix.lower[ff].lazyProduct(matrix.upper[ee]);
      matrix.upper[target].noalias() -= matrix.lower[ee].lazyProduct(matrix.upper[ff]);
    }
  }
}

}  // namespace

template <int Dof>
void factor(BlockLu<Dof>& matrix) {
  const BlockPattern& pattern = matrix.pattern;
  matrix.inverse.resize(pattern.n);
  for (size_t j = 0; j < matrix.inverse.size(); ++j) {
    matrix.inverse[j] = matrix.diagonal[j];
    invert<Dof>(matrix.inverse[j]);
    const int begin = pattern.column_begin[j], end = pattern.column_begin[j + 1];
    for (int e = begin; e < end; ++e) {
      auto& lower = matrix.lower[e];
      lower = lower.lazyProduct(matrix.inverse[j]).eval();
    }
    subtract_column(matrix, begin, end);
  }
}

template <int Dof>
void solve(BlockLu<Dof>& factored, std::span<const Eigen::Matrix<double, Dof, 1>> b,
           std::span<Eigen::Matrix<double, Dof, 1>> x) {
  const BlockPattern& pattern = factored.pattern;
  const auto n = static_cast<size_t>(pattern.n);
  auto& y = factored.scratch;
  y.resize(n);
  for (size_t j = 0; j < n; ++j) y[j] = b[pattern.order[j]];
  for (size_t j = 0; j < n; ++j)
    for (int e = pattern.column_begin[j]; e < pattern.column_begin[j + 1]; ++e) {
      const auto ee = static_cast<size_t>(e);
      y[pattern.row[ee]].noalias() -= factored.lower[ee].lazyProduct(y[j]);
    }
  for (size_t j = n; j-- > 0;) {
    for (int e = pattern.column_begin[j]; e < pattern.column_begin[j + 1]; ++e) {
      const auto ee = static_cast<size_t>(e);
      y[j].noalias() -= factored.upper[ee].lazyProduct(y[pattern.row[ee]]);
    }
    y[j] = factored.inverse[j].lazyProduct(y[j]).eval();
    x[pattern.order[j]] = y[j];
  }
}

template void invert<6>(Eigen::Matrix<double, 6, 6>&);
template void invert<12>(Eigen::Matrix<double, 12, 12>&);
template void clear_matrix<6>(BlockLu<6>&);
template void clear_matrix<12>(BlockLu<12>&);
template void add_blocks<6>(BlockLu<6>&, int, int, const Eigen::Matrix<double, 6, 6>&,
                            const Eigen::Matrix<double, 6, 6>&);
template void add_blocks<12>(BlockLu<12>&, int, int, const Eigen::Matrix<double, 12, 12>&,
                             const Eigen::Matrix<double, 12, 12>&);
template void factor<6>(BlockLu<6>&);
template void factor<12>(BlockLu<12>&);
template void solve<6>(BlockLu<6>&, std::span<const Eigen::Matrix<double, 6, 1>>,
                       std::span<Eigen::Matrix<double, 6, 1>>);
template void solve<12>(BlockLu<12>&, std::span<const Eigen::Matrix<double, 12, 1>>,
                        std::span<Eigen::Matrix<double, 12, 1>>);

}  // namespace talus
