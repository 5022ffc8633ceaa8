// tests/unit/blocks/scenes.hpp
// Terrains and masses made up for the tests of the blocks.
#pragma once

#include <cmath>
#include <vector>

#include "base/random.hpp"
#include "base/units.hpp"
#include "blocks/joint_sets.hpp"
#include "blocks/source.hpp"
#include "terrain/trn.hpp"

namespace talus::test {

/// n x n nodes; z(x, y) by `height`.
template <class Height>
Trn grid(int n_rows, int n_cols, double cell, Height height) {
  Trn trn;
  trn.n_rows = n_rows;
  trn.n_cols = n_cols;
  trn.cell_size = cell;
  trn.node0 = {0, (n_rows - 1) * cell};
  for (int r = 0; r < n_rows; ++r)
    for (int c = 0; c < n_cols; ++c)
      trn.elevation.push_back(height(c * cell, (n_rows - 1 - r) * cell));
  return trn;
}

inline JointSet joint_set(double dip_deg, double direction_deg, double spacing,
                          const char* name = "J") {
  JointSet set;
  set.name = name;
  set.dip = dip_deg * degree;
  set.dip_direction = direction_deg * degree;
  set.mean_spacing = spacing;
  return set;
}

inline std::vector<Joint> draw_all(const std::vector<JointSet>& sets, const Vec3& centre,
                                   double radius, std::uint64_t seed = 1) {
  std::vector<Joint> joints;
  for (size_t s = 0; s < sets.size(); ++s)
    for (Joint& joint : draw_joints(sets[s], static_cast<int>(s), centre, radius, seed))
      joints.push_back(std::move(joint));
  return joints;
}

/// A rough slope and a bed below part of it, sometimes daylighting: as made by a source.
struct Scene {
  Trn ground, bed;
};
inline Scene random_scene(Random& random, int n_nodes, double cell) {
  const double extent = (n_nodes - 1) * cell;
  const double slope = random.uniform(-1.2, 1.2), tilt = random.uniform(-0.6, 0.6);
  const double roughness = random.uniform(0, 0.25) * cell;
  Scene scene;
  scene.ground = grid(n_nodes, n_nodes, cell, [&](double x, double y) {
    return slope * x + tilt * y +
           0.3 * extent * std::sin(3 * x / extent) * std::sin(4 * y / extent) +
           roughness * random.normal();
  });
  scene.bed = scene.ground;
  const double depth = random.uniform(0.5, 3) * cell;
  // A bowl, a plane that daylights, or a constant depth over a disc.
  const int kind = static_cast<int>(random.below(3));
  for (int r = 1; r + 1 < n_nodes; ++r)
    for (int c = 1; c + 1 < n_nodes; ++c) {
      const size_t i = node_index(scene.ground, r, c);
      const double u = c * cell / extent - 0.5, v = r * cell / extent - 0.5;
      double z = scene.ground.elevation[i];
      if (kind == 0) z -= depth * (1 - 6 * (u * u + v * v));
      if (kind == 1)
        z = std::min(z, slope * 0.7 * (c * cell) + random.uniform(-1e-12, 0) - 0.2 * depth);
      if (kind == 2 && u * u + v * v < 0.16) z -= depth;
      scene.bed.elevation[i] = std::min(z, scene.ground.elevation[i]);
    }
  return scene;
}

}  // namespace talus::test
