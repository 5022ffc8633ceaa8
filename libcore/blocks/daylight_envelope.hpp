// libcore/blocks/daylight_envelope.hpp: public
// The part of a mass that can leave its hollow: the failure surface lifted until no rock ahead
// blocks it.
// in:    ground, area, a bed of any form, the direction of the motion
// out:   the bed on which rock leaves along that direction without touching anything
//
// The lifted bed is B*(x) = max over r >= 0 of [B(x + r u) + r tan a], with u the plan direction of
// the motion and a its plunge: B is the bed inside the area and the ground outside. Every point of
// it lies on a line of that direction that clears the rock ahead, so it daylights everywhere. Of an
// even hollow d deep and L long on a slope b it keeps 1 - d / (2 L (tan b - tan a)).
#pragma once

#include "blocks/area.hpp"
#include "terrain/trn.hpp"

namespace talus {

struct DaylightDirection {
  double azimuth = 0;  ///< [rad]
  double plunge = 0;   ///< [rad]
  double width = 0;    ///< a block meets rock up to so far to either side of its path [m]
};

/// How far past the foot the ground still holds [cells].
inline constexpr double cells_beyond = 3;

[[nodiscard]] Trn lifted_to_daylight(const Trn& ground, const Area& area, Trn bed,
                                     const DaylightDirection& direction);

}  // namespace talus
