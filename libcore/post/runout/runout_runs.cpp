#include "post/runout/runout_runs.hpp"

#include <algorithm>
#include <cmath>

#include "post/statistics.hpp"

namespace talus {
namespace {

void sort_and_unite(std::vector<std::uint32_t>& cells) {
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
}

}  // namespace

RunoutRun runout_run(const RunFile& run, const RunMember& member, const PassageGrid& grid,
                     const Trn& trn, const ReachSettings& settings) {
  RunoutRun r;
  r.member = member;
  r.event = event_reach(run, trn, settings);
  r.balance = balance_of(run, settings.rest_speed);
  r.energy = energy_shares(run);
  for (int b = 0; b < n_blocks(run); ++b) {
    r.paths.push_back(simplified(block_path(run, b), settings.tolerance));
    const Pose pose = last_pose(run, b);
    r.footprints.push_back(footprint(run, b, pose));
    r.end.push_back(pose.position);
  }
  r.volume = run.blocks.volume;
  r.mass = run.blocks.mass;
  for (const WeightedValue& d : displacements(run)) r.displacement.push_back(d.value);
  r.trees = {run.forests, run.tree_hits};
  r.curves = curves(run);
  for (const Passage& passage : run.passages)
    r.cells.push_back(static_cast<std::uint32_t>(passage.cell));
  sort_and_unite(r.cells);
  add_deposit(r.deposit, grid, run, settings.rest_speed);
  return r;
}

RunoutRuns add_up(std::vector<RunoutRun> runs, const PassageGrid& grid) {
  RunoutRuns out;
  out.grid = grid;
  out.runs = std::move(runs);
  std::vector<WeightedValue> displacement;
  for (const RunoutRun& r : out.runs) {
    for (std::size_t b = 0; b < r.mass.size(); ++b)
      displacement.push_back({r.displacement[b], r.mass[b]});
    add(out.balance, r.balance);
    add(out.deposit, r.deposit);
    out.cells.insert(out.cells.end(), r.cells.begin(), r.cells.end());
    out.released.weight.push_back(r.member.weight);
    out.released.n_blocks.push_back(r.member.n_blocks);
  }
  sort_and_unite(out.cells);
  out.moved = moved_of(std::move(displacement));
  return out;
}

double swept_area(const RunoutRuns& all) {
  return static_cast<double>(all.cells.size()) * all.grid.cell_size * all.grid.cell_size;
}

Spread spread_over(const std::vector<RunoutRun>& runs, double (*value)(const RunoutRun&)) {
  std::vector<WeightedValue> values;
  double sum = 0;
  for (const RunoutRun& r : runs)
    if (const double v = value(r); std::isfinite(v)) values.push_back({v, 1}), sum += v;
  if (values.empty()) return {};
  sort_values(values);
  return {values.size(),
          sum / static_cast<double>(values.size()),
          values.front().value,
          weighted_percentile(values, 0.05),
          weighted_percentile(values, 0.5),
          weighted_percentile(values, 0.95),
          values.back().value};
}

int n_moved(const std::vector<RunoutRun>& runs) {
  return static_cast<int>(std::count_if(
      runs.begin(), runs.end(), [](const RunoutRun& run) { return run.event.moved.any(); }));
}

const RunoutRun* farthest_run(const std::vector<RunoutRun>& runs) {
  const RunoutRun* farthest = nullptr;
  for (const RunoutRun& run : runs)
    if (run.event.moved.any() &&
        (farthest == nullptr || run.event.event.path > farthest->event.event.path))
      farthest = &run;
  return farthest;
}

}  // namespace talus
