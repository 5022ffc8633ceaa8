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

/// A pair to evaluate.
struct PairEvaluation {
  std::span<RowGroup> groups;
  Vec6 motion;           ///< u
  Two sum[6];            ///< out: of the impulses, as generalised ones on A about its centroid
  bool changed = false;  ///< out: a tangent did

  [[nodiscard]] Vec6 impulse() const {
    Vec6 f;
    for (int k = 0; k < 6; ++k) f[k] = sum[k][0] + sum[k][1];
    return f;
  }
};

/// Rows that are evaluated at a time, with the same bits: two anywhere, four where the processor
/// has AVX2.
enum class RowWidth : std::uint8_t { two = 2, four = 4 };
/// Whether this processor and this build can take four.
[[nodiscard]] bool has_four_lanes();
[[nodiscard]] inline RowWidth widest() { return has_four_lanes() ? RowWidth::four : RowWidth::two; }

/// Impulses of the pairs' contacts at their relative motions. A tangent counts as changed with a
/// state, or with a slip stiffness by more than `slack` of what the tangent was summed with.
void evaluate_pairs(std::span<PairEvaluation> pairs, Evaluation evaluation, double slack,
                    RowWidth width = widest());
/// The same where has_four_lanes() (row_groups_avx2.cpp).
void evaluate_pairs_by_four(std::span<PairEvaluation> pairs, Evaluation evaluation, double slack);

/// W = sum T^T K T of a pair, symmetric; and with `rest`, what the exact derivative has instead of
/// the stiffness across the slip. False when no contact presses.
bool sum_tangents(std::span<RowGroup> groups, Packed<6>& W, Mat6* rest);

}  // namespace talus
