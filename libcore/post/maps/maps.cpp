// Bands of hazard maps: reach, energy, height, speed and more over each cell.
#include "post/maps/maps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "base/error.hpp"
#include "base/units.hpp"
#include "post/percentile_bounds.hpp"

namespace talus {
namespace {

constexpr float none = std::numeric_limits<float>::quiet_NaN();

// How a quantity is read from a passage, and the texts of its bands.
struct QuantityText {
  MapQuantity quantity;
  float PassageValues::*member;
  double scale;  // from the passage's unit to the band's
  const char *unit, *what;
};
constexpr std::array<QuantityText, 5> quantity_texts = {{
    {MapQuantity::speed, &PassageValues::speed, 1, "m/s",
     "largest centroid speed of a block while any part of it is over the cell"},
    {MapQuantity::translational_energy, &PassageValues::translational_energy, 1e-3, "kJ",
     "largest m v^2 / 2 of a block while any part of it is over the cell"},
    {MapQuantity::total_energy, &PassageValues::total_energy, 1e-3, "kJ",
     "largest m v^2 / 2 + w' I w / 2 of a block while any part of it is over the cell"},
    {MapQuantity::centroid_height, &PassageValues::centroid_height, 1, "m",
     "largest vertical height of a block's centroid above the ground while any part of the block "
     "is over the cell"},
    {MapQuantity::top_height, &PassageValues::top_height, 1, "m",
     "largest vertical height of a block's highest vertex above the ground below its centroid "
     "while any part of the block is over the cell"},
}};

const QuantityText& text_of(MapQuantity quantity) {
  return *std::find_if(quantity_texts.begin(), quantity_texts.end(),
                       [quantity](const QuantityText& t) { return t.quantity == quantity; });
}

std::span<const MapRow> rows_of(const CellRows& cells, std::size_t i) {
  return std::span(cells.rows).subspan(cells.begin[i], cells.begin[i + 1] - cells.begin[i]);
}

// The values of one quantity in one cell, ascending, with the running sum of their weights.
struct CellSample {
  struct Item {
    float value, weight;
    std::int32_t run, block;
  };
  std::vector<Item> items;
  std::vector<BlockWeight> blocks;  // of the items
  std::vector<double> weight_up_to;
  double mean = 0, n_eff = 0;

  void fill(std::span<const MapRow> rows, float PassageValues::*member) {
    items.clear();
    double total = 0, total_sq = 0, moment = 0;
    for (const MapRow& row : rows) {
      const float value = row.largest.*member;
      if (std::isnan(value) || !(row.weight > 0)) continue;
      items.push_back({value, row.weight, row.run, row.block});
      total += row.weight;
      total_sq += static_cast<double>(row.weight) * row.weight;
      moment += static_cast<double>(row.weight) * value;
    }
    mean = moment / total;
    n_eff = effective_size(total, total_sq);
    std::sort(items.begin(), items.end(), [](const Item& a, const Item& b) {
      return a.value != b.value ? a.value < b.value : a.weight < b.weight;
    });
    weight_up_to.resize(items.size());
    blocks.clear();
    double running = 0;
    for (std::size_t i = 0; i < items.size(); ++i) {
      weight_up_to[i] = running += items[i].weight;
      blocks.push_back({items[i].run, items[i].block, items[i].weight});
    }
  }

