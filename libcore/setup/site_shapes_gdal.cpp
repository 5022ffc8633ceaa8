// Shapes of sections of a site file: points written there, and vector files.
#include "setup/site_shapes_gdal.hpp"

#include <cmath>
#include <utility>

#include "base/error.hpp"
#include "base/source_path.hpp"
#include "import/canonical_gdal.hpp"
#include "import/feature_tables_gdal.hpp"
#include "io/crs_gdal.hpp"
#include "io/data_files_gdal.hpp"
#include "setup/vector_inputs_gdal.hpp"
#include "site/site_layers.hpp"

namespace talus {
namespace {

// --- objects -----------------------------------------------------------------------------------

// Place and kind of the shapes that the keys of a section name.
VectorKind kind_of(const Site& site, const ObjectSettings& object) {
  const int n = !object.polygon.empty() + !object.line.empty() + !object.position_m.empty() +
                !object.file.empty();
  if (n != 1)
    throw InputError(where_of_object(site, object),
                     n == 0 ? "has no place" : "has more than one place",
                     "give one of polygon, line, position_m or file");
  const bool has_width = !std::isnan(object.width_m), has_radius = !std::isnan(object.radius_m);
  if (has_width && has_radius)
    throw InputError(where_of_object(site, object), "has both width_m and radius_m",
                     "width_m is of lines, radius_m of points");
  if (!object.line.empty() && !has_width)
    throw InputError(where_of_object(site, object), "is a line without a width",
                     "give width_m, e.g. that of the road");
  if (!object.position_m.empty() && !has_radius)
    throw InputError(where_of_object(site, object), "is a point without a radius",
                     "give radius_m, or an outline as polygon");
  if (!object.polygon.empty() && (has_width || has_radius))
    throw InputError(where_of_object(site, object), "is an area with width_m or radius_m",
                     "leave them out: a polygon is taken as it is");
  if (!object.line.empty() || (!object.file.empty() && has_width)) return VectorKind::lines;
  if (!object.position_m.empty() || (!object.file.empty() && has_radius)) return VectorKind::points;
  return VectorKind::areas;
}

// --- files -------------------------------------------------------------------------------------

// Of a layer that defines sections its features count; a GIS changes the bytes of the file when
// it only looks at it.
std::string state_of(const Site& site, const std::string& file) {
  const std::string path = resolved(site, file);
  if (!names_layers_file(site, file)) return digest_of_data(path);
  const SourcePath named = parse_source_path(path);
  return digest_of_features(named.source, named.layer, named.subset, attributes_of(named.layer));
}

RequestedLayer requested(const Site& site, const SitePlace& place) {
  return {role_of(place.kind),
          {resolved(site, place.file), "", 0},
          place.fields,
          place.layer,
          place.section,
          place.file,
          state_of(site, place.file)};
}

// As talus-import wrote it, where the site has such a file, else itself.
VectorShapes shapes_of_file(InputLog& log, const Site& site, const SitePlace& place,
                            const std::string& crs) {
  VectorQuery query{resolved(site, place.file), place.kind, place.fields};
  read_data(log, place.section, query.path);
  if (site.inputs.empty()) return read_layer(log, place.section, query, crs);
  const auto imported = canonical_layer(site.inputs, requested(site, place), crs);
  if (imported) query.path = imported->path;
  VectorShapes found = read_layer(log, place.section, query, crs);
  if (imported && digest_of(found) != imported->seal) throw changed_since(imported->path);
  return found;
}

// --- points of the site file -------------------------------------------------------------------

RequestedLayer written(const Site& site, const SitePlace& place) {
  const std::string& crs = site.info.crs;
  RequestedLayer layer{role_of(place.kind), {}, {}, place.layer, place.section};
  layer.points = place.points;
  layer.crs = crs.empty() ? crs : crs_from_user(crs, "site.crs");
  layer.where = where_of(site, place.section + "." + place.points_key);
  return layer;
}

}  // namespace

Where where_of_object(const Site& site, const ObjectSettings& object) {
  return {site.file, object.line_number, "object." + object.name};
}

SitePlace place_of(const SourceSettings& source) {
  return {"source", "source", VectorKind::areas, source.polygon_file, source.polygon, "polygon"};
}

SitePlace place_of(const GroundSettings& ground) {
  return {"ground." + ground.name, "grounds",      VectorKind::areas,
          ground.polygon_file,     ground.polygon, "polygon"};
}

SitePlace place_of(const FenceSettings& fence) {
  return {"fence." + fence.name, "fences", VectorKind::lines, fence.file, fence.line, "line"};
}

SitePlace place_of(const DamSettings& dam) {
  return {"dam." + dam.name, "dams", VectorKind::lines, dam.file, dam.line, "line"};
}

SitePlace place_of(const ForestSettings& forest) {
  return {"forest." + forest.name, "forest",       VectorKind::areas,
          forest.polygon_file,     forest.polygon, "polygon"};
}

SitePlace stems_of(const ForestSettings& forest) {
  return {"forest." + forest.name,         "stems", VectorKind::points, forest.stems_file, {}, {},
          {"dbh_cm", "species", "conifer"}};
}

SitePlace place_of(const PlaceSettings& place) {
  return {"place." + place.name, "places",      VectorKind::areas,
          place.polygon_file,    place.polygon, "polygon"};
}

SitePlace boulders_of(const ObservedSettings& observed) {
  return {"observed." + observed.name,
          "observed_boulders",
          VectorKind::points,
          observed.boulders_file,
          {},
          {},
          {"volume_m3", "date", "start_x_m", "start_y_m"}};
}

SitePlace scars_of(const ObservedSettings& observed) {
  return {"observed." + observed.name,
          "observed_scars",
          VectorKind::points,
          observed.scars_file,
          {},
          {},
          {"height_m", "date"}};
}

SitePlace outline_of(const ObservedSettings& observed) {
  return {"observed." + observed.name, "observed_outlines", VectorKind::areas,
          observed.outline_file};
}

SitePlace release_of(const RockfallSettings& rocks) {
  const bool is_of_lines = !std::isnan(rocks.release_spacing_m);
  return {"rockfall." + rocks.name, is_of_lines ? "release_lines" : "release_points",
          is_of_lines ? VectorKind::lines : VectorKind::points, rocks.release_file};
}

SitePlace areas_of(const RockfallSettings& rocks) {
  return {"rockfall." + rocks.name, "release_areas", VectorKind::areas,
          rocks.polygon_file,       rocks.polygon,   "polygon"};
}

SitePlace place_of(const Site& site, const ObjectSettings& object) {
  const VectorKind kind = kind_of(site, object);
  SitePlace place{"object." + object.name, "objects", kind, object.file, object.polygon, "polygon"};
  if (kind == VectorKind::lines) {
    place.layer = "object_lines";
    place.points = object.line;
    place.points_key = "line";
  } else if (kind == VectorKind::points) {
    place.layer = "object_points";
    place.points = object.position_m;
    place.points_key = "position_m";
  }
  return place;
}

std::vector<RequestedLayer> layers_of(const Site& site) {
  std::vector<SitePlace> places{place_of(site.source)};
  for (const GroundSettings& ground : site.grounds) places.push_back(place_of(ground));
  for (const FenceSettings& fence : site.fences) places.push_back(place_of(fence));
  for (const DamSettings& dam : site.dams) places.push_back(place_of(dam));
  for (const ForestSettings& forest : site.forests) {
    if (!forest.active) continue;
    places.push_back(place_of(forest));
    places.push_back(stems_of(forest));
  }
  for (const RockfallSettings& rocks : site.rockfalls) {
    places.push_back(release_of(rocks));
    places.push_back(areas_of(rocks));
  }
  for (const ObjectSettings& object : site.objects) places.push_back(place_of(site, object));
  for (const PlaceSettings& place : site.places) places.push_back(place_of(place));
  for (const ObservedSettings& observed : site.observed)
    for (const auto& part : {boulders_of(observed), scars_of(observed), outline_of(observed)})
      places.push_back(part);
  std::vector<RequestedLayer> layers;
  for (const SitePlace& place : places) {
    if (!place.points.empty()) layers.push_back(written(site, place));
    if (!place.file.empty()) layers.push_back(requested(site, place));
  }
  return layers;
}

std::vector<SiteRaster> rasters_of(const Site& site) {
  std::vector<SiteRaster> rasters;
  const auto add = [&](const std::string& key, const std::string& file,
                       CellKind kind = CellKind::values) {
    if (!file.empty()) rasters.push_back({key, resolved(site, file), kind});
  };
  add("terrain.ground_raster", site.terrain.ground_raster, CellKind::classes);
  add("source.raster", site.source.raster, CellKind::heights);
  add("water.raster", site.water.raster, CellKind::heights);
  for (const RockfallSettings& rocks : site.rockfalls) {
    const std::string section = "rockfall." + rocks.name;
    add(section + ".rockdensity_raster", rocks.rockdensity_raster);
    add(section + ".d1_raster", rocks.d1_raster);
    add(section + ".d2_raster", rocks.d2_raster);
    add(section + ".d3_raster", rocks.d3_raster);
    add(section + ".blshape_raster", rocks.blshape_raster);
  }
  for (const ForestSettings& forest : site.forests) {
    if (!forest.active) continue;
    const std::string section = "forest." + forest.name;
    add(section + ".nrtrees_raster", forest.nrtrees_raster);
    add(section + ".dbhmean_raster", forest.dbhmean_raster);
    add(section + ".dbhstd_raster", forest.dbhstd_raster);
    add(section + ".conif_percent_raster", forest.conif_percent_raster);
  }
  return rasters;
}

VectorShapes local_shapes(InputLog& log, const Site& site, const Trn& ground,
                          const SitePlace& place) {
  VectorShapes found;
  if (!place.file.empty()) found = shapes_of_file(log, site, place, ground.crs_wkt);
  for (std::vector<Vec3>& shape : found.shapes)
    for (Vec3& point : shape) point -= ground.origin;
  if (place.points.empty()) return found;
  const std::vector<Vec3> points =
      local_points(log, site, ground, place.points, place.section, place.points_key);
  if (place.kind != VectorKind::points) {
    found.shapes.insert(found.shapes.begin(), points);
    return found;
  }
  std::vector<std::vector<Vec3>> alone;
  for (const Vec3& point : points) alone.push_back({point});
  found.shapes.insert(found.shapes.begin(), alone.begin(), alone.end());
  return found;
}

std::vector<std::vector<Vec2>> shapes_in_plan(InputLog& log, const Site& site, const Trn& ground,
                                              const SitePlace& place) {
  std::vector<std::vector<Vec2>> rings;
  for (const std::vector<Vec3>& shape : local_shapes(log, site, ground, place).shapes) {
    rings.emplace_back();
    for (const Vec3& point : shape) rings.back().push_back(point.head<2>());
  }
  return rings;
}

std::vector<Vec3> local_points(InputLog& log, const Site& site, const Trn& ground,
                               std::vector<Vec3> points, const std::string& section,
                               const std::string& key) {
  if (!points.empty() && !ground.crs_wkt.empty()) {
    InputsRequest request;
    request.layers = {written(site, {section, "", VectorKind::lines, "", std::move(points), key})};
    request.has_frame = true;
    request.frame = ground.crs_wkt;
    ImportReading reading;
    VectorShapes found = std::move(import_inputs(request, reading).shapes.front());
    log.doubts(reading.doubts);
    if (!found.operation.empty()) {
      const std::string name = section + "." + key;
      log.content_read(name, digest_of(found));
      log.info(name + ": " + found.operation);
      log.record(name + ": " + found.operation);
    }
    points = std::move(found.shapes.front());
  }
  for (Vec3& p : points) p -= ground.origin;
  return points;
}

}  // namespace talus
