// The layers of a GeoPackage and the styles that it holds for them.
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

// Of the fields of each layer, by "layer.field", where the file holds them.
std::map<std::string, std::string> titles_of(GDALDataset& dataset) {
  std::map<std::string, std::string> titles;
  const auto rows = [&dataset](const char* sql, const auto& take) {
    OGRLayer* const found = dataset.ExecuteSQL(sql, nullptr, nullptr);
    if (found == nullptr) return;
    for (const auto& row : found) take(*row);
    dataset.ReleaseResultSet(found);
  };
  bool has_titles = false;
  rows("SELECT name FROM sqlite_master WHERE name = 'gpkg_data_columns'",
       [&](const OGRFeature&) { has_titles = true; });
  if (has_titles)
    rows("SELECT table_name, column_name, title FROM gpkg_data_columns WHERE title IS NOT NULL",
         [&](const OGRFeature& row) {
           titles[std::string(row.GetFieldAsString(0)) + "." + row.GetFieldAsString(1)] =
               row.GetFieldAsString(2);
         });
  return titles;
}

}  // namespace

std::vector<StyledLayer> styled_layers(const std::string& path) {
  register_gdal_drivers();
  const std::unique_ptr<GDALDataset> dataset(
      GDALDataset::Open(path.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY));
  if (!dataset) throw InputError({path}, "cannot be read as a GeoPackage");
  const auto styles = styles_of(*dataset);
  const auto titles = titles_of(*dataset);
  std::vector<StyledLayer> layers;
  for (OGRLayer* layer : dataset->GetLayers()) {
    StyledLayer found{layer->GetName(), shape_of(layer->GetGeomType()), "",
                      layer->GetFeatureCount() == 0};
    if (found.shape == StyledLayer::none) continue;
    if (const char* words = layer->GetMetadataItem("DESCRIPTION")) found.description = words;
    for (int i = 0; i < layer->GetLayerDefn()->GetFieldCount(); ++i) {
      const std::string name = layer->GetLayerDefn()->GetFieldDefn(i)->GetNameRef();
      const auto title = titles.find(found.name + "." + name);
      found.fields.emplace_back(name, title == titles.end() ? name : title->second);
    }
    if (const auto style = styles.find(found.name); style != styles.end())
      found.qml = style->second;
    layers.push_back(std::move(found));
  }
  return layers;
}

}  // namespace talus
