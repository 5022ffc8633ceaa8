// libcore/solver/mass_solver.hpp: public
// Contact impulses of a mass that moves: projected Gauss-Seidel over pairs of bodies, colour by
// colour, eight pairs of a colour side by side in single precision.
// in:    bodies, and contacts as rows, each with the impulse of the last step
// out:   impulse of every row; the change by the last sweep
// docs/theory/theory.md, "One step of a mass"
//
// The law of a row: with w = v + J dv, v its velocity at the end of the step without contact, the
// bias and the shear spring, and dv the change of the bodies' velocities,
//   p_n = max(0, -D_n w_n), at most `limit`;  p_t = -D_t w_t, |p_t| <= friction p_n,
// where it slips along the mean of the slip at the start and at the end. It is the law of
// solver/contact_law.hpp with one stiffness for all contacts: D_n = 1 / (compliance W_n), D_t =
// shear_ratio D_n.
//
// Impulses alone are results. Changes of velocity are summed in single precision while the sweeps
// continue; sums of the impulses in doubles keep momentum to their rounding.
#pragma once

#include <cstdint>
#include <vector>

#include "base/types.hpp"
#include "base/workers.hpp"
#include "solver/angular_row.hpp"
#include "solver/mass_rows.hpp"

namespace talus {

/// Rows of two bodies, or of one with the ground, consecutive. Two bodies may have several pairs.
struct MassPair {
  int a = 0, b = -1;  ///< b = -1: the ground
  int row_begin = 0, row_end = 0;
};

/// A couple that resists the rolling and the pivoting of the body of a pair with the ground.
struct MassTurn {
  int pair = 0;
  int arm_begin = 0;           ///< of the arms of the pair's rows
  double damping = 0;          ///< couple impulse per spin while it holds [kg m2]
  double inertia = 0;          ///< smallest principal moment of the body [kg m2]
  Vec3 spin = Vec3::Zero();    ///< at the end of the step without contact [rad/s]
  Vec3 couple = Vec3::Zero();  ///< out: on A [N m s]
};

struct MassSettings {
  int sweeps = 0;       ///< at least, > 0; half as many more ...
  int most_sweeps = 0;  ///< ... up to this ...
  double settled = 0;   ///< ... while the last one changes velocities by more [m/s]
  bool from_rest =
      false;  ///< no row knows its impulse: they double while all since the last time do
  double compliance = 0;       ///< > 0 [-]
  double shear_ratio = 0;      ///< > 0 [-]
  Workers* workers = nullptr;  ///< share the batches of a colour; nullptr: there are none
};

struct MassResult {
  int sweeps = 0;     ///< beyond the one that applies the impulses of the last step
  double change = 0;  ///< of velocities in the last of them, or in the last half of them where the
                      ///< mass is from rest: root of the mean square over the bodies or over the
                      ///< mass, whichever is larger [m/s]
  bool diverges = false;  ///< ... and it grew with the sweeps: the impulses mean nothing
  int n_colours = 0;
};

/// A mass to be solved, and its scratch. Buffers grow to the largest mass and are kept.
struct MassSystem {  // clang-format off
  std::vector<MassInertia> inertia;         ///< in                                      (n_bodies)
  std::vector<MassRow> rows;                ///< pair by pair
  std::vector<MassPair> pairs;              ///< in
  std::vector<MassTurn> turns;
  std::vector<RowArm> arms;                 ///< in: of the rows of pairs with a turn
  // scratch
  std::vector<MassBody> change;             ///< of bodies, and of those that are not: ...
  std::vector<MassInertia> inertias;        ///< ... one for each lane and side
  std::vector<MassBody> before;             ///< the last sweep                          (n_bodies)
  std::vector<std::uint64_t> used;          ///< colours of the pairs of a body          (n_bodies)
  std::vector<int> colour, order, bucket;
  std::vector<MassBatch> batches;
  std::vector<MassColour> colours;          ///< consecutive batches
  std::vector<MassPoint> points;
  std::vector<int> place;                   ///< of a row: 8 point + lane                (n_rows)
};  // clang-format on

/// Empties bodies, pairs and rows.
void clear(MassSystem& system);

/// Bodies, one on the other, from the ground to the body that is the most of them away from it.
[[nodiscard]] int layers_on_ground(const MassSystem& system);

/// Fills the impulses of rows and turns. `width`: lanes computed at a time, 4 or 8; the same bits.
MassResult solve_mass(const MassSettings& settings, MassSystem& system, int width);
/// The width that is fastest here.
[[nodiscard]] int widest_mass_lanes();

}  // namespace talus
