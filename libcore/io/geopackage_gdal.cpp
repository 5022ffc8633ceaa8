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

namespace talus {
namespace {

// The driver writes the time of day into the file unless it is told one.
class FixedDate {
 public:
  FixedDate() { CPLSetThreadLocalConfigOption("OGR_CURRENT_DATE", "2000-01-01T00:00:00.000Z"); }
  ~FixedDate() { CPLSetThreadLocalConfigOption("OGR_CURRENT_DATE", nullptr); }
  FixedDate(const FixedDate&) = delete;
  FixedDate& operator=(const FixedDate&) = delete;
};

OGRwkbGeometryType ogr_type(GeometryType type) {
  switch (type) {
    case GeometryType::point:
      return wkbPoint;
    case GeometryType::point_z:
      return wkbPoint25D;
    case GeometryType::multi_point_z:
      return wkbMultiPoint25D;
    case GeometryType::line:
      return wkbLineString;
    case GeometryType::line_z:
      return wkbLineString25D;
    case GeometryType::line_zm:
      return wkbLineStringZM;
    case GeometryType::multi_polygon:
      return wkbMultiPolygon;
    case GeometryType::none:
      break;
  }
  return wkbNone;
}

std::unique_ptr<OGRGeometry> line_of(const VectorFeature& feature) {
  auto line = std::make_unique<OGRLineString>();
  for (const Vec3& p : feature.points) line->addPoint(p.x(), p.y());
  return line;
}

std::unique_ptr<OGRGeometry> line_z_of(const VectorFeature& feature) {
  auto line = std::make_unique<OGRLineString>();
  for (const Vec3& p : feature.points) line->addPoint(p.x(), p.y(), p.z());
  return line;
}

std::unique_ptr<OGRGeometry> points_z_of(const VectorFeature& feature) {
  auto points = std::make_unique<OGRMultiPoint>();
  for (const Vec3& p : feature.points) {
    const OGRPoint point(p.x(), p.y(), p.z());
    points->addGeometry(&point);
  }
  return points;
}

std::unique_ptr<OGRGeometry> line_zm_of(const VectorFeature& feature) {
  auto line = std::make_unique<OGRLineString>();
  for (std::size_t i = 0; i < feature.points.size(); ++i) {
    const Vec3& p = feature.points[i];
    line->addPoint(p.x(), p.y(), p.z(), feature.measure.empty() ? 0 : feature.measure[i]);
  }
  return line;
}

std::unique_ptr<OGRGeometry> multi_polygon_of(const VectorFeature& feature) {
  auto multi = std::make_unique<OGRMultiPolygon>();
  for (const auto& rings : feature.polygons) {
    auto polygon = std::make_unique<OGRPolygon>();
    for (const auto& points : rings) {
      auto ring = std::make_unique<OGRLinearRing>();
      for (const Vec2& p : points) ring->addPoint(p.x(), p.y());
      ring->closeRings();
      polygon->addRingDirectly(ring.release());
    }
    multi->addGeometryDirectly(polygon.release());
  }
  return multi;
}

std::unique_ptr<OGRGeometry> geometry_of(const VectorFeature& feature, GeometryType type) {
  switch (type) {
    case GeometryType::point:
      return std::make_unique<OGRPoint>(feature.points.at(0).x(), feature.points.at(0).y());
    case GeometryType::point_z:
      return std::make_unique<OGRPoint>(feature.points.at(0).x(), feature.points.at(0).y(),
                                        feature.points.at(0).z());
    case GeometryType::multi_point_z:
      return points_z_of(feature);
    case GeometryType::line:
      return line_of(feature);
    case GeometryType::line_z:
      return line_z_of(feature);
    case GeometryType::line_zm:
      return line_zm_of(feature);
    case GeometryType::multi_polygon:
      return multi_polygon_of(feature);
    case GeometryType::none:
      break;
  }
  return nullptr;
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
    style.SetField("f_geometry_column", "geom");
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
  const FixedDate date;
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
    static_cast<void>(dataset->CommitTransaction());
  }
  dataset.reset();  // the last bytes are written here
  if (!is_open || errors.failed())
    throw InputError({path}, "cannot be written: " + errors.failure(), errors.why_not_written());
}

}  // namespace talus
