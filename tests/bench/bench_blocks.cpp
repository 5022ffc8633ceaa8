// Cutting a mass of 200 m x 200 m on 40 x 40 cells by three joint sets: CPU time and growth with
// the number of blocks. Counters: blocks, convex cells before joining, relative error of the
// volume.
#include <benchmark/benchmark.h>

#include <cmath>

#include "base/random.hpp"
#include "blocks/assemble.hpp"
#include "blocks/source.hpp"

namespace {

using namespace talus;

Trn rough_slope() {
  Trn trn;
  trn.n_rows = trn.n_cols = 43;
  trn.cell_size = 5;
  trn.node0 = {0, 210};
  Random random(1);
  for (int r = 0; r < trn.n_rows; ++r)
    for (int c = 0; c < trn.n_cols; ++c)
      trn.elevation.push_back(0.6 * 5 * c + 4 * std::sin(0.25 * c) * std::cos(0.3 * r) +
                              random.uniform(-0.4, 0.4));
  return trn;
}

void cut_and_assemble(benchmark::State& state, bool exact) {
  const double spacing = static_cast<double>(state.range(0)) / 100;
  const Trn ground = rough_slope();
  Trn bed = ground;
  for (int r = 1; r + 1 < ground.n_rows; ++r)
    for (int c = 1; c + 1 < ground.n_cols; ++c) {
      const double u = c / 21.0 - 1, v = r / 21.0 - 1;
      bed.elevation[node_index(bed, r, c)] -= 25 * std::max(0.0, 1 - 0.8 * (u * u + v * v));
    }
  std::vector<JointSet> sets(3);
  const double dips[] = {0.6, 1.4, 1.5}, directions[] = {4.7, 1.6, 0.1};
  for (int s = 0; s < 3; ++s) {
    sets[s].name = std::string(1, static_cast<char>('a' + s));
    sets[s].dip = dips[s], sets[s].dip_direction = directions[s];
    sets[s].spacing = Spacing::uniform;
    sets[s].mean_spacing = spacing;
    sets[s].spacing_a = 0.6 * spacing, sets[s].spacing_b = 1.4 * spacing;
  }
  AssembleReport report;
  BlockSet set;
  for (auto _ : state) {
    std::vector<Joint> joints;
    for (int s = 0; s < 3; ++s)
      for (Joint& joint : draw_joints(sets[s], s, {105, 105, 63}, 200, 1))
        joints.push_back(std::move(joint));
    set = {};
    set.material_names = {"rock"};
    set.joint_set_names = {"a", "b", "c"};
    AssembleOptions options;
    options.exact = exact;
    options.min_volume = 0.02 * spacing * spacing * spacing;
    report = assemble_blocks(cut_mass(ground, bed, {}, joints), joints, bed, options, set);
  }
  const double volume = prism_volume(ground, bed);
  state.counters["blocks"] = n_blocks(set);
  state.counters["pieces"] = report.n_pieces;
  state.counters["cells"] = report.n_cells;
  state.counters["kept_exact"] = report.n_kept_exact;
  state.counters["cut_error"] = std::abs(report.cut_volume - volume) / volume;
  state.counters["loss"] = (report.cut_volume - report.block_volume) / volume;
}

}  // namespace

BENCHMARK_CAPTURE(cut_and_assemble, convex, false)
    ->Arg(4000)
    ->Arg(1000)
    ->Arg(500)
    ->Arg(400)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(cut_and_assemble, exact, true)
    ->Arg(4000)
    ->Arg(1000)
    ->Arg(500)
    ->Arg(400)
    ->Unit(benchmark::kMillisecond);
