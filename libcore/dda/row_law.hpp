// libcore/dda/row_law.hpp
// The contact law over lanes, for row_groups.cpp and row_groups_avx2.cpp alone: V is a vector of
// two or four doubles, that is the rows of one group or of two. Whatever the width, each row sees
// the same operations in the same order, and so has the same bits. All of it is local to the file
// that includes it, which compiles it for its own processor.
#pragma once

#include <cmath>

#include "dda/pair_evaluation.hpp"

namespace talus {
namespace {

template <class V>
inline constexpr int n_groups = sizeof(V) / sizeof(Two);

template <class V>
using Mask = decltype(V{} < V{});

template <class V>
[[gnu::always_inline]] inline void dot(const V (&a)[3], const V (&b)[3], V& out) {
  out = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

template <class V>
[[gnu::always_inline]] inline void square_root(const V& x, V& out) {
#if defined(TALUS_FOUR_LANES)
  if constexpr (n_groups<V> == 2) return void(out = __builtin_ia32_sqrtpd256(x));
#endif
#if defined(__SSE2__)
  if constexpr (n_groups<V> == 1) out = __builtin_ia32_sqrtpd(x);
#else
  for (int i = 0; i < 2 * n_groups<V>; ++i) out[i] = std::sqrt(x[i]);
#endif
}

// The lanes of a mask as bits.
template <class V>
[[gnu::always_inline]] inline int bits(const Mask<V>& mask) {
#if defined(TALUS_FOUR_LANES)
  if constexpr (n_groups<V> == 2) return __builtin_ia32_movmskpd256(V(mask));
#endif
#if defined(__SSE2__)
  if constexpr (n_groups<V> == 1) return __builtin_ia32_movmskpd(Two(mask));
#else
  int set = 0;
  for (int i = 0; i < 2 * n_groups<V>; ++i) set |= (mask[i] != 0) << i;
  return set;
#endif
}

/// As many groups as V has rows for, side by side.
template <class V>
struct Rows {
  RowGroup* group[n_groups<V>];

  // What `of` a group is, of all of them.
  template <class Of>
  [[gnu::always_inline]] void read(Of&& of, V& out) const {
    if constexpr (n_groups<V> == 1)
      out = of(*group[0]);
    else
      out = __builtin_shufflevector(of(*group[0]), of(*group[1]), 0, 1, 2, 3);
  }
  [[gnu::always_inline]] void read(Two RowGroup::*field, V& out) const {
    read([&](const RowGroup& g) -> const Two& { return g.*field; }, out);
  }
  [[gnu::always_inline]] void read(Two (RowGroup::*field)[3], V (&out)[3]) const {
    for (int k = 0; k < 3; ++k)
      read([&](const RowGroup& g) -> const Two& { return (g.*field)[k]; }, out[k]);
  }
  [[gnu::always_inline]] void write(const V& value, Two RowGroup::*field) const {
    for (int g = 0; g < n_groups<V>; ++g) group_of(value, g, group[g]->*field);
  }
  [[gnu::always_inline]] void write(const V (&value)[3], Two (RowGroup::*field)[3]) const {
    for (int k = 0; k < 3; ++k)
      for (int g = 0; g < n_groups<V>; ++g) group_of(value[k], g, (group[g]->*field)[k]);
  }

  // The lanes of group `g`.
  [[gnu::always_inline]] static void group_of(const V& value, int g, Two& out) {
    if constexpr (n_groups<V> == 1)
      out = value;
    else
      out = g == 0 ? __builtin_shufflevector(value, value, 0, 1)
                   : __builtin_shufflevector(value, value, 2, 3);
  }
};

// Velocity of the contact points at the motions u.
template <class V>
[[gnu::always_inline]] inline void velocity_at(const V (&r)[3], const V (&u)[6], V (&w)[3]) {
  w[0] = u[0] + (u[4] * r[2] - u[5] * r[1]);
  w[1] = u[1] + (u[5] * r[0] - u[3] * r[2]);
  w[2] = u[2] + (u[3] * r[1] - u[4] * r[0]);
}

// T(r)^T p.
template <class V>
[[gnu::always_inline]] inline void generalised_lanes(const V (&r)[3], const V (&p)[3], V (&q)[6]) {
  for (int k = 0; k < 3; ++k) q[k] = p[k];
  q[3] = r[1] * p[2] - r[2] * p[1];
  q[4] = r[2] * p[0] - r[0] * p[2];
  q[5] = r[0] * p[1] - r[1] * p[0];
}

/// What the law reads of rows more than once.
template <class V>
struct Strength {
  V friction, cohesion, tension;

  [[gnu::always_inline]] void bound(const V& p_n, V& cap) const {
    cap = friction * (p_n > 0 ? p_n : V{}) + cohesion;
  }
};

// Which contacts press at normal impulse p_n, and their friction bounds.
template <class V>
[[gnu::always_inline]] inline void press(const Rows<V>& rows, const V (&normal)[3], const V& p_n,
                                         const V& state_before, Evaluation evaluation,
                                         Mask<V>& closed, V& cap) {
  constexpr double unbounded = 1e150;  // friction bound whose square is finite
  Strength<V> strength;
  rows.read(&RowGroup::friction, strength.friction);
  rows.read(&RowGroup::cohesion, strength.cohesion);
  rows.read(&RowGroup::tension, strength.tension);
  closed = p_n > -strength.tension;
  strength.bound(p_n, cap);
  if (evaluation == Evaluation::coupled) return;
  V last[3], last_p_n, last_cap;
  rows.read(&RowGroup::impulse, last);
  dot(normal, last, last_p_n);
  strength.bound(last_p_n, last_cap);
  const Mask<V> is_new = state_before == V{} + static_cast<double>(ContactState::open);
  const Mask<V> slips = (state_before == V{} + static_cast<double>(ContactState::slip)) |
                        ((strength.friction + strength.cohesion) <= 0);
  cap = is_new ? cap : slips ? last_cap : V{} + unbounded;
  // what just touches may be pushed; what would pull more than it pressed has parted
  closed = (p_n >= -strength.tension) | (~is_new & (p_n >= -last_p_n));
}

// Friction on contacts that slip, against trial + share a start: from the end direction where slip
// just begins (share 0) to the mean of those at the step's start and end. a = start . trial.
// With t the angle between these two it is at atan(tan(t) / (1 + share)), which turns by
// (1 + share) / (1 + share (2 + share) cos^2 t) as t grows.
template <class V>
[[gnu::always_inline]] inline void add_slip(const Rows<V>& rows, const Mask<V>& slip,
                                            const V (&trial)[3], const V& speed_sq, const V& cap,
                                            const V& shear_damping, V (&impulse)[3],
                                            V& slip_tangent) {
  const V one = V{} + 1;
  V start[3], a, speed, length;
  rows.read(&RowGroup::slip_start, start);
  dot(start, trial, a);
  a = a > 0 ? a : V{};
  square_root(slip ? speed_sq : one, speed);
  const V share = slip ? 1 - cap / (shear_damping * speed) : V{};
  const V length_sq = speed_sq + share * (2 + share) * a * a;
  square_root(slip ? length_sq : one, length);
  const V per_length = 1 / length, force = slip ? cap * per_length : V{};
  const V on_start = force * share * a;
  for (int k = 0; k < 3; ++k) impulse[k] -= force * trial[k] + on_start * start[k];
  slip_tangent = a > 0 ? (1 + share) * force * speed * per_length : force;
  rows.write(speed, &RowGroup::trial_speed);
}

// The contact law at motions u: impulses, states and tangents of the rows. Returns the impulses and
// for which rows a tangent changed, as bits.
template <class V>
[[gnu::always_inline]] inline int apply_law(const Rows<V>& rows, const V (&u)[6],
                                            Evaluation evaluation, double slack, V (&arm)[3],
                                            V (&impulse)[3]) {
  V normal[3], w[3], v_n, bias, damping, limit, state_before, tangent_before, used;
  rows.read(&RowGroup::arm, arm);
  rows.read(&RowGroup::normal, normal);
  rows.read(&RowGroup::bias, bias);
  rows.read(&RowGroup::normal_damping, damping);
  rows.read(&RowGroup::normal_limit, limit);
  rows.read(&RowGroup::state, state_before);
  rows.read(&RowGroup::normal_tangent, tangent_before);
  rows.read(&RowGroup::used_tangent, used);
  velocity_at(arm, u, w);
  dot(normal, w, v_n);
  V p_n = -damping * (v_n + bias), cap;
  const Mask<V> below_limit = p_n < limit;
  p_n = below_limit ? p_n : limit;
  const V normal_tangent = below_limit ? damping : V{};
  rows.write(normal_tangent, &RowGroup::normal_tangent);
  Mask<V> closed;
  press(rows, normal, p_n, state_before, evaluation, closed, cap);
  V state = {}, slip_tangent = {};
  for (int k = 0; k < 3; ++k) impulse[k] = V{};
  if (bits<V>(closed) != 0) {
    V shear[3], shear_damping, trial[3], speed_sq;
    rows.read(&RowGroup::shear_velocity, shear);
    rows.read(&RowGroup::shear_damping, shear_damping);
    for (int k = 0; k < 3; ++k) trial[k] = w[k] - v_n * normal[k] + shear[k];
    dot(trial, trial, speed_sq);
    const Mask<V> within = (shear_damping * shear_damping * speed_sq <= cap * cap) & (cap > 0);
    const Mask<V> stick = closed & within, slip = closed & ~within;
    const V on_normal = closed ? p_n : V{}, on_trial = stick ? shear_damping : V{};
    for (int k = 0; k < 3; ++k) impulse[k] = on_normal * normal[k] - on_trial * trial[k];
    state = stick  ? V{} + static_cast<double>(ContactState::stick)
            : slip ? V{} + static_cast<double>(ContactState::slip)
                   : V{};
    const Mask<V> rubs = slip & (cap > 0);
    if (bits<V>(rubs) != 0)
      add_slip(rows, rubs, trial, speed_sq, cap, shear_damping, impulse, slip_tangent);
  }
  rows.write(impulse, &RowGroup::impulse);
  rows.write(state, &RowGroup::state);
  rows.write(slip_tangent, &RowGroup::slip_tangent);
  const V difference = slip_tangent - used, off = difference > 0 ? difference : -difference;
  return bits<V>((state != state_before) | (normal_tangent != tangent_before) |
                 (off > slack * used));
}

/// A group and the pair that it belongs to.
struct GroupOfPair {
  RowGroup* group;
  PairEvaluation* pair;
};

// Evaluates as many groups as V has rows for.
template <class V>
[[gnu::always_inline]] inline void evaluate_groups(const GroupOfPair (&of)[n_groups<V>],
                                                   Evaluation evaluation, double slack) {
  Rows<V> rows;
  V u[6], arm[3], impulse[3], q[6];
  for (int g = 0; g < n_groups<V>; ++g) rows.group[g] = of[g].group;
  for (int k = 0; k < 6; ++k) {
    if constexpr (n_groups<V> == 1) {
      u[k] = V{} + of[0].pair->motion[k];
    } else {
      const double low = of[0].pair->motion[k], high = of[1].pair->motion[k];
      u[k] = V{low, low, high, high};
    }
  }
  const int changed = apply_law(rows, u, evaluation, slack, arm, impulse);
  generalised_lanes(arm, impulse, q);
  for (int g = 0; g < n_groups<V>; ++g) {
    PairEvaluation& pair = *of[g].pair;
    for (int k = 0; k < 6; ++k) {
      Two lanes;
      Rows<V>::group_of(q[k], g, lanes);
      pair.sum[k] += lanes;
    }
    pair.changed |= (changed >> 2 * g & 3) != 0;
  }
}

// The pairs' groups, as many at a time as V has rows for, whichever pairs they belong to.
template <class V>
[[gnu::always_inline]] inline void evaluate_in_lanes(std::span<PairEvaluation> pairs,
                                                     Evaluation evaluation, double slack) {
  GroupOfPair waiting[n_groups<V>];
  int n_waiting = 0;
  for (PairEvaluation& pair : pairs) {
    for (Two& sum : pair.sum) sum = Two{};
    pair.changed = false;
    for (RowGroup& group : pair.groups) {
      waiting[n_waiting++] = {&group, &pair};
      if (n_waiting < n_groups<V>) continue;
      evaluate_groups<V>(waiting, evaluation, slack);
      n_waiting = 0;
    }
  }
  if constexpr (n_groups < V >> 1) {
    const GroupOfPair last[1] = {waiting[0]};
    if (n_waiting > 0) evaluate_groups<Two>(last, evaluation, slack);
  }
}

}  // namespace
}  // namespace talus
