// libcore/solver/mass_lanes.hpp
// The sweeps of the mass solver over vectors of four or eight floats, for mass_solver.cpp and
// mass_solver_avx2.cpp alone: whatever the width, each lane sees the same operations in the same
// order, and so has the same bits. All of it is local to the file that includes it, which compiles
// it for its own processor.
#pragma once

#include <cmath>
#include <span>

#include "solver/mass_numbers.hpp"
#include "solver/mass_sweeps.hpp"

namespace talus {
namespace {

using FourFloats __attribute__((vector_size(16), may_alias)) = float;
using EightFloats __attribute__((vector_size(32), may_alias)) = float;

template <class V>
inline constexpr int n_floats = sizeof(V) / sizeof(float);

template <class V>
[[gnu::always_inline]] inline V& lanes_at(float* values) {
  return *reinterpret_cast<V*>(values);
}
template <class V>
[[gnu::always_inline]] inline const V& lanes_at(const float* values) {
  return *reinterpret_cast<const V*>(values);
}

template <class V>
[[gnu::always_inline]] inline void square_root_of(const V& x, V& out) {
#if defined(TALUS_EIGHT_LANES)
  if constexpr (n_floats<V> == 8) return void(out = __builtin_ia32_sqrtps256(x));
#endif
#if defined(__SSE2__)
  if constexpr (n_floats<V> == 4) out = __builtin_ia32_sqrtps(x);
#else
  for (int i = 0; i < n_floats<V>; ++i) out[i] = std::sqrt(x[i]);
#endif
}

// Rows of a square become its columns.
[[gnu::always_inline]] inline void transpose(FourFloats& a, FourFloats& b, FourFloats& c,
                                             FourFloats& d) {
  const FourFloats ab = __builtin_shufflevector(a, b, 0, 4, 1, 5),
                   AB = __builtin_shufflevector(a, b, 2, 6, 3, 7),
                   cd = __builtin_shufflevector(c, d, 0, 4, 1, 5),
                   CD = __builtin_shufflevector(c, d, 2, 6, 3, 7);
  a = __builtin_shufflevector(ab, cd, 0, 1, 4, 5);
  b = __builtin_shufflevector(ab, cd, 2, 3, 6, 7);
  c = __builtin_shufflevector(AB, CD, 0, 1, 4, 5);
  d = __builtin_shufflevector(AB, CD, 2, 3, 6, 7);
}

[[gnu::always_inline]] inline void transpose(EightFloats (&r)[8]) {
  EightFloats low[4], high[4];
  for (int i = 0; i < 4; ++i) {
    low[i] = __builtin_shufflevector(r[2 * i], r[2 * i + 1], 0, 8, 1, 9, 4, 12, 5, 13);
    high[i] = __builtin_shufflevector(r[2 * i], r[2 * i + 1], 2, 10, 3, 11, 6, 14, 7, 15);
  }
  EightFloats quarter[8];
  for (int i = 0; i < 2; ++i) {
    const EightFloats &l0 = low[2 * i], &l1 = low[2 * i + 1], &h0 = high[2 * i],
                      &h1 = high[2 * i + 1];
    quarter[4 * i] = __builtin_shufflevector(l0, l1, 0, 1, 8, 9, 4, 5, 12, 13);
    quarter[4 * i + 1] = __builtin_shufflevector(l0, l1, 2, 3, 10, 11, 6, 7, 14, 15);
    quarter[4 * i + 2] = __builtin_shufflevector(h0, h1, 0, 1, 8, 9, 4, 5, 12, 13);
    quarter[4 * i + 3] = __builtin_shufflevector(h0, h1, 2, 3, 10, 11, 6, 7, 14, 15);
  }
  for (int i = 0; i < 4; ++i) {
    r[i] = __builtin_shufflevector(quarter[i], quarter[4 + i], 0, 1, 2, 3, 8, 9, 10, 11);
    r[4 + i] = __builtin_shufflevector(quarter[i], quarter[4 + i], 4, 5, 6, 7, 12, 13, 14, 15);
  }
}

// Eight consecutive floats of each lane: out[k] is float k of all lanes.
template <class V>
[[gnu::always_inline]] inline void read_lanes(const float* const (&at)[n_floats<V>], V (&out)[8]) {
  if constexpr (n_floats<V> == 8) {
    for (int i = 0; i < 8; ++i) out[i] = lanes_at<V>(at[i]);
    transpose(out);
  } else {
    for (int i = 0; i < 4; ++i) {
      out[i] = lanes_at<V>(at[i]);
      out[4 + i] = lanes_at<V>(at[i] + 4);
    }
    transpose(out[0], out[1], out[2], out[3]);
    transpose(out[4], out[5], out[6], out[7]);
  }
}
// ... and back; changes `in`.
template <class V>
[[gnu::always_inline]] inline void write_lanes(V (&in)[8], float* const (&at)[n_floats<V>]) {
  if constexpr (n_floats<V> == 8) {
    transpose(in);
    for (int i = 0; i < 8; ++i) lanes_at<V>(at[i]) = in[i];
  } else {
    transpose(in[0], in[1], in[2], in[3]);
    transpose(in[4], in[5], in[6], in[7]);
    for (int i = 0; i < 4; ++i) {
      lanes_at<V>(at[i]) = in[i];
      lanes_at<V>(at[i] + 4) = in[4 + i];
    }
  }
}

template <class V>
[[gnu::always_inline]] inline void dot_of(const V (&a)[3], const V (&b)[3], V& out) {
  out = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <class V>
[[gnu::always_inline]] inline void cross_of(const V (&a)[3], const V (&b)[3], V (&out)[3]) {
  out[0] = a[1] * b[2] - a[2] * b[1];
  out[1] = a[2] * b[0] - a[0] * b[2];
  out[2] = a[0] * b[1] - a[1] * b[0];
}

/// Bodies of a side of a batch.
template <class V>
struct BodyLanes {
  float* change[n_floats<V>];
  V velocity[3], spin[3];
  V inertia[8];  // as MassInertia

  [[gnu::always_inline]] void read(const MassSweeps& sweeps, const int* bodies) {
    const float* of[n_floats<V>];
    for (int i = 0; i < n_floats<V>; ++i) {
      change[i] = sweeps.change[bodies[i]].velocity;
      of[i] = &sweeps.inertia[bodies[i]].xx;
    }
    read_lanes<V>(of, inertia);
    const float* now[n_floats<V>];
    for (int i = 0; i < n_floats<V>; ++i) now[i] = change[i];
    V all[8];
    read_lanes<V>(now, all);
    for (int k = 0; k < 3; ++k) velocity[k] = all[k], spin[k] = all[3 + k];
  }
  [[gnu::always_inline]] void write() {
    V all[8] = {velocity[0], velocity[1], velocity[2], spin[0], spin[1], spin[2], V{}, V{}};
    write_lanes<V>(all, change);
  }
  // Inverse of the inertia times a couple.
  [[gnu::always_inline]] void turned_by(const V (&couple)[3], V (&out)[3]) const {
    out[0] = inertia[0] * couple[0] + inertia[3] * couple[1] + inertia[4] * couple[2];
    out[1] = inertia[3] * couple[0] + inertia[1] * couple[1] + inertia[5] * couple[2];
    out[2] = inertia[4] * couple[0] + inertia[5] * couple[1] + inertia[2] * couple[2];
  }
  [[gnu::always_inline]] void push(const V (&arm)[3], const V (&impulse)[3]) {
    V couple[3], by[3];
    cross_of(arm, impulse, couple);
    turned_by(couple, by);
    for (int k = 0; k < 3; ++k) velocity[k] += inertia[6] * impulse[k], spin[k] += by[k];
  }
  [[gnu::always_inline]] void velocity_at(const V (&arm)[3], V (&out)[3]) const {
    cross_of(spin, arm, out);
    for (int k = 0; k < 3; ++k) out[k] += velocity[k];
  }
  // Mobility by turning of the point at `arm` along `normal`, and the sum along all axes.
  [[gnu::always_inline]] void mobility(const V (&arm)[3], const V (&normal)[3], V& along,
                                       V& all) const {
    V couple[3], by[3], size;
    cross_of(arm, normal, couple);
    turned_by(couple, by);
    dot_of(couple, by, along);
    turned_by(arm, by);
    dot_of(arm, arm, size);
    dot_of(arm, by, all);
    all = (inertia[0] + inertia[1] + inertia[2]) * size - all;
  }
};

template <class V>
[[gnu::always_inline]] inline void read_axis(const float (&field)[3][mass_lanes], int lane,
                                             V (&out)[3]) {
  for (int k = 0; k < 3; ++k) out[k] = lanes_at<V>(&field[k][lane]);
}
template <class V>
[[gnu::always_inline]] inline void write_axis(const V& x, const V& y, const V& z, int lane,
                                              float (&field)[3][mass_lanes]) {
  lanes_at<V>(&field[0][lane]) = x;
  lanes_at<V>(&field[1][lane]) = y;
  lanes_at<V>(&field[2][lane]) = z;
}

// Rows of a batch, side by side, with their compliances and the step of a sweep.
template <class V>
[[gnu::always_inline]] inline void fill_lanes(const MassSweeps& sweeps, const MassBatch& batch,
                                              int lane) {
  BodyLanes<V> a, b;
  a.read(sweeps, batch.a + lane);
  b.read(sweeps, batch.b + lane);
  for (int j = 0; j < batch.count; ++j) {
    MassPoint& point = sweeps.points[batch.first + j];
    const float* at[3][n_floats<V>];
    for (int i = 0; i < n_floats<V>; ++i) {
      const bool is_there = j < batch.n_rows[lane + i];
      const MassRow& row = is_there ? sweeps.rows[batch.row_begin[lane + i] + j] : sweeps.no_row;
      at[0][i] = row.normal;
      at[1][i] = row.arm_b;
      at[2][i] = row.slip_start;
    }
    V first[8], second[8], third[8];
    read_lanes<V>(at[0], first);
    read_lanes<V>(at[1], second);
    read_lanes<V>(at[2], third);
    const V normal[3] = {first[0], first[1], first[2]}, arm_a[3] = {first[3], first[4], first[5]},
            arm_b[3] = {second[0], second[1], second[2]},
            impulse[3] = {third[3], third[4], third[5]};
    V along_a, along_b, all_a, all_b, p_n;
    a.mobility(arm_a, normal, along_a, all_a);
    b.mobility(arm_b, normal, along_b, all_b);
    const V inverse_mass = a.inertia[6] + b.inertia[6];
    const V W_n = inverse_mass + along_a + along_b;
    const V W_t = inverse_mass + (all_a + all_b - along_a - along_b) * mass::turning_share;
    const V normal_give = W_n * sweeps.compliance, shear_give = W_n * sweeps.shear_compliance;
    const V tiny = V{} + 1e-30F;
    const V normal_size = W_n + normal_give, shear_size = W_t + shear_give;
    lanes_at<V>(&point.normal_give[lane]) = normal_give;
    lanes_at<V>(&point.shear_give[lane]) = shear_give;
    lanes_at<V>(&point.normal_step[lane]) = 1 / (normal_size > tiny ? normal_size : tiny);
    lanes_at<V>(&point.shear_step[lane]) = 1 / (shear_size > tiny ? shear_size : tiny);
    lanes_at<V>(&point.friction[lane]) = first[6];
    lanes_at<V>(&point.limit[lane]) = first[7];
    write_axis<V>(first[0], first[1], first[2], lane, point.normal);
    write_axis<V>(first[3], first[4], first[5], lane, point.arm_a);
    write_axis<V>(second[0], second[1], second[2], lane, point.arm_b);
    write_axis<V>(third[0], third[1], third[2], lane, point.slip_start);
    write_axis<V>(third[3], third[4], third[5], lane, point.impulse);
    // a contact that sticks is pressed along until it moves: its spring holds the last force
    dot_of(impulse, normal, p_n);
    V v[3];
    for (int k = 0; k < 3; ++k) v[k] = second[3 + k] - (impulse[k] - p_n * normal[k]) * shear_give;
    write_axis<V>(v[0], v[1], v[2], lane, point.velocity);
  }
}

// Impulses of the rows so far, back into the rows.
template <class V>
[[gnu::always_inline]] inline void empty_lanes(const MassSweeps& sweeps, const MassBatch& batch,
                                               int lane) {
  MassRow unused;
  for (int j = 0; j < batch.count; ++j) {
    const MassPoint& point = sweeps.points[batch.first + j];
    V all[8] = {};
    V impulse[3];
    for (int k = 0; k < 3; ++k) all[k] = lanes_at<V>(&point.slip_start[k][lane]);
    read_axis<V>(point.impulse, lane, impulse);
    for (int k = 0; k < 3; ++k) all[3 + k] = impulse[k];
    all[6] = 1 / lanes_at<V>(&point.normal_give[lane]);
    float* at[n_floats<V>];
    for (int i = 0; i < n_floats<V>; ++i)
      at[i] = (j < batch.n_rows[lane + i] ? sweeps.rows[batch.row_begin[lane + i] + j] : unused)
                  .slip_start;
    write_lanes<V>(all, at);
  }
}

// The impulse of a point at the velocities of now; `delta`: by how much it changed.
template <class V>
[[gnu::always_inline]] inline void solve_point(MassPoint& point, int lane, const BodyLanes<V>& a,
                                               const BodyLanes<V>& b, V (&delta)[3]) {
  V n[3], arm_a[3], arm_b[3], v[3], s[3], p[3], at_a[3], at_b[3];
  read_axis<V>(point.normal, lane, n);
  read_axis<V>(point.arm_a, lane, arm_a);
  read_axis<V>(point.arm_b, lane, arm_b);
  read_axis<V>(point.velocity, lane, v);
  read_axis<V>(point.slip_start, lane, s);
  read_axis<V>(point.impulse, lane, p);
  a.velocity_at(arm_a, at_a);
  b.velocity_at(arm_b, at_b);
  for (int k = 0; k < 3; ++k) v[k] += at_a[k] - at_b[k];
  V v_n, p_n;
  dot_of(v, n, v_n);
  dot_of(p, n, p_n);
  const V& normal_step = lanes_at<V>(&point.normal_step[lane]);
  const V& shear_step = lanes_at<V>(&point.shear_step[lane]);
  const V& shear_give = lanes_at<V>(&point.shear_give[lane]);
  const V& limit = lanes_at<V>(&point.limit[lane]);
  V next_n = p_n - (v_n + p_n * lanes_at<V>(&point.normal_give[lane])) * normal_step;
  next_n = next_n > 0 ? next_n : V{};
  next_n = next_n < limit ? next_n : limit;
  const V cap = lanes_at<V>(&point.friction[lane]) * next_n;
  V slip[3], trial[3], size, along;
  for (int k = 0; k < 3; ++k) {
    slip[k] = v[k] - v_n * n[k];
    const V p_t = p[k] - p_n * n[k];
    trial[k] = p_t - (slip[k] + p_t * shear_give) * shear_step;
  }
  dot_of(trial, trial, size);
  square_root_of<V>(size, size);
  dot_of(s, slip, along);
  along = along > 0 ? along * shear_step : V{};
  along = size > cap ? along : V{};
  for (int k = 0; k < 3; ++k) trial[k] -= along * s[k];
  V length;
  dot_of(trial, trial, length);
  square_root_of<V>(length, length);
  const V tiny = V{} + 1e-20F;
  const V share = (size < cap ? size : cap) / (length > tiny ? length : tiny);
  for (int k = 0; k < 3; ++k) {
    const V next = next_n * n[k] + share * trial[k];
    delta[k] = next - p[k];
    lanes_at<V>(&point.impulse[k][lane]) = next;
  }
}

// A sweep over a batch; `applies`: applies the impulses as they are.
template <class V, bool applies>
[[gnu::always_inline]] inline void sweep_lanes(const MassSweeps& sweeps, const MassBatch& batch,
                                               int lane) {
  BodyLanes<V> a, b;
  a.read(sweeps, batch.a + lane);
  b.read(sweeps, batch.b + lane);
  for (int j = 0; j < batch.count; ++j) {
    MassPoint& point = sweeps.points[batch.first + j];
    V delta[3], back[3], arm_a[3], arm_b[3];
    if constexpr (applies)
      read_axis<V>(point.impulse, lane, delta);
    else
      solve_point<V>(point, lane, a, b, delta);
    read_axis<V>(point.arm_a, lane, arm_a);
    read_axis<V>(point.arm_b, lane, arm_b);
    for (int k = 0; k < 3; ++k) back[k] = -delta[k];
    a.push(arm_a, delta);
    b.push(arm_b, back);
  }
  a.write();
  b.write();
}

template <class V>
[[gnu::always_inline]] inline void run_in_lanes(const MassSweeps& sweeps, MassPass pass) {
  for (const MassBatch& batch : sweeps.batches)
    for (int lane = 0; lane < mass_lanes; lane += n_floats<V>) {
      switch (pass) {
        case MassPass::fill:
          fill_lanes<V>(sweeps, batch, lane);
          break;
        case MassPass::apply:
          sweep_lanes<V, true>(sweeps, batch, lane);
          break;
        case MassPass::sweep:
          sweep_lanes<V, false>(sweeps, batch, lane);
          break;
        case MassPass::empty:
          empty_lanes<V>(sweeps, batch, lane);
          break;
      }
    }
}

}  // namespace
}  // namespace talus
