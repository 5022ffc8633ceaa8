// libcore/contact/body_overlap.hpp: public
// How far two bodies are in each other, as bodies: no contact is asked.
// in:    two placed bodies, each of one or more convex parts
// out:   the least displacement that frees them
// theory: docs/theory/theory.md 2.1
#pragma once

#include <array>
#include <vector>

#include "contact/hulls.hpp"

namespace talus {

/// A part of A is out of a part of B once A has moved by x with axis . x >= depth for one of these.
struct WayOut {
  Vec3 axis = Vec3::Zero();  ///< unit, from B to A
  double depth = 0;          ///< [m]
};

/// A displacement of A and the axes along which it goes to the end of the overlap, or beyond.
struct Displacement {
  static constexpr int most_ways = 6;
  Vec3 x = Vec3::Zero();
  double length = 0;  ///< [m]
  int n_ways = 0;
  std::array<int, most_ways> ways{};
};

/// Arrays that body_overlap fills anew; kept to spare allocation.
struct BodyOverlapScratch {
  std::vector<WayOut> ways;         ///< pair of parts by pair
  std::vector<int> begin;           ///< of each pair's axes
  std::vector<Displacement> tried;  ///< a heap, the shortest first
};

/// The least displacement of A that takes it out of all parts of B [m]. Out of one part may be into
/// the next: in a notch it leads out of both flanks at once. Where the search for it takes too long
/// (deep in many parts): the least along an axis of a pair of parts. 0: the bodies do not overlap.
/// An overlap of up to `ignored` [m] may come out as 0, which is found sooner.
[[nodiscard]] double body_overlap(const Hulls& hulls, const PlacedHulls& placed, int body_a,
                                  int body_b, double ignored, BodyOverlapScratch& scratch);

}  // namespace talus
