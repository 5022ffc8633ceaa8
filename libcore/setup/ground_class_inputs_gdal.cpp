#include "setup/ground_class_inputs_gdal.hpp"

#include <map>
#include <string>

#include "base/sha256.hpp"
#include "import/class_raster_gdal.hpp"
#include "io/areas_gdal.hpp"
#include "setup/site_places_gdal.hpp"
#include "setup/vector_inputs_gdal.hpp"
#include "site/ground_classes.hpp"

namespace talus {
namespace {

using Rings = std::vector<std::vector<Vec3>>;

void check_corners(const std::vector<Vec3>& corners, const Where& where) {
  std::vector<Vec2> plan;
  for (const Vec3& corner : corners) plan.push_back(corner.head<2>());
  check_polygon(plan, where);
}

// The area of a section: a polygon in the site file, polygons of a file, or both, which are painted
// one after the other, so that a place in both is in the section.
void add_ground_areas(InputLog& log, const Site& site, const Trn& trn, int index,
                      std::vector<GroundArea>& areas) {
  const GroundSettings& ground = site.grounds[index];
  const std::string section = "ground." + ground.name;
  const auto add = [&](const Rings& rings) {
    areas.push_back({index, {}});
    for (const std::vector<Vec3>& ring : rings) {
      areas.back().rings.emplace_back();
      for (const Vec3& point : ring) areas.back().rings.back().push_back(point.head<2>());
    }
  };
  if (!ground.polygon.empty()) {
    check_corners(ground.polygon, where_of(site, section + ".polygon"));
    add({local_points(log, site, trn, ground.polygon, section + ".polygon")});
  }
  if (ground.polygon_file.empty()) return;
  const std::string path = resolved(site, ground.polygon_file);
  read_data(log, section, path);
  VectorShapes found = read_layer(log, section, {path, VectorKind::areas}, trn.crs_wkt);
  for (std::vector<Vec3>& ring : found.shapes)
    for (Vec3& point : ring) point -= trn.origin;
  add(found.shapes);
}

std::string digest_of(const std::vector<std::int32_t>& values) {
  Sha256 hash;
  hash.add(values.data(), values.size() * sizeof values[0]);
  return hash.hex();
}

// Classes of the cells by the raster; where it is unknown, and without a raster, `elsewhere`.
std::vector<std::uint8_t> raster_classes(InputLog& log, const Site& site, const Trn& trn,
                                         int elsewhere) {
  const std::map<std::int32_t, int> class_of = classes_of_values(site);
  if (site.terrain.ground_raster.empty()) {
    const auto n_cells =
        static_cast<std::size_t>(trn.n_rows - 1) * static_cast<std::size_t>(trn.n_cols - 1);
    return std::vector<std::uint8_t>(n_cells, static_cast<std::uint8_t>(elsewhere));
  }
  const std::string path = resolved(site, site.terrain.ground_raster);
  read_data(log, "ground_raster", path);
  const std::vector<std::int32_t> values = read_cell_classes(path, trn);
  log.content_read("ground_raster", digest_of(values));
  return classes_of_cells(values, class_of, elsewhere, path);
}

}  // namespace

std::vector<std::uint8_t> ground_classes(InputLog& log, const Site& site, const Trn& trn) {
  const int n = static_cast<int>(site.grounds.size());
  const bool is_everywhere = n == 1 && site.terrain.ground_raster.empty() &&
                             !has_area(site.grounds[0]) && site.grounds[0].raster_values.empty();
  if (is_everywhere) return {};
  if (n > 255)
    throw InputError({site.file}, std::to_string(n) + " sections [ground.*], expected up to 255");
  const int elsewhere = ground_elsewhere(site);
  std::vector<GroundArea> areas;
  for (int i = 0; i < n; ++i)
    if (has_area(site.grounds[i])) add_ground_areas(log, site, trn, i, areas);
  std::vector<std::uint8_t> classes = raster_classes(log, site, trn, elsewhere);
  paint_areas(trn, areas, classes);
  return classes;
}

}  // namespace talus
