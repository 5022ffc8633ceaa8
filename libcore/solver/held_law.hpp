// libcore/solver/held_law.hpp
// The contact law of an island's lanes while friction bounds are held: -gradient of the convex
//   E(w) = D_n / 2 <-(v_n + b)>^2 + H(f),  f^2 = |x|^2 + s <x . e>^2,  x = v_t + s_n / tau,
// with H(f) = D_t f^2 / 2 up to f = c / D_t, beyond c f - c^2 / (2 D_t), and its second derivative.
// c and s are held, e is the direction of slip at the start of the step. Friction acts whether or
// not the contact presses, and of what gives way E grows no faster than its limit times v_n.
// Where c and s are those of what it finds (hold_friction), this is the law of contact_law.hpp:
// that slips along x + s <x . e> e, the gradient of f, too. theory 1.7
#pragma once

#include "solver/contact_law.hpp"
#include "solver/island.hpp"

namespace talus {
namespace {

/// The law at velocities `w` of the contacts' points.
template <class V, class Rows>
[[gnu::always_inline]] inline void held_law(const Rows& rows, const V (&w)[3], Found<V>& found) {
  V normal[3], start[3], shear[3], v_n, bias, damping, shear_damping, limit, tension, bound, share;
  rows.read(&RowGroup::normal, normal);
  rows.read(&RowGroup::slip_start, start);
  rows.read(&RowGroup::shear_velocity, shear);
  rows.read(&RowGroup::bias, bias);
  rows.read(&RowGroup::normal_damping, damping);
  rows.read(&RowGroup::shear_damping, shear_damping);
  rows.read(&RowGroup::normal_limit, limit);
  rows.read(&RowGroup::tension, tension);
  rows.read(&RowGroup::held_bound, bound);
  rows.read(&RowGroup::held_share, share);
  const V none{};
  dot(normal, w, v_n);
  V p_n = -damping * (v_n + bias);
  const Mask<V> below_limit = p_n<limit, presses = p_n> - tension;
  p_n = below_limit ? p_n : limit;
  p_n = presses ? p_n : none;
  found.normal_tangent = below_limit & presses ? damping : none;
  V speed_sq, along, norm_sq, norm;
  for (int k = 0; k < 3; ++k) found.trial[k] = w[k] - v_n * normal[k] + shear[k];
  dot(found.trial, found.trial, speed_sq);
  dot(start, found.trial, along);
  along = along > 0 ? along : none;
  const V on_start = share * along;
  norm_sq = speed_sq + on_start * along;
  const Mask<V> within = (shear_damping * shear_damping * norm_sq <= bound * bound) & (bound > 0);
  const Mask<V> rubs = none_of<V>(within) & (bound > 0);
  square_root(rubs ? norm_sq : none + 1, norm);
  const V per_norm = 1 / norm, force = within ? shear_damping : rubs ? bound * per_norm : none;
  for (int k = 0; k < 3; ++k)
    found.impulse[k] = p_n * normal[k] - force * (found.trial[k] + on_start * start[k]);
  found.state = within           ? all_in<V>(ContactState::stick)
                : rubs | presses ? all_in<V>(ContactState::slip)
                                 : all_in<V>(ContactState::open);
  // what is left of the second derivative: of one that slips across x, of one that sticks along e
  const V stretch = along > 0 ? 1 + share : none + 1;
  const V across = force * stretch * speed_sq * per_norm * per_norm;
  found.slip_tangent = rubs ? across : (within & (along > 0)) ? shear_damping * share : none;
  found.trial_speed = norm;
  found.rubs = false;
}

}  // namespace
}  // namespace talus
