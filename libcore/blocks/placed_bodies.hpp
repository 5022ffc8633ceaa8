// libcore/blocks/placed_bodies.hpp: public
// Bodies from elsewhere as a group: scaled together, set on the ground, looked at for overlaps.
// in:    bodies as their mesh has them, or a shape; the ground
// out:   the same bodies at their place, and doubts about them
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "blocks/block_set.hpp"
#include "terrain/trn.hpp"

namespace talus {

[[nodiscard]] double volume_of(const Body& body);  ///< of its parts [m3]

/// Moves all bodies so that their common centre of mass is at 0.
void centre(std::vector<Body>& bodies);

/// Scales all bodies about 0 to this volume in all [m3].
void scale_to_volume(std::vector<Body>& bodies, double volume);

/// Where a group of bodies starts.
struct Placing {
  Mat3 turn = Mat3::Identity();
  Vec3 place = Vec3::Zero();  ///< of the group's 0, local; z NaN: the lowest body on the ground [m]
  /// Of the lowest body; it wins over place.z() unless it is NaN [m].
  double height_above_ground = std::numeric_limits<double>::quiet_NaN();
};

/// Turns the bodies and moves them to their place. Returns how far they reach into the ground [m],
/// 0 where they do not, and NaN where one of them does not lie over known ground.
[[nodiscard]] double put_on_ground(std::vector<Body>& bodies, const Trn& ground,
                                   const Placing& placing);

/// All of the body lies below the ground.
[[nodiscard]] bool is_below(const Body& body, const Trn& ground);

struct BodyOverlaps {
  int n = 0;                 ///< pairs that share more than rounding explains
  double largest_share = 0;  ///< of the smaller body's volume
  std::array<int, 2> worst{};
  /// A body that was inside-out and lies in another one: a cavity, and the body around it.
  std::optional<std::array<int, 2>> cavity;
};
/// `were_turned`: bodies whose surface was inside-out.                               (n_bodies)
[[nodiscard]] BodyOverlaps find_overlaps(const std::vector<Body>& bodies,
                                         const std::vector<bool>& were_turned);

}  // namespace talus
