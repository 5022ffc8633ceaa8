// libcore/record/passage_recorder.hpp
// Data of the recording of passages: its grid, each block between two pieces of its motion, and
// the table. Filled by record/passages.hpp and the pieces below it.
#pragma once

#include <vector>

#include "record/motion.hpp"
#include "record/passage_table.hpp"
#include "record/path_heights.hpp"
#include "terrain/trn.hpp"

namespace talus {

struct Scene;

/// Square cells, north-up; cell (r, c) has index r * n_cols + c.
struct PassageGrid {
  Vec2 corner = Vec2::Zero();  ///< local x, y of the north-west corner [m]
  double cell_size = 0;        ///< > 0 [m]
  int n_rows = 0, n_cols = 0;  ///< cells
};

inline constexpr int n_footprint_axes = 8;
using AxisArray = Eigen::Array<double, n_footprint_axes, 1>;

/// Extent of a footprint along the axes (cos, sin)(22.5 deg k), relative to the centroid [m].
struct Extents {
  AxisArray low = AxisArray::Zero(), high = AxisArray::Zero();
};

/// A block at one moment.
struct PassageInstant {
  Motion motion;
  double top = 0;          ///< of the highest vertex above the centroid [m]
  double spin_energy = 0;  ///< [J]
};

/// State of a block between two pieces of its motion.
struct PassageTracker {
  PassageInstant last;
  double last_time = 0;      ///< [s]
  double margin = 0;         ///< the set below cannot change before a point moves this far [m]
  double start_z = 0;        ///< of the centroid [m]
  double path = 0;           ///< of the centroid in plan, up to `last` [m]
  std::vector<int> covered;  ///< cells under the footprint at `last`
  PassageValues pending;     ///< largest since the set was found, not yet in the table
};

/// The extents of a block at the attitude for which they were asked last; recomputed at will.
struct LastExtents {
  Quat attitude = Quat(0, 0, 0, 0);
  Extents extents;
};

/// A block between two pieces of its flight.
struct FlightInstant {
  bool known = false;
  PassageInstant instant;
  Vec2 low = Vec2::Zero(), high = Vec2::Zero();  ///< box around its footprint [m]
};

struct PassageRecorder {
  PassageGrid grid;
  Trn frame;                 ///< the grid as walk_cells() reads it: nodes without elevations
  bool by_centroid = false;  ///< count a cell only while the centroid is over it
  PassageTable table;
  std::vector<PassageTracker> trackers;        ///<                                      (n_blocks)
  std::vector<double> inner_radius;            ///< of a ball in the block, about its centroid [m]
  std::vector<LastExtents> last_extents;       ///<                                     (n_blocks)
  std::vector<FlightInstant> flight_instants;  ///< of the flight at hand      (n_pieces + 1)
};

}  // namespace talus
