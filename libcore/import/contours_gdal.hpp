// libcore/import/contours_gdal.hpp: public
// Contour maps from any vector source that OGR reads (GeoPackage, Shapefile, GeoJSON, GML, DXF
// ...), with breaklines, spot heights and a boundary; all in one projected CRS in metres.
#pragma once

#include <string>
#include <vector>

#include "import/contour_sources.hpp"
#include "terrain/contours.hpp"

namespace talus {

/// Reads everything, reprojects breaklines, spot heights and boundary to the CRS of the contours,
/// and puts the origin at the lower left corner, floored to 100 m (z: 0). Throws InputError where
/// anything is missing or cannot be true: see docs/tools/talus-tin.md.
[[nodiscard]] ContourMap read_contours(const ContourSources& sources, ContourReading& reading);

/// Points of the ground (`sources.contours`: a vector layer of points, or text, point_text.hpp) as
/// spots of a map without contours, with a boundary; CRS, units and origin as read_contours does.
/// Throws InputError; laser scans are refused with the command that makes text of them.
[[nodiscard]] ContourMap read_ground_points(const ContourSources& sources, ContourReading& reading);

/// Points with a height in map coordinates, in `crs_wkt` [m]: what a terrain is held against. What
/// was found goes to `notes` and `taken`; a missing CRS, of the source or in `crs_wkt`, means the
/// same one. Throws InputError as read_contours does for spot heights.
[[nodiscard]] std::vector<Vec3> read_points(const LayerChoice& choice, const std::string& crs_wkt,
                                            std::vector<std::string>& notes, LayerReading& taken);

/// Writes points as a GeoPackage with one 3-D layer. `points` relative to `origin` [m].
/// Throws InputError when the file cannot be written.
void write_points(const std::string& path, const std::string& layer, const std::string& crs_wkt,
                  const Vec3& origin, const std::vector<Vec3>& points);

}  // namespace talus
