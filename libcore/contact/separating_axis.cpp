// Finds the axis along which two convex parts are farthest apart, or overlap least.
#include "contact/separating_axis.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "contact/entrance.hpp"
#include "contact/lanes.hpp"
#include "contact/pair_axes.hpp"
#include "contact/scales.hpp"

namespace talus {
namespace {

using Parts = PartPair;

constexpr double none = -infinity;
// For bodies of several parts: points nearer than this part of the thickness may be the same place
// on both sides of a seam; an overlap below this part of its depth counts as free.
constexpr double seam_ratio = 5e-3;
constexpr double longest_hold = 0.05;  // [m], of an axis

// direction . normal for all normals of `part` into its row, padded.
void normal_dots(const Parts& parts, int part, const Vec3& direction, double* row) {
  const PlacedHulls& placed = parts.placed;
  const int begin = parts.hulls.face_begin[part], end = parts.hulls.face_begin[part + 1];
  for (int f = begin; f < end; f += n_lanes)
    lanes(row + f - begin) = direction.x() * lanes(&placed.nx[f]) +
                             direction.y() * lanes(&placed.ny[f]) +
                             direction.z() * lanes(&placed.nz[f]);
}

struct BestEdges {
  double separation = none;
  double second = none;
  double elsewhere = none;  // of those in other directions than the best face
  int a = -1, b = -1;
  Vec3 normal = Vec3::Zero();
  bool nearly_parallel = false;  // within a degree
};

/// The face along which two parts are farthest apart, and by how much edges that are parallel
/// within a degree have to be better, over the sine of the angle at which they cross.
struct BesideFace {
  Vec3 normal = Vec3::Zero();  // from B to A
  double separation = none;
  double bar_per_sine = infinity;
};

// Whether edges that are parallel within a degree are an axis of their own. Along a face their
// parts are farther in than along the edges by d sin(angle), d the distance from their crossing to
// the end of one edge. The smaller that is, the less it differs from an edge that rests on a face
// all along: the bar above the face is as much lower as their angle is less than a degree.
bool cross_beside(const BesideFace& face, const Vec3& normal, double separation, double sine_sq) {
  return normal.dot(face.normal) < no_face_cos &&
         separation > face.separation + face.bar_per_sine * std::sqrt(sine_sq);
}

// Two edges whose arcs cross; `points_to_a`: their cross product does.
void consider_edges(const Parts& parts, int e_a, int e_b, const Vec3& along_a, bool points_to_a,
                    const BesideFace& face, BestEdges& best) {
  const Hulls& hulls = parts.hulls;
  const HullEdge& edge_a = hulls.edges[hulls.edge_begin[parts.a] + e_a];
  const HullEdge& edge_b = hulls.edges[hulls.edge_begin[parts.b] + e_b];
  const Vec3 along_b = edge_direction(parts, parts.b, edge_b);
  Vec3 cross = along_a.cross(along_b);
  if (are_parallel(along_a, along_b, cross, no_crossing_sin_sq)) return;
  const bool nearly_parallel = are_parallel(along_a, along_b, cross);
  if (!points_to_a) cross = -cross;
  const double length_sq = cross.squaredNorm();
  const double along = cross.dot(parts.placed.vertices[slot(hulls, parts.a, edge_a.a)] -
                                 parts.placed.vertices[slot(hulls, parts.b, edge_b.a)]);
  const double least = std::min(best.second, best.elsewhere);  // few get past this
  if (along < 0 && least < 0 && along * along > least * least * length_sq) return;
  const double scale = 1 / std::sqrt(length_sq), separation = scale * along;
  const Vec3 normal = scale * cross;
  if (nearly_parallel && !cross_beside(face, normal, separation,
                                       length_sq / (along_a.squaredNorm() * along_b.squaredNorm())))
    return;
  if (separation > best.elsewhere && normal.dot(face.normal) < same_axis_cos)
    best.elsewhere = separation;
  if (separation <= best.separation) {
    best.second = std::max(best.second, separation);
    return;
  }
  best = {separation, best.separation, best.elsewhere, e_a, e_b, normal, nearly_parallel};
}

// The vertex of the other part that is nearest to the face of `part` along which they are farthest
// apart.
const Vec3& nearest_vertex(const Parts& parts, int part, const AxisScratch& scratch) {
  const Hulls& hulls = parts.hulls;
  const std::vector<double>& separation = part == parts.a ? scratch.face_a : scratch.face_b;
  const auto first = separation.begin();
  const auto face = std::max_element(first, first + hulls.n_faces[part]) - first;
  const Vec3 normal = normal_at(parts.placed, hulls.face_begin[part] + static_cast<int>(face));
  const int other = part == parts.a ? parts.b : parts.a;
  int nearest = hulls.vertex_begin[other];
  double lowest = infinity;
  for (int v = nearest; v < hulls.vertex_begin[other + 1]; ++v) {
    const double height = normal.dot(parts.placed.vertices[v]);
    nearest = height < lowest ? v : nearest;
    lowest = std::min(lowest, height);
  }
  return parts.placed.vertices[nearest];
}

// The edges of `part` at which the parts may be farther apart than `least`, in `found`: active
// ones, with `inner` also those at which the part alone ends but its body does not.
//
// The separation along a normal of an edge's arc is at most the height that any point of the other
// part has over the plane through the edge. Where that point is behind the planes of both faces,
// its height over that one is at most its height over the higher of them. The centroid of the other
// body tells so of the edges on the far side, its vertex that is nearest to the part's best face of
// most remaining ones: it lies behind all faces beside that one. `least` <= 0, and any edge where
// it is not finite.
int near_edges(const Parts& parts, int part, bool inner, double least, AxisScratch& scratch,
               std::vector<int>& found) {
  const Hulls& hulls = parts.hulls;
  const PlacedHulls& placed = parts.placed;
  const HullEdge* edges = hulls.edges.data() + hulls.edge_begin[part];
  const int n =
      inner ? hulls.edge_begin[part + 1] - hulls.edge_begin[part] : hulls.n_active_edges[part];
  const int begin = hulls.face_begin[part], n_normals = hulls.face_begin[part + 1] - begin;
  if (found.size() < static_cast<std::size_t>(n)) found.resize(n);
  if (scratch.heights.size() < 2 * static_cast<std::size_t>(n_normals))
    scratch.heights.resize(2 * n_normals);
  double* const of_centroid = scratch.heights.data();
  double* const of_vertex = of_centroid + n_normals;
  const int other = part == parts.a ? parts.b : parts.a;
  normal_dots(parts, part, placed.position[hulls.body[other]], of_centroid);
  normal_dots(parts, part, nearest_vertex(parts, part, scratch), of_vertex);
  for (int f = 0; f < n_normals; f += n_lanes) {
    const Lanes offset = lanes(&placed.offset[begin + f]);
    lanes(of_centroid + f) = lanes(of_centroid + f) - offset;
    lanes(of_vertex + f) = lanes(of_vertex + f) - offset;
  }
  int kept = 0;  // without branches: their outcome would be a guess
  for (int e = 0; e < n; ++e) {
    const int left = edges[e].left, right = edges[e].right;
    found[kept] = e;
    kept += std::min(std::max(of_centroid[left], of_centroid[right]),
                     std::max(of_vertex[left], of_vertex[right])) >= least;
  }
  return kept;
}

// Pairs of edges whose Gauss arcs cross (theory 2.2), of those along which the parts may be farther
// apart than `least`; see near_edges() for `inner`. Along an edge, left x right of its arc points
// as the edge does, so the arcs' cross products are the edges' directions, and the test needs only
// the products of edge directions with the other part's normals.
BestEdges find_edges(const Parts& parts, const BesideFace& face, bool inner, double least,
                     AxisScratch& scratch) {
  const Hulls& hulls = parts.hulls;
  const std::size_t width_a = hulls.face_begin[parts.a + 1] - hulls.face_begin[parts.a];
  const std::size_t width_b = hulls.face_begin[parts.b + 1] - hulls.face_begin[parts.b];
  const HullEdge* edges_a = hulls.edges.data() + hulls.edge_begin[parts.a];
  const HullEdge* edges_b = hulls.edges.data() + hulls.edge_begin[parts.b];
  const int n_a = near_edges(parts, parts.a, inner, least, scratch, scratch.edges_a);
  const int n_b = near_edges(parts, parts.b, inner, least, scratch, scratch.edges_b);
  const int* const near_b = scratch.edges_b.data();
  if (scratch.dots_a.size() < width_b) scratch.dots_a.resize(width_b);
  if (scratch.dots_b.size() < n_b * width_a) scratch.dots_b.resize(n_b * width_a);
  const auto most = static_cast<std::size_t>(n_b);
  if (scratch.crossing.size() < most) scratch.crossing.resize(most);
  double* const row = scratch.dots_a.data();
  int* const crossing = scratch.crossing.data();
  for (int k = 0; k < n_b; ++k)
    normal_dots(parts, parts.a, edge_direction(parts, parts.b, edges_b[near_b[k]]),
                scratch.dots_b.data() + k * width_a);

  BestEdges best;
  for (int i = 0; i < n_a; ++i) {
    const int e_a = scratch.edges_a[i];
    const Vec3 along_a = edge_direction(parts, parts.a, edges_a[e_a]);
    normal_dots(parts, parts.b, along_a, row);
    int n = 0, n_both = 0;  // without branches, as above
    for (int k = 0; k < n_b; ++k) {
      const HullEdge& edge_b = edges_b[near_b[k]];
      crossing[n] = k;
      n += row[edge_b.arc_left] * row[edge_b.arc_right] < 0;
    }
    const int arc_left = edges_a[e_a].arc_left, arc_right = edges_a[e_a].arc_right;
    for (int m = 0; m < n; ++m) {
      const int k = crossing[m];
      const double* column = scratch.dots_b.data() + k * width_a;
      const double right = column[arc_right];
      crossing[n_both] = k;
      n_both += (column[arc_left] * right < 0) & (row[edges_b[near_b[k]].arc_left] * right < 0);
    }
    for (int m = 0; m < n_both; ++m) {  // along_b is left x right of its arc
      const int e_b = near_b[crossing[m]];
      consider_edges(parts, e_a, e_b, along_a, row[edges_b[e_b].arc_right] > 0, face, best);
    }
  }
  return best;
}

Vec3 outward(const Parts& parts, const FaceAxis& axis) {
  return normal_at(parts.placed, parts.hulls.face_begin[axis.part] + axis.face);
}
Vec3 to_a(const Parts& parts, const FaceAxis& axis) {
  const Vec3 normal = outward(parts, axis);
  return axis.part == parts.b ? normal : Vec3(-normal);
}

template <class Visit>
void for_each_face(const Parts& parts, const AxisScratch& scratch, Visit&& visit) {
  for (int f = 0; f < parts.hulls.n_faces[parts.a]; ++f)
    visit(FaceAxis{parts.a, f, scratch.face_a[f]});
  for (int f = 0; f < parts.hulls.n_faces[parts.b]; ++f)
    visit(FaceAxis{parts.b, f, scratch.face_b[f]});
}

bool has_pieces(const Hulls& hulls, int part) {
  const int body = hulls.body[part];
  return hulls.part_begin[body + 1] - hulls.part_begin[body] > 1;
}

// --- bodies of several parts ---

// How far two parts are apart once A has moved; at least `enough` is as good as more.
double apart_after(const Parts& parts, const Vec3& moved, double enough) {
  double apart = none;
  const auto consider = [&](const Vec3& normal, double separation) {
    apart = std::max(apart, separation + normal.dot(moved));
  };
  for_each_face_normal(parts, [&](const Vec3& normal, double separation, FaceCover) {
    consider(normal, separation);
  });
  if (apart < enough) for_each_crossing(parts, false, consider);
  return apart;
}

// Do two parts overlap by more than `depth` along all axes in other directions than `normal`, once
// A has moved?
bool overlap_beside(const Parts& parts, const Vec3& moved, const Vec3& normal, double depth) {
  bool overlap = true;
  const auto consider = [&](const Vec3& other, double separation) {
    if (other.dot(normal) < same_axis_cos) overlap &= separation + other.dot(moved) < -depth;
  };
  for_each_face_normal(
      parts, [&](const Vec3& other, double separation, FaceCover) { consider(other, separation); });
  if (overlap) for_each_crossing(parts, false, consider);
  return overlap;
}

// An axis from B to A along which two parts are apart, or overlap.
struct Axis {
  Vec3 normal = Vec3::Zero();
  double separation = none;
};

// The least overlap along the uncovered faces of two parts.
Axis bare_axis(const Parts& parts) {
  Axis best;
  const auto consider = [&best](const Vec3& normal, double separation) {
    if (separation > best.separation) best = {normal, separation};
  };
  for_each_face_normal(parts, [&](const Vec3& normal, double separation, FaceCover cover) {
    if (cover != FaceCover::all) consider(normal, separation);
  });
  for_each_crossing(parts, true, consider);
  return best;
}

// The other pairs of parts of the same two bodies.
template <class Visit>
void for_each_other_pair(const Parts& parts, Visit&& visit) {
  const Hulls& hulls = parts.hulls;
  const int body_a = hulls.body[parts.a], body_b = hulls.body[parts.b];
  for (int a = hulls.part_begin[body_a]; a < hulls.part_begin[body_a + 1]; ++a)
    for (int b = hulls.part_begin[body_b]; b < hulls.part_begin[body_b + 1]; ++b)
      if (a != parts.a || b != parts.b) visit(Parts{hulls, parts.placed, a, b});
}

// Extends the displacement of A by the rest of an overlap.
void move_out(const Axis& axis, Vec3& moved) {
  if (axis.separation >= 0) return;
  moved += std::max(0.0, -axis.separation - axis.normal.dot(moved)) * axis.normal;
}

// Whether the parts' bodies touch along an axis of the parts: where A is moved along it until the
// parts touch, it is in no other part, or is in none once that has pushed A out and these parts
// still lie against each other.
bool leads_out(const Parts& parts, const Axis& axis, double seam) {
  Vec3 others_out = Vec3::Zero();
  bool is_free = true;
  const Vec3 until_touch = -axis.separation * axis.normal;
  for_each_other_pair(parts, [&](const Parts& other) {
    if (apart_after(other, until_touch, seam) >= seam) return;
    is_free = false;
    move_out(bare_axis(other), others_out);
  });
  if (is_free) return true;
  const Vec3 moved = others_out - (axis.separation + axis.normal.dot(others_out)) * axis.normal;
  if (!overlap_beside(parts, moved, axis.normal, seam)) return false;
  is_free = true;
  for_each_other_pair(parts, [&](const Parts& other) {
    is_free &= apart_after(other, moved, 0) >= -feature_slack * seam;
  });
  return is_free;
}

// Whether the contacts of other parts of the bodies, each less deep than these parts along their
// own axis and in another direction, free these parts too. So the least deep of all is never left
// out.
bool others_free(const Parts& parts, const Axis& own) {
  Vec3 moved = Vec3::Zero();
  for_each_other_pair(parts, [&](const Parts& other) {
    const Axis axis = bare_axis(other);
    if (axis.separation > own.separation && axis.normal.dot(own.normal) < same_axis_cos &&
        apart_after(other, Vec3::Zero(), 0) < 0)
      move_out(axis, moved);
  });
  return !moved.isZero(0) && apart_after(parts, moved, 0) >= hardly_better * own.separation;
}

// Axes of faces that other parts cover where they would meet.
struct Covered {
  double passed_over = none;  // the best that leads into another part
  double below = none;        // the best of those that the bare ones are better than
  bool is_chosen = false;     // one of them is the best axis, or was nearly
};

double& separation_of(const Parts& parts, const FaceAxis& axis, AxisScratch& scratch) {
  return (axis.part == parts.a ? scratch.face_a : scratch.face_b)[axis.face];
}

FaceCover cover_of(const Parts& parts, const FaceAxis& axis) {
  const int other = axis.part == parts.a ? parts.b : parts.a;
  const int met = incident_face(parts.hulls, parts.placed, other, outward(parts, axis));
  const auto cover = [&](int part, int face) {
    return parts.hulls.cover[parts.hulls.face_begin[part] + face];
  };
  return std::max(cover(axis.part, axis.face), cover(other, met));
}

// Takes out the axes of covered faces, but those that are better than all bare ones, down to the
// first that leads out of the bodies. `open`: separation along edges.
Covered remove_covered(const Parts& parts, double open, double seam, AxisScratch& scratch) {
  Covered covered;
  std::vector<FaceAxis>& doubtful = scratch.doubtful;
  doubtful.clear();
  for_each_face(parts, scratch, [&](const FaceAxis& axis) {
    const FaceCover cover = cover_of(parts, axis);
    if (cover == FaceCover::none) {
      open = std::max(open, axis.separation);
      return;
    }
    doubtful.push_back(axis);
    if (cover == FaceCover::all) separation_of(parts, axis, scratch) = none;
  });
  std::stable_sort(doubtful.begin(), doubtful.end(), [](const FaceAxis& p, const FaceAxis& q) {
    return p.separation > q.separation;
  });
  for (const FaceAxis& axis : doubtful) {
    if (axis.separation <= open) {
      covered.below = axis.separation;
      break;
    }
    covered.is_chosen = leads_out(parts, {to_a(parts, axis), axis.separation}, seam);
    separation_of(parts, axis, scratch) = covered.is_chosen ? axis.separation : none;
    if (covered.is_chosen) break;
    covered.passed_over = std::max(covered.passed_over, axis.separation);
  }
  return covered;
}

FaceAxis best_face(const Parts& parts, const AxisScratch& scratch) {
  FaceAxis best;
  for_each_face(parts, scratch, [&](const FaceAxis& axis) {
    if (axis.separation > best.separation) best = axis;
  });
  return best;
}

// Largest separation along face normals in other directions than `normal`.
double best_other_face(const Parts& parts, const AxisScratch& scratch, const Vec3& normal) {
  double best = none;
  for_each_face(parts, scratch, [&](const FaceAxis& axis) {
    if (axis.separation > best && to_a(parts, axis).dot(normal) < same_axis_cos)
      best = axis.separation;
  });
  return best;
}

double keep_bonus(const FaceAxis& last, double thickness) {
  return std::max(hardly_better * std::abs(last.separation), feature_slack * thickness);
}

// Edges with a separation below this change nothing: they are neither chosen nor noted beside the
// best face, of separation `face`, nor do they shorten a hold of `longest`.
double least_edges(double face, double thickness, double longest) {
  constexpr double ample = 2;  // depth of a chosen face below the best one, and of edges below that
  const double bonus = std::max(hardly_better * std::abs(face), axis_slack * thickness);
  return std::min(0.0, face - 2 * longest - 2 * ample * bonus);
}

FaceAxis last_face(const Parts& parts, const AxisScratch& scratch, const PairAxis& last) {
  if (last.kind == AxisKind::face_a)
    return {parts.a, last.feature_a, scratch.face_a[last.feature_a]};
  if (last.kind == AxisKind::face_b)
    return {parts.b, last.feature_b, scratch.face_b[last.feature_b]};
  return {};
}

// The face to use when `best` has the largest separation: the last one while it is nearly as good;
// else one of A in the same direction as a best one of B, so that rounding does not choose.
FaceAxis settled_face(const Parts& parts, const AxisScratch& scratch, const FaceAxis& best,
                      const FaceAxis& last, double thickness) {
  if (last.separation > none) {
    const bool same = to_a(parts, last).dot(to_a(parts, best)) >= same_axis_cos;
    const double bonus = same ? axis_slack * thickness : keep_bonus(last, thickness);
    if (last.separation + bonus >= best.separation) return last;
  }
  if (best.part == parts.a) return best;
  FaceAxis chosen = best;
  double least = best.separation - feature_slack * thickness;
  const Vec3 normal = to_a(parts, best);
  for (int f = 0; f < parts.hulls.n_faces[parts.a]; ++f) {
    const FaceAxis axis{parts.a, f, scratch.face_a[f]};
    if (axis.separation < least || to_a(parts, axis).dot(normal) < same_axis_cos) continue;
    chosen = axis;
    least = axis.separation;
  }
  return chosen;
}

PairAxis name_of(const Parts& parts, const FaceAxis& face) {
  if (face.part == parts.a) return {AxisKind::face_a, face.face, -1};
  return {AxisKind::face_b, -1, face.face};
}

AxisChoice apart_choice(const Parts& parts, const FaceAxis& face) {
  AxisChoice choice;
  choice.axis = name_of(parts, face);
  choice.separation = face.separation;
  return choice;
}

AxisChoice apart_choice(const BestEdges& edges) {
  AxisChoice choice;
  choice.axis = {AxisKind::edges, edges.a, edges.b};
  choice.separation = edges.separation;
  return choice;
}

AxisChoice face_choice(const Parts& parts, const AxisScratch& scratch, const FaceAxis& face,
                       const FaceAxis& best, double edge_bar, const BestEdges& edges,
                       double thickness) {
  AxisChoice choice;
  choice.axis = name_of(parts, face);
  choice.normal = to_a(parts, face);
  choice.separation = face.separation;
  choice.other_face = best_other_face(parts, scratch, choice.normal);
  choice.hold = std::min(face.separation + keep_bonus(face, thickness) - choice.other_face,
                         best.separation + edge_bar - edges.elsewhere) /
                2;
  choice.largest = std::max(best.separation, edges.separation);
  if (choice.largest > choice.separation)
    choice.passed_over = edges.separation > best.separation
                             ? PairAxis{AxisKind::edges, edges.a, edges.b}
                             : name_of(parts, best);
  if (edges.normal.dot(choice.normal) >= same_axis_cos &&
      edges.separation >= face.separation - keep_bonus(face, thickness))
    choice.near_edges = {AxisKind::edges, edges.a, edges.b};
  return choice;
}

AxisChoice edge_choice(const Parts& parts, const AxisScratch& scratch, const BestEdges& edges,
                       const FaceAxis& best, double edge_bar, double near) {
  AxisChoice choice;
  choice.axis = {AxisKind::edges, edges.a, edges.b};
  choice.normal = edges.normal;
  choice.separation = edges.separation;
  choice.other_face = best_other_face(parts, scratch, edges.normal);
  choice.hold = (edges.separation - std::max(best.separation + edge_bar, edges.second)) / 2;
  if (best.separation >= edges.separation - near &&
      to_a(parts, best).dot(edges.normal) >= same_axis_cos)
    choice.near_face = name_of(parts, best);
  return choice;
}

}  // namespace

void face_separations(const Hulls& hulls, const PlacedHulls& placed, int face_part, int vertex_part,
                      std::vector<double>& separation) {
  const int begin = hulls.face_begin[face_part], n = hulls.n_faces[face_part];
  const int first = hulls.vertex_begin[vertex_part];
  const int last = hulls.vertex_begin[vertex_part + 1];
  const std::size_t padded = (static_cast<std::size_t>(n) + 3) / 4 * 4;
  if (separation.size() < padded) separation.resize(padded);
  for (int f = 0; f < n; f += 2 * n_lanes) {  // two at a time hide each other's latency
    const double *x = &placed.nx[begin + f], *y = &placed.ny[begin + f], *z = &placed.nz[begin + f];
    const Lanes x0 = lanes(x), y0 = lanes(y), z0 = lanes(z);
    const Lanes x1 = lanes(x + n_lanes), y1 = lanes(y + n_lanes), z1 = lanes(z + n_lanes);
    Lanes lowest0 = Lanes{} + infinity, lowest1 = lowest0;
    for (int v = first; v < last; ++v) {
      const Vec3& p = placed.vertices[v];
      const Lanes height0 = x0 * p.x() + y0 * p.y() + z0 * p.z();
      const Lanes height1 = x1 * p.x() + y1 * p.y() + z1 * p.z();
      lowest0 = height0 < lowest0 ? height0 : lowest0;
      lowest1 = height1 < lowest1 ? height1 : lowest1;
    }
    lanes(&separation[f]) = lowest0 - lanes(&placed.offset[begin + f]);
    lanes(&separation[f + n_lanes]) = lowest1 - lanes(&placed.offset[begin + f + n_lanes]);
  }
}

int incident_face(const Hulls& hulls, const PlacedHulls& placed, int part, const Vec3& normal) {
  const int support = farthest_vertex(hulls, placed, part, normal);
  int face = -1;
  double most_opposed = infinity;
  for (int k = hulls.ring_begin[support]; k < hulls.ring_begin[support + 1]; ++k) {
    const double cosine =
        normal.dot(normal_at(placed, hulls.face_begin[part] + hulls.ring_faces[k]));
    if (cosine < most_opposed) {
      most_opposed = cosine;
      face = hulls.ring_faces[k];
    }
  }
  return face;
}

AxisChoice find_axis(const Hulls& hulls, const PlacedHulls& placed, int part_a, int part_b,
                     double margin, const PairAxis& last, AxisScratch& scratch) {
  const Parts parts{hulls, placed, part_a, part_b};
  face_separations(hulls, placed, part_a, part_b, scratch.face_a);
  face_separations(hulls, placed, part_b, part_a, scratch.face_b);
  const FaceAxis farthest = best_face(parts, scratch);
  AxisChoice apart = apart_choice(parts, farthest);
  if (apart.separation > margin) return apart;
  const double thickness = std::min(hulls.thickness[part_a], hulls.thickness[part_b]);
  const double radius =
      std::min(hulls.radius[hulls.body[part_a]], hulls.radius[hulls.body[part_b]]);
  const double longest = std::min(longest_hold, axis_slack * radius);
  const bool pieces = has_pieces(hulls, part_a) || has_pieces(hulls, part_b);
  const double least = pieces ? none : least_edges(farthest.separation, thickness, longest);
  // bar of edges above the best face: half as much when an edge pair was chosen last
  const double edge_bar = feature_slack * thickness * (last.kind == AxisKind::edges ? 0.5 : 1);
  const BesideFace face{to_a(parts, farthest), farthest.separation,
                        edge_bar / std::sqrt(parallel_sin_sq)};
  BestEdges edges = find_edges(parts, face, false, least, scratch);
  if (edges.separation > margin && edges.separation > apart.separation) return apart_choice(edges);

  const double seam = std::max(seam_ratio * thickness, margin);
  Covered covered;
  if (pieces) covered = remove_covered(parts, edges.separation, seam, scratch);
  const FaceAxis best = best_face(parts, scratch);
  if (pieces) {
    const BestEdges inner = find_edges(parts, face, true, none, scratch);
    if (inner.separation > margin) return apart_choice(inner);
    if (inner.separation > std::max(best.separation, edges.separation)) {
      covered.is_chosen = leads_out(parts, {inner.normal, inner.separation}, seam);
      if (covered.is_chosen)
        edges = inner;
      else
        covered.passed_over = std::max(covered.passed_over, inner.separation);
    }
  }
  if (covered.passed_over > none) {
    const Axis open = edges.separation > best.separation ? Axis{edges.normal, edges.separation}
                                                         : Axis{to_a(parts, best), best.separation};
    if (covered.passed_over >= 0 || open.separation == none || others_free(parts, open)) {
      apart.axis = {};
      return apart;
    }
    covered.is_chosen = true;
  }
  const double bar = edges.nearly_parallel ? 0 : edge_bar;  // nearly parallel edges have passed
                                                            // their bar already
  AxisChoice choice;
  if (edges.separation > best.separation + bar) {
    const double near = axis_slack * thickness * (last.kind == AxisKind::edges ? 0.5 : 1);
    choice = edge_choice(parts, scratch, edges, best, bar, near);
  } else if (best.separation > none) {
    const FaceAxis settled =
        settled_face(parts, scratch, best, last_face(parts, scratch, last), thickness);
    choice = face_choice(parts, scratch, settled, best, edge_bar, edges, thickness);
  } else {
    apart.axis = {};
    return apart;
  }
  choice.touches = true;
  const double to_covered =
      covered.is_chosen ? 0 : (std::max(best.separation, edges.separation) - covered.below) / 2;
  choice.hold = std::clamp(std::min(choice.hold, to_covered), 0.0, longest);
  return choice;
}

double apart_along(const Hulls& hulls, const PlacedHulls& placed, int part_a, int part_b,
                   const Vec3& normal) {
  double lowest_a = infinity, highest_b = -infinity;
  for (int v = hulls.vertex_begin[part_a]; v < hulls.vertex_begin[part_a + 1]; ++v)
    lowest_a = std::min(lowest_a, normal.dot(placed.vertices[v]));
  for (int v = hulls.vertex_begin[part_b]; v < hulls.vertex_begin[part_b + 1]; ++v)
    highest_b = std::max(highest_b, normal.dot(placed.vertices[v]));
  return lowest_a - highest_b;
}

Vec3 axis_normal(const Hulls& hulls, const PlacedHulls& placed, int part_a, int part_b,
                 const PairAxis& axis) {
  if (axis.kind == AxisKind::face_a)
    return -normal_at(placed, hulls.face_begin[part_a] + axis.feature_a);
  if (axis.kind == AxisKind::face_b)
    return normal_at(placed, hulls.face_begin[part_b] + axis.feature_b);
  const Parts parts{hulls, placed, part_a, part_b};
  const HullEdge& edge_a = hulls.edges[hulls.edge_begin[part_a] + axis.feature_a];
  const HullEdge& edge_b = hulls.edges[hulls.edge_begin[part_b] + axis.feature_b];
  const Vec3 along_a = edge_direction(parts, part_a, edge_a),
             along_b = edge_direction(parts, part_b, edge_b), cross = along_a.cross(along_b);
  if (are_parallel(along_a, along_b, cross, no_crossing_sin_sq)) return Vec3::Zero();
  const int first = hulls.face_begin[part_b];
  const Vec3 outward =
      normal_at(placed, first + edge_b.arc_left) + normal_at(placed, first + edge_b.arc_right);
  return (cross.dot(outward) > 0 ? 1 : -1) / cross.norm() * cross;
}

}  // namespace talus
