// libcore/blocks/bed_equilibrium.hpp: public
// The factor of safety of a mass that moves as one over its bed.
// in:    columns: weight and the gradient of the bed below them
// out:   F and the azimuth of the motion for which it is smallest
// refs:  Hungr 1987, Hungr et al. 1989 (simplified Janbu in three dimensions)
//
// Every column is in vertical equilibrium, so a steep rise at the foot supports with its full
// normal force. F says little of the part that fails: parts of a mass may leave the part that holds
// the rest.
#pragma once

#include <span>

#include "base/types.hpp"

namespace talus {

struct BedColumn {
  Vec2 gradient = Vec2::Zero();  ///< of the bed, dz/dx and dz/dy [-]
  double weight = 0;             ///< > 0 [N]
  double friction = 0;           ///< tangent of the friction angle [-]
  double cohesion = 0;           ///< cohesion times area of the bed [N]
};

/// Resistance over driving force of motion along `azimuth` [rad]; infinity where nothing drives, 0
/// where nothing resists.
[[nodiscard]] double factor_along(std::span<const BedColumn> columns, double azimuth);

struct BedEquilibrium {
  double factor = 0;   ///< smallest of all azimuths looked at [-]
  double azimuth = 0;  ///< [rad]
};
/// The smallest factor within 40 degrees of `azimuth`, to a tenth of a degree.
[[nodiscard]] BedEquilibrium least_factor(std::span<const BedColumn> columns, double azimuth);

}  // namespace talus
