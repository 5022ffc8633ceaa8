// Round numbers for axes, scales and distances between lines.
#include "draw/ticks.hpp"

#include <array>
#include <cmath>
#include <span>

namespace talus {
namespace {

// The smallest of `steps` times a power of ten that is at least `value`.
double rounded_up(double value, std::span<const double> steps) {
  const double power = std::pow(10, std::floor(std::log10(value)));
  constexpr double rounding = 1 + 1e-9;
  for (const double step : steps)
    if (step * power * rounding >= value) return step * power;
  return 10 * power;
}

}  // namespace

std::vector<double> round_ticks(double low, double high, int n) {
  const double rough = (high - low) / n;
  const double power = std::pow(10, std::floor(std::log10(rough)));
  double step = 10 * power;
  for (const double factor : {5.0, 2.0, 1.0})
    if (factor * power >= rough * (1 - 1e-9)) step = factor * power;
  std::vector<double> ticks;
  for (double k = std::ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k)
    ticks.push_back(k == 0 ? 0 : k * step);
  return ticks;
}

double round_scale(double value) {
  constexpr std::array<double, 10> steps = {1, 1.25, 1.5, 2, 2.5, 3, 4, 5, 6, 8};
  return rounded_up(value, steps);
}

double round_up(double value) {
  constexpr std::array<double, 3> steps = {1, 2, 5};
  return rounded_up(value, steps);
}

double round_down(double value) {
  const double power = std::pow(10, std::floor(std::log10(value)));
  for (const double step : {5.0, 2.0})
    if (step * power <= value * (1 + 1e-9)) return step * power;
  return power;
}

}  // namespace talus
