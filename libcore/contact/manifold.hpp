// libcore/contact/manifold.hpp: public
// The contact points of two convex parts along a given axis.
// in:    two placed parts and the axis that find_axis chose
// out:   which features meet; then one normal and a point, a gap and a share of the area for each
// theory: docs/theory/theory.md 1.6 (one form for all modes), 2.6 (clipping)
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "contact/contact.hpp"
#include "contact/face_clip.hpp"
#include "contact/hulls.hpp"
#include "contact/separating_axis.hpp"

namespace talus {

/// A contact point of a manifold.
///
/// The key names it by features of the bodies, so it survives a change of the reference face:
/// vertex_face: vertex of A, part of B; face_vertex: part of A, vertex of B; edge_edge: both edges.
/// Each counts from the first of its body.
struct PairPoint {
  ContactKey key;
  Vec3 point_b;     ///< on B, local axes [m]; the point of A is point_b + gap * normal
  double gap = 0;   ///< along the manifold's normal, > 0 open [m]
  double area = 0;  ///< share of the contact area; the shares keep the area's centre [m2]
};

/// The contact of a part of block A with a part of block B, block_a < block_b.
struct PairManifold {
  int block_a = 0, block_b = 0;
  int part_a = 0, part_b = 0;
  int joint_set_a = 0, joint_set_b = 0;  ///< of the faces in contact; of an edge, its left face
  int point_begin = 0, point_end = 0;    ///< its points; none: see PairWork
  double area = 0;                       ///< of the faces' overlap seen along the normal [m2]
  Vec3 normal;                           ///< unit, local axes, from B to A
};

[[nodiscard]] inline bool has_points(const PairManifold& m) { return m.point_end > m.point_begin; }

/// The features of a contact without their places: they stay while the parts hardly move.
struct HeldPoint {
  ContactKey key;
  double area = 0;  ///< [m2]
};

/// incident_face of the face that names a face axis; -1 for edges.
[[nodiscard]] int incident_of(const Hulls& hulls, const PlacedHulls& placed, int part_a, int part_b,
                              const PairAxis& axis);

/// Which features of two parts meet along `axis`; appends to `held`.
///
/// A face axis clips the incident face by the sides of the reference face: its corners inside are
/// vertex-face contacts, corners of the reference face inside are face-vertex contacts, crossings
/// of sides edge-edge contacts. Other vertices of the incident part that are in behind the
/// reference face are vertex-face contacts too, without a share of the area. An axis of two edges
/// gives those edges. Returns the area of the polygon [m2]; without `with_areas` areas are zero.
/// `incident` (counted from the part's first) is for face axes only.
double find_features(const Hulls& hulls, const PlacedHulls& placed, int part_a, int part_b,
                     const PairAxis& axis, int incident, bool with_areas, ClipScratch& scratch,
                     std::vector<HeldPoint>& held);

/// Appends the contact of `near_edges` (see AxisChoice) to the features held[begin, end) of an
/// axis, unless it is among them, or the edges do not cross seen along `normal`.
void add_near_edges(const Hulls& hulls, const PlacedHulls& placed, int part_a, int part_b,
                    const PairAxis& near_edges, const Vec3& normal, std::size_t begin,
                    std::vector<HeldPoint>& held);

/// The same for those of the features `before` that are edges of the two parts at right angles to
/// `normal` within 2 degrees: blocks that rock on two edges keep both.
void keep_edges(const Hulls& hulls, const PlacedHulls& placed, int part_a, int part_b,
                std::span<const HeldPoint> before, const Vec3& normal, std::size_t begin,
                std::vector<HeldPoint>& held);

/// Smallest gap over the features `held` of a face axis [m]; infinity without any.
[[nodiscard]] double deepest_gap(const Hulls& hulls, const PlacedHulls& placed, int part_a,
                                 int part_b, const PairAxis& axis, int incident,
                                 std::span<const HeldPoint> held);

/// Result of search_contact.
struct ContactSearch {
  AxisChoice choice;
  int incident = -1;  ///< incident_face of a face axis
  double area = 0;    ///< of the clipped polygon [m2]
};

/// find_axis, then find_features, which are appended to `held`. Edges with a face in nearly their
/// direction are used as that face and its near edges. Where a face is preferred to the axis of the
/// largest separation, but no point above that face is as deep, the axis is used after all, for one
/// step: of two faces of a block that are nearly one plane, the other block may press on the one
/// that it did not press on before.
[[nodiscard]] ContactSearch search_contact(const Hulls& hulls, const PlacedHulls& placed,
                                           int part_a, int part_b, double margin,
                                           const PairAxis& last, bool with_areas,
                                           AxisScratch& axis_scratch, ClipScratch& clip_scratch,
                                           std::vector<HeldPoint>& held);

/// Which points of a manifold are wanted: those whose gap is at most `margin`, and of these, those
/// that are at most `closing` apart now or at the end of the step, as the bodies move now. A gap
/// opens by opens_at_origin + opens_along . x in the step, x the place of its point.
struct PointReach {
  double margin = 0;                                         ///< [m]
  double closing = std::numeric_limits<double>::infinity();  ///< [m]
  double opens_at_origin = 0;                                ///< [m]
  Vec3 opens_along = Vec3::Zero();
  [[nodiscard]] bool takes(double gap, double x, double y, double z) const {
    if (!(gap <= margin)) return false;
    if (gap <= closing) return true;
    return gap + opens_at_origin + opens_along.x() * x + opens_along.y() * y +
               opens_along.z() * z <=
           closing;
  }
};

/// Appends the manifold of two parts along `axis` and those of its points `held` that `reach`
/// takes, if any, at the places where they are now.
void add_manifold(const Hulls& hulls, const PlacedHulls& placed, int part_a, int part_b,
                  const PairAxis& axis, int incident, const Vec3& normal, double area,
                  const PointReach& reach, std::span<const HeldPoint> held,
                  std::vector<PairManifold>& manifolds, std::vector<PairPoint>& points);

}  // namespace talus
