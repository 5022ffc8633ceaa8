// blocks/shapes.hpp: prism, EOTA block and, by the convex hull of CGAL, random rock.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/error.hpp"
#include "blocks/block_set.hpp"
#include "blocks/shapes.hpp"
#include "blocks/solid.hpp"

namespace talus {

Polyhedron prism(int n_sides, double diameter, double length) {
  Polyhedron body;
  const double turn = 2 * std::numbers::pi / n_sides;
  for (const double y : {-length / 2, length / 2})
    for (int k = 0; k < n_sides; ++k) {
      // Half a turn off the lowest point, so that a side lies below.
      const double angle = -std::numbers::pi / 2 + (k + 0.5) * turn;
      body.vertices.emplace_back(diameter / 2 * std::cos(angle), y, diameter / 2 * std::sin(angle));
    }
  std::vector<int> front, back;
  for (int k = 0; k < n_sides; ++k) {
    front.push_back(k);  // counter-clockwise in (x, z) is seen from -y
    back.push_back(2 * n_sides - 1 - k);
    const int next = (k + 1) % n_sides;
    const std::vector<int> side = {k, n_sides + k, n_sides + next, next};
    add_face(body, side, face_terrain);
  }
  add_face(body, front, face_terrain);
  add_face(body, back, face_terrain);
  return centred(std::move(body));
}

Polyhedron eota(const Vec3& size) {
  constexpr double tolerance = 1e-12;
  Polyhedron body = box(Vec3::Constant(-1), Vec3::Constant(1), face_terrain);
  for (int i = -1; i <= 1; ++i)
    for (int j = -1; j <= 1; ++j)
      for (int k = -1; k <= 1; ++k) {
        const int n_axes = std::abs(i) + std::abs(j) + std::abs(k);
        if (n_axes < 2) continue;  // edges: |x| + |y| <= 3/2; corners: |x| + |y| + |z| <= 2
        const Vec3 outward(i, j, k);
        const double offset = (n_axes == 2 ? 1.5 : 2) / outward.norm();
        body = clip_convex(body, {outward.normalized(), offset}, face_terrain, tolerance);
      }
  for (Vec3& v : body.vertices) v = v.cwiseProduct(size / 2);
  return body;
}

Polyhedron rock(const Vec3& axes, int n_points, Random& random) {
  std::vector<Vec3> points;
  for (int i = 0; i < n_points; ++i) {
    const Vec3 direction(random.normal(), random.normal(), random.normal());
    points.push_back(direction.normalized().cwiseProduct(axes / 2));
  }
  return centred(convex_hull(points, face_terrain));
}

const std::vector<ShapeKind>& shape_kinds() {
  static const std::vector<ShapeKind> kinds = {
      {"box", 3,
       [](const ShapeSize& size, Random&) {
         return box(-size.extents / 2, size.extents / 2, face_terrain);
       }},
      {"prism", 2,
       [](const ShapeSize& size, Random&) {
         return prism(size.n_sides, size.extents.x(), size.extents.y());
       }},
      {"eota", 3, [](const ShapeSize& size, Random&) { return eota(size.extents); }},
      {"eota111", 1, [](const ShapeSize& size, Random&) { return eota(size.extents); }},
      {"eota211", 1,
       [](const ShapeSize& size, Random&) { return eota(size.extents.x() * Vec3(1, 0.5, 0.5)); }},
      {"eota221", 1,
       [](const ShapeSize& size, Random&) { return eota(size.extents.x() * Vec3(1, 1, 0.5)); }},
      {"rock", 3,
       [](const ShapeSize& size, Random& random) {
         return rock(size.extents, size.n_points, random);
       }},
  };
  return kinds;
}

const ShapeKind& shape_kind(const std::string& name) {
  const std::vector<ShapeKind>& kinds = shape_kinds();
  const auto found = std::find_if(kinds.begin(), kinds.end(),
                                  [&name](const ShapeKind& kind) { return kind.name == name; });
  TALUS_ASSERT(found != kinds.end());
  return *found;
}

Polyhedron centred(Polyhedron body) {
  const Vec3 centre = moments(body).centroid;
  for (Vec3& v : body.vertices) v -= centre;
  return body;
}

Polyhedron scaled_to(Polyhedron body, double volume) {
  const double factor = std::cbrt(volume / moments(body).volume);
  for (Vec3& v : body.vertices) v *= factor;
  return body;
}

Mat3 random_rotation(Random& random) {
  const Eigen::Quaterniond q(random.normal(), random.normal(), random.normal(), random.normal());
  return q.normalized().toRotationMatrix();
}

Mat3 rotation(double yaw, double pitch, double roll) {
  return (Eigen::AngleAxisd(yaw, Vec3::UnitZ()) * Eigen::AngleAxisd(pitch, Vec3::UnitY()) *
          Eigen::AngleAxisd(roll, Vec3::UnitX()))
      .toRotationMatrix();
}

}  // namespace talus
