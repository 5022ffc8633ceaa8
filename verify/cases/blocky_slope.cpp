// The slope as fixed polyhedral blocks, as the original method models it.
#include "verify/cases/blocky_slope.hpp"

#include <algorithm>
#include <array>

#include "blocks/block_set.hpp"
#include "scene/yielding.hpp"

namespace talus {
namespace {

Polyhedron prism_below(const std::array<Vec3, 3>& top, double depth) {
  Polyhedron prism;
  prism.vertices.assign(top.begin(), top.end());
  for (const Vec3& v : top) prism.vertices.push_back(v - depth * Vec3::UnitZ());
  const auto add = [&prism](std::initializer_list<int> face, int tag) {
    add_face(prism, std::vector<int>(face), tag);
  };
  // the sides lie against those of the neighbours: no block can touch them
  add({0, 1, 2}, face_terrain);
  add({5, 4, 3}, face_terrain);
  add({0, 3, 4, 1}, face_internal);
  add({1, 4, 5, 2}, face_internal);
  add({2, 5, 3, 0}, face_internal);
  return prism;
}

}  // namespace

void add_blocky_slope(Scene& scene, double depth) {
  const Trn& trn = scene.ground.trn;
  const int first_class = static_cast<int>(scene.fixed.classes.size());
  scene.fixed.classes.insert(scene.fixed.classes.end(), scene.ground.classes.begin(),
                             scene.ground.classes.end());
  for (int t = 0; t < n_triangles(trn); ++t)
    if (is_known(trn, t))
      add_fixed_body(scene, prism_below(triangle_corners(trn, t), depth),
                     first_class + class_of(scene.ground, t));
  scene.settings.trn_contacts = false;
}

double blocky_depth(const Scene& scene) {
  double largest = 0;
  for (const double radius : scene.blocks.shapes.radius) largest = std::max(largest, 2 * radius);
  return std::max(2 * scene.ground.trn.cell_size, largest);
}

}  // namespace talus
