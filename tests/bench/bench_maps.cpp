// tests/bench/bench_maps.cpp
// Rows of passages a second and core: merged (sorted by cell), and turned into all maps.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <numeric>

#include "base/random.hpp"
#include "post/maps/map_layers.hpp"

namespace {

using namespace talus;

const PassageGrid grid{Vec2(0, 0), 5, 120, 160};

// Runs of `n_blocks` blocks that wander down a slope, some 100 cells each.
std::vector<std::vector<Passage>> make_runs(int n_runs, int n_blocks) {
  Random random(1, "bench");
  std::vector<std::vector<Passage>> runs(static_cast<std::size_t>(n_runs));
  for (auto& rows : runs)
    for (int block = 0; block < n_blocks; ++block) {
      int col = 60 + static_cast<int>(random.below(40));
      for (int row = 5; row < 105; ++row) {
        col = std::clamp(col + static_cast<int>(random.below(3)) - 1, 0, grid.n_cols - 1);
        Passage p;
        p.block = block;
        p.cell = row * grid.n_cols + col;
        const auto speed = static_cast<float>(5 + 10 * random.uniform());
        p.largest = {speed, 1300 * speed * speed, 1500 * speed * speed, 1, 2};
        p.first_time = static_cast<float>(row);
        p.travel_angle = 0.6F;
        p.heading = -1.5F;
        rows.push_back(p);
      }
    }
  return runs;
}

std::vector<std::vector<MapRow>> rows_of(const std::vector<std::vector<Passage>>& runs,
                                         int n_blocks) {
  std::vector<std::vector<MapRow>> rows;
  const std::vector<double> weight(static_cast<std::size_t>(n_blocks), 1);
  for (const auto& run : runs) rows.push_back(map_rows(run, grid, {grid, 1}, weight));
  return rows;
}

void merge(benchmark::State& state) {
  const int n_runs = static_cast<int>(state.range(0)), n_blocks = static_cast<int>(state.range(1));
  const auto runs = make_runs(n_runs, n_blocks);
  std::size_t n = 0;
  for (auto _ : state) {
    const CellRows cells = group_by_cell(rows_of(runs, n_blocks), grid.n_rows * grid.n_cols);
    n = cells.rows.size();
    benchmark::DoNotOptimize(cells.rows.data());
  }
  state.counters["rows_per_s"] =
      benchmark::Counter(static_cast<double>(n), benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(merge)->Args({1000, 1})->Args({10000, 1})->Args({50, 390})->Unit(benchmark::kMillisecond);

void all_layers(benchmark::State& state) {
  const int n_runs = static_cast<int>(state.range(0)), n_blocks = static_cast<int>(state.range(1));
  const auto runs = make_runs(n_runs, n_blocks);
  const CellRows cells = group_by_cell(rows_of(runs, n_blocks), grid.n_rows * grid.n_cols);
  Clusters clusters;
  clusters.weight.assign(runs.size(), n_blocks);
  clusters.n_blocks.assign(runs.size(), n_blocks);
  clusters.run_weight.assign(runs.size(), 1);
  clusters.of_run.resize(runs.size());
  std::iota(clusters.of_run.begin(), clusters.of_run.end(), 0);
  const ShareBasis basis = share_basis(std::move(clusters));
  const DepositSums deposit;  // nothing came to rest
  const MapSettings settings;
  for (auto _ : state) {
    for (const MapLayerKind& kind : map_layers())
      benchmark::DoNotOptimize(make_layer(kind, {cells, deposit, 5, basis, settings}).bands.data());
  }
  state.counters["rows_per_s"] = benchmark::Counter(static_cast<double>(cells.rows.size()),
                                                    benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(all_layers)
    ->Args({1000, 1})
    ->Args({10000, 1})
    ->Args({50, 390})
    ->Unit(benchmark::kMillisecond);

}  // namespace
