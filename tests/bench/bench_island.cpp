// Coupled solve of islands: time of a solve, of its parts, and how they grow. CPU time; `rows`,
// passes and conjugate-gradient iterations per solve are counters. Steps follow each other as in a
// run: velocities and states of the last solve start the next, the free motion changes by the share
// `noise` (in per mille).
#include <benchmark/benchmark.h>

#include "../unit/solver/island_scenes.hpp"
#include "solver/island_solver.hpp"

namespace {

using talus::Island;
using talus::IslandResult;
using talus::IslandSettings;
using talus::IslandWork;
using talus::scenes::LawOfScene;

constexpr double loose = 1e-2;  // tolerance of the slide, relative to g h

void solve_steps(benchmark::State& state, const Island& start, const LawOfScene& law,
                 double noise) {
  Island island = start;
  IslandWork work;
  IslandSettings settings;
  settings.tolerance = loose * law.gravity * law.step;
  talus::Random random(1, "noise");
  long passes = 0, iterations = 0, unconverged = 0, steps = 0;
  (void)solve_island(island, settings, work);
  for (auto _ : state) {
    state.PauseTiming();
    for (std::size_t i = 0; i < island.free_velocity.size(); ++i)
      island.free_velocity[i] = start.free_velocity[i] * (1 + noise * random.uniform(-1, 1));
    state.ResumeTiming();
    const IslandResult result = solve_island(island, settings, work);
    passes += result.passes;
    iterations += result.linear_iterations;
    unconverged += !result.converged;
    ++steps;
  }
  const auto per_step = [&](long n) { return static_cast<double>(n) / static_cast<double>(steps); };
  state.counters["blocks"] = talus::n_bodies(island);
  state.counters["rows"] = static_cast<double>(2 * island.rows.size());
  state.counters["passes"] = per_step(passes);
  state.counters["cg"] = per_step(iterations);
  state.counters["unconverged"] = per_step(unconverged);
}

double noise_of(const benchmark::State& state) {
  return 1e-3 * static_cast<double>(state.range(0));
}

void solve_stack_50(benchmark::State& state) {
  const LawOfScene law;
  solve_steps(state, talus::scenes::stack(50, law), law, noise_of(state));
}

void solve_wall_400(benchmark::State& state) {
  const LawOfScene law;
  solve_steps(state, talus::scenes::wall(20, 20, law), law, noise_of(state));
}

void solve_pile(benchmark::State& state, int n_x, int n_y, int n_z) {
  const LawOfScene law;
  talus::Random random(1, "pile");
  solve_steps(state, talus::scenes::pile({n_x, n_y, n_z}, law, random), law, noise_of(state));
}

BENCHMARK(solve_stack_50)->Arg(3)->Arg(300)->Unit(benchmark::kMicrosecond);
BENCHMARK(solve_wall_400)->Arg(3)->Arg(300)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(solve_pile, 8, 2, 2, 2)->Arg(3)->Arg(300)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(solve_pile, 39, 13, 3, 1)->Arg(3)->Arg(300)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(solve_pile, 390, 13, 10, 3)->Arg(3)->Arg(300)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(solve_pile, 3900, 26, 25, 6)->Arg(3)->Arg(300)->Unit(benchmark::kMicrosecond);

/// A solved pile of 390 blocks and its scratch, for the parts.
struct Parts {
  Island island;
  IslandWork work;
};

Parts solved_pile() {
  const LawOfScene law;
  talus::Random random(1, "pile");
  Parts parts{talus::scenes::pile({13, 10, 3}, law, random), {}};
  IslandSettings settings;
  settings.tolerance = loose * law.gravity * law.step;
  (void)solve_island(parts.island, settings, parts.work);
  return parts;
}

void count_per(benchmark::State& state, const char* name, std::size_t n) {
  state.counters[name] =
      benchmark::Counter(static_cast<double>(n), benchmark::Counter::kIsIterationInvariantRate |
                                                     benchmark::Counter::kInvert);
}

// Argument: rows at a time.
void evaluate_rows(benchmark::State& state) {
  const auto width = static_cast<talus::RowWidth>(state.range(0));
  if (width == talus::RowWidth::four && !talus::has_four_lanes())
    return state.SkipWithError("no AVX2");
  Parts parts = solved_pile();
  std::vector<talus::PairEvaluation> pairs;
  for (const talus::BodyPair& pair : parts.island.pairs) {
    pairs.emplace_back().groups = groups_of(parts.island, pair);
    pairs.back().motion = parts.island.velocity[static_cast<std::size_t>(pair.a)];
  }
  for (auto _ : state) {
    talus::evaluate_pairs(pairs, talus::Evaluation::coupled, 0.1, width);
    benchmark::DoNotOptimize(pairs.data());
  }
  count_per(state, "per_row", 2 * parts.island.rows.size());
}

void assemble_rows(benchmark::State& state) {
  Parts parts = solved_pile();
  talus::Packed<6> W;
  for (auto _ : state)
    for (std::size_t p = 0; p < parts.island.pairs.size(); ++p)
      benchmark::DoNotOptimize(
          talus::sum_tangents(groups_of(parts.island, parts.island.pairs[p]), W, nullptr));
  count_per(state, "per_row", 2 * parts.island.rows.size());
}

void invert_6x6(benchmark::State& state) {
  Parts parts = solved_pile();
  for (auto _ : state)
    for (const auto& block : parts.work.matrix.diagonal)
      benchmark::DoNotOptimize(talus::inverse(block));
  count_per(state, "per_body", parts.work.matrix.diagonal.size());
}

BENCHMARK(evaluate_rows)->Arg(2)->Arg(4);
BENCHMARK(assemble_rows);
BENCHMARK(invert_6x6);

}  // namespace
