// Convex parts of all blocks: made from a block set, then placed at the pose of each body.
#include "contact/hulls.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "base/error.hpp"
#include "blocks/block_set.hpp"
#include "contact/lanes.hpp"
#include "contact/scales.hpp"
#include "geometry/face_overlap.hpp"

namespace talus {
namespace {

// A face of a part in body axes, while a body is being added.
struct DraftFace {
  Vec3 normal, centre;
  std::vector<Vec3> corners;
  double area = 0;
  int tag = 0;
  bool internal = false;  // covered by other parts, or by a body beside this one
  bool partly = false;    // covered in part: the uncovered rest stops bodies
};

struct DraftPart {
  std::vector<Vec3> vertices;
  std::vector<std::vector<int>> loops;
  std::vector<DraftFace> faces;
  std::vector<PolyhedronEdge> edges;
};

DraftPart draft_part(const Polyhedron& part, const Vec3& centroid, const Mat3& to_body,
                     bool stands_among_others) {
  DraftPart draft;
  for (const Vec3& v : part.vertices) draft.vertices.push_back(to_body * (v - centroid));
  for (int f = 0; f < n_faces(part); ++f) {
    DraftFace out;
    out.normal = to_body * face_normal(part, f);
    out.centre = to_body * (face_centroid(part, f) - centroid);
    out.area = face_area(part, f);
    out.tag = part.face_tag[f];
    out.internal = stands_among_others && out.tag == face_internal;
    for (const int v : face(part, f)) out.corners.push_back(draft.vertices[v]);
    draft.faces.push_back(std::move(out));
    draft.loops.emplace_back(face(part, f).begin(), face(part, f).end());
  }
  draft.edges = edges(part);
  return draft;
}

void check_part(const Polyhedron& part) {
  double size = 0;
  for (const Vec3& v : part.vertices) size = std::max(size, (v - part.vertices[0]).norm());
  const SurfaceFault fault = check_surface(part).fault;
  if (fault != SurfaceFault::none)
    throw InputError({}, std::string("a convex part of a block is ") + text(fault),
                     "repair the mesh, or cut the block anew");
  if (!is_convex(part, negligible * size))
    throw InputError({}, "a part of a block is not convex",
                     "split the block into convex parts (talus-blocks does)");
}

// Area of `face` that lies against faces of the body's other parts.
double covered_area(const std::vector<DraftPart>& parts, std::size_t own, const DraftFace& face,
                    double same) {
  double area = 0;
  for (std::size_t q = 0; q < parts.size(); ++q) {
    if (q == own) continue;
    for (const DraftFace& other : parts[q].faces)
      if (face.normal.dot(other.normal) < -1 + rounding &&
          std::abs(face.normal.dot(other.centre - face.centre)) <= same)
        area += face_overlap(face.corners, face.normal, other.corners).area;
  }
  return area;
}

void mark_internal_faces(std::vector<DraftPart>& parts, double same) {
  for (std::size_t p = 0; p < parts.size(); ++p)
    for (DraftFace& face : parts[p].faces) {
      const double covered = covered_area(parts, p, face, same);
      face.partly = covered > negligible * face.area && covered < (1 - negligible) * face.area;
      face.internal = !face.partly && covered > 0.5 * face.area;
    }
}

bool contains(const DraftFace& face, const Vec3& point, double same) {
  if (std::abs(face.normal.dot(point - face.centre)) > same) return false;
  for (std::size_t k = 0; k < face.corners.size(); ++k) {
    const Vec3& start = face.corners[k];
    const Vec3 side = face.corners[(k + 1) % face.corners.size()] - start;
    if (face.normal.cross(side).dot(point - start) < -same * side.norm()) return false;
  }
  return true;
}

// Is the face bare beside `point` of it, on either side of the direction `along`?
bool is_bare_beside(const std::vector<DraftPart>& parts, const DraftFace& face, const Vec3& point,
                    const Vec3& along, double same) {
  for (const double side : {-100 * same, 100 * same}) {
    const Vec3 beside = point + side * face.normal.cross(along);
    if (!contains(face, beside, same)) continue;
    bool covered = false;
    for (const DraftPart& part : parts)
      for (const DraftFace& other : part.faces)
        covered |= face.normal.dot(other.normal) < -1 + rounding && contains(other, beside, same);
    if (!covered) return true;
  }
  return false;
}

bool has_normal(const std::vector<const DraftFace*>& faces, const Vec3& normal) {
  return std::any_of(faces.begin(), faces.end(), [&](const DraftFace* face) {
    return (face->normal - normal).norm() < negligible;
  });
}

// Whether another part of the body has a face at `point`.
bool is_shared(const std::vector<DraftPart>& parts, const DraftPart& own, const Vec3& point,
               double same) {
  return std::any_of(parts.begin(), parts.end(), [&](const DraftPart& part) {
    return &part != &own &&
           std::any_of(part.faces.begin(), part.faces.end(),
                       [&](const DraftFace& face) { return contains(face, point, same); });
  });
}

// The two surface normals of the body at the middle of a part's edge, in the order that turns about
// the edge; no normals where the surface is flat, concave or hidden there. Where no other part is,
// they are those of the part's own faces, however narrow these are.
std::vector<Vec3> surface_arc(const std::vector<DraftPart>& parts, const DraftPart& own,
                              const PolyhedronEdge& edge, double same) {
  const Vec3 &a = own.vertices[edge.a], &b = own.vertices[edge.b];
  const Vec3 middle = (a + b) / 2, along = (b - a).normalized();
  if (!is_shared(parts, own, middle, same)) {
    const DraftFace &left = own.faces[edge.left], &right = own.faces[edge.right];
    if (left.internal || right.internal || (left.normal - right.normal).norm() < negligible)
      return {};
    return {left.normal, right.normal};
  }
  std::vector<const DraftFace*> found;
  for (const DraftPart& part : parts)
    for (const DraftFace& face : part.faces)
      if (!face.internal && std::abs(face.normal.dot(along)) <= negligible &&
          contains(face, middle, same) && !has_normal(found, face.normal) &&
          is_bare_beside(parts, face, middle, along, same))
        found.push_back(&face);
  if (found.size() != 2) return {};
  const DraftFace &one = *found[0], &two = *found[1];
  if (one.normal.dot(two.centre - middle) >= 0 || two.normal.dot(one.centre - middle) >= 0)
    return {};
  if (one.normal.cross(two.normal).dot(along) > 0) return {one.normal, two.normal};
  return {two.normal, one.normal};
}

void add_vertices(Hulls& hulls, const DraftPart& part) {
  for (std::size_t v = 0; v < part.vertices.size(); ++v) {
    hulls.vertices.push_back(part.vertices[v]);
    for (std::size_t f = 0; f < part.loops.size(); ++f)
      if (std::count(part.loops[f].begin(), part.loops[f].end(), static_cast<int>(v)) > 0)
        hulls.ring_faces.push_back(static_cast<int>(f));
    hulls.ring_begin.push_back(static_cast<int>(hulls.ring_faces.size()));
  }
  hulls.vertex_begin.push_back(static_cast<int>(hulls.vertices.size()));
}

FaceCover cover_of(const DraftFace& face) {
  return face.internal ? FaceCover::all : face.partly ? FaceCover::part : FaceCover::none;
}

void add_normal(Hulls& hulls, const Vec3& normal, int joint_set, FaceCover cover) {
  hulls.nx.push_back(normal.x());
  hulls.ny.push_back(normal.y());
  hulls.nz.push_back(normal.z());
  hulls.joint_set.push_back(joint_set);
  hulls.cover.push_back(cover);
  hulls.loop_begin.push_back(static_cast<int>(hulls.loop_vertices.size()));
}

// Own faces with their loops; returns the number of the part's edge in `order` for (from, to).
void add_faces(Hulls& hulls, const DraftPart& part,
               const std::map<std::pair<int, int>, int>& edge_of) {
  for (std::size_t f = 0; f < part.faces.size(); ++f) {
    const std::vector<int>& loop = part.loops[f];
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const int from = loop[k], to = loop[(k + 1) % loop.size()];
      hulls.loop_vertices.push_back(from);
      hulls.loop_edges.push_back(edge_of.at(std::minmax(from, to)));
    }
    add_normal(hulls, part.faces[f].normal, part.faces[f].tag, cover_of(part.faces[f]));
  }
  hulls.n_faces.push_back(static_cast<int>(part.faces.size()));
}

// Index of a normal among the part's; a normal of another part of the body is appended.
int normal_index(Hulls& hulls, const Vec3& normal) {
  const int first = hulls.face_begin.back(), end = static_cast<int>(hulls.nx.size());
  for (int f = first; f < end; ++f)
    if ((Vec3(hulls.nx[f], hulls.ny[f], hulls.nz[f]) - normal).norm() < negligible)
      return f - first;
  add_normal(hulls, normal, face_internal, FaceCover::all);
  return end - first;
}

double smallest_width(const DraftPart& part) {
  double width = std::numeric_limits<double>::infinity();
  for (const DraftFace& face : part.faces) {
    double lowest = 0;
    for (const Vec3& v : part.vertices) lowest = std::min(lowest, face.normal.dot(v - face.centre));
    width = std::min(width, -lowest);
  }
  return width;
}

void add_part(Hulls& hulls, const std::vector<DraftPart>& parts, const DraftPart& part, int body,
              double same) {
  struct Arc {
    const PolyhedronEdge* edge;
    std::vector<Vec3> normals;
  };
  std::vector<Arc> arcs;
  for (const PolyhedronEdge& edge : part.edges)
    arcs.push_back({&edge, surface_arc(parts, part, edge, same)});
  const auto middle = std::stable_partition(arcs.begin(), arcs.end(),
                                            [](const Arc& arc) { return !arc.normals.empty(); });
  std::map<std::pair<int, int>, int> edge_of;
  for (std::size_t e = 0; e < arcs.size(); ++e)
    edge_of[std::minmax(arcs[e].edge->a, arcs[e].edge->b)] = static_cast<int>(e);

  hulls.body.push_back(body);
  hulls.thickness.push_back(smallest_width(part));
  add_vertices(hulls, part);
  add_faces(hulls, part, edge_of);
  for (const Arc& arc : arcs) {
    const PolyhedronEdge& e = *arc.edge;
    HullEdge out{e.a, e.b, e.left, e.right, e.left, e.right};
    if (!arc.normals.empty()) {
      out.arc_left = normal_index(hulls, arc.normals[0]);
      out.arc_right = normal_index(hulls, arc.normals[1]);
    }
    hulls.edges.push_back(out);
  }
  hulls.n_active_edges.push_back(static_cast<int>(middle - arcs.begin()));
  hulls.edge_begin.push_back(static_cast<int>(hulls.edges.size()));
  while (hulls.nx.size() % 4 != 0)
    add_normal(hulls, Vec3(hulls.nx.back(), hulls.ny.back(), hulls.nz.back()), face_internal,
               FaceCover::all);
  hulls.face_begin.push_back(static_cast<int>(hulls.nx.size()));
}

// The normals of slots [begin, end), multiples of 4, turned into local axes.
void turn_normals(const Hulls& hulls, int begin, int end, const Mat3& turn, PlacedHulls& placed) {
  double* const to[3] = {placed.nx.data(), placed.ny.data(), placed.nz.data()};
  for (int f = begin; f < end; f += n_lanes) {
    const Lanes x = lanes(&hulls.nx[f]), y = lanes(&hulls.ny[f]), z = lanes(&hulls.nz[f]);
    for (int k = 0; k < 3; ++k) lanes(to[k] + f) = turn(k, 0) * x + turn(k, 1) * y + turn(k, 2) * z;
  }
}

void normalize(PlacedHulls& placed, int begin, int end) {
  for (int f = begin; f < end; ++f) {
    const double scale = 1 / normal_at(placed, f).norm();
    placed.nx[f] *= scale;
    placed.ny[f] *= scale;
    placed.nz[f] *= scale;
  }
}

void place_part(const Hulls& hulls, int p, const Mat3& axes, const Mat3& normal_axes, bool rigid,
                const Vec3& position, PlacedHulls& placed) {
  const int first = hulls.vertex_begin[p];
  for (int v = first; v < hulls.vertex_begin[p + 1]; ++v)
    placed.vertices[v].noalias() = axes * hulls.vertices[v] + position;
  const int face_first = hulls.face_begin[p], face_end = hulls.face_begin[p + 1];
  turn_normals(hulls, face_first, face_end, normal_axes, placed);
  if (!rigid) normalize(placed, face_first, face_end);
  for (int f = face_first; f < face_first + hulls.n_faces[p]; ++f)
    placed.offset[f] =
        normal_at(placed, f).dot(placed.vertices[first + hulls.loop_vertices[hulls.loop_begin[f]]]);
}

void resize(const Hulls& hulls, PlacedHulls& placed) {
  placed.vertices.resize(hulls.vertices.size());
  for (std::vector<double>* v : {&placed.nx, &placed.ny, &placed.nz, &placed.offset})
    v->resize(hulls.nx.size());
  placed.position.resize(hulls.radius.size());
  placed.axes.resize(hulls.radius.size());
  placed.turned.assign(hulls.radius.size(), 0);
}

}  // namespace

