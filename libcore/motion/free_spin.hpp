// libcore/motion/free_spin.hpp: public
// Free spin of a rigid body in closed form: the attitude at any time, at a price that neither the
// time nor the turns in between enter.
// in:    attitude, angular momentum, principal moments at time 0
// out:   attitude at time t, to rounding
// Jacobi's solution: the momentum in body axes goes as (cn, sn, dn), and the turn about it is even
// in time but for the argument of a theta function (Whittaker, Analytical Dynamics, par. 69).
#pragma once

#include <array>

#include "motion/pose.hpp"

namespace talus {

/// A complex number, or the angle of one of length 1. (std::complex looks for infinities.)
struct Phasor {
  double re = 1, im = 0;
};

/// A free spin, made ready to be asked for attitudes; computed by free_spin().
struct FreeSpin {  // clang-format off
  enum class Kind {
    still,     ///< no momentum
    axis,      ///< about the principal axis `e[2]`, steadily
    symmetric, ///< two equal moments: precesses steadily
    elliptic,  ///< by theta functions
    series,    ///< too near to the flip about the middle axis: power series from time 0
  };
  Kind kind = Kind::still;
  Quat attitude = Quat::Identity();  ///< at time 0
  Vec3 L = Vec3::Zero();             ///< angular momentum, local axes [kg m2/s]
  Vec3 inertia = Vec3::Ones();       ///< principal moments [kg m2]
  // elliptic: axis e[1] is the middle one, and e[2] the one that the spin goes around
  static constexpr int most_terms = 13;
  std::array<int, 3> e{0, 1, 2};     ///< body axes in this order
  double sense = 1;                  ///< -1: e[1] is turned round, which makes them right-handed
  Vec3 amplitude = Vec3::Zero();     ///< of cn, sn, dn, as shares of |L|; theta constants included
  double v_start = 0, v_rate = 0;    ///< argument of the theta functions, pi u / (2 K); [1/s]
  double phase_rate = 0;             ///< the even part of the turn about L [rad/s]
  double phase_sign = 1;             ///< of the argument of theta_4(v + iy) in that turn
  Phasor shifted_start;              ///< theta_4(v + iy) at time 0
  Quat base = Quat::Identity();      ///< attitude(t) = base * turn(t)
  int n_terms = 0;                   ///< of all series
  struct Term {
    double odd = 0, odd_signed = 0;    ///< q^(n (n + 1)), of theta_2; (-1)^n times it, of theta_1
    double even = 0, even_signed = 0;  ///< 2 q^(n n), of theta_3; (-1)^n times it, of theta_4
    double re = 0, im = 0;             ///< of theta_4(v + iy)
  };
  std::array<Term, most_terms> terms;
};  // clang-format on

/// The free spin of a body with principal moments `inertia`, axes = body axes, and angular momentum
/// `L` in local axes.
[[nodiscard]] FreeSpin free_spin(const Quat& attitude, const Vec3& L, const Vec3& inertia);

/// Attitude after `t` seconds.
[[nodiscard]] Quat attitude_after(const FreeSpin& spin, double t);

}  // namespace talus
