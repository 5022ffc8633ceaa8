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

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "dda/scene.hpp"
#include "dda/work.hpp"
#include "store/motion.hpp"
#include "terrain/trn.hpp"

namespace talus {

/// Square cells, north-up; cell (r, c) has index r * n_cols + c.
struct PassageGrid {
  Vec2 corner = Vec2::Zero();  ///< local x, y of the north-west corner [m]
  double cell_size = 0;        ///< > 0 [m]
  int n_rows = 0, n_cols = 0;  ///< cells
};

/// The largest values of a block while it was over a cell. Floats: a maximum of rounded numbers is
/// the rounded maximum, so rounding early changes nothing.
struct PassageValues {
  static constexpr float unknown = std::numeric_limits<float>::quiet_NaN();
  float speed = 0;                  ///< of the centroid [m/s]
  float translational_energy = 0;   ///< [J]
  float total_energy = 0;           ///< translation and rotation at the same moment [J]
  float centroid_height = unknown;  ///< above the ground below it; NaN: no known ground [m]
  float top_height = unknown;  ///< of the highest vertex above the ground below the centroid [m]

  void raise(const PassageValues& other);  ///< element-wise maximum; NaN gives way
};

struct Passage {
  std::int32_t block = 0;
  std::int32_t cell = 0;  ///< index in the grid
  PassageValues largest;
  float first_time = 0;  ///< when the block came over the cell [s]
  /// Then: from its centroid's start, below the horizontal, atan(drop / length of its path in plan)
  /// [rad]; NaN before it has moved in plan.
  float travel_angle = PassageValues::unknown;
  float heading = PassageValues::unknown;  ///< then, from x to y [rad]; NaN: it stood in plan
};

/// Rows with an index over (block, cell): open addressing, grown by doubling.
struct PassageTable {
  std::vector<Passage> rows;         ///< in the order of the first visit
  std::vector<std::uint32_t> slots;  ///< row + 1, 0 empty; a power of two

  /// The row of a block and cell that the block came over at `time` or before, else null.
  [[nodiscard]] Passage* earlier(std::int32_t block, std::int32_t cell, float time);
  /// A block over a cell: its values raise those of earlier visits, its arrival counts if it is the
  /// first.
  void raise(const Passage& visit);
};

/// Rows in the order of block, then cell: what is written.
[[nodiscard]] std::vector<Passage> sorted(const PassageTable& table);

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
/// covers it (NaN: the TRN's).
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

/// The way of a block's centroid and of its top above it: straight in plan, z(s) = from + (to -
/// from) s - sag s (1 - s) with sag = a_z h^2 / 2, s from 0 to 1.
struct HeightPath {
  Vec3 from, to;                    ///< centroid [m]
  double top_from = 0, top_to = 0;  ///< highest vertex above the centroid, linear in s [m]
  double sag = 0;                   ///< [m]
};
struct Heights {
  double centroid = PassageValues::unknown, top = PassageValues::unknown;  ///< [m]
};
/// Greatest heights above the ground below the centroid for s from s_in to s_out. Exact for the
/// TRN's triangles. NaN where no ground is known below the path.
[[nodiscard]] Heights largest_heights(const Trn& trn, const HeightPath& path, double s_in,
                                      double s_out);

}  // namespace talus
