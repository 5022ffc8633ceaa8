// Draws sizes of single rocks from a law of magnitude and frequency.
#include "blocks/rock_draws.hpp"

#include <cmath>

namespace talus {

double power_law_volume(double u, double low, double high, double exponent) {
  const double span = std::log(high / low);
  // (V / low)^-exponent goes from 1 down to (high / low)^-exponent
  const double part = u * -std::expm1(-exponent * span);
  return exponent > 0 ? low * std::exp(-std::log1p(-part) / exponent) : low * std::exp(u * span);
}

}  // namespace talus
