// libcore/solver/relax.hpp
// The balance of momentum M (v - v_free) = sum J^T p(J v) where steps of Newton do not find it: the
// velocities come to rest from the free motion in a time of their own, M dv/ds = -residual. Their
// limit is a solution, and a stable one. theory, "One step of an island", 7
//
// Where a heavy body jams a light one, forces differ by orders of magnitude between solutions that
// are next to each other, and steps of Newton do not get there. A step of s is one of implicit
// Euler, by one step of Newton. It is as long as that step gets its equation right, and becomes a
// step of Newton near the end.
#pragma once

#include <algorithm>
#include <cmath>

#include "solver/law_numbers.hpp"

namespace talus {

/// Relaxes from the free motion, where the caller has evaluated the residual, while `is_open()`.
/// `stiffness` is the largest D / m. `advance(time)` makes a step; it returns the share of the
/// residual that the step leaves in its own equation, as a root of energies, and goes back where
/// that is not below 1.
template <class IsOpen, class Advance>
void relax(double stiffness, int most_steps, IsOpen&& is_open, Advance&& advance) {
  double time = 1 / std::max(1.0, stiffness);
  for (int steps = 0; steps < most_steps && is_open(); ++steps) {
    const double left = advance(time);
    const double next = std::isfinite(left) ? std::sqrt(law::usually_left / left) : 0;
    time *= std::clamp(next, 1 / law::largest_change, law::largest_change);
  }
}

}  // namespace talus
