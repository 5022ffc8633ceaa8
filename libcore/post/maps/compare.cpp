// Difference of two ensembles of runs, cell by cell, with 95 % intervals.
#include "post/maps/compare.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <span>

#include "base/numbers.hpp"
#include "post/percentile_bounds.hpp"

namespace talus {
namespace {

struct Compared {
  const char *name, *unit;
  float PassageValues::*member;
  double scale;
};
constexpr std::array<Compared, 3> quantities = {
    {{"velocity", "m/s", &PassageValues::speed, 1},
     {"ke_total", "kJ", &PassageValues::total_energy, 1e-3},
     {"pass_height_top", "m", &PassageValues::top_height, 1}}};
struct Level {
  const char* name;
  double p;
};
constexpr std::array<Level, 2> levels = {{{"p50", 0.5}, {"p95", 0.95}}};

// One side, read cell by cell in ascending order.
struct Side {
  explicit Side(const ComparedRuns& of) : ensemble(of), bounds{of.basis.clusters, 200} {}

  const ComparedRuns& ensemble;
  PercentileBounds bounds;
  std::size_t next = 0;  // the first touched cell that was not passed by

  std::span<const MapRow> rows_at(std::uint32_t cell) {
    const CellRows& cells = ensemble.cells;
    while (next < cells.cell.size() && cells.cell[next] < cell) ++next;
    if (next == cells.cell.size() || cells.cell[next] != cell) return {};
    return std::span(cells.rows)
        .subspan(cells.begin[next], cells.begin[next + 1] - cells.begin[next]);
  }
};

std::vector<BlockWeight> blocks_of(std::span<const MapRow> rows) {
  std::vector<BlockWeight> blocks;
  for (const MapRow& row : rows) blocks.push_back({row.run, row.block, row.weight});
  return blocks;
}

Estimate reach_of(const Side& side, std::span<const BlockWeight> blocks) {
  const ShareBasis& basis = side.ensemble.basis;
  double weight = 0;
  for (const BlockWeight& block : blocks) weight += block.weight;
  const double share = std::min(1.0, weight / basis.over.whole);
  const Interval interval = share_interval(basis, blocks, share);
  return {share, interval.low, interval.high};
}

Difference reach_difference(const Side& a, std::span<const MapRow> rows_a, const Side& b,
                            std::span<const MapRow> rows_b, const RunPairs& pairs) {
  const std::vector<BlockWeight> blocks_a = blocks_of(rows_a), blocks_b = blocks_of(rows_b);
  const double whole = a.ensemble.basis.over.whole;
  Estimate of_b = reach_of(b, blocks_b);
  if (pairs.n_runs > 0) {
    const double left = b.ensemble.basis.over.whole / whole;
    of_b = {left * of_b.value, left * of_b.low, left * of_b.high};
  }
  Difference out = difference(reach_of(a, blocks_a), of_b);
  if (pairs.n_runs == 0) return out;
  const PairedDifference paired = paired_difference(pairs, blocks_a, blocks_b);
  if (paired.n_differ < least_clusters || std::isnan(paired.interval.low)) return out;
  const double scale = pairs.n_runs / whole;  // of an amount a run to a share
  out.low = std::max(-1.0, scale * paired.interval.low);
  out.high = std::min(1.0, scale * paired.interval.high);
  return out;
}

Estimate percentile_of(Side& side, std::span<const MapRow> rows, const Compared& quantity,
                       double p) {
  struct Item {
    float value;
    BlockWeight block;
  };
  std::vector<Item> items;
  for (const MapRow& row : rows) {
    const float value = row.largest.*quantity.member;
    if (!std::isnan(value) && row.weight > 0)
      items.push_back({value, {row.run, row.block, row.weight}});
  }
  std::sort(items.begin(), items.end(), [](const Item& a, const Item& b) {
    return a.value != b.value ? a.value < b.value : a.block.weight < b.block.weight;
  });
  std::vector<BlockWeight> blocks;
  for (const Item& item : items) blocks.push_back(item.block);
  const BoundedPlaces places = percentile_places(side.bounds, blocks, p);
  const auto value_at = [&](int place) {
    return place < 0 ? no_value : static_cast<double>(items[place].value) * quantity.scale;
  };
  return {value_at(places.place), value_at(places.low), value_at(places.high)};
}

void add_bands(MapLayer& layer, const std::string& name, const std::string& unit,
               const std::string& what) {
  const std::size_t n = layer.cell.size();
  const auto add = [&](const std::string& end, const std::string& begin) {
    layer.bands.push_back({name + end, unit, begin + what, false,
                           std::vector<float>(n, std::numeric_limits<float>::quiet_NaN()),
                           OverviewValue::farthest_from_zero});
  };
  add("", "");
  add("_lo", "lower bound of the 95 % interval of the ");
  add("_hi", "upper bound of the 95 % interval of the ");
}

void put(MapLayer& layer, std::size_t band, std::size_t cell, const Difference& d) {
  layer.bands[band].value[cell] = static_cast<float>(d.value);
  layer.bands[band + 1].value[cell] = static_cast<float>(d.low);
  layer.bands[band + 2].value[cell] = static_cast<float>(d.high);
}

}  // namespace

Difference difference(const Estimate& a, const Estimate& b) {
  const double d = b.value - a.value;
  return {d, d - std::hypot(b.value - b.low, a.high - a.value),
          d + std::hypot(b.high - b.value, a.value - a.low)};
}

MapLayer comparison_layer(const ComparedRuns& a, const ComparedRuns& b, const RunPairs& pairs) {
  MapLayer layer{"compare", {}, {}};
  std::set_union(a.cells.cell.begin(), a.cells.cell.end(), b.cells.cell.begin(), b.cells.cell.end(),
                 std::back_inserter(layer.cell));
  add_bands(
      layer, "reach_probability_difference", "1",
      "weight of the blocks that crossed the cell / weight of all released blocks: that of these "
      "runs minus that of the runs compared with");
  for (const Compared& quantity : quantities)
    for (const Level& level : levels)
      add_bands(layer, std::string(quantity.name) + "_" + level.name + "_difference", quantity.unit,
                std::string(level.name) + " of " + quantity.name +
                    " over the blocks that crossed the cell: that of these runs minus that of the "
                    "runs compared with");
  Side side_a(a), side_b(b);
  for (std::size_t i = 0; i < layer.cell.size(); ++i) {
    const auto rows_a = side_a.rows_at(layer.cell[i]), rows_b = side_b.rows_at(layer.cell[i]);
    std::size_t band = 0;
    put(layer, band, i, reach_difference(side_a, rows_a, side_b, rows_b, pairs));
    for (const Compared& quantity : quantities)
      for (const Level& level : levels)
        put(layer, band += 3, i,
            difference(percentile_of(side_a, rows_a, quantity, level.p),
                       percentile_of(side_b, rows_b, quantity, level.p)));
  }
  return layer;
}

}  // namespace talus
