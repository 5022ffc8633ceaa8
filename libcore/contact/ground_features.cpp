// Finds contacts of convex nodes and edges of the ground with faces and edges of a block.
#include "contact/ground_features.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "contact/entrance.hpp"
#include "contact/scales.hpp"

namespace talus {
namespace {

using std::size_t;

// Bounds of the sine below which a block's face and a ridge count as parallel: the margin over the
// block's radius, by which a face that rests on a ridge may be pressed in farther at one end than
// at the other. The lower one is ten times the slope that ground_flags takes as flat.
constexpr double least_parallel = 1e-3;
constexpr double most_parallel = 0.03;
constexpr double explained = 2;    // of its depth: so near to another overlap it is part of that
constexpr double at_node = 0.01;   // of half the thickness: a ridge supports this far beyond its
                                   // ends
constexpr double blunt_cos = 0.1;  // of the normals beside a ridge: a normal between is along both
constexpr double searches_ahead = 10;  // a list of features is to last for this many ...
constexpr double least_skin = 5e-3;    // ... of the radius
constexpr double short_lived = 5;      // searches: such a list would not pay

// Sine below which a face of the block and a ridge count as parallel.
double parallel_within(double margin, double radius) {
  return std::clamp(margin / radius, least_parallel, most_parallel);
}

/// A search for contacts, or for the features of a list.
struct FeatureSearch : PlacedBlock {
  double margin;
  double nearly_parallel;  // sine
  double strained;         // bound on the displacement of vertices by strains [m]
  double skin = 0;         // by which the block may have moved, to make a list [m] ...
  double turn = 0;         // ... and may have turned, as a chord
  int n_put_off = 0;       // deep overlaps that another feature may explain better
  int n_sure = -1;         // second search, for these: the contacts found in the first

  [[nodiscard]] Vec3 to_body(const Vec3& x) const {
    return to_local.transpose() * (x - pose.position);
  }
  [[nodiscard]] double height(int vertex) const { return vertices[vertex].z(); }

