// libcore/record/run_file.hpp: public
// One run as a file: place, time and motion of its blocks. docs/reference/formats.md#run
// in:    the recorder's data
// out:   an HDF5 file that is whole at any moment, or none
//
// A file is always written in one go, under another name, synced, and renamed: a run that is killed
// leaves the file of its last checkpoint, whole and closed. It says so itself (status "running",
// time_s below duration_s) and can be read by everything that reads a finished one.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "record/crossings.hpp"
#include "record/frames.hpp"
#include "record/object_hits.hpp"
#include "record/passages.hpp"
#include "record/reach.hpp"
#include "record/roof_hits.hpp"
#include "scene/events.hpp"
#include "scene/phase.hpp"
#include "step/report.hpp"

namespace talus {

struct State;

/// Description of a run as a whole.
struct RunInfo {
  std::string run_id;          ///< digest of version, settings and inputs
  std::string version;         ///< of the program
  std::string site;            ///< name of the site
  std::string crs_wkt;         ///< of the map; empty when unknown
  Vec3 origin = Vec3::Zero();  ///< map coordinates of the local zero [m]
  std::string trn_sha256;      ///< of the TRN file
  std::string terrain_digest;  ///< of the terrain before the slide, where there are several rock
                               ///< masses, each with a bed of its own; else empty
  std::string blocks_hash;     ///< of the block set
  std::string law;             ///< "talus" or "paper"
  std::int64_t seed = 0;
  bool seed_draws = true;                ///< another seed gives another run
  std::string case_name;                 ///< the variant of settings that it is of; "": none
  bool independent = false;              ///< each block moved as if it were alone, among
                                         ///< fences and trees as they were at the start
  bool weights_are_frequencies = false;  ///< weights of blocks are events a year, not shares
  std::string status = "running";        ///< "running", "done" or "failed"
  std::string reason;                    ///< why it failed
  double duration = 0;                   ///< asked for [s]
  double time = 0;                       ///< reached [s]
  std::string config;                    ///< effective settings, TOML
  std::string made_with;  ///< options that are not in `config`, digests of the files read
  std::string plan;       ///< parts computed and left out, JSON
  std::string warnings;   ///< a line each, of inputs and settings; no paths
};

/// The blocks as they are drawn and weighed.
struct RunBlocks {  // clang-format off
  std::vector<double> mass;              ///< [kg]                                    (n_blocks)
  std::vector<double> volume;            ///< [m3]                                    (n_blocks)
  std::vector<double> weight;            ///< in statistics; empty: 1 each            (n_blocks)
  std::vector<int> parent;               ///< that a piece may come from, -1: released; empty:
                                         ///< nothing breaks                          (n_blocks)
  std::vector<int> generation;           ///< breaks before it; empty: nothing breaks (n_blocks)
  std::vector<int> body;                 ///< its number in the run, once pieces are merged into
                                         ///< blocks (record/pieces.hpp); empty: that of the row
  std::vector<Vec3> inertia;             ///< principal moments [kg m2]               (n_blocks)
  std::vector<Pose> rest;                ///< as cut, local                           (n_blocks)
  std::vector<int> vertex_begin{0};      ///< vertices of block b: [b], [b + 1)       (n_blocks + 1)
  std::vector<Vec3> vertices;            ///< body axes [m]                           (n_vertices)
  std::vector<int> face_vertices;        ///< into `vertices`, counter-clockwise from outside
  std::vector<int> face_begin{0};        ///< first entry of face f                   (n_faces + 1)
  std::vector<int> block_face_begin{0};  ///< faces of block b: [b], [b + 1)          (n_blocks + 1)
};  // clang-format on

/// Frames as they are stored: positions in full, the rest in single precision.
struct RunFrames {  // clang-format off
  std::vector<double> time;      ///< [s]                                (n_frames)
  std::vector<double> position;  ///< of the centroids, local [m]        (n_frames x n_blocks x 3)
  std::vector<float> attitude;   ///< w x y z, body to local axes        (n_frames x n_blocks x 4)
  std::vector<float> velocity;   ///< [m/s]                              (n_frames x n_blocks x 3)
  std::vector<float> spin;       ///< local axes [rad/s]                 (n_frames x n_blocks x 3)
  std::vector<float> strain;     ///< empty when not asked for [-]       (n_frames x n_blocks x 6)
};  // clang-format on
void append(RunFrames& frames, const Frame& frame, bool with_strain);

/// Health over an interval that ends at `time`; counts are those of the interval.
struct HealthRow {
  double time = 0;         ///< [s]
  double shortest_dt = 0;  ///< of a step with contact search; 0 when there was none [s]
  std::int64_t steps = 0, substeps = 0, passes = 0, flips = 0, impacts = 0, unconverged = 0;
  std::int64_t left_domain = 0;                   ///< blocks that have left the known terrain
  std::int64_t fell_through = 0, not_finite = 0;  ///< steps so far with such a block
  std::array<std::int64_t, substep_cut_names.size()> cuts{};  ///< substeps made again, by reason
  double largest_error = 0;                                   ///< estimated of a substep [-]
  double largest_penetration = 0;                             ///< [m]
  double translation = 0, rotation = 0, potential = 0, elastic = 0;   ///< at `time` [J]
  double friction = 0, impact = 0, contact = 0, base = 0, fence = 0;  ///< since the start [J]
  double rolling = 0, drag = 0, breakage = 0, water = 0;              ///< since the start [J]
  double removed = 0;                                                 ///< since the start [J]
};
/// Energy that is gone since the start [J].
[[nodiscard]] inline double spent_energy(const HealthRow& row) {
  return row.friction + row.impact + row.contact + row.fence + row.rolling + row.drag +
         row.breakage + row.removed;
}

/// A panel of a fence, as it was at the end. In a run of independent rocks: as it was at
/// the start, and once more for each rock that pushed it, as that rock left it.
struct PanelRow {
  std::int32_t line = 0, panel = 0;  ///< panel: number in its line, from 0
  double capacity = 0;               ///< infinite: rigid [J]
  double work = 0;                   ///< taken from blocks [J]
  double deflection = 0;             ///< to the left of the line, lasting [m]
  double broken_at = 0;              ///< infinite: it is whole [s]
  std::int32_t broken_by = -1;       ///< block, -1: it is whole
  std::int32_t rock = -1;            ///< that alone met it so: the released block, by its number in
                                     ///< the run; -1: all blocks
};
/// By line; after them those of rocks, by rock, then line.
[[nodiscard]] std::vector<PanelRow> panel_rows(const Scene& scene, const State& state);

/// A block that was in something by more than a tenth of its thickness, and its possible effects.
struct DeepRow {
  /// Values of `partner` below the numbers of blocks.
  static constexpr std::int32_t ground = -1, fence = -2, fixed_body = -3;

