// Ground class of each cell by the sections [ground.*] and their areas.
#include "site/ground_classes.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/text.hpp"

namespace talus {
namespace {

// x of all crossings of the area's rings with the horizontal line at y, sorted.
std::vector<double> crossings_at(const GroundArea& area, double y) {
  std::vector<double> xs;
  for (const std::vector<Vec2>& ring : area.rings)
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
      if ((a.y() <= y) == (b.y() <= y)) continue;
      xs.push_back(a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x()));
    }
  std::sort(xs.begin(), xs.end());
  return xs;
}

}  // namespace

bool has_area(const GroundSettings& ground) {
  return !ground.polygon.empty() || !ground.polygon_file.empty();
}

int ground_elsewhere(const Site& site) {
  int elsewhere = -1;
  for (std::size_t i = 0; i < site.grounds.size(); ++i) {
    const GroundSettings& ground = site.grounds[i];
    if (has_area(ground) || !ground.raster_values.empty()) continue;
    if (elsewhere >= 0)
      throw InputError({site.file, ground.line},
                       "[ground." + ground.name + "] has no polygon, and neither has [ground." +
                           site.grounds[elsewhere].name + "]",
                       "one section holds elsewhere, the others need a polygon or raster_values");
    elsewhere = static_cast<int>(i);
  }
  if (elsewhere < 0)
    throw InputError({site.file},
                     "no section [ground.*] holds outside the polygons and where the raster says "
                     "nothing",
                     "add one without polygon and raster_values");
  return elsewhere;
}

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

std::vector<std::uint8_t> classes_of_cells(const std::vector<std::int32_t>& values,
                                           const std::map<std::int32_t, int>& class_of,
                                           int elsewhere, const std::string& path) {
  std::vector<std::uint8_t> classes;
  classes.reserve(values.size());
  for (const std::int32_t value : values) {
    const auto found = class_of.find(value);
    if (value != no_class && found == class_of.end())
      throw InputError({path},
                       "holds the value " + std::to_string(value) +
                           " below the terrain, which no [ground.*] names",
                       "add it to raster_values of a section [ground.*]");
    classes.push_back(static_cast<std::uint8_t>(value == no_class ? elsewhere : found->second));
  }
  return classes;
}

void paint_areas(const Trn& trn, const std::vector<GroundArea>& areas,
                 std::vector<std::uint8_t>& classes) {
  const int n_rows = trn.n_rows - 1, n_cols = trn.n_cols - 1;
  for (const GroundArea& area : areas)
    for (int row = 0; row < n_rows; ++row) {
      const double y = trn.node0.y() - (row + 0.5) * trn.cell_size;
      const std::vector<double> xs = crossings_at(area, y);
      for (std::size_t i = 0; i + 1 < xs.size(); i += 2) {
        const auto column = [&](double x) {  // first cell whose centre lies at or right of x
          const double place = std::ceil((x - trn.node0.x()) / trn.cell_size - 0.5);
          return static_cast<int>(std::clamp(place, 0.0, static_cast<double>(n_cols)));
        };
        const auto begin = classes.begin() + static_cast<std::ptrdiff_t>(row) * n_cols;
        std::fill(begin + column(xs[i]), begin + column(xs[i + 1]),
                  static_cast<std::uint8_t>(area.ground_class));
      }
    }
}

}  // namespace talus
