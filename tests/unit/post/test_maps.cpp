// Maps of runs against plain statistics of the list of blocks.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <tuple>

#include "base/error.hpp"
#include "base/random.hpp"
#include "post/maps/maps.hpp"
#include "post/statistics.hpp"
#include "run_maker.hpp"

using namespace talus;
using namespace talus::testing;

namespace {

constexpr float unknown = PassageValues::unknown;

struct HandMadeRun {
  std::vector<Passage> passages;  // by block, then cell
  std::vector<double> weight;
};

struct HandMade {
  PassageGrid grid{Vec2(0, 60), 2, 9, 11};
  std::vector<HandMadeRun> runs;

  [[nodiscard]] ShareBasis basis(const std::vector<double>& run_weight = {},
                                 double failed_share = 0) const {
    std::vector<double> released;
    std::size_t most = 0;
    for (const auto& run : runs) {
      released.push_back(std::accumulate(run.weight.begin(), run.weight.end(), 0.0));
      most = std::max(most, run.weight.size());
    }
    return share_basis(clusters_of_runs(released, static_cast<int>(most), {}, run_weight),
                       failed_share);
  }
  [[nodiscard]] CellRows cells(const MapGrid& map) const {
    std::vector<std::vector<MapRow>> rows;
    for (const auto& run : runs) rows.push_back(map_rows(run.passages, grid, map, run.weight));
    return group_by_cell(std::move(rows),
                         static_cast<std::size_t>(map.grid.n_rows) * map.grid.n_cols);
  }
  [[nodiscard]] CellRows cells() const { return cells({grid, 1}); }
};

Passage random_passage(Random& random, int block, int cell) {
  const auto number = [&random](double high) {
    return static_cast<float>(std::floor(random.uniform(0, high)));
  };
  Passage p;
  p.block = block;
  p.cell = cell;
  p.largest = {number(30), number(4e5), number(5e5), number(4), number(6)};
  if (random.below(10) == 0) p.largest.centroid_height = unknown;
  p.first_time = number(20);
  p.travel_angle = number(100) / 100;
  p.heading = number(600) / 100 - 3;
  if (random.below(8) == 0) p.travel_angle = p.heading = unknown;
  return p;
}

HandMade random_runs(int n_runs, int n_blocks, bool weighted, double share, std::uint64_t seed) {
  Random random(seed);
  HandMade made;
  made.runs.resize(n_runs);
  for (auto& run : made.runs)
    for (int block = 0; block < n_blocks; ++block) {
      run.weight.push_back(weighted ? 1.0 + random.below(3) : 1.0);
      for (int cell = 0; cell < made.grid.n_rows * made.grid.n_cols; ++cell)
        if (random.uniform() < share) run.passages.push_back(random_passage(random, block, cell));
    }
  return made;
}

const MapBand& band_named(const MapLayer& layer, const std::string& name) {
  const auto at = std::find_if(layer.bands.begin(), layer.bands.end(),
                               [&name](const MapBand& b) { return b.name == name; });
  if (at == layer.bands.end()) throw std::runtime_error("no band " + name);
  return *at;
}

struct Known {
  int run;
  double weight;
  Passage passage;
};
// Passages of every block in each cell of `factor` x `factor` recorded ones, by plain loops.
std::map<int, std::vector<Known>> by_cell(const HandMade& made, int factor) {
  std::map<std::tuple<int, int, int>, Known> blocks;  // cell, run, block
  const int n_cols = (made.grid.n_cols + factor - 1) / factor;
  for (std::size_t r = 0; r < made.runs.size(); ++r)
    for (const Passage& p : made.runs[r].passages) {
      const int cell =
          p.cell / made.grid.n_cols / factor * n_cols + p.cell % made.grid.n_cols / factor;
      const int run = static_cast<int>(r);
      const auto [at, is_new] =
          blocks.try_emplace({cell, run, p.block}, Known{run, made.runs[r].weight[p.block], p});
      if (is_new) continue;
      PassageValues& v = at->second.passage.largest;
      v.speed = std::max(v.speed, p.largest.speed);
      v.translational_energy = std::max(v.translational_energy, p.largest.translational_energy);
      v.total_energy = std::max(v.total_energy, p.largest.total_energy);
      v.centroid_height = std::fmax(v.centroid_height, p.largest.centroid_height);
      v.top_height = std::fmax(v.top_height, p.largest.top_height);
      if (p.first_time < at->second.passage.first_time) {
        at->second.passage.first_time = p.first_time;
        at->second.passage.travel_angle = p.travel_angle;
        at->second.passage.heading = p.heading;
      }
    }
  std::map<int, std::vector<Known>> cells;
  for (const auto& [key, known] : blocks) cells[std::get<0>(key)].push_back(known);
  return cells;
}

void expect_value(float found, double expected) {
  if (std::isnan(expected))
    EXPECT_TRUE(std::isnan(found)) << found;
  else
    EXPECT_FLOAT_EQ(found, static_cast<float>(expected));
}

void expect_statistics(const HandMade& made, int factor, int min_passages) {
  const MapGrid map = map_grid(made.grid, made.grid.cell_size * factor, "--cell-size-m");
  const CellRows cells = made.cells(map);
  MapSettings settings;
  settings.min_passages = min_passages;
  const MapLayer layer = quantity_layer("pass_height_centroid", cells, MapQuantity::centroid_height,
                                        made.basis(), settings);
  const auto known = by_cell(made, factor);
  ASSERT_EQ(cells.cell.size(), known.size());
  for (std::size_t i = 0; i < cells.cell.size(); ++i) {
    std::vector<WeightedValue> sample;
    double w = 0, w_sq = 0, moment = 0;
    for (const Known& k : known.at(static_cast<int>(cells.cell[i]))) {
      if (std::isnan(k.passage.largest.centroid_height)) continue;
      sample.push_back({k.passage.largest.centroid_height, k.weight});
      w += k.weight, w_sq += k.weight * k.weight, moment += k.weight * sample.back().value;
    }
    sort_values(sample);
    expect_value(band_named(layer, "pass_height_centroid_mean").value[i], moment / w);
    expect_value(band_named(layer, "pass_height_centroid_max").value[i],
                 sample.empty() ? NAN : sample.back().value);
    const std::map<std::string, std::pair<double, int>> percentiles = {
        {"p50", {0.5, 5}}, {"p90", {0.9, 29}}, {"p95", {0.95, 59}}, {"p99", {0.99, 299}}};
    for (const auto& [name, p] : percentiles) {
      const int needed = min_passages > 0 ? min_passages : p.second;
      const bool enough = w * w / w_sq > needed - 1e-6;
      expect_value(band_named(layer, "pass_height_centroid_" + name).value[i],
                   enough ? weighted_percentile(sample, p.first) : NAN);
    }
  }
}

}  // namespace

