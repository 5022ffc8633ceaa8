// libcore/setup/site_scene.hpp: public
// From a site file, its terrain and its blocks to the scene that is computed.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "blocks/block_set.hpp"
#include "scene/fence.hpp"
#include "scene/joint_water.hpp"
#include "scene/scene.hpp"
#include "site/base_motion.hpp"
#include "site/plan.hpp"
#include "site/site.hpp"

namespace talus {

/// Inputs that a site file's settings refer to, read by the caller.
struct SceneParts {
  Trn trn;
  std::vector<std::uint8_t> cell_class;  ///< index into [ground.*]; empty: one class   (n_cells)
  BlockSet blocks;                       ///< in the TRN's local coordinates
  std::vector<Fragment> fragments;       ///< of add_fragments(), which has changed `blocks`
  AccelerationRecord base;
  std::vector<StandingFence> fences;    ///< that are built in the run
  std::vector<Stem> stems;              ///< of its active forests
  std::vector<GroundClass> stem_faces;  ///< by Stem::section
  std::vector<Canopy> canopies;         ///< of the forests that drag
  std::optional<JointWater> water;      ///< of [water]
};

/// [solver] time_step_s, else 5 ms for law talus and 0.1 ms for law paper [s].
[[nodiscard]] double time_step(const SolverSettings& solver);

/// How a site's run is computed: its solver's settings with the decisions of the plan. Without any
/// it is Settings{}.
[[nodiscard]] Settings settings_of(const SolverSettings& solver, const ScenePlan& plan);

/// The law of a section [ground.*].
[[nodiscard]] GroundClass ground_class(const GroundSettings& ground);

/// The ground classes of a site with the friction and restitution that its seed draws, within the
/// range that they can be.
[[nodiscard]] std::vector<GroundSettings> drawn_grounds(const Site& site);

/// The scene with the settings of the site and the decisions of the plan. Scatter of friction and
/// restitution and the jitter of the start are drawn from [solver] seed. Throws InputError for a
/// block material that the site file does not know, and a scene that check_scene() refuses.
///
/// `surfaces_later`: rocks that fall a few at a time have no surfaces, which the caller that runs
/// the scene makes of the block set (RunOptions::surfaces).
[[nodiscard]] Scene make_site_scene(const Site& site, const ScenePlan& plan, SceneParts parts,
                                    bool surfaces_later = false);

/// How blocks are cut for [fragmentation]; `set`: before that.
[[nodiscard]] SplitSettings split_settings(const Site& site, const BlockSet& set);

/// A value of the site file that can be computed with but is far from the values that rock and its
/// models have.
struct UnusualValue {
  std::string key;      ///< "material.rock.density_kg_m3"
  std::string finding;  ///< "is 260 kg/m3; rock has ..."
};
[[nodiscard]] std::vector<UnusualValue> unusual_values(const Site& site);

}  // namespace talus
