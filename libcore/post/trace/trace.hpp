// libcore/post/trace/trace.hpp: public
// Which source hits which object, how often and how hard.
// in:    runs with their hits of objects; where each block was released
// out:   objects, source cells behind them, and the links between both
//
// The source of a block is the cell of a grid that it was released in. Sums hold together: the hits
// of an object are those from all source cells; the blocks of a source cell are those that hit any
// object and those that hit none.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "post/deposit.hpp"
#include "post/share_interval.hpp"
#include "record/run_file.hpp"

namespace talus {

/// A block on an object.
struct TraceHit {
  std::int32_t run = 0, object = 0, block = 0;
  std::uint32_t source = 0;  ///< cell of the grid of sources
  double weight = 1, volume = 0;
  double run_weight = 1;      ///< of its run alone
  double time = 0;            ///< of the first touch [s]
  double energy = 0;          ///< with rotation, at the first touch [J]
  double largest_energy = 0;  ///< while over the object [J]
  double top_height = 0;      ///< at the first touch; by cells the largest over them [m]
  Vec2 place = Vec2::Zero();  ///< of the centroid, local; by cells a cell's centre [m]
};

/// Releases of a source cell, all runs together.
struct TraceSource {
  double n = 0, weight = 0, volume = 0;
  double n_none = 0;  ///< blocks that hit no object
};

/// Volumes are weighed by the weights of their runs; numbers are counted.
struct TraceSums {
  PassageGrid sources;                ///< grid of source cells
  std::vector<RecordObject> objects;  ///< as asked for
  std::vector<TraceHit> hits;
  std::map<std::uint32_t, TraceSource> source;
  int n_runs = 0;
  std::vector<double> deposited;               ///< on each object, all runs [m3]      (n_objects)
  std::vector<int> n_recorded;                 ///< runs that watched the object       (n_objects)
  double n_released = 0, volume_released = 0;  ///< all runs together
};

/// Cells of a grid that lie within a few millimetres of an object, ascending: no block on it is
/// over none of them.
[[nodiscard]] std::vector<std::uint32_t> cells_of(const PassageGrid& grid,
                                                  const RecordObject& object);

/// Whether the run watched the object, with the same outline; its index in the run, -1: it did not.
[[nodiscard]] int watched_as(const RunFile& run, const RecordObject& object);

/// Each object as the run watched it, with the roofs that were over it then; as it is where the run
/// did not.
[[nodiscard]] std::vector<RecordObject> as_watched(const RunFile& run,
                                                   const std::vector<RecordObject>& objects);

/// The cells_of() all objects, as pairs of cell and object, ascending.
using ObjectCells = std::vector<std::pair<std::uint32_t, std::int32_t>>;
[[nodiscard]] ObjectCells object_cells(const PassageGrid& grid,
                                       const std::vector<RecordObject>& objects);

/// Hits of one run by the cells that its blocks passed, by object and block: none is missed, some
/// are too many, and values are the largest over the cells.
using CellHits = std::map<std::pair<std::int32_t, std::int32_t>, TraceHit>;
/// Passages of a run may come in several pieces.
void add_cell_hits(CellHits& hits, const ObjectCells& cells, const std::vector<Passage>& passages,
                   const PassageGrid& grid);

/// Adds a run: sources, recorded hits (not with `by_cells`), deposits. `run` needs blocks, objects
/// and the last frame. Hits of objects that it did not watch are added by add_hits().
void add_run(TraceSums& sums, const RunFile& run, double rest_speed, bool by_cells);
/// `run_index`: in the order of add_run().
void add_hits(TraceSums& sums, const RunFile& run, int run_index, const CellHits& hits,
              bool by_cells);
/// Puts hits in their order and counts the blocks of each source that hit nothing; once, at the
/// end.
void finish(TraceSums& sums);

/// Hits of one object, after finish().
[[nodiscard]] std::span<const TraceHit> hits_of(const TraceSums& sums, int object);

/// A percentile of a quantity with its upper bound; NaN: too few.
struct TracePercentiles {
  double p50 = 0, p95 = 0, p95_high = 0, largest = 0;
};

struct ObjectTrace {
  int n_hits = 0, n_runs_hit = 0;
  double run_share = 0;  ///< share of the runs with any hit, by their weights
  Interval run_share_interval;
  double hits_a_run = 0, weight_share = 0, volume_share = 0;  ///< runs by their weights
  Interval weight_share_interval;
  TracePercentiles energy;                       ///< with rotation, at the first touch [kJ]
  double top_height_p95 = 0, first_arrival = 0;  ///< [m], [s]
  double deposited_a_run = 0;                    ///< [m3]
  std::array<int, 3> n_sources{};                ///< source cells behind 50, 90, 100 % of the hits
  std::string method;                            ///< "recorded", "by_cells", "both"
};
struct SourceLink;
/// `links`: of source_links().
[[nodiscard]] ObjectTrace object_trace(const TraceSums& sums, int object, const ShareBasis& basis,
                                       const std::vector<SourceLink>& links);

/// Hits of an object from a source cell.
struct SourceLink {
  std::uint32_t source = 0;
  int object = 0;
  int n_hits = 0;
  double p_hit = 0;           ///< weight of the hits / weight of the blocks released there
  double share_of_hits = 0;   ///< of the object's hits by weight; sums to 1 over the sources
  double energy_p95 = 0;      ///< largest where there are fewer than 59 hits [kJ]
  Vec2 place = Vec2::Zero();  ///< mean place of the hits, local [m]
};
/// By object, the largest share first.
[[nodiscard]] std::vector<SourceLink> source_links(const TraceSums& sums);

/// The middle of a source cell, local [m].
[[nodiscard]] Vec2 place_of_source(const TraceSums& sums, std::uint32_t source);

}  // namespace talus
