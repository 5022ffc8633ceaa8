// libcore/step/rough_joints.hpp
// Friction of rough joints, by Barton and Bandis, at the stress on a block's face.
// in:    classes of ground and of joints; normal forces of the last step
// out:   friction of contacts
// theory: docs/theory/theory.md, "Rough joints"
//
// The stress is nominal: the normal force of a block against the other side over the area of its
// face there, whose corners are the contacts. An edge or a corner alone presses with more than the
// strength of the wall: friction is the residual one, as in hits.
#pragma once

#include <span>

#include "contact/contact.hpp"
#include "contact/manifold.hpp"
#include "scene/scene.hpp"
#include "solver/contact_row.hpp"

namespace talus {

/// Makes the friction of `rows`, contacts of block b with the ground, that at its stress; `to_row`
/// turns local axes into theirs, those of the body. Before the first step the force is that of
/// gravity.
void set_rough_friction(const Scene& scene, int b, const Mat3& to_row,
                        std::span<const ContactMemory> memory, std::span<ContactRow> rows);

/// The same of a manifold between two blocks, from the memory of block A.
void set_rough_friction(const Scene& scene, const PairManifold& m,
                        std::span<const ContactMemory> memory, GroundClass& faces);

/// Whether a joint between blocks is rough.
[[nodiscard]] bool has_rough_joints(const Scene& scene);

}  // namespace talus
