// Load through a block at which it is crushed, by its point load strength.
#include "setup/crushing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/percentile.hpp"

namespace talus {
namespace {

using std::size_t;

constexpr double per_index = 23;            // uniaxial strength over I_s50, ISRM 1985: 22 to 24
constexpr double standard_diameter = 0.05;  // [m]
constexpr double size_exponent = 0.45;

}  // namespace

double point_load_strength(double strength, double core_diameter) {
  const double index =
      strength / per_index * std::pow(core_diameter / standard_diameter, -size_exponent);
  return index * core_diameter * core_diameter;
}

double equivalent_core_diameter(const Polyhedron& shell, const Pose& rest) {
  double least = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 normal = rest.attitude * Vec3::Unit(axis);
    least = std::min(least, section_area(shell, plane_through(rest.position, normal)));
  }
  return std::sqrt(4 * least / std::numbers::pi);
}

std::vector<double> crush_loads(const BlockSet& set, const Blocks& blocks,
                                std::span<const Crushing> crushing, int n_released) {
  std::vector<double> loads;
  const bool any = std::any_of(crushing.begin(), crushing.end(),
                               [](const Crushing& c) { return c.strength > 0 && c.below > 0; });
  if (!any || n_released == 0) return loads;
  const double middle = median({blocks.volume.begin(), blocks.volume.begin() + n_released});
  loads.assign(blocks.volume.size(), std::numeric_limits<double>::infinity());
  bool any_small = false;
  for (int b = 0; b < n_blocks(set); ++b) {
    const auto i = static_cast<size_t>(b);
    const Crushing& c = crushing[static_cast<size_t>(set.material[i])];
    if (!(c.strength > 0 && blocks.volume[i] < c.below * middle)) continue;
    const double diameter = equivalent_core_diameter(block_shell(set, b), blocks.rest[i]);
    loads[i] = point_load_strength(c.strength, diameter);
    any_small = true;
  }
  if (!any_small) loads.clear();
  return loads;
}

}  // namespace talus
