#include "post/maps/maps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <span>

#include "base/error.hpp"
#include "post/share_interval.hpp"
#include "post/statistics.hpp"

namespace talus {
namespace {

constexpr float none = std::numeric_limits<float>::quiet_NaN();
constexpr double degrees = 180 / std::numbers::pi;

// How a quantity is read from a passage, and what its bands say.
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

int n_runs(const Released& released) { return static_cast<int>(released.weight.size()); }

double sum(std::span<const double> values) {
  double total = 0;
  for (const double value : values) total += value;
  return total;
}

// Resamples of the runs, drawn when a cell first needs them.
class LazyResamples {
 public:
  LazyResamples(int n_runs, const MapSettings& settings) : n_runs_(n_runs), settings_(settings) {}
  const RunResamples& get() {
    if (!resamples_) resamples_ = resample_runs(n_runs_, settings_.n_resamples, settings_.seed);
    return *resamples_;
  }

 private:
  int n_runs_;
  MapSettings settings_;
  std::optional<RunResamples> resamples_;
};

// Ranks of upper bounds, computed once for each sample size.
class BoundRanks {
 public:
  explicit BoundRanks(double p) : p_(p) {}
  int of(int n) {
    if (static_cast<std::size_t>(n) >= rank_.size()) rank_.resize(n + 1, not_computed);
    if (rank_[n] == not_computed) rank_[n] = upper_bound_rank(n, p_);
    return rank_[n];
  }

 private:
  static constexpr int not_computed = -1;
  double p_;
  std::vector<int> rank_;
};

// The values of one quantity in one cell, ascending, with the running sum of their weights.
struct CellSample {
  struct Item {
    float value, weight;
    std::int32_t run;
  };
  std::vector<Item> items;
  std::vector<double> weight_up_to;
  double mean = 0, n_eff = 0;
  int n_runs = 0;            // that came here
  bool runs_repeat = false;  // some run came with several blocks

  void fill(std::span<const MapRow> rows, float PassageValues::*member) {
    items.clear();
    double total = 0, total_sq = 0, moment = 0;
    n_runs = 0;
    runs_repeat = false;
    std::int32_t last_run = -1;
    for (const MapRow& row : rows) {
      const float value = row.largest.*member;
      if (std::isnan(value) || !(row.weight > 0)) continue;
      items.push_back({value, row.weight, row.run});
      total += row.weight;
      total_sq += static_cast<double>(row.weight) * row.weight;
      moment += static_cast<double>(row.weight) * value;
      if (row.run == last_run)
        runs_repeat = true;
      else
        ++n_runs;
      last_run = row.run;
    }
    mean = moment / total;
    n_eff = effective_size(total, total_sq);
    std::sort(items.begin(), items.end(), [](const Item& a, const Item& b) {
      return a.value != b.value ? a.value < b.value : a.weight < b.weight;
    });
    weight_up_to.resize(items.size());
    double running = 0;
    for (std::size_t i = 0; i < items.size(); ++i) weight_up_to[i] = running += items[i].weight;
  }

  // As weighted_percentile(), by bisection.
  [[nodiscard]] double percentile(double p) const {
    const double wanted = p * weight_up_to.back() * (1 - 1e-12);
    const auto at = std::lower_bound(weight_up_to.begin(), weight_up_to.end(), wanted);
    return items[std::min<std::size_t>(at - weight_up_to.begin(), items.size() - 1)].value;
  }
};

// Upper 95 % bounds of the percentiles; NaN where the sample gives none. Passages of different runs
// are independent, and ranks bound them exactly; blocks of one run are not, and the runs are
// resampled.
std::array<double, percentile_levels.size()> upper_bounds(const CellSample& sample,
                                                          std::span<BoundRanks> ranks,
                                                          LazyResamples& resamples) {
  std::array<double, percentile_levels.size()> bounds;
  bounds.fill(none);
  const int n = static_cast<int>(sample.n_eff + 1e-9);
  std::size_t n_bounded = 0;  // the lower percentiles need fewer
  while (n_bounded < bounds.size() && n >= smallest_sample(percentile_levels[n_bounded].p))
    ++n_bounded;
  if (!sample.runs_repeat) {
    for (std::size_t k = 0; k < n_bounded; ++k)
      bounds[k] = sample.percentile(static_cast<double>(ranks[k].of(n)) / n);
    return bounds;
  }
  if (sample.n_runs < least_runs_to_resample || n_bounded == 0) return bounds;
  std::vector<RunWeight> descending;
  descending.reserve(sample.items.size());
  for (auto item = sample.items.rbegin(); item != sample.items.rend(); ++item)
    descending.push_back({item->run, item->weight});
  std::vector<double> levels;
  for (std::size_t k = n_bounded; k-- > 0;) levels.push_back(percentile_levels[k].p);
  const std::vector<int> places = bootstrap_upper_places(descending, resamples.get(), levels);
  for (std::size_t k = 0; k < n_bounded; ++k) {
    const int place = places[n_bounded - 1 - k];
    if (place >= 0) bounds[k] = sample.items[sample.items.size() - 1 - place].value;
  }
  return bounds;
}

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
    add(std::string(p.name) + "_hi",
        std::string("upper 95 % confidence bound of ") + p.name +
            "; by ranks where no run passed twice, else by the bootstrap over runs; nodata where "
            "the sample gives none");
  return layer;
}

// What the intervals of reach_probability rest on.
ShareBasis reach_basis(const Released& released, const MapSettings& settings) {
  const bool single_blocks = std::all_of(released.n_blocks.begin(), released.n_blocks.end(),
                                         [](int count) { return count <= 1; });
  return share_basis(released.weight, single_blocks, settings.n_resamples, settings.seed);
}

// Weight of each run that came; `rows` by run.
void weigh_runs(std::span<const MapRow> rows, std::vector<RunWeight>& parts) {
  parts.clear();
  for (const MapRow& row : rows) {
    if (parts.empty() || parts.back().run != row.run) parts.push_back({row.run, 0});
    parts.back().weight += row.weight;
  }
}

// Width of a cell seen across a heading, in cell sizes; the mean over all directions for a block
// that stood.
double width_across(double heading) {
  if (std::isnan(heading)) return 4 / std::numbers::pi;
  return std::abs(std::cos(heading)) + std::abs(std::sin(heading));
}

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
      band("passage_per_m", "1/m",
           "sum over crossing blocks of 1 / (width of the cell seen across the block's "
           "heading)",
           n, true),
      band("n_eff", "1", "(sum w)^2 / sum w^2 over the blocks that crossed the cell", n, true)};
}

}  // namespace

