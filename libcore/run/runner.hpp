// libcore/run/runner.hpp: public
// A run from its start, or from a checkpoint, to its end: steps, and what is recorded of them.
// in:    a Scene, lines, limits
// out:   a RunFile, complete at any moment
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "base/workers.hpp"
#include "blocks/block_set.hpp"
#include "record/crossings.hpp"
#include "record/frames.hpp"
#include "record/object_hits.hpp"
#include "record/passages.hpp"
#include "record/run_file.hpp"
#include "run/law.hpp"
#include "scene/scene.hpp"
#include "scene/state.hpp"
#include "step/work.hpp"

namespace talus {

/// Limits of a run's health; what breaks one fails the run.
struct RunLimits {
  double max_penetration = std::numeric_limits<double>::quiet_NaN();  ///< NaN: none [m]
  /// Mechanical energy gained, or lost where all hits return almost all, share of the fall energy.
  double max_energy_gain = 0.01;
  double max_lost_share = 0.01;        ///< mass of the blocks that left the terrain, share [-]
  double max_unconverged_share = 0.1;  ///< accepted without convergence, share of the steps [-]
  double max_deep_share = 1e-3;        ///< mass of the blocks that were deep, share of all [-]
};

struct RunOptions {
  double duration = 0;        ///< > 0 [s]
  double frame_interval = 0;  ///< > 0 [s]
  bool passages = true;
  bool passages_by_centroid = false;
  double passage_cell_size = std::numeric_limits<double>::quiet_NaN();  ///< NaN: the TRN's [m]
  bool strain = false;                                                  ///< store strains in frames
  std::optional<PaperSettings> paper;  ///< law paper moves the blocks, not law talus
  RunLimits limits;
  Workers* workers = nullptr;  ///< share the loops of a step; the bits do not depend on them
};

/// One limit and how the run stands to it.
struct HealthCheck {
  std::string name;
  double value = 0, limit = 0;
  bool pass = true;
  bool ends_run = false;  ///< no sense in going on once it is broken
  std::string where;      ///< which block, in what, when, where, its share; empty: nothing to name
};

/// A run under way. `file` holds what is complete; update_file() adds the rest.
struct Runner {
  const Scene& scene;
  RunOptions options;
  RunLaw law;
  State state;
  Work work;
  PassageRecorder passages;
  CrossingRecorder crossings;
  ObjectRecorder objects;
  FrameSampler sampler;
  SegmentMotion motion;     ///< of the segment at hand
  HealthRow interval;       ///< since the last row of health
  double energy_start = 0;  ///< kinetic, potential and elastic energy at time 0 [J]
  RunFile file;
};

/// A run at time 0; `info` and `faces` of the blocks' shells go into its file, whose objects are
/// watched. `scene` must outlive it.
[[nodiscard]] Runner begin_run(const Scene& scene, const RunOptions& options,
                               std::vector<RecordLine> lines, RunFile file);
/// A run where the checkpoint in `file` left it: what follows equals, bit for bit, what would have
/// followed. Throws InputError naming `path` when the checkpoint does not belong to the scene.
[[nodiscard]] Runner resume_run(const Scene& scene, const RunOptions& options,
                                std::vector<RecordLine> lines, RunFile file,
                                const std::string& path);

/// One step of the solver, recorded.
void advance(Runner& runner);
/// Whether the duration is reached, to half a step.
[[nodiscard]] bool is_over(const Runner& runner);
/// Whether the mass stands and may be left: `standing_after_s` have passed, no block is farther
/// than `standing_within_m` from where it began or faster than `standing_speed_m_s`, none flies,
/// and nothing shakes the ground. A mass that loosens is faster.
inline constexpr double standing_after_s = 3, standing_within_m = 0.1, standing_speed_m_s = 2e-3;
[[nodiscard]] bool stands(const Runner& runner);
/// Records what is still under way (flights, the last frame, the last interval of health).
void finish(Runner& runner);

/// Brings `runner.file` up to date; with a checkpoint to go on from, or without.
void update_file(Runner& runner, bool with_checkpoint);

/// The limits, at the last row of health.
[[nodiscard]] std::vector<HealthCheck> health_checks(const Runner& runner);
/// A limit that ends the run is broken: checked after each row of health.
[[nodiscard]] bool has_failed(const Runner& runner);

/// Mass of the blocks that left the known terrain, share of all [-].
[[nodiscard]] double lost_share(const Scene& scene, const State& state);

/// The blocks of a scene as a run file stores them; faces of the shells from the block set, whose
/// vertices stand in the same order.
[[nodiscard]] RunBlocks run_blocks(const Scene& scene, const BlockSet& set);

}  // namespace talus
