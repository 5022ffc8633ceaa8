// tools/runout/layers.hpp
// How far runs came, as layers of the GeoPackage that talus-runout writes, with their styles.
// Attributes: docs/reference/formats.md#run-out
#pragma once

#include <vector>

#include "io/geopackage_gdal.hpp"
#include "post/runout/runout_runs.hpp"

namespace talus {

/// envelope, deposit, paths, path_points, impacts, streamline, reach_points and runs, in this
/// order. `origin`: map coordinates of the local origin [m]; `tolerance`: of the simplified paths
/// [m].
[[nodiscard]] std::vector<VectorLayer> runout_layers(const RunoutRuns& all, const Vec3& origin,
                                                     double tolerance);

}  // namespace talus
