// libcore/import/open_layer_gdal.hpp
// The layers of a vector source that are read, and their parts of one shape.
// in:    a source and the purpose of reading it
// out:   layers chosen by name or by shape; a call a part. Messages name file, layer and feature
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/types.hpp"
#include "import/layer_reading.hpp"
#include "import/layer_shapes_gdal.hpp"
#include "import/request.hpp"

class GDALDataset;
class OGRFeature;
class OGRGeometry;
class OGRLayer;

namespace talus {

/// Heights of a layer: not needed, one a line, or one a point.
enum class HeightsOf { nothing, level_lines, points };

/// Purpose of reading a source.
struct LayerRole {
  LayerShape shape;
  const char* name;        ///< of its parts, for messages: "contours"
  const char* input = "";  ///< that options are for: "contours", "spots"; empty: none is
  HeightsOf heights = HeightsOf::nothing;
  bool is_of_texts = false;  ///< of a drawing its texts are read, else all but texts
};

[[nodiscard]] LayerRole role_of(InputRole role);

/// A source that is open at one or more of its layers.
struct OpenLayer {
  LayerRef ref;
  std::shared_ptr<GDALDataset> dataset;
  std::vector<OGRLayer*> layers;  ///< one at least, all in one CRS
  OGRLayer* layer = nullptr;      ///< the first of them
  LayerRole role;
  std::string name;    ///< of the layers, for messages: "index, intermediate"
  std::string filter;  ///< in effect; empty: none
  bool is_drawing = false;
  bool is_y_first = false;  ///< a table whose columns are called y and x, in this order
  /// DXF, DGN: the one OGR layer holds all of the drawing's layers, whose names are in a field.
  std::string drawing_field;
  std::vector<std::string> wanted;  ///< of those; empty: the only one that holds the shape
  std::vector<std::string> remarks;

  // for_each_part
  std::size_t current = 0;  ///< of `layers`, while a part is visited
  std::int64_t n_features = 0;
  std::int64_t n_parts = 0;
  std::map<std::string, std::int64_t> passed_over;  ///< parts of another kind, "open line" -> 2
  std::int64_t n_closed_lines = 0;                  ///< that are areas
  std::int64_t n_curves = 0;                        ///< stroked to lines
  std::int64_t n_splines = 0;                       ///< of a drawing: GDAL reads no Z of them
  std::map<std::string, std::int64_t> parts_of;     ///< layer -> parts of the shape
};

/// The beginning of an option that says something of the source: "--unit-m ", "--unit-m spots=".
[[nodiscard]] std::string option_words(const LayerRole& role, const std::string& option);

/// The layers that are named, else the only one that holds the shape. Throws InputError when the
/// source cannot be opened, has no such layer, or has several that may be meant.
[[nodiscard]] OpenLayer open_layer(const LayerRef& ref, const LayerRole& role);

[[nodiscard]] Where where_of_layer(const OpenLayer& source);
[[nodiscard]] Where where_of_feature(const OpenLayer& source, const OGRFeature& feature);

/// Calls visit(geometry, feature) for every simple part of the wanted shape: lines, points, or
/// polygons; closed lines are polygons where nothing else is, and in a drawing always. Other parts
/// are counted. Throws InputError at the end for features without geometry (a truncated file reads
/// without complaint), for nothing of the shape, for a named layer without any, and for a drawing
/// of which several layers may be meant.
void for_each_part(OpenLayer& source,
                   const std::function<void(const OGRGeometry&, const OGRFeature&)>& visit);

/// Findings of for_each_part().
[[nodiscard]] LayerReading reading_of(const OpenLayer& source);

/// Sentences on its filter, its remarks and the features passed over.
void add_remarks(const LayerReading& taken, std::vector<std::string>& notes);

/// Throws InputError.
void check_finite(const Vec3& point, const Where& where);

}  // namespace talus
