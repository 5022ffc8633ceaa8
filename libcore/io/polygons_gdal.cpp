#include "io/polygons_gdal.hpp"

#include <ogr_geometry.h>

#include <utility>

namespace talus {
namespace {

std::vector<std::vector<Vec2>> rings_of(const OGRPolygon& polygon) {
  std::vector<std::vector<Vec2>> rings;
  for (const OGRLinearRing* ring : polygon) {
    std::vector<Vec2> points;
    for (int i = 0; i + 1 < ring->getNumPoints(); ++i)
      points.emplace_back(ring->getX(i), ring->getY(i));
    rings.push_back(std::move(points));
  }
  return rings;
}

}  // namespace

std::vector<std::vector<std::vector<Vec2>>> polygons_of(const OGRGeometry& geometry) {
  std::vector<std::vector<std::vector<Vec2>>> out;
  const OGRwkbGeometryType type = wkbFlatten(geometry.getGeometryType());
  if (type == wkbPolygon) out.push_back(rings_of(*geometry.toPolygon()));
  if (type == wkbMultiPolygon || type == wkbGeometryCollection)
    for (const OGRGeometry* part : *geometry.toGeometryCollection())
      for (auto& polygon : polygons_of(*part)) out.push_back(std::move(polygon));
  return out;
}

}  // namespace talus
