// libcore/blocks/placement.hpp: public
// Where bodies from elsewhere start: points along lines and over areas, and the height above
// ground.
#pragma once

#include <vector>

#include "blocks/block_set.hpp"
#include "blocks/source.hpp"
#include "terrain/trn.hpp"

namespace talus {

/// Points along a polyline every `spacing`, from its first vertex on; its last when it falls on it.
[[nodiscard]] std::vector<Vec2> points_along(const std::vector<Vec2>& line, double spacing);

/// Ground that releases rocks: triangles whose middle lies in the area, of all ground without
/// rings. Points are only where it is as steep as this.
struct ReleaseArea {
  Area area;
  double min_slope = 0;  ///< [rad]
};

/// One point for every spacing^2 of sloping ground in the area: triangle after triangle, a point
/// wherever the summed true area passes a multiple, placed in the triangle by the R2 sequence:
/// even, but no grid. Those on flatter ground are left out. `shift` of the sequence, 0 to 1 each:
/// as many other points in the same triangles.
[[nodiscard]] std::vector<Vec2> points_over(const Trn& ground, const ReleaseArea& release,
                                            double spacing, const Vec2& shift = Vec2::Zero());

/// True area of the triangles, and of those that are steep enough [m2].
struct SlopingArea {
  double all = 0, steep = 0;
};
[[nodiscard]] SlopingArea sloping_area(const Trn& ground, const ReleaseArea& release);

/// Smallest vertical distance of the body's lower side above the ground, exact for the triangles of
/// the TRN: at the body's vertices, at nodes below it, and where edges cross in plan. Negative when
/// it reaches into the ground; NaN when part of it lies off the known ground [m].
[[nodiscard]] double clearance(const Polyhedron& convex, const Trn& ground);
[[nodiscard]] double clearance(const Body& body, const Trn& ground);

/// Moves all parts and the shell.
void move_by(Body& body, const Vec3& shift);
void rotate(Body& body, const Mat3& rotation);

}  // namespace talus
