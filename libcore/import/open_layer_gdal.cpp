// Opens the layers of a vector source by name or by shape.
#include "import/open_layer_gdal.hpp"

#include <ogrsf_frmts.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/text.hpp"
#include "base/words.hpp"
#include "import/layer_names.hpp"
#include "import/layer_shapes_gdal.hpp"
#include "import/vector_dataset_gdal.hpp"
#include "io/crs_gdal.hpp"
#include "io/errors_gdal.hpp"

namespace talus {
namespace {

// --- shapes --------------------------------------------------------------------------------------

// Whether a test holds for the geometry or for a part of it.
bool any_part(const OGRGeometry& geometry, const std::function<bool(const OGRGeometry&)>& test) {
  if (!OGR_GT_IsSubClassOf(wkbFlatten(geometry.getGeometryType()), wkbGeometryCollection))
    return test(geometry);
  for (const OGRGeometry* part : *geometry.toGeometryCollection())
    if (any_part(*part, test)) return true;
  return false;
}

bool any_feature(OGRLayer& layer, const std::function<bool(const OGRGeometry&)>& test) {
  layer.ResetReading();
  bool found = false;
  for (const auto& feature : layer) {
    const OGRGeometry* geometry = feature->GetGeometryRef();
    found = geometry != nullptr && any_part(*geometry, test);
    if (found) break;
  }
  layer.ResetReading();
  return found;
}

// Whether the layer is declared to hold the shape. One that may hold anything is looked through: a
// first feature of another shape says nothing of those behind it.
bool holds(OGRLayer& layer, LayerShape shape) {
  const OGRwkbGeometryType type = wkbFlatten(layer.GetGeomType());
  if (type == wkbNone) return false;
  if (type != wkbUnknown && type != wkbGeometryCollection) return fits(layer.GetGeomType(), shape);
  return any_feature(
      layer, [shape](const OGRGeometry& part) { return fits(part.getGeometryType(), shape); });
}

bool holds_closed_line(OGRLayer& layer) {
  if (!holds(layer, LayerShape::line)) return false;
  return any_feature(layer, [](const OGRGeometry& part) {
    const std::unique_ptr<OGRGeometry> line(part.getLinearGeometry());
    return wkbFlatten(line->getGeometryType()) == wkbLineString && is_closed(*line->toLineString());
  });
}

// --- layers by name ------------------------------------------------------------------------------

std::vector<std::string> layer_names(GDALDataset& dataset) {
  std::vector<std::string> names;
  for (OGRLayer* layer : dataset.GetLayers()) names.emplace_back(layer->GetName());
  return names;
}

// The layers of a database that one word names: a layer, a pattern, or several parted by commas.
std::vector<OGRLayer*> layers_named(const std::string& word, const OpenLayer& source) {
  if (OGRLayer* layer = source.dataset->GetLayerByName(word.c_str())) return {layer};
  std::vector<OGRLayer*> found;
  if (word.find(',') != std::string::npos) {
    for (const std::string& part : parted(word, ',')) {
      const std::vector<OGRLayer*> named = layers_named(part, source);
      if (named.empty()) return {};
      found.insert(found.end(), named.begin(), named.end());
    }
    return found;
  }
  if (is_pattern(word))
    for (OGRLayer* layer : source.dataset->GetLayers())
      if (matches(word, layer->GetName()) && holds(*layer, source.role.shape))
        found.push_back(layer);
  return found;
}

void choose_by_name(const std::string& names, OpenLayer& source) {
  for (OGRLayer* layer : layers_named(names, source))
    if (std::find(source.layers.begin(), source.layers.end(), layer) == source.layers.end())
      source.layers.push_back(layer);
  if (source.is_drawing) {  // "*": the whole drawing, by its name in GDAL
    source.wanted = {source.layers.empty() ? names : "*"};
    source.layers = {source.dataset->GetLayer(0)};
  } else if (source.layers.empty()) {
    throw InputError({source.ref.path}, "there is no layer \"" + names + "\"; there are: " +
                                            list_of(layer_names(*source.dataset)));
  }
}

void choose_by_number(const std::string& number, OpenLayer& source) {
  double value = -1;
  const int n = source.dataset->GetLayerCount();
  if (!parse_double(number, value) || value < 0 || value >= n || value != std::floor(value))
    throw InputError({source.ref.path},
                     "there is no layer with the number " + number +
                         "; the layers are: " + list_of(layer_names(*source.dataset)));
  source.layers = {source.dataset->GetLayer(static_cast<int>(value))};
}

void choose_by_shape(OpenLayer& source) {
  const LayerShape shape = source.role.shape;
  const auto take_if = [&source](const std::function<bool(OGRLayer&)>& test) {
    for (OGRLayer* layer : source.dataset->GetLayers())
      if (test(*layer)) source.layers.push_back(layer);
  };
  if (source.dataset->GetLayerCount() == 1)
    source.layers.push_back(source.dataset->GetLayer(0));  // its features show the fault
  else
    take_if([shape](OGRLayer& layer) { return holds(layer, shape); });
  if (source.layers.empty() && shape == LayerShape::polygon) take_if(holds_closed_line);
  if (source.layers.size() == 1) return;
  std::vector<std::string> fitting;
  std::string sizes;
  for (OGRLayer* layer : source.layers) {
    fitting.emplace_back(layer->GetName());
    sizes += (sizes.empty() ? ". " : ", ") + fitting.back() + ": " +
             counted(layer->GetFeatureCount(), "feature");
    OGREnvelope e;
    if (layer->GetExtent(&e) == OGRERR_NONE)
      sizes += " over " + text(e.MaxX - e.MinX, 4) + " by " + text(e.MaxY - e.MinY, 4);
  }
  throw InputError({source.ref.path},
                   std::to_string(fitting.size()) + " layers hold " + plural(shape) +
                       ", expected one; the layers are: " + list_of(layer_names(*source.dataset)) +
                       sizes,
                   hint_to_choose(fitting));
}

// --- opening -------------------------------------------------------------------------------------

void set_filter(OpenLayer& source) {
  if (source.filter.empty()) return;
  for (OGRLayer* layer : source.layers) {
    const GdalErrors errors;
    if (layer->SetAttributeFilter(source.filter.c_str()) == OGRERR_NONE) continue;
    throw InputError({source.ref.path, 0, std::string("layer ") + layer->GetName()},
                     "the filter \"" + source.filter + "\" cannot be used: " + errors.failure());
  }
}

void check_one_crs(const OpenLayer& source) {
  const std::string first = wkt_of(source.layer->GetSpatialRef());
  for (OGRLayer* layer : source.layers) {
    const std::string other = wkt_of(layer->GetSpatialRef());
    if (same_crs(first, other) && same_heights(first, other)) continue;
    throw InputError({source.ref.path},
                     std::string("the CRS of layer ") + source.layer->GetName() + " is " +
                         crs_name(first) + ", that of layer " + layer->GetName() + " is " +
                         crs_name(other) + ", expected one CRS",
                     "bring the layers to one CRS first");
  }
}

void find_drawing_field(OpenLayer& source) {
  const std::string driver = source.dataset->GetDriverName();
  if (driver == "DXF") source.drawing_field = "Layer";
  if (driver == "DGN") source.drawing_field = "Level";
  source.is_drawing = !source.drawing_field.empty();
}

}  // namespace

LayerRole role_of(InputRole role) {
  switch (role) {
    case InputRole::contours:
      return {LayerShape::line, "contours", "contours", HeightsOf::level_lines};
    case InputRole::points:
      return {LayerShape::point, "points", "contours", HeightsOf::points};
    case InputRole::labels:
      return {LayerShape::point, "labels", "labels", HeightsOf::nothing, true};
    case InputRole::breaklines:
      return {LayerShape::line, "breaklines", "breaklines", HeightsOf::points};
    case InputRole::spots:
      return {LayerShape::point, "spot heights", "spots", HeightsOf::points};
    case InputRole::boundary:
      return {LayerShape::polygon, "boundary", "boundary"};
    case InputRole::reference:
      return {LayerShape::point, "points", "reference", HeightsOf::points};
    case InputRole::site_points:
      return {LayerShape::point, "points"};
    case InputRole::site_lines:
      return {LayerShape::line, "lines"};
    case InputRole::site_areas:
      break;
  }
  return {LayerShape::polygon, "polygons"};
}

std::string option_words(const LayerRole& role, const std::string& option) {
  const std::string input = role.input;
  return option + " " + (input == "contours" || input == "reference" ? "" : input + "=");
}

OpenLayer open_layer(const LayerRef& ref, const LayerRole& role) {
  const SourcePath path = parse_source_path(ref.path);
  OpenLayer source;
  source.ref = ref;
  source.role = role;
  VectorDataset opened = open_vectors(path);
  source.dataset = opened.dataset;
  source.remarks = std::move(opened.remarks);
  source.is_y_first = opened.is_y_first;
  source.filter = path.subset;
  find_drawing_field(source);
  if (!path.layer.empty())
    choose_by_name(path.layer, source);
  else if (!path.layer_id.empty())
    choose_by_number(path.layer_id, source);
  else
    choose_by_shape(source);
  source.layer = source.layers.front();
  check_one_crs(source);
  set_filter(source);
  std::vector<std::string> taken;
  for (OGRLayer* layer : source.layers) taken.emplace_back(layer->GetName());
  source.name = list_of(source.wanted.empty() ? taken : source.wanted);
  return source;
}

}  // namespace talus
