// libcore/dda/island_impact.hpp
// Impact in an island: a change of velocity at one instant, for all its contacts together:
//   v_n+ >= -e v_n-, p_n >= 0, complementary; Coulomb friction on the impulses.
// theory 1.12 (Newton's law at velocity level, never one contact after the other);
// docs/design-notes.md
//
// Hard contacts are reached by rounds of the compliant solver, each with the impulses of the last
// as its start (augmented Lagrangian), so that no matrix is as stiff as the contact.
#pragma once

#include "dda/island_solver.hpp"

namespace talus {

struct ImpactSettings {
  double tolerance = 1e-6;  ///< of the conditions on velocity, relative to the fastest body
  double stiffness = 10;    ///< of the first round: D_n over the reduced mass
  int max_rounds = 60;
};

struct IslandImpactResult {
  bool converged = false;
  int rounds = 0;               ///< of the compliant solver
  int passes = 0;               ///< evaluations of all contacts
  double violation = 0;         ///< largest error of the conditions on velocity [m/s]
  double dissipated = 0;        ///< kinetic energy lost; below zero by rounding only [J]
  double restitution_part = 1;  ///< of the restitution asked for; < 1 where it would create energy
};

/// Scratch of apply_island_impact; reused from call to call, it stops allocating.
template <int Dof>
struct ImpactWork {
  IslandWork<Dof> solver;
  std::vector<double> asked;  ///< restitution asked for, the rows' `bias` [m/s]        (n_rows)
  std::vector<typename Island<Dof>::Vec> outcome;  ///< velocities with restitution     (n_bodies)
  std::vector<Vec3> impulses;                      ///< and their impulses              (n_rows)
};

/// Applies the impact law to `island`: free_velocity holds the velocities before, `velocity` gets
/// those after, the rows their impulses.
///
/// A row's `bias` asks for restitution: e v_n- (<= 0) where the contact approaches faster than its
/// resting speed, else 0. Friction, normal and arm are used; the other fields of the law are
/// overwritten, and all rows take part.
///
/// Newton's law with friction, or with e that differ, can create energy. Where it would, the
/// outcome is moved towards that of e = 0 until it does not: E is quadratic on that line and e = 0
/// never gains, impulses stay in their cones and no contact closes.
template <int Dof>
IslandImpactResult apply_island_impact(Island<Dof>& island, const ImpactSettings& settings,
                                       ImpactWork<Dof>& work);

}  // namespace talus
