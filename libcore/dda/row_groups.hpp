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

/// How contacts are evaluated: with the states they came with and friction bounded by the last
/// step's normal impulses (a bound from the predicted overlap has no limit), a new contact and one
/// that would pull more than it pressed by the law; or all with the law.
enum class Evaluation : std::uint8_t { inherited, coupled };

/// Impulses of a pair's contacts at the relative motion u; `f` is their sum as a generalised
/// impulse on A about its centroid. True when a tangent changed: a state, or a slip stiffness by
/// more than `slack` of what the tangent was summed with.
bool evaluate_pair(std::span<RowGroup> groups, const Vec6& u, Evaluation evaluation, double slack,
                   Vec6& f);

/// W = sum T^T K T of a pair, symmetric; and with `rest`, what the exact derivative has instead of
/// the stiffness across the slip. False when no contact presses.
bool sum_tangents(std::span<RowGroup> groups, Packed<6>& W, Mat6* rest);

}  // namespace talus
