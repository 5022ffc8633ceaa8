// libcore/scene/make_scene.hpp: public
// From a block set and a ground to a Scene: masses, principal axes, surfaces in body axes.
// theory 1.3, 1.4
#pragma once

#include <span>

#include "blocks/block_set.hpp"
#include "scene/scene.hpp"

namespace talus {

/// Material of a block.
struct Material {
  double density = 2500;  ///< > 0 [kg/m3]
  double young = 5e10;    ///< E, > 0 [Pa]
  double poisson = 0.25;  ///< nu, 0 to below 0.5 [-]
};

/// Appends the blocks of `set`; `materials` in the order of set.material_names (at least one).
/// Throws InputError for a block without volume, or a density, E or nu out of range.
void add_blocks(Scene& scene, const BlockSet& set, std::span<const Material> materials);
/// The same without surfaces, of which only radius and thickness are kept: 11 kB less a rock.
void add_blocks_without_surfaces(Scene& scene, const BlockSet& set,
                                 std::span<const Material> materials);
/// Appends the surfaces of block b of `set`.
void add_surfaces(const BlockSet& set, int b, Blocks& to);

/// Throws InputError for a scene that cannot be computed: dt <= 0, friction < 0, a restitution
/// outside 0..1, a base motion whose times do not increase.
void check_scene(const Scene& scene);

}  // namespace talus
