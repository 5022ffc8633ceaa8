// libcore/terrain/flat.hpp: public
// Flat triangles of a contour map: three corners at one height, on summits, ridges, in pits and on
// valley floors, where the ground is not flat. Finds them, and finds points inside them that mend.
// method: docs/developing/design-notes.md, "Flat triangles"
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/progress.hpp"
#include "base/types.hpp"
#include "terrain/triangulate.hpp"

namespace talus {

/// Points first to last - 1 were measured (breaklines, spot heights): a level triangle at one of
/// them is taken as level ground.
struct MeasuredPoints {
  int first = 0, last = 0;
};

/// 1 for each triangle with three corners within same_height_m, none of them measured.
[[nodiscard]] std::vector<std::uint8_t> find_flat_triangles(const TriangleMesh& mesh,
                                                            MeasuredPoints measured);

/// Area in plan of the triangles marked, and of all [m2].
struct AreaShare {
  double marked_m2 = 0, all_m2 = 0;
  [[nodiscard]] double share() const { return all_m2 > 0 ? marked_m2 / all_m2 : 0; }
};
[[nodiscard]] AreaShare area_of(const TriangleMesh& mesh, const std::vector<std::uint8_t>& marked);

struct FlatMending {
  double contour_interval = 0;  ///< vertical distance of neighbouring contours, > 0 [m]
  double spacing = 0;           ///< of the lattice [m]; 0: lattice_spacing()
};

struct MendingPoints {
  std::vector<Vec3> points;                ///< to be added to the triangulation [m]
  std::vector<std::array<int, 2>> border;  ///< edges to be fixed before, so that all else stays
  double spacing = 0;                      ///< of the lattice used [m]
  int n_regions = 0;                       ///< groups of nodes solved independently
  int n_unsolved = 0;                      ///< nodes left as they were because nothing holds them
  double largest_change = 0;               ///< of a node against the triangles [m]
};

/// The larger of 1.5 mean segments and an eighth of the mean plan distance of the contours [m].
[[nodiscard]] double lattice_spacing(const TriangleMesh& mesh);

/// The spacing with which a lattice over the mesh has 40 million nodes [m]; none may be finer.
[[nodiscard]] double finest_spacing(const TriangleMesh& mesh);

/// Points with heights that mend the triangles marked `flat` (find_flat_triangles): a plate under
/// tension through the contours, over the flat triangles and over the triangles that share with
/// them a level edge that is not a contour. The tension grows with the slope s of the ground around
/// as (s / interval)^2: a slope dies out within the distance in which it would reach the next
/// contour, which is missing. Heights stay strictly within half an interval of a flat triangle, and
/// between the heights of the corners of a sloping one, so no point passes the next contour. Leaves
/// the mesh without neighbors and constrained, which are as large as the solution.
[[nodiscard]] MendingPoints mend_flat_triangles(TriangleMesh& mesh,
                                                const std::vector<std::uint8_t>& flat,
                                                const FlatMending& mending,
                                                const ProgressFunction& progress = {});

/// `value` where it is well inside low..high, bent towards the nearer bound over the outer fifths
/// so that it never reaches it: monotone, with a continuous slope.
[[nodiscard]] double bend_into(double value, double low, double high);

}  // namespace talus
