// Passages as hazard classes count them: rows by cell and run.
#include "post/hazard/event_rows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

namespace talus {
namespace {

// Blocks that came over a cell within so short a time of another one.
std::vector<bool> is_in_company(const std::vector<MapRow>& rows, double alone_s) {
  std::vector<std::uint32_t> order(rows.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&rows](std::uint32_t a, std::uint32_t b) {
    return std::tie(rows[a].cell, rows[a].first_time, rows[a].block) <
           std::tie(rows[b].cell, rows[b].first_time, rows[b].block);
  });
  std::vector<bool> company(rows.size(), false);
  for (std::size_t i = 1; i < order.size(); ++i) {
    const MapRow &before = rows[order[i - 1]], &row = rows[order[i]];
    if (row.cell == before.cell && row.first_time - before.first_time < alone_s)
      company[order[i - 1]] = company[order[i]] = true;
  }
  return company;
}

float intensity_of(const MapRow& row, const RunBlocks& blocks, IntensityBy by) {
  switch (by) {
    case IntensityBy::reach:
    case IntensityBy::total_energy:
      return row.largest.total_energy / 1e3F;
    case IntensityBy::translational_energy:
      return row.largest.translational_energy / 1e3F;
    case IntensityBy::block_volume:
      break;
  }
  return static_cast<float>(blocks.volume[static_cast<std::size_t>(row.block)]);
}

}  // namespace

std::vector<EventRow> event_rows(const std::vector<MapRow>& rows, const RunBlocks& blocks,
                                 const Recipe& recipe, const RunMember& run, int index) {
  const double released = std::accumulate(blocks.volume.begin(), blocks.volume.end(), 0.0);
  const bool is_mass =
      !run.info.independent && recipe.mass_volume > 0 && released > recipe.mass_volume;
  const std::vector<bool> company =
      is_mass ? is_in_company(rows, recipe.alone_s) : std::vector<bool>(rows.size(), false);
  // the least value of that intensity: the breaks are exceeded, not met
  const float least =
      recipe.mass_intensity == 0
          ? 0
          : std::nextafter(static_cast<float>(
                               recipe.breaks[static_cast<std::size_t>(recipe.mass_intensity - 1)]),
                           std::numeric_limits<float>::infinity());
  std::vector<EventRow> out;
  out.reserve(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const MapRow& row = rows[i];
    const float own = intensity_of(row, blocks, recipe.by);
    const double weight =
        blocks.weight.empty() ? 1 : blocks.weight[static_cast<std::size_t>(row.block)];
    out.push_back({row.cell, index, row.block, row.largest.total_energy / 1e3F,
                   company[i] ? std::max(own, least) : own, weight * run.run_weight});
  }
  return out;
}

void sort_events(std::vector<EventRow>& rows) {
  std::sort(rows.begin(), rows.end(), [](const EventRow& a, const EventRow& b) {
    return std::tie(a.cell, a.run, a.energy, a.intensity, a.weight, a.block) <
           std::tie(b.cell, b.run, b.energy, b.intensity, b.weight, b.block);
  });
}

}  // namespace talus
