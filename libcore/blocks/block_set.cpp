// Adds bodies to a block set, gives them back, and checks the set.
#include "blocks/block_set.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "base/error.hpp"

namespace talus {
namespace {

// Appends the faces of `body` to a table of faces; its vertex 0 is at `first_vertex` of the set.
void append_faces(const Polyhedron& body, int first_vertex, std::vector<int>& vertices,
                  std::vector<int>& begin, std::vector<int>& tags) {
  for (int f = 0; f < n_faces(body); ++f) {
    for (const int v : face(body, f)) vertices.push_back(first_vertex + v);
    begin.push_back(static_cast<int>(vertices.size()));
    tags.push_back(body.face_tag[f]);
  }
}

int append_vertices(BlockSet& set, const Polyhedron& body) {
  const int first = static_cast<int>(set.vertices.size());
  set.vertices.insert(set.vertices.end(), body.vertices.begin(), body.vertices.end());
  return first;
}

// Faces [first, last) of a table as a body with the vertices that they use, in order of first use.
Polyhedron faces_as_body(const BlockSet& set, const std::vector<int>& vertices,
                         const std::vector<int>& begin, const std::vector<int>& tags, int first,
                         int last) {
  Polyhedron body;
  std::map<int, int> local;
  std::vector<int> loop;
  for (int f = first; f < last; ++f) {
    loop.clear();
    for (int k = begin[f]; k < begin[f + 1]; ++k) {
      const auto [entry, is_new] =
          local.try_emplace(vertices[k], static_cast<int>(body.vertices.size()));
      if (is_new) body.vertices.push_back(set.vertices[vertices[k]]);
      loop.push_back(entry->second);
    }
    add_face(body, loop, tags[f]);
  }
  return body;
}

// `begin` lists n groups in order, from 0 to `end`.
bool lists(const std::vector<int>& begin, size_t n, size_t end) {
  if (begin.size() != n + 1 || begin.front() != 0) return false;
  for (size_t i = 0; i < n; ++i)
    if (begin[i] > begin[i + 1]) return false;
  return static_cast<size_t>(begin.back()) == end;
}

std::string broken_size(const BlockSet& set) {
  const size_t n = set.volume.size(), n_pairs = set.pair_blocks.size();
  if (set.part_begin.empty()) return "part_begin is empty";
  const std::array<std::pair<const char*, bool>, 9> lengths = {{
      {"block_vertex_begin", lists(set.block_vertex_begin, n, set.vertices.size())},
      {"face_begin", lists(set.face_begin, set.joint_set.size(), set.face_vertices.size())},
      {"block_face_begin", lists(set.block_face_begin, n, set.joint_set.size())},
      {"part_face_begin",
       lists(set.part_face_begin, set.part_joint_set.size(), set.part_face_vertices.size())},
      {"part_begin", lists(set.part_begin, set.part_begin.size() - 1, set.part_joint_set.size())},
      {"convex_part_begin", lists(set.convex_part_begin, n, set.part_begin.size() - 1)},
      {"material, centroid, second_moment, velocity or spin",
       set.material.size() == n && set.centroid.size() == n && set.second_moment.size() == n &&
           set.velocity.size() == n && set.spin.size() == n},
      {"weight", set.weight.empty() || set.weight.size() == n},
      {"pair_joint_set, pair_area, pair_normal or pair_point",
       set.pair_joint_set.size() == n_pairs && set.pair_area.size() == n_pairs &&
           set.pair_normal.size() == n_pairs && set.pair_point.size() == n_pairs},
  }};
  for (const auto& [name, is_right] : lengths)
    if (!is_right) return std::string(name) + " does not fit the arrays that it belongs to";
  return {};
}

bool all_within(const std::vector<int>& values, int low, size_t end) {
  return std::all_of(values.begin(), values.end(),
                     [&](int v) { return v >= low && v < static_cast<int>(end); });
}

std::string broken_index(const BlockSet& set) {
  if (!all_within(set.joint_set, face_source_side, set.joint_set_names.size()) ||
      !all_within(set.part_joint_set, face_source_side, set.joint_set_names.size()) ||
      !all_within(set.pair_joint_set, face_source_side, set.joint_set_names.size()))
    return "joint_set names a joint set that does not exist";
  if (!all_within(set.material, 0, set.material_names.size()))
    return "material names a material that does not exist";
  for (const auto& [a, b] : set.pair_blocks)
    if (a < 0 || a >= b || b >= n_blocks(set)) return "pair_blocks names blocks that do not exist";
  return {};
}

// Faces [first_face, last_face) name vertices of block b only.
bool own_vertices(const BlockSet& set, int b, const std::vector<int>& vertices, int first,
                  int last) {
  for (int k = first; k < last; ++k)
    if (vertices[k] < set.block_vertex_begin[b] || vertices[k] >= set.block_vertex_begin[b + 1])
      return false;
  return true;
}

std::string broken_block(const BlockSet& set, int b) {
  const int first_part = set.convex_part_begin[b], last_part = set.convex_part_begin[b + 1];
  if (first_part == last_part) return "has no convex part";
  if (!own_vertices(set, b, set.face_vertices, set.face_begin[set.block_face_begin[b]],
                    set.face_begin[set.block_face_begin[b + 1]]) ||
      !own_vertices(set, b, set.part_face_vertices, set.part_face_begin[set.part_begin[first_part]],
                    set.part_face_begin[set.part_begin[last_part]]))
    return "has a face that names a vertex of another block";
  if (!std::isfinite(set.volume[b]) || !set.centroid[b].allFinite() ||
      !set.second_moment[b].allFinite() || !set.velocity[b].allFinite() || !set.spin[b].allFinite())
    return "has numbers that are not finite";
  for (int v = set.block_vertex_begin[b]; v < set.block_vertex_begin[b + 1]; ++v)
    if (!set.vertices[v].allFinite()) return "has a vertex that is not finite";
  if (set.volume[b] <= 0) return "has no volume";
  if (!set.weight.empty() && !(set.weight[b] > 0 && std::isfinite(set.weight[b])))
    return "has a weight that is not above 0";
  for (int p = first_part; p < last_part; ++p) {
    const SurfaceFault fault = check_surface(convex_part(set, p)).fault;
    if (fault != SurfaceFault::none) return std::string("has a convex part that is ") + text(fault);
  }
  const SurfaceFault fault = check_surface(block_shell(set, b)).fault;
  if (fault != SurfaceFault::none) return std::string("has a shell that is ") + text(fault);
  return {};
}

}  // namespace

void add_body(BlockSet& set, const Body& body) {
  TALUS_ASSERT(!body.parts.empty());
  Moments sum;
  const bool own_shell = n_faces(body.shell) > 0;
  if (own_shell)
    append_faces(body.shell, append_vertices(set, body.shell), set.face_vertices, set.face_begin,
                 set.joint_set);
  for (const Polyhedron& part : body.parts) {
    const int first = append_vertices(set, part);
    append_faces(part, first, set.part_face_vertices, set.part_face_begin, set.part_joint_set);
    set.part_begin.push_back(static_cast<int>(set.part_joint_set.size()));
    if (!own_shell) append_faces(part, first, set.face_vertices, set.face_begin, set.joint_set);
    sum = &part == body.parts.data() ? moments(part) : joined(sum, moments(part));
  }
  set.block_vertex_begin.push_back(static_cast<int>(set.vertices.size()));
  set.block_face_begin.push_back(static_cast<int>(set.joint_set.size()));
  set.convex_part_begin.push_back(static_cast<int>(set.part_begin.size()) - 1);
  // A shell of its own is the whole body, parts too thin to be solid included.
  if (own_shell) sum = moments(body.shell);
  set.material.push_back(body.material);
  set.volume.push_back(sum.volume);
  set.centroid.push_back(sum.centroid);
  set.second_moment.push_back(sum.second);
  set.velocity.push_back(body.velocity);
  set.spin.push_back(body.spin);
  if (body.weight != 1 && set.weight.empty()) set.weight.assign(set.volume.size() - 1, 1);
  if (body.weight != 1 || !set.weight.empty()) set.weight.push_back(body.weight);
}

Polyhedron block_shell(const BlockSet& set, int b) {
  return faces_as_body(set, set.face_vertices, set.face_begin, set.joint_set,
                       set.block_face_begin[b], set.block_face_begin[b + 1]);
}

Polyhedron convex_part(const BlockSet& set, int p) {
  return faces_as_body(set, set.part_face_vertices, set.part_face_begin, set.part_joint_set,
                       set.part_begin[p], set.part_begin[p + 1]);
}

std::vector<Polyhedron> block_surfaces(const BlockSet& set, int b) {
  Polyhedron shell = block_shell(set, b);
  if (check_surface(shell).n_shells == 1) return {std::move(shell)};
  std::vector<Polyhedron> parts;
  for (int p = set.convex_part_begin[b]; p < set.convex_part_begin[b + 1]; ++p)
    parts.push_back(convex_part(set, p));
  return parts;
}

std::string broken_promise(const BlockSet& set) {
  std::string broken = broken_size(set);
  if (broken.empty()) broken = broken_index(set);
  for (int b = 0; broken.empty() && b < n_blocks(set); ++b) {
    const std::string fault = broken_block(set, b);
    if (!fault.empty()) broken = "block " + std::to_string(b) + " " + fault;
  }
  return broken;
}

}  // namespace talus
