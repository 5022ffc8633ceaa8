// libcore/contact/ground_features.hpp
// Modes 2 and 3 of Fig. 7: convex nodes of the ground against faces of a block, convex edges
// against its edges. Within the module, for search.cpp.
// in:    ground, block where it is, candidate cells; the list of earlier searches
// out:   contacts whose gap is below the margin
// theory: 2.1, 2.2
#pragma once

#include <span>
#include <vector>

#include "contact/contact.hpp"
#include "contact/ground.hpp"
#include "contact/near_features.hpp"
#include "contact/shapes.hpp"
#include "motion/pose.hpp"

namespace talus {

/// A block over the ground, in local axes but for `shapes`.
struct PlacedBlock {
  const Ground& ground;
  const Shapes& shapes;
  int b;  ///< of `shapes`
  const Pose& pose;
  const Mat3& stretch;             ///< I + strain, body axes
  Mat3 to_local;                   ///< body to local axes
  std::span<const Vec3> vertices;  ///< where they are [m]
  Vec3 low, high;                  ///< box around them [m]
};

/// Adds the contacts with convex nodes and edges of the ground in `cells`. Deep ones that other
/// features may explain better come last, where nothing found before explains them. `near`: the
/// list for this block, brought up to date; none: all of `cells` is looked at.
void find_features(const PlacedBlock& block, const CellRange& cells, double margin,
                   NearFeatures* near, std::vector<Contact>& contacts);

}  // namespace talus
