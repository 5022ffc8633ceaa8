// Distributions of a number and of a mean direction, as functions of a uniform number.
#include "sampling/distribution.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.hpp"
#include "sampling/normal.hpp"

namespace talus {
namespace {

// Of the logarithm, by the mean and standard deviation of the value.
struct LogNormal {
  double mean = 0, std = 0;
};
LogNormal of_logarithm(const Distribution& d) {
  const double variance = std::log1p(d.std / d.mean * (d.std / d.mean));
  return {std::log(d.mean) - variance / 2, std::sqrt(variance)};
}

double triangular_below(const Distribution& d, double x) {
  if (x <= d.min) return 0;
  if (x >= d.max) return 1;
  const double width = d.max - d.min;
  return x < d.mode ? (x - d.min) * (x - d.min) / (width * (d.mode - d.min))
                    : 1 - (d.max - x) * (d.max - x) / (width * (d.max - d.mode));
}

double triangular_quantile(const Distribution& d, double u) {
  const double width = d.max - d.min;
  return u * width < d.mode - d.min ? d.min + std::sqrt(u * width * (d.mode - d.min))
                                    : d.max - std::sqrt((1 - u) * width * (d.max - d.mode));
}

double sum_of(const std::vector<double>& weights) {
  double sum = 0;
  for (const double weight : weights) sum += weight;
  return sum;
}

// Of the values from `low` to `high`.
double discrete_quantile(const Distribution& d, double u) {
  const auto is_kept = [&](std::size_t i) { return d.values[i] >= d.low && d.values[i] <= d.high; };
  double kept = 0;
  for (std::size_t i = 0; i < d.values.size(); ++i) kept += is_kept(i) ? d.weights[i] : 0;
  double sum = 0, last = d.values.back();
  for (std::size_t i = 0; i < d.values.size(); ++i) {
    if (!is_kept(i) || d.weights[i] == 0) continue;
    last = d.values[i];
    sum += d.weights[i];
    if (u * kept < sum) break;
  }
  return last;
}

double whole_quantile(const Distribution& d, double u) {
  switch (d.kind) {
    case DistributionKind::normal:
      return d.mean + d.std * normal_quantile(u);
    case DistributionKind::lognormal: {
      const LogNormal log = of_logarithm(d);
      return std::exp(log.mean + log.std * normal_quantile(u));
    }
    case DistributionKind::triangular:
      return triangular_quantile(d, u);
    default:
      return d.min + u * (d.max - d.min);
  }
}

}  // namespace

double probability_below(const Distribution& d, double x) {
  switch (d.kind) {
    case DistributionKind::normal:
      return normal_probability((x - d.mean) / d.std);
    case DistributionKind::lognormal: {
      if (!(x > 0)) return 0;
      const LogNormal log = of_logarithm(d);
      return normal_probability((std::log(x) - log.mean) / log.std);
    }
    case DistributionKind::uniform:
      return std::clamp((x - d.min) / (d.max - d.min), 0.0, 1.0);
    case DistributionKind::triangular:
      return triangular_below(d, x);
    case DistributionKind::discrete:
      break;
  }
  double sum = 0;
  for (std::size_t i = 0; i < d.values.size(); ++i)
    if (d.values[i] <= x) sum += d.weights[i];
  return sum / sum_of(d.weights);
}

double probability_between(const Distribution& d, double low, double high) {
  if (d.kind != DistributionKind::discrete)
    return probability_below(d, high) - probability_below(d, low);
  double sum = 0;
  for (std::size_t i = 0; i < d.values.size(); ++i)
    if (d.values[i] >= low && d.values[i] <= high) sum += d.weights[i];
  return sum / sum_of(d.weights);
}

double quantile(const Distribution& d, double u) {
  TALUS_ASSERT(u > 0 && u < 1);
  if (d.kind == DistributionKind::discrete) return discrete_quantile(d, u);
  const double below = probability_below(d, d.low), kept = probability_below(d, d.high) - below;
  const double p = std::clamp(below + u * kept, 1e-300, 1 - 0x1p-53);
  return std::clamp(whole_quantile(d, p), d.low, d.high);
}

DirectionDraw fisher_draw(double k, double u, double v) {
  // The inverse of the distribution of cos t, written so that large k does not overflow.
  const double cosine = 1 + std::log(u + (1 - u) * std::exp(-2 * k)) / k;
  // of 1 - cos t, which keeps small angles
  const double half = std::sqrt(std::clamp((1 - cosine) / 2, 0.0, 1.0));
  return {2 * std::asin(half), 2 * std::numbers::pi * v};
}

double concentration_of_mean(double k, double n) { return k * (n * (1 - 1 / k) + 1 / k); }

double cone_95(double concentration) { return std::acos(1 + std::log(0.05) / concentration); }

}  // namespace talus
