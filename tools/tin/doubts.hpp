// Heights and meetings of a contour map that need a look: said, written as places, refused.
// in:    a map, its triangulation, what the user accepts
// out:   cleaned lines; warnings, the layer of places; InputError for what cannot be
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "terrain/contours.hpp"
#include "terrain/outliers.hpp"
#include "tools/frame/doubts_layer.hpp"
#include "tools/frame/tool.hpp"

namespace talus {

struct DoubtOptions {
  std::string layer;    ///< file of the places; empty: none
  bool accept = false;  ///< heights that cannot be are taken all the same
  double tolerance_m = std::numeric_limits<double>::quiet_NaN();  ///< NaN: from the map
};

/// Features of the lines of a map, which outlive the lines.
struct LineFeatures {
  std::vector<std::int64_t> contours, breaklines;
};

/// Lines that meet at their ends only. Contours of different heights that meet within the tolerance
/// are moved apart in `map`; rows and `report` say what was done. Throws InputError, after the
/// places were written, where lines still meet.
[[nodiscard]] CleanLines clean_or_mend(Tool& tool, const DoubtOptions& options, ContourMap& map,
                                       std::vector<DoubtRow>& rows, Json& report);

/// Contours, breaklines and spot heights lower than any land.
[[nodiscard]] std::vector<DoubtRow> rows_below_land(const ContourMap& map);

[[nodiscard]] std::vector<DoubtRow> rows_of(const std::vector<Outlier>& outliers,
                                            const LineFeatures& features, const Vec3& origin);

/// Warns of rows in doubt, writes the layer, and gives the rows for the report. Throws InputError
/// naming `source` where a row is refused and not accepted.
[[nodiscard]] Json say_doubts(Tool& tool, const DoubtOptions& options, const std::string& source,
                              const std::string& crs_wkt, std::vector<DoubtRow>& rows);

}  // namespace talus
