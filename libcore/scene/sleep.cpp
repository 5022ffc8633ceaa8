// Loads that sleeping blocks carry, and waking.
#include "scene/sleep.hpp"

#include <algorithm>
#include <utility>

namespace talus {
namespace {

using std::size_t;

bool is_before(const SleepLoad& a, const SleepLoad& b) {
  return std::pair(a.block, a.by) < std::pair(b.block, b.by);
}

auto range_of(const std::vector<SleepLoad>& loads, int b) {
  const auto of_block = [](const SleepLoad& x, const SleepLoad& y) { return x.block < y.block; };
  SleepLoad of;
  of.block = b;
  return std::equal_range(loads.begin(), loads.end(), of, of_block);
}

}  // namespace

std::span<const SleepLoad> carried_by(const State& state, int b) {
  const auto [begin, end] = range_of(state.carried, b);
  return {begin, end};
}

void note_carried(const SleepLoad& load, State& state) {
  const auto at = std::lower_bound(state.carried.begin(), state.carried.end(), load, is_before);
  if (at == state.carried.end() || is_before(load, *at))
    state.carried.insert(at, load);
  else
    at->load += load.load;
}

void wake_bonded(int b, double time, State& state, std::vector<int>& woken) {
  wake(state, static_cast<size_t>(b), time);
  woken.push_back(b);
  const auto [begin, end] = range_of(state.carried, b);
  state.carried.erase(begin, end);
  const auto wake_other = [&](int one, int other) {
    if (one == b && phase_of(state, other) == Phase::asleep) wake_bonded(other, time, state, woken);
  };
  for (const BlockBond& bond : state.bonds) {
    if (!(bond.area > 0)) continue;
    wake_other(bond.block_a, bond.block_b);
    wake_other(bond.block_b, bond.block_a);
  }
}

}  // namespace talus
