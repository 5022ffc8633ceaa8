// libcore/terrain/seams.hpp
// Steps of one height along a straight line of nodes, where two sources of heights meet.
// in:    a TRN
// out:   lines of nodes
#pragma once

#include <vector>

#include "terrain/trn.hpp"

namespace talus {

/// Between the rows `line` and `line` + 1, or the columns; all of it, or a part.
struct Seam {
  bool between_rows = false;
  int line = 0;
  int middle = 0;     ///< column, or row, in the middle
  double step_m = 0;  ///< height of the second side above the first [m]
};

/// Lines along which the height steps by one amount beyond the slope of both sides, within a
/// quarter over four fifths of the line: by at least 0.5 m, six times the usual step between other
/// lines, and twice that of nine in ten of them. Looks at 1,000 nodes of a line at most, one by one
/// and by medians of 4 and of 16, and needs 16 of either; known ground goes on for 4 lines and
/// more on both sides.
///
/// And such parts of lines, as a tile leaves that ends inside. A part is held against 32 lines on
/// either side; each of its ends lies within 3 looks (or medians) of another part or of the edge of
/// known ground. Of parts that are joined to no edge one is 64 looks long. Where heights are
/// multiples of 0.5 to 10 m, a step is of two of these at least: rounding leaves steps of one.
[[nodiscard]] std::vector<Seam> find_seams(const Trn& trn);

}  // namespace talus
