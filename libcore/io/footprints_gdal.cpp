#include "io/footprints_gdal.hpp"

#include <cpl_conv.h>
#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <algorithm>
#include <memory>

#include "base/error.hpp"
#include "base/printable.hpp"
#include "geometry/convex_outline.hpp"
#include "io/errors_gdal.hpp"

namespace talus {
namespace {

// A GeoPackage stamps layers with the time of writing unless this option fixes it.
class FixedTime {
 public:
  FixedTime() { CPLSetThreadLocalConfigOption("OGR_CURRENT_DATE", "2000-01-01T00:00:00.000Z"); }
  ~FixedTime() { CPLSetThreadLocalConfigOption("OGR_CURRENT_DATE", nullptr); }
  FixedTime(const FixedTime&) = delete;
  FixedTime& operator=(const FixedTime&) = delete;
};

constexpr const char* style_qml =
    R"(<!DOCTYPE qgis PUBLIC 'http://mrcc.com/qgis.dtd' 'SYSTEM'>
<qgis version="3.22"><renderer-v2 type="singleSymbol" symbollevels="0" forceraster="0" enableorderby="0"><symbols><symbol type="fill" name="0" alpha="1" clip_to_extent="1" force_rhr="0"><layer class="SimpleFill" enabled="1" locked="0" pass="0"><Option type="Map"><Option type="QString" name="color" value="196,132,84,150"/><Option type="QString" name="outline_color" value="70,40,20,255"/><Option type="QString" name="outline_width" value="0.2"/><Option type="QString" name="outline_width_unit" value="MM"/><Option type="QString" name="style" value="solid"/></Option></layer></symbol></symbols></renderer-v2></qgis>)";

[[noreturn]] void fail(const std::string& path, const GdalErrors& errors) {
  throw InputError({path}, "cannot be written: " + errors.failure(), errors.why_not_written());
}

OGRPolygon polygon_of(const std::vector<Vec2>& ring) {
  OGRLinearRing outline;
  for (const Vec2& p : ring) outline.addPoint(p.x(), p.y());
  outline.closeRings();
  OGRPolygon polygon;
  polygon.addRing(&outline);
  return polygon;
}

std::vector<Vec2> footprint(const BlockSet& set, int b) {
  std::vector<Vec2> points;
  for (int v = set.block_vertex_begin[b]; v < set.block_vertex_begin[b + 1]; ++v)
    points.emplace_back(set.vertices[v].head<2>() + set.origin.head<2>());
  return convex_outline(std::move(points));
}

void add_fields(OGRLayer& layer) {
  for (const char* name :
       {"volume_m3", "bottom_m", "top_m", "longest_m", "middle_m", "shortest_m"}) {
    OGRFieldDefn field(name, OFTReal);
    layer.CreateField(&field);
  }
  for (const char* name : {"block_id", "n_parts"}) {
    OGRFieldDefn field(name, OFTInteger);
    layer.CreateField(&field);
  }
  OGRFieldDefn material("material", OFTString);
  layer.CreateField(&material);
}

void add_block(OGRLayer& layer, const BlockSet& set, int b, const std::string& path,
               const GdalErrors& errors) {
  double bottom = set.vertices[set.block_vertex_begin[b]].z(), top = bottom;
  for (int v = set.block_vertex_begin[b]; v < set.block_vertex_begin[b + 1]; ++v) {
    bottom = std::min(bottom, set.vertices[v].z());
    top = std::max(top, set.vertices[v].z());
  }
  const Vec3 size = extents({set.volume[b], set.centroid[b], set.second_moment[b]});
  const std::unique_ptr<OGRFeature, void (*)(OGRFeature*)> feature(
      OGRFeature::CreateFeature(layer.GetLayerDefn()), OGRFeature::DestroyFeature);
  feature->SetField("block_id", b);
  feature->SetField("n_parts", set.convex_part_begin[b + 1] - set.convex_part_begin[b]);
  feature->SetField("volume_m3", set.volume[b]);
  feature->SetField("bottom_m", bottom + set.origin.z());
  feature->SetField("top_m", top + set.origin.z());
  feature->SetField("longest_m", size.x());
  feature->SetField("middle_m", size.y());
  feature->SetField("shortest_m", size.z());
  feature->SetField("material", printable(set.material_names[set.material[b]]).c_str());
  OGRPolygon polygon = polygon_of(footprint(set, b));
  feature->SetGeometry(&polygon);
  if (layer.CreateFeature(feature.get()) != OGRERR_NONE) fail(path, errors);
}

void add_style(GDALDataset& dataset, const std::string& path, const GdalErrors& errors) {
  const char* const no_options[] = {nullptr};
  OGRLayer* styles =
      dataset.CreateLayer("layer_styles", nullptr, wkbNone, const_cast<char**>(no_options));
  if (!styles) fail(path, errors);
  for (const char* name :
       {"f_table_catalog", "f_table_schema", "f_table_name", "f_geometry_column", "styleName",
        "styleQML", "styleSLD", "description", "owner", "ui", "update_time"}) {
    OGRFieldDefn field(name, OFTString);
    styles->CreateField(&field);
  }
  OGRFieldDefn is_default("useAsDefault", OFTInteger);
  is_default.SetSubType(OFSTBoolean);
  styles->CreateField(&is_default);
  const std::unique_ptr<OGRFeature, void (*)(OGRFeature*)> style(
      OGRFeature::CreateFeature(styles->GetLayerDefn()), OGRFeature::DestroyFeature);
  style->SetField("f_table_catalog", "");
  style->SetField("f_table_schema", "");
  style->SetField("f_table_name", "blocks");
  style->SetField("f_geometry_column", "geom");
  style->SetField("styleName", "blocks");
  style->SetField("styleQML", style_qml);
  style->SetField("useAsDefault", 1);
  for (const char* name : {"styleSLD", "description", "owner", "ui"}) style->SetField(name, "");
  style->SetField("update_time", "2000-01-01T00:00:00.000Z");
  if (styles->CreateFeature(style.get()) != OGRERR_NONE) fail(path, errors);
}

}  // namespace

