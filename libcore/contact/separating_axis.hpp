// libcore/contact/separating_axis.hpp
// The axis along which two convex parts are farthest apart, or overlap least.
// in:    two placed parts, the axis that held before
// out:   the axis, the separation along it, and how far the parts may move before another can win
// theory: docs/theory/theory.md 2.2 (entrance tests), 2.3 (choice among candidates), 2.6
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "contact/hulls.hpp"

namespace talus {

enum class AxisKind : std::uint8_t {
  none,    ///< not searched, or nothing but inner faces meet
  face_a,  ///< normal of a face of A
  face_b,  ///< normal of a face of B
  edges,   ///< normal to an edge of A and an edge of B whose Gauss arcs cross
};

/// Names an axis by its features, counted from the part's first.
struct PairAxis {
  AxisKind kind = AxisKind::none;
  int feature_a = -1;  ///< face or edge of A; -1 for face_b
  int feature_b = -1;  ///< face or edge of B; -1 for face_a
  bool operator==(const PairAxis&) const = default;
};

/// Axes closer than this count as one direction: which of them carries a contact is a matter of
/// taste.
inline constexpr double same_axis_cos = 0.9993908270190958;  // cos 2 deg

/// Outcome of find_axis.
struct AxisChoice {
  PairAxis axis;
  bool touches = false;        ///< not farther apart than the margin
  Vec3 normal = Vec3::Zero();  ///< unit, from B to A
  double separation = 0;       ///< along the axis [m]
  double other_face = 0;       ///< largest along face normals that are other directions [m]
  double hold = 0;             ///< relative motion within which the same axis stays chosen [m]
  PairAxis passed_over;        ///< the axis of the largest separation, where a face was preferred
  double largest = 0;          ///< along it [m]
  PairAxis near_edges;         ///< edges that meet nearly where the chosen face does, if any
  PairAxis near_face;          ///< face in nearly the direction of the chosen edges, if any
};

/// The axis along a face of one of the parts.
struct FaceAxis {
  int part = -1, face = -1;  ///< the face counts from the part's first
  double separation = -std::numeric_limits<double>::infinity();  ///< [m]
};

/// Arrays that find_axis fills anew; kept to spare allocation.
struct AxisScratch {
  std::vector<double> face_a, face_b;  ///< separation along the faces of A, of B [m]
  std::vector<double> dots_a, dots_b;  ///< edge directions times the other part's normals
  std::vector<int> edges_a, edges_b;   ///< edges of A, of B, that may touch or separate
  std::vector<double> heights;         ///< of two points of the other body over the faces [m]
  std::vector<FaceAxis> doubtful;      ///< of faces that other parts of their bodies cover
  std::vector<int> crossing;           ///< of edges_b, those whose arcs cross that of an edge of A
};

/// Separation of `vertex_part` from each face of `face_part` (negative: overlap) into
/// separation[0, n_faces); `separation` grows to a multiple of 4.
void face_separations(const Hulls& hulls, const PlacedHulls& placed, int face_part, int vertex_part,
                      std::vector<double>& separation);

/// The largest separation of the parts, over their face normals and over the pairs of active edges
/// whose Gauss arcs cross, which are all faces of the entrance block (theory 2.1).
///
/// A face that separates by more than `margin` [m] ends the search. Otherwise the axis chosen is
/// that of the largest separation, except: `last` stays until another face is better by a tenth, a
/// face is preferred to a pair of edges that is better by less than a thousandth of the thickness,
/// and a face of A to one of B in the same direction. Of bodies of several parts, an axis that
/// leads out of one part into another is not chosen, and a pair that the pushes of less deep ones
/// free does not touch.
[[nodiscard]] AxisChoice find_axis(const Hulls& hulls, const PlacedHulls& placed, int part_a,
                                   int part_b, double margin, const PairAxis& last,
                                   AxisScratch& scratch);

/// Separation along a unit normal from B to A, over all vertices: a bound of the parts' distance
/// from below [m].
[[nodiscard]] double apart_along(const Hulls& hulls, const PlacedHulls& placed, int part_a,
                                 int part_b, const Vec3& normal);

/// Normal from B to A of a named axis at the present poses.
[[nodiscard]] Vec3 axis_normal(const Hulls& hulls, const PlacedHulls& placed, int part_a,
                               int part_b, const PairAxis& axis);

/// The face of `part` that meets a face with outward unit normal `normal`: of those around the
/// part's farthest vertex against `normal`, the one most opposed to it. Counted from the part's
/// first.
[[nodiscard]] int incident_face(const Hulls& hulls, const PlacedHulls& placed, int part,
                                const Vec3& normal);

}  // namespace talus
