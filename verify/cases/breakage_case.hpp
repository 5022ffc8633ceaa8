// verify/cases/breakage_case.hpp
// Blocks that break in two when they are hit.
#pragma once

#include "verify/cases/closed_form.hpp"

namespace talus::cases {

/// A block of 2600 kg at rest breaks into 1000 and 1600 kg, which 500 J drive apart along the
/// normal of the cut: largest relative error of their velocities, 0.78446 and 0.49029 m/s, and of
/// the energy, after 0.1 s of flight. Law paper breaks nothing: its pieces are released all the
/// same.
CaseResult pieces_part(const CaseSettings& settings);

/// A cube that falls on a face, COR 0.3, 2600 kg/m3, 1e5 J/m2 across one section and a sharp
/// threshold: relative error of the speed from which it breaks, sqrt(2 G / (rho a (1 - e^2))) for
/// the side a, by bisection; 16.786, 9.194 and 5.308 m/s for 0.3, 1 and 3 m.
CaseResult breaking_speed(const CaseSettings& settings, double side_m);

}  // namespace talus::cases
