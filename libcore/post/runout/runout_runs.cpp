// Run-out of many runs: the data kept of each, their sums and the spread over them.
#include "post/runout/runout_runs.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "post/statistics.hpp"

namespace talus {

std::vector<LineReach> reach_of_lines(const RunFile& run) {
  double total = 0;
  for (int b = 0; b < n_blocks(run); ++b) total += weight_of(run, b);
  std::vector<LineReach> lines;
  for (const RecordLine& line : run.lines) lines.push_back({line.name, 0, 0});
  for (const Crossing& crossing : run.crossings) {  // a row a block and line
    if (crossing.beside) continue;
    LineReach& line = lines[crossing.line];
    line.share += weight_of(run, crossing.block) / total;
    line.energy = std::max(line.energy, crossing.translational_energy + crossing.rotational_energy);
  }
  std::vector<LineReach> asked_for;
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (!is_candidate(run.lines[i]) && !is_before_dam(run.lines[i])) asked_for.push_back(lines[i]);
  return asked_for;
}

RunoutRun runout_run(const RunFile& run, const RunMember& member, const Trn& trn,
                     const ReachSettings& settings) {
  RunoutRun r;
  r.member = member;
  r.event = event_reach(run, trn, settings);
  r.balance = balance_of(run, settings.rest_speed);
  r.energy = energy_shares(run);
  r.has_frames = !run.reach;
  for (int b = 0; b < n_blocks(run); ++b) {
    if (r.has_frames) r.paths.push_back(shown_path(run, b, trn, settings.tolerance));
    const Pose pose = last_pose(run, b);
    r.footprints.push_back(footprint(run, b, pose));
    r.end.push_back(pose.position);
  }
  r.volume = run.blocks.volume;
  r.mass = run.blocks.mass;
  for (const WeightedValue& d : displacements(run)) r.displacement.push_back(d.value);
  r.lines = reach_of_lines(run);
  r.trees = trees_of(run);
  r.curves = curves(run);
  return r;
}

void add_run(RunoutSums& sums, const RunFile& run, const RunMember& member, const PassageGrid& grid,
             const Trn& trn, const ReachSettings& settings) {
  sums.grid = grid;
  sums.runs.push_back(runout_run(run, member, trn, settings));
  for (const Passage& passage : run.passages) add_cell(sums, passage.cell);
  DepositSums deposit;
  add_deposit(deposit, grid, run, settings.rest_speed);
  add(sums.deposit, deposit);
}

void add_cell(RunoutSums& sums, std::int32_t cell) {
  const auto n_cells = static_cast<std::size_t>(sums.grid.n_rows) * sums.grid.n_cols;
  if (sums.is_passed.size() < n_cells) sums.is_passed.resize(n_cells, 0);
  sums.is_passed[cell] = 1;
}

namespace {

// As counted_by() of a run.
double counted(const RunoutRun& run, std::size_t block) {
  return run.member.info.independent ? 1 : run.mass[block];
}

bool are_of_rocks(const std::vector<RunoutRun>& runs) {
  return !runs.empty() && runs.front().member.info.independent;
}

}  // namespace

RunoutRuns add_up(RunoutSums sums) {
  RunoutRuns out;
  out.grid = sums.grid;
  out.runs = std::move(sums.runs);
  out.deposit = std::move(sums.deposit);
  std::vector<WeightedValue> displacement;
  for (const RunoutRun& r : out.runs) {
    for (std::size_t b = 0; b < r.mass.size(); ++b)
      displacement.push_back({r.displacement[b], r.member.run_weight * counted(r, b)});
    add(out.balance, r.balance);
  }
  for (std::size_t cell = 0; cell < sums.is_passed.size(); ++cell)
    if (sums.is_passed[cell] != 0) out.cells.push_back(static_cast<std::uint32_t>(cell));
  out.moved = moved_of(std::move(displacement), are_of_rocks(out.runs));
  return out;
}

double swept_area(const RunoutRuns& all) {
  return static_cast<double>(all.cells.size()) * all.grid.cell_size * all.grid.cell_size;
}

Spread spread_over(const std::vector<RunoutRun>& runs, double (*value)(const RunoutRun&)) {
  return spread_over(runs, all_of(runs), value);
}

std::vector<RunoutCase> cases_of(const std::vector<RunoutRun>& runs) {
  std::map<std::string, std::vector<int>> by_name;
  for (std::size_t i = 0; i < runs.size(); ++i)
    by_name[runs[i].member.info.case_name].push_back(static_cast<int>(i));
  std::vector<RunoutCase> cases;
  if (by_name.size() < 2) return cases;
  for (auto& [name, of_case] : by_name) {
    std::vector<WeightedValue> displacement;
    for (const int i : of_case)
      for (std::size_t b = 0; b < runs[i].mass.size(); ++b)
        displacement.push_back({runs[i].displacement[b], counted(runs[i], b)});
    cases.push_back({name, of_case, moved_of(std::move(displacement), are_of_rocks(runs))});
  }
  return cases;
}

Spread spread_over(const std::vector<RunoutRun>& runs, const std::vector<int>& some,
                   double (*value)(const RunoutRun&)) {
  std::vector<WeightedValue> values;
  double sum = 0, weight = 0;
  for (const int i : some) {
    const double v = value(runs[i]), of_run = runs[i].member.run_weight;
    if (!std::isfinite(v)) continue;
    values.push_back({v, of_run});
    sum += of_run * v;
    weight += of_run;
  }
  if (values.empty()) return {};
  sort_values(values);
  return {values.size(),
          sum / weight,
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

std::vector<int> all_of(const std::vector<RunoutRun>& runs) {
  std::vector<int> all(runs.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

std::vector<int> events_among(const std::vector<RunoutRun>& runs, const std::vector<int>& some) {
  std::vector<int> events;
  for (const int i : some)
    if (runs[i].event.moved.is_event()) events.push_back(i);
  return events;
}

double event_probability(const std::vector<RunoutRun>& runs, const std::vector<int>& some) {
  double of_events = 0, all = 0;
  for (const int i : some) {
    all += runs[i].member.run_weight;
    if (runs[i].event.moved.is_event()) of_events += runs[i].member.run_weight;
  }
  return of_events / all;
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
