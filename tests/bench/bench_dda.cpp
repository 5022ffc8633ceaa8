// CPU time of one step of one block, law talus, and of whole cases at a given error. Medians, as
// ratios:
// --benchmark_repetitions=9 --benchmark_report_aggregates_only=true.
#include <benchmark/benchmark.h>

#include <cmath>
#include <utility>

#include "base/units.hpp"
#include "step/step.hpp"
#include "verify/cases/cases.hpp"
#include "verify/cases/closed_form.hpp"

namespace {

using namespace talus;
using namespace talus::cases;

Scene sliding_scene(const Settings& settings, double friction_deg, double cell_size, double reach) {
  const SlopeFrame frame = slope_frame(30, 37);
  GroundClass ground;
  ground.friction = std::tan(friction_deg * degree);
  Body cube;
  cube.parts = {box_in(frame, Vec3::Zero(), Vec3(-0.5, -0.5, 0), Vec3(0.5, 0.5, 1))};
  return scene_of(plane_trn(frame, cell_size, reach), ground, {cube}, settings);
}

// Steps from the start again after `n`, so that the block stays on its slope.
void run_steps(benchmark::State& bench, const Scene& scene, int n) {
  const State first = start(scene);
  State state = first;
  Work work = make_work(scene);
  int i = 0;
  for (auto _ : bench) {
    benchmark::DoNotOptimize(step(scene, state, work));
    if (++i == n) state = first, i = 0;
  }
}

void sliding_block(benchmark::State& bench) {
  Settings settings;
  settings.strains = bench.range(0) == 12;
  run_steps(bench, sliding_scene(settings, 20, 0.5, 60), 800);
}
BENCHMARK(sliding_block)->Arg(6)->Arg(12);

// Argument 0: as with --plan=full, nothing sleeps.
void sticking_block(benchmark::State& bench) {
  Settings settings;
  settings.sleep = bench.range(0) != 0;
  run_steps(bench, sliding_scene(settings, 35, 0.5, 60), 100000);
}
BENCHMARK(sticking_block)->Arg(0)->Arg(1);

// From 2,240 triangles to 516,652: the same cell size, more of them around.
void sliding_block_on_terrain(benchmark::State& bench) {
  const int nodes = static_cast<int>(bench.range(0));
  run_steps(bench, sliding_scene({}, 20, 2, (nodes - 1)), 400);
  bench.counters["triangles"] = 2.0 * (nodes - 1) * (nodes - 1);
}
BENCHMARK(sliding_block_on_terrain)->Arg(35)->Arg(509);

void ground_set_up(benchmark::State& bench) {
  const int nodes = static_cast<int>(bench.range(0));
  const Trn trn = plane_trn(slope_frame(30, 37), 2, nodes - 1);
  for (auto _ : bench) {
    Trn copy = trn;
    benchmark::DoNotOptimize(make_ground(std::move(copy), {}));
  }
  bench.counters["triangles"] = 2.0 * (nodes - 1) * (nodes - 1);
}
BENCHMARK(ground_set_up)->Arg(509)->Unit(benchmark::kMillisecond);

// Argument 0: as with --plan=full, the search is made in every step.
void flying_block(benchmark::State& bench) {
  const SlopeFrame flat = slope_frame(0, 0);
  Body body;
  body.parts = {box_in(flat, Vec3(0, 0, 600), Vec3(-1, -1.5, -2.5), Vec3(1, 1.5, 2.5))};
  body.spin = Vec3(0.02, 5, 0.01);
  Settings settings;
  settings.flight = bench.range(0) != 0;
  const Scene scene = scene_of(plane_trn(flat, 5, 100), {}, {body}, settings);
  run_steps(bench, scene, 1600);
}
BENCHMARK(flying_block)->Arg(1)->Arg(0);

// Whole cases: the counter `error` is listed beside the time.
void case_sliding(benchmark::State& bench) {
  CaseResult result;
  for (auto _ : bench) result = sliding({}, 20, 37, 4, Vec3::Zero(), 4);
  bench.counters["error"] = result.error;
}
BENCHMARK(case_sliding)->Unit(benchmark::kMillisecond);

void case_bounce(benchmark::State& bench) {
  CaseSettings settings;
  settings.dt = 1e-2;
  CaseResult result;
  for (auto _ : bench) result = bounce(settings, 0.7, Landing::face);
  bench.counters["error"] = result.error;
}
BENCHMARK(case_bounce)->Unit(benchmark::kMillisecond);

void case_oblique(benchmark::State& bench) {
  CaseResult result;
  for (auto _ : bench) result = oblique_slide({}, 37);
  bench.counters["error"] = result.error;
}
BENCHMARK(case_oblique)->Unit(benchmark::kMillisecond);

}  // namespace
