// libcore/io/contours_gdal.hpp
// Contour maps from any vector source that OGR reads (GeoPackage, Shapefile, GeoJSON, GML, DXF
// ...), with breaklines, spot heights and a boundary; all in one projected CRS in metres.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "terrain/contours.hpp"

namespace talus {

/// A vector source and one of its layers; an empty layer means the only one with fitting
/// geometries. In a DXF drawing the layer may also be a layer of the drawing.
struct LayerChoice {
  std::string path;
  std::string layer;
  std::string elevation_field;  ///< empty: Z where it tells heights apart, else a field by name
};

struct ContourSources {
  LayerChoice contours, breaklines, spots, boundary;  ///< all but contours may have an empty path
  LayerChoice labels;  ///< points with the heights of the contours as text; empty path: none
  double elevation_unit_m = 1;                        ///< metres in one unit of all elevations read
  bool crs_given = false;  ///< `crs` stands for the CRS of contours that have none
  std::string crs;         ///< WKT; empty: local metres
  std::string t_srs;       ///< WKT to reproject to; empty: the CRS of the contours
};

/// What was found while reading; `notes` are sentences for the user.
struct ContourReading {
  std::string layer;            ///< of the contours
  std::string elevation_from;   ///< "Z" or "field ELEV"
  std::int64_t n_features = 0;  ///< of the contours
  std::int64_t n_ignored = 0;   ///< parts of the drawing of the contours that are no lines
  std::vector<std::string> notes;
};

/// Reads everything, reprojects breaklines, spot heights and boundary to the CRS of the contours,
/// and puts the origin at the lower left corner, floored to 100 m (z: 0). Throws InputError where
/// anything is missing or cannot be true: see docs/tools/talus-tin.md.
[[nodiscard]] ContourMap read_contours(const ContourSources& sources, ContourReading& reading);

/// Points of the ground (`sources.contours`: a vector layer of points, or text, point_text.hpp) as
/// spots of a map without contours, with a boundary; CRS, units and origin as read_contours does.
/// Throws InputError; laser scans are refused with the command that makes text of them.
[[nodiscard]] ContourMap read_ground_points(const ContourSources& sources, ContourReading& reading);

/// Points with a height in map coordinates, in `crs_wkt` [m]: what a terrain is held against. What
/// was found goes to `notes`; a missing CRS, of the source or in `crs_wkt`, means the same one.
/// Throws InputError as read_contours does for spot heights.
[[nodiscard]] std::vector<Vec3> read_points(const LayerChoice& choice, const std::string& crs_wkt,
                                            std::vector<std::string>& notes);

/// Writes points as a GeoPackage with one 3-D layer. `points` relative to `origin` [m].
/// Throws InputError when the file cannot be written.
void write_points(const std::string& path, const std::string& layer, const std::string& crs_wkt,
                  const Vec3& origin, const std::vector<Vec3>& points);

}  // namespace talus
