// tools/check/look.hpp
// All that a look at a site finds before anything is computed.
#pragma once

#include <string>
#include <vector>

#include "blocks/bed_equilibrium.hpp"
#include "blocks/kinematics.hpp"
#include "blocks/removability.hpp"
#include "run/probe.hpp"
#include "setup/scene_inputs_gdal.hpp"
#include "setup/source_work.hpp"
#include "site/plausibility.hpp"
#include "terrain/slider.hpp"
#include "tools/frame/failure_outlines.hpp"
#include "tools/frame/tool.hpp"

namespace talus {

struct CheckFiles {
  std::string trn, bed, blocks;
  bool settle = false;  ///< as the runs will be
};

/// The volume of the mass by three methods [m3].
struct ThreeVolumes {
  double cut = 0;    ///< of the blocks
  double prism = 0;  ///< between ground and bed inside the polygon, exact
  double nodes = 0;  ///< area of the polygon times the mean depth at its nodes
};

/// Section of the site file that a line is of.
[[nodiscard]] inline std::string section_of(const RecordLine& line) {
  if (is_gallery(line)) return "dam" + line.name.substr(line.name.find('.'));
  return (is_dam(line) ? "" : "fence.") + line.name;
}

/// Fall lines at a fence.
struct FenceLook {
  RecordLine line;
  double height = 0;          ///< [m]
  bool stands = false;        ///< it stops blocks
  bool is_dam = false;        ///< the crest of a dam, or a gallery's edge: ground
  double low = 0, high = 0;   ///< of its base, local z [m]
  int n_fall_lines = 0;       ///< that cross it
  int n_from_downhill = 0;    ///< of these, that cross a dam's crest towards uphill
  double nearest = 0;         ///< distance of the nearest fall line; 0 where one crosses it [m]
  bool is_in_source = false;  ///< a post is in the source
};

/// Fall lines at an object.
struct ObjectLook {
  RecordObject object;
  double distance = 0;        ///< in plan, from the nearest block [m]
  int n_fall_lines = 0;       ///< that come onto it
  bool is_in_source = false;  ///< a block is on it
};

struct Look {
  CheckFiles files;
  BlocksWork work;   ///< site, ground, area, sets, planes, wedges
  DdaInputs inputs;  ///< bed, blocks, classes of ground, lines of fences
  bool is_cut = false;

  // the mass; of a source that is cut
  MassMeasure measure;
  ThreeVolumes volume;
  double mean_depth = 0, relief = 0, width = 0;  ///< [m]
  Attitude slope;
  double motion = 0;  ///< azimuth of the failure surface's fall, or of the slope's [rad]
  std::vector<FootStep> foot;
  double step = 0,
         step_share = 0;    ///< largest step at the foot [m]; share of it with one that counts
  double low_step = 0.1;    ///< from where on a step counts: it is not low for the blocks [m]
  double rising_share = 0;  ///< of the mass over bed that rises against the motion
  BedEquilibrium equilibrium;
  Kinematics kinematics, smooth_kinematics;  ///< of the triangles, and of means of 3 x 3 nodes
  PeelOff peel;
  std::vector<OutlinedSurface> surfaces;  ///< that the mass could leave on

  // fall lines
  std::vector<SliderPath> slides;
  double travel_duration = 0;  ///< that they ask for [s]
  std::vector<FenceLook> fences;
  std::vector<ObjectLook> objects;

  // the engine
  bool is_probed = false;
  Probe probe;
  double probe_cpu_s = 0;

  Json stability;  ///< result of talus-stability; null: not asked for

  std::vector<Doubt> doubts;
};

/// Reads the files and looks at everything but the engine. Results before an InputError
/// stay.
void look_at(Tool& tool, const Site& site, const CheckFiles& files, Look& look);

/// Adds the probe: `duration` s of the run.
void probe_look(Tool& tool, double duration, Look& look);

/// After all else.
void find_doubts(Look& look);

/// Whether the run can be computed as a packed mass (law talus).
[[nodiscard]] bool can_be_probed(const Look& look);

}  // namespace talus
