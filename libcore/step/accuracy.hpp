// libcore/step/accuracy.hpp
// How far a substep errs, told by how its forces change: law talus takes them as constant in it.
// docs/theory/theory.md, stage 8
#pragma once

#include <algorithm>
#include <cmath>

#include "base/types.hpp"
#include "scene/scene.hpp"
#include "solver/law_numbers.hpp"
#include "step/substep_numbers.hpp"

namespace talus {

/// Estimated error of a block's place after a substep, and the displacement of its points in it
/// [m].
struct DisplacementError {
  double error = 0, displacement = 0;
};

/// From the changes of the mean acceleration and spin rate since the substep of `last_h` before.
/// A linear change by c over h leaves an error of c h^2 / 12.
[[nodiscard]] inline DisplacementError error_of_displacement(const BlockNumbers& c,
                                                             const Vec3& change,
                                                             const Vec3& change_of_spin,
                                                             const Vec3& path, const Vec3& turn,
                                                             double h, double last_h) {
  const double over_h = std::min(1.0, 2 * h / (h + last_h));
  const double changed = change.norm() + c.radius * change_of_spin.norm();
  return {over_h * changed * h * h / 12, path.norm() + c.radius * turn.norm()};
}

/// As a share of the displacement, or of a part of the thickness where that is more [-].
[[nodiscard]] inline double share_of(const DisplacementError& of, double thickness) {
  return of.error / (of.displacement + law::shallow * thickness);
}

/// Of an island or a mass: the mean share, by momentum.
struct MeanError {
  double share = 0, momentum = 0;

  void add(const BlockNumbers& c, const DisplacementError& of) {
    share += c.mass * of.displacement * share_of(of, c.thickness);
    momentum += c.mass * of.displacement;
  }
  [[nodiscard]] double over_displacement() const { return momentum > 0 ? share / momentum : 0; }
};

/// Length of a substep whose error is allowed: `h` where `share`, that of `h`, is [s].
[[nodiscard]] inline double accurate_substep(const Settings& settings, double share, double h) {
  const double excess = share / settings.accuracy, shortest = settings.dt / law::most_substeps;
  if (!(excess > 1) || h <= shortest) return h;
  return std::max(shortest, h / std::min(law::largest_change, std::ceil(std::sqrt(excess))));
}

/// The longest substep that is tried after one of `h` whose error is `share`, `longest` having been
/// that before. A substep cut short for another reason says nothing [s].
[[nodiscard]] inline double longest_after(const Settings& settings, double share, double h,
                                          double longest) {
  constexpr double sure = 0.8;
  if (h < longest) return longest;
  const double room = settings.accuracy / std::max(share, 1e-300);
  return h * std::clamp(std::sqrt(sure * room), 1.0, law::largest_change);
}

}  // namespace talus
