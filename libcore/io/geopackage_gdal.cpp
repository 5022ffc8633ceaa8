// Writes features as layers of a GeoPackage, each with its style for QGIS.
#include "io/geopackage_gdal.hpp"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <cmath>
#include <memory>

#include "base/error.hpp"
#include "base/printable.hpp"
#include "io/errors_gdal.hpp"
#include "io/polygons_gdal.hpp"

namespace talus {
namespace {

// In the order of GeometryType.
constexpr OGRwkbGeometryType ogr_types[] = {wkbPoint,        wkbPoint25D,      wkbMultiPoint25D,
                                            wkbLineString,   wkbLineString25D, wkbLineStringZM,
                                            wkbMultiPolygon, wkbPolygon,       wkbNone};

OGRwkbGeometryType ogr_type(GeometryType type) { return ogr_types[static_cast<int>(type)]; }

OGRPoint point_of(const VectorFeature& feature, std::size_t i, OGRwkbGeometryType type) {
  const Vec3& p = feature.points.at(i);
  if (OGR_GT_HasM(type) != 0)
    return {p.x(), p.y(), p.z(), feature.measure.empty() ? 0 : feature.measure[i]};
  return OGR_GT_HasZ(type) != 0 ? OGRPoint(p.x(), p.y(), p.z()) : OGRPoint(p.x(), p.y());
}

std::unique_ptr<OGRGeometry> multi_polygon_of(const VectorFeature& feature) {
  auto multi = std::make_unique<OGRMultiPolygon>();
  for (const auto& rings : feature.polygons) {
    const OGRPolygon polygon = polygon_of(rings);
    multi->addGeometry(&polygon);
  }
  return multi;
}

std::unique_ptr<OGRGeometry> geometry_of(const VectorFeature& feature, GeometryType wanted) {
  const OGRwkbGeometryType type = ogr_type(wanted), flat = wkbFlatten(type);
  if (feature.points.empty() && feature.polygons.empty()) return nullptr;
  if (type == wkbMultiPolygon) return multi_polygon_of(feature);
  if (type == wkbPolygon) return std::make_unique<OGRPolygon>(polygon_of(feature.polygons.front()));
  if (flat == wkbPoint) return std::make_unique<OGRPoint>(point_of(feature, 0, type));
  auto points = std::make_unique<OGRMultiPoint>();
  auto line = std::make_unique<OGRLineString>();
  for (std::size_t i = 0; i < feature.points.size(); ++i) {
    const OGRPoint point = point_of(feature, i, type);
    if (flat == wkbMultiPoint)
      points->addGeometry(&point);
    else
      line->addPoint(&point);
  }
  if (flat == wkbMultiPoint) return points;
  return line;
}

void set_field(OGRFeature& feature, int index, const FieldValue& value) {
  if (const auto* whole = std::get_if<std::int64_t>(&value))
    feature.SetField(index, static_cast<GIntBig>(*whole));
  else if (const auto* real = std::get_if<double>(&value); real != nullptr && !std::isnan(*real))
    feature.SetField(index, *real);
  else if (const auto* words = std::get_if<std::string>(&value))
    feature.SetField(index, printable(*words).c_str());
  else
    feature.SetFieldNull(index);
}

void create(OGRLayer& layer, OGRFeature& feature) {
  if (layer.CreateFeature(&feature) != OGRERR_NONE)
    CPLError(CE_Failure, CPLE_FileIO, "a feature cannot be written");
}

void write_features(OGRLayer& out, const VectorLayer& layer) {
  for (const VectorFeature& from : layer.features) {
    OGRFeature feature(out.GetLayerDefn());
    for (std::size_t i = 0; i < from.values.size(); ++i)
      set_field(feature, static_cast<int>(i), from.values[i]);
    if (auto geometry = geometry_of(from, layer.type))
      feature.SetGeometryDirectly(geometry.release());
    create(out, feature);
  }
}

void write_layer(GDALDataset& dataset, OGRSpatialReference* crs, const VectorLayer& layer) {
  CPLStringList options;
  options.SetNameValue("DESCRIPTION", layer.description.c_str());
  options.SetNameValue("GEOMETRY_NAME", layer.geometry.c_str());
  OGRLayer* const out =
      dataset.CreateLayer(layer.name.c_str(), crs, ogr_type(layer.type), options.List());
  if (out == nullptr) return;
  for (const VectorField& field : layer.fields) {
    const OGRFieldType type = field.type == FieldType::integer   ? OFTInteger64
                              : field.type == FieldType::real    ? OFTReal
                              : field.type == FieldType::boolean ? OFTInteger
                                                                 : OFTString;
    OGRFieldDefn definition(field.name.c_str(), type);
    if (field.type == FieldType::boolean) definition.SetSubType(OFSTBoolean);
    static_cast<void>(out->CreateField(&definition));
  }
  write_features(*out, layer);
}

std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? "''" : std::string(1, c);
  return out + "'";
}

// Titles of fields as the standard's extension "Schema" keeps them.
void write_titles(GDALDataset& dataset, const std::vector<VectorLayer>& layers) {
  const auto run = [&dataset](const std::string& sql) {
    dataset.ReleaseResultSet(dataset.ExecuteSQL(sql.c_str(), nullptr, nullptr));
  };
  bool any = false;
  for (const VectorLayer& layer : layers)
    for (const VectorField& field : layer.fields) {
      if (field.title.empty()) continue;
      if (!any) {
        run("CREATE TABLE gpkg_data_columns (table_name TEXT NOT NULL, column_name TEXT NOT NULL, "
            "name TEXT, title TEXT, description TEXT, mime_type TEXT, constraint_name TEXT, "
            "CONSTRAINT pk_gdc PRIMARY KEY (table_name, column_name), CONSTRAINT gdc_tn UNIQUE "
            "(table_name, name))");
        run("CREATE TABLE IF NOT EXISTS gpkg_extensions (table_name TEXT, column_name TEXT, "
            "extension_name TEXT NOT NULL, definition TEXT NOT NULL, scope TEXT NOT NULL, "
            "CONSTRAINT ge_tce UNIQUE (table_name, column_name, extension_name))");
        run("INSERT INTO gpkg_extensions VALUES ('gpkg_data_columns', NULL, 'gpkg_schema', "
            "'http://www.geopackage.org/spec121/#extension_schema', 'read-write')");
        any = true;
      }
      run("INSERT INTO gpkg_data_columns (table_name, column_name, title) VALUES (" +
          quoted(layer.name) + ", " + quoted(field.name) + ", " + quoted(field.title) + ")");
    }
}

// The table that QGIS reads default styles from.
void write_styles(GDALDataset& dataset, const std::vector<VectorLayer>& layers) {
  OGRLayer* const styles = dataset.CreateLayer("layer_styles", nullptr, wkbNone, nullptr);
  if (styles == nullptr) return;
  for (const char* name :
       {"f_table_catalog", "f_table_schema", "f_table_name", "f_geometry_column", "styleName",
        "styleQML", "styleSLD", "useAsDefault", "description", "owner", "ui", "update_time"}) {
    OGRFieldDefn definition(name, OFTString);
    if (std::string(name) == "useAsDefault") {
      definition.SetType(OFTInteger);
      definition.SetSubType(OFSTBoolean);
    }
    static_cast<void>(styles->CreateField(&definition));
  }
  for (const VectorLayer& layer : layers) {
    if (layer.qml.empty()) continue;
    OGRFeature style(styles->GetLayerDefn());
    for (const char* name : {"f_table_catalog", "f_table_schema", "styleSLD", "owner", "ui"})
      style.SetField(name, "");
    style.SetField("f_table_name", layer.name.c_str());
    style.SetField("f_geometry_column", layer.geometry.c_str());
    style.SetField("styleName", layer.name.c_str());
    style.SetField("styleQML", layer.qml.c_str());
    style.SetField("useAsDefault", 1);
    style.SetField("description", layer.description.c_str());
    style.SetField("update_time", "2000-01-01T00:00:00.000Z");
    create(*styles, style);
  }
}

}  // namespace

