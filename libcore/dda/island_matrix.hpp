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

namespace talus {

[[nodiscard]] inline std::span<RowGroup> groups_of(RowGroups& rows, std::size_t pair) {
  return std::span(rows.groups)
      .subspan(static_cast<std::size_t>(rows.begin[pair]),
               static_cast<std::size_t>(rows.begin[pair + 1] - rows.begin[pair]));
}

/// u = v_A - X v_B: motion of A relative to B as a field about A's centroid; `shift` = x_A - x_B.
template <int Dof>
[[nodiscard]] inline Eigen::Matrix<double, Dof, 1> relative_motion(
    const Eigen::Matrix<double, Dof, 1>& a, const Eigen::Matrix<double, Dof, 1>& b,
    const Vec3& shift) {
  Eigen::Matrix<double, Dof, 1> u = a - b;
  u.template head<3>() = a.template head<3>() - point_velocity<Dof>(b, shift);
  return u;
}

/// X^T f: the generalised force `f` about A's centroid as one about B's.
template <int Dof>
[[nodiscard]] inline Eigen::Matrix<double, Dof, 1> carried_to_b(
    const Eigen::Matrix<double, Dof, 1>& f, const Vec3& shift) {
  Eigen::Matrix<double, Dof, 1> out = generalised<Dof>(shift, f.template head<3>());
  out.template tail<Dof - 3>() += f.template tail<Dof - 3>();
  return out;
}

/// Tangents with or without the change of the friction bound with the normal impulse. With it the
/// matrix is the exact derivative, and not symmetric.
enum class Tangent : std::uint8_t { symmetric, exact };

template <int Dof>
struct IslandMatrix {  // clang-format off
  using Vec = Eigen::Matrix<double, Dof, 1>;
  using Mat = Eigen::Matrix<double, Dof, Dof>;
  // prepare_matrix
  std::vector<Vec3> shift;         ///< x_A - x_B [m]                                   (n_pairs)
  std::vector<std::uint8_t> pair_changed;  ///< tangent has to be summed again          (n_pairs)
  std::vector<std::uint8_t> body_changed;  ///< a pair of the body changed since        (n_bodies)
  // update_tangents
  Tangent tangent = Tangent::symmetric;    ///< what `pair` and `rest` hold
  std::vector<Packed<Dof>> pair;   ///< W of pair p, its symmetric part                 (n_pairs)
  std::vector<Mat> rest;           ///< exact: what W has besides                     (n_pairs or 0)
  std::vector<std::uint8_t> pair_closed;   ///< W != 0                                  (n_pairs)
  std::vector<int> coupled;        ///< pairs of two bodies with W != 0                 (n_coupled)
  // choose_active
  std::vector<int> active;         ///< bodies that the linear solution moves, ascending (n_active)
  std::vector<int> active_coupled;         ///< coupled pairs with an active body
  std::vector<std::uint8_t> is_active;     ///<                                        (n_bodies)
  // update_diagonals
  std::vector<Packed<Dof>> own;       ///< M + contacts with the ground [kg .. kg m2]   (n_bodies)
  std::vector<Packed<Dof>> diagonal;  ///< diagonal block of K                          (n_bodies)
  std::vector<Packed<Dof>> inverse;   ///< of the diagonal block                        (n_bodies)
  // solvers
  std::vector<Vec> residual, preconditioned, direction, product;  ///<                  (n_bodies)
  std::vector<std::pair<int, int>> edges;  ///< graph for the factorisation
  BlockLu<Dof> lu;
};  // clang-format on

/// Sizes and constants of a step; everything counts as changed, or what BodyPair::changed says.
template <int Dof>
void prepare_matrix(const Island<Dof>& island, bool only_changed, IslandMatrix<Dof>& matrix);

/// Brings pairs marked as changed up to date with the rows' states.
template <int Dof>
void update_tangents(const Island<Dof>& island, Tangent tangent, RowGroups& rows,
                     IslandMatrix<Dof>& matrix);

/// Brings the diagonal blocks of bodies with changed pairs, and their inverses, up to date.
template <int Dof>
void update_diagonals(const Island<Dof>& island, IslandMatrix<Dof>& matrix);

/// Makes those bodies active that have `moves` != 0, and their neighbours over a pressing
/// contact; the others stand while the linear solution moves these.
template <int Dof>
void choose_active(const Island<Dof>& island, std::span<const std::uint8_t> moves,
                   IslandMatrix<Dof>& matrix);

/// y = K x for the active bodies, with symmetric tangents and after update_diagonals.
template <int Dof>
void multiply(const Island<Dof>& island, const IslandMatrix<Dof>& matrix,
              std::span<const Eigen::Matrix<double, Dof, 1>> x,
              std::span<Eigen::Matrix<double, Dof, 1>> y);

struct LinearResult {
  bool converged = false;
  int iterations = 0;
};

/// K x = b by conjugate gradients from zero, preconditioned with the diagonal blocks, until the
/// residual in the preconditioner's norm has fallen to `tolerance` of its start. Active bodies
/// only; x of the others is zero. Needs symmetric tangents and update_diagonals.
template <int Dof>
LinearResult solve_conjugate_gradients(const Island<Dof>& island, IslandMatrix<Dof>& matrix,
                                       std::span<const Eigen::Matrix<double, Dof, 1>> b,
                                       double tolerance, int max_iterations,
                                       std::span<Eigen::Matrix<double, Dof, 1>> x);

/// K x = b by block LU, with either tangent. A singular matrix gives an x that is not finite.
template <int Dof>
void solve_direct(const Island<Dof>& island, IslandMatrix<Dof>& matrix,
                  std::span<const Eigen::Matrix<double, Dof, 1>> b,
                  std::span<Eigen::Matrix<double, Dof, 1>> x);

}  // namespace talus
