// tools/runout/trees.hpp
// Hit trees of runs, as layers of the GeoPackage and as JSON. Attributes:
// docs/reference/formats.md#run-out
#pragma once

#include <string>
#include <vector>

#include "io/geopackage_gdal.hpp"
#include "post/runout/tree_summary.hpp"
#include "tools/frame/tool.hpp"

namespace talus {

/// trees_hit, a point a stem over all runs, and tree_hits, a point a block and stem that it
/// touched. `run_ids`: of the runs. `origin`: map coordinates of the local origin [m].
[[nodiscard]] std::vector<VectorLayer> tree_layers(const std::vector<RunTrees>& runs,
                                                   const std::vector<std::string>& run_ids,
                                                   const Vec3& origin);

[[nodiscard]] Json trees_json(const TreeSummary& trees, const Vec3& origin);

}  // namespace talus
