// Faces as triangles: fans where the face is convex, ears cut off where it is not.
#include "geometry/triangulate.hpp"

#include <Eigen/Geometry>

namespace talus {
namespace {

// The corner at k sticks out, and no other corner lies in its triangle.
bool is_ear(const std::vector<Vec3>& points, const std::vector<int>& loop, const Vec3& normal,
            size_t k) {
  const size_t n = loop.size();
  const Vec3 &a = points[loop[(k + n - 1) % n]], &b = points[loop[k]],
             &c = points[loop[(k + 1) % n]];
  if ((b - a).cross(c - b).dot(normal) <= 0) return false;
  for (size_t i = 0; i < n; ++i) {
    const Vec3& p = points[loop[i]];
    if (p == a || p == b || p == c) continue;
    if ((b - a).cross(p - a).dot(normal) >= 0 && (c - b).cross(p - b).dot(normal) >= 0 &&
        (a - c).cross(p - c).dot(normal) >= 0)
      return false;
  }
  return true;
}

}  // namespace

bool is_convex_face(const Polyhedron& body, int f) {
  const auto loop = face(body, f);
  const Vec3 normal = face_normal(body, f);
  const size_t n = loop.size();
  for (size_t k = 0; k < n; ++k) {
    const Vec3 &a = body.vertices[loop[k]], &b = body.vertices[loop[(k + 1) % n]],
               &c = body.vertices[loop[(k + 2) % n]];
    if ((b - a).cross(c - b).dot(normal) < 0) return false;
  }
  return true;
}

std::vector<std::array<int, 3>> triangles_of_face(const Polyhedron& body, int f) {
  const auto corners = face(body, f);
  std::vector<int> loop(corners.begin(), corners.end());
  std::vector<std::array<int, 3>> triangles;
  const bool is_fan = is_convex_face(body, f);
  const Vec3 normal = face_normal(body, f);
  while (loop.size() > 3) {
    // In a fan from the first corner, the second one is always an ear.
    size_t ear = 1;
    if (!is_fan) {
      ear = 0;
      while (ear < loop.size() && !is_ear(body.vertices, loop, normal, ear)) ++ear;
      if (ear == loop.size()) ear = 1;
    }
    const size_t n = loop.size();
    triangles.push_back({loop[(ear + n - 1) % n], loop[ear], loop[(ear + 1) % n]});
    loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  triangles.push_back({loop[0], loop[1], loop[2]});
  return triangles;
}

}  // namespace talus
