// libcore/sampling/normal.hpp: public
// The normal distribution with mean 0 and standard deviation 1.
#pragma once

namespace talus {

/// Probability that a normal variable stays below x.
[[nodiscard]] double normal_probability(double x);

/// The value that a normal variable stays below with probability p, 0 < p < 1.
[[nodiscard]] double normal_quantile(double p);

}  // namespace talus
