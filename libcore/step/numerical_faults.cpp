// Notes the first block that failed to converge, became infinite, left the terrain or fell through.
#include "step/numerical_faults.hpp"

#include <algorithm>
#include <cmath>

#include "step/flight.hpp"

namespace talus {
namespace {

using std::size_t;

void note(const Scene& scene, const State& state, int block, NumericalFault& fault) {
  fault.block = block;
  fault.time = state.time;
  fault.place = motion_at(scene, state, block, state.time).pose.position;
}

// The first block of a phase.
int first_in(const State& state, Phase phase) {
  return static_cast<int>(std::find(state.phase.begin(), state.phase.end(), phase) -
                          state.phase.begin());
}

// The block whose centroid is farthest below the ground under it.
int lowest_block(const Scene& scene, const State& state) {
  const Trn& trn = scene.ground.trn;
  int lowest = 0;
  double most = -INFINITY;
  for (int b = 0; b < n_blocks(scene); ++b) {
    const Vec3 at = motion_at(scene, state, b, state.time).pose.position;
    if (!takes_part(state.phase[static_cast<size_t>(b)]) || !contains(trn, at.x(), at.y()))
      continue;
    const double below = elevation_at(trn, at.x(), at.y()) - at.z();
    if (below > most) lowest = b;
    most = std::max(most, below);
  }
  return lowest;
}

}  // namespace

void note_numerical_faults(const Scene& scene, const StepReport& report, State& state) {
  NumericalFaults& numerical_faults = state.numerical_faults;
  const auto is_first = [](bool happened, const NumericalFault& fault) {
    return happened && fault.block < 0;
  };
  if (is_first(report.n_unconverged > 0, numerical_faults.unconverged))
    note(scene, state, report.unconverged_block, numerical_faults.unconverged);
  if (is_first(has(report.flags, StepFlag::not_finite), numerical_faults.not_finite))
    note(scene, state, first_in(state, Phase::stopped), numerical_faults.not_finite);
  if (is_first(has(report.flags, StepFlag::left_domain), numerical_faults.left_domain))
    note(scene, state, first_in(state, Phase::left_domain), numerical_faults.left_domain);
  if (is_first(has(report.flags, StepFlag::fell_through), numerical_faults.fell_through))
    note(scene, state, lowest_block(scene, state), numerical_faults.fell_through);
}

}  // namespace talus
