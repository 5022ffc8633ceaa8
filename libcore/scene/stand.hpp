// libcore/scene/stand.hpp: public
// A stand of trees that is drawn: a Poisson process of stems whose diameters are gamma distributed.
// in:    stems on a hectare, mean and deviation of diameters, share of conifers, cell by cell
// out:   stems; those of a cell depend on (seed, name, cell) alone, not on other cells or an order
// ref:   Dorren 2016 (Rockyfor3D), whose rasters have the same quantities
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/types.hpp"

namespace talus {

/// Side of the cells in which a stand in a polygon is drawn [m].
inline constexpr double stand_cell = 10;

/// Known data of the trees on a square.
struct Stocking {
  double stems_per_ha = 0;
  double dbh_mean = 0, dbh_std = 0;  ///< diameter at breast height; a deviation of 0: all alike [m]
  double conifer_share = 1;
};

/// A square of the map, by its column and row in a grid of such squares from (0, 0).
struct StandCell {
  std::int64_t col = 0, row = 0;
  double size = stand_cell;  ///< > 0 [m]
  Vec2 low = Vec2::Zero();   ///< south-west corner, map coordinates [m]
};
/// The cell of a grid of squares that holds a place, map coordinates.
[[nodiscard]] StandCell stand_cell_at(const Vec2& place, double size);
/// All cells of stand_cell that meet the box.
[[nodiscard]] std::vector<StandCell> stand_cells(const Vec2& low, const Vec2& high);

struct DrawnStem {
  Vec2 at = Vec2::Zero();  ///< map coordinates [m]
  double dbh = 0;          ///< > 0 [m]
  bool is_conifer = true;
};

/// Names a stand; another seed draws another one.
struct StandSeed {
  std::int64_t seed = 1;
  std::string name;      ///< of the section: stands of two sections on one place are independent
  std::int64_t run = 0;  ///< seed of the run where each draws its own, else 0
};

/// Appends the stems of a cell, in the order of their numbers in it. More stems on a hectare or
/// other diameters leave the places of the first ones.
void draw_cell(const StandSeed& seed, const StandCell& cell, const Stocking& stocking,
               std::vector<DrawnStem>& stems);

/// Names of the species that a list of stems may give, from "conifer" and "broadleaf" on, and the
/// factor FE of the energy that breaks each (Dorren and Berger 2006); those of the first two are
/// set by the site file.
struct Species {
  const char* name;
  double factor;
};
[[nodiscard]] const std::vector<Species>& known_species();
/// Index of a species by its name, -1: unknown.
[[nodiscard]] int species_named(const std::string& name);

}  // namespace talus