void write_footprints(const std::string& path, const BlockSet& set,
                      const std::vector<std::vector<Vec2>>& source_rings,
                      const std::map<std::string, std::string>& tags) {
  register_gdal_drivers();
  const GdalErrors errors;
  const FixedTime fixed_time;
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GPKG");
  if (!driver) throw InputError({path}, "this GDAL cannot write GeoPackages");
  driver->Delete(path.c_str());
  std::unique_ptr<GDALDataset> dataset(driver->Create(path.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
  if (!dataset) fail(path, errors);
  OGRSpatialReference srs;
  srs.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  const bool has_crs =
      !set.crs_wkt.empty() && srs.importFromWkt(set.crs_wkt.c_str()) == OGRERR_NONE;
  for (const auto& [name, value] : tags)
    dataset->SetMetadataItem(name.c_str(), printable(value).c_str());
  if (dataset->StartTransaction() != OGRERR_NONE) fail(path, errors);
  OGRLayer* layer = dataset->CreateLayer("blocks", has_crs ? &srs : nullptr, wkbPolygon, nullptr);
  if (!layer) fail(path, errors);
  add_fields(*layer);
  for (int b = 0; b < n_blocks(set); ++b) add_block(*layer, set, b, path, errors);
  if (!source_rings.empty()) {
    OGRLayer* area =
        dataset->CreateLayer("source_area", has_crs ? &srs : nullptr, wkbPolygon, nullptr);
    if (!area) fail(path, errors);
    for (const auto& ring : source_rings) {
      const std::unique_ptr<OGRFeature, void (*)(OGRFeature*)> feature(
          OGRFeature::CreateFeature(area->GetLayerDefn()), OGRFeature::DestroyFeature);
      OGRPolygon polygon = polygon_of(ring);
      feature->SetGeometry(&polygon);
      if (area->CreateFeature(feature.get()) != OGRERR_NONE) fail(path, errors);
    }
  }
  add_style(*dataset, path, errors);
  if (dataset->CommitTransaction() != OGRERR_NONE) fail(path, errors);
  dataset.reset();
  if (errors.failed()) fail(path, errors);
}

}  // namespace talus
