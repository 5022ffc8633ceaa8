// libcore/solver/island_solver.hpp: public
// Contact impulses of an island: semismooth Newton on the balance of momentum of all its bodies,
//   M (v - v_free) = sum B_c^T p_c(B_c v),
// with the contact law of solver/contact_law.hpp. A body that touches only the ground is cheaper
// with solve_contacts() in solver/newton.hpp. theory 1.7, 3.4, 3.5; docs/developing/design-notes.md
#pragma once

#include "solver/incomplete_factor.hpp"
#include "solver/island.hpp"
#include "solver/island_matrix.hpp"

namespace talus {

struct IslandSettings {
  double tolerance = 0;        ///< largest residual, as a velocity of a body's points, > 0 [m/s]
  int max_passes = 200;        ///< evaluations of all contacts; then it relaxes, in three
                               ///< times as many steps
  Vec3 down = -Vec3::UnitZ();  ///< along gravity: the order in which bodies are eliminated
  double linear_tolerance = 1e-2;   ///< of conjugate gradients, relative to the step's start
  int max_linear_iterations = 250;  ///< of conjugate gradients in one step
  int direct_bodies = 8;            ///< islands up to this size are factored
  int direct_fallback = 1500;       ///< up to this size where conjugate gradients stagnate
  /// Largest D_n and D_t over the reduced mass of the pair; stiffer rows of the island are lowered
  /// to it. Beyond, the mass is lost in the rounding of the matrix.
  double stiffest = 1e8;
  /// Continues from the last solution of the same IslandWork, which converged, and from which only
  /// the data named by BodyPair::changed differ: no step with the states they came with. Costs grow
  /// with the number of changes.
  bool continues = false;
};

struct IslandResult {
  bool converged =
      false;            ///< residual <= tolerance, or below the rounding of velocities and impulses
  double residual = 0;  ///< at the velocities returned, NaN when there are none [m/s]
  int passes = 0;       ///< evaluations of all contacts
  int linear_iterations = 0;  ///< of conjugate gradients, summed
  int factorisations = 0;
  int n_lowered = 0;  ///< rows stiffer than IslandSettings::stiffest, of pairs that changed
};

/// Result of an evaluation for a pair.
struct PairImpulse {
  Vec6 impulse;
  bool changed = false;  ///< its tangent did
};

/// Scratch of solve_island; reused from call to call, it stops allocating.
struct IslandWork {  // clang-format off
  IslandMatrix matrix;             ///< its workers share the other loops too
  IncompleteFactor factor;
  std::vector<Vec6> velocity;      ///< before momentum is kept; where a solution that continues
                                   ///< this one starts                                 (n_bodies)
  std::vector<Vec6> residual;      ///< M (v - v_free) - sum B^T p                       (n_bodies)
  std::vector<Vec6> unaimed;       ///< the same, where couples aim at holding           (n_bodies)
  std::vector<Vec6> per_impulse;   ///< speed of a body's points per impulse [1/kg, 1/(kg m)]
  std::vector<double> speed;       ///< of the residual [m/s]                            (n_bodies)
  std::vector<PairImpulse> evaluated;  ///< scratch, of active pairs; threads only
  std::vector<Vec6> pair_impulse;  ///< sum B^T p of a pair, about A                     (n_pairs)
  std::vector<Vec6> step;          ///< of Newton                                        (n_bodies)
  std::vector<Vec6> from;          ///< velocity before the step                         (n_bodies)
  std::vector<int> start;          ///< their bodies
  IndexSet touched_bodies;         ///< whose residual this solution computed anew
  IndexSet touched_pairs;          ///< that this solution evaluated
  double rounding = 0;             ///< of velocities and of the stiffest impulse [m/s]
  double stiffness_ratio = 0;      ///< largest D / m
};  // clang-format on

/// Solves the island: sets velocity, impulse and state of the rows.
///
/// The first step keeps the inherited states and bounds friction by the last step's normal
/// impulses; where none is inherited and the first guess is right, no step is made. Steps follow
/// with the law at the iterate, from the fourth on with a line search: with the exact derivative
/// where the matrix is factored, with a symmetric one for conjugate gradients. Where that
/// gets no closer, the bodies come to rest from their free motion under the residual, in a time of
/// its own.
/// At last the velocities are made those that the impulses give, so that momentum and angular
/// momentum are kept to rounding.
///
/// Not finite input, or no convergence: `converged` is false and the velocities are those that the
/// bodies have come to.
IslandResult solve_island(Island& island, const IslandSettings& settings, IslandWork& work);

}  // namespace talus
