// libcore/store/passages.hpp
// Which cells each block passed and how: one row per block and cell, kept up between all steps.
// in:    the solver's segments; the terrain; a grid of cells (the TRN's, or one of its own)
// out:   rows whose number grows with the cells touched, not with steps; frames do not enter
//
// A cell is passed while any part of the block's footprint lies over it (or its centroid, by
// choice). The footprint is the vertical projection of the block's vertices, replaced by the
// polygon with the same extent along eight axes 22.5 degrees apart: it holds the footprint, so no
// cell is missed, and stands out from it by at most a tenth of its longest side. A piece of motion
// is straight in plan; where the block turns in it by theta < 0.25 rad, the extents go linearly
// from end to end, widened by the sagitta r theta^2 / 8 (r theta^2 / 4 in free tumbling, whose axis
// turns too; below 2 % of the radius). Entry and exit of each cell and the largest values in
// between are then found in closed form.
#pragma once

#include <vector>

#include "dda/scene.hpp"
#include "dda/work.hpp"
#include "store/motion.hpp"
#include "store/passage_table.hpp"
#include "store/path_heights.hpp"
#include "terrain/trn.hpp"

namespace talus {

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

/// What is kept of a block between two pieces of its motion.
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
  std::vector<LastExtents> last_extents;       ///<                                     (n_blocks)
  std::vector<FlightInstant> flight_instants;  ///< of the flight at hand      (n_pieces + 1)
};

/// The grid of the TRN's own cells, or of cells of `cell_size` from the same north-west corner that
/// covers it (NaN: the TRN's). Throws InputError for more than 1e8 cells.
[[nodiscard]] PassageGrid passage_grid(const Trn& trn, double cell_size);

/// Empty table; the blocks' start is their first passage.
[[nodiscard]] PassageRecorder start_passages(const Scene& scene, const PassageGrid& grid,
                                             bool by_centroid);
/// A block's place and motion before its first segment.
void record_start(PassageRecorder& recorder, const Scene& scene, int block, const Motion& motion,
                  double time);
/// The next segment of a block, which `motion` follows; segments of one block come in the order of
/// time.
void record_passages(PassageRecorder& recorder, const Scene& scene, SegmentMotion& motion);
/// Writes what is pending into the table; further segments may follow.
void flush_passages(PassageRecorder& recorder);

}  // namespace talus