TEST(QuantityLayer, EqualsStatisticsOfTheListOfBlocks) {
  expect_statistics(random_runs(80, 1, false, 0.9, 1), 1, 0);
  expect_statistics(random_runs(6, 30, true, 0.6, 2), 1, 0);
  expect_statistics(random_runs(6, 30, true, 0.6, 2), 1, 3);
}

TEST(QuantityLayer, IsExactOnWholeMultiplesOfTheRecordedCells) {
  for (const int factor : {2, 3, 5}) expect_statistics(random_runs(5, 9, true, 0.3, 3), factor, 1);
}

// Single-block runs: the bound is the order statistic of the Wilks rank. 59 passages: the maximum.
TEST(QuantityLayer, BoundsPercentilesByRanksWhereRunsAreIndependent) {
  HandMade made = random_runs(300, 1, false, 0, 1);
  for (int run = 0; run < 300; ++run)
    for (int cell = 0; cell < 3; ++cell) {
      if (run >= std::array{58, 59, 300}[cell]) continue;
      Passage p;
      p.cell = cell;
      p.largest.speed = static_cast<float>((run * 7) % 300);
      made.runs[run].passages.push_back(p);
    }
  const MapLayer layer =
      quantity_layer("velocity", made.cells(), MapQuantity::speed, made.basis(), {});
  const auto& p95 = band_named(layer, "velocity_p95").value;
  const auto& p95_hi = band_named(layer, "velocity_p95_hi").value;
  EXPECT_TRUE(std::isnan(p95[0]));
  EXPECT_TRUE(std::isnan(p95_hi[0]));
  EXPECT_FALSE(std::isnan(band_named(layer, "velocity_p90_hi").value[0]));
  EXPECT_EQ(p95_hi[1], band_named(layer, "velocity_max").value[1]);
  EXPECT_EQ(p95[2], 284);  // 285th of 0..299
  EXPECT_EQ(p95_hi[2], upper_bound_rank(300, 0.95) - 1);
  EXPECT_EQ(band_named(layer, "velocity_p99_hi").value[2], 299);
}

