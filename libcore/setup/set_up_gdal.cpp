// Sets up a scene from a site and the files of its terrain and blocks.
#include "setup/set_up_gdal.hpp"

#include <cstdint>
#include <utility>

#include "base/text.hpp"
#include "setup/forest_inputs_gdal.hpp"
#include "setup/run_settings.hpp"
#include "setup/scene_inputs_gdal.hpp"
#include "setup/site_dams_gdal.hpp"
#include "terrain/trn_flags.hpp"

namespace talus {

ScenePlan plan_of(const Site& site, const SceneParts& parts, bool full) {
  return make_plan(plan_facts(site, parts.blocks, parts.trn, ground_flags(parts.trn)), full);
}

SetUp plan_scene(const Site& site, const SetUpRequest& request, InputLog& log) {
  check_times(site);
  std::vector<std::string> odd = warn_of_settings(log, site);
  if (const std::size_t n = site.quantities.size(); n > 0 && site.uncertainty.sample == 0) {
    odd.push_back(std::to_string(n) + (n == 1 ? " quantity" : " quantities") +
                  " of [uncertainty] not drawn: no --sample is given, so the values of the site "
                  "file hold");
    log.warn(odd.back());
  }
  SetUp setup;
  setup.inputs = read_dda_inputs(log, site, request.files);
  setup.inputs.warnings.insert(setup.inputs.warnings.begin(), odd.begin(), odd.end());
  setup.plan = plan_of(site, setup.inputs.parts, request.full_plan);
  return setup;
}

void read_files_of_scene(const Site& site, InputLog& log, const SetUp& setup) {
  static_cast<void>(read_forests(log, site, setup.inputs.parts.trn, setup.inputs.parts.blocks));
}

void make_scene(const Site& site, const SetUpRequest& request, InputLog& log, SetUp& setup) {
  if (setup.inputs.other_dams) throw *setup.inputs.other_dams;
  warn_of_plan(log, site, setup.plan, setup.inputs);
  check_start(log, site, setup.inputs, request.files, setup.plan.block_contacts);
  log.detail(as_text(setup.plan));
  cut_fragments(log, site, setup.inputs);
  setup.blocks = setup.inputs.parts.blocks;
  const bool has_water = setup.inputs.parts.water.has_value();
  setup.scene =
      make_site_scene(site, setup.plan, std::move(setup.inputs.parts), request.surfaces_later);
  if (const std::size_t n = setup.scene.wet_faces.size(); n > 0)
    log.info("[water] is in " + counted(static_cast<std::int64_t>(n), "joint face"));
  else if (has_water)
    log.warn("[water] is below all joint faces, or all are drained: the mass is dry");
}

SetUp set_up(const Site& site, const SetUpRequest& request, InputLog& log) {
  SetUp setup = plan_scene(site, request, log);
  make_scene(site, request, log, setup);
  return setup;
}

}  // namespace talus
