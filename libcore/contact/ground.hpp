// libcore/contact/ground.hpp: public
// The terrain as the contact search reads it: elevations, convex features, bounds and classes.
// in:    a TRN and, for each cell, the class of its ground
// out:   everything about the terrain that a contact needs; const during a run
#pragma once

#include <cstdint>
#include <vector>

#include "terrain/trn.hpp"
#include "terrain/trn_flags.hpp"
#include "terrain/trn_pyramid.hpp"
#include "terrain/trn_walk.hpp"

namespace talus {

/// What a contact with one class of ground does.
struct GroundClass {
  double friction = 0;     ///< tan(phi), >= 0 [-]
  double cohesion = 0;     ///< c, acts on bonded area until the bond breaks [Pa]
  double tension = 0;      ///< tensile strength of the same bond [Pa]
  double restitution = 0;  ///< coefficient of restitution along the normal, 0 to 1 [-]
  // what ground that gives way does besides; 0: nothing
  double half_speed = 0;       ///< v_h: approach that halves the restitution [m/s]
  double half_energy = 0;      ///< E_05: or the energy of it [J]
  double rolling = 0;          ///< mu_r: couple against rolling per normal force and radius [-]
  double spinning = -1;        ///< mu_s: against pivoting about the normal; < 0: as rolling [-]
  double bearing = 0;          ///< q: mu_r by the size of the block instead [Pa]
  double scar_friction = 0;    ///< mu_max: tan(phi) that slip leads to [-]
  double scar_rate = 0;        ///< kappa: how fast, along the way slid [1/m]
  double scar_decay = 0;       ///< beta: how fast that way is forgotten off the ground [1/s]
  double weak_friction = 0;    ///< mu_w: tan(phi) at high speed of slip [-]
  double weakening_speed = 0;  ///< U_w: where half of the way to it is done [m/s]
  double drag_per_time = 0;    ///< nu [1/s]
  double drag_per_way = 0;     ///< c [1/m]
};

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
/// order; what is off the grid is left out.
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
