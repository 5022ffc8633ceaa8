#include "io/union_gdal.hpp"

#include <ogr_geometry.h>

#include <cmath>
#include <memory>

#include "base/error.hpp"
#include "geometry/plan2d.hpp"
#include "io/polygons_gdal.hpp"

namespace talus {
namespace {

using Ring = std::vector<Vec2>;

bool is_between(const Vec2& a, const Vec2& p, const Vec2& b, double tolerance) {
  const Vec2 along = b - a;
  if (along.norm() <= tolerance) return true;
  return std::abs(cross(along, p - a)) <= tolerance * along.norm() && (p - a).dot(b - p) >= 0;
}

// Without corners that the sides beside them pass within the tolerance.
Ring without_straight_corners(const Ring& ring, double tolerance) {
  Ring out;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Vec2& before = out.empty() ? ring.back() : out.back();
    if (!is_between(before, ring[k], ring[(k + 1) % ring.size()], tolerance))
      out.push_back(ring[k]);
  }
  return out;
}

double width_of(const Ring& ring) {
  const double around = length_of(ring) + (ring.front() - ring.back()).norm();
  return around > 0 ? 2 * std::abs(ring_area(ring)) / around : 0;
}

// Corners that differ by rounding become one, so that pieces share their edges.
OGRPolygon polygon_of(const Ring& piece, double tolerance) {
  OGRLinearRing ring;
  for (const Vec2& p : piece)
    ring.addPoint(std::round(p.x() / tolerance) * tolerance,
                  std::round(p.y() / tolerance) * tolerance);
  ring.closeRings();
  OGRPolygon polygon;
  polygon.addRing(&ring);
  return polygon;
}

}  // namespace

std::vector<std::vector<Ring>> union_of(const std::vector<Ring>& pieces, double tolerance) {
  OGRMultiPolygon all;
  for (const Ring& piece : pieces) {
    const OGRPolygon polygon = polygon_of(piece, tolerance / 4);
    if (polygon.get_Area() > 0) all.addGeometry(&polygon);
  }
  if (all.getNumGeometries() == 0) return {};
  const std::unique_ptr<OGRGeometry> joined(all.UnionCascaded());
  if (!joined) throw InputError({}, "an area cannot be put together from its pieces");
  std::vector<std::vector<Ring>> out;
  for (const std::vector<Ring>& rings : polygons_of(*joined)) {
    std::vector<Ring> kept;
    for (const Ring& ring : rings)
      if (width_of(ring) > tolerance) kept.push_back(without_straight_corners(ring, tolerance));
    // A polygon whose outer ring is a sliver holds nothing.
    if (!kept.empty() && width_of(rings[0]) > tolerance) out.push_back(std::move(kept));
  }
  return out;
}

}  // namespace talus
