// tools/profile/output.hpp
// Crossings of a line and values along it, as tables, layers, charts, JSON and in words.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "io/geopackage_gdal.hpp"
#include "post/profile/line_result.hpp"
#include "tools/frame/tool.hpp"

namespace talus {

/// All that the outputs are made from.
struct LineProfile {
  LineSums sums;
  AcrossSummary whole;
  std::vector<AcrossSummary> bins;
  std::vector<StationSummary> stations;
  std::vector<std::string> run_ids;  ///<                                              (n_runs)
  Vec3 origin = Vec3::Zero();        ///< map coordinates of the local zero [m]
};

/// How sure the numbers across the line are, by where they come from.
[[nodiscard]] std::string error_text(const LineSums& sums);

/// A row a crossing, a bin, a station (CSV).
[[nodiscard]] std::string crossing_csv(const LineProfile& profile);
[[nodiscard]] std::string bin_csv(const LineProfile& profile);
[[nodiscard]] std::string station_csv(const LineProfile& profile);

/// Layers crossings, line_bins and stations.
[[nodiscard]] std::vector<VectorLayer> profile_layers(const LineProfile& profile);

/// Name of the file without its ending, and the SVG.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> profile_charts(
    const LineProfile& profile);

/// Keys line, across and along.
[[nodiscard]] Json profile_json(const LineProfile& profile);

[[nodiscard]] std::string profile_summary(const LineProfile& profile);

}  // namespace talus