// Blocks of one run are not independent: one run gives no bound, however many blocks it has.
TEST(QuantityLayer, BoundsNothingFromASingleRun) {
  const HandMade one = random_runs(1, 500, false, 1, 4), many = random_runs(25, 20, false, 1, 4);
  const auto bound = [](const HandMade& made) {
    return band_named(quantity_layer("ke_total", made.cells(), MapQuantity::total_energy,
                                     made.basis(), {}),
                      "ke_total_p95_hi")
        .value[0];
  };
  EXPECT_TRUE(std::isnan(bound(one)));
  EXPECT_FALSE(std::isnan(bound(many)));
}

TEST(QuantityLayer, GivesEnergiesInKilojoule) {
  HandMade made = random_runs(1, 1, false, 0, 1);
  Passage p;
  p.cell = 7;
  p.largest.total_energy = 41500;
  made.runs[0].passages = {p};
  const MapLayer layer =
      quantity_layer("ke_total", made.cells(), MapQuantity::total_energy, made.basis(), {});
  EXPECT_FLOAT_EQ(band_named(layer, "ke_total_max").value[0], 41.5F);
  EXPECT_EQ(layer.bands[0].unit, "kJ");
}

TEST(ReachLayer, CountsEachBlockOnceWithItsWeight) {
  for (const int factor : {1, 4}) {
    const HandMade made = random_runs(7, 6, true, 0.2, 5);
    const MapGrid map = map_grid(made.grid, made.grid.cell_size * factor, "");
    const CellRows cells = made.cells(map);
    const MapLayer layer = reach_layer(cells, map.grid.cell_size, made.basis());
    double total = 0;
    for (const double w : made.basis().clusters.weight) total += w;
    const auto known = by_cell(made, factor);
    for (std::size_t i = 0; i < cells.cell.size(); ++i) {
      const auto& blocks = known.at(static_cast<int>(cells.cell[i]));
      double w = 0, w_sq = 0, per_m = 0;
      std::map<int, int> runs;
      for (const Known& k : blocks) {
        w += k.weight, w_sq += k.weight * k.weight, ++runs[k.run];
        const double h = k.passage.heading;
        per_m +=
            1 / map.grid.cell_size /
            (std::isnan(h) ? 4 / std::numbers::pi : std::abs(std::cos(h)) + std::abs(std::sin(h)));
      }
      EXPECT_EQ(band_named(layer, "n_pass").value[i], blocks.size());
      expect_value(band_named(layer, "reach_probability").value[i], w / total);
      expect_value(band_named(layer, "run_share").value[i], runs.size() / 7.0);
      expect_value(band_named(layer, "passage_per_m").value[i], per_m);
      expect_value(band_named(layer, "n_eff").value[i], w * w / w_sq);
    }
  }
}

// A hundred single-block runs, 10 of which came: Wilson's interval of 10 out of 100.
TEST(ReachLayer, BoundsTheProbabilityByWilsonForSingleBlocks) {
  HandMade made = random_runs(100, 1, false, 0, 1);
  for (int run = 0; run < 10; ++run) made.runs[run].passages = {Passage{}};
  const MapLayer layer = reach_layer(made.cells(), 2, made.basis());
  EXPECT_FLOAT_EQ(band_named(layer, "reach_probability").value[0], 0.1F);
  EXPECT_NEAR(band_named(layer, "reach_probability_lo").value[0], 0.05523, 1e-5);
  EXPECT_NEAR(band_named(layer, "reach_probability_hi").value[0], 0.17437, 1e-5);
}

// 40 runs of one block, 4 of which came: 0.10 of 40 trials; 141 are wanted for a half width of
// 0.05.
// A run that counts three times is as good as the same run three times, but for how sure that is.
TEST(ReachLayer, WeighsRunsAsIfTheyStoodThereSoManyTimes) {
  HandMade made = random_runs(2, 3, false, 0.4, 5), repeated = made;
  repeated.runs.push_back(made.runs[1]);
  repeated.runs.push_back(made.runs[1]);
  for (double& weight : made.runs[1].weight) weight *= 3;
  const ShareBasis weighed = made.basis({1, 3});
  const MapLayer a = reach_layer(made.cells(), 2, weighed);
  const MapLayer b = reach_layer(repeated.cells(), 2, repeated.basis());
  int n = 0;
  for (std::size_t k = 0; k < a.bands.size(); ++k) {
    if (a.bands[k].name != "reach_probability" && a.bands[k].name != "run_share") continue;
    ++n;
    EXPECT_EQ(a.bands[k].value, b.bands[k].value) << a.bands[k].name;
  }
  EXPECT_EQ(n, 2);
  // effective runs: (1 + 3)^2 / (1 + 9)
  EXPECT_NEAR(reach_bound_elsewhere(weighed), wilson_interval(0, 1.6).high, 1e-12);
}

