// libcore/site/joint_plan.hpp: public
// From the sections of the site file to the inputs of cutting: joint sets, source options, limits.
#pragma once

#include <string>
#include <vector>

#include "blocks/assemble.hpp"
#include "blocks/joint_sets.hpp"
#include "blocks/source.hpp"
#include "site/joint_list.hpp"
#include "site/site.hpp"

namespace talus {

/// A joint set and the section that it came from.
struct PlannedSet {
  JointSet set;
  int section = 0;                   ///< index into Site::joints
  std::vector<Vec3> measured_poles;  ///< that represent it; empty when dip and direction were given
};

/// Joint sets of the site; a section with measured orientations gives n_sets of them, named NAME_1
/// and so on when there is more than one. `lists[i]` is measured_file of section i, as
/// written. Azimuths are turned to the map's north, but those of a list that was computed.
/// Throws InputError for keys that are missing or contradict one another.
[[nodiscard]] std::vector<PlannedSet> plan_joint_sets(const Site& site,
                                                      const std::vector<OrientationList>& lists);

/// Failure surface of [source], local to `origin`; the raster is left empty, and so is the plane of
/// a daylighting surface, which find_failure_planes() finds. Throws InputError when
/// a key that its kind needs is not given.
[[nodiscard]] SourceOptions plan_source(const Site& site, const Vec3& origin);

/// Limits of slivers with their defaults filled in, from the joint sets, the volume of the mass and
/// the number of joint cells expected in it.
[[nodiscard]] AssembleOptions plan_limits(const Site& site, const std::vector<PlannedSet>& sets,
                                          double mass_volume, double expected_cells);

/// Index of the material of that name; the only one when the name is empty.
[[nodiscard]] int material_index(const Site& site, const std::string& name);

}  // namespace talus
