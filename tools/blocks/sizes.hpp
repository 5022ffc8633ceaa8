// tools/blocks/sizes.hpp
// talus-blocks --sizes: design volumes from a list of blocks.
#pragma once

#include <limits>
#include <string>

#include "tools/frame/tool.hpp"

namespace talus {

struct SizeOptions {
  std::string list, scenarios;
  double anchor_volume_m3 = std::numeric_limits<double>::quiet_NaN();
  double anchor_years = std::numeric_limits<double>::quiet_NaN();
};
void declare_sizes(Tool& tool, SizeOptions& o);

/// Fits the list and gives V30, V100, V300. Throws InputError for a list without sizes, sizes that
/// are not above 0, fewer than five blocks, or no anchor.
void report_sizes(Tool& tool, const SizeOptions& o);

}  // namespace talus