TEST(RunsToAdd, AreThoseOfTheWorstCell) {
  HandMade made = random_runs(40, 1, false, 0, 1);
  for (int run = 0; run < 4; ++run) made.runs[run].passages = {Passage{}};
  EXPECT_EQ(runs_to_add(made.cells(), made.basis(), 0.05).n, 101);
  Passage half;
  half.cell = 3;
  for (int run = 0; run < 20; ++run) made.runs[run].passages.push_back(half);
  EXPECT_EQ(runs_to_add(made.cells(), made.basis(), 0.05).n, 341);  // 381 wanted where R = 0.5
  EXPECT_EQ(runs_to_add(made.cells(), made.basis(), 0.2).n, 0);
  HandMade few = random_runs(4, 2, false, 0, 1);  // have no interval at all
  EXPECT_EQ(runs_to_add(few.cells(), few.basis(), 0.2).n, least_clusters - 4);
}

// Two of the 102 runs that were wanted failed: the rest says 10 of 100.
TEST(ReachLayer, CountsFailedRunsIntoItsIntervals) {
  HandMade made = random_runs(100, 1, false, 0, 1);
  for (int run = 0; run < 10; ++run) made.runs[run].passages = {Passage{}};
  EXPECT_NEAR(reach_bound_elsewhere(made.basis()), 0.036993, 5e-7);
  const ShareBasis with_failed_runs = made.basis({}, 0.02);
  const MapLayer layer = reach_layer(made.cells(), 2, with_failed_runs);
  EXPECT_FLOAT_EQ(band_named(layer, "reach_probability").value[0], 0.1F);
  for (const std::string name : {"reach_probability", "run_share"}) {
    EXPECT_NEAR(band_named(layer, name + "_lo").value[0], 0.05523 * 0.98, 1e-5);
    EXPECT_NEAR(band_named(layer, name + "_hi").value[0], 0.17437 * 0.98 + 0.02, 1e-5);
  }
  EXPECT_NEAR(reach_bound_elsewhere(with_failed_runs), 0.036993 * 0.98 + 0.02, 5e-7);
}

TEST(ExceedanceLayer, SharesTheWeightAboveTheThresholdNotAtIt) {
  HandMade made = random_runs(4, 1, false, 0, 1);
  for (int run = 0; run < 4; ++run) {
    Passage p;
    p.largest.total_energy = std::array{29e3F, 30e3F, 31e3F, 301e3F}[run];
    made.runs[run].passages = {p};
  }
  const MapLayer layer = exceedance_layer(made.cells(), made.basis());
  EXPECT_EQ(band_named(layer, "p_exceed_30kJ").value[0], 0.5F);
  EXPECT_EQ(band_named(layer, "p_exceed_300kJ").value[0], 0.25F);
}

TEST(ArrivalAndEnergyLine, TakeTheSmallestOverBlocksAndSkipTheUnknown) {
  HandMade made = random_runs(3, 1, false, 0, 1);
  for (int run = 0; run < 3; ++run) {
    Passage p;
    p.first_time = std::array{4.0F, 2.5F, 3.0F}[run];
    p.travel_angle = std::array{0.7F, unknown, 0.5F}[run];
    made.runs[run].passages = {p};
  }
  EXPECT_EQ(arrival_layer(made.cells()).bands[0].value[0], 2.5F);
  EXPECT_EQ(arrival_layer(made.cells()).bands[0].overview, OverviewValue::smallest);
  EXPECT_FLOAT_EQ(energy_line_layer(made.cells()).bands[0].value[0],
                  static_cast<float>(0.5 * 180 / std::numbers::pi));
}

TEST(MapGrid, RefusesSizesThatWouldHaveToBeResampled) {
  const PassageGrid recorded{Vec2(0, 60), 2, 9, 11};
  EXPECT_EQ(map_grid(recorded, 6, "").factor, 3);
  EXPECT_EQ(map_grid(recorded, 6, "").grid.n_cols, 4);
  EXPECT_EQ(map_grid(recorded, std::nan(""), "").factor, 1);
  for (const double size : {1.0, 3.0, -2.0, 5.9})
    EXPECT_THROW((void)map_grid(recorded, size, "--x"), InputError);
}

