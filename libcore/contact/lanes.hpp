// libcore/contact/lanes.hpp
// Four doubles at a time, as the compiler's vector type: two SSE2 registers on any x86-64, one AVX
// register where a function is compiled for it, plain code elsewhere. The bits are the same.
#pragma once

namespace talus {

/// Arithmetic and comparison by lane; a scalar operand counts for each lane.
using Lanes __attribute__((vector_size(32), aligned(8), may_alias)) = double;

/// The four doubles from `first` on. References, since passing lanes by value is bound to the ABI.
[[gnu::always_inline]] inline const Lanes& lanes(const double* first) {
  return *reinterpret_cast<const Lanes*>(first);
}
[[gnu::always_inline]] inline Lanes& lanes(double* first) {
  return *reinterpret_cast<Lanes*>(first);
}

}  // namespace talus
