// libcore/run/runner.hpp: public
// A run from its start, or from a checkpoint, to its end: steps, and their record.
// in:    a Scene, lines, limits
// out:   a RunFile, complete at any moment
#pragma once

#include <string>
#include <vector>

#include "blocks/block_set.hpp"
#include "run/run_data.hpp"

namespace talus {

/// One limit and the run's value against it.
struct HealthCheck {
  std::string name;
  double value = 0, limit = 0;
  bool pass = true;
  bool ends_run = false;  ///< not worth continuing once it is broken
  std::string where;      ///< which block, in what, when, where, its share; empty: nothing to name
};

/// A run at time 0; `info` and `faces` of the blocks' shells go into its file, whose objects are
/// watched. `scene` must outlive it.
[[nodiscard]] Runner begin_run(const Scene& scene, const RunOptions& options,
                               std::vector<RecordLine> lines, RunFile file);
/// A run where the checkpoint in `file` left it: the continuation equals, bit for bit, the run that
/// would have followed. Throws InputError naming `path` when the checkpoint does not belong to the
/// scene.
[[nodiscard]] Runner resume_run(const Scene& scene, const RunOptions& options,
                                std::vector<RecordLine> lines, RunFile file,
                                const std::string& path);

/// One step of the solver, recorded, or some rocks from start to end. True where an interval of
/// health ended: time to look at the limits.
bool advance(Runner& runner);
/// Whether the duration is reached, to half a step, or all rocks are done.
[[nodiscard]] bool is_over(const Runner& runner);
/// How much of the run is computed, 0 to 1.
[[nodiscard]] double done_share(const Runner& runner);
/// Whether the mass is stable and the run may end: `standing_after_s` have passed, no block is
/// farther than `standing_within_m` from where it began or faster than `standing_speed_m_s`, none
/// flies, and nothing shakes the ground. A mass that loosens is faster.
inline constexpr double standing_after_s = 3, standing_within_m = 0.1, standing_speed_m_s = 2e-3;
[[nodiscard]] bool stands(const Runner& runner);
/// Records open flights, the last frame and the last interval of health.
void finish(Runner& runner);

/// Brings `runner.file` up to date; with a checkpoint to resume from, or without.
void update_file(Runner& runner, bool with_checkpoint);

/// The limits, at the last row of health.
[[nodiscard]] std::vector<HealthCheck> health_checks(const Runner& runner);
/// A limit that ends the run is broken: checked after each row of health.
[[nodiscard]] bool has_failed(const Runner& runner);

/// Mass of the blocks that left the known terrain, share of all [-].
[[nodiscard]] double lost_share(const Scene& scene, const State& state);

/// The blocks of a scene as a run file stores them; faces of the shells from the block set, whose
/// vertices are in the same order.
[[nodiscard]] RunBlocks run_blocks(const Scene& scene, const BlockSet& set);

}  // namespace talus
