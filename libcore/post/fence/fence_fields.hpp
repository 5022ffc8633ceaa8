// libcore/post/fence/fence_fields.hpp: public
// Fields of a block's verdict at a fence, with how it arrived.
#pragma once

#include "base/fields.hpp"
#include "post/fence/fence_runs.hpp"

namespace talus {

struct VerdictRow {
  const Fence& fence;
  const FenceRunGroup& group;
  int run;
  const BlockVerdict& verdict;
  const FenceArrival* arrival;  ///< null: it did not arrive
};
[[nodiscard]] const std::vector<Field<VerdictRow>>& verdict_fields();

/// A row (CSV) for each fence, run and block: its verdict and, where it came to the fence, how.
[[nodiscard]] std::string verdict_csv(const std::vector<FenceCase>& fences,
                                      const FenceRunGroup& group);

}  // namespace talus
