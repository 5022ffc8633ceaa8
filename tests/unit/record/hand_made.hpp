// tests/unit/record/hand_made.hpp
// Scenes and motions made by hand: input of the recorder without a solver behind it.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "base/random.hpp"
#include "motion/free_rotation.hpp"
#include "motion/rotation.hpp"
#include "scene/scene.hpp"
#include "step/work.hpp"

namespace talus_test {

using talus::Motion;
using talus::Quat;
using talus::Scene;
using talus::Segment;
using talus::Trn;
using talus::Vec2;
using talus::Vec3;

/// z = f(x, y) at nodes `cell` apart from (0, 0) in the south-west to (n_cols - 1, n_rows - 1)
/// cells.
template <class Function>
Trn trn_of(int n_rows, int n_cols, double cell, Function&& f) {
  Trn trn;
  trn.n_rows = n_rows;
  trn.n_cols = n_cols;
  trn.cell_size = cell;
  trn.node0 = {0, (n_rows - 1) * cell};
  trn.origin = {500000, 5000000, 0};
  for (int r = 0; r < n_rows; ++r)
    for (int c = 0; c < n_cols; ++c) trn.elevation.push_back(f(c * cell, (n_rows - 1 - r) * cell));
  return trn;
}

/// Adds a body of 2600 kg/m3 with the moments of the box a x b x c and the given vertices.
inline void add_body(Scene& scene, const std::vector<Vec3>& vertices, const Vec3& box) {
  const double volume = box.prod(), mass = 2600 * volume;
  const Vec3 sq = box.cwiseAbs2();
  scene.blocks.mass.push_back(mass);
  scene.blocks.volume.push_back(volume);
  scene.blocks.inertia.push_back(mass / 12 *
                                 Vec3(sq.y() + sq.z(), sq.z() + sq.x(), sq.x() + sq.y()));
  talus::Shapes& shapes = scene.blocks.shapes;
  double radius = 0;
  for (const Vec3& vertex : vertices) {
    shapes.vertices.push_back(vertex);
    radius = std::max(radius, vertex.norm());
  }
  shapes.vertex_begin.push_back(static_cast<int>(shapes.vertices.size()));
  shapes.part_begin.push_back(static_cast<int>(shapes.face_begin.size()) - 1);
  shapes.radius.push_back(radius);
}

inline void add_box(Scene& scene, const Vec3& box) {
  std::vector<Vec3> vertices;
  for (const double x : {-0.5, 0.5})
    for (const double y : {-0.5, 0.5})
      for (const double z : {-0.5, 0.5}) vertices.push_back(Vec3(x, y, z).cwiseProduct(box));
  talus::Shapes& shapes = scene.blocks.shapes;
  for (const double side : {-0.5, 0.5})
    for (int axis = 0; axis < 3; ++axis) {
      talus::ShapeFace& face = shapes.faces.emplace_back();
      face.normal = 2 * side * Vec3::Unit(axis);
      face.offset = box[axis] / 2;
    }
  shapes.face_begin.push_back(static_cast<int>(shapes.faces.size()));
  shapes.wall_begin.push_back(0);
  add_body(scene, vertices, box);
}

inline Vec3 random_vector(talus::Random& random, double size) {
  return size * Vec3(random.normal(), random.normal(), random.normal());
}

inline Quat random_attitude(talus::Random& random) {
  return Quat(random.normal(), random.normal(), random.normal(), random.normal()).normalized();
}

/// A free flight of block b from `start` between two times.
inline Segment flight(const Scene& scene, int b, const Motion& start, double t0, double t1) {
  Segment segment;
  segment.block = b;
  segment.flight = true;
  segment.t_start = t0;
  segment.t_end = t1;
  segment.start = start;
  segment.acceleration = scene.gravity;
  const double h = t1 - t0;
  segment.end = start;
  segment.end.pose.position += h * start.velocity + 0.5 * h * h * scene.gravity;
  segment.end.velocity += h * scene.gravity;
  segment.end.pose.attitude =
      talus::free_rotation(start.pose.attitude, start.angular_momentum, scene.blocks.inertia[b], h);
  return segment;
}

/// A step with contact: constant acceleration, turned by `turn` [rad, local axes].
inline Segment slide(int b, const Motion& start, double t0, double t1, const Vec3& acceleration,
                     const Vec3& turn) {
  Segment segment;
  segment.block = b;
  segment.t_start = t0;
  segment.t_end = t1;
  segment.start = start;
  segment.acceleration = acceleration;
  const double h = t1 - t0;
  segment.end = start;
  segment.end.pose.position += h * start.velocity + 0.5 * h * h * acceleration;
  segment.end.velocity += h * acceleration;
  segment.end.pose.attitude = talus::rotation_by(turn) * start.pose.attitude;
  return segment;
}

}  // namespace talus_test
