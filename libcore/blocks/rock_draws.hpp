// libcore/blocks/rock_draws.hpp: public
// Sizes of single rocks from a law of magnitude and frequency.
// refs: Hungr, Evans and Hazzard 1999, doi:10.1139/t98-106 (power law of rockfall volumes)
#pragma once

namespace talus {

/// The volume [m3] that a share `u` of the rocks between `low` and `high` stays below, where the
/// number of larger ones goes with volume^-exponent; exponent 0: evenly by the logarithm.
/// 0 <= u <= 1, 0 < low <= high, exponent >= 0.
[[nodiscard]] double power_law_volume(double u, double low, double high, double exponent);

}  // namespace talus
