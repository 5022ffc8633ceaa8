// tools/fence/layers.hpp
// Results at fences as layers of the GeoPackage that talus-fence writes, with their styles.
// Attributes: docs/reference/formats.md#fence
#pragma once

#include <vector>

#include "io/geopackage_gdal.hpp"
#include "post/fence/dam_result.hpp"

namespace talus {

/// fences, fence_fields, fence_posts and fence_arrivals, in this order. `origin`: map coordinates
/// of the local origin [m].
[[nodiscard]] std::vector<VectorLayer> fence_layers(const std::vector<FenceCase>& fences,
                                                    const std::vector<FenceResult>& results,
                                                    const std::vector<FenceCase>& lines,
                                                    const FenceRunGroup& group, const Vec3& origin);

/// Crests of dams with their verdicts.
[[nodiscard]] VectorLayer dam_layer(const std::vector<DamCase>& dams,
                                    const std::vector<DamResult>& results,
                                    const std::vector<Fence>& crests, const Vec3& origin);

}  // namespace talus
