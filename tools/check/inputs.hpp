// tools/check/inputs.hpp
// What a site's results are made from, as extents to draw over the ground.
#pragma once

#include <vector>

#include "report/check_view.hpp"
#include "tools/check/look.hpp"

namespace talus {

/// The layers that the reports of the import list, then what the look has found of source, blocks,
/// fences, objects and stems, then what else the site file itself writes; in local coordinates.
[[nodiscard]] std::vector<ViewedInput> viewed_inputs(const Look& look,
                                                     const std::vector<Json>& reports);

}  // namespace talus
