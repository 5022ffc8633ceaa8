#include "post/places.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/plan2d.hpp"
#include "post/deposit.hpp"

namespace talus {
namespace {

// Whether the segment from a to b comes into the box, its rim included (Liang and Barsky 1984).
bool meets_box(const Vec2& a, const Vec2& b, const Vec2& low, const Vec2& high) {
  double from = 0, to = 1;
  for (int k = 0; k < 2; ++k) {
    const double step = b[k] - a[k];
    if (step == 0) {
      if (a[k] < low[k] || a[k] > high[k]) return false;
      continue;
    }
    const double t = (low[k] - a[k]) / step, u = (high[k] - a[k]) / step;
    from = std::max(from, std::min(t, u));
    to = std::min(to, std::max(t, u));
  }
  return from <= to;
}

bool is_inside(const PlaceRings& rings, const Vec2& point) {
  bool inside = false;
  for (const std::vector<Vec2>& ring : rings)
    if (talus::is_inside(ring, point)) inside = !inside;
  return inside;
}

bool touches(const PlaceRings& rings, const Vec2& low, const Vec2& high) {
  for (const std::vector<Vec2>& ring : rings)
    for (std::size_t i = 0; i < ring.size(); ++i)
      if (meets_box(ring[i], ring[(i + 1) % ring.size()], low, high)) return true;
  return is_inside(rings, (low + high) / 2);
}

bool is_of_line(const std::string& name, const std::string& line) {
  return name == line || name.starts_with(line + ".");
}

}  // namespace

std::vector<std::uint8_t> cells_touched(const PassageGrid& grid, const PlaceRings& rings) {
  std::vector<std::uint8_t> cells(static_cast<std::size_t>(grid.n_rows) * grid.n_cols, 0);
  for (int row = 0; row < grid.n_rows; ++row)
    for (int col = 0; col < grid.n_cols; ++col) {
      const Vec2 low(grid.corner.x() + col * grid.cell_size,
                     grid.corner.y() - (row + 1) * grid.cell_size);
      const Vec2 high = low + Vec2::Constant(grid.cell_size);
      cells[static_cast<std::size_t>(row) * grid.n_cols + col] = touches(rings, low, high);
    }
  return cells;
}

double weight_reaching(const Place& place, const RunFile& run,
                       const std::vector<Passage>& passages) {
  std::vector<std::uint8_t> reaches(static_cast<std::size_t>(n_blocks(run)), 0);
  if (!place.cells.empty()) {
    for (const Passage& passage : passages)
      if (place.cells[passage.cell] != 0) reaches[passage.block] = 1;
  } else {
    for (const Crossing& crossing : run.crossings)
      if (!crossing.beside && is_of_line(run.lines[crossing.line].name, place.line))
        reaches[crossing.block] = 1;
  }
  double weight = 0;
  for (int b = 0; b < n_blocks(run); ++b)
    if (reaches[b] != 0) weight += weight_of(run, b);
  return weight;
}

PlaceReach place_reach(const Place& place, const Released& released,
                       const std::vector<double>& weight) {
  const ShareBasis basis = share_basis_of(released);
  const int n_runs = static_cast<int>(weight.size());
  std::vector<RunWeight> parts;
  double reached = 0, total = 0, runs_hit = 0;
  for (int run = 0; run < n_runs; ++run) {
    total += released.weight[run];
    if (weight[run] == 0) continue;
    parts.push_back({run, weight[run]});
    reached += weight[run];
    runs_hit += basis.run_weight[run];
  }
  PlaceReach out;
  out.share = total > 0 ? std::min(1.0, reached / total) : 0;
  out.interval = parts.empty() ? interval_of_none_or_all(basis, false)
                               : share_interval(basis, parts, out.share);
  out.n_runs_hit = static_cast<int>(parts.size());
  out.share_of_runs = std::min(1.0, runs_hit / basis.runs.whole);
  out.interval_of_runs = run_share_interval(basis, parts);
  out.half_width = (out.interval.high - out.interval.low) / 2;
  out.lacks_masses = std::isnan(out.half_width) && !released.unit.empty();
  if (out.lacks_masses) return out;
  if (std::isnan(out.half_width)) {  // not before the intervals begin
    out.runs_to_add = std::max(1, least_runs_to_resample - n_runs);
    return out;
  }
  if (out.half_width <= place.half_width) return out;
  out.runs_to_add = std::max(
      1, runs_to_add(n_runs, trials_of(basis, parts, out.share), out.share, place.half_width));
  return out;
}

}  // namespace talus
