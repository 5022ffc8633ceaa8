// libcore/solver/mass_sweeps.hpp
// Data that a pass over all batches of a mass reads and changes: the seam between the solver and
// its lanes of four (mass_solver.cpp) or eight (mass_solver_avx2.cpp).
#pragma once

#include <cstdint>
#include <span>

#include "solver/mass_rows.hpp"

namespace talus {

/// `fill`: rows into points; `apply`: their impulses as they are; `sweep`: solves point by point;
/// `empty`: impulses back into the rows.
enum class MassPass : std::uint8_t { fill, apply, sweep, empty };

struct MassSweeps {
  std::span<const MassBatch> batches;
  MassPoint* points;
  MassRow* rows;
  MassBody* change;
  const MassInertia* inertia;
  const MassRow& no_row;   ///< row of lanes that have none
  float compliance;        ///< W_n D_n = 1 / compliance
  float shear_compliance;  ///< W_n D_t = 1 / shear_compliance
};

void run_by_four(const MassSweeps& sweeps, MassPass pass);
/// The same where the processor has AVX2 (mass_solver_avx2.cpp).
void run_by_eight(const MassSweeps& sweeps, MassPass pass);
[[nodiscard]] bool has_eight_mass_lanes();

}  // namespace talus
