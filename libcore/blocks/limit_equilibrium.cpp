#include "blocks/limit_equilibrium.hpp"

#include <algorithm>
#include <cmath>

namespace talus {
namespace {

// Where f turns from true to false between two values, to 1e-12 of the first range.
template <class Holds>
double last_that_holds(double low, double high, Holds&& holds) {
  for (int k = 0; k < 60; ++k) {
    const double middle = (low + high) / 2;
    (holds(middle) ? low : high) = middle;
  }
  return low;
}

// Whether the toe needs no support at this friction. Forces are per weight of a square metre of
// column.
bool row_holds(const ColumnRow& row, double friction) {
  const double sine = std::sin(row.base_dip), cosine = std::cos(row.base_dip);
  double push = 0, arm = 0;  // of the column above, and how high above this base
  for (size_t n = row.height.size(); n-- > 0;) {
    const double height = row.height[n], weight = row.width * height;
    const double top = n > 0 ? std::min(height, row.height[n - 1] - row.step) : height;
    const double tips =
        push * (arm - row.width * friction) + weight / 2 * (height * sine - row.width * cosine);
    const double slides =
        push - weight * (cosine * friction - sine) / std::max(1e-12, 1 - friction * friction);
    if (tips > 0 && !(top > 0)) return false;  // it falls over the one below
    push = std::max({0.0, tips > 0 ? tips / top : 0.0, slides});
    arm = top + row.step;
  }
  return push <= 0;
}

}  // namespace

double sliding_factor(const SlidingMass& mass, const Vec3& seismic) {
  return block_mode(mass.weight * (seismic - Vec3::UnitZ()) + mass.water, mass.planes).factor();
}

double critical_seismic(const SlidingMass& mass, double azimuth) {
  const Vec3 along(std::sin(azimuth), std::cos(azimuth), 0);
  return last_that_holds(0, 2, [&](double k) { return sliding_factor(mass, k * along) >= 1; });
}

double toppling_factor(const ColumnRow& row, double friction) {
  // beyond a tangent of 1 columns jam
  const auto holds = [&](double tangent) { return row_holds(row, tangent); };
  return holds(1) ? friction / last_that_holds(1, 0, holds) : 0;
}

}  // namespace talus
