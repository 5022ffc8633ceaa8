// Four rows at a time, for processors with AVX2. Inline functions of headers are shared with other
// files and must run everywhere, so they come before the pragma.
#include <cmath>

#include "solver/row_groups.hpp"

#if defined(__x86_64__) && !defined(__clang__)
#pragma GCC target("avx2")
#pragma GCC diagnostic ignored "-Wpsabi"  // vectors of four are passed within this file alone
#define TALUS_FOUR_LANES
#include "solver/row_lanes.hpp"

namespace talus {

bool has_four_lanes() {
  static const bool has = __builtin_cpu_supports("avx2") != 0;
  return has;
}

[[gnu::flatten]] void evaluate_pairs_by_four(std::span<PairEvaluation> pairs, Evaluation evaluation,
                                             double slack) {
  using FourDoubles __attribute__((vector_size(32))) = double;
  evaluate_in_lanes<FourDoubles>(pairs, evaluation, slack);
}

}  // namespace talus
#else
namespace talus {

bool has_four_lanes() { return false; }
void evaluate_pairs_by_four(std::span<PairEvaluation> pairs, Evaluation evaluation, double slack) {
  evaluate_pairs(pairs, evaluation, slack, RowWidth::two);
}

}  // namespace talus
#endif
