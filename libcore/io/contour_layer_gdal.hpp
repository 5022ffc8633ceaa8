// libcore/io/contour_layer_gdal.hpp
// The layer of a vector source that is read, and its parts of one shape.
// in:    a source and what it is read for
// out:   the layer chosen by name or by shape; a call a part. Messages name file, layer and feature
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "base/error.hpp"
#include "base/types.hpp"
#include "io/contour_sources.hpp"

class GDALDataset;
class OGRFeature;
class OGRGeometry;
class OGRLayer;

namespace talus {

enum class LayerShape { line, point, polygon };

/// What a source is read for.
struct LayerRole {
  LayerShape shape;
  const char* name;     ///< of its parts, for messages: "contours"
  const char* options;  ///< how its options begin: "--breaklines-", "source.polygon_"
};

/// A source that is open at one of its layers.
struct OpenLayer {
  std::shared_ptr<GDALDataset> dataset;
  OGRLayer* layer = nullptr;
  LayerRole role;
  bool is_drawing = false;  ///< DXF: one layer holds all sorts of things
  std::string name;         ///< of the layer, for messages
  std::string filter;       ///< set already: the layer of a drawing; empty: none
  // for_each_part
  std::int64_t n_features = 0;
  std::int64_t n_ignored = 0;  ///< parts of a drawing that have another shape
};

/// The layer that is named, else the only one that holds the shape. Throws InputError when the
/// source cannot be opened or has no such layer.
[[nodiscard]] OpenLayer open_layer(const LayerChoice& choice, const LayerRole& role);

[[nodiscard]] Where where_of_layer(const LayerChoice& choice, const OpenLayer& source);
[[nodiscard]] Where where_of_feature(const LayerChoice& choice, const OpenLayer& source,
                                     const OGRFeature& feature);

/// Calls visit(geometry, feature) for every simple part of the wanted shape. Counts features
/// without geometry and refuses them at the end: a truncated file reads without complaint. Other
/// shapes are refused too, but in a drawing, where they are counted. Throws InputError.
void for_each_part(const LayerChoice& choice, OpenLayer& source,
                   const std::function<void(const OGRGeometry&, const OGRFeature&)>& visit);

/// Throws InputError.
void check_finite(const Vec3& point, const Where& where);

}  // namespace talus
