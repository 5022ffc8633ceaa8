// libcore/scene/bonds.hpp: public
// Bonds that hold joint faces together until they break, and the class of the faces that touch.
// in:    joint classes of the scene; blocks that lie against each other before anything moves
// theory 1.7 (bonded area, brittle), docs/developing/design-notes.md
#pragma once

#include <span>
#include <vector>

#include "contact/ground.hpp"
#include "contact/manifold.hpp"
#include "contact/start_contacts.hpp"
#include "scene/scene.hpp"

namespace talus {

/// Two blocks whose faces in one direction hold together: intact while area > 0. Part of the state.
struct BlockBond {
  int block_a = 0, block_b = 0;  ///< block_a < block_b
  double area = 0;               ///< A_c of the common faces; 0 once broken [m2]
  GroundClass face;              ///< friction and strength of the joint
  Vec3 normal = Vec3::Zero();    ///< unit, from B to A, body axes of A
};

/// Class of the contacts of a manifold: of the two faces the smaller friction and restitution;
/// friction weakens with speed where that of both does.
///
/// A face of a joint set has the friction and the strength of that set, any other face those of its
/// block's rock.
[[nodiscard]] GroundClass pair_class(const Scene& scene, const PairManifold& manifold);

/// Gap of faces that lie against each other where the blocks start [m].
[[nodiscard]] double closed_gap(const Scene& scene);

/// The faces of released blocks that lie against each other where the blocks start.
[[nodiscard]] std::vector<JointContact> closed_faces(const Scene& scene);

/// Bonds of all faces that lie against each other where the blocks start and both have cohesion, or
/// both tensile strength: one for the faces of two blocks in one direction. Sorted by block_a, then
/// block_b.
[[nodiscard]] std::vector<BlockBond> start_bonds(const Scene& scene);

/// Index of the intact bond of two blocks along `normal`, from B to A, local axes, where A has
/// `attitude`; -1: none.
[[nodiscard]] int find_bond(std::span<const BlockBond> bonds, int block_a, int block_b,
                            const Quat& attitude, const Vec3& normal);

}  // namespace talus
