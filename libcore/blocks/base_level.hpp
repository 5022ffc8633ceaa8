// libcore/blocks/base_level.hpp: public
// How curved a sloping local base level (SLBL) is: from its sag, or from the usual scenarios, to
// the constant C of the cells at hand.
// refs:  Jaboyedoff et al. 2004, 2009, 2020; the automatic choice of NGU's pySLBL
//
// Along a profile of plan length L the base level is a parabola that sags by e = C L^2 / (4 D^2)
// below the chord, D the cell. The same C is another surface on every cell size; the sag is not.
#pragma once

#include "blocks/area.hpp"
#include "terrain/trn.hpp"

namespace talus {

/// Through the middle of the area along the fall line of its mean slope.
struct SourceProfile {
  double length = 0;  ///< in plan, from the upper to the lower end of the area [m]
  double height = 0;  ///< of the upper end above the lower [m]
  Vec2 top = Vec2::Zero(), foot = Vec2::Zero();
};
[[nodiscard]] SourceProfile source_profile(const Trn& ground, const Area& area);

/// C of a base level that sags by `sag` on `length` [m].
[[nodiscard]] double curvature_of_sag(double sag, double length, double cell_size);
/// The deepest sag of the three scenarios, a quarter circle's: (sqrt 2 - 1) height; the middle one
/// is half of it, the least none [m].
[[nodiscard]] double largest_sag(double height);

}  // namespace talus