void add_hulls(Hulls& hulls, std::span<const Polyhedron> parts, const Vec3& centroid,
               const Mat3& to_body, bool stands_among_others) {
  std::vector<DraftPart> drafts;
  double radius = 0;
  for (const Polyhedron& part : parts) {
    check_part(part);
    drafts.push_back(draft_part(part, centroid, to_body, stands_among_others));
    for (const Vec3& v : drafts.back().vertices) radius = std::max(radius, v.norm());
  }
  const double same = negligible * radius;
  if (drafts.size() > 1) mark_internal_faces(drafts, same);
  const int body = n_bodies(hulls);
  for (const DraftPart& draft : drafts) add_part(hulls, drafts, draft, body, same);
  hulls.radius.push_back(radius);
  hulls.part_begin.push_back(n_parts(hulls));
  hulls.body_vertex_begin.push_back(hulls.vertex_begin.back());
  hulls.body_edge_begin.push_back(hulls.edge_begin.back());
}

Hulls make_hulls(const BlockSet& set, std::span<const Pose> rest) {
  Hulls hulls;
  std::vector<Polyhedron> parts;
  for (int b = 0; b < n_blocks(set); ++b) {
    parts.clear();
    for (int p = set.convex_part_begin[b]; p < set.convex_part_begin[b + 1]; ++p)
      parts.push_back(convex_part(set, p));
    add_hulls(hulls, parts, rest[b].position, rest[b].attitude.conjugate().toRotationMatrix());
  }
  return hulls;
}

