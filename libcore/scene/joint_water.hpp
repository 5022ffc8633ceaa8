// libcore/scene/joint_water.hpp: public
// Water in the joints of a mass at rest: its pressure on each face, as point loads.
// in:    a piezometric surface, open cracks; blocks that lie against each other at the start
// out:   Scene::loads, Scene::wet_faces
// theory: docs/theory/theory.md 1.14; decay of the pressure: step/loads.hpp
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "blocks/area.hpp"
#include "scene/scene.hpp"

namespace talus {

/// How high water is in the joints of a set.
enum class JointFill : std::uint8_t {
  surface,  ///< to the piezometric surface
  crack,    ///< to `crack_fill` above the lowest point of each crack, a plane of the set; at
            ///< most to its highest
  drained   ///< there is none
};

struct JointWater {
  /// z of the piezometric surface at the nodes of the ground, NaN: no water; may be empty [m]
  std::vector<double> surface;
  /// Or its depth below the blocks' faces on the ground surface, elsewhere the ground; NaN: none
  /// [m]
  double depth = std::numeric_limits<double>::quiet_NaN();
  std::vector<JointFill> of_set;           ///< by joint set; sets beyond it have the surface's
  JointFill of_side = JointFill::surface;  ///< walls along the outline of the source
  double crack_fill = 0;                   ///< [m]
  double unit_weight = 0;                  ///< of water [N/m3]
};

/// Adds the pressure of `water` on the faces that lie against each other, on those that lie on the
/// ground, and on the walls of the source: against A and B alike, at the centre of pressure. Faces
/// in the air are dry. Once, when the blocks of the scene are in place.
void add_joint_water(const JointWater& water, Scene& scene);

/// By how much the water of a scene would have to rise (or sink, < 0) to reach the lowest and the
/// highest corner of its joints: below `dry` it is in none. A surface rises as it is, cracks alike.
struct WaterRange {
  double dry = 0, full = 0;  ///< [m]
};
[[nodiscard]] WaterRange water_range(const JointWater& water, const Scene& scene);

/// Resultant of the pressure on a mass between ground and bed that is not cut yet: on its bed, and
/// on the walls along the outline, of which each is a crack of its own where they are cracks [N].
[[nodiscard]] Vec3 water_on_mass(const JointWater& water, const Trn& ground, const Trn& bed,
                                 const Area& area);

}  // namespace talus
