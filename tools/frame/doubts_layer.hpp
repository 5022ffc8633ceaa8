// Places of an input to look at before its result is used, as points to open in a GIS.
// in:    what was found where, while a map or a raster was read
// out:   one layer of a GeoPackage, also where the input is refused
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "base/types.hpp"
#include "tools/frame/tool.hpp"

namespace talus {

/// One place. NaN and -1 become NULL.
struct DoubtRow {
  std::string what;           ///< "contour", "spot height", "contours meet", "cell" ...
  std::int64_t feature = -1;  ///< in its source
  Vec3 place = Vec3::Zero();  ///< on the map; z: its height [m]
  double expected_low = std::numeric_limits<double>::quiet_NaN();  ///< by what is beside it [m]
  double expected_high = std::numeric_limits<double>::quiet_NaN();
  double moved = std::numeric_limits<double>::quiet_NaN();  ///< in plan, to mend it [m]
  std::string outcome;  ///< "in doubt", "refused", "accepted", "mended", "not mended"
};

/// How far the height is off the expected ones; 0 between them, NaN without them [m].
[[nodiscard]] double difference_of(const DoubtRow& row);

/// Rows that were accepted, in words: "level area at 0 m, x 650000, y 5200100; ...", up to 20 of
/// them and how many more there are. Empty: none.
[[nodiscard]] std::string accepted_places(const std::vector<DoubtRow>& rows);

/// Writes the layer `doubts` where a path is given; it stays when the run is refused afterwards.
void write_doubts(Tool& tool, const std::string& path, const std::string& crs_wkt,
                  const std::vector<DoubtRow>& rows);

}  // namespace talus
