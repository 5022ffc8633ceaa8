// libcore/report/map_marks.hpp
// Marks of a map drawn in metres, y to the south: scale bar and north arrow.
#pragma once

#include <string>

#include "base/types.hpp"

namespace talus {

/// In the corners of the window from `low` to `high`. The bar has a round length of about a quarter
/// of the width.
[[nodiscard]] std::string scale_and_north(const Vec2& low, const Vec2& high);

}  // namespace talus
