#include "post/maps.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/error.hpp"
#include "base/text.hpp"
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
  const char *layer, *title, *unit, *what;
};
constexpr std::array<QuantityText, 5> quantity_texts = {{
    {MapQuantity::speed, &PassageValues::speed, 1, "velocity", "Velocity", "m/s",
     "largest centroid speed of a block while any part of it is over the cell"},
    {MapQuantity::translational_energy, &PassageValues::translational_energy, 1e-3,
     "ke_translational", "Translational kinetic energy", "kJ",
     "largest m v^2 / 2 of a block while any part of it is over the cell"},
    {MapQuantity::total_energy, &PassageValues::total_energy, 1e-3, "ke_total",
     "Kinetic energy with spin", "kJ",
     "largest m v^2 / 2 + w' I w / 2 of a block while any part of it is over the cell"},
    {MapQuantity::centroid_height, &PassageValues::centroid_height, 1, "pass_height_centroid",
     "Passing height of the centroid", "m",
     "largest vertical height of a block's centroid above the ground while any part of the block "
     "is over the cell"},
    {MapQuantity::top_height, &PassageValues::top_height, 1, "pass_height_top",
     "Passing height of the top", "m",
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

// The largest values of both; what belongs to the arrival comes from the earlier one.
void take_earlier(MapRow& row, const MapRow& other) {
  row.largest.raise(other.largest);
  if (other.first_time >= row.first_time) return;
  row.first_time = other.first_time;
  row.travel_angle = other.travel_angle;
  row.heading = other.heading;
}

// Rows of the same block and cell become one.
void merge_equal_cells(std::vector<MapRow>& rows) {
  std::stable_sort(rows.begin(), rows.end(), [](const MapRow& a, const MapRow& b) {
    return a.block != b.block ? a.block < b.block : a.cell < b.cell;
  });
  std::size_t n = 0;
  for (const MapRow& row : rows) {
    if (n > 0 && rows[n - 1].block == row.block && rows[n - 1].cell == row.cell)
      take_earlier(rows[n - 1], row);
    else
      rows[n++] = row;
  }
  rows.resize(n);
}

MapRow map_row(const Passage& passage, std::uint32_t cell, float weight) {
  return {cell,
          0,
          passage.block,
          weight,
          passage.largest,
          passage.first_time,
          passage.travel_angle,
          passage.heading};
}

std::uint32_t map_cell(const Passage& passage, const PassageGrid& recorded, const MapGrid& map) {
  if (map.factor == 1) return static_cast<std::uint32_t>(passage.cell);
  const int row = passage.cell / recorded.n_cols / map.factor;
  const int col = passage.cell % recorded.n_cols / map.factor;
  return static_cast<std::uint32_t>(row) * static_cast<std::uint32_t>(map.grid.n_cols) +
         static_cast<std::uint32_t>(col);
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

MapLayer empty_quantity_layer(const QuantityText& text, const CellRows& cells) {
  MapLayer layer{text.layer, text.title, cells.cell, {}};
  const std::string prefix = text.layer, what = text.what;
  const auto add = [&](const std::string& name, const std::string& description) {
    layer.bands.push_back(band(prefix + "_" + name, text.unit, description, cells.cell.size()));
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

// Bounds of the share of released weight that came over a cell: Wilson where every run released a
// single block, else the bootstrap over runs.
class ReachBounds {
 public:
  ReachBounds(const Released& released, const MapSettings& settings)
      : resamples_(static_cast<int>(released.weight.size()), settings),
        single_blocks_(std::all_of(released.n_blocks.begin(), released.n_blocks.end(),
                                   [](int count) { return count <= 1; })),
        exist_(single_blocks_ ||
               static_cast<int>(released.weight.size()) >= least_runs_to_resample) {
    double total_sq = 0;
    for (const double w : released.weight) total_sq += w * w;
    n_eff_ = effective_size(sum(released.weight), total_sq);
    if (exist_ && !single_blocks_) whole_ = resampled_sums(resamples_.get(), released.weight);
  }

  Interval of(std::span<const MapRow> rows, double share) {
    if (!exist_) return {none, none};
    if (single_blocks_) return wilson_interval(share, n_eff_);
    parts_.clear();
    for (const MapRow& row : rows) {
      if (parts_.empty() || parts_.back().run != row.run) parts_.push_back({row.run, 0});
      parts_.back().weight += row.weight;
    }
    return bootstrap_share(parts_, whole_, resamples_.get());
  }

 private:
  LazyResamples resamples_;
  bool single_blocks_, exist_;
  double n_eff_ = 0;
  std::vector<double> whole_;  // released weight of each resample
  std::vector<RunWeight> parts_;
};

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

MapGrid map_grid(const PassageGrid& recorded, double cell_size, const std::string& item) {
  if (std::isnan(cell_size) || cell_size == 0) return {recorded, 1};
  const double ratio = cell_size / recorded.cell_size;
  const double factor = std::round(ratio);
  if (!(factor >= 1) || std::abs(ratio - factor) > 1e-9 * factor || factor > 1e6)
    throw InputError({"", 0, item},
                     "is " + text(cell_size) + ", expected a whole multiple of " +
                         text(recorded.cell_size) + ", the cells the passages were recorded on",
                     "other sizes would have to be resampled; set [output] cell_size_m = " +
                         text(cell_size) + " in the site file and run talus-dda again");
  const int k = static_cast<int>(factor);
  MapGrid map{recorded, k};
  map.grid.cell_size = recorded.cell_size * k;
  map.grid.n_rows = (recorded.n_rows + k - 1) / k;
  map.grid.n_cols = (recorded.n_cols + k - 1) / k;
  return map;
}

std::vector<MapRow> map_rows(std::span<const Passage> passages, const PassageGrid& recorded,
                             const MapGrid& map, std::span<const double> weight,
                             const MapTile& tile) {
  std::vector<MapRow> rows;
  rows.reserve(tile.first == 0 ? passages.size() : 0);
  for (const Passage& passage : passages) {
    const std::uint32_t cell = map_cell(passage, recorded, map);
    if (cell < tile.first || cell >= tile.end) continue;
    rows.push_back(
        map_row(passage, cell, weight.empty() ? 1 : static_cast<float>(weight[passage.block])));
  }
  if (map.factor > 1) merge_equal_cells(rows);
  return rows;
}

std::vector<MapTile> tiles_of(std::span<const std::uint32_t> rows_of_cell, std::uint64_t most) {
  std::vector<MapTile> tiles{{0, 0}};
  std::uint64_t n = 0;
  for (const std::uint32_t rows : rows_of_cell) {
    if (n + rows > most && tiles.back().end > tiles.back().first) {
      tiles.push_back({tiles.back().end, tiles.back().end});
      n = 0;
    }
    n += rows;
    ++tiles.back().end;
  }
  return tiles;
}

CellRows group_by_cell(std::vector<std::vector<MapRow>> runs, std::size_t n_cells) {
  // Counting sort: it keeps the order of runs and blocks within a cell.
  std::vector<std::uint64_t> place(n_cells + 1, 0);
  for (const auto& rows : runs)
    for (const MapRow& row : rows) ++place[row.cell + 1];
  CellRows cells;
  for (std::size_t cell = 0; cell < n_cells; ++cell) {
    if (place[cell + 1] > 0) {
      cells.cell.push_back(static_cast<std::uint32_t>(cell));
      cells.begin.push_back(cells.begin.back() + place[cell + 1]);
    }
    place[cell + 1] += place[cell];
  }
  cells.rows.resize(cells.begin.back());
  for (std::size_t run = 0; run < runs.size(); ++run) {
    for (MapRow& row : runs[run]) {
      row.run = static_cast<std::int32_t>(run);
      cells.rows[place[row.cell]++] = row;
    }
    std::vector<MapRow>().swap(runs[run]);
  }
  return cells;
}

MapLayer quantity_layer(const CellRows& cells, MapQuantity quantity, const Released& released,
                        const MapSettings& settings) {
  const QuantityText& text = text_of(quantity);
  MapLayer layer = empty_quantity_layer(text, cells);
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
  MapLayer layer{"reach", "Reach", cells.cell, empty_reach_bands(n)};
  const double total = sum(released.weight);
  ReachBounds bounds(released, settings);
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
    const Interval interval = bounds.of(rows, share);
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
  MapLayer layer{"exceedance", "Exceedance of energy", cells.cell, {}};
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
  MapLayer layer{"arrival", "First arrival", cells.cell, {}};
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
  MapLayer layer{"energy_line", "Energy-line angle", cells.cell, {}};
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
