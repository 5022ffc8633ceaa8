// libcore/post/places.hpp: public
// How many blocks reach a place, how surely that is known, and how many runs are lacking.
// in:    a place as cells of the grid of passages, or as a line; the runs one by one
// out:   share of blocks and of runs with their intervals, runs to add
//
// A polygon is reached by a block that came over a cell that it touches: no block is missed, and
// some beside it are counted.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "post/maps/maps.hpp"
#include "record/run_file.hpp"

namespace talus {

/// Rings in local coordinates, even-odd, without the first point at the end.
using PlaceRings = std::vector<std::vector<Vec2>>;

/// 1 for each cell of the grid that the area touches.                                (n_cells)
[[nodiscard]] std::vector<std::uint8_t> cells_touched(const PassageGrid& grid,
                                                      const PlaceRings& rings);

struct Place {
  std::string name;
  double half_width = 0.05;         ///< wanted, of the interval of the share of blocks
  std::vector<std::uint8_t> cells;  ///< of the grid; empty: a line                   (n_cells)
  std::string line;                 ///< its name, or that of its parts before the dot
};

/// Adds the blocks of one run that reach the place; `index`: its place among the runs. `passages`:
/// all of that run.
void add_reaching(std::vector<BlockWeight>& blocks, const Place& place, const RunFile& run,
                  int index, const std::vector<Passage>& passages);

struct PlaceReach {
  double share = 0;          ///< of the weight of all released blocks
  Interval interval;         ///< 95 %; NaN where there are too few clusters
  int n_runs_hit = 0;        ///< in which any block reaches it
  double share_of_runs = 0;  ///< of all, each with its weight
  Interval interval_of_runs;
  double half_width = 0;  ///< of `interval`
  RunsToAdd to_add;       ///< until it is as narrow as wanted
};
/// `blocks`: of add_reaching(), run by run.
[[nodiscard]] PlaceReach place_reach(const Place& place, const ShareBasis& basis,
                                     const std::vector<BlockWeight>& blocks);

}  // namespace talus
