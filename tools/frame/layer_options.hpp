// tools/frame/layer_options.hpp
// The options that say which layer and which features of a vector source are taken.
#pragma once

#include <string>

#include "io/contours_gdal.hpp"
#include "tools/frame/options.hpp"

namespace talus {

/// The options LAYER and WHERE of a vector source whose options begin with `prefix` ("--spots-").
inline void add_layer_options(Tool& tool, const std::string& prefix, const std::string& of,
                              LayerChoice& choice) {
  tool.option(prefix + "layer", choice.layer,
              "layer of " + of + ", again for each further one; empty: the only one that fits")
      ->join();
  tool.option(prefix + "where", choice.where, "filter on " + of + ", e.g. \"ELEV > 900\"");
}

}  // namespace talus
