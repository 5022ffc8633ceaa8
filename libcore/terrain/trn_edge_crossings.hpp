// libcore/terrain/trn_edge_crossings.hpp: public
// Where a straight line in plan crosses the edges of a TRN (triangulated regular network). The
// ground below it is straight between crossings, so it is highest or lowest at one or at an end.
#pragma once

#include <algorithm>
#include <cmath>

#include "terrain/trn.hpp"

namespace talus {

/// Calls visit(share) for each crossing, at `share` (0 to 1) of the line from local `a` to `b`; not
/// in the order of the line, and some twice. An end is visited only where it lies on an edge, and
/// the line is not cut at the rim of the TRN. Diagonals of cells run from north-west to south-east.
template <class Visit>
void for_each_edge_crossing(const Trn& trn, const Vec2& a, const Vec2& b, Visit&& visit) {
  const Vec2 from((a.x() - trn.node0.x()) / trn.cell_size, (trn.node0.y() - a.y()) / trn.cell_size);
  const Vec2 to((b.x() - trn.node0.x()) / trn.cell_size, (trn.node0.y() - b.y()) / trn.cell_size);
  const auto cross_lines = [&](double start, double end) {
    if (start == end) return;
    for (double k = std::ceil(std::min(start, end)); k <= std::max(start, end); ++k)
      visit(std::clamp((k - start) / (end - start), 0.0, 1.0));
  };
  cross_lines(from.x(), to.x());
  cross_lines(from.y(), to.y());
  cross_lines(from.x() - from.y(), to.x() - to.y());  // the diagonals of the cells
}

}  // namespace talus
