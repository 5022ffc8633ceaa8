// libcore/contact/face_clip.hpp
// A face of one convex part clipped by the sides of a face of another.
// in:    two placed parts and a face of each
// out:   a polygon whose corners say which features meet there
// theory: docs/theory/theory.md 2.6 (Sutherland-Hodgman)
#pragma once

#include <vector>

#include "contact/contact.hpp"
#include "contact/hulls.hpp"

namespace talus {

/// The face that clips (reference) and the face that is clipped (incident), and their parts.
struct FacePair {
  int reference_part, incident_part;
  int reference_face, incident_face;  ///< slots
  bool reference_is_a;
};

/// Vertex slot of a corner of a face.
[[nodiscard]] inline int corner_slot(const Hulls& hulls, int part, int face_slot, int corner) {
  return hulls.vertex_begin[part] + hulls.loop_vertices[hulls.loop_begin[face_slot] + corner];
}

[[nodiscard]] inline int n_corners(const Hulls& hulls, int face_slot) {
  return hulls.loop_begin[face_slot + 1] - hulls.loop_begin[face_slot];
}

/// Plane coordinates on the reference face, local axes.
struct FaceFrame {
  Vec3 origin, u, v;
};

/// A corner of the polygon that is being clipped, in the frame of the reference face.
struct ClipCorner {
  double u = 0, v = 0;                          ///< [m]
  ContactMode mode = ContactMode::vertex_face;  ///< seen from the incident part
  int incident = -1;   ///< corner of the incident loop, or its edge (mode edge_edge)
  int reference = -1;  ///< corner of the reference loop, or its side (mode edge_edge)
  int next_side = 0;   ///< line to the next corner: incident edge i, or reference side -1 - k
};

/// Arrays that find_features fills anew; kept to spare allocation.
struct ClipScratch {
  std::vector<ClipCorner> polygon, clipped;
  std::vector<Vec2> reference;  ///< corners of the reference face in its frame [m]
};

/// Fills the scratch anew: `reference`, and `polygon` with the part of the incident face that lies
/// above the reference face, seen along its normal. Points within 1e-6 of the smaller thickness of
/// a side count as on it.
FaceFrame clip_incident_face(const Hulls& hulls, const PlacedHulls& placed, const FacePair& pair,
                             ClipScratch& scratch);

/// Whether the point (u, v) of the frame lies in the reference face.
[[nodiscard]] bool is_in_reference(const std::vector<Vec2>& reference, double u, double v);

}  // namespace talus