MapLayer quantity_layer(const std::string& name, const CellRows& cells, MapQuantity quantity,
                        const Released& released, const MapSettings& settings) {
  const QuantityText& text = text_of(quantity);
  MapLayer layer = empty_quantity_layer(name, text, cells);
  constexpr std::size_t n_p = percentile_levels.size();
  std::vector<BoundRanks> ranks;
  for (const PercentileLevel& p : percentile_levels) ranks.emplace_back(p.p);
  LazyResamples resamples(n_runs(released), settings);
  CellSample sample;
  for (std::size_t i = 0; i < cells.cell.size(); ++i) {
    sample.fill(rows_of(cells, i), text.member);
    if (sample.items.empty()) continue;
    const auto put = [&](std::size_t b, double value) {
      layer.bands[b].value[i] = static_cast<float>(value * text.scale);
    };
    put(0, sample.mean);
    put(1 + n_p, sample.items.back().value);
    const auto bounds = upper_bounds(sample, ranks, resamples);
    for (std::size_t k = 0; k < n_p; ++k) {
      const double p = percentile_levels[k].p;
      const int needed = settings.min_passages > 0 ? settings.min_passages : smallest_sample(p);
      if (sample.n_eff + 1e-9 >= needed) put(1 + k, sample.percentile(p));
      put(2 + n_p + k, bounds[k]);
    }
  }
  return layer;
}

MapLayer reach_layer(const CellRows& cells, double cell_size, const Released& released,
                     const MapSettings& settings) {
  const std::size_t n = cells.cell.size();
  MapLayer layer{"", cells.cell, empty_reach_bands(n)};
  const double total = sum(released.weight);
  const ShareBasis basis = reach_basis(released, settings);
  std::vector<RunWeight> parts;
  for (std::size_t i = 0; i < n; ++i) {
    const auto rows = rows_of(cells, i);
    double w = 0, w_sq = 0, per_m = 0;
    int runs = 0;
    for (std::size_t k = 0; k < rows.size(); ++k) {
      w += rows[k].weight;
      w_sq += static_cast<double>(rows[k].weight) * rows[k].weight;
      runs += k == 0 || rows[k].run != rows[k - 1].run;
      per_m += 1 / (width_across(rows[k].heading) * cell_size);
    }
    const double share = total > 0 ? std::min(1.0, w / total) : 0;
    weigh_runs(rows, parts);
    const Interval interval = share_interval(basis, parts, share);
    const std::array values = {static_cast<double>(rows.size()),
                               share,
                               interval.low,
                               interval.high,
                               static_cast<double>(runs) / n_runs(released),
                               per_m,
                               effective_size(w, w_sq)};
    for (std::size_t b = 0; b < values.size(); ++b)
      layer.bands[b].value[i] = static_cast<float>(values[b]);
  }
  return layer;
}

MapLayer exceedance_layer(const CellRows& cells, const Released& released) {
  MapLayer layer{"", cells.cell, {}};
  const double total = sum(released.weight);
  for (const int limit_kj : {30, 300}) {
    MapBand out =
        band("p_exceed_" + std::to_string(limit_kj) + "kJ", "1",
             "weight of the blocks whose kinetic energy with spin was above " +
                 std::to_string(limit_kj) + " kJ over the cell / weight of all released blocks",
             cells.cell.size(), true);
    for (std::size_t i = 0; i < cells.cell.size(); ++i) {
      double w = 0;
      for (const MapRow& row : rows_of(cells, i))
        if (row.largest.total_energy > 1e3F * static_cast<float>(limit_kj)) w += row.weight;
      out.value[i] = static_cast<float>(total > 0 ? std::min(1.0, w / total) : 0);
    }
    layer.bands.push_back(std::move(out));
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
      out.value[i] = std::fmin(out.value[i], static_cast<float>(row.travel_angle * degrees));
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