TEST(MapTiles, CoverAllCellsWithNoMoreRowsThanAllowed) {
  Random random(8);
  std::vector<std::uint32_t> rows_of_cell(500);
  for (auto& n : rows_of_cell) n = static_cast<std::uint32_t>(random.below(40));
  rows_of_cell[77] = 1000;  // more than a tile may hold
  std::uint32_t end = 0;
  for (const MapTile& tile : tiles_of(rows_of_cell, 100)) {
    EXPECT_EQ(tile.first, end);
    end = tile.end;
    std::uint32_t n = 0;
    for (std::uint32_t cell = tile.first; cell < tile.end; ++cell) n += rows_of_cell[cell];
    EXPECT_TRUE(n <= 100 || tile.end == tile.first + 1) << n;
  }
  EXPECT_EQ(end, 500U);
}

// Layers made tile by tile hold the bits of those made at once.
TEST(MapTiles, ChangeNothing) {
  const HandMade made = random_runs(14, 9, true, 0.6, 6);
  for (const int factor : {1, 2}) {
    const MapGrid map = map_grid(made.grid, made.grid.cell_size * factor, "");
    const auto layers_of = [&](const MapTile& tile) {
      std::vector<std::vector<MapRow>> rows;
      for (const auto& run : made.runs)
        rows.push_back(map_rows(run.passages, made.grid, map, run.weight, tile));
      const CellRows cells = group_by_cell(
          std::move(rows), static_cast<std::size_t>(map.grid.n_rows) * map.grid.n_cols);
      return std::vector{
          reach_layer(cells, 2, made.basis()),
          quantity_layer("height", cells, MapQuantity::centroid_height, made.basis(), {}),
          arrival_layer(cells)};
    };
    std::vector<std::uint32_t> rows_of_cell(static_cast<std::size_t>(map.grid.n_rows) *
                                            map.grid.n_cols);
    for (const auto& run : made.runs)
      for (const MapRow& row : map_rows(run.passages, made.grid, map, run.weight))
        ++rows_of_cell[row.cell];
    const std::vector<MapTile> tiles = tiles_of(rows_of_cell, 300);
    ASSERT_GT(tiles.size(), 5U);
    std::vector<MapLayer> tiled = layers_of(tiles[0]);
    for (std::size_t t = 1; t < tiles.size(); ++t) {
      const auto next = layers_of(tiles[t]);
      for (std::size_t i = 0; i < tiled.size(); ++i) append(tiled[i], next[i]);
    }
    const std::vector<MapLayer> whole = layers_of({});
    for (std::size_t i = 0; i < whole.size(); ++i) {
      EXPECT_EQ(tiled[i].cell, whole[i].cell);
      for (std::size_t b = 0; b < whole[i].bands.size(); ++b)
        for (std::size_t k = 0; k < whole[i].cell.size(); ++k)
          expect_value(tiled[i].bands[b].value[k], whole[i].bands[b].value[k]);
    }
  }
}

TEST(OnGrid, TellsZeroFromNodata) {
  HandMade made = random_runs(1, 1, false, 0, 1);
  Passage p;
  p.cell = 1;
  made.runs[0].passages = {p};
  const CellRows cells = made.cells();
  const MapLayer reach = reach_layer(cells, 2, made.basis());
  const MapLayer speed = quantity_layer("velocity", cells, MapQuantity::speed, made.basis(), {});
  EXPECT_EQ(on_grid(reach, band_named(reach, "n_pass"), 3, -9999), (std::vector<float>{0, 1, 0}));
  EXPECT_EQ(on_grid(speed, band_named(speed, "velocity_max"), 3, -9999),
            (std::vector<float>{-9999, 0, -9999}));
  EXPECT_EQ(on_grid(speed, band_named(speed, "velocity_p95"), 3, -9999),
            (std::vector<float>{-9999, -9999, -9999}));
}

TEST(Maps, OfNoPassageAtAllAreEmpty) {
  const HandMade made = random_runs(2, 3, false, 0, 1);
  const CellRows cells = made.cells();
  EXPECT_TRUE(cells.cell.empty());
  EXPECT_EQ(reach_layer(cells, 2, made.basis()).bands.size(), 9U);
  EXPECT_EQ(quantity_layer("speed", cells, MapQuantity::speed, made.basis(), {}).bands.size(), 10U);
}
