#include "ground_class_inputs.hpp"

#include <cmath>
#include <map>
#include <string>

#include "base/text.hpp"
#include "io/areas_gdal.hpp"
#include "io/class_raster_gdal.hpp"
#include "scene/ground_classes.hpp"
#include "site_places.hpp"
#include "vector_inputs.hpp"

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
void add_ground_areas(Tool& tool, const Site& site, const Trn& trn, int index,
                      std::vector<GroundArea>& areas) {
  const GroundSettings& ground = site.grounds[static_cast<std::size_t>(index)];
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
    add({local_points(tool, site, trn, ground.polygon, section + ".polygon")});
  }
  if (ground.polygon_file.empty()) return;
  const std::string path = resolved(site, ground.polygon_file);
  tool.read_also(section, path);
  VectorShapes found = read_layer(
      tool, section,
      {path, ground.polygon_layer, ground.polygon_where, VectorKind::areas, section + ".polygon_"},
      trn.crs_wkt);
  for (std::vector<Vec3>& ring : found.shapes)
    for (Vec3& point : ring) point -= trn.origin;
  add(found.shapes);
}

bool has_area(const GroundSettings& ground) {
  return !ground.polygon.empty() || !ground.polygon_file.empty();
}

// The section that says neither where by a polygon nor by values of the raster.
int ground_elsewhere(const Site& site) {
  int elsewhere = -1;
  for (std::size_t i = 0; i < site.grounds.size(); ++i) {
    const GroundSettings& ground = site.grounds[i];
    if (has_area(ground) || !ground.raster_values.empty()) continue;
    if (elsewhere >= 0)
      throw InputError({site.file, ground.line},
                       "[ground." + ground.name + "] has no polygon, and neither has [ground." +
                           site.grounds[static_cast<std::size_t>(elsewhere)].name + "]",
                       "one section holds elsewhere, the others need a polygon or raster_values");
    elsewhere = static_cast<int>(i);
  }
  return elsewhere;
}

// Which class a value of the raster stands for.
std::map<std::int32_t, int> classes_of_values(const Site& site) {
  std::map<std::int32_t, int> class_of;
  for (std::size_t i = 0; i < site.grounds.size(); ++i) {
    const GroundSettings& ground = site.grounds[i];
    const Where where = where_of(site, "ground." + ground.name + ".raster_values");
    if (!ground.raster_values.empty() && site.terrain.ground_raster.empty())
      throw InputError(where, "raster_values stand here, and there is no raster",
                       "name it: [terrain] ground_raster");
    for (const double value : ground.raster_values) {
      if (value != std::floor(value) || std::abs(value) > 2e9)
        throw InputError(where, "raster_values holds " + text(value) + ", expected whole numbers");
      if (!class_of.emplace(static_cast<std::int32_t>(value), static_cast<int>(i)).second)
        throw InputError(where, "the raster's value " + text(value) + " stands for two grounds");
    }
  }
  return class_of;
}

// Classes of the cells by the raster; where it is unknown, and without a raster, `elsewhere`.
std::vector<std::uint8_t> raster_classes(Tool& tool, const Site& site, const Trn& trn,
                                         int elsewhere) {
  const std::map<std::int32_t, int> class_of = classes_of_values(site);
  const auto n_cells =
      static_cast<std::size_t>(trn.n_rows - 1) * static_cast<std::size_t>(trn.n_cols - 1);
  std::vector<std::uint8_t> classes(n_cells, static_cast<std::uint8_t>(elsewhere));
  if (site.terrain.ground_raster.empty()) return classes;
  const std::string path = resolved(site, site.terrain.ground_raster);
  tool.read_also("ground_raster", path);
  const std::vector<std::int32_t> values = read_cell_classes(path, trn);
  for (std::size_t cell = 0; cell < n_cells; ++cell) {
    if (values[cell] == no_class) continue;
    const auto found = class_of.find(values[cell]);
    if (found == class_of.end())
      throw InputError({path},
                       "holds the value " + std::to_string(values[cell]) +
                           " below the terrain, which no [ground.*] names",
                       "add it to raster_values of a section [ground.*]");
    classes[cell] = static_cast<std::uint8_t>(found->second);
  }
  return classes;
}

}  // namespace

std::vector<std::uint8_t> ground_classes(Tool& tool, const Site& site, const Trn& trn) {
  const int n = static_cast<int>(site.grounds.size());
  if (n == 1 && site.terrain.ground_raster.empty()) return {};
  if (n > 255)
    throw InputError({site.file}, std::to_string(n) + " sections [ground.*], expected up to 255");
  const int elsewhere = ground_elsewhere(site);
  if (elsewhere < 0)
    throw InputError({site.file},
                     "no section [ground.*] holds outside the polygons and where the raster says "
                     "nothing",
                     "add one without polygon and raster_values");
  std::vector<GroundArea> areas;
  for (int i = 0; i < n; ++i)
    if (has_area(site.grounds[static_cast<std::size_t>(i)]))
      add_ground_areas(tool, site, trn, i, areas);
  std::vector<std::uint8_t> classes = raster_classes(tool, site, trn, elsewhere);
  paint_areas(trn, areas, classes);
  return classes;
}

}  // namespace talus
