// Crossings and passages of runs at a line that was drawn after them.
#include "post/profile/line_sums.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "base/numbers.hpp"
#include "post/profile/whole_bodies.hpp"
#include "terrain/trn_walk.hpp"

namespace talus {
namespace {

struct PlanBox {
  Vec2 low = Vec2::Constant(std::numeric_limits<double>::infinity());
  Vec2 high = -low;
};
PlanBox box_of(const RecordLine& line) {
  PlanBox box;
  for (const Vec3& p : line.points) {
    box.low = box.low.cwiseMin(p.head<2>());
    box.high = box.high.cwiseMax(p.head<2>());
  }
  return box;
}

LineCrossing crossing_of_block(const RunFile& run, int index, int b) {
  LineCrossing out;
  out.at.run = index;
  out.at.block = b;
  out.at.weight = weight_of(run, b);
  out.at.volume = run.blocks.volume[b];
  out.mass = run.blocks.mass[b];
  out.run_weight = run.run_weight;
  return out;
}

// Of block b on a straight path in plan from frame k to the next, as the body that it then is part
// of.
LineCrossing crossing_between(const RunFile& run, int index, int b, const WholeBodies& bodies,
                              int k, const Vec2& start, const Vec2& end, const LineMeeting& met,
                              const Trn& trn) {
  const auto between = [&](double a, double z) { return a + met.share * (z - a); };
  LineCrossing out = crossing_of_block(run, index, b);
  FenceArrival& at = out.at;
  at.time = between(run.frames.time[k], run.frames.time[k + 1]);
  const std::span<const int> rows = bodies.rows_with(b, at.time);
  const BodyState from = body_state(run, k, rows), to = body_state(run, k + 1, rows);
  at.chainage = met.chainage;
  at.direction = met.direction;
  at.field = met.segment;
  at.speed = between(from.velocity.norm(), to.velocity.norm());
  at.spin = no_value;
  at.translation = between(from.translation, to.translation);
  at.rotation = between(from.rotation, to.rotation);
  out.energy_change = std::abs(to.translation + to.rotation - from.translation - from.rotation);
  out.place << start + met.share * (end - start), between(from.position.z(), to.position.z());
  at.centroid = out.place.z() - elevation_at(trn, out.place.x(), out.place.y());
  at.top = at.centroid + between(from.top, to.top);
  at.bottom = at.centroid + between(from.bottom, to.bottom);
  return out;
}

void add_frame_crossings(LineSums& sums, const RunFile& run, int index, const Trn& trn) {
  const PlanBox box = box_of(sums.line);
  const WholeBodies bodies(run);
  for (int b = 0; b < n_blocks(run); ++b) {
    LineCrossing first;
    first.n_crossings = 0;
    const auto place = [&](int k) {
      return body_place(run, k, bodies.rows_with(b, run.frames.time[k]));
    };
    Vec2 to = place(0);
    for (int k = 0; k + 1 < n_frames(run.frames); ++k) {
      const Vec2 from = to;
      to = place(k + 1);  // of a piece, come off since: its path continues from its block
      if (from == to || (from.cwiseMin(to).array() > box.high.array()).any() ||
          (from.cwiseMax(to).array() < box.low.array()).any())
        continue;
      for (const LineMeeting& met : line_meetings(sums.line, from, to)) {
        if (first.n_crossings == 0) {
          first = crossing_between(run, index, b, bodies, k, from, to, met, trn);
          continue;
        }
        ++first.n_crossings;
      }
    }
    if (first.n_crossings == 0) continue;
    first.at.passed_for_good = first.n_crossings % 2 == 1;
    sums.crossings.push_back(first);
  }
}

Trn frame_of(const PassageGrid& grid) {
  Trn frame;  // no elevations: cells are walked alone
  frame.n_rows = grid.n_rows + 1;
  frame.n_cols = grid.n_cols + 1;
  frame.cell_size = grid.cell_size;
  frame.node0 = grid.corner;
  return frame;
}

void find_cells(LineSums& sums, const PassageGrid& grid) {
  sums.grid = grid;
  const Trn frame = frame_of(grid);
  for (std::size_t i = 0; i + 1 < sums.line.points.size(); ++i) {
    const double start = sums.line.chainage[i], length = sums.line.chainage[i + 1] - start;
    walk_cells(frame, sums.line.points[i].head<2>(), sums.line.points[i + 1].head<2>(),
               [&](const CellPart& part) {
                 const auto cell =
                     static_cast<std::uint32_t>(part.cell.row * grid.n_cols + part.cell.col);
                 const double from = start + part.t_in * length, to = start + part.t_out * length;
                 if (!sums.cells.empty() && sums.cells.back().cell == cell) {
                   sums.cells.back().to = to;
                   return;
                 }
                 sums.of_cell.emplace(cell, sums.cells.size());
                 sums.cells.push_back({cell, from, to});
               });
  }
}

LineCrossing crossing_by_cell(const LineSums& sums, const RunFile& run, int index,
                              const Passage& row, const LineCell& cell) {
  LineCrossing out = crossing_of_block(run, index, row.block);
  FenceArrival& at = out.at;
  at.time = row.first_time;
  at.chainage = 0.5 * (cell.from + cell.to);
  at.speed = row.largest.speed;
  at.spin = no_value;
  at.translation = row.largest.translational_energy;
  at.rotation = row.largest.total_energy - row.largest.translational_energy;
  at.centroid = row.largest.centroid_height;
  at.top = row.largest.top_height;
  at.bottom = no_value;
  out.place = point_on(sums.line, at.chainage);
  out.n_crossings = 0;
  out.by_cells = true;
  out.energy_change = no_value;
  return out;
}

// The block came over another cell under the line.
void raise(LineCrossing& known, const LineCrossing& other) {
  FenceArrival& at = known.at;
  const double energy = std::max(at.energy(), other.at.energy());
  if (std::tie(other.at.time, other.at.chainage) < std::tie(at.time, at.chainage)) {
    at.time = other.at.time;
    at.chainage = other.at.chainage;
    known.place = other.place;
  }
  at.speed = std::max(at.speed, other.at.speed);
  at.translation = std::max(at.translation, other.at.translation);
  at.rotation = energy - at.translation;
  at.centroid = std::fmax(at.centroid, other.at.centroid);
  at.top = std::fmax(at.top, other.at.top);
}

}  // namespace

LineSums start_line(RecordLine line) {
  LineSums sums;
  sums.line = std::move(line);
  return sums;
}

Vec3 point_on(const RecordLine& line, double chainage) {
  const auto after = std::upper_bound(line.chainage.begin() + 1, line.chainage.end() - 1, chainage);
  const auto i = static_cast<std::size_t>(after - line.chainage.begin());
  const double from = line.chainage[i - 1], to = line.chainage[i];
  const double w = std::clamp((chainage - from) / (to - from), 0.0, 1.0);
  return line.points[i - 1] + w * (line.points[i] - line.points[i - 1]);
}

bool has_frames(const RunFile& run) { return !run.reach && n_frames(run.frames) > 2; }

void add_run(LineSums& sums, const RunFile& run, const Trn& trn) {
  const int index = n_runs(sums);
  double mass = 0;
  for (int b = 0; b < n_blocks(run); ++b) mass += run.run_weight * run.blocks.mass[b];
  sums.mass.push_back(mass);
  sums.has_passages.push_back(run.grid.n_rows > 0);
  if (run.grid.n_rows > 0 && sums.grid.n_rows == 0) find_cells(sums, run.grid);
  sums.by_centroid = sums.by_centroid || (run.grid.n_rows > 0 && run.passages_by_centroid);
  if (!has_frames(run)) {
    ++sums.n_by_cells;
    return;
  }
  ++sums.n_by_frames;
  sums.frame_interval = std::max(sums.frame_interval, run.frames.time[1] - run.frames.time[0]);
  add_frame_crossings(sums, run, index, trn);
}

void add_passages(LineSums& sums, const RunFile& run, int index,
                  const std::vector<Passage>& passages) {
  const bool tell_crossings = !has_frames(run);
  for (const Passage& row : passages) {
    const auto found = sums.of_cell.find(static_cast<std::uint32_t>(row.cell));
    if (found == sums.of_cell.end()) continue;
    sums.values[found->first].push_back({index, weight_of(run, row.block), row.largest.total_energy,
                                         row.largest.speed, row.largest.top_height});
    if (!tell_crossings) continue;
    const LineCrossing crossing =
        crossing_by_cell(sums, run, index, row, sums.cells[found->second]);
    const auto [at, is_new] = sums.by_cells.try_emplace({index, row.block}, sums.crossings.size());
    if (is_new)
      sums.crossings.push_back(crossing);
    else
      raise(sums.crossings[at->second], crossing);
  }
}

void finish(LineSums& sums) {
  sums.by_cells.clear();
  std::sort(sums.crossings.begin(), sums.crossings.end(),
            [](const LineCrossing& a, const LineCrossing& b) {
              return std::tie(a.at.run, a.at.block) < std::tie(b.at.run, b.at.block);
            });
}

}  // namespace talus
