// libcore/dda/island.hpp
// An island: bodies that touch each other, directly or through others, over one time step.
// in:     masses, free motion and contacts from the step that assembles them, in local axes
// out:    velocities at the end of the step and the impulse of every contact
// theory: 1.6 (relative map B_c = [T_A, -T_B]), 1.7, 3.5
//
// A contact has one point, common to both bodies, so that its two impulses are opposite on one
// line: momentum and angular momentum are kept to rounding. With one point, all contacts of a pair
// act through the relative motion of the two bodies as seen from A's centroid,
//   u = v_A - X v_B,   X v_B: the velocity field of B at A's centroid,   w = T(r_A) u,
// so that a pair costs one tangent W = sum T(r_A)^T K T(r_A) instead of three blocks.
#pragma once

#include <Eigen/LU>
#include <vector>

#include "contact/contact.hpp"
#include "dda/contact_row.hpp"
#include "dda/displacement.hpp"

namespace talus {

/// A contact of an island. Velocities are those of A's point relative to B's.
///
/// A known part of the point's velocity (ContactRow::drift) goes into bias and shear_velocity.
/// A bond that breaks within the step makes the law jump, and a step with a jump may have no
/// solution: give an intact bond without limit (`held` of island_assembly.cpp), compare its impulse
/// with the limits afterwards and solve again without the bonds that were exceeded.
struct IslandRow {  // clang-format off
  // filled by the caller; vectors in local axes
  Vec3 normal = Vec3::Zero();          ///< unit, from B to A
  Vec3 arm = Vec3::Zero();             ///< contact point from the centroid of A [m]
  Vec3 shear_velocity = Vec3::Zero();  ///< s_n / tau, tangential, plus the tangential drift [m/s]
  Vec3 slip_start = Vec3::Zero();      ///< unit direction of sliding at the step's start, or zero
  double bias = 0;              ///< b_n: N > 0 needs v_n + b_n < 0; with the drift's part [m/s]
  double normal_damping = 0;    ///< D_n, impulse per velocity below -b_n [kg]
  double shear_damping = 0;     ///< D_t, impulse per tangential velocity while sticking [kg]
  double friction = 0;          ///< tan(phi) [-]
  double cohesion_impulse = 0;  ///< c A_c h [N s]
  double tension_impulse = 0;   ///< t A_c h [N s]
  double normal_limit = no_normal_limit;  ///< the other side gives way at this normal impulse [N s]
  // in: those of the last step, scaled to this one's length; out: the solution
  Vec3 impulse = Vec3::Zero();  ///< on A; B gets the opposite [N s]
  ContactState state = ContactState::open;  ///< in: inherited; a new contact is `open`
  bool waits_for_impact = false;  ///< presses nothing
};  // clang-format on

/// Contacts of one pair of bodies, or of one body with the ground: consecutive rows.
struct BodyPair {
  int a = 0;          ///< body of the island
  int b = -1;         ///< body of the island, != a; -1: the ground
  int row_begin = 0;  ///< rows [row_begin, row_end)
  int row_end = 0;
  bool changed = true;  ///< rows or centroids are not those of the solution that is continued
};

/// One island of rigid bodies over one step. Velocity: of the centroid, and spin, in local axes;
/// `mass` is the matrix that belongs to it.
struct Island {  // clang-format off
  std::vector<Mat6> mass;          ///< M = m and the inertia in local axes [kg, kg m2] (n_bodies)
  std::vector<Vec6> free_velocity; ///< without contact [m/s, rad/s]                    (n_bodies)
  std::vector<Vec6> velocity;      ///< in: first guess; out: at the end of the step    (n_bodies)
  std::vector<Vec3> position;      ///< centroids [m]                                   (n_bodies)
  std::vector<double> radius;      ///< turns spin into velocity [m]                    (n_bodies)
  std::vector<BodyPair> pairs;     ///< a pair may appear more than once                (n_pairs)
  std::vector<IslandRow> rows;     ///< grouped by pair                                 (n_rows)
};  // clang-format on

[[nodiscard]] inline int n_bodies(const Island& island) {
  return static_cast<int>(island.mass.size());
}

/// M v and M^-1 p of one body.
[[nodiscard]] inline Vec6 times_mass(const Mat6& M, const Vec6& v) {
  Vec6 p;
  p.head<3>() = M(0, 0) * v.head<3>();
  p.segment<3>(3) = M.block<3, 3>(3, 3).lazyProduct(v.segment<3>(3));
  return p;
}
[[nodiscard]] inline Vec6 solve_mass(const Mat6& M, const Vec6& p) {
  Vec6 v;
  v.head<3>() = p.head<3>() / M(0, 0);
  v.segment<3>(3) = M.block<3, 3>(3, 3).inverse() * p.segment<3>(3);
  return v;
}

/// m_a m_b / (m_a + m_b); m_a on the ground [kg].
[[nodiscard]] inline double reduced_mass(const Island& island, const BodyPair& pair) {
  const double m_a = island.mass[static_cast<std::size_t>(pair.a)](0, 0);
  if (pair.b < 0) return m_a;
  const double m_b = island.mass[static_cast<std::size_t>(pair.b)](0, 0);
  return m_a * (m_b / (m_a + m_b));
}

}  // namespace talus
