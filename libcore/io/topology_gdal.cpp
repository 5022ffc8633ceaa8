#include "io/topology_gdal.hpp"

#include <ogr_geometry.h>

#include <algorithm>
#include <memory>
#include <numeric>

#include "base/error.hpp"
#include "base/text.hpp"
#include "io/errors_gdal.hpp"
#include "io/polygons_gdal.hpp"

namespace talus {
namespace {

double length_of_rings(const OGRPolygon& polygon) {
  double sum = 0;
  for (const OGRLinearRing* ring : polygon) sum += ring->get_Length();
  return sum;
}

}  // namespace

void check_topology(const std::vector<std::vector<std::vector<Vec2>>>& polygons,
                    const TopologyRules& rules, const std::string& path, const std::string& layer) {
  constexpr double rounding = 1e-9;  // of areas of map coordinates, relative
  std::vector<OGRPolygon> shapes;
  std::vector<OGREnvelope> box(polygons.size());
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    shapes.push_back(polygon_of(polygons[i]));
    shapes[i].getEnvelope(&box[i]);
  }
  const auto refuse = [&](std::size_t i, const std::string& finding) {
    throw InputError({path, 0, layer}, "the polygon at " + text(box[i].MinX) + ", " +
                                           text(box[i].MinY) + " " + finding);
  };
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const GdalErrors errors;
    if (!shapes[i].IsValid()) refuse(i, "is not sound: " + errors.warning());
    const double area = shapes[i].get_Area(), width = 2 * area / length_of_rings(shapes[i]);
    if (area < rules.least_area * (1 - rounding))
      refuse(i, "has " + text(area, 4) + " m2, less than " + text(rules.least_area, 4));
    if (width < rules.least_width * (1 - rounding))
      refuse(i, "is a sliver of " + text(width, 3) + " m");
  }
  std::vector<std::size_t> order(shapes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return box[a].MinX < box[b].MinX; });
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t j = i + 1; j < order.size() && box[order[j]].MinX <= box[order[i]].MaxX; ++j) {
      const OGRPolygon &a = shapes[order[i]], &b = shapes[order[j]];
      if (!box[order[i]].Intersects(box[order[j]]) || !a.Intersects(&b) || a.Touches(&b)) continue;
      refuse(order[i],
             "lies over that at " + text(box[order[j]].MinX) + ", " + text(box[order[j]].MinY));
    }
}

}  // namespace talus
