// libcore/contact/search.hpp
// All contacts that a block may have with the ground at a pose: modes 1, 2 and 3 of Fig. 7.
// in:    ground, block surface, pose
// out:   candidate contacts with their gaps
// paper: Zhang et al. 2018, Eq. (5)-(7) and Fig. 7; theory 2.2-2.5
#pragma once

#include <cstdint>
#include <vector>

#include "contact/contact.hpp"
#include "contact/ground.hpp"
#include "contact/pose.hpp"
#include "contact/shapes.hpp"

namespace talus {

/// What the search found besides the contacts.
struct SearchResult {
  /// `off_ground` also when a vertex lies beyond the known ground and the block is not above it:
  /// what would bear or stop it there is not known.
  Reach reach = Reach::off_ground;
  double clearance = 0;  ///< when above: lowest vertex over the highest candidate ground [m]
};

/// The nodes and edges of the ground that one block may touch while it stays near a pose, and with
/// which of its own edges: found with a skin around the block and looked at alone until it has
/// moved by that, as a Verlet list. It changes no contact and no bit.
struct NearFeatures {
  /// A convex node, or a convex edge that the node owns.
  struct Feature {
    std::uint64_t edges = 0;  ///< of the block that may touch it, by bits; all where it has over 64
    int row = 0, col = 0;     ///< node
    std::uint8_t flag = 0;    ///< one of trn_flag
  };
  std::vector<Feature> features;  ///< row by row, as the search goes
  Pose listed;                    ///< where the list was made ...
  Mat3 stretch = Mat3::Zero();    ///< ... and I + strain there
  Pose last;                      ///< where the block was looked for last
  double skin = -1;               ///< the list holds within this from `listed`; < 0: no list [m]
  double margin = 0;              ///< largest margin that it is made for [m]
};

/// Replaces `contacts` by those of block b at `pose` whose gap is below `margin`.
///
/// Mode 1: the plane under each vertex, and beside a valley line the plane of the other side too,
/// within 4 margins of it or 4 depths of the vertex, so that one in a valley leans on both. Modes
/// 2 and 3: convex nodes and edges only, by the entrance tests with the normals of the true
/// neighbours. That leaves nothing to collide with on flat or concave ground; of deep ones that
/// another face or edge may explain better, those that nothing else found explains. `stretch` = I +
/// strain moves the vertices in body axes. `vertices` is scratch: the block's vertices at the pose.
/// `near`: what the last searches for this block leave for the next; none: every search is whole.
SearchResult find_contacts(const Ground& ground, const Shapes& shapes, int b, const Pose& pose,
                           const Mat3& stretch, double margin, std::vector<Vec3>& vertices,
                           std::vector<Contact>& contacts, NearFeatures* near = nullptr);

}  // namespace talus
