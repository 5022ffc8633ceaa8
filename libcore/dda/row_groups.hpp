// libcore/dda/row_groups.hpp
// The contacts of an island two at a time: the contact law and the tangents without a branch per
// contact. The impulse is that of dda/contact_law.hpp; a test holds the two together.
//
// The symmetric tangent leaves out the change of the friction bound with the normal impulse, so
// that a Newton step goes downhill and conjugate gradients apply; the bound itself is renewed at
// every evaluation.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "dda/island.hpp"
#include "dda/packed_matrix.hpp"

namespace talus {

/// Two doubles, the compiler's vector type: a register of any x86-64, plain code elsewhere with the
/// same bits. (Four at a time need AVX; without it the compiler takes them through memory.)
using Two __attribute__((vector_size(16), may_alias)) = double;

/// Two contacts of one pair; fields as in IslandRow, index = axis, then contact. Places without a
/// contact, and contacts that wait for their impact, have no stiffness.
struct RowGroup {
  Two normal[3], arm[3], shear_velocity[3], slip_start[3];
  Two bias, normal_damping, shear_damping, friction, cohesion, tension, normal_limit;
  Two impulse[3];
  Two state;           ///< ContactState
  Two normal_tangent;  ///< normal_damping; 0 while the normal impulse is at its limit [kg]
  Two slip_tangent;    ///< of a slipping contact across its direction [kg]
  Two trial_speed;     ///< of a slipping contact, v_t + s / tau [m/s]
  Two used_tangent;    ///< slip_tangent when the tangent was last summed [kg]
};

/// Rows [row_begin, row_end) of the pair fill groups [begin[p], begin[p + 1]).
struct RowGroups {
  std::vector<RowGroup> groups;  ///<                                                   (n_groups)
  std::vector<int> begin;  ///<                                                   (n_pairs + 1)
};

/// How contacts are evaluated: with the states they came with and friction bounded by the last
/// step's normal impulses (a bound from the predicted overlap has no limit), a new contact and one
/// that would pull more than it pressed by the law; or all with the law.
enum class Evaluation : std::uint8_t { inherited, coupled };

/// Packs the rows; those stiffer than `limit[p]` (D_n or D_t) are lowered to it. Returns how many.
/// With `only_changed` the rest of `out` stays as it is: pairs and numbers of their rows are those
/// of the last call.
int pack_rows(std::span<const BodyPair> pairs, std::span<const IslandRow> rows,
              std::span<const double> limit, bool only_changed, RowGroups& out);

/// Impulses and states back to the rows.
void unpack_rows(std::span<const BodyPair> pairs, const RowGroups& groups,
                 std::span<IslandRow> rows);

/// Impulses of a pair's contacts at the relative motion u; `f` is their sum as a generalised
/// impulse on A about its centroid. True when a tangent changed: a state, or a slip stiffness by
/// more than `slack` of what the tangent was summed with.
bool evaluate_pair(std::span<RowGroup> groups, const Vec6& u, Evaluation evaluation, double slack,
                   Vec6& f);

/// W = sum T^T K T of a pair, symmetric; and with `rest`, what the exact derivative has instead of
/// the stiffness across the slip. False when no contact presses.
bool sum_tangents(std::span<RowGroup> groups, Packed<6>& W, Mat6* rest);

}  // namespace talus
