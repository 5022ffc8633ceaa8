// libcore/dda/island_matrix.hpp
// The matrix of one Newton step of an island, K = M + sum B_c^T K_c B_c, kept pair by pair, and its
// solution by conjugate gradients or block LU.
// theory 1.6, 3.4; docs/design-notes.md (why pairs are not spread over three blocks)
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "dda/block_lu.hpp"
#include "dda/island.hpp"
#include "dda/newton.hpp"
#include "dda/packed_matrix.hpp"
#include "dda/row_groups.hpp"
#include "dda/single_matrix.hpp"

namespace talus {

[[nodiscard]] inline std::span<RowGroup> groups_of(RowGroups& rows, std::size_t pair) {
  return std::span(rows.groups)
      .subspan(static_cast<std::size_t>(rows.begin[pair]),
               static_cast<std::size_t>(rows.begin[pair + 1] - rows.begin[pair]));
}

/// u = v_A - X v_B: motion of A relative to B as a field about A's centroid; `shift` = x_A - x_B.
[[nodiscard]] inline Vec6 relative_motion(const Vec6& a, const Vec6& b, const Vec3& shift) {
  Vec6 u = a - b;
  u.head<3>() = a.head<3>() - point_velocity<6>(b, shift);
  return u;
}

/// X^T f: the generalised force `f` about A's centroid as one about B's.
[[nodiscard]] inline Vec6 carried_to_b(const Vec6& f, const Vec3& shift) {
  Vec6 out = generalised<6>(shift, f.head<3>());
  out.tail<3>() += f.tail<3>();
  return out;
}

/// Tangents with or without the change of the friction bound with the normal impulse. With it the
/// matrix is the exact derivative, and not symmetric.
enum class Tangent : std::uint8_t { symmetric, exact };

/// What conjugate gradients take of a pair of two bodies.
struct SingleCoupling {
  SingleMatrix W;  ///< IslandMatrix::pair
  Four shift;      ///< IslandMatrix::shift [m]
};

struct IslandMatrix {  // clang-format off
  // prepare_matrix
  std::vector<Vec3> shift;         ///< x_A - x_B [m]                                   (n_pairs)
  std::vector<std::uint8_t> pair_changed;  ///< tangent has to be summed again          (n_pairs)
  std::vector<std::uint8_t> body_changed;  ///< a pair of the body changed since        (n_bodies)
  // update_tangents
  Tangent tangent = Tangent::symmetric;    ///< what `pair` and `rest` hold
  std::vector<Packed<6>> pair;     ///< W of pair p, its symmetric part                 (n_pairs)
  std::vector<Mat6> rest;          ///< exact: what W has besides                     (n_pairs or 0)
  std::vector<SingleCoupling> coupling;    ///< symmetric: the same, of two bodies (n_pairs or 0)
  std::vector<std::uint8_t> pair_closed;   ///< W != 0                                  (n_pairs)
  std::vector<int> coupled;        ///< pairs of two bodies with W != 0                 (n_coupled)
  // choose_active
  std::vector<int> active;         ///< bodies that the linear solution moves, ascending (n_active)
  std::vector<int> active_coupled;         ///< coupled pairs with an active body
  std::vector<std::uint8_t> is_active;     ///<                                        (n_bodies)
  // update_diagonals
  std::vector<Packed<6>> own;      ///< M + contacts with the ground [kg .. kg m2]      (n_bodies)
  std::vector<Packed<6>> diagonal; ///< diagonal block of K                             (n_bodies)
  std::vector<SingleMatrix> single_own;    ///<                                         (n_bodies)
  std::vector<SingleMatrix> inverse;       ///< of the diagonal block                   (n_bodies)
  // solvers
  std::vector<SingleVector> residual, preconditioned, direction, product, sum;  ///<    (n_bodies)
  std::vector<std::pair<int, int>> edges;  ///< graph for the factorisation
  BlockLu<6> lu;
};  // clang-format on

/// Sizes and constants of a step; everything counts as changed, or what BodyPair::changed says.
void prepare_matrix(const Island& island, bool only_changed, IslandMatrix& matrix);

/// Brings pairs marked as changed up to date with the rows' states.
void update_tangents(const Island& island, Tangent tangent, RowGroups& rows, IslandMatrix& matrix);

/// Brings the diagonal blocks of bodies with changed pairs, and their inverses, up to date.
void update_diagonals(const Island& island, IslandMatrix& matrix);

/// Makes those bodies active that have `moves` != 0, and their neighbours over a pressing
/// contact; the others stand while the linear solution moves these.
void choose_active(const Island& island, std::span<const std::uint8_t> moves, IslandMatrix& matrix);

/// y = K x for the active bodies, with symmetric tangents and after update_diagonals.
void multiply(const Island& island, const IslandMatrix& matrix, std::span<const SingleVector> x,
              std::span<SingleVector> y);

struct LinearResult {
  bool converged = false;
  int iterations = 0;
};

/// K x = b by conjugate gradients from zero, preconditioned with the diagonal blocks, until the
/// residual in the preconditioner's norm has fallen to `tolerance` of its start. Active bodies
/// only; x of the others is zero. In single precision: `tolerance` above 1e-4 or so. Needs
/// symmetric tangents and update_diagonals.
LinearResult solve_conjugate_gradients(const Island& island, IslandMatrix& matrix,
                                       std::span<const Vec6> b, double tolerance,
                                       int max_iterations, std::span<Vec6> x);

/// K x = b by block LU, with either tangent. A singular matrix gives an x that is not finite.
void solve_direct(const Island& island, IslandMatrix& matrix, std::span<const Vec6> b,
                  std::span<Vec6> x);

}  // namespace talus
