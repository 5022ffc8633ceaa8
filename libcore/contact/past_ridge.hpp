// libcore/contact/past_ridge.hpp: public
// Depth of a block in a ridge that one of its vertices has crossed.
// in:    ground, block, its contacts
// out:   an overlap that none of the contacts reports
#pragma once

#include <span>
#include <vector>

#include "contact/contact.hpp"
#include "contact/ground.hpp"
#include "contact/shapes.hpp"

namespace talus {

/// Depth of block b in a ridge that one of its vertices has crossed, where no contact reports half
/// as much [m]; 0 when there is none. The vertex is on or in the triangle beyond the ridge, and its
/// contact says nothing of the edge that leads from it back under the ridge; the shortest direction
/// out may be normal to a plane that the vertex has left. The height from that edge up to the ridge
/// times the cosine of the steeper slope beside it. `vertices`: those of the block at its pose;
/// `contacts`: result of find_contacts() there; depths up to `least` count as none.
[[nodiscard]] double depth_past_ridge(const Ground& ground, const Shapes& shapes, int b,
                                      std::span<const Vec3> vertices,
                                      const std::vector<Contact>& contacts, double least);

}  // namespace talus
