// libcore/sampling/design.hpp: public
// Which point of the unit cube a run draws its quantities from.
// in:    a seed, the number of the point, a coordinate with its name
// out:   a number between 0 and 1, a pure function of these arguments
// refs:  Sobol 1967; Joe and Kuo 2008 (directions); Owen 1995 (scrambling); McKay et al. 1979
//
// No state is kept: more runs continue where earlier ones ended, and a quantity that is added at
// the end leaves those before it as they were.
#pragma once

#include <cstdint>
#include <string>

namespace talus {

enum class Sampling { sobol, hypercube, random };

struct Design {
  Sampling sampling = Sampling::sobol;
  std::uint64_t seed = 1;
  std::uint64_t n_points = 0;  ///< of a hypercube: it has exactly these points
};

/// Coordinate number `dimension` of point number `point`, both from 0, of Sobol's sequence as it
/// is: point 0 is 0, point 1 is 1/2 in all coordinates. Directions: Joe and Kuo; 64 bits.
[[nodiscard]] std::uint64_t sobol_bits(std::uint64_t point, int dimension);

/// A number above 0 and below 1: the coordinate `dimension` of a point. `name`: of the quantity,
/// whose scrambling is its own. Sobol: scrambled as Owen does, bit by bit. `point` < n_points for a
/// hypercube.
[[nodiscard]] double unit_value(const Design& design, std::uint64_t point, int dimension,
                                const std::string& name);

/// The point of run number `run` among those that share `n_masses` sets of blocks in turn. The runs
/// of one set would else take points whose first binary digits are alike, and the effects of blocks
/// and numbers could not be separated. So each round of n_masses runs but the first takes its
/// points in an order of its own. `n_masses` 0 or 1: `run`.
[[nodiscard]] std::uint64_t point_of_run(const Design& design, std::uint64_t run,
                                         std::uint64_t n_masses);

}  // namespace talus
