// libcore/blocks/area_clip.hpp: public
// The part of each triangle of a TRN in an area: convex pieces in plan.
// in:    TRN, area
// out:   the triangles that the area overlaps, the sides that cut them, the pieces inside
//
// A triangle is cut along the whole line of each side that crosses it, so pieces are convex; they
// lie wholly inside or outside of the area. A point nearer to a side than the tolerance lies on it:
// corners on nodes, and sides along grid lines, cut nothing. Corners a hair beside them are moved
// there first, so that each triangle and its neighbour see the same.
#pragma once

#include <limits>
#include <vector>

#include "blocks/area.hpp"
#include "geometry/plane.hpp"
#include "geometry/polyhedron.hpp"
#include "terrain/trn.hpp"

namespace talus {

/// A side of an outline and the vertical plane through it.
struct AreaSide {
  Vec2 start = Vec2::Zero();       ///< [m]
  Vec2 direction = Vec2::UnitX();  ///< unit
  double length = 0;               ///< [m]
  Plane plane;                     ///< its normal points out of the area
};
[[nodiscard]] std::vector<AreaSide> sides_of(const Area& area);

/// The area with corners that are nearer to a node, a grid line or a diagonal of the TRN than ten
/// times the tolerance of its sides moved there.
[[nodiscard]] Area snapped(const Trn& trn, Area area);

/// 1e-8 of the diagonal of the area's box [m].
[[nodiscard]] double side_tolerance(const Area& area);

/// How far along a side a section in its plane reaches [m].
struct SideRange {
  double low = std::numeric_limits<double>::infinity(), high = -low;
};
void include(SideRange& range, const AreaSide& side, const Vec2& point);
/// Whether the side itself, not only its line, runs through the section.
[[nodiscard]] bool runs_through(const AreaSide& side, const SideRange& range, double tolerance);
/// Whether the vertical strip over and under the side runs through a convex body.
[[nodiscard]] bool runs_through(const AreaSide& side, const Polyhedron& body, double tolerance);

struct TriangleInArea {
  int triangle = 0;
  std::vector<int> sides;                 ///< that cut it, in the order of the cuts
  std::vector<std::vector<Vec2>> pieces;  ///< convex, counter-clockwise, at least one
};
/// Of the area as snapped; ascending. It must lie on the grid.
[[nodiscard]] std::vector<TriangleInArea> triangles_in(const Trn& trn, const Area& area);

}  // namespace talus
