// libcore/scene/canopy.hpp: public
// Forests that drag blocks in their undergrowth and crowns, and have no stem in them.
// in:    areas in plan, heights above the ground
// out:   viscous drag on the mass centre of a block, -d v
// docs/theory/theory.md, Stems; step/soil.hpp applies it
#pragma once

#include <vector>

#include "base/types.hpp"
#include "blocks/prepared_area.hpp"
#include "terrain/trn.hpp"

namespace talus {

/// A stand of trees with its drag.
struct Canopy {
  PreparedArea area;  ///< local coordinates
  Vec2 low, high;     ///< of the box around it [m]
  double height = 0;  ///< up to which it drags, above the ground, > 0 [m]
  double drag = 0;    ///< d, > 0 [kg/s]
};

[[nodiscard]] Canopy make_canopy(const Area& area, double height, double drag);

/// Mean of drag_at() over the straight segment from one place to another. Borders of the stands and
/// the tops of their canopies are located on it [kg/s].
[[nodiscard]] double mean_drag(const std::vector<Canopy>& canopies, const Trn& trn,
                               const Vec3& from, const Vec3& to);

/// Drag on a mass centre at `position`: the sum of all stands over whose area and below whose
/// canopy it is, none over a dam [kg/s].
[[nodiscard]] double drag_at(const std::vector<Canopy>& canopies, const Trn& trn,
                             const Vec3& position);

/// Whether a mass centre that starts at `position` with `velocity` and accelerates with `a` comes
/// over the box of a stand within `time`, at any height. May say yes where it does not, never the
/// reverse.
[[nodiscard]] bool comes_over(const std::vector<Canopy>& canopies, const Vec3& position,
                              const Vec3& velocity, const Vec3& a, double time);

}  // namespace talus
