// The normal distribution with mean 0 and standard deviation 1, and its inverse.
#include "sampling/normal.hpp"

#include <cmath>
#include <numbers>

#include "base/error.hpp"

namespace talus {

double normal_probability(double x) { return 0.5 * std::erfc(-x / std::numbers::sqrt2); }

// Bisection to the last bit: the probability rises with x.
double normal_quantile(double p) {
  TALUS_ASSERT(p > 0 && p < 1);
  double low = -1, high = 1;
  while (normal_probability(low) > p) low *= 2;
  while (normal_probability(high) < p) high *= 2;
  for (int i = 0; i < 200 && low < high; ++i) {
    const double middle = low + (high - low) / 2;
    if (middle == low || middle == high) break;
    (normal_probability(middle) < p ? low : high) = middle;
  }
  return high;
}

}  // namespace talus
