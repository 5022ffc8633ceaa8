// libcore/terrain/trn_edges_met.hpp: public
// Where a straight line in plan meets the edges of a TRN. Between two of these places the ground
// below it is straight, so that what is largest of it along the line is so at one of them.
#pragma once

#include <algorithm>
#include <cmath>

#include "terrain/trn.hpp"

namespace talus {

/// Calls look(share) for each place where the line from local `a` to `b` meets an edge; not in the
/// order of the line, and some twice. The ends are not looked at for themselves. Edges lie on lines
/// x = const, y = const and x + y = const of the grid.
template <class Look>
void for_each_edge_met(const Trn& trn, const Vec2& a, const Vec2& b, Look&& look) {
  const Vec2 from((a.x() - trn.node0.x()) / trn.cell_size, (trn.node0.y() - a.y()) / trn.cell_size);
  const Vec2 to((b.x() - trn.node0.x()) / trn.cell_size, (trn.node0.y() - b.y()) / trn.cell_size);
  const auto cross_lines = [&](double start, double end) {
    if (start == end) return;
    for (double k = std::ceil(std::min(start, end)); k <= std::max(start, end); ++k)
      look(std::clamp((k - start) / (end - start), 0.0, 1.0));
  };
  cross_lines(from.x(), to.x());
  cross_lines(from.y(), to.y());
  cross_lines(from.x() - from.y(), to.x() - to.y());  // the diagonals of the cells
}

}  // namespace talus
