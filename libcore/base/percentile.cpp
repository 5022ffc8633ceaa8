// Percentiles of a list of values.
#include "base/percentile.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
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

double percentile(std::vector<double> values, double p) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const double rank = std::ceil(p * static_cast<double>(values.size()) * (1 - rounding));
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(std::max(rank, 1.0)) - 1;
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

double median(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*std::max_element(values.begin(), middle) + *middle);
}

}  // namespace talus
