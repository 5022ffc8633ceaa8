// verify/cases/stem_case.hpp
// A stem of a tree that stops a block, or breaks; a forest that drags.
#pragma once

#include "verify/cases/closed_form.hpp"

namespace talus::cases {

/// A cube of 500 kg slides on a smooth plane into the middle of a stem of 91.111 kJ at 10, 15, 20
/// and 25 m/s: largest error of its speed behind the stem, v'^2 = v^2 - 2 E / m or 0, relative to
/// the speed before.
CaseResult stem(const CaseSettings& settings);

/// A cube of 1000 kg flies at 15 m/s without gravity through a forest that drags by 500 kg/s, 40 s:
/// relative error of its path, m v / d = 30 m.
CaseResult dragged_flight(const CaseSettings& settings);

}  // namespace talus::cases
