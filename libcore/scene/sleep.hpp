// libcore/scene/sleep.hpp: public
// Loads of blocks asleep, and how blocks wake.
// docs/theory/theory.md, "Blocks asleep"
#pragma once

#include <span>
#include <vector>

#include "scene/state.hpp"

namespace talus {

/// Load of block b when it fell asleep, by neighbour.
[[nodiscard]] std::span<const SleepLoad> carried_by(const State& state, int b);
/// Notes a load on a block that falls asleep: added to its load from that neighbour.
void note_carried(const SleepLoad& load, State& state);

/// Wakes block b, which sleeps, at `time`, and all that bonds hold it to; adds them to `woken`.
void wake_bonded(int b, double time, State& state, std::vector<int>& woken);
inline void wake_bonded(int b, double time, State& state) {
  std::vector<int> woken;
  wake_bonded(b, time, state, woken);
}

}  // namespace talus
