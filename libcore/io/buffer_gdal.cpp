#include "io/buffer_gdal.hpp"

#include <ogr_geometry.h>

#include <memory>

#include "base/error.hpp"
#include "io/polygons_gdal.hpp"

namespace talus {
std::vector<std::vector<std::vector<Vec2>>> buffer_of(const std::vector<Vec2>& line,
                                                      double radius) {
  TALUS_ASSERT(!line.empty() && radius > 0);
  OGRLineString string;
  for (const Vec2& p : line) string.addPoint(p.x(), p.y());
  const OGRPoint point(line[0].x(), line[0].y());
  const OGRGeometry& shape = line.size() == 1 ? static_cast<const OGRGeometry&>(point) : string;
  const std::unique_ptr<OGRGeometry> area(shape.Buffer(radius, 8));
  if (!area) throw InputError({}, "an area around a line cannot be made");
  return polygons_of(*area);
}

}  // namespace talus
