// libcore/draw/ticks.hpp: public
// Round numbers: of axes, scales and distances between lines.
#pragma once

#include <vector>

namespace talus {

/// Round numbers (1, 2 or 5 times a power of ten apart) that cover [low, high] with about `n`
/// steps.
[[nodiscard]] std::vector<double> round_ticks(double low, double high, int n);

/// 1, 1.25, 1.5, 2, 2.5, 3, 4, 5, 6, 8 times a power of ten, at least `value` > 0.
[[nodiscard]] double round_scale(double value);
/// 1, 2, 5 times a power of ten: the smallest one of at least `value`, the largest one of at most.
[[nodiscard]] double round_up(double value);
[[nodiscard]] double round_down(double value);

}  // namespace talus
