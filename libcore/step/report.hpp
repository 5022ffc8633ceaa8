// libcore/step/report.hpp: public
// Report of one step: its numbers for the health record, and trouble as bits.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace talus {

/// Bits, since several can happen at once. Counted per run in the run record; never hidden.
enum class StepFlag : unsigned {
  none = 0,
  unconverged = 1,   ///< a block's contact forces did not converge at the shortest step
  not_finite = 2,    ///< NaN or infinity: the block was stopped at its last good state
  left_domain = 4,   ///< a block left the known terrain and was stopped
  fell_through = 8,  ///< a block lies wholly below the ground under it
  deep = 16,         ///< a block is in something by more than a tenth of its thickness
};

[[nodiscard]] inline StepFlag operator|(StepFlag a, StepFlag b) {
  return static_cast<StepFlag>(static_cast<unsigned>(a) | static_cast<unsigned>(b));
}
[[nodiscard]] inline bool has(StepFlag flags, StepFlag flag) {
  return (static_cast<unsigned>(flags) & static_cast<unsigned>(flag)) != 0;
}

/// Why a substep is made again.
enum class SubstepCut : std::uint8_t {
  yielding_touched,  ///< a yielding fixed body is first touched within it: ends there
  unconverged,       ///< its forces did not converge: half
  deep,              ///< a block would end deep in something: ends after the hit that does it
  hit,               ///< a contact of a small island closes within it: ends there
  inaccurate,        ///< its forces change by more than Settings::accuracy allows: shorter
  bond_broken,       ///< a bond carries more than it holds: the same without it
  woken,             ///< the load on a sleeping block has changed: with it awake
  yielding_used_up,  ///< a yielding body has taken all that it can: ends there
};
inline constexpr std::array<const char*, 8> substep_cut_names = {
    "yielding_touched", "unconverged", "deep",  "hit",
    "inaccurate",       "bond_broken", "woken", "yielding_used_up"};

struct StepReport {
  StepFlag flags = StepFlag::none;
  int passes = 0;     ///< iterations, summed over blocks and substeps
  int substeps = 0;   ///< block steps with contact search
  int n_closed = 0;   ///< contacts that press at the end of the step
  int n_flips = 0;    ///< contacts that opened, closed, or went from stick to slip or back; not in
                      ///< islands of law talus
  int n_impacts = 0;  ///< impact events
  int n_unconverged = 0;       ///< block steps accepted without convergence
  int unconverged_block = -1;  ///< first of them; of an island the heaviest block
  int deepest_block = -1;      ///< with largest_penetration
  /// Overlap of contacts that press, or hold one that presses nothing, at the end of the step; of
  /// those that say that a block is deep: of the bodies (step/deep_blocks.hpp) [m].
  double largest_penetration = 0;
  double sum_penetration = 0;  ///< over contacts that press [m]
  /// Substeps of islands of law talus that were made again, by SubstepCut.
  std::array<int, substep_cut_names.size()> cuts{};
  /// Largest error estimated of a substep that was accepted, as a share of the displacement (step/
  /// accuracy.hpp) [-].
  double largest_error = 0;
  double shortest_dt = 0;  ///< shortest substep; 0 when no block searched contact [s]
};

/// A step of `block` is accepted without convergence.
inline void note_unconverged(int block, StepReport& report) {
  if (report.n_unconverged == 0) report.unconverged_block = block;
  ++report.n_unconverged;
}

}  // namespace talus
