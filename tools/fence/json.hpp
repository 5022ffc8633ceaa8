// tools/fence/json.hpp
// Results at fences as talus-fence writes them to JSON. Keys: docs/reference/formats.md#fence
#pragma once

#include "post/fence/fence_result.hpp"
#include "tools/fence/inputs.hpp"
#include "tools/frame/tool.hpp"

namespace talus {

/// All of fence number `index`; `basis` of the runs.
[[nodiscard]] Json fence_json(const FenceCase& fence, std::size_t index, const FenceResult& result,
                              const FenceRunGroup& group, const ShareBasis& basis,
                              const FenceCode& code);

/// A dam or gallery: verdicts, arrivals, load cases.
[[nodiscard]] Json dam_json(const DamCase& dam, const DamResult& result, const FenceRunGroup& group,
                            const Fence& crest, const ShareBasis& basis);

/// Blocks behind the line of fence number `index` with the fences, without them, and the
/// difference.
[[nodiscard]] Json comparison_json(const FenceRunGroup& with, const FenceRunGroup& without,
                                   std::size_t index);

[[nodiscard]] Json deposit_change_json(const GroundSums& with, const GroundSums& without);

}  // namespace talus
