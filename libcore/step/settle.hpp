// libcore/step/settle.hpp: public
// Law talus: static start of one block, and the bonds of its faces on cohesive ground.
#pragma once

#include "scene/scene.hpp"
#include "scene/state.hpp"
#include "step/work.hpp"

namespace talus {

/// Lets block b, which touches the ground at rest or slides along it, down into static equilibrium,
/// or into that of sliding where it slides off: its contacts press as they will while it slides,
/// and State::acceleration is that of sliding. Strains, where they are computed and no other block
/// can touch it, are those of that equilibrium. A block that topples or does not touch stays where
/// it is. Other blocks are not looked at.
void settle_block(const Scene& scene, int b, State& state, Work& work);

/// Bonds the faces of block b that lie on cohesive ground at rest, as settle_block does, and leaves
/// the block where it is.
void bond_block(const Scene& scene, int b, State& state, Work& work);

}  // namespace talus
