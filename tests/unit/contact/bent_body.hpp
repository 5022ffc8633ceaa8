// tests/unit/contact/bent_body.hpp
// A body of two convex parts whose bed bends from flat to steep where they meet, as the columns of
// a block cut out of a slope do.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "blocks/block_set.hpp"
#include "geometry/polyhedron.hpp"

namespace talus::test {

/// A polygon in x and z, counter-clockwise seen from -y, between y = -1 and y = 1; `tag[k]` is that
/// of the side from corner k to the next.
inline Polyhedron prism(std::span<const Vec2> corners, std::span<const int> tag) {
  Polyhedron body;
  const int n = static_cast<int>(corners.size());
  std::vector<int> near, far;
  for (const double y : {-1.0, 1.0})
    for (const Vec2& corner : corners) body.vertices.emplace_back(corner.x(), y, corner.y());
  for (int k = 0; k < n; ++k) {
    near.push_back(k);
    far.push_back(2 * n - 1 - k);
    const int next = (k + 1) % n;
    add_face(body, std::array{next, k, n + k, n + next}, tag[static_cast<std::size_t>(k)]);
  }
  add_face(body, near, 0);
  add_face(body, far, 0);
  return body;
}

/// The flat part lies at -1 <= x <= 0 on z = 0, the steep one at 0 <= x <= 1 on z = `rise` x; the
/// top is at z = 4, the wall between them at x = 0.
struct BentBody {
  std::vector<Polyhedron> parts;
  Polyhedron shell;
};

inline BentBody bent_body(double rise) {
  const Vec2 flat[] = {{-1, 0}, {0, 0}, {0, 4}, {-1, 4}};
  const Vec2 steep[] = {{0, 0}, {1, rise}, {1, 4}, {0, 4}};
  const Vec2 both[] = {{-1, 0}, {0, 0}, {1, rise}, {1, 4}, {0, 4}, {-1, 4}};
  const int flat_tags[] = {face_failure, face_internal, face_terrain, 0};
  const int steep_tags[] = {face_failure, 0, face_terrain, face_internal};
  const int tags[] = {face_failure, face_failure, 0, face_terrain, face_terrain, 0};
  return {{prism(flat, flat_tags), prism(steep, steep_tags)}, prism(both, tags)};
}

}  // namespace talus::test
