#include "report/styles_gdal.hpp"

#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <map>
#include <memory>

#include "base/error.hpp"
#include "io/errors_gdal.hpp"

namespace talus {
namespace {

StyledLayer::Shape shape_of(OGRwkbGeometryType type) {
  switch (wkbFlatten(type)) {
    case wkbPoint:
    case wkbMultiPoint:
      return StyledLayer::point;
    case wkbLineString:
    case wkbMultiLineString:
      return StyledLayer::line;
    case wkbPolygon:
    case wkbMultiPolygon:
      return StyledLayer::polygon;
    default:
      return StyledLayer::none;
  }
}

// Table of QGIS: f_table_name -> styleQML.
std::map<std::string, std::string> styles_of(GDALDataset& dataset) {
  std::map<std::string, std::string> styles;
  OGRLayer* const table = dataset.GetLayerByName("layer_styles");
  if (table == nullptr) return styles;
  for (const auto& row : table) {
    const int name = row->GetFieldIndex("f_table_name"), qml = row->GetFieldIndex("styleQML");
    if (name >= 0 && qml >= 0) styles[row->GetFieldAsString(name)] = row->GetFieldAsString(qml);
  }
  return styles;
}

// Of the fields of a layer.
std::map<std::string, std::string> titles_of(GDALDataset& dataset, const std::string& layer) {
  std::map<std::string, std::string> titles;
  OGRLayer* const table = dataset.GetLayerByName("gpkg_data_columns");
  if (table == nullptr) return titles;
  table->ResetReading();
  for (const auto& row : table) {
    const auto text = [&row](const char* name) -> std::string {
      const int i = row->GetFieldIndex(name);
      return i < 0 ? "" : row->GetFieldAsString(i);
    };
    if (text("table_name") == layer) titles[text("column_name")] = text("title");
  }
  return titles;
}

}  // namespace

std::vector<StyledLayer> styled_layers(const std::string& path) {
  register_gdal_drivers();
  const std::unique_ptr<GDALDataset> dataset(
      GDALDataset::Open(path.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY));
  if (!dataset) throw InputError({path}, "cannot be read as a GeoPackage");
  const auto styles = styles_of(*dataset);
  std::vector<StyledLayer> layers;
  for (OGRLayer* layer : dataset->GetLayers()) {
    StyledLayer found{layer->GetName(), shape_of(layer->GetGeomType()), "",
                      layer->GetFeatureCount() == 0};
    if (found.shape == StyledLayer::none) continue;
    if (const char* words = layer->GetMetadataItem("DESCRIPTION")) found.description = words;
    std::map<std::string, std::string> titles = titles_of(*dataset, found.name);
    for (int i = 0; i < layer->GetLayerDefn()->GetFieldCount(); ++i) {
      const std::string name = layer->GetLayerDefn()->GetFieldDefn(i)->GetNameRef();
      const std::string& title = titles[name];
      found.fields.emplace_back(name, title.empty() ? name : title);
    }
    if (const auto style = styles.find(found.name); style != styles.end())
      found.qml = style->second;
    layers.push_back(std::move(found));
  }
  return layers;
}

}  // namespace talus