  // Whether a contact at x is taken. A deep one in doubt is put off to the second search, and left
  // out there when an overlap was found near it: the features have come in by that one.
  [[nodiscard]] bool takes(const Vec3& x, double gap, bool in_doubt,
                           const std::vector<Contact>& contacts) {
    if (n_sure < 0) {
      n_put_off += in_doubt;
      return !in_doubt;
    }
    return in_doubt &&
           std::none_of(contacts.begin(), contacts.begin() + n_sure, [&](const Contact& other) {
             return other.gap < 0 && (other.point_b - x).norm() < -explained * gap;
           });
  }
};

// Whether X lies across a wall of part p, where another part of the body begins.
bool is_across_wall(const Shapes& shapes, int p, const Vec3& X, double same) {
  const auto begin = shapes.walls.begin();
  return std::any_of(
      begin + shapes.wall_begin[p], begin + shapes.wall_begin[p + 1],
      [&](const ShapeWall& wall) { return wall.normal.dot(X) > wall.offset + same; });
}

// How far X lies in part p: to the nearest face that does not meet in `edge`; negative outside of
// the part, also across a wall of it [m].
double depth_in_part(const Shapes& shapes, int p, const Vec3& X, const ShapeEdge& edge,
                     double same) {
  if (is_across_wall(shapes, p, X, same)) return -1;
  double depth = std::numeric_limits<double>::infinity();
  for (int f = shapes.face_begin[p]; f < shapes.face_begin[p + 1]; ++f) {
    const ShapeFace& face = shapes.faces[f];
    const double inside = face.offset - face.normal.dot(X);
    const bool at_edge = face.normal.dot(edge.arc.left) > 1 - rounding ||
                         face.normal.dot(edge.arc.right) > 1 - rounding;
    if (!at_edge || inside < -same) depth = std::min(depth, inside);
  }
  return depth;
}

// Whether an edge of the block, at A, and one of the ground, at X (both in body axes), that read as
// `depth` deep overlap by that: X lies in the block, which no other face leads out of sooner, and A
// not high above the ground (behind a sharp ridge it may be a little). Far from the edges the
// planes beside them end, and such a pair may lie in the open.
bool edges_overlap(const FeatureSearch& s, const ShapeEdge& edge, const Vec3& A, const Vec3& X,
                   double depth) {
  const Trn& trn = s.ground.trn;
  const Vec3 a = s.pose.position + s.to_local * A;
  if (!contains(trn, a.x(), a.y())) return false;
  if (!(a.z() - elevation_at(trn, locate(trn, a.x(), a.y())) < 2 * depth)) return false;
  const double same = rounding * s.shapes.radius[s.b];
  for (int p = s.shapes.part_begin[s.b]; p < s.shapes.part_begin[s.b + 1]; ++p)
    if (depth_in_part(s.shapes, p, X, edge, same) >= depth) return true;
  return false;
}

// The six neighbours of an inner node of the network.
std::array<Vec3, 6> node_ring(const Trn& trn, int row, int col) {
  return {node_point(trn, row, col + 1),     node_point(trn, row - 1, col),
          node_point(trn, row - 1, col - 1), node_point(trn, row, col - 1),
          node_point(trn, row + 1, col),     node_point(trn, row + 1, col + 1)};
}

/// The face through which a node of the ground is in a part, and its distance from it.
struct EnteredFace {
  int face = -1;  // -1: none
  double gap = -std::numeric_limits<double>::infinity();
  bool is_nearest = true;
};

// Node (row, col) of the ground, at X in body axes, enters through the nearest face of part p.
// Where the ground beside the node is higher than that face's plane, it came in from below, through
// the face beneath it.
EnteredFace entered_face(const FeatureSearch& s, int p, int row, int col, const Vec3& X) {
  const Vec3 up = s.to_local.transpose() * Vec3::UnitZ();
  EnteredFace nearest, beneath;
  beneath.is_nearest = false;
  double height = std::numeric_limits<double>::infinity();  // above the lowest face so far
  for (int f = s.shapes.face_begin[p]; f < s.shapes.face_begin[p + 1]; ++f) {
    const ShapeFace& face = s.shapes.faces[f];
    const double gap = face.normal.dot(X) - face.offset, slope = face.normal.dot(up);
    if (gap > nearest.gap) nearest.face = f, nearest.gap = gap;
    if (slope < 0 && gap > slope * height)
      beneath.face = f, beneath.gap = gap, height = gap / slope;
  }
  if (nearest.face < 0 || nearest.gap > s.margin) return {};
  const Trn& trn = s.ground.trn;
  const std::array<Vec3, 6> ring = node_ring(trn, row, col);
  for (const EnteredFace& entered : {nearest, beneath}) {
    if (entered.face < 0) continue;
    const Vec3 outward = s.to_local * s.shapes.faces[entered.face].normal;
    if (vertex_may_enter(node_point(trn, row, col), ring, outward,
                         s.nearly_parallel * trn.cell_size))
      return entered;
  }
  return {};
}

void find_mode_2(FeatureSearch& s, int row, int col, std::vector<Contact>& contacts) {
  const Trn& trn = s.ground.trn;
  const Vec3 node = node_point(trn, row, col);
  const Vec3 X = s.to_body(node);
  const double radius = s.shapes.radius[s.b] + s.margin;
  if (X.squaredNorm() > radius * radius) return;
  const double deepest = s.shapes.thickness[s.b] / 2;
  for (int p = s.shapes.part_begin[s.b]; p < s.shapes.part_begin[s.b + 1]; ++p) {
    if (is_across_wall(s.shapes, p, X, rounding * radius)) continue;
    const EnteredFace entered = entered_face(s, p, row, col, X);
    if (entered.face < 0) continue;
    const bool in_doubt = !entered.is_nearest && entered.gap < -hardly_better * deepest;
    if (!s.takes(node, entered.gap, in_doubt, contacts)) continue;
    const ShapeFace& face = s.shapes.faces[entered.face];
    Contact contact;
    contact.key = {ContactMode::face_vertex, -1, entered.face,
                   static_cast<int>(node_index(trn, row, col))};
    contact.block_a = s.b;
    contact.ground_class = class_of(s.ground, first_triangle(trn, {std::min(row, trn.n_rows - 2),
                                                                   std::min(col, trn.n_cols - 2)}));
    contact.normal = -(s.to_local * face.normal);
    contact.gap = entered.gap;
    contact.point_a = X - entered.gap * face.normal;
    contact.point_b = node;
    contacts.push_back(contact);
  }
}

/// Vertices of a block above the planes on either side of a ridge by more than the margin, as bits.
/// The ground at a ridge is the region below both planes: an edge between two vertices above the
/// same one is clear of it.
struct AboveRidge {
  static constexpr size_t most = 64;  // vertices; of a block with more nothing is known
  std::uint64_t left = 0, right = 0;

