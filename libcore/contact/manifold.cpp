// Contact points of two convex parts along a given axis.
#include "contact/manifold.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/make_room.hpp"
#include "contact/pair_axes.hpp"
#include "contact/scales.hpp"
#include "geometry/corner_shares.hpp"

namespace talus {
namespace {

FacePair face_pair(const Hulls& hulls, int part_a, int part_b, const PairAxis& axis, int incident) {
  if (axis.kind == AxisKind::face_a)
    return {part_a, part_b, hulls.face_begin[part_a] + axis.feature_a,
            hulls.face_begin[part_b] + incident, true};
  return {part_b, part_a, hulls.face_begin[part_b] + axis.feature_b,
          hulls.face_begin[part_a] + incident, false};
}

// Numbers from the first of the body.
int body_part(const Hulls& hulls, int part) { return part - hulls.part_begin[hulls.body[part]]; }
int body_vertex(const Hulls& hulls, int part, int slot) {
  return slot - hulls.body_vertex_begin[hulls.body[part]];
}
int body_edge(const Hulls& hulls, int part, int edge) {
  return hulls.edge_begin[part] + edge - hulls.body_edge_begin[hulls.body[part]];
}

ContactKey key_of(const Hulls& hulls, const FacePair& pair, const ClipCorner& corner) {
  const int inc = pair.incident_part, ref = pair.reference_part;
  int inc_feature = 0, ref_feature = 0;
  ContactMode mode = corner.mode;
  switch (corner.mode) {
    case ContactMode::edge_edge:
      inc_feature = body_edge(
          hulls, inc, hulls.loop_edges[hulls.loop_begin[pair.incident_face] + corner.incident]);
      ref_feature = body_edge(
          hulls, ref, hulls.loop_edges[hulls.loop_begin[pair.reference_face] + corner.reference]);
      break;
    case ContactMode::vertex_face:
      inc_feature =
          body_vertex(hulls, inc, corner_slot(hulls, inc, pair.incident_face, corner.incident));
      ref_feature = body_part(hulls, ref);
      if (pair.reference_is_a) mode = ContactMode::face_vertex;
      break;
    case ContactMode::face_vertex:
      inc_feature = body_part(hulls, inc);
      ref_feature =
          body_vertex(hulls, ref, corner_slot(hulls, ref, pair.reference_face, corner.reference));
      if (pair.reference_is_a) mode = ContactMode::vertex_face;
      break;
  }
  if (pair.reference_is_a) return {mode, hulls.body[inc], ref_feature, inc_feature};
  return {mode, hulls.body[ref], inc_feature, ref_feature};
}

// Vertices beside the incident face that are in behind the reference face: a long body with many
// faces may lean on it with both of its ends, which no face of its has in common. Held by one end
// in turn with the other, it would sink in.
void add_vertices_behind(const Hulls& hulls, const PlacedHulls& placed, const FacePair& pair,
                         const FaceFrame& frame, const std::vector<Vec2>& reference,
                         std::vector<HeldPoint>& held) {
  const int part = pair.incident_part, n = n_corners(hulls, pair.incident_face);
  const Vec3& normal = normal_at(placed, pair.reference_face);
  for (int slot = hulls.vertex_begin[part]; slot < hulls.vertex_begin[part + 1]; ++slot) {
    const Vec3 from = placed.vertices[slot] - frame.origin;
    if (normal.dot(from) >= 0) continue;
    bool of_face = false;
    for (int i = 0; i < n; ++i) of_face |= corner_slot(hulls, part, pair.incident_face, i) == slot;
    if (of_face || !is_in_reference(reference, frame.u.dot(from), frame.v.dot(from))) continue;
    const int vertex = body_vertex(hulls, part, slot), face = body_part(hulls, pair.reference_part);
    held.push_back(
        {pair.reference_is_a
             ? ContactKey{ContactMode::face_vertex, hulls.body[part], face, vertex}
             : ContactKey{ContactMode::vertex_face, hulls.body[pair.reference_part], vertex, face},
         0});
  }
}

// The places of the contacts of a face axis. `n` is the outward normal of the reference face.
struct FaceContacts {
  const Hulls& hulls;
  const PlacedHulls& placed;
  FacePair pair;
  Vec3 n, incident_normal;
  double offset, incident_offset;
  double slope;                               // n . incident_normal, < 0
  int reference_vertices, incident_vertices;  // first of the bodies
  int reference_edges, incident_edges;
};

FaceContacts face_contacts(const Hulls& hulls, const PlacedHulls& placed, const FacePair& pair) {
  const int reference = hulls.body[pair.reference_part], incident = hulls.body[pair.incident_part];
  FaceContacts face{hulls,
                    placed,
                    pair,
                    normal_at(placed, pair.reference_face),
                    normal_at(placed, pair.incident_face),
                    placed.offset[pair.reference_face],
                    placed.offset[pair.incident_face],
                    0,
                    hulls.body_vertex_begin[reference],
                    hulls.body_vertex_begin[incident],
                    hulls.body_edge_begin[reference],
                    hulls.body_edge_begin[incident]};
  face.slope = std::min(face.n.dot(face.incident_normal), -1e-9);
  return face;
}

// A point of the incident part and its height above the plane of the reference face. The functions
// that fill it work on references and single numbers: copies of vectors to the stack, read back in
// other widths, made them three times slower.
struct Place {
  double x, y, z, height;
};

// Where an edge of the incident part crosses a side of the reference face, seen along its normal.
Place edge_crossing(const FaceContacts& face, int side_of_body, int edge_of_body) {
  const HullEdge& side = face.hulls.edges[face.reference_edges + side_of_body];
  const HullEdge& edge = face.hulls.edges[face.incident_edges + edge_of_body];
  const Vec3* reference = &face.placed.vertices[face.hulls.vertex_begin[face.pair.reference_part]];
  const Vec3* incident = &face.placed.vertices[face.hulls.vertex_begin[face.pair.incident_part]];
  const Vec3 &s = reference[side.a], &e = reference[side.b];
  const Vec3 &p = incident[edge.a], &q = incident[edge.b];
  const double u = e.x() - s.x(), v = e.y() - s.y(), w = e.z() - s.z();
  const double across_x = face.n.y() * w - face.n.z() * v;
  const double across_y = face.n.z() * u - face.n.x() * w;
  const double across_z = face.n.x() * v - face.n.y() * u;
  const double d_p =
      across_x * (p.x() - s.x()) + across_y * (p.y() - s.y()) + across_z * (p.z() - s.z());
  const double d_q =
      across_x * (q.x() - s.x()) + across_y * (q.y() - s.y()) + across_z * (q.z() - s.z());
  const double t = d_p == d_q ? 0.5 : std::clamp(d_p / (d_p - d_q), 0.0, 1.0);
  const double x = p.x() + t * (q.x() - p.x()), y = p.y() + t * (q.y() - p.y()),
               z = p.z() + t * (q.z() - p.z());
  return {x, y, z, face.n.x() * x + face.n.y() * y + face.n.z() * z - face.offset};
}

// A vertex of the incident part.
Place incident_vertex(const FaceContacts& face, int vertex_of_body) {
  const Vec3& p = face.placed.vertices[face.incident_vertices + vertex_of_body];
  return {p.x(), p.y(), p.z(),
          face.n.x() * p.x() + face.n.y() * p.y() + face.n.z() * p.z() - face.offset};
}

// The point of the incident face above a vertex of the reference part.
Place above_reference_vertex(const FaceContacts& face, int vertex_of_body) {
  const Vec3& p = face.placed.vertices[face.reference_vertices + vertex_of_body];
  const Vec3& m = face.incident_normal;
  const double height =
      (face.incident_offset - m.x() * p.x() - m.y() * p.y() - m.z() * p.z()) / face.slope;
  return {p.x() + height * face.n.x(), p.y() + height * face.n.y(), p.z() + height * face.n.z(),
          height};
}

Place place_of(const FaceContacts& face, const ContactKey& key) {
  const bool of_a = face.pair.reference_is_a;
  const int reference = of_a ? key.feature_a : key.feature_b;
  const int incident = of_a ? key.feature_b : key.feature_a;
  if (key.mode == ContactMode::edge_edge) return edge_crossing(face, reference, incident);
  if ((key.mode == ContactMode::face_vertex) == of_a) return incident_vertex(face, incident);
  return above_reference_vertex(face, reference);
}

void add_face_points(const Hulls& hulls, const PlacedHulls& placed, const FacePair& pair,
                     const PointReach& reach, std::span<const HeldPoint> held,
                     std::vector<PairPoint>& points) {
  const FaceContacts face = face_contacts(hulls, placed, pair);
  for (const HeldPoint& h : held) {
    const Place p = place_of(face, h.key);
    if (!reach.takes(p.height, p.x, p.y, p.z)) continue;
    const double back = pair.reference_is_a ? 0 : p.height;  // B's point, when A is incident
    make_room(points);
    PairPoint& point = points.emplace_back();
    point.key = h.key;
    point.point_b.x() = p.x - back * face.n.x();
    point.point_b.y() = p.y - back * face.n.y();
    point.point_b.z() = p.z - back * face.n.z();
    point.gap = p.height;
    point.area = h.area;
  }
}

// The point of edge B nearest to the line of edge A, within the edge.
Vec3 crossing_on_b(const Vec3& a, const Vec3& along_a, const Vec3& b, const Vec3& along_b) {
  const double aa = along_a.squaredNorm(), bb = along_b.squaredNorm(), ab = along_a.dot(along_b);
  const double t = (ab * along_a.dot(b - a) - aa * along_b.dot(b - a)) / (aa * bb - ab * ab);
  return b + std::clamp(t, 0.0, 1.0) * along_b;
}

void add_edge_point(const Hulls& hulls, const PlacedHulls& placed, int part_a, int part_b,
                    const PairAxis& axis, const Vec3& normal, const PointReach& reach,
                    const HeldPoint& held, std::vector<PairPoint>& points) {
  const HullEdge& edge_a = hulls.edges[hulls.edge_begin[part_a] + axis.feature_a];
  const HullEdge& edge_b = hulls.edges[hulls.edge_begin[part_b] + axis.feature_b];
  const Vec3& a = placed.vertices[hulls.vertex_begin[part_a] + edge_a.a];
  const Vec3& b = placed.vertices[hulls.vertex_begin[part_b] + edge_b.a];
  const double gap = normal.dot(a - b);
  if (!(gap <= reach.margin)) return;
  const Vec3 along_a = placed.vertices[hulls.vertex_begin[part_a] + edge_a.b] - a;
  const Vec3 along_b = placed.vertices[hulls.vertex_begin[part_b] + edge_b.b] - b;
  const Vec3 on_b = crossing_on_b(a, along_a, b, along_b);
  if (!reach.takes(gap, on_b.x(), on_b.y(), on_b.z())) return;
  make_room(points);
  points.push_back({held.key, on_b, gap, held.area});
}

ContactKey key_of_edges(const Hulls& hulls, int part_a, int part_b, const PairAxis& axis) {
  return {ContactMode::edge_edge, hulls.body[part_b], body_edge(hulls, part_a, axis.feature_a),
          body_edge(hulls, part_b, axis.feature_b)};
}

struct Segment {
  Vec3 start, end;
};

Segment segment_of(const Hulls& hulls, const PlacedHulls& placed, int part, int edge) {
  const HullEdge& e = hulls.edges[hulls.edge_begin[part] + edge];
  const Vec3* vertices = &placed.vertices[hulls.vertex_begin[part]];
  return {vertices[e.a], vertices[e.b]};
}

// The point of a segment that the line of another meets, seen along `normal`.
Vec3 met_by(const Segment& segment, const Segment& line, const Vec3& normal) {
  const Vec3 across = normal.cross(line.end - line.start);
  const double d_start = across.dot(segment.start - line.start);
  const double d_end = across.dot(segment.end - line.start);
  const double t = d_start == d_end ? 0.5 : std::clamp(d_start / (d_start - d_end), 0.0, 1.0);
  return segment.start + t * (segment.end - segment.start);
}

// Do the ends of a segment lie on both sides of the line of another, seen along `normal`?
bool is_parted(const Segment& segment, const Segment& line, const Vec3& normal) {
  const Vec3 across = normal.cross(line.end - line.start);
  return across.dot(segment.start - line.start) * across.dot(segment.end - line.start) < 0;
}

// Edges that cross seen along `normal`, which need not be at right angles to them.
void add_crossing(const Hulls& hulls, const PlacedHulls& placed, int part_a, int part_b,
                  const Vec3& normal, const PointReach& reach, const HeldPoint& held,
                  std::vector<PairPoint>& points) {
  const auto segment = [&](int part, int edge_of_body) {
    return segment_of(
        hulls, placed, part,
        edge_of_body + hulls.body_edge_begin[hulls.body[part]] - hulls.edge_begin[part]);
  };
  const Segment a = segment(part_a, held.key.feature_a), b = segment(part_b, held.key.feature_b);
  const Vec3 on_b = met_by(b, a, normal);
  const double gap = normal.dot(met_by(a, b, normal) - on_b);
  if (!reach.takes(gap, on_b.x(), on_b.y(), on_b.z())) return;
  make_room(points);
  points.push_back({held.key, on_b, gap, held.area});
}

// An edge pair has one contact point, and a force beside it turns the blocks into each other before
// another contact is known: where a face is nearly as good, its corners are contacts too.
void prefer_near_face(const Hulls& hulls, const PlacedHulls& placed, int part_a, int part_b,
                      AxisChoice& choice) {
  if (choice.near_face.kind == AxisKind::none) return;
  choice.passed_over = choice.near_edges = choice.axis;
  choice.largest = choice.separation;
  choice.axis = choice.near_face;
  choice.normal = axis_normal(hulls, placed, part_a, part_b, choice.axis);
  choice.separation = apart_along(hulls, placed, part_a, part_b, choice.normal);
}

}  // namespace

double find_features(const Hulls& hulls, const PlacedHulls& placed, int part_a, int part_b,
                     const PairAxis& axis, int incident, bool with_areas, ClipScratch& scratch,
                     std::vector<HeldPoint>& held) {
  if (axis.kind == AxisKind::edges) {
    held.push_back({key_of_edges(hulls, part_a, part_b, axis), 0});
    return 0;
  }
  const FacePair pair = face_pair(hulls, part_a, part_b, axis, incident);
  const FaceFrame frame = clip_incident_face(hulls, placed, pair, scratch);
  const std::size_t begin = held.size();
  for (const ClipCorner& corner : scratch.polygon) held.push_back({key_of(hulls, pair, corner), 0});
  double area = 0;
  if (with_areas)
    area = share_area(
        scratch.polygon.size(),
        [&](std::size_t i) { return Vec2(scratch.polygon[i].u, scratch.polygon[i].v); },
        [&](std::size_t i, double share) { held[begin + i].area += share; });
  add_vertices_behind(hulls, placed, pair, frame, scratch.reference, held);
  return area;
}

double deepest_gap(const Hulls& hulls, const PlacedHulls& placed, int part_a, int part_b,
                   const PairAxis& axis, int incident, std::span<const HeldPoint> held) {
  const FaceContacts face =
      face_contacts(hulls, placed, face_pair(hulls, part_a, part_b, axis, incident));
  double deepest = std::numeric_limits<double>::infinity();
  for (const HeldPoint& h : held) deepest = std::min(deepest, place_of(face, h.key).height);
  return deepest;
}

void add_near_edges(const Hulls& hulls, const PlacedHulls& placed, int part_a, int part_b,
                    const PairAxis& near_edges, const Vec3& normal, std::size_t begin,
                    std::vector<HeldPoint>& held) {
  if (near_edges.kind == AxisKind::none) return;
  const ContactKey key = key_of_edges(hulls, part_a, part_b, near_edges);
  const auto same = [&](const HeldPoint& h) {
    return h.key.mode == key.mode && h.key.feature_a == key.feature_a &&
           h.key.feature_b == key.feature_b;
  };
  if (std::any_of(held.begin() + static_cast<std::ptrdiff_t>(begin), held.end(), same)) return;
  const Segment a = segment_of(hulls, placed, part_a, near_edges.feature_a);
  const Segment b = segment_of(hulls, placed, part_b, near_edges.feature_b);
  if (is_parted(a, b, normal) && is_parted(b, a, normal)) held.push_back({key, 0});
}

void keep_edges(const Hulls& hulls, const PlacedHulls& placed, int part_a, int part_b,
                std::span<const HeldPoint> before, const Vec3& normal, std::size_t begin,
                std::vector<HeldPoint>& held) {
  const auto edge_of_part = [&](int part, int edge_of_body) {
    const int edge =
        edge_of_body + hulls.body_edge_begin[hulls.body[part]] - hulls.edge_begin[part];
    return edge < hulls.edge_begin[part + 1] - hulls.edge_begin[part] ? edge : -1;
  };
  for (const HeldPoint& h : before) {
    if (h.key.mode != ContactMode::edge_edge) continue;
    const PairAxis edges{AxisKind::edges, edge_of_part(part_a, h.key.feature_a),
                         edge_of_part(part_b, h.key.feature_b)};
    if (edges.feature_a < 0 || edges.feature_b < 0) continue;
    const Segment a = segment_of(hulls, placed, part_a, edges.feature_a),
                  b = segment_of(hulls, placed, part_b, edges.feature_b);
    const Vec3 along_a = a.end - a.start, along_b = b.end - b.start;
    if (are_parallel(along_a, along_b, along_a.cross(along_b))) continue;
    if (axis_normal(hulls, placed, part_a, part_b, edges).dot(normal) >= same_axis_cos)
      add_near_edges(hulls, placed, part_a, part_b, edges, normal, begin, held);
  }
}

ContactSearch search_contact(const Hulls& hulls, const PlacedHulls& placed, int part_a, int part_b,
                             double margin, const PairAxis& last, bool with_areas,
                             AxisScratch& axis_scratch, ClipScratch& clip_scratch,
                             std::vector<HeldPoint>& held) {
  ContactSearch found;
  AxisChoice& choice = found.choice;
  choice = find_axis(hulls, placed, part_a, part_b, margin, last, axis_scratch);
  if (!choice.touches) return found;
  prefer_near_face(hulls, placed, part_a, part_b, choice);
  const std::size_t begin = held.size();
  found.incident = incident_of(hulls, placed, part_a, part_b, choice.axis);
  found.area = find_features(hulls, placed, part_a, part_b, choice.axis, found.incident, with_areas,
                             clip_scratch, held);
  add_near_edges(hulls, placed, part_a, part_b, choice.near_edges, choice.normal, begin, held);
  if (choice.passed_over.kind == AxisKind::none) return found;
  const double deep_enough = choice.largest + hardly_better * std::abs(choice.largest);
  if (deepest_gap(hulls, placed, part_a, part_b, choice.axis, found.incident,
                  std::span(held).subspan(begin)) <= deep_enough)
    return found;
  held.resize(begin);
  choice.axis = choice.passed_over;
  choice.near_edges = {};
  choice.normal = axis_normal(hulls, placed, part_a, part_b, choice.axis);
  choice.separation = choice.largest;
  choice.hold = 0;
  found.incident = incident_of(hulls, placed, part_a, part_b, choice.axis);
  found.area = find_features(hulls, placed, part_a, part_b, choice.axis, found.incident, with_areas,
                             clip_scratch, held);
  return found;
}

int incident_of(const Hulls& hulls, const PlacedHulls& placed, int part_a, int part_b,
                const PairAxis& axis) {
  if (axis.kind == AxisKind::face_a)
    return incident_face(hulls, placed, part_b,
                         normal_at(placed, hulls.face_begin[part_a] + axis.feature_a));
  if (axis.kind == AxisKind::face_b)
    return incident_face(hulls, placed, part_a,
                         normal_at(placed, hulls.face_begin[part_b] + axis.feature_b));
  return -1;
}

void add_manifold(const Hulls& hulls, const PlacedHulls& placed, int part_a, int part_b,
                  const PairAxis& axis, int incident, const Vec3& normal, double area,
                  const PointReach& reach, std::span<const HeldPoint> held,
                  std::vector<PairManifold>& manifolds, std::vector<PairPoint>& points) {
  const int begin = static_cast<int>(points.size());
  int face_a = axis.feature_a, face_b = axis.feature_b;
  if (axis.kind == AxisKind::edges) {
    add_edge_point(hulls, placed, part_a, part_b, axis, normal, reach, held[0], points);
    for (const HeldPoint& other : held.subspan(1))
      add_crossing(hulls, placed, part_a, part_b, normal, reach, other, points);
    face_a = hulls.edges[hulls.edge_begin[part_a] + axis.feature_a].left;
    face_b = hulls.edges[hulls.edge_begin[part_b] + axis.feature_b].left;
  } else {
    add_face_points(hulls, placed, face_pair(hulls, part_a, part_b, axis, incident), reach, held,
                    points);
    (axis.kind == AxisKind::face_a ? face_b : face_a) = incident;
  }
  const int end = static_cast<int>(points.size());
  manifolds.push_back({hulls.body[part_a], hulls.body[part_b], part_a, part_b,
                       hulls.joint_set[hulls.face_begin[part_a] + face_a],
                       hulls.joint_set[hulls.face_begin[part_b] + face_b], begin, end, area,
                       normal});
}

}  // namespace talus
