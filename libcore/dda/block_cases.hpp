// libcore/dda/block_cases.hpp
// Cases of several blocks with a closed form; as closed_form.hpp.
#pragma once

#include "dda/closed_form.hpp"

namespace talus::cases {

/// n unit cubes one on the other on a slope whose direction of dip is turned by 30 degrees.
[[nodiscard]] Scene tower(int n, double dip_deg, double friction_deg, const Settings& settings);

/// Three cubes, friction 40 degrees between them and 10 on the ground, on 15 degrees for 1 s: they
/// slide as one. Largest relative error of their displacements down the dip.
CaseResult tower_slide(const Settings& settings);

/// Equal cubes meeting face to face at 8 m/s, no friction. `value`: the speed they part with [m/s];
/// error of that speed over 8 m/s, or of the place of one over its way, the larger.
CaseResult head_on(const Settings& settings, double restitution);

/// A stack of n cubes that has had `settling_s` to press itself together: largest movement of a
/// cube in the 4 s after [m].
CaseResult stack_stands(const Settings& settings, int n, double settling_s);

/// A cube of 10 m on four cubes of 0.1 m, 1e6 times lighter, for 2 s: largest movement [m].
CaseResult large_on_small(const Settings& settings);

}  // namespace talus::cases
