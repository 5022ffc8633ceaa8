// libcore/run/run_data.hpp
// Options of a run, and its data while it is under way.
// filled by: run/runner.hpp, and run/rocks.hpp for rocks that fall one by one
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>

#include "base/workers.hpp"
#include "blocks/block_set.hpp"
#include "record/crossings.hpp"
#include "record/frames.hpp"
#include "record/object_hits.hpp"
#include "record/passage_rows.hpp"
#include "record/passages.hpp"
#include "record/roof_hits.hpp"
#include "record/run_file.hpp"
#include "run/law.hpp"
#include "scene/scene.hpp"
#include "scene/state.hpp"
#include "step/work.hpp"

namespace talus {

/// Limits of a run's health; a run that breaks one fails.
struct RunLimits {
  double max_penetration = std::numeric_limits<double>::quiet_NaN();  ///< NaN: none [m]
  /// Mechanical energy gained, or lost where all hits return almost all, share of the fall energy.
  double max_energy_gain = 0.01;
  double max_lost_share = 0.01;        ///< mass of the blocks that left the terrain, share [-]
  double max_unconverged_share = 0.1;  ///< accepted without convergence, share of the steps [-]
  double max_deep_share = 1e-3;        ///< of the mass, or of rocks one by one, that was deep [-]
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
  const BlockSet* surfaces = nullptr;  ///< of rocks whose scene has none (make_site_scene)
  Workers* workers = nullptr;  ///< share the loops of a step, or the rocks that fall one by one;
                               ///< the bits do not depend on them
  std::string folder;          ///< takes the passages of rocks one by one that are more than
  std::size_t passages_in_memory = 1 << 18;  ///< these; empty: none
  std::function<bool()>
      is_stopped;  ///< asked by any thread before the next few rocks; may be empty
};

/// A run under way. `file` holds the complete part; update_file() adds the rest.
///
/// Rocks that fall one by one are computed from start to end, a few at a time (run/rocks.hpp):
/// `state` and `file` then hold those before `n_done`, and the rest are at their start.
struct Runner {
  const Scene& scene;
  RunOptions options;
  RunLaw law;
  State state;
  Work work;
  PassageRecorder passages;
  CrossingRecorder crossings;
  ObjectRecorder objects;
  RoofRecorder roofs;
  FrameSampler sampler;
  SegmentMotion motion;     ///< of the segment at hand
  HealthRow interval;       ///< since the last row of health
  double energy_start = 0;  ///< kinetic, potential and elastic energy at time 0 [J]
  RunFile file;
  std::shared_ptr<PassageRows> earlier = {};  ///< passages before those in `file`; may be null
  int n_done = 0;  ///< rocks of a run of rocks one by one, else all blocks
};

}  // namespace talus
