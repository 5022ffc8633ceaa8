// libcore/import/contour_sources.hpp
// What a contour map is read from, and what was found while reading it: plain data.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "import/layer_reading.hpp"

namespace talus {

/// A vector source: "map.gpkg|layername=index,between|subset=ELEV > 900", or an archive. Layers are
/// parted by commas, with * and ? for any letters; without them the only one with fitting
/// geometries is taken. Of a DXF drawing they are the layers of the drawing.
struct LayerChoice {
  std::string path;
  /// Empty: Z where it tells heights apart, else a field by name. "Z", or "geometry.Z" and
  /// "field.Z" where a field has that name.
  std::string elevation_field;
  double unit_m = 0;  ///< metres in one unit of its coordinates; 0: metres, or as a drawing says
};

struct ContourSources {
  LayerChoice contours, breaklines, spots, boundary;  ///< all but contours may have an empty path
  LayerChoice labels;  ///< points with the heights of the contours as text; empty path: none
  /// Metres in one unit of all elevations read; 0: the unit of the source, else height_unit_m().
  double elevation_unit_m = 0;
  bool crs_given = false;    ///< `crs` stands for the CRS of contours that have none
  std::string crs;           ///< WKT; empty: local metres
  std::string t_srs;         ///< WKT to reproject to; empty: the CRS of the contours
  std::string vertical_crs;  ///< what the heights of contours are in that do not say it: WKT of a
                             ///< vertical system, or ellipsoidal_heights
  std::string t_vertical;    ///< WKT of the vertical system to take all heights to; empty: none
  bool accept_ballpark = false;  ///< reproject though nothing is known of the datum
};

/// What was found while reading; `notes` are sentences for the user.
struct ContourReading {
  std::string layer;            ///< of the contours
  std::string elevation_from;   ///< "Z" or "field ELEV"
  std::int64_t n_features = 0;  ///< of the contours
  std::vector<std::string> notes;
  std::vector<std::string> operations;  ///< sentences: how places and heights were taken over
  std::vector<std::string> warnings;    ///< places beside their CRS, better operations without grid
  /// What was taken, of each source; without a file: none was given.
  LayerReading contours, labels, breaklines, spots, boundary;
};

}  // namespace talus
