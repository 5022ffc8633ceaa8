// libcore/blocks/convexify.hpp
// Makes a block convex inside its joint cell: the bed is kept clear of by supporting planes, the
// volume is kept by the height of one plane on the terrain side. A block that would lose too much
// as one convex body becomes two or four that meet in planes, and so does one at a re-entrant
// corner of the source.
#pragma once

#include <vector>

#include "geometry/polyhedron.hpp"
#include "terrain/trn.hpp"

namespace talus {

/// A block as it was cut, and the room that it may take.
struct ConvexTask {
  std::vector<Polyhedron> cells;  ///< convex cells that fill the block; face_tag as CutFace
  Polyhedron room;                ///< convex: joint cell within the source, cut off from other
                                  ///< blocks in it
  double volume = 0;              ///< to be kept, > 0 [m3]
};

struct ConvexOptions {
  double max_loss = 0.05;     ///< share of the volume
  double tolerance_m = 1e-9;  ///< of lying on a plane
  double min_edge = 0;        ///< shorter edges are removed [m]
};

/// The convex block; without faces when nothing of it is left. Its volume is that of the task where
/// the room allows. Lies above `bed` everywhere to within the tolerance, and within the room. Faces
/// on the terrain side carry face_terrain, those on the bed face_failure, all further ones their
/// tag.
[[nodiscard]] Polyhedron made_convex(const ConvexTask& task, const Trn& bed,
                                     const ConvexOptions& options);

/// A convex body for each task of a block, and up to three more, that keep at least 1 - max_loss of
/// the volume; empty when that cannot be done, or would leave bodies that do not hang together. Two
/// bodies meet in a vertical plane and do not overlap.
[[nodiscard]] std::vector<Polyhedron> made_convex_parts(const std::vector<ConvexTask>& tasks,
                                                        const Trn& bed,
                                                        const ConvexOptions& options);

/// A convex body inside `body` without edges shorter than `shortest` [m]: of vertices that near one
/// stays. `body` itself when it has no such edge, or would lose more than `max_loss` of its volume.
[[nodiscard]] Polyhedron without_short_edges(const Polyhedron& body, double shortest,
                                             double max_loss);

}  // namespace talus