namespace {

// `stretch`: nullptr for a rigid body. `first`: it was not placed before.
void place_one(const Hulls& hulls, int b, const Pose& pose, const Mat3* stretch, bool first,
               PlacedHulls& placed) {
  const bool rigid = stretch == nullptr;
  const Mat3 turn = pose.attitude.toRotationMatrix();
  const Mat3 axes = rigid ? turn : Mat3(turn * *stretch);
  if (!first && axes == placed.axes[b] && pose.position == placed.position[b]) return;
  if (!first) placed.turned[b] += hulls.radius[b] * (axes - placed.axes[b]).norm();
  const Mat3 normal_axes = rigid ? turn : Mat3(axes.inverse().transpose());
  placed.axes[b] = axes;
  placed.position[b] = pose.position;
  for (int p = hulls.part_begin[b]; p < hulls.part_begin[b + 1]; ++p)
    place_part(hulls, p, axes, normal_axes, rigid, pose.position, placed);
}

}  // namespace

void place_hulls(const Hulls& hulls, std::span<const Pose> poses, std::span<const Mat3> stretch,
                 std::span<const std::uint8_t> moving, PlacedHulls& placed, Workers* workers) {
  const bool first = placed.turned.size() != hulls.radius.size();
  if (first) resize(hulls, placed);
  TALUS_ASSERT(!first || poses.size() == hulls.radius.size());
  in_chunks(workers, poses.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b) {
      if (!first && !moving.empty() && moving[b] == 0) continue;
      place_one(hulls, static_cast<int>(b), poses[b], stretch.empty() ? nullptr : &stretch[b],
                first, placed);
    }
  });
}

void place_body(const Hulls& hulls, int b, const Pose& pose, PlacedHulls& placed) {
  place_one(hulls, b, pose, nullptr, false, placed);
}

Box box_of_part(const Hulls& hulls, const PlacedHulls& placed, int part) {
  const int first = hulls.vertex_begin[part];
  Box box{placed.vertices[first], placed.vertices[first]};
  for (int v = first + 1; v < hulls.vertex_begin[part + 1]; ++v) {
    box.low = box.low.cwiseMin(placed.vertices[v]);
    box.high = box.high.cwiseMax(placed.vertices[v]);
  }
  return box;
}

}  // namespace talus
