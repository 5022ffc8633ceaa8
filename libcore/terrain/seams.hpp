// libcore/terrain/seams.hpp
// Steps of one height along a straight line of nodes, where two sources of heights meet.
// in:    a TRN
// out:   lines of nodes
#pragma once

#include <vector>

#include "terrain/trn.hpp"

namespace talus {

/// Between the rows `line` and `line` + 1, or the columns.
struct Seam {
  bool between_rows = false;
  int line = 0;
  int middle = 0;     ///< column, or row, in the middle of the line
  double step_m = 0;  ///< height of the second side above the first [m]
};

/// Lines along which the height steps by one amount beyond the slope of both sides: by at least 0.5
/// m and six times the usual step between other lines, within a quarter over four fifths of the
/// line. Looks at 1,000 nodes of a line at most.
[[nodiscard]] std::vector<Seam> find_seams(const Trn& trn);

}  // namespace talus
