// libcore/solver/row_lanes.hpp
// Contacts of an island as lanes of the contact law, for row_groups.cpp and row_groups_avx2.cpp
// alone: V is a vector of two or four doubles, that is the rows of one group or of two. Whatever
// the width, each row sees the same operations in the same order, and so has the same bits. All of
// it is local to the file that includes it, which compiles it for its own processor.
#pragma once

#include "solver/contact_law.hpp"
#include "solver/pair_evaluation.hpp"

namespace talus {
namespace {

template <class V>
inline constexpr int n_groups = sizeof(V) / sizeof(Two);

/// As many groups as V has rows for, side by side.
template <class V>
struct Rows {
  using Row = RowGroup;
  RowGroup* group[n_groups<V>];

  // The lanes `of` each group, joined.
  template <class Of>
  [[gnu::always_inline]] void gather(Of&& of, V& out) const {
    if constexpr (n_groups<V> == 1)
      out = of(*group[0]);
    else
      out = __builtin_shufflevector(of(*group[0]), of(*group[1]), 0, 1, 2, 3);
  }
  [[gnu::always_inline]] void read(Two RowGroup::*field, V& out) const {
    gather([&](const RowGroup& g) -> const Two& { return g.*field; }, out);
  }
  [[gnu::always_inline]] void read(Two (RowGroup::*field)[3], V (&out)[3]) const {
    for (int k = 0; k < 3; ++k)
      gather([&](const RowGroup& g) -> const Two& { return (g.*field)[k]; }, out[k]);
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

// The contact law at motions u: impulses, states and tangents of the rows. Returns for which rows a
// tangent changed, as bits.
template <class V>
[[gnu::always_inline]] inline int apply_law(const Rows<V>& rows, const V (&u)[6],
                                            Evaluation evaluation, double slack, V (&arm)[3],
                                            Found<V>& found) {
  V w[3], state_before, tangent_before, used;
  rows.read(&RowGroup::arm, arm);
  rows.read(&RowGroup::state, state_before);
  rows.read(&RowGroup::normal_tangent, tangent_before);
  rows.read(&RowGroup::used_tangent, used);
  velocity_at(arm, u, w);
  found.trial_speed = V{};
  contact_law(rows, w, state_before, evaluation, found);
  rows.write(found.impulse, &RowGroup::impulse);
  rows.write(found.state, &RowGroup::state);
  rows.write(found.normal_tangent, &RowGroup::normal_tangent);
  rows.write(found.slip_tangent, &RowGroup::slip_tangent);
  if (found.rubs) rows.write(found.trial_speed, &RowGroup::trial_speed);
  const V difference = found.slip_tangent - used, off = difference > 0 ? difference : -difference;
  return bits<V>((found.state != state_before) | (found.normal_tangent != tangent_before) |
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
  V u[6], arm[3], q[6];
  Found<V> found;
  for (int g = 0; g < n_groups<V>; ++g) rows.group[g] = of[g].group;
  for (int k = 0; k < 6; ++k) {
    if constexpr (n_groups<V> == 1) {
      u[k] = V{} + of[0].pair->motion[k];
    } else {
      const double low = of[0].pair->motion[k], high = of[1].pair->motion[k];
      u[k] = V{low, low, high, high};
    }
  }
  const int changed = apply_law(rows, u, evaluation, slack, arm, found);
  generalised_lanes(arm, found.impulse, q);
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
