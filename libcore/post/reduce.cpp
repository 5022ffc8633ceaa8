// Reduces runs to their start and end, and many of them to one part.
#include "post/reduce.hpp"

#include <algorithm>

namespace talus {
namespace {

// Frames `first` and `last` of a run.
RunFrames ends_of(const RunFile& run) {
  RunFrames ends;
  const auto add = [&](int frame) {
    const auto take = [&](auto& to, const auto& from, std::size_t columns) {
      const std::size_t n = columns * static_cast<std::size_t>(n_blocks(run));
      const auto at = from.begin() + static_cast<std::ptrdiff_t>(n) * frame;
      to.insert(to.end(), at, at + static_cast<std::ptrdiff_t>(n));
    };
    ends.time.push_back(run.frames.time[frame]);
    take(ends.position, run.frames.position, 3);
    take(ends.attitude, run.frames.attitude, 4);
    take(ends.velocity, run.frames.velocity, 3);
    take(ends.spin, run.frames.spin, 3);
    if (!run.frames.strain.empty()) take(ends.strain, run.frames.strain, 6);
  };
  const int n = n_frames(run.frames);
  if (n > 0) add(0);
  if (n > 1) add(n - 1);
  return ends;
}

void add_counts(HealthRow& sum, const HealthRow& row) {
  for (const auto count : {&HealthRow::steps, &HealthRow::substeps, &HealthRow::passes,
                           &HealthRow::flips, &HealthRow::impacts, &HealthRow::unconverged})
    sum.*count += row.*count;
  for (std::size_t k = 0; k < sum.cuts.size(); ++k) sum.cuts[k] += row.cuts[k];
}

}  // namespace

RunFile without_frames(RunFile run, const Trn& trn, const ReachSettings& settings) {
  if (run.reach) return run;
  run.reach = reach_of_frames(run, trn, settings);
  run.frames = ends_of(run);
  return run;
}

std::vector<HealthRow> short_health(const std::vector<HealthRow>& rows) {
  if (rows.size() <= 2) return rows;
  HealthRow rest = rows.back();
  for (std::size_t i = 1; i + 1 < rows.size(); ++i) {
    add_counts(rest, rows[i]);
    rest.largest_error = std::max(rest.largest_error, rows[i].largest_error);
    rest.largest_penetration = std::max(rest.largest_penetration, rows[i].largest_penetration);
    if (rows[i].shortest_dt > 0 &&
        !(rest.shortest_dt > 0 && rest.shortest_dt < rows[i].shortest_dt))
      rest.shortest_dt = rows[i].shortest_dt;
  }
  return {rows.front(), rest};
}

void for_each_strip(const PartFile& file, int factor, const MapTile& tile, std::uint64_t most,
                    const std::function<void(const std::vector<std::vector<Passage>>&)>& take) {
  const int n_cols = file.part.grid.n_cols;
  const auto n_map_cols = static_cast<std::uint32_t>((n_cols + factor - 1) / factor);
  const auto strip_of = [&](std::size_t i) {
    return static_cast<std::uint32_t>(file.cell[i] / n_cols / factor);
  };
  const auto is_wanted = [&](std::size_t i) {
    return (strip_of(i) + 1) * n_map_cols > tile.first && strip_of(i) * n_map_cols < tile.end;
  };
  const auto hand_over = [&](std::size_t first, std::size_t end) {
    std::vector<std::vector<Passage>> by_run(static_cast<std::size_t>(n_runs(file.part)));
    for (const PartRow& row : file.rows(first, end)) by_run[row.run].push_back(row.passage);
    take(by_run);
  };
  const std::size_t n = file.cell.size();
  std::size_t first = 0;
  while (first < n && !is_wanted(first)) ++first;
  for (std::size_t i = first; i < n && is_wanted(i);) {
    std::size_t end = i;  // of the strip
    while (end < n && strip_of(end) == strip_of(i)) ++end;
    if (i > first && static_cast<std::uint64_t>(file.begin[end] - file.begin[first]) > most) {
      hand_over(first, i);
      first = i;
    }
    i = end;
    if (i == n || !is_wanted(i)) hand_over(first, i);
  }
}

}  // namespace talus
