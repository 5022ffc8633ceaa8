// tools/tin/doubts.hpp
// Heights and meetings of a contour map that need a look.
// in:    a map, its triangulation, the doubts that the user accepts
// out:   cleaned lines, doubts
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "terrain/contours.hpp"
#include "terrain/outliers.hpp"
#include "tools/frame/doubts.hpp"

namespace talus {

struct TinDoubtOptions : DoubtOptions {
  double tolerance_m = std::numeric_limits<double>::quiet_NaN();  ///< NaN: from the map
};

/// Features of the lines of a map, which outlive the lines, and the files that they are of.
struct LineFeatures {
  std::vector<std::int64_t> contours, breaklines;
  std::string contour_file, breakline_file, spot_file;
};

/// Lines that meet at their ends only. Contours of different heights that meet within the tolerance
/// are moved apart in `map`, which the tool is told of; `report` lists the changes. Throws
/// InputError where lines still meet.
[[nodiscard]] CleanLines clean_or_mend(Tool& tool, const TinDoubtOptions& options, ContourMap& map,
                                       Json& report);

/// Contours, breaklines and spot heights, or points, lower than any land.
[[nodiscard]] std::vector<Doubt> doubts_below_land(const ContourMap& map,
                                                   const LineFeatures& features,
                                                   const char* of_points);

/// A height at `place` that differs from those beside it, `low` to `high`.
[[nodiscard]] Doubt height_doubt(const std::string& source, const char* what, const Vec3& place,
                                 double low, double high, bool is_impossible);
/// But for those below all land.
[[nodiscard]] std::vector<Doubt> doubts_of(const std::vector<Outlier>& outliers,
                                           const LineFeatures& features, const Vec3& origin);

}  // namespace talus
