// tools/frame/failure_outlines.hpp
// Planes and wedges that a mass could leave on, as areas in plan of the mass that would go with
// each.
#pragma once

#include <string>
#include <vector>

#include "io/geopackage_gdal.hpp"
#include "setup/source_work.hpp"
#include "tools/frame/tool.hpp"

namespace talus {

using Polygons = std::vector<std::vector<std::vector<Vec2>>>;

/// Parts of the outline that hold less of the volume than this are left out, and named.
inline constexpr double least_part = 0.05;

struct OutlinedSurface {
  bool is_wedge = false;
  std::string sets;       ///< "sliding", "sliding + rear"
  Attitude fall;          ///< dip and dip direction; of a wedge plunge and trend
  double free_share = 0;  ///< of the foot, that it comes out along
  double volume = 0;      ///< of the polygons below [m3]
  Polygons polygons;      ///< local [m]
  int n_left_out = 0;     ///< parts that are too small
  double volume_left_out = 0;
  bool is_taken = false;  ///< by failure_surface = "daylighting"
};

/// Of each plane and wedge of `work` that a mass can leave on; after find_planes() and
/// find_wedges(). None for those without a volume.
[[nodiscard]] std::vector<OutlinedSurface> outlined_surfaces(const BlocksWork& work);

/// The same plane through another point, as of PlaneAtShare.
[[nodiscard]] OutlinedSurface outlined_plane(const BlocksWork& work, const FailurePlane& plane,
                                             const Vec3& point, double free_share);

/// "sliding + rear, 2,400 m3, free along 92 % of the foot"
[[nodiscard]] std::string title_of(const OutlinedSurface& surface);

/// In map coordinates; `polygons` as GeoJSON has the coordinates of a MultiPolygon.
[[nodiscard]] Json outline_json(const OutlinedSurface& surface, const Vec3& origin);
[[nodiscard]] VectorLayer outline_layer(const std::vector<OutlinedSurface>& surfaces,
                                        const Vec3& origin);

}  // namespace talus
