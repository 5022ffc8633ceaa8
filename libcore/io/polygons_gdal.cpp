// Unites polygons and makes areas along lines.
#include "io/polygons_gdal.hpp"

#include <ogr_geometry.h>

#include <cmath>
#include <memory>
#include <utility>

#include "base/error.hpp"
#include "geometry/plan2d.hpp"

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

OGRPolygon polygon_of(const std::vector<Ring>& rings) {
  OGRPolygon polygon;
  for (const Ring& points : rings) {
    OGRLinearRing ring;
    for (const Vec2& p : points) ring.addPoint(p.x(), p.y());
    ring.closeRings();
    polygon.addRing(&ring);
  }
  return polygon;
}

OGRPolygon polygon_of(const Ring& ring) { return polygon_of(std::vector<Ring>{ring}); }

std::vector<std::vector<Ring>> union_of(const std::vector<Ring>& pieces, double tolerance) {
  OGRMultiPolygon all;
  for (const Ring& piece : pieces) {
    // corners that differ by rounding become one, so that pieces share their edges
    const double step = tolerance / 4;
    Ring rounded;
    for (const Vec2& p : piece)
      rounded.emplace_back(std::round(p.x() / step) * step, std::round(p.y() / step) * step);
    const OGRPolygon polygon = polygon_of(rounded);
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

std::vector<Ring> rim_of(const std::vector<Ring>& footprints, double gap) {
  constexpr double seen = 0.02;
  constexpr int quadrant = 4;  // pieces of a round corner, which the buffer back removes again
  using Shape = std::unique_ptr<OGRGeometry>;
  OGRMultiPolygon pieces;  // each on its own: together their time would grow with its square
  for (const Ring& footprint : footprints)
    if (const Shape piece(polygon_of(footprint).Buffer(gap / 2, quadrant)); piece)
      pieces.addGeometry(piece.get());
  const Shape wide(pieces.UnionCascaded());
  const Shape narrow(wide ? wide->Buffer(-gap / 2, quadrant) : nullptr);
  const Shape rim(narrow ? narrow->SimplifyPreserveTopology(seen) : nullptr);
  std::vector<Ring> rings;
  if (rim)
    for (std::vector<Ring>& polygon : polygons_of(*rim))
      rings.insert(rings.end(), polygon.begin(), polygon.end());
  return rings;
}

}  // namespace talus
