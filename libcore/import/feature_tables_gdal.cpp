// Reads attributes of layers as tables, and digests of their features.
#include "import/feature_tables_gdal.hpp"

#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <memory>

#include "base/error.hpp"
#include "base/sha256.hpp"
#include "base/text.hpp"
#include "import/vector_dataset_gdal.hpp"
#include "io/crs_gdal.hpp"
#include "io/errors_gdal.hpp"

namespace talus {
namespace {

constexpr std::size_t most_rows = 100000;

std::string value_of(const OGRFeature& feature, int index) {
  if (feature.IsFieldSetAndNotNull(index) == 0) return "";
  const OGRFieldDefn& field = *feature.GetFieldDefnRef(index);
  if (field.GetType() == OFTReal) return text(feature.GetFieldAsDouble(index));
  if (field.GetSubType() == OFSTBoolean)
    return feature.GetFieldAsInteger(index) != 0 ? "true" : "false";
  return feature.GetFieldAsString(index);
}

FeatureTable table_of(OGRLayer& layer, const std::string& name, const std::string& path) {
  FeatureTable table{name, {}, {}};
  const OGRFeatureDefn& fields = *layer.GetLayerDefn();
  for (int i = 0; i < fields.GetFieldCount(); ++i)
    table.fields.emplace_back(fields.GetFieldDefn(i)->GetNameRef());
  for (const auto& feature : layer) {
    FeatureTable::Row row{feature->GetFID(), {}};
    for (int i = 0; i < fields.GetFieldCount(); ++i) row.values.push_back(value_of(*feature, i));
    table.rows.push_back(std::move(row));
    if (table.rows.size() > most_rows)
      throw InputError({path, 0, "layer " + table.layer},
                       "has more than " + std::to_string(most_rows) + " features",
                       "a feature is a place: is it the layer that you mean?");
  }
  return table;
}

}  // namespace

std::vector<std::string> layers_of(const std::string& path) {
  const VectorDataset source = open_vectors(parse_source_path(path));
  std::vector<std::string> names;
  for (OGRLayer* const layer : source.dataset->GetLayers()) names.emplace_back(layer->GetName());
  return names;
}

std::vector<FeatureTable> read_feature_tables(const std::string& path,
                                              const std::vector<std::string>& layers) {
  const VectorDataset source = open_vectors(parse_source_path(path));
  std::vector<FeatureTable> tables;
  for (const std::string& name : layers)
    if (OGRLayer* const layer = source.dataset->GetLayerByName(name.c_str()))
      tables.push_back(table_of(*layer, name, path));
  return tables;
}

std::string digest_of_features(const std::string& path, const std::string& layer,
                               const std::string& where,
                               const std::vector<std::string>& attributes) {
  const VectorDataset source = open_vectors(parse_source_path(path));
  OGRLayer* const open = source.dataset->GetLayerByName(layer.c_str());
  if (open == nullptr) throw InputError({path}, "has no layer " + layer);
  if (!where.empty() && open->SetAttributeFilter(where.c_str()) != OGRERR_NONE)
    throw InputError({path, 0, "layer " + layer}, "cannot be filtered by " + where);
  Sha256 hash;
  const std::string crs = wkt_of(open->GetSpatialRef());
  hash.add(crs.c_str(), crs.size() + 1);
  for (const auto& feature : *open) {
    const OGRGeometry* const geometry = feature->GetGeometryRef();
    if (geometry == nullptr) continue;  // readers of the layer report it
    std::vector<unsigned char> bytes(geometry->WkbSize());
    geometry->exportToWkb(wkbNDR, bytes.data(), wkbVariantIso);
    hash.add(bytes.data(), bytes.size());
    for (const std::string& name : attributes) {
      const int field = feature->GetFieldIndex(name.c_str());
      const std::string value = field < 0 ? "" : value_of(*feature, field);
      hash.add(value.c_str(), value.size() + 1);
    }
  }
  return hash.hex();
}

std::string crs_of_source(const std::string& path) {
  register_gdal_drivers();
  const GdalErrors quiet;
  const std::unique_ptr<GDALDataset> raster(
      GDALDataset::Open(parse_source_path(path).source.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY));
  if (raster && raster->GetRasterCount() > 0) return wkt_of(raster->GetSpatialRef());
  const VectorDataset source = open_vectors(parse_source_path(path));
  OGRLayer* const layer = source.dataset->GetLayer(0);
  return layer == nullptr ? "" : wkt_of(layer->GetSpatialRef());
}

}  // namespace talus
