// tests/unit/contact/depth_below_ground.hpp
// Depth of a block below the ground at its vertices and at convex nodes.
#pragma once

#include <algorithm>
#include <vector>

#include "contact/search.hpp"

namespace talus {

/// How far block b reaches below the ground at a pose: its deepest vertex, or the deepest convex
/// node inside it, 0 when nothing does [m].
[[nodiscard]] inline double depth_below_ground(const Ground& ground, const Shapes& shapes, int b,
                                               const Pose& pose) {
  std::vector<Vec3> vertices;
  std::vector<Contact> contacts;
  (void)find_contacts(ground, shapes, b, pose, Mat3::Identity(), 0, vertices, contacts);
  double depth = 0;
  for (const Contact& contact : contacts)
    if (contact.key.mode != ContactMode::edge_edge) depth = std::max(depth, -contact.gap);
  return depth;
}

}  // namespace talus
