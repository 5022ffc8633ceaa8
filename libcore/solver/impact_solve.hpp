// libcore/solver/impact_solve.hpp: public
// The impact law: what rigid bodies that hit each other at one time do to each other's velocities.
// in:    bodies at that time, and the contacts that approach then
// out:   their velocities after it, and the impulse of each contact
// theory 1.12: M (v - v-) = sum J^T p, 0 <= p_n _|_ u_n - t >= 0, Coulomb against the end velocity
#pragma once

#include <Eigen/Dense>
#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "base/workers.hpp"
#include "motion/displacement.hpp"
#include "solver/angular_row.hpp"
#include "solver/block_lu.hpp"

namespace talus {

/// A body at the time of the impact; local axes.
struct ImpactBody {
  double per_mass = 0;                  ///< [1/kg]
  Mat3 inertia = Mat3::Identity();      ///< [kg m2]
  Mat3 per_inertia = Mat3::Identity();  ///< its inverse [1/(kg m2)]
  Vec3 position = Vec3::Zero();         ///< of the centroid [m]
  Vec6 velocity = Vec6::Zero();         ///< of the centroid, and spin; in: before, out: after
};

/// How a restitution falls with the approach v > 0: to that at no speed over 1 + per_speed v +
/// per_square v^2. All zero: it does not.
struct RestitutionFall {
  double per_speed = 0;   ///< [s/m]
  double per_square = 0;  ///< [s2/m2]

  [[nodiscard]] double at(double restitution, double v) const {
    return restitution / (1 + v * (per_speed + per_square * v));
  }
};

/// A contact of two of the bodies, or of one with the ground. One point, common to both bodies.
struct ImpactContact {
  int a = 0, b = -1;           ///< bodies; b = -1: the ground
  Vec3 normal = Vec3::Zero();  ///< unit, from B to A
  Vec3 point = Vec3::Zero();   ///< local axes [m]
  double friction = 0;         ///< tan(phi) [-]
  double restitution = 0;      ///< of the normal speed, at no speed [-]
  RestitutionFall fall;        ///< ... at the approach
  RowArm arm;                  ///< of the couple on A that resists its rolling on the ground
  double resting_speed = 0;    ///< a slower approach returns nothing [m/s]
  bool is_bond = false;        ///< holds A to B whatever the force
  // out
  double approach = 0;          ///< normal speed before, < 0: approaches [m/s]
  Vec3 impulse = Vec3::Zero();  ///< on A; B gets the opposite [N s]
};

/// What an impact came to.
struct Impact {
  bool converged = true;
  int passes = 0;          ///< evaluations of all contacts
  double share = 1;        ///< of the restitution: below 1 where all of it would gain energy
  double dissipated = 0;   ///< kinetic energy lost, >= 0 [J]
  double by_friction = 0;  ///< ... of it by friction [J]
  double by_rolling = 0;   ///< ... of it by couples [J]
};

/// Scratch of the solution in the impulses of few contacts (impact_few.hpp). Sizes are bounded, so
/// that nothing of it is on the heap.
struct FewContacts {
  static constexpr std::size_t most = 16;  ///< contacts
  template <int columns>
  using Array = Eigen::Matrix<double, Eigen::Dynamic, columns, 0, 3 * static_cast<int>(most),
                              columns == 1 ? 1 : 3 * static_cast<int>(most)>;
  Array<Eigen::Dynamic> response;    ///< velocity per impulse [1/kg]
  Array<Eigen::Dynamic> matrix;      ///< of Newton's equations [-]
  Array<1> impulse, residual;        ///< [N s]
  Array<1> slip_before, slip;        ///< velocities of the contacts' points [m/s]
  std::array<double, most> feels{};  ///< velocity per impulse of a contact alone [1/kg]
  Eigen::PartialPivLU<Array<Eigen::Dynamic>> factor;
};

/// Scratch of solve_impact.
struct ImpactWork {  // clang-format off
  struct Row {
    Vec3 arm_a = Vec3::Zero(), arm_b = Vec3::Zero();  ///< from the centroids [m]
    double target = 0;                   ///< normal speed that is asked for [m/s]
    double normal_damping = 0, shear_damping = 0;  ///< [kg]
    Vec3 expected = Vec3::Zero();        ///< impulse that the solution is sought around [N s]
    double missing_slip = 0;             ///< of the last round [m/s]
    double slip = -1;                    ///< taken as known; < 0: it is not [m/s]
    Vec3 impulse = Vec3::Zero();         ///< [N s]
    Mat3 tangent = Mat3::Zero();         ///< - d impulse / d velocity [kg]
  };
  /// A body that the ground resists to roll on it.
  struct Turn {
    int body = 0;
    double damping = 0;                  ///< [kg m2]
    double lever = 0;                    ///< turns spin into velocity [m]
    CoupleBounds bounds;                 ///< by the impulses at hand
    CoupleBounds held;                   ///< by those expected
    Vec3 expected = Vec3::Zero();        ///< couple that the solution is sought around [N m s]
    Vec3 couple = Vec3::Zero();          ///< [N m s]
    Mat3 tangent = Mat3::Zero();         ///< - d couple / d spin [kg m2]
    AngularRow law;                      ///< at the last evaluation
  };
  Workers* workers = nullptr;            ///< share the contacts of a large group
  std::vector<Turn> turns, kept_turns;   ///< mostly none
  std::vector<int> turn_of;              ///< of a body, -1: none; empty: no turns         (n_bodies)
  std::vector<Vec3> full_couple;         ///< with all of the restitution
  std::vector<Row> rows, kept;           ///<                                            (n_contacts)
  std::vector<Vec3> full_impulse;        ///< with all of the restitution                (n_contacts)
  Eigen::VectorXd before, velocity, kept_velocity, full, tried, residual, step;  ///<   (6 n_bodies)
  FewContacts few;
  BlockLu<6> matrix;
  std::vector<std::pair<int, int>> edges;
  std::vector<Vec6> blocks;              ///<                                            (n_bodies)
};  // clang-format on

/// Scratch of those who look for hits.
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

/// Largest share f <= 1 of a restitution at which square f^2 + linear f + constant, what it gains
/// or lacks of the energy that it must lose, is not above zero; where none is, the share at which
/// it is least. `square` > 0; at f = 1 the sum is above zero.
[[nodiscard]] double largest_share(double square, double linear, double constant);

}  // namespace talus
