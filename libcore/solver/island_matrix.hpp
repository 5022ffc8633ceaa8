// libcore/solver/island_matrix.hpp
// The matrix of one Newton step of an island, K = M + sum B_c^T K_c B_c, kept pair by pair, and its
// solution by block LU; by conjugate gradients: solver/incomplete_factor.hpp.
// theory 1.6, 3.4; docs/developing/design-notes.md (why pairs are not spread over three blocks)
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/index_set.hpp"
#include "base/workers.hpp"
#include "solver/block_lu.hpp"
#include "solver/island.hpp"
#include "solver/newton.hpp"
#include "solver/packed_matrix.hpp"
#include "solver/row_groups.hpp"

namespace talus {

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
/// matrix is the exact derivative, and not symmetric. `none`: not summed yet.
enum class Tangent : std::uint8_t { none, symmetric, exact };

/// Bodies that a linear solution moves while the rest is fixed, and its data of the island:
/// costs go with these, not with the island.
struct ActiveBodies {  // clang-format off
  IndexSet bodies;
  IndexSet others;         ///< that share a pair with an active body
  std::vector<int> pairs;  ///< with an active body
};

struct IslandMatrix {
  Workers* workers = nullptr;      ///< share the loops; nullptr: there are none
  // prepare_matrix
  std::vector<int> pair_begin, pairs_of; ///< pairs of body i: pairs_of[pair_begin[i]] to
                                         ///< pairs_of[pair_begin[i + 1]], ascending
  std::vector<Vec3> shift;         ///< x_A - x_B [m]                                   (n_pairs)
  IndexSet changed_pairs;          ///< whose tangent has to be summed again
  double mass_scale = 1;           ///< K has M times this
  // update_tangents
  Tangent tangent = Tangent::none;         ///< of `pair` and `rest`
  std::vector<Packed<6>> pair;     ///< W of pair p, its symmetric part                 (n_pairs)
  std::vector<Mat6> rest;          ///< exact: difference from W                    (n_pairs or 0)
  std::vector<std::uint8_t> pair_closed;   ///< W != 0                                  (n_pairs)
  std::vector<Packed<6>> change;   ///< scratch: of W, of pairs that changed
  std::vector<Packed<6>> diagonal; ///< of K, symmetric tangents [kg .. kg m2]          (n_bodies)
  // activate, activate_all
  ActiveBodies active;
  // solve_direct
  std::vector<std::pair<int, int>> edges;  ///< graph for the factorisation
  BlockLu<6> lu;
};  // clang-format on

/// Pairs of body `i`, ascending.
[[nodiscard]] inline std::span<const int> pairs_of(const IslandMatrix& matrix, std::size_t i) {
  return std::span(matrix.pairs_of)
      .subspan(static_cast<std::size_t>(matrix.pair_begin[i]),
               static_cast<std::size_t>(matrix.pair_begin[i + 1] - matrix.pair_begin[i]));
}

/// Sizes and constants of a step; everything counts as changed.
void prepare_matrix(const Island& island, IslandMatrix& matrix);

/// Constants of `pair`, whose tangent has to be summed again.
void prepare_pair(const Island& island, std::size_t pair, IslandMatrix& matrix);

/// Brings pairs marked as changed, and the diagonal blocks of their bodies, up to date with the
/// rows' states.
void update_tangents(Island& island, Tangent tangent, IslandMatrix& matrix);

/// Makes K = scale M + sum B_c^T K_c B_c from the next update_tangents() on.
void scale_masses(double scale, IslandMatrix& matrix);

/// Makes exactly `bodies`, which may repeat, active.
void activate(const Island& island, std::span<const int> bodies, IslandMatrix& matrix);
void activate_all(const Island& island, IslandMatrix& matrix);

struct LinearResult {
  bool converged = false;
  int iterations = 0;
};

/// K x = -b by block LU, with either tangent; all bodies. A singular matrix gives an x that is not
/// finite.
void solve_direct(const Island& island, IslandMatrix& matrix, std::span<const Vec6> b,
                  std::span<Vec6> x);

}  // namespace talus
