// libcore/base/percentile.hpp: public
// Percentiles, with and without weights, and medians.
#pragma once

#include <span>
#include <vector>

namespace talus {

struct WeightedValue {
  double value = 0;
  double weight = 1;  ///< >= 0
};

/// The p-percentile, 0 <= p <= 1: the smallest value that at least the share p of the weight does
/// not exceed (inverse of the distribution function; for equal weights the value of rank
/// ceil(p n)). It is always one of the values. `sorted` ascends by value; NaN when it is empty or
/// has no weight.
[[nodiscard]] double weighted_percentile(std::span<const WeightedValue> sorted, double p);

/// Ascending by value, equal ones by weight: the order that weighted_percentile() takes.
void sort_values(std::span<WeightedValue> values);

/// The same of values that weigh alike, in any order.
[[nodiscard]] double percentile(std::vector<double> values, double p);

/// The middle value, of an even count the mean of the two in the middle; NaN when there is none.
[[nodiscard]] double median(std::vector<double> values);

}  // namespace talus
