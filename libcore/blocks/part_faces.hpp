// libcore/blocks/part_faces.hpp: public
// How the convex parts of one body lie to each other, where a file gives them.
#pragma once

#include <vector>

#include "geometry/polyhedron.hpp"

namespace talus {

/// Sum over pairs of the common volume of two parts [m3].
[[nodiscard]] double shared_volume(const std::vector<Polyhedron>& parts);

/// Tags faces that other parts cover (all but 1e-6 of their area) face_internal, the rest
/// face_terrain. Faces lie against each other within 1e-6 of the largest part's size, as where
/// contacts are found.
void name_covered_faces(std::vector<Polyhedron>& parts);

/// Can every part be reached from the first over faces that lie against each other?
[[nodiscard]] bool hang_together(const std::vector<Polyhedron>& parts);

}  // namespace talus
