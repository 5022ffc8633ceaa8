// libcore/solver/incomplete_factor.hpp
// Conjugate gradients for the matrix of an island, K = M + sum B_c^T K_c B_c, preconditioned with
// an incomplete elimination of its bodies from the lowest to the highest, as loads are carried.
// in:     island, its matrix with symmetric tangents, active bodies, right side
// out:    the step of the active bodies
// theory: 3.4; docs/developing/design-notes.md
//
// K = L + A + L^T, A the diagonal blocks, L the coupling of a body to those eliminated before. The
// factor (D + L) D^-1 (D + L)^T drops the fill-in of elimination between bodies that share no pair:
// D_i = A_i - sum over j before i of L_ij D_j^-1 L_ij^T. It is K itself where the contact graph is
// a tree and each body has at most one neighbour after it: a column. Its blocks are positive by
// construction: a pair adds W to A_j and takes at most W from A_i, since D_j >= M_j + W.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solver/island_matrix.hpp"

namespace talus {

/// Block of the lower triangle, of the body at one place with one at a place before it.
struct LowerBlock {
  int before = 0;  ///< place of the other
  Mat6 block;      ///< L_ij
};

/// The same block from the side of the other body.
struct UpperBlock {
  int after = 0;  ///< place of its row
  int block = 0;  ///< index into IncompleteFactor::lower
};

/// Scratch: everything by place in the order of elimination.
struct IncompleteFactor {  // clang-format off
  Workers* workers = nullptr;        ///< share the loops: those of the matrix
  std::vector<double> height;        ///< against gravity [m]                            (n_bodies)
  std::vector<int> order;            ///< active bodies by place                         (n_active)
  std::vector<int> place;            ///< of each body, -1: not active                   (n_bodies)
  std::vector<LowerBlock> lower;     ///< row by row
  std::vector<int> lower_pair;       ///< pair of each block of `lower`
  std::vector<int> lower_begin;      ///< of the row at each place                    (n_active + 1)
  std::vector<UpperBlock> upper;     ///< column by column, from the last row up; threads only
  std::vector<int> upper_begin;      ///< of the column at each place                 (n_active + 1)
  std::vector<Mat6> pivot;           ///< D_i                                            (n_active)
  std::vector<Mat6> per_pivot;       ///< D_i^-1                                         (n_active)
  std::vector<Mat6> rest;            ///< A_i - 2 D_i                                    (n_active)
  std::vector<Vec6> residual, direction, product, sum, by_upper, scratch;
  std::vector<double> terms;         ///< of a sum, in its order; threads only          (n_active)
  std::vector<std::uint64_t> done;   ///< number of the last sweep that made this row; threads only
  std::uint64_t n_sweeps = 0;
};  // clang-format on

/// Heights of the bodies' centroids: `down` points along gravity, of any length.
void set_heights(const Island& island, const Vec3& down, IncompleteFactor& factor);

/// The factor for the active bodies of `matrix`, which holds symmetric tangents; the rest is
/// fixed.
void eliminate(const Island& island, const IslandMatrix& matrix, IncompleteFactor& factor);

/// K x = -b for the active bodies by conjugate gradients from zero, after eliminate(), until the
/// residual in the preconditioner's norm has fallen to `tolerance` of its start.
LinearResult solve_conjugate_gradients(IncompleteFactor& factor, std::span<const Vec6> b,
                                       double tolerance, int max_iterations, std::span<Vec6> x);

}  // namespace talus
