// libcore/record/tree_hits.hpp: public
// Which trees were hit, by which block, with which energy left: rows of a run file from the state.
#pragma once

#include <vector>

#include "record/run_file.hpp"

namespace talus {

/// One row a block and stem that it touched, by the time of the first touch, step by step.
[[nodiscard]] std::vector<TreeHitRow> tree_hit_rows(const Scene& scene, const State& state);

}  // namespace talus
