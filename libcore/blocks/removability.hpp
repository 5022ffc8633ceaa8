// libcore/blocks/removability.hpp: public
// Which blocks of a mass can leave it, in which order, and which of them hold the rest.
// in:    the planes that a block rests on, with the directions that they leave it, and its weight
// out:   whether it can move at all, its direction, its factor of safety; the order of removal
// refs:  Goodman and Shi 1985 (block theory, theorem of removability); Moreau 1962 (the projection
//        on a cone, which is all modes of the vector method at once)
//
// A plane k leaves a block the half space n_k . v >= 0. The intersection of these is its joint
// pyramid. The block moves along the projection of the active force on that pyramid, and slides on
// the planes that are in contact then. Pushing and turning are left out: a block that is found to
// stay may still be pushed away by blocks behind it.
#pragma once

#include <span>
#include <vector>

#include "base/types.hpp"
#include "blocks/block_set.hpp"

namespace talus {

/// Whether some direction is left to a body between planes with these inward unit normals.
[[nodiscard]] bool can_leave(std::span<const Vec3> inward_normals);

/// A plane that a block rests on.
struct RestPlane {
  Vec3 normal = Vec3::UnitZ();  ///< unit, into the block
  double friction = 0;          ///< tangent of the friction angle [-]
  double cohesion = 0;          ///< cohesion times area [N]
};

/// How a block goes under a force.
struct BlockMode {
  Vec3 direction = Vec3::Zero();  ///< projection of the force on the free directions [N]; 0: stays
  std::vector<int> bearing;       ///< planes in contact: none: it falls or is lifted; one; two
  double driving = 0;             ///< length of `direction` [N]
  double resistance = 0;          ///< friction and cohesion of these planes [N]
  [[nodiscard]] bool is_free() const { return driving > 0; }
  [[nodiscard]] bool goes() const { return driving > resistance; }
  /// Resistance over driving force; infinity for a block that nothing drives.
  [[nodiscard]] double factor() const;
};

/// The mode of a block between `planes` under `force`. Where more than two planes are in contact,
/// the forces between them are not unique: the largest resistance is taken.
[[nodiscard]] BlockMode block_mode(const Vec3& force, std::span<const RestPlane> planes);

/// A plane of a block and the block behind it.
struct BlockContact {
  int other = -1;  ///< the block there; -1: rock or ground that stays
  RestPlane plane;
  double area = 0;  ///< [m2]
};

/// Friction of each kind of face of a block set.
struct FaceFriction {
  std::vector<double> of_set;  ///< tangent of the friction angle of each joint set  (n_joint_sets)
  double of_bed = 0;           ///< of the ground below the mass
  double of_rock = 0;          ///< of all other faces
};

/// The contacts of each block: joint faces it shares, failure surface, sides of the source. Faces
/// smaller than 0.02 V^(2/3) are left out.
[[nodiscard]] std::vector<std::vector<BlockContact>> contacts_of(const BlockSet& blocks,
                                                                 const FaceFriction& friction);

/// Planes whose normals lie within one degree taken as one, with their mean friction by area.
[[nodiscard]] std::vector<RestPlane> merged(std::span<const BlockContact> contacts);

/// A block that stays, and the effect of removing it alone.
struct Lock {
  int block = 0;
  double freed = 0;  ///< weight of further blocks that would leave, share of all [-]
};

struct PeelOff {
  std::vector<int> round;       ///< in which a block went, from 0; -1: it stays       (n_blocks)
  std::vector<BlockMode> mode;  ///< when it went, or at the end                       (n_blocks)
  double share = 0;             ///< weight that went, share of all [-]
  double locked_share = 0;      ///< weight that friction does not hold: no direction is left [-]
  std::vector<Lock> locks;      ///< by the weight that they hold, most first; those that hold
                                ///< nothing left out
};

/// Removes, round by round, each block that slides or falls off the remaining ones. `weight` [N].
[[nodiscard]] PeelOff peel_off(std::span<const std::vector<BlockContact>> contacts,
                               std::span<const double> weight);

}  // namespace talus
