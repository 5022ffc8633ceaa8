// tools/site/new_layers.hpp
// A site.gpkg to begin with: a layer a kind of section, with the fields, forms and styles that a
// GIS edits it by.
#pragma once

#include <string>

#include "tools/frame/tool.hpp"

namespace talus {

struct NewLayers {
  std::string out;     ///< GeoPackage to make; empty: none
  std::string crs_of;  ///< raster or vector file that says the CRS
  std::string source;  ///< polygons that the layer source begins with; empty: none
};
void declare_new_layers(Tool& tool, NewLayers& wanted);

/// Throws InputError: the file says no CRS in metres, the polygons cannot be read.
void make_new_layers(Tool& tool, const NewLayers& wanted);

}  // namespace talus