  std::int32_t block = 0;
  std::int32_t partner = ground;       ///< in which block it was deepest
  std::int32_t line = -1, panel = -1;  ///< of a fence
  std::int64_t steps = 0;              ///< that ended with it so deep
  double first_time = 0, time = 0;     ///< of the first of them; when it was deepest [s]
  double depth = 0, thickness = 0;     ///< [m]
  Vec3 place = Vec3::Zero();           ///< of its centroid when it was deepest, local [m]
  double mass_share = 0;               ///< of the mass of all blocks [-]
  std::int32_t ends_in_toe = 0;        ///< 1: farther from the top than 95 % of the mass
  std::int32_t met_fence = 0;          ///< 1: in a fence, or deep before it touched or crossed one
  std::int32_t is_too_fast = 0;        ///< 1: was faster than its fall can have made it
};

/// A forest of the run.
struct ForestInfo {
  std::string name;          ///< of the section
  std::int32_t n_stems = 0;  ///< at the start
};

/// A touch of a block and a stem, and the stem as it was at the end.
struct TreeHitRow {
  std::int32_t forest = 0;      ///< index into RunFile::forests
  std::int32_t stem = 0;        ///< its id in that forest
  std::int32_t species = 0;     ///< index into known_species()
  Vec3 foot = Vec3::Zero();     ///< local [m]
  double dbh = 0;               ///< [m]
  double capacity = 0;          ///< before anything hit it [J]
  double left = 0;              ///< of it at the end of the run, 0 once it is broken [J]
  double broken_at = 0;         ///< infinite: it is whole [s]
  std::int32_t broken_by = -1;  ///< block, -1: it is whole
  StemHit hit;                  ///< hit.stem says nothing once it is read
};

/// Everything that a run file holds.
struct RunFile {
  RunInfo info;
  RunBlocks blocks;
  RunFrames frames;
  std::optional<RunReach> reach;  ///< replaces the frames between the first and the last
  PassageGrid grid;
  bool passages_by_centroid = false;
  std::vector<Passage> passages;  ///< by block, then cell
  std::vector<RecordLine> lines;
  std::vector<Crossing> crossings;  ///< by line, then block
  std::vector<RecordObject> objects;
  std::vector<ObjectHit> object_hits;  ///< by object, then block
  std::vector<RoofHit> roof_hits;      ///< by line, then block
  std::vector<FenceHit> fence_hits;    ///< by time, step by step
  std::vector<PanelRow> panels;        ///< of the fences (panel_rows)
  std::vector<ForestInfo> forests;     ///< of the run
  std::vector<TreeHitRow> tree_hits;   ///< by time, step by step
  std::vector<HealthRow> health;
  std::vector<DeepRow> deep;          ///< by block
  std::vector<Break> breaks;          ///< by time; blocks by their number in the run
  std::vector<CrushedBlock> crushed;  ///< by time
  std::vector<Phase> phase;           ///< at info.time; empty: not known               (n_blocks)
  std::vector<std::uint8_t> checkpoint;  ///< store/checkpoint.hpp; empty when the run is done
  /// How much it counts among the runs that are evaluated with it, 1 on average; not in the file
  /// [-]
  double run_weight = 1;
};

[[nodiscard]] inline int n_blocks(const RunFile& run) {
  return static_cast<int>(run.blocks.mass.size());
}
[[nodiscard]] inline int n_frames(const RunFrames& frames) {
  return static_cast<int>(frames.time.size());
}
/// Statistical weight of a block, times that of its run; 1 when the run names none.
[[nodiscard]] inline double weight_of(const RunFile& run, int block) {
  return run.run_weight * (run.blocks.weight.empty() ? 1 : run.blocks.weight[block]);
}
/// Block b in frame k; strain zero when it was not stored.
[[nodiscard]] FrameBlock frame_block(const RunFile& run, int k, int b);

/// Parts to read beside info and blocks; files of many runs are read for their passages alone.
struct RunParts {
  bool frames = true, passages = true, crossings = true, health = true, checkpoint = true;
  bool objects = true;           ///< and their hits
  bool only_last_frame = false;  ///< of the frames
  bool only_faults = false;      ///< of the health, penetrations and counts of faults
  bool words = true;             ///< info's config, made_with and plan
  bool merge_pieces = true;      ///< of blocks that broke, see record/pieces.hpp
  bool trees = true;             ///< hits of trees
};

/// Reads a run file. Throws InputError for a file that is not a run, is damaged, or contradicts
/// itself (an index out of range, arrays of different lengths, numbers that are not finite where
/// they must be).
[[nodiscard]] RunFile read_run_file(const std::string& path, const RunParts& parts = {});

/// The data that tell whether runs belong together: `info` and `grid`.
[[nodiscard]] RunFile read_run_head(const std::string& path);

/// Writes `run` to `path` itself, synced. Equal content gives equal bytes.
void write_run_file(const std::string& path, const RunFile& run);

/// Writes to a name beside `path` and puts it in its place when it is whole.
void replace_run_file(const std::string& path, const RunFile& run);

}  // namespace talus
