// libcore/sampling/distribution.hpp: public
// Distributions of a single number, and of a mean direction, as functions of a uniform number.
// in:    parameters, a number between 0 and 1
// out:   the value that the distribution stays below with that probability
// refs:  Fisher 1953; Mardia and Jupp 2000, 9.3 (concentration of a mean direction)
#pragma once

#include <limits>
#include <vector>

namespace talus {

enum class DistributionKind { normal, lognormal, uniform, triangular, discrete };

struct Distribution {
  DistributionKind kind = DistributionKind::uniform;
  double mean = 0, std = 1;               ///< normal, lognormal: of the value itself, std > 0
  double min = 0, mode = 0.5, max = 1;    ///< uniform, triangular: min < max
  std::vector<double> values, weights{};  ///< discrete: ascending; weights sum to more than 0
  double low = -std::numeric_limits<double>::infinity();  ///< truncated to [low, high]:
  double high = std::numeric_limits<double>::infinity();  ///< the rest is scaled up to 1
};

/// Probability of values up to x, before it is truncated.
[[nodiscard]] double probability_below(const Distribution& distribution, double x);

/// Probability that a value lies in [low, high], before it is truncated.
[[nodiscard]] double probability_between(const Distribution& distribution, double low, double high);

/// The value that the truncated distribution stays below with probability u, 0 < u < 1.
[[nodiscard]] double quantile(const Distribution& distribution, double u);

// --- directions --------------------------------------------------------------------------------

/// Angle from the mean direction and azimuth around it [rad].
struct DirectionDraw {
  double angle = 0, azimuth = 0;
};
/// A direction with Fisher's density exp(k cos t) sin t, k > 0, from two uniform numbers.
[[nodiscard]] DirectionDraw fisher_draw(double k, double u, double v);

/// Concentration of the mean direction of n poles that scatter with k: k R, R = n (1 - 1/k) + 1/k.
[[nodiscard]] double concentration_of_mean(double k, double n);

/// Half angle of the cone that holds the true mean direction with 95 % [rad].
[[nodiscard]] double cone_95(double concentration);

}  // namespace talus
