// libcore/blocks/shell.hpp
// The surface of a group of cells of a complex, and the groups of cells whose union is convex.
#pragma once

#include <vector>

#include "blocks/cut.hpp"

namespace talus {

/// Reads shells off a complex. Keeps scratch arrays of the size of the complex, so make it once.
class ShellReader {
 public:
  explicit ShellReader(const CellComplex& complex);

  /// Closed outward surface of `cells`. Faces in one plane made by the same joint, by the ground or
  /// by the bed are joined into one polygon (convex or not); where the surface touches itself in a
  /// point or along an edge, that is in it once for each sheet. face_tag = CutFace or joint.
  [[nodiscard]] Polyhedron shell(const std::vector<int>& cells);

  /// Parts `cells` into few groups with convex unions, joining neighbours across walls greedily.
  /// `tolerance_m`: how far a vertex may be outside the plane of a face.
  [[nodiscard]] std::vector<std::vector<int>> convex_groups(const std::vector<int>& cells,
                                                            double tolerance_m);

  /// Parts `cells` by a plane across `axis` at `share` of their extent, by the cells' middles, into
  /// groups that hang together through common faces.
  [[nodiscard]] std::vector<std::vector<int>> parted(const std::vector<int>& cells,
                                                     const Vec3& axis, double share);

 private:
  const CellComplex& complex_;
  std::vector<int> cell_face_begin_;  // faces are ordered by cell (n_cells + 1)
  std::vector<char> is_member_;       // of the group at hand (n_cells)
  std::vector<int> local_of_dart_;    // -1 when not on the surface (n_darts)
};

}  // namespace talus
