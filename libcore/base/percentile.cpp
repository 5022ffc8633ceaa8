#include "base/percentile.hpp"

#include <algorithm>
#include <limits>

namespace talus {
namespace {

constexpr double rounding = 1e-12;  // of a share of the weight

}  // namespace

double weighted_percentile(std::span<const WeightedValue> sorted, double p) {
  double total = 0;
  for (const WeightedValue& v : sorted) total += v.weight;
  if (!(total > 0)) return std::numeric_limits<double>::quiet_NaN();
  double sum = 0;
  for (const WeightedValue& v : sorted) {
    sum += v.weight;
    if (v.weight > 0 && sum >= p * total * (1 - rounding)) return v.value;
  }
  return sorted.back().value;
}

void sort_values(std::span<WeightedValue> values) {
  std::sort(values.begin(), values.end(), [](const WeightedValue& a, const WeightedValue& b) {
    return a.value != b.value ? a.value < b.value : a.weight < b.weight;
  });
}

}  // namespace talus
