// libcore/step/deep_blocks.hpp: public
// Blocks that are in the ground, in another block or in a fence by more than a tenth of their
// thickness at the end of a step.
// in:    blocks with a contact that says so (DeepWork::is_suspect), motion at the end of the step
// out:   State::deep, and the largest overlap of the step
//
// A contact only raises the suspicion: along its own normal a block that has turned or gone round a
// corner seems to be in where it is not. The overlap of the two bodies counts.
#pragma once

#include "scene/scene.hpp"
#include "scene/state.hpp"
#include "solver/law_numbers.hpp"
#include "step/deep_work.hpp"
#include "step/report.hpp"

namespace talus {

/// Scratch for the blocks of a scene, so that a step asks for no memory.
[[nodiscard]] DeepWork make_deep_work(const Scene& scene);

/// Takes a contact that presses, or holds an overlap that presses nothing, into the report.
/// `block`: the thinner of its two.
inline void note_overlap(int block, double overlap, double thickness, DeepWork& deep,
                         StepReport& report) {
  if (overlap > law::shallow * thickness) {
    deep.is_suspect[block] = 1;
  } else if (overlap > report.largest_penetration) {
    report.largest_penetration = overlap;
    report.deepest_block = block;
  }
}

/// Measures the suspects of the step that has just ended at state.time; the deepest of the run so
/// far goes into state.numerical_faults.
void note_deep_blocks(const Scene& scene, State& state, DeepWork& w, StepReport& report);

}  // namespace talus
