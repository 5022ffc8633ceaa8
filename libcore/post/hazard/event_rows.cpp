// Passages as hazard classes count them: rows by cell and run.
#include "post/hazard/event_rows.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
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

// Calls take(cell, begin, end) for the cells that a line of `length` across a heading, over the
// middle of a cell, is in from `begin` to `end` along itself, 0 in its middle; all in cell sizes.
template <class Take>
void for_each_across(std::uint32_t cell, const PassageGrid& grid, double heading, double length,
                     Take&& take) {
  const auto n_cols = static_cast<std::uint32_t>(grid.n_cols);
  const std::array<double, 2> middle = {cell % n_cols + 0.5, cell / n_cols + 0.5};  // column, row
  const std::array<double, 2> along = {-std::sin(heading), -std::cos(heading)};
  for (double t = -length / 2; t < length / 2;) {
    double end = length / 2;
    for (std::size_t k = 0; k < 2; ++k) {
      constexpr double rounding = 1e-9;  // a border so near has been crossed
      const double at = middle[k] + (t + rounding) * along[k];
      const double border = along[k] > 0 ? std::floor(at) + 1 : std::ceil(at) - 1;
      if (along[k] != 0)
        end = std::min(end, std::max((border - middle[k]) / along[k], t + rounding));
    }
    const double col = std::floor(middle[0] + (t + end) / 2 * along[0]);
    const double row = std::floor(middle[1] + (t + end) / 2 * along[1]);
    if (col >= 0 && col < grid.n_cols && row >= 0 && row < grid.n_rows)
      take(static_cast<std::uint32_t>(row) * n_cols + static_cast<std::uint32_t>(col), t, end);
    t = end;
  }
}

// A row of a cell on a line across the path of its rock. Lengths in cell sizes.
struct RowAcross {
  EventRow row;
  double length = 0;   // of the line in the cell
  double reached = 0;  // part of it from where the rock hits what is centred there
};

bool is_before(const RowAcross& a, const RowAcross& b) {
  return std::tie(a.row.cell, a.length, a.reached) < std::tie(b.row.cell, b.length, b.reached);
}

double size_of(double volume) { return std::cbrt(6 * volume / std::numbers::pi); }

// A line across a path, in cell sizes: the part that the rock hits from, and all of it. Each end is
// longer by what passages of one rock may lie beside each other, so that a cell which one of its
// lines reaches is crossed by the others too.
struct LineAcross {
  double reach = 0, length = 0;
};
LineAcross line_across(const PassageGrid& grid, double volume, double width, double cell_width) {
  const double rock = size_of(volume) / grid.cell_size, reach = width / grid.cell_size + rock;
  return {reach, reach + 2 * (rock + cell_width)};
}

// Rows of a rock beside one of its passages, for what is `width` wide [m] and centred on a cell.
// The passages say which cells it crossed, not where: lines over them, as long as the width and the
// rock, reach all of a cell, a part, or nothing.
void add_across(const EventRow& row, double heading, const PassageGrid& grid, double volume,
                double width, std::vector<RowAcross>& across) {
  if (std::isnan(heading)) {  // at rest
    across.push_back({row, 1, 1});
    return;
  }
  const LineAcross line = line_across(grid, volume, width, cell_width_across(heading));
  RowAcross made{row};
  for_each_across(
      row.cell, grid, heading, line.length, [&](std::uint32_t cell, double begin, double end) {
        made.row.cell = cell;
        made.length = end - begin;
        made.reached =
            std::max(0.0, std::min(end, line.reach / 2) - std::max(begin, -line.reach / 2));
        across.push_back(made);
      });
}

// One row of each cell: its weight is the share of the lines over it that is reached.
void take_merged(std::vector<RowAcross>& across, const TakeEvent& take) {
  std::sort(across.begin(), across.end(), is_before);
  for (std::size_t i = 0; i < across.size();) {
    EventRow made = across[i].row;
    made.energy = made.intensity = 0;
    double length = 0, reached = 0;
    for (; i < across.size() && across[i].row.cell == made.cell; ++i) {
      length += across[i].length;
      reached += across[i].reached;
      if (across[i].reached == 0) continue;
      made.energy = std::max(made.energy, across[i].row.energy);
      made.intensity = std::max(made.intensity, across[i].row.intensity);
    }
    made.weight *= reached / length;
    if (reached > 0) take(made);
  }
  across.clear();
}

std::vector<std::uint32_t> by_block(const std::vector<MapRow>& rows) {
  std::vector<std::uint32_t> order(rows.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&rows](std::uint32_t a, std::uint32_t b) {
    return std::tie(rows[a].block, rows[a].cell) < std::tie(rows[b].block, rows[b].cell);
  });
  return order;
}

}  // namespace

bool blocks_are_events(const RunInfo& run, int n_released) {
  return n_released == 1 || run.independent || run.weights_are_frequencies;
}

void event_rows(const std::vector<MapRow>& rows, const PassageGrid& grid, const RunBlocks& blocks,
                const Recipe& recipe, const EventSource& of, const TakeEvent& take) {
  const double released = std::accumulate(blocks.volume.begin(), blocks.volume.end(), 0.0);
  const bool is_mass =
      !of.run.info.independent && recipe.mass_volume > 0 && released > recipe.mass_volume;
  const std::vector<bool> company =
      is_mass ? is_in_company(rows, recipe.alone_s) : std::vector<bool>(rows.size(), false);
  // the least value of that intensity: the breaks are exceeded, not met
  const float least =
      recipe.mass_intensity == 0
          ? 0
          : std::nextafter(static_cast<float>(
                               recipe.breaks[static_cast<std::size_t>(recipe.mass_intensity - 1)]),
                           std::numeric_limits<float>::infinity());
  const auto row_of = [&](std::size_t i) -> EventRow {
    const MapRow& row = rows[i];
    const float own = intensity_of(row, blocks, recipe.by);
    const double weight =
        blocks.weight.empty() ? 1 : blocks.weight[static_cast<std::size_t>(row.block)];
    return {row.cell,
            of.index,
            row.block,
            row.largest.total_energy / 1e3F,
            company[i] ? std::max(own, least) : own,
            weight * of.run.run_weight};
  };
  if (!of.of_rocks || recipe.width == 0) {
    for (std::size_t i = 0; i < rows.size(); ++i) take(row_of(i));
    return;
  }
  std::vector<RowAcross> across;
  const std::vector<std::uint32_t> order = by_block(rows);
  for (std::size_t k = 0; k < order.size(); ++k) {
    const MapRow& row = rows[order[k]];
    add_across(row_of(order[k]), row.heading, grid,
               blocks.volume[static_cast<std::size_t>(row.block)], recipe.width, across);
    if (k + 1 == order.size() || rows[order[k + 1]].block != row.block) take_merged(across, take);
  }
}

int cells_beside(const PassageGrid& grid, const RunBlocks& blocks, const Recipe& recipe,
                 bool of_rocks) {
  if (blocks.volume.empty() || !of_rocks || recipe.width == 0) return 0;
  const double largest = *std::max_element(blocks.volume.begin(), blocks.volume.end());
  return 1 + static_cast<int>(line_across(grid, largest, recipe.width, 2).length / 2);
}

void sort_events(std::vector<EventRow>& rows) {
  std::sort(rows.begin(), rows.end(), [](const EventRow& a, const EventRow& b) {
    return std::tie(a.cell, a.run, a.energy, a.intensity, a.weight, a.block) <
           std::tie(b.cell, b.run, b.energy, b.intensity, b.weight, b.block);
  });
}

}  // namespace talus