void write_geopackage(const std::string& path, const std::string& crs_wkt,
                      const std::vector<VectorLayer>& layers,
                      const std::vector<std::pair<std::string, std::string>>& tags) {
  register_gdal_drivers();
  // the driver writes the time of day into the file unless it is told one, and from GDAL 3.10 on
  // the metadata into a file beside it too
  const CPLConfigOptionSetter date("OGR_CURRENT_DATE", "2000-01-01T00:00:00.000Z", false);
  const CPLConfigOptionSetter no_file_beside("GDAL_PAM_ENABLED", "NO", false);
  const GdalErrors errors;
  GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName("GPKG");
  std::unique_ptr<GDALDataset> dataset(
      driver == nullptr ? nullptr : driver->Create(path.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
  const bool is_open = dataset != nullptr;
  if (is_open) {
    OGRSpatialReference crs;
    const bool has_crs = !crs_wkt.empty() && crs.SetFromUserInput(crs_wkt.c_str()) == OGRERR_NONE;
    crs.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    for (const auto& [key, value] : tags)
      dataset->SetMetadataItem(key.c_str(), printable(value).c_str());
    static_cast<void>(dataset->StartTransaction());
    for (const VectorLayer& layer : layers) write_layer(*dataset, has_crs ? &crs : nullptr, layer);
    write_styles(*dataset, layers);
    write_titles(*dataset, layers);
    static_cast<void>(dataset->CommitTransaction());
  }
  dataset.reset();  // the last bytes are written here
  errors.check_written(path, is_open);
}

}  // namespace talus
