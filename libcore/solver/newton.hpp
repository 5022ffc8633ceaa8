// libcore/solver/newton.hpp: public
// Contact impulses of one block: semismooth Newton on the balance of momentum.
// theory 1.7, 1.10; docs/developing/design-notes.md (why the friction bound is iterated inside the
// step)
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <span>

#include "motion/displacement.hpp"
#include "solver/angular_row.hpp"
#include "solver/contact_row.hpp"

namespace talus {

/// One block over one step in its own axes at the predicted pose. Dof is 6 (rigid) or 12.
/// Velocity: that of the centroid, spin, and for 12 the strain rates.
template <int Dof>
struct BlockSystem {
  using Vec = Eigen::Matrix<double, Dof, 1>;
  using Mat = Eigen::Matrix<double, Dof, Dof>;
  Mat mass;                       ///< M plus the damping of the elastic strains [kg, kg m2]
  Vec free_velocity;              ///< without contact [m/s, rad/s, 1/s]
  Vec velocity;                   ///< in: first guess; out: at the end of the step
  double tolerance = 0;           ///< largest residual, as a velocity of the block's points [m/s]
  std::span<AngularRow> angular;  ///< couples beside the rows, bounded by them; mostly none
  std::span<const RowArm> arms;   ///< of their rows
};

struct NewtonResult {
  bool converged = false;
  int passes = 0;  ///< evaluations of all contacts
};

/// Solves M (v - v_free) = sum J^T p(J v) + couples; sets `impulse` and `state` of the rows.
///
/// Newton with the friction bound coupled to the normal impulse: whole steps at first, then with a
/// line search. A block that has not settled after `max_passes` relaxes (solver/relax.hpp), in
/// twelve times as many steps.
template <int Dof>
NewtonResult solve_contacts(BlockSystem<Dof>& system, std::span<ContactRow> rows, int max_passes);

/// Velocity of a body point by the generalised velocity, T(X) v.
template <int Dof>
[[nodiscard]] inline Vec3 point_velocity(const Eigen::Matrix<double, Dof, 1>& v, const Vec3& X) {
  Vec3 w(v[0] + (v[4] * X.z() - v[5] * X.y()), v[1] + (v[5] * X.x() - v[3] * X.z()),
         v[2] + (v[3] * X.y() - v[4] * X.x()));
  if constexpr (Dof == 12) {
    w.x() += v[6] * X.x() + (v[10] * X.z() + v[11] * X.y()) / 2;
    w.y() += v[7] * X.y() + (v[9] * X.z() + v[11] * X.x()) / 2;
    w.z() += v[8] * X.z() + (v[9] * X.y() + v[10] * X.x()) / 2;
  }
  return w;
}

/// Generalised impulse T(X)^T p.
template <int Dof>
[[nodiscard]] inline Eigen::Matrix<double, Dof, 1> generalised(const Vec3& X, const Vec3& p) {
  Eigen::Matrix<double, Dof, 1> f;
  f.template head<3>() = p;
  f.template segment<3>(3) = X.cross(p);
  if constexpr (Dof == 12) f.template tail<6>() = strain_load(X, p);
  return f;
}

/// Velocity of a body point per impulse along the normal there, and the largest along any tangent.
struct Mobility {
  double normal, tangent;  ///< [1/kg]
};
[[nodiscard]] inline Mobility mobility(double inverse_mass, const Vec3& inverse_inertia,
                                       const Vec3& X, const Vec3& n) {
  const Vec3 sq = X.cwiseAbs2(), turn = X.cross(n);
  const double normal = inverse_mass + turn.cwiseAbs2().dot(inverse_inertia);
  const double all = 3 * inverse_mass + inverse_inertia.dot(Vec3::Constant(sq.sum()) - sq);
  return {normal, std::max(normal, all - normal)};
}

extern template NewtonResult solve_contacts<6>(BlockSystem<6>&, std::span<ContactRow>, int);
extern template NewtonResult solve_contacts<12>(BlockSystem<12>&, std::span<ContactRow>, int);

}  // namespace talus
