// tools/check/inputs.hpp
// Inputs of a site's results, as extents to draw over the ground.
#pragma once

#include <vector>

#include "report/check_view.hpp"
#include "tools/check/look.hpp"

namespace talus {

/// The layers that the reports of the import list, then what the look has found of source, blocks,
/// fences, objects and stems, then the rest that the site file itself gives; in local coordinates.
[[nodiscard]] std::vector<ViewedInput> viewed_inputs(const Look& look,
                                                     const std::vector<Json>& reports);

}  // namespace talus
