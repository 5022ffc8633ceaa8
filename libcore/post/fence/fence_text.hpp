// libcore/post/fence/fence_text.hpp: public
// Results at a fence in words and as a table.
// in:    runs at the fences, the result of each fence
// out:   a summary of some lines, notes on the limits of the numbers, one row a block and fence
#pragma once

#include <string>
#include <vector>

#include "post/fence/fence_result.hpp"

namespace talus {

/// Where an arrival's values are from: "first touch" or "crossing".
[[nodiscard]] const char* recorded_at(const FenceArrival& arrival);

/// "fence a: 39 blocks of 1 run: 30 stopped, 9 not reached;" of the blocks called `name`.
[[nodiscard]] std::string verdicts_text(const std::string& name, std::size_t index,
                                        const FenceRunGroup& group);

/// Basis of the design check: "70 crossings of its line in 10 runs without the fence".
[[nodiscard]] std::string basis_text(const FenceResult& result);

/// Which energies are for design and which are not, and which runs are needed when there are none.
[[nodiscard]] std::string basis_note(const FenceResult& result, const std::string& fence,
                                     bool one_by_one);

/// Fates of the blocks at fence number `index`, its arrivals, and what the design check
/// says of it: one line.
[[nodiscard]] std::string fence_summary(const FenceCase& fence, std::size_t index,
                                        const FenceResult& result, const FenceRunGroup& group);

/// Limits of the numbers, a sentence or two each.
[[nodiscard]] std::vector<std::string> fence_notes(const FenceCase& fence, std::size_t index,
                                                   const FenceResult& result,
                                                   const FenceRunGroup& group,
                                                   const DesignCode& code);

}  // namespace talus
