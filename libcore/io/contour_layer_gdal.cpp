#include "io/contour_layer_gdal.hpp"

#include <ogrsf_frmts.h>

#include <vector>

#include "base/text.hpp"
#include "io/errors_gdal.hpp"

namespace talus {
namespace {

const char* plural(LayerShape shape) {
  return shape == LayerShape::line ? "lines" : shape == LayerShape::point ? "points" : "polygons";
}

GDALDatasetUniquePtr open_vectors(const std::string& path) {
  register_gdal_drivers();
  const GdalErrors errors;
  GDALDatasetUniquePtr dataset(
      GDALDataset::Open(path.c_str(), GDAL_OF_VECTOR | GDAL_OF_VERBOSE_ERROR));
  if (dataset) return dataset;
  throw InputError(
      {path},
      "cannot be opened as vectors" + (errors.failed() ? ": " + errors.failure() : std::string()),
      "ogrinfo " + path + " shows what GDAL makes of it");
}

bool fits(OGRwkbGeometryType type, LayerShape shape) {
  const OGRwkbGeometryType flat = OGR_GT_GetLinear(wkbFlatten(type));
  switch (shape) {
    case LayerShape::line:
      return flat == wkbLineString || flat == wkbMultiLineString;
    case LayerShape::point:
      return flat == wkbPoint || flat == wkbMultiPoint;
    default:
      return flat == wkbPolygon || flat == wkbMultiPolygon;
  }
}

// Whether the geometry is of the shape, or a collection with a part that is.
bool has_part(const OGRGeometry& geometry, LayerShape shape) {
  const OGRwkbGeometryType type = wkbFlatten(geometry.getGeometryType());
  if (fits(type, shape)) return true;
  if (type != wkbGeometryCollection) return false;
  for (const OGRGeometry* part : *geometry.toGeometryCollection())
    if (has_part(*part, shape)) return true;
  return false;
}

// Whether the layer is declared to hold the shape. One that may hold anything is looked through: a
// first feature of another shape says nothing of those behind it.
bool holds(OGRLayer& layer, LayerShape shape) {
  const OGRwkbGeometryType type = wkbFlatten(layer.GetGeomType());
  if (type == wkbNone) return false;
  if (type != wkbUnknown && type != wkbGeometryCollection) return fits(type, shape);
  layer.ResetReading();
  bool found = false;
  for (const auto& feature : layer) {
    const OGRGeometry* geometry = feature->GetGeometryRef();
    found = geometry != nullptr && has_part(*geometry, shape);
    if (found) break;
  }
  layer.ResetReading();
  return found;
}

std::string list_of_layers(GDALDataset& dataset) {
  std::string names;
  for (OGRLayer* layer : dataset.GetLayers())
    names += (names.empty() ? "" : ", ") + std::string(layer->GetName());
  return names.empty() ? "none" : names;
}

std::string quoted(const std::string& text) {
  std::string escaped;
  for (const char c : text) escaped += c == '\'' ? "''" : std::string(1, c);
  return "'" + escaped + "'";
}

void choose_by_name(const LayerChoice& choice, OpenLayer& source) {
  source.layer = source.dataset->GetLayerByName(choice.layer.c_str());
  source.name = choice.layer;
  if (source.layer != nullptr) return;
  if (source.is_drawing) {
    source.layer = source.dataset->GetLayer(0);
    source.filter = "Layer = " + quoted(choice.layer);
    source.layer->SetAttributeFilter(source.filter.c_str());
    if (source.layer->GetFeatureCount() > 0) return;
    throw InputError({choice.path}, "the drawing has nothing in a layer \"" + choice.layer + "\"",
                     "ogrinfo -al " + choice.path + " shows the layers as attribute Layer");
  }
  throw InputError({choice.path}, "there is no layer \"" + choice.layer +
                                      "\"; there are: " + list_of_layers(*source.dataset));
}

void choose_by_shape(const LayerChoice& choice, OpenLayer& source) {
  const LayerShape shape = source.role.shape;
  std::vector<OGRLayer*> fitting;
  if (source.dataset->GetLayerCount() == 1)
    fitting.push_back(source.dataset->GetLayer(0));  // its features say what is wrong
  else
    for (OGRLayer* layer : source.dataset->GetLayers())
      if (holds(*layer, shape)) fitting.push_back(layer);
  if (fitting.size() != 1)
    throw InputError({choice.path},
                     std::to_string(fitting.size()) + " layers hold " + plural(shape) +
                         ", expected one; the layers are: " + list_of_layers(*source.dataset),
                     "choose with " + std::string(source.role.options) + "layer");
  source.layer = fitting.front();
  source.name = source.layer->GetName();
}

}  // namespace

OpenLayer open_layer(const LayerChoice& choice, const LayerRole& role) {
  OpenLayer source;
  source.role = role;
  source.dataset = open_vectors(choice.path);
  source.is_drawing = std::string(source.dataset->GetDriverName()) == "DXF";
  if (choice.layer.empty())
    choose_by_shape(choice, source);
  else
    choose_by_name(choice, source);
  return source;
}

Where where_of_layer(const LayerChoice& choice, const OpenLayer& source) {
  return {choice.path, 0, "layer " + source.name};
}

Where where_of_feature(const LayerChoice& choice, const OpenLayer& source,
                       const OGRFeature& feature) {
  return {choice.path, 0, "layer " + source.name + ", feature " + std::to_string(feature.GetFID())};
}

void for_each_part(const LayerChoice& choice, OpenLayer& source,
                   const std::function<void(const OGRGeometry&, const OGRFeature&)>& visit) {
  const GdalErrors errors;
  const LayerShape shape = source.role.shape;
  std::int64_t n_null = 0;
  source.n_features = source.n_ignored = 0;
  const std::function<void(const OGRGeometry&, const OGRFeature&)> descend =
      [&](const OGRGeometry& geometry, const OGRFeature& feature) {
        const OGRwkbGeometryType type = wkbFlatten(geometry.getGeometryType());
        if (OGR_GT_IsSubClassOf(type, wkbGeometryCollection)) {
          for (const OGRGeometry* part : *geometry.toGeometryCollection()) descend(*part, feature);
        } else if (fits(type, shape)) {
          visit(geometry, feature);
        } else if (source.is_drawing) {
          ++source.n_ignored;
        } else {
          throw InputError(where_of_feature(choice, source, feature),
                           std::string("the geometry is ") + geometry.getGeometryName() +
                               ", expected " + plural(shape),
                           type == wkbPoint && shape == LayerShape::line
                               ? "--points makes a TIN of points of the ground"
                               : "");
        }
      };
  source.layer->ResetReading();
  for (const auto& feature : *source.layer) {
    ++source.n_features;
    const OGRGeometry* geometry = feature->GetGeometryRef();
    if (geometry == nullptr || geometry->IsEmpty()) {
      ++n_null;
      continue;
    }
    const std::unique_ptr<OGRGeometry> linear(geometry->getLinearGeometry());
    descend(*linear, *feature);
  }
  const Where where = where_of_layer(choice, source);
  if (source.n_features == 0)
    throw InputError(where, "the layer is empty, expected " + std::string(plural(shape)));
  if (n_null > 0)
    throw InputError(where,
                     std::to_string(n_null) + " of " + std::to_string(source.n_features) +
                         " features have no geometry, expected none: is the file truncated?",
                     "copy the file anew; features that are meant to be empty must be deleted");
  if (errors.failed()) throw InputError(where, "reading failed: " + errors.failure());
}

void check_finite(const Vec3& point, const Where& where) {
  if (point.allFinite()) return;
  throw InputError(where, "a coordinate is not finite (x " + text(point.x()) + ", y " +
                              text(point.y()) + ", z " + text(point.z()) + ")");
}

}  // namespace talus
