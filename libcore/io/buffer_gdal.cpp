#include "io/buffer_gdal.hpp"

#include <ogr_geometry.h>

#include <memory>

#include "base/error.hpp"

namespace talus {
namespace {

std::vector<Vec2> ring_of(const OGRLinearRing& ring) {
  std::vector<Vec2> out;
  for (int i = 0; i + 1 < ring.getNumPoints(); ++i) out.emplace_back(ring.getX(i), ring.getY(i));
  return out;
}

std::vector<std::vector<Vec2>> rings_of(const OGRPolygon& polygon) {
  std::vector<std::vector<Vec2>> rings;
  for (const OGRLinearRing* ring : polygon) rings.push_back(ring_of(*ring));
  return rings;
}

}  // namespace

std::vector<std::vector<std::vector<Vec2>>> buffer_of(const std::vector<Vec2>& line,
                                                      double radius) {
  TALUS_ASSERT(!line.empty() && radius > 0);
  OGRLineString string;
  for (const Vec2& p : line) string.addPoint(p.x(), p.y());
  const OGRPoint point(line[0].x(), line[0].y());
  const OGRGeometry& shape = line.size() == 1 ? static_cast<const OGRGeometry&>(point) : string;
  const std::unique_ptr<OGRGeometry> area(shape.Buffer(radius, 8));
  if (!area) throw InputError({}, "an area around a line cannot be made");
  std::vector<std::vector<std::vector<Vec2>>> out;
  if (wkbFlatten(area->getGeometryType()) == wkbPolygon)
    out.push_back(rings_of(*area->toPolygon()));
  else if (wkbFlatten(area->getGeometryType()) == wkbMultiPolygon)
    for (const OGRPolygon* polygon : *area->toMultiPolygon()) out.push_back(rings_of(*polygon));
  return out;
}

}  // namespace talus
