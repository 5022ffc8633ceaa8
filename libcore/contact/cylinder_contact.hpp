// libcore/contact/cylinder_contact.hpp: public
// Contact of a convex part with a vertical cylinder, such as the stem of a tree.
// in:    placed hulls, a cylinder
// out:   where they are nearest to each other, seen from above, and the points of the part there
#pragma once

#include <vector>

#include "contact/hulls.hpp"
#include "contact/manifold.hpp"

namespace talus {

/// From far below up to `top`.
struct VerticalCylinder {
  Vec2 axis = Vec2::Zero();  ///< local x, y [m]
  double radius = 0;         ///< > 0 [m]
  double top = 0;            ///< local z [m]
};

/// Appends the points of `part` that are within `margin` of the cylinder: where the edges of the
/// part meet the vertical half-plane from the axis towards the place that is nearest to it, seen
/// from above, and are hardly farther than that place. `normal` becomes horizontal, from the
/// cylinder to the part. Names of the points: edge_edge, the edge of the body, 0. Returns how many
/// points there are.
int find_cylinder_contact(const Hulls& hulls, const PlacedHulls& placed, int part,
                          const VerticalCylinder& cylinder, double margin, Vec3& normal,
                          std::vector<PairPoint>& points);

}  // namespace talus
