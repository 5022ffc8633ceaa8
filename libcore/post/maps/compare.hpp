// libcore/post/maps/compare.hpp: public
// Difference of two ensembles of runs, cell by cell, and how sure it is.
// in:    passages of both by cell of one map
// out:   differences of reach and percentiles with their 95 % intervals
//
// The interval of a difference is made of those of both sides, each taken as far as it reaches
// towards the other, as if they were independent (Newcombe 1998; Zou and Donner 2008). That of
// reach is of pairs (post/paired.hpp) where the runs have the same seeds and ten pairs differ.
#pragma once

#include "post/maps/maps.hpp"
#include "post/paired.hpp"

namespace talus {

struct ComparedRuns {
  const CellRows& cells;
  const ShareBasis& basis;
};

/// Of b - a.
struct Difference {
  double value = 0, low = 0, high = 0;
};
/// A side with its interval; NaN where there is none.
struct Estimate {
  double value = 0, low = 0, high = 0;
};
[[nodiscard]] Difference difference(const Estimate& a, const Estimate& b);

/// `b` minus `a` over the cells that either touched: reach_probability_difference, and of speed,
/// energy and height of the top the differences of p50 and p95, each with _lo and _hi.
/// `pairs`: all runs of `a` and `b`, or none. Of pairs both shares are of what `a` released: rocks
/// that `b` does not release, or less often, reach nothing there.
[[nodiscard]] MapLayer comparison_layer(const ComparedRuns& a, const ComparedRuns& b,
                                        const RunPairs& pairs = {});

}  // namespace talus
