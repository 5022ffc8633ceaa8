// libcore/solver/contact_law.hpp
// Law talus: the impulse of a contact as a function of the velocity of its point, once for a lone
// block and an impact (V = double: solver/one_contact.hpp) and for an island (V = lanes of two or
// four contacts: solver/row_lanes.hpp).
// in:    velocity of the point, numbers of the contact (fields of LawRow, over an accessor)
// out:   impulse, state, tangents
// paper: Eq. (16)-(24) and the three patterns of Fig. 8; theory 1.7 (return mapping), 1.8
//
// The law works with impulses over a step. Normal: p_n = max(0, -D_n (v_n + b)), where b holds
// the overlap at the start of the step, so that a resting contact of stiffness k_n presses with k_n
// times its overlap, and one that just closes takes the approach away and no more; where the other
// side yields at a force (a panel of a fence), p_n stays at that limit. Tangent: the
// trial -D_t (v_t + s / tau) is the impulse while it stays below tan(phi) p_n + c A_c h, else the
// contact slips with tan(phi) p_n along the mean of the slip directions at the step's start and
// end: second order in the step, which the end direction alone is not (it errs by 1e-3 on an
// oblique slide).
//
// All templates are local to the file that includes them, which compiles them for its own
// processor, and inline: this is the innermost loop of the engine. Functions take vectors of V by
// reference, since a vector of four cannot be an argument where there is no AVX.
#pragma once

#include <cmath>

#include "solver/contact_row.hpp"

