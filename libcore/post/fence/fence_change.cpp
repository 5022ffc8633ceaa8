// Maps and volumes of what a fence changes: deposit and passages with it minus without it.
#include "post/fence/fence_change.hpp"

#include <algorithm>
#include <set>

namespace talus {
namespace {

template <class Map>
double value_at(const Map& values, std::uint32_t cell) {
  const auto at = values.find(cell);
  return at == values.end() ? 0 : at->second;
}

// Cutting at the cells' sides leaves rounding, of either sign, where a block does not reach.
double volume_at(const GroundSums& sums, std::uint32_t cell) {
  return sums.n_runs > 0 ? std::max(0.0, value_at(sums.deposit.volume, cell)) / sums.n_runs : 0;
}

std::set<std::uint32_t> cells_of(const GroundSums& with, const GroundSums& without) {
  std::set<std::uint32_t> cells;
  for (const GroundSums* side : {&with, &without}) {
    for (const auto& [cell, volume] : side->deposit.volume) cells.insert(cell);
    for (const auto& [cell, speed] : side->speed) cells.insert(cell);
  }
  return cells;
}

}  // namespace

void add_run(GroundSums& sums, const PassageGrid& grid, const RunFile& run, double rest_speed) {
  ++sums.n_runs;
  add_deposit(sums.deposit, grid, run, rest_speed);
  add_speeds(sums, run.passages);
}

void add_speeds(GroundSums& sums, std::span<const Passage> passages) {
  for (const Passage& passage : passages) {
    float& speed = sums.speed[static_cast<std::uint32_t>(passage.cell)];
    speed = std::max(speed, passage.largest.speed);
  }
}

MapLayer change_layer(const GroundSums& with, const GroundSums& without, double cell_size) {
  MapLayer layer{"fence_change", {}, {}};
  layer.bands = {
      {"deposit_thickness_change",
       "m",
       "volume of the blocks at rest over the cell / cell area, mean over the runs: with "
       "the fences minus without",
       true,
       {},
       OverviewValue::farthest_from_zero},
      {"velocity_max_change",
       "m/s",
       "largest centroid speed of any block over the cell (0: none came): with the "
       "fences minus without",
       true,
       {},
       OverviewValue::farthest_from_zero}};
  for (const std::uint32_t cell : cells_of(with, without)) {
    layer.cell.push_back(cell);
    const double volume = volume_at(with, cell) - volume_at(without, cell);
    layer.bands[0].value.push_back(static_cast<float>(volume / (cell_size * cell_size)));
    layer.bands[1].value.push_back(
        static_cast<float>(value_at(with.speed, cell) - value_at(without.speed, cell)));
  }
  return layer;
}

DepositChange deposit_change(const GroundSums& with, const GroundSums& without) {
  DepositChange change;
  for (const std::uint32_t cell : cells_of(with, without)) {
    const double a = volume_at(with, cell), b = volume_at(without, cell);
    change.with += a;
    change.without += b;
    change.more += std::max(0.0, a - b);
    change.less += std::max(0.0, b - a);
  }
  return change;
}

}  // namespace talus
