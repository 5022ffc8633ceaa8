// libcore/contact/lanes.hpp
// Two doubles at a time, as the compiler's vector type: a register of any x86-64 or arm64. (Four at
// a time were split through the stack where the processor has no such register: ten times slower.)
#pragma once

namespace talus {

/// Arithmetic and comparison by lane; a scalar operand counts for each lane.
using Lanes __attribute__((vector_size(16), aligned(8), may_alias)) = double;

inline constexpr int n_lanes = 2;

/// The doubles from `first` on.
[[gnu::always_inline]] inline const Lanes& lanes(const double* first) {
  return *reinterpret_cast<const Lanes*>(first);
}
[[gnu::always_inline]] inline Lanes& lanes(double* first) {
  return *reinterpret_cast<Lanes*>(first);
}

}  // namespace talus