  // As weighted_percentile(), by bisection.
  [[nodiscard]] double percentile(double p) const {
    const double wanted = p * weight_up_to.back() * (1 - 1e-12);
    const auto at = std::lower_bound(weight_up_to.begin(), weight_up_to.end(), wanted);
    return items[std::min<std::size_t>(at - weight_up_to.begin(), items.size() - 1)].value;
  }
};

MapBand band(std::string name, std::string unit, std::string description, std::size_t n_touched,
             bool zero_elsewhere = false) {
  return {std::move(name), std::move(unit), std::move(description), zero_elsewhere,
          std::vector<float>(n_touched, none)};
}

MapLayer empty_quantity_layer(const std::string& name, const QuantityText& text,
                              const CellRows& cells) {
  MapLayer layer{name, cells.cell, {}};
  const std::string what = text.what;
  const auto add = [&](const std::string& statistic, const std::string& description) {
    layer.bands.push_back(band(name + "_" + statistic, text.unit, description, cells.cell.size()));
  };
  add("mean", "weighted mean over blocks of the " + what);
  for (const PercentileLevel& p : percentile_levels)
    add(p.name, std::string("weighted ") + p.name + " over blocks of the " + what +
                    "; nodata where too few blocks passed for it");
  add("max", "maximum over blocks of the " + what);
  for (const PercentileLevel& p : percentile_levels)
    add(std::string(p.name) + "_hi", std::string("upper 95 % confidence bound of ") + p.name +
                                         "; nodata where the sample gives none");
  return layer;
}

// The blocks that came and `counts`, run by run; the share that they are.
template <class Test>
double take_blocks(std::span<const MapRow> rows, const ShareBasis& basis, const Test& counts,
                   std::vector<BlockWeight>& blocks) {
  blocks.clear();
  double weight = 0;
  for (const MapRow& row : rows) {
    if (!counts(row)) continue;
    blocks.push_back({row.run, row.block, row.weight});
    weight += row.weight;
  }
  return basis.over.whole > 0 ? std::min(1.0, weight / basis.over.whole) : 0;
}
bool all(const MapRow&) { return true; }

std::vector<MapBand> empty_reach_bands(std::size_t n) {
  return {
      band("n_pass", "1", "number of blocks of all runs that crossed the cell, each once", n, true),
      band("reach_probability", "1",
           "weight of the blocks that crossed the cell / weight of all released blocks", n, true),
      band("reach_probability_lo", "1",
           "lower bound of the 95 % interval of reach_probability; nodata where no block came "
           "and where there are too few runs",
           n),
      band("reach_probability_hi", "1",
           "upper bound of the 95 % interval of reach_probability; nodata where no block came "
           "and where there are too few runs",
           n),
      band("run_share", "1", "share of the runs in which any block crossed the cell", n, true),
      band("run_share_lo", "1",
           "lower bound of the 95 % interval of run_share; nodata where no block came", n),
      band("run_share_hi", "1",
           "upper bound of the 95 % interval of run_share; nodata where no block came: there it is "
           "the tag REACH_UPPER_BOUND_ELSEWHERE",
           n),
      band("passage_per_m", "1/m",
           "sum over crossing blocks of 1 / (width of the cell seen across the block's "
           "heading)",
           n, true),
      band("n_eff", "1", "(sum w)^2 / sum w^2 over the blocks that crossed the cell", n, true)};
}

}  // namespace

MapLayer quantity_layer(const std::string& name, const CellRows& cells, MapQuantity quantity,
                        const ShareBasis& basis, const MapSettings& settings) {
  const QuantityText& text = text_of(quantity);
  MapLayer layer = empty_quantity_layer(name, text, cells);
  constexpr std::size_t n_p = percentile_levels.size();
  PercentileBounds bounds{basis.clusters, 200};
  CellSample sample;
  for (std::size_t i = 0; i < cells.cell.size(); ++i) {
    sample.fill(rows_of(cells, i), text.member);
    if (sample.items.empty()) continue;
    const auto put = [&](std::size_t b, double value) {
      layer.bands[b].value[i] = static_cast<float>(value * text.scale);
    };
    put(0, sample.mean);
    put(1 + n_p, sample.items.back().value);
    const BoundPlaces upper = upper_bound_places(bounds, sample.blocks);
    for (std::size_t k = 0; k < n_p; ++k) {
      const double p = percentile_levels[k].p;
      const int needed = settings.min_passages > 0 ? settings.min_passages : smallest_sample(p);
      if (sample.n_eff + 1e-9 >= needed) put(1 + k, sample.percentile(p));
      if (upper[k] >= 0) put(2 + n_p + k, sample.items[upper[k]].value);
    }
  }
  return layer;
}

MapLayer reach_layer(const CellRows& cells, double cell_size, const ShareBasis& basis) {
  const std::size_t n = cells.cell.size();
  MapLayer layer{"", cells.cell, empty_reach_bands(n)};
  std::vector<BlockWeight> blocks;
  for (std::size_t i = 0; i < n; ++i) {
    const auto rows = rows_of(cells, i);
    double w = 0, w_sq = 0, per_m = 0;
    for (std::size_t k = 0; k < rows.size(); ++k) {
      w += rows[k].weight;
      w_sq += static_cast<double>(rows[k].weight) * rows[k].weight;
      per_m += 1 / (cell_width_across(rows[k].heading) * cell_size);
    }
    const double share = take_blocks(rows, basis, all, blocks);
    const Interval interval = share_interval(basis, blocks, share);
    const Interval of_runs = run_share_interval(basis, blocks);
    const std::array values = {
        static_cast<double>(rows.size()), share,       interval.low, interval.high,
        share_of_runs(basis, blocks),     of_runs.low, of_runs.high, per_m,
        effective_size(w, w_sq)};
    for (std::size_t b = 0; b < values.size(); ++b)
      layer.bands[b].value[i] = static_cast<float>(values[b]);
  }
  return layer;
}

double reach_bound_elsewhere(const ShareBasis& basis) {
  return run_share_interval(basis, 0.0).high;
}

RunsToAdd runs_to_add(const CellRows& cells, const ShareBasis& basis, double half) {
  std::vector<BlockWeight> blocks;
  if (!basis.bounded) return runs_to_add(basis, blocks, 0, half);
  RunsToAdd most;
  for (std::size_t i = 0; i < cells.cell.size(); ++i) {
    const double share = take_blocks(rows_of(cells, i), basis, all, blocks);
    if (share <= least_reach) continue;
    const RunsToAdd here = runs_to_add(basis, blocks, share, half);
    most = {std::max(most.n, here.n), most.help && here.help};
  }
  return most;
}

MapLayer exceedance_layer(const CellRows& cells, const ShareBasis& basis) {
  MapLayer layer{"", cells.cell, {}};
  const std::size_t n = cells.cell.size();
  std::vector<BlockWeight> blocks;
  for (const int limit_kj : {30, 300}) {
    const std::string name = "p_exceed_" + std::to_string(limit_kj) + "kJ";
    MapBand out =
        band(name, "1",
             "weight of the blocks whose kinetic energy with spin was above " +
                 std::to_string(limit_kj) + " kJ over the cell / weight of all released blocks",
             n, true);
    const char* const nodata = "; nodata where no block came and where there are too few runs";
    MapBand low =
                band(name + "_lo", "1", "lower bound of the 95 % interval of " + name + nodata, n),
            high =
                band(name + "_hi", "1", "upper bound of the 95 % interval of " + name + nodata, n);
    for (std::size_t i = 0; i < n; ++i) {
      const float limit = 1e3F * static_cast<float>(limit_kj);
      const double share = take_blocks(
          rows_of(cells, i), basis,
          [limit](const MapRow& r) { return r.largest.total_energy > limit; }, blocks);
      const Interval interval = share_interval(basis, blocks, share);
      out.value[i] = static_cast<float>(share);
      low.value[i] = static_cast<float>(interval.low);
      high.value[i] = static_cast<float>(interval.high);
    }
    for (MapBand* made : {&out, &low, &high}) layer.bands.push_back(std::move(*made));
  }
  return layer;
}

MapLayer arrival_layer(const CellRows& cells) {
  MapLayer layer{"", cells.cell, {}};
  MapBand out = band("first_arrival", "s",
                     "earliest time after the run's start at which any block came over the cell",
                     cells.cell.size());
  out.overview = OverviewValue::smallest;
  for (std::size_t i = 0; i < cells.cell.size(); ++i)
    for (const MapRow& row : rows_of(cells, i))
      out.value[i] = std::fmin(out.value[i], row.first_time);
  layer.bands.push_back(std::move(out));
  return layer;
}

MapLayer energy_line_layer(const CellRows& cells) {
  MapLayer layer{"", cells.cell, {}};
  MapBand out = band("energy_line_angle", "deg",
                     "smallest over blocks of atan(drop of the centroid since its start / "
                     "horizontal length of its path) when the block came over the cell",
                     cells.cell.size());
  out.overview = OverviewValue::smallest;
  for (std::size_t i = 0; i < cells.cell.size(); ++i)
    for (const MapRow& row : rows_of(cells, i))
      out.value[i] = std::fmin(out.value[i], static_cast<float>(row.travel_angle / degree));
  layer.bands.push_back(std::move(out));
  return layer;
}

void append(MapLayer& layer, const MapLayer& next) {
  TALUS_ASSERT(layer.name == next.name && layer.bands.size() == next.bands.size());
  layer.cell.insert(layer.cell.end(), next.cell.begin(), next.cell.end());
  for (std::size_t b = 0; b < layer.bands.size(); ++b) {
    std::vector<float>& value = layer.bands[b].value;
    value.insert(value.end(), next.bands[b].value.begin(), next.bands[b].value.end());
  }
}

std::vector<float> on_grid(const MapLayer& layer, const MapBand& band_values, std::size_t n_cells,
                           float nodata) {
  std::vector<float> values(n_cells, band_values.zero_elsewhere ? 0.0F : nodata);
  for (std::size_t i = 0; i < layer.cell.size(); ++i) {
    const float value = band_values.value[i];
    values[layer.cell[i]] = std::isnan(value) ? nodata : value;
  }
  return values;
}

}  // namespace talus
