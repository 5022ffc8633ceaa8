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

/// As many points as spacing^2 goes into the steep ground of the area, one at least: cell after
/// cell along Hilbert's curve, so that they are spread in plan, a point wherever the summed true
/// area passes a multiple, placed in its triangle by the R2 sequence. `shift`, 0 to 1 each, < 1: of
/// that sequence, and of the multiples: other points, as many. None where no ground is steep
/// enough.
[[nodiscard]] std::vector<Vec2> points_over(const Trn& ground, const ReleaseArea& release,
                                            double spacing,
                                            const Vec3& shift = Vec3::Constant(0.5));

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
