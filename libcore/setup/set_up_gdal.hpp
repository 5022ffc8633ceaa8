// libcore/setup/set_up_gdal.hpp: public
// From a site and the files of its terrain and blocks to a scene that a run can begin with.
#pragma once

#include "base/input_log.hpp"
#include "setup/dda_inputs.hpp"
#include "setup/site_scene.hpp"
#include "site/plan.hpp"
#include "site/site.hpp"

namespace talus {

struct SetUpRequest {
  DdaFiles files;
  bool full_plan = false;       ///< compute also parts that the scene does not need
  bool surfaces_later = false;  ///< of make_site_scene()
};

struct SetUp {
  DdaInputs inputs;  ///< without `parts` once the scene is made
  ScenePlan plan;
  Scene scene;      ///< of make_scene()
  BlockSet blocks;  ///< that the scene was made of, with the pieces they may break into
};

/// Plan of the parts that this scene has to compute.
[[nodiscard]] ScenePlan plan_of(const Site& site, const SceneParts& parts, bool full);

/// Reads the inputs and plans the scene. Throws InputError as check_times() and read_dda_inputs().
[[nodiscard]] SetUp plan_scene(const Site& site, const SetUpRequest& request, InputLog& log);

/// Reads the files that make_scene() reads, so that the log has their contents before it.
void read_files_of_scene(const Site& site, InputLog& log, const SetUp& setup);

/// Checks where the blocks start, reads the forests, cuts fragments and makes the scene. Throws
/// InputError as check_start() and make_site_scene().
void make_scene(const Site& site, const SetUpRequest& request, InputLog& log, SetUp& setup);

/// Both.
[[nodiscard]] SetUp set_up(const Site& site, const SetUpRequest& request, InputLog& log);

}  // namespace talus