  [[nodiscard]] bool has(int a, int b) const {
    return ((left >> a & left >> b) | (right >> a & right >> b)) & 1;
  }
  [[nodiscard]] bool has_all(size_t n_vertices) const {
    if (n_vertices > most) return false;
    const std::uint64_t all = ~std::uint64_t{0} >> (most - n_vertices);
    return left == all || right == all;
  }
};

// Whether a point is above the plane of `normal` through `at` by more than `clear`.
bool is_above(const Vec3& normal, const Vec3& at, const Vec3& point, double clear) {
  const double x = point.x() - at.x(), y = point.y() - at.y(), z = point.z() - at.z();
  return normal.x() * x + normal.y() * y + normal.z() * z > clear;
}

constexpr std::uint64_t all_edges = ~std::uint64_t{0};

/// An edge of the ground and its geometry for the search.
struct Ridge {
  Vec3 end_a, end_b;          // local axes
  Vec3 Q, f;                  // end_a and the path to end_b, body axes
  GaussArc arc;               // body axes
  int left = 0, feature = 0;  // triangle; as in the contact's key
};

// The contact of edge `i` of the block with a ridge whose arc it crosses, if they meet.
void add_edge_contact(FeatureSearch& s, const Ridge& ridge, size_t i, double deepest,
                      std::vector<Contact>& contacts) {
  const std::span<const Vec3> body = vertices_of(s.shapes, s.b);
  const ShapeEdge& edge = edges_of(s.shapes, s.b)[i];
  const Vec3 &Q = ridge.Q, &f = ridge.f, &P = body[edge.a];
  const Vec3 e = body[edge.b] - P;
  LinePair at = nearest_on_lines(P, e, Q, f, no_crossing_sin_sq);
  if (at.parallel) return;
  Vec3 normal = e.cross(f);
  const bool nearly_parallel =
      normal.squaredNorm() <= parallel_sin_sq * e.squaredNorm() * f.squaredNorm();
  normal.normalize();
  if (normal.dot(ridge.arc.left + ridge.arc.right) < 0) normal = -normal;
  // Where a face is as good, the direction across such edges is hardly known.
  if (nearly_parallel && !(is_well_inside(ridge.arc, normal) && is_well_inside(edge.arc, -normal)))
    return;
  // Of edges that overlap the nearest points may lie a little beyond an end. Where they cross in
  // plan, the block's is below the ground, however deep.
  const bool overlap = normal.dot(P - Q) < 0;
  const Vec3 up = s.to_local.transpose() * Vec3::UnitZ();
  const LinePair crossing = overlap ? crossing_seen_along(up, P, e, Q, f) : at;
  // Ridges that meet at a node both support an edge above it: taken by turns they would not.
  const double beyond = std::clamp(normal.dot(Q - P), 0.0, at_node * deepest) / f.norm();
  // An edge along the normal of one side that ends before the ridge reads as overlapping it by as
  // much as its end is below the other side's plane, which is in the air there.
  if (overlap && !is_within(crossing, beyond) && !edges_may_touch(edge.arc, ridge.arc, 0)) return;
  if (!is_within(at, beyond)) at = crossing;
  if (!is_within(at, beyond)) return;
  const Vec3 a = P + at.s * e, X = Q + at.t * f;
  const double gap = normal.dot(a - X);
  if (gap > s.margin) return;
  const bool in_doubt =
      gap < -hardly_better * deepest && (gap < -deepest || !edges_overlap(s, edge, a, X, -gap));
  if (in_doubt && !is_within(crossing, beyond)) return;
  const Vec3 x = ridge.end_a + at.t * (ridge.end_b - ridge.end_a);
  if (!s.takes(x, gap, in_doubt, contacts)) return;
  Contact contact;
  contact.key = {ContactMode::edge_edge, -1, static_cast<int>(i), ridge.feature};
  contact.block_a = s.b;
  contact.ground_class = class_of(s.ground, ridge.left);
  contact.normal = s.to_local * normal;
  contact.gap = gap;
  contact.point_a = a;
  contact.point_b = x;
  contacts.push_back(contact);
}

/// A ridge that the block may touch, and bounds that exclude some of its edges.
struct NearRidge {
  Ridge ridge;
  Vec3 left, right;    // normals beside it, local axes
  double clear = 0;    // farther above a plane beside it than that the block does not touch it [m]
  double height = 0;   // nor above that, local axes [m]
  bool blunt = false;  // planes beside it tell nothing

