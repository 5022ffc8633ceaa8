// libcore/report/styles_gdal.hpp: public
// The layers of a GeoPackage and the styles that it holds for them.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace talus {

struct StyledLayer {
  std::string name;
  enum Shape { none, point, line, polygon } shape = none;
  std::string qml;  ///< its default style; empty: none
  bool is_empty = false;
  std::string description{};  ///< of the layer, in the file
  /// Name and title of each, without that of the feature's number; no title: its name.
  std::vector<std::pair<std::string, std::string>> fields{};
};

/// Layers with a geometry, in the order of the file. Throws InputError when it cannot be read.
[[nodiscard]] std::vector<StyledLayer> styled_layers(const std::string& path);

}  // namespace talus
