// tools/trace/layers.hpp
// Objects, source cells and links as layers, rasters and rows.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/geopackage_gdal.hpp"
#include "io/style.hpp"
#include "post/hazard/risk.hpp"
#include "post/trace/trace.hpp"
#include "terrain/trn.hpp"

namespace talus {

/// An object with all that is said of it.
struct TracedObject {
  ObjectTrace trace;
  double rate = 0, rate_low = 0, rate_high = 0;  ///< events a year; NaN: no frequency [1/a]
  std::optional<ObjectRisk> risk;                ///< by a recipe of risk
};

/// Layers objects, links, source_cells. Objects have the colours of their classes of risk.
[[nodiscard]] std::vector<VectorLayer> trace_layers(const TraceSums& sums,
                                                    const std::vector<TracedObject>& objects,
                                                    const std::vector<SourceLink>& links,
                                                    const Trn& trn, const Recipe& recipe);

/// p_hit, share_of_hits and n_released over the source cells.
[[nodiscard]] MapLayer source_layer(const TraceSums& sums, int object,
                                    const std::vector<SourceLink>& links);
[[nodiscard]] RasterStyle source_style(const std::string& object, const std::string& remark);

/// One row a link.
[[nodiscard]] std::string link_csv(const TraceSums& sums, const std::vector<SourceLink>& links,
                                   const Vec3& origin);

}  // namespace talus
