// Eight lanes of a mass at a time, for processors with AVX2. Inline functions of headers are shared
// with other files and must run everywhere, so they come before the pragma.
#include <cmath>
#include <span>

#include "solver/mass_numbers.hpp"
#include "solver/mass_sweeps.hpp"

#if defined(__x86_64__) && !defined(__clang__)
#pragma GCC target("avx2")
#pragma GCC diagnostic ignored "-Wpsabi"  // vectors of eight are passed within this file alone
#define TALUS_EIGHT_LANES
#include "solver/mass_lanes.hpp"

namespace talus {

bool has_eight_mass_lanes() {
  static const bool has = __builtin_cpu_supports("avx2") != 0;
  return has;
}

[[gnu::flatten]] void run_by_eight(const MassSweeps& sweeps, MassPass pass) {
  run_in_lanes<EightFloats>(sweeps, pass);
}

}  // namespace talus
#else
namespace talus {

bool has_eight_mass_lanes() { return false; }
void run_by_eight(const MassSweeps& sweeps, MassPass pass) { run_by_four(sweeps, pass); }

}  // namespace talus
#endif
