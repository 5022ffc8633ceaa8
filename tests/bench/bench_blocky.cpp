// TRN against blocky slope, same engine, same scene, one run: the first 5 s of the peers' slide
// (scene F, 39 blocks) on 2,240 triangles, and with the slope 10 times larger around it, where no
// block comes. TALUS_PEERS_DIR=... bench_blocky; counters: cost of a step, triangles, mean path.
#include <benchmark/benchmark.h>

#include <algorithm>

#include "slide_scene.hpp"
#include "step/step.hpp"
#include "verify/cases/blocky_slope.hpp"

namespace {

using namespace talus;

// The same ground with `rows` and `cols` more nodes on each side, level outwards.
Trn larger(const Trn& trn, int rows, int cols) {
  Trn out = trn;
  out.n_rows += 2 * rows;
  out.n_cols += 2 * cols;
  out.node0 += Vec2(-cols * trn.cell_size, rows * trn.cell_size);
  out.elevation.clear();
  for (int r = -rows; r < trn.n_rows + rows; ++r)
    for (int c = -cols; c < trn.n_cols + cols; ++c)
      out.elevation.push_back(trn.elevation[node_index(trn, std::clamp(r, 0, trn.n_rows - 1),
                                                       std::clamp(c, 0, trn.n_cols - 1))]);
  return out;
}

// Arguments: 0 TRN, 1 blocky; 0 the paper's size, 1 ten times larger.
void Slope(benchmark::State& run) {
  if (bench::peers_folder().empty()) return run.SkipWithError("TALUS_PEERS_DIR is not set");
  SlideData slide = bench::read_peers_slide(39);
  if (run.range(1) == 1) slide.trn = larger(slide.trn, 44, 32);
  const Settings settings;
  Scene scene = slide_scene(slide, settings, 0);
  if (run.range(0) == 1) add_blocky_slope(scene, blocky_depth(scene));
  double way = 0, unconverged = 0, steps = 0;
  for (auto _ : run) {
    run.PauseTiming();
    State state = start(scene);
    Work work = make_work(scene);
    run.ResumeTiming();
    while (state.time < 5 - settings.dt / 2) step(scene, state, work);
    run.PauseTiming();
    way = 0;
    for (std::size_t b = 0; b < state.motion.size(); ++b)
      way += (motion_at(scene, state, static_cast<int>(b), state.time).pose.position -
              scene.blocks.rest[b].position)
                 .norm() /
             static_cast<double>(state.motion.size());
    unconverged = static_cast<double>(state.counters.unconverged);
    steps = static_cast<double>(state.counters.steps);
    run.ResumeTiming();
  }
  run.counters["triangles"] = n_triangles(scene.ground.trn);
  run.counters["mean_way_m"] = way;
  run.counters["unconverged"] = unconverged;
  run.counters["step_us"] =
      benchmark::Counter(1e-6 * steps * static_cast<double>(run.iterations()),
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK(Slope)
    ->ArgNames({"blocky", "larger"})
    ->ArgsProduct({{0, 1}, {0, 1}})
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1);

}  // namespace
