// libcore/contact/ground.hpp: public
// The terrain as the contact search reads it: elevations, convex features, bounds and classes.
// in:    a TRN and, for each cell, the class of its ground
// out:   everything about the terrain that a contact needs; const during a run
#pragma once

#include <cstdint>
#include <vector>

#include "contact/ground_law.hpp"
#include "terrain/trn.hpp"
#include "terrain/trn_flags.hpp"
#include "terrain/trn_pyramid.hpp"
#include "terrain/trn_walk.hpp"

namespace talus {

struct Ground {
  Trn trn;
  std::vector<std::uint8_t> flags;       ///< ground_flags: convex edges and nodes      (n_nodes)
  TrnPyramid pyramid;                    ///< build_pyramid
  std::vector<std::uint8_t> cell_class;  ///< index into `classes`; empty: all 0        (n_cells)
  std::vector<GroundClass> classes;      ///< at least one
};

/// Flags and pyramid of `trn`, one class for all of it.
[[nodiscard]] Ground make_ground(Trn trn, const GroundClass& ground_class);

/// Class of a triangle's cell.
[[nodiscard]] inline int class_of(const Ground& ground, int triangle) {
  return ground.cell_class.empty() ? 0 : ground.cell_class[triangle / 2];
}

/// Calls visit(class, share) for each part of a straight displacement that lies over one class, in
/// order; parts off the grid are left out.
template <class Visit>
void for_each_class_below(const Ground& ground, const Vec3& from, const Vec3& to, Visit&& visit) {
  int last = -1;
  double begin = 0, end = 0;
  walk_cells(ground.trn, from.head<2>(), to.head<2>(), [&](const CellPart& part) {
    const int now = class_of(ground, first_triangle(ground.trn, part.cell));
    if (now != last) {
      if (last >= 0) visit(last, end - begin);
      last = now, begin = part.t_in;
    }
    end = part.t_out;
  });
  if (last >= 0) visit(last, end - begin);
}

/// Whether all of the cells have the same class.
[[nodiscard]] inline bool is_one_class(const Ground& ground, const CellRange& cells) {
  if (ground.cell_class.empty()) return true;
  const int first =
      class_of(ground, first_triangle(ground.trn, {cells.row_first, cells.col_first}));
  for (int row = cells.row_first; row <= cells.row_last; ++row)
    for (int col = cells.col_first; col <= cells.col_last; ++col)
      if (class_of(ground, first_triangle(ground.trn, {row, col})) != first) return false;
  return true;
}

}  // namespace talus
