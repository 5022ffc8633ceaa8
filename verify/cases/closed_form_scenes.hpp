// verify/cases/closed_form_scenes.hpp
// Common scenes of the cases of closed_form.hpp: a body on one plane. Within the module, for
// closed_form_sliding.cpp  blocks at rest or sliding: planes, wedge, column, bond, shaken base
// closed_form_rolling.cpp  prisms that roll, columns that rock closed_form_events.cpp   events
// within a step: bounces, rolling, take-off, edges, borders closed_form_soil.cpp     yielding
// ground: COR, rolling resistance, friction, drag closed_form_flight.cpp   free flight and spin,
// and motion after an impact
#pragma once

#include "verify/cases/cases.hpp"

namespace talus::cases {

/// A body on the plane of `frame` through the point `through`; the TRN reaches `reach` [m] from
/// there to all four sides, in cells of `cell_size` [m].
inline Scene on_plane(const Settings& settings, const SlopeFrame& frame, const GroundClass& ground,
                      const Body& body, double reach, double cell_size = 0.5,
                      const Vec3& through = Vec3::Zero()) {
  return scene_of(plane_trn(frame, cell_size, reach, through), ground, {body}, settings);
}

/// Cube with the middle of its lower face at `base`, `side` long [m].
inline Polyhedron cube_on(const SlopeFrame& frame, double side, const Vec3& base = Vec3::Zero()) {
  const double h = side / 2;
  return box_in(frame, base, Vec3(-h, -h, 0), Vec3(h, h, side));
}

}  // namespace talus::cases
