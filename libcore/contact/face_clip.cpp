// Clips a face of one convex part by the sides of a face of another.
#include "contact/face_clip.hpp"

#include <algorithm>
#include <cmath>

#include "contact/scales.hpp"

namespace talus {
namespace {

FaceFrame frame_of(const Hulls& hulls, const PlacedHulls& placed, const FacePair& pair) {
  const Vec3 origin =
      placed.vertices[corner_slot(hulls, pair.reference_part, pair.reference_face, 0)];
  const Vec3 u =
      (placed.vertices[corner_slot(hulls, pair.reference_part, pair.reference_face, 1)] - origin)
          .normalized();
  return {origin, u, normal_at(placed, pair.reference_face).cross(u)};
}

// The incident face, turned so that it runs counter-clockwise about the reference normal: corner i
// of its loop leads to corner i - 1 along edge i - 1.
void start_polygon(const Hulls& hulls, const PlacedHulls& placed, const FacePair& pair,
                   const FaceFrame& frame, std::vector<ClipCorner>& polygon) {
  polygon.clear();
  const int n = n_corners(hulls, pair.incident_face);
  for (int i = n - 1; i >= 0; --i) {
    const Vec3 from =
        placed.vertices[corner_slot(hulls, pair.incident_part, pair.incident_face, i)] -
        frame.origin;
    polygon.push_back({frame.u.dot(from), frame.v.dot(from), ContactMode::vertex_face, i, -1,
                       i == 0 ? n - 1 : i - 1});
  }
}

// A side of the reference face.
struct Side {
  double u, v;                // start [m]
  double inward_u, inward_v;  // normal to its left, as long as the side
  double tolerance;           // of a product with `inward`
  int number, n_sides;
};

double inside_by(const Side& side, const ClipCorner& p) {
  return side.inward_u * (p.u - side.u) + side.inward_v * (p.v - side.v);
}

// Where the path from p (inside by d_p) to q (by d_q) crosses the side.
ClipCorner crossing(const Side& side, const ClipCorner& p, const ClipCorner& q, double d_p,
                    double d_q, int next_side) {
  const double t = d_p / (d_p - d_q);
  ClipCorner corner{p.u + t * (q.u - p.u), p.v + t * (q.v - p.v), ContactMode::edge_edge,
                    p.next_side,           side.number,           next_side};
  if (p.next_side >= 0) return corner;
  // two sides of the reference face meet in its corner
  const int other = -1 - p.next_side;
  const bool follows = side.number == (other + 1) % side.n_sides;
  corner.mode = ContactMode::face_vertex;
  corner.incident = -1;
  corner.reference = follows ? side.number : (side.number + 1) % side.n_sides;
  return corner;
}

// Keeps the part on the inner side (Sutherland-Hodgman); a corner on the side stays as it is.
void clip(const Side& side, std::vector<ClipCorner>& polygon, std::vector<ClipCorner>& clipped) {
  bool all_inside = true;
  for (const ClipCorner& p : polygon) all_inside &= inside_by(side, p) >= -side.tolerance;
  if (all_inside) return;
  clipped.clear();
  const std::size_t n = polygon.size();
  const int along = -1 - side.number;
  double d = inside_by(side, polygon[0]);
  for (std::size_t i = 0; i < n; ++i) {
    const ClipCorner &p = polygon[i], &q = polygon[i + 1 == n ? 0 : i + 1];
    const double d_next = inside_by(side, q);
    const bool is_inside = d >= -side.tolerance, next_inside = d_next >= -side.tolerance;
    if (is_inside) clipped.push_back(p);
    if (is_inside && !next_inside) {
      if (d > side.tolerance)
        clipped.push_back(crossing(side, p, q, d, d_next, along));
      else
        clipped.back().next_side = along;
    } else if (!is_inside && next_inside && d_next > side.tolerance) {
      clipped.push_back(crossing(side, p, q, d, d_next, p.next_side));
    }
    d = d_next;
  }
  polygon.swap(clipped);
}

void clip_by_reference(const Hulls& hulls, const PlacedHulls& placed, const FacePair& pair,
                       const FaceFrame& frame, double on_side, ClipScratch& scratch) {
  const int n = n_corners(hulls, pair.reference_face);
  scratch.reference.clear();
  for (int k = 0; k < n; ++k) {
    const Vec3 from =
        placed.vertices[corner_slot(hulls, pair.reference_part, pair.reference_face, k)] -
        frame.origin;
    scratch.reference.emplace_back(frame.u.dot(from), frame.v.dot(from));
  }
  for (int k = 0; k < n && !scratch.polygon.empty(); ++k) {
    const Vec2& start = scratch.reference[k];
    const Vec2 along = scratch.reference[k + 1 == n ? 0 : k + 1] - start;
    const double length = std::abs(along.x()) + std::abs(along.y());
    clip({start.x(), start.y(), -along.y(), along.x(), on_side * length, k, n}, scratch.polygon,
         scratch.clipped);
  }
}

}  // namespace

FaceFrame clip_incident_face(const Hulls& hulls, const PlacedHulls& placed, const FacePair& pair,
                             ClipScratch& scratch) {
  const FaceFrame frame = frame_of(hulls, placed, pair);
  start_polygon(hulls, placed, pair, frame, scratch.polygon);
  const double on_side = negligible * std::min(hulls.thickness[pair.reference_part],
                                               hulls.thickness[pair.incident_part]);
  clip_by_reference(hulls, placed, pair, frame, on_side, scratch);
  return frame;
}

bool is_in_reference(const std::vector<Vec2>& reference, double u, double v) {
  for (std::size_t k = 0; k < reference.size(); ++k) {
    const Vec2& start = reference[k];
    const Vec2 along = reference[k + 1 == reference.size() ? 0 : k + 1] - start;
    if (along.x() * (v - start.y()) < along.y() * (u - start.x())) return false;
  }
  return true;
}

}  // namespace talus
