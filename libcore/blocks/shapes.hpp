// libcore/blocks/shapes.hpp: public
// Shapes by name: box, prism, EOTA block and its three usual proportions, random rock. Centred on
// their centroid.
// refs:  EAD 340059 (the EOTA block: a cube with bevelled edges and corners, 24 vertices)
#pragma once

#include <string>
#include <vector>

#include "base/random.hpp"
#include "geometry/polyhedron.hpp"

namespace talus {

/// Regular prism lying on a side, its axis along y: `diameter` of the circle around its section,
/// `length` along y [m].
[[nodiscard]] Polyhedron prism(int n_sides, double diameter, double length);

/// EOTA block with these extents [m]: vertices at all (+-1, +-1/2, +-1/2) of half the extents.
[[nodiscard]] Polyhedron eota(const Vec3& size);

/// Convex hull of `n_points` points at random on an ellipsoid with these axes [m].
[[nodiscard]] Polyhedron rock(const Vec3& axes, int n_points, Random& random);

/// Dimensions of shapes; each uses those that it needs.
struct ShapeSize {
  Vec3 extents = Vec3::Ones();  ///< of box, EOTA block, rock; prism: diameter, length [m]
  int n_sides = 6;              ///< of a prism
  int n_points = 20;            ///< of a rock
};

/// A shape as the site file names it.
struct ShapeKind {
  const char* name;
  int n_extents;  ///< numbers that size_m takes, unless one is given for all
  Polyhedron (*make)(const ShapeSize&, Random&);
};
[[nodiscard]] const std::vector<ShapeKind>& shape_kinds();
/// The row of a name that the site file allows.
[[nodiscard]] const ShapeKind& shape_kind(const std::string& name);

/// Moved so that the centroid is at 0.
[[nodiscard]] Polyhedron centred(Polyhedron body);

/// Scaled about the origin to this volume [m3].
[[nodiscard]] Polyhedron scaled_to(Polyhedron body, double volume);

/// A rotation at random, uniform over all rotations.
[[nodiscard]] Mat3 random_rotation(Random& random);

/// Rotation by roll about x, then pitch about y, then yaw about z [rad].
[[nodiscard]] Mat3 rotation(double yaw, double pitch, double roll);

}  // namespace talus
