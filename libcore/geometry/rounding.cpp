// Coordinates that a program has rounded as it wrote them.
#include "geometry/rounding.hpp"

#include <algorithm>
#include <cmath>

namespace talus {
namespace {

constexpr int fewest_digits = 6;   // that programs write by default
constexpr int most_digits = 9;     // more of them leave millimetres of map coordinates
constexpr int double_digits = 12;  // of a number that is looked at

int before_point(double value) {
  return value == 0 ? 0 : static_cast<int>(std::floor(std::log10(std::abs(value)))) + 1;
}

// Significant digits; double_digits: as many or more.
int digits_of(double value) {
  for (int n = std::max(0, before_point(value)); n < double_digits; ++n) {
    const double whole = value * std::pow(10, n - before_point(value));
    if (std::abs(whole - std::round(whole)) < 1e-3) return n;
  }
  return double_digits;
}

}  // namespace

void RoundingFinder::add(const Vec3& point) {
  for (int k = 0; k < 3; ++k) {
    const auto single = static_cast<float>(point[k]);
    is_single_ = is_single_ && single == point[k];
    is_round_ = is_round_ && std::abs(std::remainder(point[k], 0.01)) < 1e-6;
    single_step_[k] = std::max<double>(
        single_step_[k], std::nextafterf(std::abs(single), HUGE_VALF) - std::abs(single));
    const auto axis = static_cast<std::size_t>(k);
    if (n_digits_[axis] < double_digits)
      n_digits_[axis] = std::max(n_digits_[axis], digits_of(point[k]));
    n_before_point_[axis] = std::max(n_before_point_[axis], before_point(point[k]));
  }
}

// Numbers of as many decimals were written on purpose.
int RoundingFinder::n_digits() const {
  const auto [fewest, most] = std::minmax_element(n_digits_.begin(), n_digits_.end());
  const auto [shortest, longest] =
      std::minmax_element(n_before_point_.begin(), n_before_point_.end());
  return *fewest == *most && *most >= fewest_digits && *most <= most_digits && *shortest < *longest
             ? *most
             : 0;
}

double RoundingFinder::step() const {
  if (is_single_ && !is_round_) return single_step_.maxCoeff();
  const int n = n_digits();
  const int longest = *std::max_element(n_before_point_.begin(), n_before_point_.end());
  return n > 0 ? std::pow(10, longest - n) : 0;
}

std::string RoundingFinder::words() const {
  return is_single_ && !is_round_ ? "single precision" : std::to_string(n_digits()) + " digits";
}

}  // namespace talus
