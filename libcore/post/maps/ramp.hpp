// libcore/post/maps/ramp.hpp: public
// Colours of maps: each kind of quantity has its own, and each tells its values apart for the
// colour-blind too, since it grows darker or lighter throughout.
#pragma once

#include "io/style.hpp"

namespace talus {

/// Kind of quantity. Hazard classes have the colours of their authority, in its recipe.
enum class Ramp {
  speed,        ///< YlGnBu
  energy,       ///< YlOrRd, carried on to a darker end for its many classes
  height,       ///< of blocks above the ground: PuBuGn
  probability,  ///< and shares: BuPu
  thickness,    ///< YlOrBr
  time,         ///< viridis, dark is early
  angle,        ///< cividis, dark is flat
  frequency,    ///< and return periods: PuRd
  intensity,    ///< Greens
  less,         ///< of a difference: blues of RdBu
  more,         ///< of a difference: reds of RdBu
};

/// The colour at a share, 0 to 1, of a ramp.
///
/// Ramps in capitals are those of ColorBrewer (C. Brewer, colorbrewer2.org) without their palest
/// colour, which light ground would hide; viridis and cividis those of matplotlib (S. van der Walt,
/// N. Smith 2015) and of Nunez, Anderton, Renslow 2018 (doi 10.1371/journal.pone.0199239).
[[nodiscard]] Colour ramp_colour(Ramp ramp, double share);

}  // namespace talus
