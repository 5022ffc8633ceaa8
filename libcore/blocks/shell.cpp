// Surfaces of groups of cells, and groups of cells with convex unions.
#include "blocks/shell.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>

#include "blocks/solid.hpp"

namespace talus {
namespace {

// Half-edges of the surface being simplified; dead ones have been removed.
struct Sheet {
  std::vector<int> next, previous, twin, vertex, face;
  std::vector<char> is_dead;
  std::vector<int> parent;   // of faces, for those joined
  std::vector<Vec3> normal;  // of faces
  std::vector<int> made_by;  // of faces
  const std::vector<Vec3>* points = nullptr;

  int root(int f) {
    while (parent[f] != f) f = parent[f] = parent[parent[f]];
    return f;
  }
  const Vec3& point(int h) const { return (*points)[vertex[h]]; }
};

// Takes the edge of h and its twin out of their loops.
void remove_edge(Sheet& s, int h) {
  const int t = s.twin[h];
  const int before_h = s.previous[h], after_h = s.next[h];
  const int before_t = s.previous[t], after_t = s.next[t];
  if (after_h != t) s.next[before_t] = after_h, s.previous[after_h] = before_t;
  if (after_t != h) s.next[before_h] = after_t, s.previous[after_t] = before_h;
  s.is_dead[h] = s.is_dead[t] = 1;
}

bool same_plane(Sheet& s, int f, int g) {
  return s.made_by[f] == s.made_by[g] && s.normal[f].dot(s.normal[g]) > 0 &&
         s.normal[f].cross(s.normal[g]).norm() < 1e-9;
}

// Joins faces of one plane across their common edges, then takes out edges that lead nowhere.
void join_faces(Sheet& s) {
  const int n = static_cast<int>(s.next.size());
  for (int h = 0; h < n; ++h) {
    if (s.is_dead[h]) continue;
    const int f = s.root(s.face[h]), g = s.root(s.face[s.twin[h]]);
    if (f == g || !same_plane(s, f, g)) continue;
    s.parent[std::max(f, g)] = std::min(f, g);
    remove_edge(s, h);
  }
  std::vector<int> open(n);
  std::iota(open.begin(), open.end(), 0);
  while (!open.empty()) {
    const int h = open.back();
    open.pop_back();
    if (s.is_dead[h] || s.next[h] != s.twin[h]) continue;
    const int before = s.previous[h];
    remove_edge(s, h);
    if (before != s.twin[h]) open.push_back(before);
  }
}

int loop_length(const Sheet& s, int h) {
  int n = 0;
  for (int k = h; n == 0 || k != h; k = s.next[k]) ++n;
  return n;
}

// Vertices in the middle of an edge between two faces only, and in line with its ends.
void remove_middle_vertices(Sheet& s) {
  for (int h = 0; h < static_cast<int>(s.next.size()); ++h) {
    if (s.is_dead[h]) continue;
    const int in = s.previous[h], out_twin = s.twin[h], in_twin = s.twin[in];
    if (s.next[out_twin] != in_twin || in_twin == h) continue;  // more than two faces meet here
    const Vec3 along = s.point(s.next[h]) - s.point(in), to = s.point(h) - s.point(in);
    if (along.cross(to).norm() > 1e-10 * along.squaredNorm() || along.dot(to) <= 0) continue;
    if (loop_length(s, h) <= 3 || loop_length(s, in_twin) <= 3) continue;
    // `in` runs on to where h ended; the twin of h runs on to where `in` began.
    s.next[in] = s.next[h], s.previous[s.next[h]] = in;
    s.next[out_twin] = s.next[in_twin], s.previous[s.next[in_twin]] = out_twin;
    s.twin[in] = out_twin, s.twin[out_twin] = in;
    s.is_dead[h] = s.is_dead[in_twin] = 1;
  }
}

Polyhedron as_polyhedron(Sheet& s) {
  Polyhedron body;
  const int n = static_cast<int>(s.next.size());
  std::vector<int> corner(n, -1);  // vertex of the body at which h starts: one for each fan
  for (int h = 0; h < n; ++h) {
    if (s.is_dead[h] || corner[h] >= 0) continue;
    for (int k = h; corner[k] < 0; k = s.next[s.twin[k]])
      corner[k] = static_cast<int>(body.vertices.size());
    body.vertices.push_back(s.point(h));
  }
  std::vector<char> is_done(n, 0);
  std::vector<int> loop;
  for (int h = 0; h < n; ++h) {
    if (s.is_dead[h] || is_done[h]) continue;
    loop.clear();
    for (int k = h; !is_done[k]; k = s.next[k]) is_done[k] = 1, loop.push_back(corner[k]);
    add_face(body, loop, s.made_by[s.root(s.face[h])]);
  }
  return body;
}

}  // namespace

Polyhedron with_joined_faces(const Polyhedron& surface) {
  Sheet sheet;
  sheet.points = &surface.vertices;
  std::map<std::pair<int, int>, int> waiting;  // half-edge by its ends
  for (int f = 0; f < n_faces(surface); ++f) {
    const auto loop = face(surface, f);
    const int first = static_cast<int>(sheet.next.size()), n = static_cast<int>(loop.size());
    sheet.parent.push_back(f);
    sheet.made_by.push_back(surface.face_tag[f]);
    sheet.normal.push_back(face_normal(surface, f));
    for (int k = 0; k < n; ++k) {
      sheet.next.push_back(first + (k + 1) % n);
      sheet.previous.push_back(first + (k + n - 1) % n);
      sheet.vertex.push_back(loop[k]);
      sheet.face.push_back(f);
      sheet.twin.push_back(-1);
      const auto other = waiting.find({loop[(k + 1) % n], loop[k]});
      if (other == waiting.end()) {
        waiting[{loop[k], loop[(k + 1) % n]}] = first + k;
        continue;
      }
      sheet.twin[first + k] = other->second;
      sheet.twin[other->second] = first + k;
    }
  }
  sheet.is_dead.assign(sheet.next.size(), 0);
  join_faces(sheet);
  remove_middle_vertices(sheet);
  return as_polyhedron(sheet);
}

ShellReader::ShellReader(const CellComplex& complex)
    : complex_(complex),
      cell_face_begin_(complex.cell_leaf.size() + 1, 0),
      is_member_(complex.cell_leaf.size(), 0),
      local_of_dart_(complex.dart_vertex.size(), -1) {
  for (const int cell : complex.face_cell) ++cell_face_begin_[cell + 1];
  std::partial_sum(cell_face_begin_.begin(), cell_face_begin_.end(), cell_face_begin_.begin());
}

Polyhedron ShellReader::shell(const std::vector<int>& cells) {
  const CellComplex& c = complex_;
  for (const int cell : cells) is_member_[cell] = 1;
  const auto is_inner = [&](int d) {
    const int other = c.dart_opposite[d];
    return other >= 0 && is_member_[c.face_cell[c.dart_face[other]]];
  };
  Sheet sheet;
  sheet.points = &c.vertices;
  std::vector<int> darts;
  for (const int cell : cells)
    for (int f = cell_face_begin_[cell]; f < cell_face_begin_[cell + 1]; ++f) {
      if (is_inner(c.face_dart[f])) continue;
      const int local_face = static_cast<int>(sheet.parent.size());
      sheet.parent.push_back(local_face);
      sheet.made_by.push_back(c.face_made_by[f]);
      Vec3 area = Vec3::Zero();
      const Vec3& o = c.vertices[c.dart_vertex[c.face_dart[f]]];
      int d = c.face_dart[f];
      do {
        local_of_dart_[d] = static_cast<int>(darts.size());
        darts.push_back(d);
        sheet.face.push_back(local_face);
        sheet.vertex.push_back(c.dart_vertex[d]);
        area +=
            (c.vertices[c.dart_vertex[d]] - o).cross(c.vertices[c.dart_vertex[c.dart_next[d]]] - o);
        d = c.dart_next[d];
      } while (d != c.face_dart[f]);
      sheet.normal.push_back(area.normalized());
    }
  sheet.next.resize(darts.size());
  sheet.previous.resize(darts.size());
  sheet.twin.resize(darts.size());
  sheet.is_dead.assign(darts.size(), 0);
  for (size_t h = 0; h < darts.size(); ++h) {
    sheet.next[h] = local_of_dart_[c.dart_next[darts[h]]];
    sheet.previous[sheet.next[h]] = static_cast<int>(h);
    // Around the edge, through the cells of the group, to the next face of the surface.
    int e = c.dart_twin[darts[h]];
    while (is_inner(e)) e = c.dart_twin[c.dart_opposite[e]];
    sheet.twin[h] = local_of_dart_[e];
  }
  join_faces(sheet);
  remove_middle_vertices(sheet);
  for (const int d : darts) local_of_dart_[d] = -1;
  for (const int cell : cells) is_member_[cell] = 0;
  return as_polyhedron(sheet);
}

std::vector<std::vector<int>> ShellReader::parted(const std::vector<int>& cells, const Vec3& axis,
                                                  double share) {
  const CellComplex& c = complex_;
  std::map<int, double> along;  // middle of each cell
  for (const int cell : cells) {
    double sum = 0;
    for (int f = cell_face_begin_[cell]; f < cell_face_begin_[cell + 1]; ++f)
      sum += axis.dot(c.vertices[c.dart_vertex[c.face_dart[f]]]);
    along[cell] = sum / (cell_face_begin_[cell + 1] - cell_face_begin_[cell]);
  }
  const auto by_value = [](const auto& a, const auto& b) { return a.second < b.second; };
  const double low = std::min_element(along.begin(), along.end(), by_value)->second;
  const double high = std::max_element(along.begin(), along.end(), by_value)->second;
  const double middle = low + share * (high - low);
  std::vector<std::vector<int>> groups;
  std::map<int, bool> is_done;
  for (const int start : cells) {
    if (is_done[start]) continue;
    groups.emplace_back();
    std::vector<int> open = {start};
    is_done[start] = true;
    while (!open.empty()) {
      const int cell = open.back();
      open.pop_back();
      groups.back().push_back(cell);
      for (int f = cell_face_begin_[cell]; f < cell_face_begin_[cell + 1]; ++f) {
        const int other = c.dart_opposite[c.face_dart[f]];
        if (other < 0) continue;
        const auto neighbour = along.find(c.face_cell[c.dart_face[other]]);
        if (neighbour == along.end() || is_done[neighbour->first]) continue;
        if ((neighbour->second < middle) != (along[cell] < middle)) continue;
        is_done[neighbour->first] = true;
        open.push_back(neighbour->first);
      }
    }
  }
  return groups;
}

namespace {

// A convex group of cells while it grows.
struct Group {
  std::vector<int> cells;
  Polyhedron body;
  std::vector<Plane> planes;  // of its faces
};

void find_planes(Group& group) {
  group.planes.clear();
  for (int f = 0; f < n_faces(group.body); ++f)
    group.planes.push_back(plane_through(face_centroid(group.body, f), face_normal(group.body, f)));
}

// Plane of a half-face; nothing when it has no area.
std::optional<Plane> plane_of_face(const CellComplex& c, int f) {
  Vec3 area = Vec3::Zero();
  const Vec3& o = c.vertices[c.dart_vertex[c.face_dart[f]]];
  for (int d = c.dart_next[c.face_dart[f]]; d != c.face_dart[f]; d = c.dart_next[d])
    area += (c.vertices[c.dart_vertex[d]] - o).cross(c.vertices[c.dart_vertex[c.dart_next[d]]] - o);
  if (!(area.norm() > 0)) return std::nullopt;
  return plane_through(o, area.normalized());
}

// Every vertex of `inner` lies within all planes of `outer` but those that lie in `between`.
bool fits(const Group& inner, const Group& outer, const Plane& between, double tolerance) {
  for (const Plane& plane : outer.planes) {
    if (std::abs(plane.normal.dot(between.normal)) > 1 - 1e-12) {
      const double offset = plane.normal.dot(between.normal) > 0 ? between.offset : -between.offset;
      if (std::abs(plane.offset - offset) <= tolerance) continue;
    }
    for (const Vec3& v : inner.body.vertices)
      if (distance(plane, v) > tolerance) return false;
  }
  return true;
}

}  // namespace

// Two convex bodies that meet in a plane have a convex union when each lies within the other's
// remaining planes: a point within all of them is then in one body or the other.
std::vector<std::vector<int>> ShellReader::convex_groups(const std::vector<int>& cells,
                                                         double tolerance_m) {
  const CellComplex& c = complex_;
  std::vector<Group> groups;
  std::map<int, int> group_of_cell;
  for (const int cell : cells) {
    group_of_cell[cell] = static_cast<int>(groups.size());
    groups.push_back({{cell}, shell({cell}), {}});
    find_planes(groups.back());
  }
  std::vector<int> parent(groups.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int g) {
    while (parent[g] != g) g = parent[g] = parent[parent[g]];
    return g;
  };
  for (bool has_joined = true; has_joined;) {
    has_joined = false;
    for (const int cell : cells)
      for (int f = cell_face_begin_[cell]; f < cell_face_begin_[cell + 1]; ++f) {
        const int other = c.dart_opposite[c.face_dart[f]];
        if (other < 0) continue;
        const auto neighbour = group_of_cell.find(c.face_cell[c.dart_face[other]]);
        if (neighbour == group_of_cell.end()) continue;
        const int g = root(group_of_cell[cell]), h = root(neighbour->second);
        if (g == h) continue;
        Group &a = groups[std::min(g, h)], &b = groups[std::max(g, h)];
        const auto between = plane_of_face(c, f);
        if (!between) continue;
        if (!fits(a, b, *between, tolerance_m) || !fits(b, a, *between, tolerance_m)) continue;
        parent[std::max(g, h)] = std::min(g, h);
        a.cells.insert(a.cells.end(), b.cells.begin(), b.cells.end());
        a.body = shell(a.cells);
        find_planes(a);
        b = {};
        has_joined = true;
      }
  }
  std::vector<std::vector<int>> joined;
  for (Group& group : groups)
    if (!group.cells.empty()) joined.push_back(std::move(group.cells));
  return joined;
}

}  // namespace talus
