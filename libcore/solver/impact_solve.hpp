// libcore/solver/impact_solve.hpp: public
// The impact law: changes of velocity of rigid bodies that hit each other at one time.
// in:    bodies at that time, and the contacts that approach then
// out:   their velocities after it, and the impulse of each contact
// theory 1.12: M (v - v-) = sum J^T p, 0 <= p_n _|_ u_n - t >= 0, Coulomb against the end velocity
#pragma once

#include <Eigen/Dense>
#include <span>
#include <utility>
#include <vector>

#include "base/workers.hpp"
#include "motion/displacement.hpp"
#include "solver/angular_row.hpp"
#include "solver/block_lu.hpp"
#include "solver/impact_contacts.hpp"
#include "solver/impact_few.hpp"

namespace talus {

/// Result of an impact.
struct Impact {
  bool converged = true;
  int passes = 0;          ///< evaluations of all contacts
  double share = 1;        ///< of the restitution: below 1 where all of it would gain energy
  double dissipated = 0;   ///< kinetic energy lost, >= 0 [J]
  double by_friction = 0;  ///< ... of it by friction [J]
  double by_rolling = 0;   ///< ... of it by couples [J]
};

/// Scratch of solve_impact.
struct ImpactWork {  // clang-format off
  /// A body that the ground resists to roll on it.
  struct Turn {
    int body = 0;
    double damping = 0;                  ///< [kg m2]
    double lever = 0;                    ///< turns spin into velocity [m]
    CoupleBounds bounds;                 ///< by the impulses at hand
    CoupleBounds held;                   ///< by those expected
    Vec3 expected = Vec3::Zero();        ///< couple that the solution is sought around [N m s]
    Vec3 couple = Vec3::Zero();          ///< [N m s]
    Vec3 full_couple = Vec3::Zero();     ///< with all of the restitution
    Mat3 tangent = Mat3::Zero();         ///< - d couple / d spin [kg m2]
    AngularRow law;                      ///< at the last evaluation
  };
  Workers* workers = nullptr;            ///< share the contacts of a large group
  std::vector<Turn> turns;               ///< mostly none
  std::vector<int> turn_of;              ///< of a body, -1: none; empty: no turns         (n_bodies)
  Eigen::VectorXd before, velocity, full, tried, residual, step;  ///<                  (6 n_bodies)
  FewContacts few;
  BlockLu<6> matrix;
  std::vector<std::pair<int, int>> edges;
  std::vector<Vec6> blocks;              ///<                                            (n_bodies)
};  // clang-format on

/// Scratch of the search of hits.
struct ImpactScratch {
  std::vector<ImpactContact> touching, hit;
  ImpactWork solver;
};

/// Newton's law with each contact's own restitution, all contacts together. Where friction would
/// let it gain energy, the largest share of the restitution is taken that does not: between the
/// solutions with the restitution and without it energy is quadratic in the share. Momentum is kept
/// to rounding, no contact approaches afterwards, impulses stay in their cones.
Impact solve_impact(std::span<ImpactBody> bodies, std::span<ImpactContact> contacts,
                    ImpactWork& work);

/// Largest share f <= 1 of a restitution at which square f^2 + linear f + constant, the gain or
/// lack of the energy that it must lose, is not above zero; if there is none, the share at which it
/// is least. `square` > 0; at f = 1 the sum is above zero.
[[nodiscard]] double largest_share(double square, double linear, double constant);

}  // namespace talus
