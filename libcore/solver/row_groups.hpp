// libcore/solver/row_groups.hpp
// The contacts of an island two at a time: the contact law and the tangents without a branch per
// contact.
//
// The symmetric tangent leaves out the change of the friction bound with the normal impulse, so
// that a Newton step goes downhill and conjugate gradients apply; the bound itself is renewed at
// every evaluation.
#pragma once

#include <cstdint>
#include <span>

#include "solver/packed_matrix.hpp"
#include "solver/pair_evaluation.hpp"

namespace talus {

/// Rows that are evaluated at a time, with the same bits: two anywhere, four where the processor
/// has AVX2.
enum class RowWidth : std::uint8_t { two = 2, four = 4 };
/// Whether this processor and this build can take four.
[[nodiscard]] bool has_four_lanes();
[[nodiscard]] inline RowWidth widest() { return has_four_lanes() ? RowWidth::four : RowWidth::two; }

/// Impulses of the pairs' contacts at their relative motions. A tangent counts as changed with a
/// state, or when a slip stiffness differs by more than `slack` from that of the summed tangent.
void evaluate_pairs(std::span<PairEvaluation> pairs, Evaluation evaluation, double slack,
                    RowWidth width = widest());
/// The same where has_four_lanes() (row_groups_avx2.cpp).
void evaluate_pairs_by_four(std::span<PairEvaluation> pairs, Evaluation evaluation, double slack);

/// W = sum T^T K T of a pair, symmetric; and with `rest`, the part by which the exact derivative
/// replaces the stiffness across the slip. False when no contact presses.
bool sum_tangents(std::span<RowGroup> groups, Packed<6>& W, Mat6* rest);

}  // namespace talus
