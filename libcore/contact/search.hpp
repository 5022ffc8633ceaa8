// libcore/contact/search.hpp: public
// All contacts that a block may have with the ground at a pose: modes 1, 2 and 3 of Fig. 7.
// in:    ground, block surface, pose
// out:   candidate contacts with their gaps
// paper: Zhang et al. 2018, Eq. (5)-(7) and Fig. 7; theory 2.1, 2.2
#pragma once

#include <vector>

#include "contact/contact.hpp"
#include "contact/ground.hpp"
#include "contact/near_features.hpp"
#include "contact/shapes.hpp"
#include "motion/pose.hpp"

namespace talus {

/// Result of the search besides the contacts.
struct SearchResult {
  /// `off_ground` also when a vertex lies beyond the known ground and the block is not above it: it
  /// is not known whether ground would support or stop it there.
  Reach reach = Reach::off_ground;
  double clearance = 0;  ///< when above: lowest vertex over the highest candidate ground [m]
};

/// Replaces `contacts` by those of block b at `pose` whose gap is below `margin`.
///
/// Mode 1: the plane under each vertex, and beside a valley line the plane of the other side too,
/// within 4 margins of it or 4 depths of the vertex, so that one in a valley leans on both. Modes
/// 2 and 3: convex nodes and edges only, by the entrance tests with the normals of the true
/// neighbours. That leaves nothing to collide with on flat or concave ground; of deep ones that
/// another face or edge may explain better, those that nothing else found explains. `stretch` = I +
/// strain moves the vertices in body axes. `vertices` is scratch: the block's vertices at the pose.
/// `near`: features that the last searches for this block left; none: every search is whole.
SearchResult find_contacts(const Ground& ground, const Shapes& shapes, int b, const Pose& pose,
                           const Mat3& stretch, double margin, std::vector<Vec3>& vertices,
                           std::vector<Contact>& contacts, NearFeatures* near = nullptr);

}  // namespace talus
