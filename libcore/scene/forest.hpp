// libcore/scene/forest.hpp: public
// Stems of trees as obstacles: vertical cylinders that yield as other fixed bodies do
// (scene/fixed_bodies.hpp), without an axis, until they have taken their energy and are gone.
// in:    stems from a list or drawn (scene/stand.hpp)
// out:   their data for the search and the solver; hits on them
//
// Stems have no hulls, so that a forest costs nothing where no block is. Their numbers as fixed
// bodies follow those of the bodies with hulls: see scene/stems.hpp.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/types.hpp"
#include "contact/body_grid.hpp"
#include "contact/ground.hpp"
#include "scene/fixed_bodies.hpp"

namespace talus {

/// A stem before anything hit it, local coordinates.
struct Stem {
  Vec3 foot = Vec3::Zero();  ///< on the ground [m]
  double height = 0;         ///< > 0 [m]
  double radius = 0;         ///< half of the diameter at breast height, > 0 [m]
  double capacity = 0;       ///< energy that breaks it, > 0 [J]
  double deflection = 0;     ///< over which it takes that, > 0 [m]
  std::int32_t section = 0;  ///< index of its [forest.*]
  std::int32_t id = 0;       ///< in that section: of a list its row, else in the order of the stand
  std::int32_t species = 0;  ///< index into known_species()
};

/// Stems of a scene; plain where there are none.
struct Forest {  // clang-format off
  std::vector<Stem> stems;            ///<                                            (n_stems)
  std::vector<Yielding> yieldings;    ///< how each yields                           (n_stems)
  std::vector<GroundClass> faces;     ///< friction, by section                       (n_sections)
  BodyGrid grid;                      ///< stems by place
  double widest = 0;                  ///< largest radius [m]
};  // clang-format on

}  // namespace talus
