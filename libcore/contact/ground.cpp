// Makes the terrain ready for the contact search: flags of convex features and elevation bounds.
#include "contact/ground.hpp"

#include <utility>

namespace talus {

Ground make_ground(Trn trn, const GroundClass& ground_class) {
  Ground ground;
  ground.flags = ground_flags(trn);
  ground.pyramid = build_pyramid(trn);
  ground.trn = std::move(trn);
  ground.classes = {ground_class};
  return ground;
}

}  // namespace talus
