// libcore/solver/island.hpp
// An island: bodies that touch each other, directly or through other bodies, over one time step.
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
#include <span>
#include <vector>

#include "contact/contact.hpp"
#include "motion/displacement.hpp"
#include "solver/angular_row.hpp"
#include "solver/contact_row.hpp"

namespace talus {

/// Two doubles, the compiler's vector type: a register of any x86-64, plain code elsewhere with the
/// same bits. (Four at a time need AVX; without it the compiler takes them through memory.)
using Two __attribute__((vector_size(16))) = double;

/// Two rows of one pair side by side, index = axis, then row; the drift of a ContactRow is in bias
/// and shear_velocity. A lane without a contact is all zero but for the limit, and never presses.
struct RowGroup : LawRow<Two> {
  Two arm[3]{};        ///< from the centroid of A [m]
  Two slip_tangent{};  ///< of a slipping contact across its direction [kg]
  Two used_tangent{};  ///< slip_tangent when the tangent was last summed [kg]

  RowGroup() { normal_limit = Two{no_normal_limit, no_normal_limit}; }
};

/// A row in its group.
template <class Group>
class RowIn {
 public:
  RowIn(Group& group, int lane) : group_(group), lane_(lane) {}

  [[nodiscard]] Vec3 normal() const { return vector(&RowGroup::normal); }
  [[nodiscard]] Vec3 arm() const { return vector(&RowGroup::arm); }
  [[nodiscard]] Vec3 impulse() const { return vector(&RowGroup::impulse); }
  [[nodiscard]] double normal_impulse() const { return normal().dot(impulse()); }
  [[nodiscard]] double bias() const { return value(&RowGroup::bias); }
  [[nodiscard]] double normal_damping() const { return value(&RowGroup::normal_damping); }
  [[nodiscard]] double shear_damping() const { return value(&RowGroup::shear_damping); }
  [[nodiscard]] double normal_limit() const { return value(&RowGroup::normal_limit); }
  [[nodiscard]] ContactState state() const {
    return static_cast<ContactState>(static_cast<int>(value(&RowGroup::state)));
  }

  /// Input and result of the contact law.
  [[nodiscard]] LawRow<double> law() const {
    LawRow<double> out;
    see_fields(group_, out, [lane = lane_](const auto& of, auto& value) {
      if constexpr (std::is_array_v<std::remove_reference_t<decltype(of)>>)
        for (int k = 0; k < 3; ++k) value[k] = of[k][lane];
      else
        value = static_cast<std::remove_reference_t<decltype(value)>>(of[lane]);
    });
    return out;
  }
  void set_law(const LawRow<double>& law) const {
    see_fields(group_, law, [lane = lane_](auto& of, const auto& value) {
      if constexpr (std::is_array_v<std::remove_reference_t<decltype(of)>>)
        for (int k = 0; k < 3; ++k) of[k][lane] = value[k];
      else
        of[lane] = static_cast<double>(value);
    });
  }

  /// Impulse per velocity, normal and tangential, from now on [kg].
  void set_damping(double normal, double shear) const {
    set(&RowGroup::normal_damping, normal);
    set(&RowGroup::shear_damping, shear);
  }
  void set_bias(double bias) const { set(&RowGroup::bias, bias); }
  void set_shear_velocity(const Vec3& v) const { set_vector(&RowGroup::shear_velocity, v); }
  void set_slip_start(const Vec3& direction) const { set_vector(&RowGroup::slip_start, direction); }
  void set_arm(const Vec3& arm) const { set_vector(&RowGroup::arm, arm); }
  void set_friction(double friction) const { set(&RowGroup::friction, friction); }
  /// A contact without an impulse, which presses by this damping when it closes; 0: never.
  void begin_open(double normal, double shear) const {
    set_damping(normal, shear);
    set(&RowGroup::normal_tangent, normal);
    set(&RowGroup::state, static_cast<double>(ContactState::open));
    set_vector(&RowGroup::impulse, Vec3::Zero());
  }

  // for the solver alone
  [[nodiscard]] double value(Two RowGroup::*field) const { return (group_.*field)[lane_]; }
  [[nodiscard]] Vec3 vector(const Two (RowGroup::*field)[3]) const {
    const auto& of = group_.*field;
    return {of[0][lane_], of[1][lane_], of[2][lane_]};
  }
  void set(Two RowGroup::*field, double value) const { (group_.*field)[lane_] = value; }

 private:
  void set_vector(Two (RowGroup::*field)[3], const Vec3& value) const {
    for (int k = 0; k < 3; ++k) (group_.*field)[k][lane_] = value[k];
  }

  Group& group_;
  int lane_;
};
/// A row as a step sees it. It knows nothing of groups and lanes.
using IslandRow = RowIn<RowGroup>;
using ConstIslandRow = RowIn<const RowGroup>;

/// Contacts of one pair of bodies, or of one body with the ground: consecutive rows, in groups of
/// their own.
struct BodyPair {
  int a = 0;          ///< body of the island
  int b = -1;         ///< body of the island, != a; -1: the ground
  int row_begin = 0;  ///< rows [row_begin, row_end), even
  int row_end = 0;
  /// In, for a solution that continues the last one: rows, centroids or free motion of a body are
  /// not those of that one. Out: false.
  bool changed = true;
  int angular = -1;           ///< index into Island::angular, -1: no couple beside the points
  Vec3 shift = Vec3::Zero();  ///< from B to A when its contacts press; without B: zero [m]
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
  std::vector<RowGroup> rows;      ///< row r is lane r % 2 of rows[r / 2]; pair by pair (n_groups)
  std::vector<AngularRow> angular; ///< of the pairs that have one, mostly none
  std::vector<RowArm> arms;        ///< of their rows, pair by pair
};  // clang-format on

[[nodiscard]] inline int n_bodies(const Island& island) {
  return static_cast<int>(island.mass.size());
}

[[nodiscard]] inline ConstIslandRow row_of(const Island& island, int r) {
  return {island.rows[r / 2], r % 2};
}
[[nodiscard]] inline IslandRow row_of(Island& island, int r) { return {island.rows[r / 2], r % 2}; }

/// The groups of a pair.
[[nodiscard]] inline std::span<RowGroup> groups_of(Island& island, const BodyPair& pair) {
  const auto begin = static_cast<std::size_t>(pair.row_begin / 2);
  return std::span(island.rows)
      .subspan(begin, static_cast<std::size_t>(pair.row_end + 1) / 2 - begin);
}

/// The bounds that the normal impulses of a pair give to its angular row.
[[nodiscard]] inline CoupleBounds couple_bounds(const Island& island, const BodyPair& pair) {
  CoupleBounds bounds;
  const auto arm_begin = static_cast<std::size_t>(island.angular[pair.angular].arm_begin);
  for (int r = pair.row_begin; r < pair.row_end; ++r) {
    const ConstIslandRow row = row_of(island, r);
    const auto i = static_cast<std::size_t>(r - pair.row_begin);
    bounds.add(island.arms[arm_begin + i], row.normal_impulse(), row.normal());
  }
  return bounds;
}

/// Adds a pair without rows, its bodies where they are.
void open_pair(int a, int b, Island& island);
/// Adds the row of a contact to the last pair and returns its number. One that waits gets the
/// place alone and presses nothing until it is hit.
int add_row(const ContactRow& contact, Island& island);

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
  const double m_a = island.mass[pair.a](0, 0);
  if (pair.b < 0) return m_a;
  const double m_b = island.mass[pair.b](0, 0);
  return m_a * (m_b / (m_a + m_b));
}

}  // namespace talus
