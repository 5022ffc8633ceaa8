#include "dda/row_groups.hpp"

#include <algorithm>
#include <cmath>

#include "base/make_room.hpp"
#include "dda/newton.hpp"

namespace talus {
namespace {

using std::size_t;

constexpr int width = 2;
constexpr double unbounded = 1e150;  // friction bound whose square is finite
using Mask = decltype(Two{} < Two{});
constexpr Two zero = {0, 0};
constexpr Two one = {1, 1};
constexpr Two open_lanes = zero;
constexpr Two slip_lanes = one;
constexpr Two stick_lanes = {2, 2};

[[gnu::always_inline]] inline void dot(const Two (&a)[3], const Two (&b)[3], Two& out) {
  out = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

[[gnu::always_inline]] inline void cross(const Two (&a)[3], const Two (&b)[3], Two (&out)[3]) {
  out[0] = a[1] * b[2] - a[2] * b[1];
  out[1] = a[2] * b[0] - a[0] * b[2];
  out[2] = a[0] * b[1] - a[1] * b[0];
}

[[gnu::always_inline]] inline void square_root(const Two& x, Two& out) {
#if defined(__SSE2__)
  out = __builtin_ia32_sqrtpd(x);
#else
  for (int i = 0; i < width; ++i) out[i] = std::sqrt(x[i]);
#endif
}

[[gnu::always_inline]] inline bool any(const Two& x) {  // lanes other than 0
  const auto hit = x != zero;
  return (hit[0] | hit[1]) != 0;
}

[[gnu::always_inline]] inline double sum(const Two& x) { return x[0] + x[1]; }

// Velocity of the contact points.
[[gnu::always_inline]] inline void velocity_at(const Two (&r)[3], const Vec6& u, Two (&w)[3]) {
  w[0] = u[0] + (u[4] * r[2] - u[5] * r[1]);
  w[1] = u[1] + (u[5] * r[0] - u[3] * r[2]);
  w[2] = u[2] + (u[3] * r[1] - u[4] * r[0]);
}

// T(r)^T p.
[[gnu::always_inline]] inline void generalised_lanes(const Two (&r)[3], const Two (&p)[3],
                                                     Two (&q)[6]) {
  for (int k = 0; k < 3; ++k) q[k] = p[k];
  q[3] = r[1] * p[2] - r[2] * p[1];
  q[4] = r[2] * p[0] - r[0] * p[2];
  q[5] = r[0] * p[1] - r[1] * p[0];
}

[[gnu::always_inline]] inline void friction_bound(const RowGroup& g, const Two& p_n, Two& cap) {
  cap = g.friction * (p_n > zero ? p_n : zero) + g.cohesion;
}

// Which contacts press at normal impulse p_n, and their friction bounds.
[[gnu::always_inline]] inline void press(const RowGroup& g, const Two& p_n, Evaluation evaluation,
                                         Mask& closed, Two& cap) {
  closed = p_n > -g.tension;
  if (evaluation == Evaluation::coupled) {
    friction_bound(g, p_n, cap);
  } else {
    Two last_p_n, last_cap, cap_now;
    dot(g.normal, g.impulse, last_p_n);
    friction_bound(g, last_p_n, last_cap);
    friction_bound(g, p_n, cap_now);
    const Mask is_new = g.state == open_lanes;
    const Mask slips = (g.state == slip_lanes) | ((g.friction + g.cohesion) <= zero);
    cap = is_new ? cap_now : slips ? last_cap : unbounded + zero;
    // what just touches may be pushed; what would pull more than it pressed has parted
    closed = (p_n >= -g.tension) | (~is_new & (p_n >= -last_p_n));
  }
}

// Friction on contacts that slip, against trial + share a start: from the end direction where slip
// just begins (share 0) to the mean of those at the step's start and end. a = start . trial.
// With t the angle between these two it is at atan(tan(t) / (1 + share)), which turns by
// (1 + share) / (1 + share (2 + share) cos^2 t) as t grows.
[[gnu::always_inline]] inline void add_slip(const Mask& slip, const Two (&trial)[3],
                                            const Two& speed_sq, const Two& cap, RowGroup& g) {
  Two a, speed, length;
  dot(g.slip_start, trial, a);
  a = a > zero ? a : zero;
  square_root(slip ? speed_sq : one, speed);
  const Two share = slip ? 1 - cap / (g.shear_damping * speed) : zero;
  const Two length_sq = speed_sq + share * (2 + share) * a * a;
  square_root(slip ? length_sq : one, length);
  const Two per_length = 1 / length, force = slip ? cap * per_length : zero;
  const Two on_start = force * share * a;
  for (int k = 0; k < 3; ++k) g.impulse[k] -= force * trial[k] + on_start * g.slip_start[k];
  g.slip_tangent = a > zero ? (1 + share) * force * speed * per_length : force;
  g.trial_speed = speed;
}

// The contact law at point velocities w: impulses, states and slip stiffness of the group.
[[gnu::always_inline]] inline void apply_law(const Two (&w)[3], Evaluation evaluation,
                                             RowGroup& g) {
  Two v_n, p_n, cap, trial[3], speed_sq;
  dot(g.normal, w, v_n);
  p_n = -g.normal_damping * (v_n + g.bias);
  const Mask below_limit = p_n < g.normal_limit;
  p_n = below_limit ? p_n : g.normal_limit;
  g.normal_tangent = below_limit ? g.normal_damping : zero;
  Mask closed;
  press(g, p_n, evaluation, closed, cap);
  if ((closed[0] | closed[1]) == 0) {
    for (int k = 0; k < 3; ++k) g.impulse[k] = zero;
    g.state = open_lanes;
    g.slip_tangent = zero;
    return;
  }
  for (int k = 0; k < 3; ++k) trial[k] = w[k] - v_n * g.normal[k] + g.shear_velocity[k];
  dot(trial, trial, speed_sq);
  const Mask within = (g.shear_damping * g.shear_damping * speed_sq <= cap * cap) & (cap > zero);
  const Mask stick = closed & within, slip = closed & ~within;
  const Two on_normal = closed ? p_n : zero, on_trial = stick ? g.shear_damping : zero;
  for (int k = 0; k < 3; ++k) g.impulse[k] = on_normal * g.normal[k] - on_trial * trial[k];
  g.state = stick ? stick_lanes : slip ? slip_lanes : open_lanes;
  g.slip_tangent = zero;
  const Mask rubs = slip & (cap > zero);
  if ((rubs[0] | rubs[1]) != 0) add_slip(rubs, trial, speed_sq, cap, g);
}

// sum += k q q^T, lower triangle.
[[gnu::always_inline]] inline void add_outer(const Two& k, const Two (&q)[6],
                                             Two (&out)[Packed<6>::size]) {
#pragma GCC unroll 6
  for (int i = 0; i < 6; ++i) {
    const Two kq = k * q[i];
#pragma GCC unroll 6
    for (int j = 0; j <= i; ++j) out[Packed<6>::at(i, j)] += kq * q[j];
  }
}

// Stick: k (T^T T). Rigid: T^T T = [I, -S; S, |r|^2 I - r r^T] with S = [r]x.
[[gnu::always_inline]] inline void add_stick(const Two& k, const Two (&r)[3],
                                             Two (&out)[Packed<6>::size]) {
  using P = Packed<6>;
  const Two x = k * r[0], y = k * r[1], z = k * r[2];
  const Two xx = x * r[0], yy = y * r[1], zz = z * r[2];
  for (int i = 0; i < 3; ++i) out[P::at(i, i)] += k;
  out[P::at(3, 1)] -= z, out[P::at(3, 2)] += y;
  out[P::at(4, 0)] += z, out[P::at(4, 2)] -= x;
  out[P::at(5, 0)] -= y, out[P::at(5, 1)] += x;
  out[P::at(3, 3)] += yy + zz, out[P::at(4, 4)] += xx + zz, out[P::at(5, 5)] += xx + yy;
  out[P::at(4, 3)] -= x * r[1], out[P::at(5, 3)] -= x * r[2], out[P::at(5, 4)] -= y * r[2];
}

Vec3 lane_of(const Two (&v)[3], int lane) { return {v[0][lane], v[1][lane], v[2][lane]}; }

// A slipping contact's exact tangent besides k_n n n^T. Its direction e turns with the end
// direction and with the share of the start direction (see add_slip), which grows with the trial
// speed and falls with the friction bound; the bound itself changes by -tan(phi) k_n n^T.
void add_exact_slip(const RowGroup& g, int lane, Mat6& rest) {
  const Vec3 n = lane_of(g.normal, lane), arm = lane_of(g.arm, lane);
  const Vec3 impulse = lane_of(g.impulse, lane), start = lane_of(g.slip_start, lane);
  const double p_n = n.dot(impulse), speed = g.trial_speed[lane];
  const Vec3 friction = p_n * n - impulse;
  const double cap = friction.norm();
  const Vec3 e = friction / cap, across = n.cross(e);
  const double cosine = e.dot(start), threshold = cap / (g.shear_damping[lane] * speed);
  const double share = 1 - threshold;
  Vec3 by_trial = g.slip_tangent[lane] * across, bound = e;
  if (cosine > 0) {
    const Vec3 end = ((1 + share) * e - share * cosine * start).normalized();
    const double c = end.dot(start), turn = -c * n.cross(start).dot(end) /
                                            (1 + share * (2 + share) * c * c);  // d angle / d share
    by_trial = g.slip_tangent[lane] * n.cross(end) + cap / speed * turn * threshold * end;
    bound -= turn * threshold * across;
  }
  const auto q_n = generalised<6>(arm, n);
  rest += generalised<6>(arm, across) * generalised<6>(arm, by_trial).transpose();
  if (p_n > 0)
    rest -=
        g.friction[lane] * g.normal_tangent[lane] * generalised<6>(arm, bound) * q_n.transpose();
}

// The stiffness across the slip, s a a^T with a = n x t / |t|, t the tangential impulse.
[[gnu::always_inline]] inline void add_across(const RowGroup& g, Two (&out)[Packed<6>::size]) {
  Two across[3], q[6], length_sq;
  cross(g.normal, g.impulse, across);
  dot(across, across, length_sq);
  const Two k = g.slip_tangent / (length_sq > zero ? length_sq : one);
  generalised_lanes(g.arm, across, q);
  add_outer(k, q, out);
}

}  // namespace

[[gnu::flatten]] bool evaluate_pair(std::span<RowGroup> groups, const Vec6& u,
                                    Evaluation evaluation, double slack, Vec6& f) {
  Two total[6];
  for (Two& t : total) t = zero;
  bool changed = false;
  for (RowGroup& g : groups) {
    Two w[3], q[6];
    velocity_at(g.arm, u, w);
    const Two state_before = g.state, tangent_before = g.normal_tangent;
    apply_law(w, evaluation, g);
    generalised_lanes(g.arm, g.impulse, q);
    for (int k = 0; k < 6; ++k) total[k] += q[k];
    const Two difference = g.slip_tangent - g.used_tangent;
    const Two off = difference > zero ? difference : -difference;
    const Two moved = off > slack * g.used_tangent ? one : zero;
    changed |= any((g.state != state_before ? one : zero) + moved +
                   (g.normal_tangent != tangent_before ? one : zero));
  }
  for (int k = 0; k < 6; ++k) f[k] = sum(total[k]);
  return changed;
}

[[gnu::flatten]] bool sum_tangents(std::span<RowGroup> groups, Packed<6>& W, Mat6* rest) {
  Two total[Packed<6>::size];
  for (Two& t : total) t = zero;
  bool closed = false;
  for (RowGroup& g : groups) {
    g.used_tangent = g.slip_tangent;
    if (!any(g.state)) continue;
    closed = true;
    const Two k_t = g.state == stick_lanes ? g.shear_damping : zero;
    const Two k_n = (g.state != open_lanes ? g.normal_tangent : zero) - k_t;
    Two q[6];
    if (any(k_t)) add_stick(k_t, g.arm, total);
    if (any(k_n)) {
      generalised_lanes(g.arm, g.normal, q);
      add_outer(k_n, q, total);
    }
    if (!rest && any(g.slip_tangent)) add_across(g, total);
    for (int lane = 0; rest && lane < width; ++lane)
      if (g.slip_tangent[lane] > 0) add_exact_slip(g, lane, *rest);
  }
  for (int k = 0; k < Packed<6>::size; ++k) W.value[static_cast<size_t>(k)] = sum(total[k]);
  return closed;
}

}  // namespace talus
