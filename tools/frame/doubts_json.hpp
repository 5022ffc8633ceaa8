// tools/frame/doubts_json.hpp
// Doubts in a report: `doubts`, a row each, and `n_doubts`, how many there are of a kind.
#pragma once

#include <vector>

#include "base/doubt.hpp"
#include "tools/frame/tool.hpp"

namespace talus {

/// Rows of up to 100 of a kind and state, the last of which represents all the rest. Form:
/// docs/reference/formats.md
void add_doubts(const std::vector<Doubt>& doubts, Json& report);

/// The rows of a report. None where it lacks the list.
[[nodiscard]] std::vector<Doubt> doubts_of(const Json& report);

}  // namespace talus
