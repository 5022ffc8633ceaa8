// libcore/solver/block_lu.hpp: public
// LU factorisation of a sparse matrix of small dense blocks whose pattern is symmetric, its values
// need not be: P A P^T = L U. Pivots are chosen within the diagonal blocks.
// The order is minimum degree on the graph of the blocks; the analysis is kept while the graph
// stays.
#pragma once

#include <Eigen/Core>
#include <span>
#include <utility>
#include <vector>

namespace talus {

/// Order and fill of the factor. Column j is the j-th unknown eliminated.
struct BlockPattern {  // clang-format off
  int n = 0;
  std::vector<std::pair<int, int>> edges;  ///< the graph analysed
  std::vector<int> order;          ///< unknown eliminated at place j                    (n)
  std::vector<int> place;          ///< place of unknown i                               (n)
  std::vector<int> column_begin;   ///< entries below the diagonal of column j           (n + 1)
  std::vector<int> row;            ///< their places, ascending in a column              (n_entries)
  std::vector<std::vector<int>> neighbours;  ///< scratch of the analysis
  std::vector<int> merged;                   ///< scratch of the analysis
};  // clang-format on

/// Analyses the graph of n unknowns; does nothing when `pattern` is already that of this graph.
void analyse_pattern(int n, std::span<const std::pair<int, int>> edges, BlockPattern& pattern);

/// Index into BlockPattern::row of entry (row_place, column_place), row_place > column_place.
[[nodiscard]] int entry_of(const BlockPattern& pattern, int row_place, int column_place);

/// Inverse of a small dense matrix in place, by Gauss-Jordan elimination with partial pivoting. A
/// singular or not finite matrix gives one that is not finite.
template <int Dof>
void invert(Eigen::Matrix<double, Dof, Dof>& matrix);

template <int Dof>
struct BlockLu {  // clang-format off
  using Vec = Eigen::Matrix<double, Dof, 1>;
  using Mat = Eigen::Matrix<double, Dof, Dof>;
  BlockPattern pattern;
  // filled by the caller with A, then by factor() with L and U
  std::vector<Mat> diagonal;  ///< by place                                              (n)
  std::vector<Mat> lower;     ///< (row, column) as pattern.row                          (n_entries)
  std::vector<Mat> upper;     ///< (column, row): its mirror                             (n_entries)
  // factor
  std::vector<Mat> inverse;   ///< of the diagonal blocks of U                           (n)
  std::vector<Vec> scratch;   ///<                                                       (n)
};  // clang-format on

/// A = 0 on the pattern.
template <int Dof>
void clear_matrix(BlockLu<Dof>& matrix);

/// A(i, j) += ij, A(j, i) += ji for unknowns i != j that share an edge.
template <int Dof>
void add_blocks(BlockLu<Dof>& matrix, int i, int j, const Eigen::Matrix<double, Dof, Dof>& ij,
                const Eigen::Matrix<double, Dof, Dof>& ji);

/// A -> L, U. A singular or not finite pivot shows in the solution, which is then not finite.
template <int Dof>
void factor(BlockLu<Dof>& matrix);

/// x = A^-1 b; both by unknown, may be the same.
template <int Dof>
void solve(BlockLu<Dof>& factored, std::span<const Eigen::Matrix<double, Dof, 1>> b,
           std::span<Eigen::Matrix<double, Dof, 1>> x);

}  // namespace talus
