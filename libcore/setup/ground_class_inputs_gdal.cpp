// Ground class of each cell of the terrain, from the polygons and rasters of [ground.*].
#include "setup/ground_class_inputs_gdal.hpp"

#include <map>
#include <string>

#include "base/sha256.hpp"
#include "import/site_rasters_gdal.hpp"
#include "io/areas_gdal.hpp"
#include "setup/site_shapes_gdal.hpp"
#include "setup/vector_inputs_gdal.hpp"
#include "site/ground_classes.hpp"

namespace talus {
namespace {

void check_corners(const std::vector<Vec3>& corners, const Where& where) {
  if (corners.empty()) return;
  std::vector<Vec2> plan;
  for (const Vec3& corner : corners) plan.push_back(corner.head<2>());
  check_polygon(plan, where);
}

// The area of a section: a polygon in the site file, polygons of a file, or both, which are painted
// one after the other, so that a place in both is in the section.
void add_ground_areas(InputLog& log, const Site& site, const Trn& trn, int index,
                      std::vector<GroundArea>& areas) {
  SitePlace written = place_of(site.grounds[index]), in_file = written;
  written.file.clear();
  in_file.points.clear();
  check_corners(written.points, where_of(site, written.section + ".polygon"));
  for (const SitePlace& place : {written, in_file})
    if (!place.points.empty() || !place.file.empty())
      areas.push_back({index, shapes_in_plan(log, site, trn, place)});
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
  std::vector<Doubt> doubts;
  const std::vector<std::int32_t> values = read_cell_classes(path, trn, doubts);
  log.doubts(doubts);
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
