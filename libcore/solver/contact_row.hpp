// libcore/solver/contact_row.hpp: public
// A contact made ready for the solve: one struct for a lone block, an impact and an island. The
// step fills it, contact by contact. Input and result of the contact law are a struct over the
// number type: the same fields are those of one contact and of an island's lanes (RowGroup in
// solver/island.hpp). Islands store only RowGroup and KeptContact; large islands are limited by
// memory bandwidth. theory 1.6 (normal, arm, gap), 1.7, 1.8
#pragma once

#include <cstdint>
#include <type_traits>

#include "contact/contact.hpp"

namespace talus {

/// Normal impulse that no contact reaches; its square is finite.
inline constexpr double no_normal_limit = 1e150;

/// How contacts are evaluated: with the states they came with and friction bounded by the last
/// step's normal impulses (a bound from the predicted overlap has no limit), a new contact and one
/// that would pull more than it pressed by the law; or all with the law.
enum class Evaluation : std::uint8_t { inherited, coupled };

/// A vector and a state of one contact (Number = double), or of several side by side (a vector type
/// of the compiler); in both cases axis k of a vector is v[k].
template <class Number>
using VectorOf = std::conditional_t<std::is_same_v<Number, double>, Vec3, Number[3]>;
template <class Number>
using StateOf = std::conditional_t<std::is_same_v<Number, double>, ContactState, Number>;

/// Input and result of the contact law for one contact. All zero, it never presses.
template <class Number>
struct LawRow {  // clang-format off
  VectorOf<Number> normal;          ///< unit, from B to A
  VectorOf<Number> shear_velocity;  ///< s_n / tau [m/s]
  VectorOf<Number> slip_start;      ///< unit direction of sliding at the start, or zero
  Number bias{};                    ///< b_n: N > 0 needs v_n + b_n < 0 [m/s]
  Number normal_damping{};          ///< D_n, impulse per velocity below -b_n [kg]
  Number shear_damping{};           ///< D_t, impulse per tangential velocity while sticking [kg]
  Number friction{};                ///< tan(phi) [-]
  Number cohesion{};                ///< c A_c h [N s]
  Number tension{};                 ///< t A_c h [N s]
  Number normal_limit{};            ///< the other side yields at this normal impulse [N s]
  // in, for an island: those of the last step, scaled to this one's length; out: the solution
  VectorOf<Number> impulse;         ///< on A; B gets the opposite [N s]
  StateOf<Number> state{};          ///< ContactState
  Number normal_tangent{};          ///< D_n; 0 while the normal impulse is at its limit [kg]
  Number trial_speed{};             ///< of a slipping contact, |v_t + s / tau| [m/s]

  LawRow() {
    for (int k = 0; k < 3; ++k)
      normal[k] = shear_velocity[k] = slip_start[k] = impulse[k] = Number{};
  }
};  // clang-format on

/// Calls see(field of a, same field of b) for all that two rows have in common.
template <class A, class B, class See>
inline void see_fields(A& a, B& b, See&& see) {
  see(a.normal, b.normal);
  see(a.shear_velocity, b.shear_velocity), see(a.slip_start, b.slip_start);
  see(a.bias, b.bias);
  see(a.normal_damping, b.normal_damping), see(a.shear_damping, b.shear_damping);
  see(a.friction, b.friction), see(a.cohesion, b.cohesion), see(a.tension, b.tension);
  see(a.normal_limit, b.normal_limit);
  see(a.impulse, b.impulse), see(a.state, b.state);
  see(a.normal_tangent, b.normal_tangent), see(a.trial_speed, b.trial_speed);
}

/// Data of a contact that an island keeps while its lanes are solved. Velocities and displacements
/// are those of A's point relative to B's. Axes: of A's body at the end of the substep for a lone
/// block, local ones for an island.
struct KeptContact {  // clang-format off
  // bodies that it acts between
  ContactKey key;
  int a = 0, b = -1;              ///< blocks; b = -1: the ground, or a fixed body
  int fixed = -1;                 ///< id of a fixed body, -1: none
  int ground_class = 0;           ///< where b and fixed are -1
  int bond = -1;                  ///< index into State::bonds, -1: none
  int memory = -1;                ///< index into A's memory, -1: new
  int pair = 0;                   ///< island: index into its pairs
  int row = 0;                    ///< island: its number among the rows of the solver
  int cooldown_steps = 0;                  ///< ContactMemory::cooldown_steps
  bool waits = false;             ///< approaches too fast to press without being hit: presses nothing
  // where it is and how it moves in the substep without contact forces
  double gap_start = 0;           ///< gap at the start, without `offset` [m]
  double gap_free = 0;            ///< island: gap at the end [m]
  double speed_start = 0;         ///< normal velocity at the start [m/s]
  double approach = 0;            ///< island: normal velocity, the smaller of start and mean [m/s]
  double offset = 0;              ///< see ContactMemory [m]
  double touch = 0;               ///< island: it touches below this gap [m]
  double hit_time = -1;           ///< island: in the substep, < 0: it is not hit [s]
  double restitution = 0;         ///< of the two surfaces [-]
  double bond_area = 0;           ///< share of its bond, of blocks or with the ground [m2]
  double last_force = 0;          ///< ContactMemory::normal_force [N]
  Vec3 arm = Vec3::Zero();        ///< from the centroid of A, both in the middle of the substep [m]
  Vec3 arm_start = Vec3::Zero();  ///< from the centroid of A to A's point, at the start [m]
  Vec3 free_move = Vec3::Zero();  ///< displacement [m]
  Vec3 shear = Vec3::Zero();      ///< s_n [m]

  [[nodiscard]] bool is_hit() const { return hit_time >= 0; }
};  // clang-format on

/// A bond that breaks within the step makes the law jump, and a step with a jump may have no
/// solution: an island takes an intact bond as one without limit, compares its load with the
/// limits afterwards and solves again without the bonds that were exceeded.
struct ContactRow : KeptContact, LawRow<double> {  // clang-format off
  int contact = 0;                ///< with the ground: index into the contacts found
  double last_stiffness = 0;      ///< ContactMemory::stiffness, 0: new [N/m]
  bool stuck = false;             ///< at the end of the last step
  double slip_speed = 0;          ///< of its point when the substep begins [m/s]
  Vec3 drift = Vec3::Zero();      ///< velocity at the end is T(arm) v + drift [m/s]
  double tilt_speed = 0;          ///< by how much its normal differs at the end, part of drift [m/s]
  // a lone block: the law at its last evaluation
  double cap = 0;                 ///< bound of the tangential impulse [N s]
  Vec3 trial = Vec3::Zero();      ///< v_t + s / tau [m/s]
  Vec3 direction = Vec3::Zero();  ///< of slip in the middle of the step, unit; while slipping

  ContactRow() { normal_limit = no_normal_limit; }
};  // clang-format on

}  // namespace talus