namespace talus {

namespace {

// --- arithmetic of the number type -------------------------------------------------------------

template <class V>
inline constexpr bool is_lanes = !std::is_same_v<V, double>;

/// Contacts in V.
template <class V>
inline constexpr int n_contacts_in = sizeof(V) / sizeof(double);

/// Truth of each contact: lanes of -1 and 0, or a bool.
template <class V>
using Mask = decltype(V{} < V{});

template <class V>
[[gnu::always_inline]] inline Mask<V> none_of(const Mask<V>& mask) {
  if constexpr (is_lanes<V>)
    return ~mask;
  else
    return !mask;
}

// The contacts of a mask as bits.
template <class V>
[[gnu::always_inline]] inline int bits(const Mask<V>& mask) {
  if constexpr (!is_lanes<V>) {
    return mask ? 1 : 0;
  } else {
#if defined(TALUS_FOUR_LANES)
    if constexpr (n_contacts_in<V> == 4) return __builtin_ia32_movmskpd256(V(mask));
#endif
#if defined(__SSE2__)
    if constexpr (n_contacts_in<V> == 2) return __builtin_ia32_movmskpd(V(mask));
#else
    int set = 0;
    for (int i = 0; i < n_contacts_in<V>; ++i) set |= (mask[i] != 0) << i;
    return set;
#endif
  }
}

template <class V>
[[gnu::always_inline]] inline void square_root(const V& x, V& out) {
  if constexpr (!is_lanes<V>) {
    out = std::sqrt(x);
  } else {
#if defined(TALUS_FOUR_LANES)
    if constexpr (n_contacts_in<V> == 4) return void(out = __builtin_ia32_sqrtpd256(x));
#endif
#if defined(__SSE2__)
    if constexpr (n_contacts_in<V> == 2) out = __builtin_ia32_sqrtpd(x);
#else
    for (int i = 0; i < n_contacts_in<V>; ++i) out[i] = std::sqrt(x[i]);
#endif
  }
}

template <class V>
[[gnu::always_inline]] inline void dot(const V (&a)[3], const V (&b)[3], V& out) {
  out = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

template <class V>
[[gnu::always_inline]] inline StateOf<V> all_in(ContactState state) {
  if constexpr (is_lanes<V>)
    return V{} + static_cast<double>(state);
  else
    return state;
}

// --- the law -----------------------------------------------------------------------------------

/// Result of the law, contact by contact. Of open contacts no more than impulse and state.
template <class V>
struct Found {
  V impulse[3];  ///< on A [N s]
  StateOf<V> state;
  V normal_tangent;   ///< see LawRow
  V cap;              ///< bound of the tangential impulse [N s]
  V trial[3];         ///< v_t + s / tau [m/s]
  V trial_speed;      ///< of a slipping contact, |trial| [m/s]
  V slip_tangent;     ///< lanes: of a slipping contact across its direction [kg]
  V direction[3];     ///< one contact: of slip, unit; while slipping
  bool rubs = false;  ///< one slips against friction: trial_speed and the last two are set
};

/// Bounds of the impulses of contacts.
template <class V>
struct Strength {
  V friction, cohesion, tension;

  /// Mohr-Coulomb: of the tangential impulse at normal impulse p_n.
  [[gnu::always_inline]] void bound(const V& p_n, V& cap) const {
    cap = friction * (p_n > 0 ? p_n : V{}) + cohesion;
  }
};

// Which contacts press at normal impulse p_n, and their friction bounds.
template <class V, class Rows>
[[gnu::always_inline]] inline void press(const Rows& rows, const V (&normal)[3], const V& p_n,
                                         const StateOf<V>& state_before, Evaluation evaluation,
                                         Mask<V>& closed, V& cap) {
  using Row = typename Rows::Row;
  Strength<V> strength;
  rows.read(&Row::friction, strength.friction);
  rows.read(&Row::cohesion, strength.cohesion);
  rows.read(&Row::tension, strength.tension);
  closed = p_n > -strength.tension;
  strength.bound(p_n, cap);
  if (evaluation == Evaluation::coupled) return;
  V last[3], last_p_n, last_cap;
  rows.read(&Row::impulse, last);
  dot(normal, last, last_p_n);
  strength.bound(last_p_n, last_cap);
  const Mask<V> is_new = state_before == all_in<V>(ContactState::open);
  const Mask<V> slips = (state_before == all_in<V>(ContactState::slip)) |
                        ((strength.friction + strength.cohesion) <= 0);
  cap = is_new ? cap : slips ? last_cap : V{} + no_normal_limit;
  // a contact that just touches may be pushed; one that would pull more than it pressed has parted
  closed = (p_n >= -strength.tension) | (none_of<V>(is_new) & (p_n >= -last_p_n));
}

// Which contacts the bound lets stick. Lanes compare squares, so that no root is taken of those
// that do; one contact, which without friction sticks while it is at rest, compares as it is.
template <class V>
[[gnu::always_inline]] inline void hold(const V& shear_damping, const V& speed_sq, Found<V>& found,
                                        Mask<V>& within) {
  const V& cap = found.cap;
  if constexpr (is_lanes<V>) {
    within = (shear_damping * shear_damping * speed_sq <= cap * cap) & (cap > 0);
  } else {
    square_root(speed_sq, found.trial_speed);
    within = shear_damping * found.trial_speed <= cap;
  }
}

// Friction against trial + share a start, a = start . trial, from start and trial as they come.
// With t the angle between these two it is at atan(tan(t) / (1 + share)), which turns by
// (1 + share) / (1 + share (2 + share) cos^2 t) as t grows.
template <class V>
[[gnu::always_inline]] inline void rub_along_mean(const Mask<V>& slip, const V (&start)[3],
                                                  const V& share, const V& speed_sq,
                                                  Found<V>& found) {
  V a, length;
  dot(start, found.trial, a);
  a = a > 0 ? a : V{};
  const V length_sq = speed_sq + share * (2 + share) * a * a;
  square_root(slip ? length_sq : V{} + 1, length);
  const V per_length = 1 / length, force = slip ? found.cap * per_length : V{};
  const V on_start = force * share * a;
  for (int k = 0; k < 3; ++k) found.impulse[k] -= force * found.trial[k] + on_start * start[k];
  found.slip_tangent = a > 0 ? (1 + share) * force * found.trial_speed * per_length : force;
}

// The same of one contact, from unit vectors: its exact tangent asks for their mean.
[[gnu::always_inline]] inline void rub_along_mean(bool, const double (&start)[3], double share,
                                                  double, Found<double>& found) {
  const double per_speed = 1 / found.trial_speed;
  double(&mean)[3] = found.direction;
  double along, length_sq;
  for (int k = 0; k < 3; ++k) mean[k] = per_speed * found.trial[k];
  dot(start, mean, along);
  if (along > 0)
    for (int k = 0; k < 3; ++k) mean[k] += (share * along) * start[k];
  dot(mean, mean, length_sq);
  const double per_length = 1 / std::sqrt(length_sq);
  for (int k = 0; k < 3; ++k) mean[k] *= per_length;
  for (int k = 0; k < 3; ++k) found.impulse[k] -= found.cap * mean[k];
}

// Friction on contacts that slip: from the end direction where slip just begins (share 0) to the
// mean of those at the step's start and end.
template <class V, class Rows>
[[gnu::always_inline]] inline void rub(const Rows& rows, const Mask<V>& slip, const V& speed_sq,
                                       const V& shear_damping, Found<V>& found) {
  V start[3];
  rows.read(&Rows::Row::slip_start, start);
  if constexpr (is_lanes<V>) square_root(slip ? speed_sq : V{} + 1, found.trial_speed);
  const V share = slip ? 1 - found.cap / (shear_damping * found.trial_speed) : V{};
  rub_along_mean(slip, start, share, speed_sq, found);
}

// Tangential impulses of the contacts that press.
template <class V, class Rows>
[[gnu::always_inline]] inline void stick_or_slip(const Rows& rows, const V (&normal)[3],
                                                 const V (&w)[3], const V& v_n, const V& p_n,
                                                 const Mask<V>& closed, Found<V>& found) {
  using Row = typename Rows::Row;
  V shear[3], shear_damping, speed_sq;
  rows.read(&Row::shear_velocity, shear);
  rows.read(&Row::shear_damping, shear_damping);
  for (int k = 0; k < 3; ++k) found.trial[k] = w[k] - v_n * normal[k] + shear[k];
  dot(found.trial, found.trial, speed_sq);
  Mask<V> within;
  hold(shear_damping, speed_sq, found, within);
  const Mask<V> stick = closed & within, slip = closed & none_of<V>(within);
  const V on_normal = closed ? p_n : V{}, on_trial = stick ? shear_damping : V{};
  for (int k = 0; k < 3; ++k) found.impulse[k] = on_normal * normal[k] - on_trial * found.trial[k];
  found.state = stick  ? all_in<V>(ContactState::stick)
                : slip ? all_in<V>(ContactState::slip)
                       : all_in<V>(ContactState::open);
  const Mask<V> rubs = slip & (found.cap > 0);
  found.rubs = bits<V>(rubs) != 0;
  if (found.rubs) rub(rows, rubs, speed_sq, shear_damping, found);
}

/// The law at velocities `w` of the contacts' points; Rows reads fields of its LawRow into V.
template <class V, class Rows>
[[gnu::always_inline]] inline void contact_law(const Rows& rows, const V (&w)[3],
                                               const StateOf<V>& state_before,
                                               Evaluation evaluation, Found<V>& found) {
  using Row = typename Rows::Row;
  V normal[3], v_n, bias, damping, limit;
  rows.read(&Row::normal, normal);
  rows.read(&Row::bias, bias);
  rows.read(&Row::normal_damping, damping);
  rows.read(&Row::normal_limit, limit);
  dot(normal, w, v_n);
  V p_n = -damping * (v_n + bias);
  const Mask<V> below_limit = p_n < limit;
  p_n = below_limit ? p_n : limit;
  found.normal_tangent = below_limit ? damping : V{};
  Mask<V> closed;
  press(rows, normal, p_n, state_before, evaluation, closed, found.cap);
  found.state = all_in<V>(ContactState::open);
  found.slip_tangent = V{};
  for (int k = 0; k < 3; ++k) found.impulse[k] = V{};
  if (bits<V>(closed) != 0) stick_or_slip(rows, normal, w, v_n, p_n, closed, found);
}

}  // namespace
}  // namespace talus