  // Whether the block's edge between two vertices is above one of the planes beside the ridge.
  [[nodiscard]] bool is_cleared_by(const Vec3& a, const Vec3& b) const {
    const Vec3& at = ridge.end_a;
    const int left_of = int{is_above(left, at, a, clear)} & int{is_above(left, at, b, clear)};
    const int right_of = int{is_above(right, at, a, clear)} & int{is_above(right, at, b, clear)};
    return !blunt && (left_of | right_of) != 0;
  }
};

// The ridge, unless the block is clear of it for its distance.
bool come_near(const FeatureSearch& s, int row, int col, EdgeKind kind, NearRidge& near) {
  const Trn& trn = s.ground.trn;
  const TrnEdge edge = trn_edge(trn, row, col, kind);
  Ridge& ridge = near.ridge;
  const Vec3& end_a = ridge.end_a = node_point(trn, edge.a.row, edge.a.col);
  const Vec3& end_b = ridge.end_b = node_point(trn, edge.b.row, edge.b.col);
  const double reach = s.margin + s.skin;
  if ((end_a.cwiseMax(end_b) - s.low).minCoeff() < -reach ||
      (s.high - end_a.cwiseMin(end_b)).minCoeff() < -reach)
    return false;
  ridge.Q = s.to_body(end_a);
  ridge.f = s.to_local.transpose() * (end_b - end_a);
  const double radius = s.shapes.radius[s.b] + reach;
  const double nearest = std::clamp(-ridge.Q.dot(ridge.f) / ridge.f.squaredNorm(), 0.0, 1.0);
  if ((ridge.Q + nearest * ridge.f).squaredNorm() > radius * radius) return false;
  near.left = triangle_plane(trn, edge.left).normal;
  near.right = triangle_plane(trn, edge.right).normal;
  near.blunt = s.vertices.size() > AboveRidge::most || near.left.dot(near.right) < blunt_cos;
  near.clear = 1.001 * s.margin + s.strained + s.skin;
  near.height = std::max(end_a.z(), end_b.z()) + s.margin + s.strained + s.skin;
  ridge.left = edge.left;
  ridge.feature = 4 * static_cast<int>(node_index(trn, row, col)) + static_cast<int>(kind);
  return true;
}

AboveRidge above_ridge(const FeatureSearch& s, const NearRidge& near) {
  AboveRidge above;
  if (near.blunt) return above;
  for (size_t v = 0; v < s.vertices.size(); ++v) {
    const Vec3 &x = s.vertices[v], &at = near.ridge.end_a;
    above.left |= std::uint64_t{is_above(near.left, at, x, near.clear)} << v;
    above.right |= std::uint64_t{is_above(near.right, at, x, near.clear)} << v;
  }
  return above;
}

void set_arc(const FeatureSearch& s, NearRidge& near) {
  near.ridge.arc =
      gauss_arc(s.to_local.transpose() * near.left, s.to_local.transpose() * near.right);
}

// Those of the edges `near` it whose arcs allow a contact with the ridge, by bits.
std::uint64_t touching_edges(const FeatureSearch& s, const GaussArc& ridge,
                             std::span<const ShapeEdge> edges, std::uint64_t near) {
  std::uint64_t touching = 0;
  for (; near != 0; near &= near - 1) {
    const int i = std::countr_zero(near);
    touching |= std::uint64_t{edges_may_touch(edges[i].arc, ridge, s.nearly_parallel, s.turn)} << i;
  }
  return touching;
}

// Of 64 edges of the block those that are near the ridge, by bits.
std::uint64_t near_edges(const FeatureSearch& s, const NearRidge& ridge, const AboveRidge& above,
                         std::span<const ShapeEdge> edges) {
  std::uint64_t near = 0;
  for (size_t i = 0; i < edges.size(); ++i) {
    const int a_high = s.height(edges[i].a) > ridge.height,
              b_high = s.height(edges[i].b) > ridge.height;
    const bool is_clear = ((a_high & b_high) | above.has(edges[i].a, edges[i].b)) != 0;
    near |= std::uint64_t{!is_clear} << i;
  }
  return near;
}

// The same of the few edges in `among`.
std::uint64_t near_edges(const FeatureSearch& s, const NearRidge& ridge,
                         std::span<const ShapeEdge> edges, std::uint64_t among) {
  std::uint64_t near = 0;
  for (; among != 0; among &= among - 1) {
    const int i = std::countr_zero(among);
    const ShapeEdge& edge = edges[i];
    const Vec3 &a = s.vertices[edge.a], &b = s.vertices[edge.b];
    const int is_high = int{a.z() > ridge.height} & int{b.z() > ridge.height};
    near |= std::uint64_t{(is_high | ridge.is_cleared_by(a, b)) == 0} << i;
  }
  return near;
}

// Edges of the block that may touch a ridge, by bits; all_edges where it has over 64.
std::uint64_t list_edges(const FeatureSearch& s, int row, int col, EdgeKind kind) {
  NearRidge near;
  if (!come_near(s, row, col, kind, near)) return 0;
  const std::span<const ShapeEdge> edges = edges_of(s.shapes, s.b);
  if (edges.size() > 64) return all_edges;
  const std::uint64_t close = near_edges(s, near, above_ridge(s, near), edges);
  if (close == 0) return 0;
  set_arc(s, near);
  return touching_edges(s, near.ridge.arc, edges, close);
}

// `among`: edges of the block that may touch the ridge, by bits, or all_edges.
void find_mode_3(FeatureSearch& s, int row, int col, EdgeKind kind, std::uint64_t among,
                 std::vector<Contact>& contacts) {
  NearRidge near;
  if (!come_near(s, row, col, kind, near)) return;
  const double deepest = s.shapes.thickness[s.b] / 2;
  const std::span<const ShapeEdge> edges = edges_of(s.shapes, s.b);
  const auto add = [&](size_t begin, std::span<const ShapeEdge> some, std::uint64_t close) {
    std::uint64_t touching = touching_edges(s, near.ridge.arc, some, close);
    for (; touching != 0; touching &= touching - 1)
      add_edge_contact(s, near.ridge, begin + static_cast<size_t>(std::countr_zero(touching)),
                       deepest, contacts);
  };
  if (among != all_edges) {
    const std::uint64_t close = near_edges(s, near, edges, among);
    if (close == 0) return;
    set_arc(s, near);
    return add(0, edges, close);
  }
  const AboveRidge above = above_ridge(s, near);
  if (above.has_all(s.vertices.size())) return;
  set_arc(s, near);
  for (size_t begin = 0; begin < edges.size(); begin += 64) {
    const std::span<const ShapeEdge> some =
        edges.subspan(begin, std::min<size_t>(64, edges.size() - begin));
    add(begin, some, near_edges(s, near, above, some));
  }
}

// Whether one of the `n` flags from `begin` on is set: eight are read at a time while there are
// eight, and those behind the n-th left out.
bool any_set(const std::vector<std::uint8_t>& flags, size_t begin, size_t n) {
  size_t k = 0;
  for (; k < n && begin + k + 8 <= flags.size(); k += 8) {
    std::uint64_t eight = 0;
    std::memcpy(&eight, flags.data() + begin + k, 8);
    if constexpr (std::endian::native == std::endian::big) eight = __builtin_bswap64(eight);
    if (n - k < 8) eight &= (std::uint64_t{1} << 8 * (n - k)) - 1;
    if (eight != 0) return true;
  }
  for (; k < n; ++k)
    if (flags[begin + k] != 0) return true;
  return false;
}

// Calls `look(row, col, flags)` for the nodes of the candidate cells that have some; nearly all
// have none.
template <class Look>
void for_each_feature(const Ground& ground, const CellRange& cells, Look&& look) {
  const Trn& trn = ground.trn;
  for (int row = cells.row_first; row <= cells.row_last + 1; ++row) {
    const size_t first = node_index(trn, row, cells.col_first);
    if (!any_set(ground.flags, first, static_cast<size_t>(cells.col_last - cells.col_first + 2)))
      continue;
    const std::uint8_t* flags = ground.flags.data() + node_index(trn, row, 0);
    for (int col = cells.col_first; col <= cells.col_last + 1; ++col)
      if (flags[col] != 0) look(row, col, flags[col]);
  }
}

constexpr std::pair<std::uint8_t, EdgeKind> convex_edges[] = {
    {trn_flag::convex_east, EdgeKind::east},
    {trn_flag::convex_south, EdgeKind::south},
    {trn_flag::convex_diagonal, EdgeKind::diagonal}};

// Modes 2 and 3 at a node with these `flags`.
void find_features_at(FeatureSearch& s, int row, int col, std::uint8_t flags, std::uint64_t among,
                      std::vector<Contact>& contacts) {
  if (flags & trn_flag::convex_vertex) find_mode_2(s, row, col, contacts);
  for (const auto& [flag, kind] : convex_edges)
    if (flags & flag) find_mode_3(s, row, col, kind, among, contacts);
}

// Modes 2 and 3 at the nodes of the candidate cells, or at those of the list among them.
void look_at_features(FeatureSearch& s, const CellRange& cells, const NearFeatures* near,
                      std::vector<Contact>& contacts) {
  if (near == nullptr) {
    for_each_feature(s.ground, cells, [&](int row, int col, std::uint8_t flags) {
      find_features_at(s, row, col, flags, all_edges, contacts);
    });
    return;
  }
  for (const NearFeatures::Feature& f : near->features)
    if (f.row >= cells.row_first && f.row <= cells.row_last + 1 && f.col >= cells.col_first &&
        f.col <= cells.col_last + 1)
      find_features_at(s, f.row, f.col, f.flag, f.edges, contacts);
}

// Bounds how far a point of the block is from where it was, and radius times the chord of its turn.
double moved(const Pose& from, const Pose& to, double radius) {
  return (to.position - from.position).norm() +
         2 * radius * (to.attitude.coeffs() - from.attitude.coeffs()).norm();
}

// Lists features that may touch the block of `s` within `near.skin` and `near.margin`.
void list_features(const FeatureSearch& s, NearFeatures& near) {
  const double radius = s.shapes.radius[s.b];
  FeatureSearch around = s;
  around.margin = near.margin;
  around.skin = near.skin;
  around.turn = near.skin / radius;
  around.nearly_parallel = parallel_within(near.margin, radius);
  near.features.clear();
  const double reach = near.margin + near.skin;
  const auto list = [&](int row, int col, std::uint8_t flag, std::uint64_t touching) {
    near.features.push_back({touching, row, col, flag});
  };
  for_each_feature(s.ground, cells_near(s.ground.trn, s.low, s.high, reach),
                   [&](int row, int col, std::uint8_t flags) {
                     if (flags & trn_flag::convex_vertex &&
                         (node_point(s.ground.trn, row, col) - s.pose.position).squaredNorm() <=
                             (radius + reach) * (radius + reach))
                       list(row, col, trn_flag::convex_vertex, all_edges);
                     for (const auto& [flag, kind] : convex_edges) {
                       if (!(flags & flag)) continue;
                       const std::uint64_t touching = list_edges(around, row, col, kind);
                       if (touching != 0) list(row, col, flag, touching);
                     }
                   });
}

// Brings the list of the block of `s` up to date; false when none pays.
bool keep_list(const FeatureSearch& s, NearFeatures& near) {
  const double radius = s.shapes.radius[s.b];
  const double last = moved(near.last, s.pose, radius);
  near.last = s.pose;
  // twice: by strains the points move, and so does the bound on that
  const double by_strain = 2 * radius * (s.stretch - near.stretch).norm();
  const double path = moved(near.listed, s.pose, radius) + by_strain;
  if (s.margin <= near.margin && path <= (1 - negligible) * near.skin) return true;
  near.skin = std::max(searches_ahead * last, least_skin * radius);
  if (near.skin > largest_skin * radius) {
    near.skin = largest_skin * radius;
    if (last * short_lived > near.skin) {
      near.skin = -1;
      return false;
    }
  }
  near.margin = std::max(near.margin, s.margin);
  near.listed = s.pose;
  near.stretch = s.stretch;
  list_features(s, near);
  return true;
}

}  // namespace

void find_features(const PlacedBlock& block, const CellRange& cells, double margin,
                   NearFeatures* near, std::vector<Contact>& contacts) {
  const double radius = block.shapes.radius[block.b];
  FeatureSearch s{block, margin, parallel_within(margin, radius),
                  (block.stretch - Mat3::Identity()).norm() * radius};
  if (near != nullptr && !keep_list(s, *near)) near = nullptr;
  look_at_features(s, cells, near, contacts);
  if (s.n_put_off == 0) return;
  s.n_sure = static_cast<int>(contacts.size());
  look_at_features(s, cells, near, contacts);
}

}  // namespace talus
