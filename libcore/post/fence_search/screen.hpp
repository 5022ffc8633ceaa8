// libcore/post/fence_search/screen.hpp
// Effect of fences on candidate lines, from runs in which these lines stopped nothing.
// in:    crossings of the lines, in the order of time; which blocks come to the object
// out:   where along a line a fence belongs; what must be high and strong enough; which runs still
//        have a block on the object
//
// A crossing matters when its block touches the object later. The rest load a fence too. A fence
// is followed hit by hit: a field adds up the energies that it takes and breaks when they are more
// is followed hit by hit: a field adds up the energies that it takes and breaks when they are more
// than its capacity; then the block passes, and all after it. A stopped block has no later hits.
// That stopped rocks dam those behind them is not considered.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "post/fence/fence.hpp"
#include "post/fence/fence_design.hpp"
#include "post/share_interval.hpp"

namespace talus {

/// The shortest stretch that holds `share` of a weight.
struct Stretch {
  double from = 0, to = 0;  ///< [m]
};
/// Places ascending with their weights (> 0); `needed`: weight that the stretch must hold. The
/// first of equally short ones; none where all places together do not hold so much.
[[nodiscard]] std::optional<Stretch> shortest_stretch(const std::vector<double>& place,
                                                      const std::vector<double>& weight,
                                                      double needed);

/// A crossing of a candidate line.
struct SearchHit {
  FenceArrival arrival;
  int block = 0;         ///< among the blocks of all runs
  bool matters = false;  ///< its block touches the object later
};

/// A candidate line; posts and base as recorded, height and capacity not set.
struct SearchLine {
  std::string name;
  Fence fence;
  int side = 1;                 ///< where blocks come from: +1 left of the line, -1 right
  std::vector<SearchHit> hits;  ///< by run, world, time, block; not those beside the line
};
/// Puts the hits in their order.
void sort_hits(SearchLine& line);

/// A block that comes to the object.
struct BlockOnObject {
  BlockWeight of;
  int block = 0;  ///< among the blocks of all runs
};

/// The object in the runs.
struct SearchRuns {
  int n_runs = 0, n_blocks = 0;          ///< blocks: of all runs together
  std::vector<BlockOnObject> on_object;  ///< by run
  ShareBasis basis;                      ///< of the runs
  double density = 0;                    ///< mean of the rock [kg/m3]
  double mean_block_size = 0;            ///< [m]
};
[[nodiscard]] double weight_on_object(const SearchRuns& runs);

/// A fence on a part of a candidate line.
struct PlacedFence {
  int line = 0;             ///< index of the SearchLine
  double from = 0, to = 0;  ///< chainages on it [m]
  int n_fields = 0;
  double height = 0;    ///< [m]
  double capacity = 0;  ///< of a field [J]
  int kind = 0;         ///< its class, from 0
};
[[nodiscard]] inline double length(const PlacedFence& fence) { return fence.to - fence.from; }
[[nodiscard]] inline bool is_on(const PlacedFence& fence, double chainage) {
  return chainage >= fence.from - 1e-9 && chainage <= fence.to + 1e-9;
}
/// Field of a chainage, from 0.
[[nodiscard]] int field_of(const PlacedFence& fence, double chainage);

/// A fence along `stretch` with fields of `spacing` at most, `end_fields` more at each end, and at
/// least `min_fields`; none where the line is too short for it.
[[nodiscard]] std::optional<PlacedFence> place_fence(const SearchLine& line, int index,
                                                     const Stretch& stretch, double spacing,
                                                     int min_fields, int end_fields);

/// Its posts on the line.
[[nodiscard]] Fence fence_on(const SearchLine& line, const PlacedFence& placed);

/// Blocks that a set of fences lets through.
struct ScreenOutcome {
  double stopped = 0;            ///< share of the weight of all hits on the object [-]
  std::vector<BlockWeight> hit;  ///< blocks that still come to the object, by run
  std::vector<bool> is_stopped;  ///< block stopped by any of the fences           (n_blocks)
  std::vector<double> retained;  ///< rock stopped, by fence, median over runs [m3]
};
/// `adds_up`: fields add up the energies that they take; else each hit counts alone.
[[nodiscard]] ScreenOutcome follow(const SearchRuns& runs, const std::vector<SearchLine>& lines,
                                   const std::vector<PlacedFence>& fences, bool adds_up = true);

/// Energies that one field meets in a run, or of a rock that falls alone: the largest single one,
/// the largest sum within one second, the sum of all; the largest of any field and, over the runs
/// with a hit, the quantile `share` [J].
struct FieldLoads {
  double single = 0, second = 0, run = 0;
};
[[nodiscard]] FieldLoads field_loads(const SearchLine& line, const PlacedFence& fence, double share,
                                     const std::vector<bool>& gone = {});

/// Demand of the code on a fence for the hits that matter, without those `gone` already.
struct FenceDemand {
  int n = 0;                ///< hits
  double height = 0;        ///< with the freeboard [m]
  double capacity = 0;      ///< with the factor on the barrier [J]
  bool is_bounded = false;  ///< as many hits as the code's percentiles need
};
[[nodiscard]] FenceDemand fence_demand(const SearchRuns& runs, const SearchLine& line,
                                       const PlacedFence& fence, const DesignCode& code,
                                       const std::vector<bool>& gone = {});

}  // namespace talus
