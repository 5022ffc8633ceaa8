// libcore/scene/joint_classes.hpp
// Laws of contacts between blocks, by the origin of the faces that touch: friction, cohesion,
// tension and restitution.
// in:    joint sets and materials of the site
#pragma once

#include <vector>

#include "contact/ground.hpp"

namespace talus {

/// Friction and strength by joint set, friction, its weakening and restitution by block.
struct JointClasses {  // clang-format off
  std::vector<GroundClass> of_block;  ///< of the rock; empty: Scene::joint for all       (n_blocks)
  std::vector<GroundClass> of_set;    ///< of a joint set's faces; friction < 0: that of the rock;
                                      ///< restitution is not used                       (n_sets)
};  // clang-format on

}  // namespace talus
