// libcore/post/profile/line_sums.hpp: public
// Blocks of runs at a line that was drawn after them.
// in:    runs one by one, with frames or passages; a line on the ground
// out:   which blocks cross the line and how; the passages of each cell under it
//
// Two questions. Across: blocks that cross the line, from frames, linear between two of them,
// for the centroid; of a run without frames by the cells under the line, which a block's footprint
// touched: no block too few, some too many, values the largest over these cells. Along: the largest
// values of each block over each cell under the line, from passages alone.
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "post/fence/fence.hpp"
#include "post/maps/maps.hpp"
#include "record/run_file.hpp"

namespace talus {

/// A block that crosses the line, when it first does.
struct LineCrossing {
  /// Heights are above the ground where it crosses; by cells the lowest vertex is not known (NaN),
  /// energies and heights are the largest, and chainage and time those of the cell that came first.
  FenceArrival at;
  Vec3 place = Vec3::Zero();  ///< of the centroid, local; by cells on the ground [m]
  double mass = 0;            ///< [kg]
  double run_weight = 1;      ///< [-]
  int n_crossings = 1;        ///< of the line in all, returns included; by cells 0
  bool by_cells = false;
  /// Of the energy with rotation, between the two frames about the crossing: nine in ten
  /// energies are off by less; NaN by cells [J].
  double energy_change = 0;
};

/// The part of the line over a cell of the passages' grid.
struct LineCell {
  std::uint32_t cell = 0;
  double from = 0, to = 0;  ///< chainage [m]
};

/// The largest values of a block over a cell.
struct CellValue {
  int run = 0;
  double weight = 1;
  double energy = 0;  ///< with rotation [J]
  double speed = 0;   ///< [m/s]
  double top = 0;     ///< of the highest vertex above the ground; NaN: not known [m]
};

struct LineSums {
  RecordLine line;                      ///< its points are the stations, on the ground
  std::vector<LineCrossing> crossings;  ///< by run, then block, once finished
  std::map<std::pair<int, int>, std::size_t> by_cells;  ///< run, block -> `crossings`; not finished
  PassageGrid grid;                                     ///< 0 rows: no run has passages
  std::vector<LineCell> cells;                          ///< under the line, in its order
  std::map<std::uint32_t, std::size_t> of_cell;         ///< cell -> first of `cells`
  std::map<std::uint32_t, std::vector<CellValue>> values;  ///< by cell, as far as blocks came
  std::vector<double> mass;             ///< of each run, times its weight [kg] (n_runs)
  std::vector<bool> has_passages;       ///<                                    (n_runs)
  int n_by_frames = 0, n_by_cells = 0;  ///< runs
  double frame_interval = 0;            ///< longest of the runs with frames [s]
  bool by_centroid = false;             ///< some runs passed cells by centroids alone
};
[[nodiscard]] inline int n_runs(const LineSums& sums) { return static_cast<int>(sums.mass.size()); }

/// `line`: with a point at each station.
[[nodiscard]] LineSums start_line(RecordLine line);

/// Place of the line at a chainage, straight between two stations; beyond the ends that of the end,
/// local [m].
[[nodiscard]] Vec3 point_on(const RecordLine& line, double chainage);

/// Whether frames give the crossings of a line: there is one between the first and the last.
[[nodiscard]] bool has_frames(const RunFile& run);

/// Adds a run: its blocks, and the crossings by its frames where it has_frames(). Its passages are
/// added by add_passages().
void add_run(LineSums& sums, const RunFile& run, const Trn& trn);

/// Adds rows of passages of the run that add_run() took as number `index`. They may come in several
/// pieces; without frames they give the crossings.
void add_passages(LineSums& sums, const RunFile& run, int index,
                  const std::vector<Passage>& passages);

/// Puts crossings in their order; once, at the end.
void finish(LineSums& sums);

}  // namespace talus
