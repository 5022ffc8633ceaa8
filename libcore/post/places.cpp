// Share of blocks and of runs that reach a place, with intervals, and how many runs are lacking.
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

void add_reaching(std::vector<BlockWeight>& blocks, const Place& place, const RunFile& run,
                  int index, const std::vector<Passage>& passages) {
  std::vector<std::uint8_t> reaches(static_cast<std::size_t>(n_blocks(run)), 0);
  if (!place.cells.empty()) {
    for (const Passage& passage : passages)
      if (place.cells[passage.cell] != 0) reaches[passage.block] = 1;
  } else {
    for (const Crossing& crossing : run.crossings)
      if (!crossing.beside && is_of_line(run.lines[crossing.line].name, place.line))
        reaches[crossing.block] = 1;
  }
  for (int b = 0; b < n_blocks(run); ++b)
    if (reaches[b] != 0) blocks.push_back({index, b, weight_of(run, b)});
}

PlaceReach place_reach(const Place& place, const ShareBasis& basis,
                       const std::vector<BlockWeight>& blocks) {
  PlaceReach out;
  double reached = 0;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    reached += blocks[i].weight;
    out.n_runs_hit += i == 0 || blocks[i].run != blocks[i - 1].run;
  }
  out.share = basis.over.whole > 0 ? std::min(1.0, reached / basis.over.whole) : 0;
  out.interval = blocks.empty() ? interval_of_none_or_all(basis, false)
                                : share_interval(basis, blocks, out.share);
  out.share_of_runs = talus::share_of_runs(basis, blocks);
  out.interval_of_runs = run_share_interval(basis, blocks);
  out.half_width = (out.interval.high - out.interval.low) / 2;
  if (out.half_width <= place.half_width) return out;
  out.to_add = runs_to_add(basis, blocks, out.share, place.half_width);
  if (out.to_add.help) out.to_add.n = std::max(1, out.to_add.n);
  return out;
}

}  // namespace talus
