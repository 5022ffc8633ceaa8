// A scene of some rocks of another scene, for rocks that fall one by one.
#include "run/batch_scene.hpp"

#include "scene/make_scene.hpp"

namespace talus {
namespace {

/// Rows [first, end) of an array.
struct Rows {
  int first = 0, end = 0;
};

template <class Value>
void add(const std::vector<Value>& from, const Rows& rows, std::vector<Value>& to) {
  if (!from.empty()) to.insert(to.end(), from.begin() + rows.first, from.begin() + rows.end);
}

// The rows that the array `begin` gives to those of another one.
Rows rows_of(const std::vector<int>& begin, const Rows& rows) {
  return {begin[static_cast<std::size_t>(rows.first)], begin[static_cast<std::size_t>(rows.end)]};
}

// The bounds of these rows, counted on from the last bound there.
void add_bounds(const std::vector<int>& from, const Rows& rows, std::vector<int>& to) {
  const int shift = to.back() - from[static_cast<std::size_t>(rows.first)];
  for (int i = rows.first + 1; i <= rows.end; ++i)
    to.push_back(from[static_cast<std::size_t>(i)] + shift);
}

void add_shapes(const Shapes& from, const Rows& blocks, Shapes& to) {
  const Rows parts = rows_of(from.part_begin, blocks), faces = rows_of(from.face_begin, parts);
  const Rows corners{
      faces.first < faces.end ? from.faces[static_cast<std::size_t>(faces.first)].vertex_begin : 0,
      faces.first < faces.end ? from.faces[static_cast<std::size_t>(faces.end) - 1].vertex_end : 0};
  const int shift = static_cast<int>(to.face_vertices.size()) - corners.first;
  for (int f = faces.first; f < faces.end; ++f) {
    ShapeFace& face = to.faces.emplace_back(from.faces[static_cast<std::size_t>(f)]);
    face.vertex_begin += shift;
    face.vertex_end += shift;
  }
  add(from.vertices, rows_of(from.vertex_begin, blocks), to.vertices);
  add(from.walls, rows_of(from.wall_begin, parts), to.walls);
  add(from.face_vertices, corners, to.face_vertices);
  add(from.edges, rows_of(from.edge_begin, blocks), to.edges);
  add(from.radius, blocks, to.radius);
  add(from.thickness, blocks, to.thickness);
  add_bounds(from.vertex_begin, blocks, to.vertex_begin);
  add_bounds(from.part_begin, blocks, to.part_begin);
  add_bounds(from.face_begin, parts, to.face_begin);
  add_bounds(from.wall_begin, parts, to.wall_begin);
  add_bounds(from.edge_begin, blocks, to.edge_begin);
}

void add_hulls(const Hulls& from, const Rows& bodies, Hulls& to) {
  const Rows parts = rows_of(from.part_begin, bodies), vertices = rows_of(from.vertex_begin, parts),
             slots = rows_of(from.face_begin, parts), corners = rows_of(from.loop_begin, slots);
  const int shift = n_bodies(to) - bodies.first;
  for (int p = parts.first; p < parts.end; ++p)
    to.body.push_back(from.body[static_cast<std::size_t>(p)] + shift);
  add(from.radius, bodies, to.radius);
  add(from.thickness, parts, to.thickness);
  add(from.n_faces, parts, to.n_faces);
  add(from.n_active_edges, parts, to.n_active_edges);
  add(from.vertices, vertices, to.vertices);
  add(from.ring_faces, rows_of(from.ring_begin, vertices), to.ring_faces);
  add(from.nx, slots, to.nx);
  add(from.ny, slots, to.ny);
  add(from.nz, slots, to.nz);
  add(from.joint_set, slots, to.joint_set);
  add(from.cover, slots, to.cover);
  add(from.loop_vertices, corners, to.loop_vertices);
  add(from.loop_edges, corners, to.loop_edges);
  add(from.edges, rows_of(from.edge_begin, parts), to.edges);
  add_bounds(from.part_begin, bodies, to.part_begin);
  add_bounds(from.body_vertex_begin, bodies, to.body_vertex_begin);
  add_bounds(from.body_edge_begin, bodies, to.body_edge_begin);
  add_bounds(from.vertex_begin, parts, to.vertex_begin);
  add_bounds(from.face_begin, parts, to.face_begin);
  add_bounds(from.edge_begin, parts, to.edge_begin);
  add_bounds(from.ring_begin, vertices, to.ring_begin);
  add_bounds(from.loop_begin, slots, to.loop_begin);
}

}  // namespace

Scene without_rocks(const Scene& scene) {
  Scene batch;
  batch.ground = scene.ground;
  batch.joint = scene.joint;
  batch.joints.of_set = scene.joints.of_set;
  batch.fragmentation = scene.fragmentation;
  batch.fixed = scene.fixed;
  batch.forest = scene.forest;
  batch.canopies = scene.canopies;
  batch.gravity = scene.gravity;
  batch.base = scene.base;
  batch.settings = scene.settings;
  return batch;
}

void take_rocks(const Scene& scene, const BlockSet* surfaces, int first, int end, Scene& batch) {
  const Rows rows{first, end};
  const Blocks& from = scene.blocks;
  Blocks& to = batch.blocks = {};
  add(from.mass, rows, to.mass);
  add(from.volume, rows, to.volume);
  add(from.inertia, rows, to.inertia);
  add(from.second_moment, rows, to.second_moment);
  add(from.young, rows, to.young);
  add(from.poisson, rows, to.poisson);
  add(from.rest, rows, to.rest);
  add(from.velocity, rows, to.velocity);
  add(from.spin, rows, to.spin);
  add(from.initial_stress, rows, to.initial_stress);
  if (surfaces == nullptr) {
    add_shapes(from.shapes, rows, to.shapes);
    add_hulls(from.hulls, rows, to.hulls);
  } else {
    for (int b = first; b < end; ++b) add_surfaces(*surfaces, b, to);
  }
  add_hulls(from.hulls, {n_blocks(scene), n_bodies(from.hulls)}, to.hulls);
  batch.crush_load.clear();
  batch.joints.of_block.clear();
  add(scene.crush_load, rows, batch.crush_load);
  add(scene.joints.of_block, rows, batch.joints.of_block);
}

}  // namespace talus
