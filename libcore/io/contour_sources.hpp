// libcore/io/contour_sources.hpp
// What a contour map is read from, and what was found while reading it: plain data.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

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

}  // namespace talus
