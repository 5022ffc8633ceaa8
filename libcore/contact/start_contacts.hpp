// libcore/contact/start_contacts.hpp: public
// Blocks that touch before anything moves: joint faces in contact, where bonds act, and overlaps,
// which are an error of the input.
// in:    hulls placed as cut
// theory: docs/theory/theory.md 1.7 (bond areas)
#pragma once

#include <limits>
#include <vector>

#include "contact/hulls.hpp"

namespace talus {

/// Two faces of different blocks that lie against each other; block_a < block_b.
struct JointContact {
  int block_a = 0, block_b = 0;
  int joint_set_a = 0, joint_set_b = 0;  ///< of the two faces
  Vec3 normal = Vec3::Zero();            ///< unit, from B to A
  Vec3 point = Vec3::Zero();             ///< centre of the common area [m]
  double area = 0;                       ///< common area A_c [m2]
  std::vector<Vec3> outline;             ///< of the common area, in the face of A [m]
};

/// All pairs of faces, not inside a body, whose planes are opposed within `angle` [rad], are not
/// farther apart than `tolerance` [m] at the common area's centre, and have an area in common of
/// more than tolerance^2. Sorted by block_a, block_b, then by face.
[[nodiscard]] std::vector<JointContact> joint_contacts(const Hulls& hulls,
                                                       const PlacedHulls& placed, double tolerance,
                                                       double angle);

/// Two blocks that overlap; block_a < block_b.
struct BlockOverlap {
  int block_a = 0, block_b = 0;
  double depth = 0;            ///< least motion that parts the deepest pair of their parts [m]
  double volume = 0;           ///< common volume [m3]
  Vec3 point = Vec3::Zero();   ///< centroid of the common volume [m]
  Vec3 normal = Vec3::Zero();  ///< of the deepest pair of parts, unit, from B to A
};

/// All pairs of blocks that overlap by more than `tolerance` [m], deepest first. Bodies from
/// number `n_moving` on are fixed: their pairs among themselves are left out. So are, without
/// `among_moving`, those of the moving bodies.
[[nodiscard]] std::vector<BlockOverlap> block_overlaps(
    const Hulls& hulls, const PlacedHulls& placed, double tolerance,
    int n_moving = std::numeric_limits<int>::max(), bool among_moving = true);

/// Part p where it is now, as a polyhedron; tags are the joint sets.
[[nodiscard]] Polyhedron placed_part(const Hulls& hulls, const PlacedHulls& placed, int p);

}  // namespace talus
