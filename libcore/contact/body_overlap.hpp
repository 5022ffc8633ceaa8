// libcore/contact/body_overlap.hpp: public
// How far two bodies are in each other, as bodies: no contact is asked.
// in:    two placed bodies, each of one or more convex parts
// out:   the least displacement along an axis of their parts that frees them
// theory: docs/theory/theory.md 2.1
#pragma once

#include <vector>

#include "contact/hulls.hpp"

namespace talus {

/// A part of A is out of a part of B once A has moved by x with axis . x >= depth for one of these.
struct WayOut {
  Vec3 axis = Vec3::Zero();  ///< unit, from B to A
  double depth = 0;          ///< [m]
};

/// Arrays that body_overlap fills anew; kept to spare allocation.
struct BodyOverlapScratch {
  std::vector<WayOut> ways;  ///< pair of parts by pair
  std::vector<int> begin;    ///< of each pair's ways
};

/// The least displacement of A that takes it out of all parts of B [m], of those along a normal of
/// a face, or of two edges whose Gauss arcs cross, of a pair of parts that overlap. Out of one part
/// may be into the next: such a displacement goes on until all are left. 0: the bodies do not
/// overlap. An overlap of up to `ignored` [m] may come out as 0, which is found sooner.
[[nodiscard]] double body_overlap(const Hulls& hulls, const PlacedHulls& placed, int body_a,
                                  int body_b, double ignored, BodyOverlapScratch& scratch);

}  // namespace talus
