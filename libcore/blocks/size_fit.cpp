// Fits sizes of blocks to return periods.
#include "blocks/size_fit.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.hpp"
#include "base/random.hpp"

namespace talus {
namespace {

double mean_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

// The x that a standard normal variable exceeds with probability p: bisection on erfc.
double normal_above(double p) {
  double low = -40, high = 40;
  for (int i = 0; i < 200; ++i) {
    const double x = (low + high) / 2;
    (0.5 * std::erfc(x / std::numbers::sqrt2) > p ? low : high) = x;
  }
  return (low + high) / 2;
}

// Shape of the likeliest Weibull law: sum x^k ln x / sum x^k - 1 / k = mean ln x; it grows with k.
double weibull_shape(const std::vector<double>& edges) {
  const double largest = *std::max_element(edges.begin(), edges.end());
  double mean_log = 0;
  for (const double a : edges)
    mean_log += std::log(a / largest) / static_cast<double>(edges.size());
  const auto is_too_large = [&](double k) {
    double sum = 0, sum_log = 0;
    for (const double a : edges) {
      const double power = std::pow(a / largest, k);
      sum += power;
      sum_log += power * std::log(a / largest);
    }
    return sum_log / sum - 1 / k > mean_log;
  };
  double low = 1e-3, high = 1;
  while (!is_too_large(high) && high < 1e6) high *= 2;
  for (int i = 0; i < 200; ++i) {
    const double k = (low + high) / 2;
    (is_too_large(k) ? high : low) = k;
  }
  return (low + high) / 2;
}

double log_density(const SizeFit& fit, double a) {
  switch (fit.law) {
    case SizeLaw::exponential:
      return -std::log(fit.first) - a / fit.first;
    case SizeLaw::lognormal: {
      const double u = (std::log(a) - fit.first) / fit.second;
      return -u * u / 2 - std::log(a * fit.second * std::sqrt(2 * std::numbers::pi));
    }
    case SizeLaw::weibull:
      break;
  }
  const double u = a / fit.second;
  return std::log(fit.first / fit.second) + (fit.first - 1) * std::log(u) - std::pow(u, fit.first);
}

double distance_from_list(const SizeFit& fit, std::vector<double> edges) {
  std::sort(edges.begin(), edges.end());
  const auto n = static_cast<double>(edges.size());
  double largest = 0;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const double below = 1 - fit.exceedance(edges[i]);
    largest = std::max(
        {largest, below - static_cast<double>(i) / n, static_cast<double>(i + 1) / n - below});
  }
  return largest;
}

}  // namespace

const char* text(SizeLaw law) {
  switch (law) {
    case SizeLaw::exponential:
      return "exponential";
    case SizeLaw::lognormal:
      return "lognormal";
    case SizeLaw::weibull:
      break;
  }
  return "weibull";
}

double SizeFit::exceedance(double edge) const {
  if (edge <= 0) return 1;
  switch (law) {
    case SizeLaw::exponential:
      return std::exp(-edge / first);
    case SizeLaw::lognormal:
      return 0.5 * std::erfc((std::log(edge) - first) / (second * std::numbers::sqrt2));
    case SizeLaw::weibull:
      break;
  }
  return std::exp(-std::pow(edge / second, first));
}

double SizeFit::edge_of(double exceedance_wanted) const {
  if (exceedance_wanted >= 1) return 0;
  switch (law) {
    case SizeLaw::exponential:
      return -first * std::log(exceedance_wanted);
    case SizeLaw::lognormal:
      return std::exp(first + second * normal_above(exceedance_wanted));
    case SizeLaw::weibull:
      break;
  }
  return second * std::pow(-std::log(exceedance_wanted), 1 / first);
}

SizeFit fit_sizes(SizeLaw law, const std::vector<double>& edges) {
  TALUS_ASSERT(edges.size() > 1);
  SizeFit fit;
  fit.law = law;
  if (law == SizeLaw::exponential) {
    fit.first = mean_of(edges);
  } else if (law == SizeLaw::lognormal) {
    std::vector<double> logs;
    for (const double a : edges) logs.push_back(std::log(a));
    fit.first = mean_of(logs);
    for (double& v : logs) v = (v - fit.first) * (v - fit.first);
    fit.second = std::sqrt(mean_of(logs));
  } else {
    fit.first = weibull_shape(edges);
    std::vector<double> powers;
    for (const double a : edges) powers.push_back(std::pow(a, fit.first));
    fit.second = std::pow(mean_of(powers), 1 / fit.first);
  }
  double likelihood = 0;
  for (const double a : edges) likelihood += log_density(fit, a);
  fit.aic = 2 * (law == SizeLaw::exponential ? 1 : 2) - 2 * likelihood;
  fit.ks = distance_from_list(fit, edges);
  return fit;
}

std::vector<SizeFit> fit_sizes(const std::vector<double>& edges) {
  std::vector<SizeFit> fits;
  for (const SizeLaw law : {SizeLaw::exponential, SizeLaw::lognormal, SizeLaw::weibull})
    fits.push_back(fit_sizes(law, edges));
  std::stable_sort(fits.begin(), fits.end(),
                   [](const SizeFit& a, const SizeFit& b) { return a.aic < b.aic; });
  return fits;
}

double rate_of_all(const SizeFit& fit, const SizeAnchor& anchor) {
  return 1 / anchor.years / fit.exceedance(std::cbrt(anchor.volume));
}

double volume_of_years(const SizeFit& fit, const SizeAnchor& anchor, double years) {
  return std::pow(fit.edge_of(1 / (years * rate_of_all(fit, anchor))), 3);
}

std::array<double, 2> volume_bounds(SizeLaw law, const std::vector<double>& edges,
                                    const SizeAnchor& anchor, double years) {
  constexpr int n_resamples = 200;
  Random random(1, "block sizes");
  std::vector<double> volumes;
  for (int k = 0; k < n_resamples; ++k) {
    std::vector<double> drawn;
    for (std::size_t i = 0; i < edges.size(); ++i)
      drawn.push_back(edges[std::min(
          edges.size() - 1,
          static_cast<std::size_t>(random.uniform() * static_cast<double>(edges.size())))]);
    if (std::all_of(drawn.begin(), drawn.end(), [&](double a) { return a == drawn[0]; })) continue;
    volumes.push_back(volume_of_years(fit_sizes(law, drawn), anchor, years));
  }
  std::sort(volumes.begin(), volumes.end());
  const auto at = [&](double p) {
    return volumes[static_cast<std::size_t>(p * static_cast<double>(volumes.size() - 1))];
  };
  return {at(0.05), at(0.95)};
}

}  // namespace talus
