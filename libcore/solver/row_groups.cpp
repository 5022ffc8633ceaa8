// Contact impulses and tangents of an island, two or four contacts at a time.
#include "solver/row_groups.hpp"

#include <cmath>

#include "solver/newton.hpp"
#include "solver/row_lanes.hpp"

namespace talus {
namespace {

using std::size_t;

constexpr int n_lanes = 2;
constexpr Two zero = {0, 0};
constexpr Two one = {1, 1};
constexpr Two open_lanes = zero;
constexpr Two stick_lanes = {2, 2};

[[gnu::always_inline]] inline void cross(const Two (&a)[3], const Two (&b)[3], Two (&out)[3]) {
  out[0] = a[1] * b[2] - a[2] * b[1];
  out[1] = a[2] * b[0] - a[0] * b[2];
  out[2] = a[0] * b[1] - a[1] * b[0];
}

[[gnu::always_inline]] inline bool any(const Two& x) {  // lanes other than 0
  const auto hit = x != zero;
  return (hit[0] | hit[1]) != 0;
}

[[gnu::always_inline]] inline double sum(const Two& x) { return x[0] + x[1]; }

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

// The stiffness across the slip, s a a^T with a = n x t / |t|, t the friction.
[[gnu::always_inline]] inline void add_across(const RowGroup& g, Two (&out)[Packed<6>::size]) {
  Two across[3], q[6], length_sq;
  cross(g.normal, g.impulse, across);
  dot(across, across, length_sq);
  const Two k = g.slip_tangent / (length_sq > zero ? length_sq : one);
  generalised_lanes(g.arm, across, q);
  add_outer(k, q, out);
}

}  // namespace

[[gnu::flatten]] void evaluate_pairs(std::span<PairEvaluation> pairs, Evaluation evaluation,
                                     double slack, RowWidth width) {
  if (width == RowWidth::four)
    evaluate_pairs_by_four(pairs, evaluation, slack);
  else
    evaluate_in_lanes<Two>(pairs, evaluation, slack);
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
    for (int lane = 0; rest && lane < n_lanes; ++lane)
      if (g.slip_tangent[lane] > 0) add_exact_slip(g, lane, *rest);
  }
  for (int k = 0; k < Packed<6>::size; ++k) W.value[k] = sum(total[k]);
  return closed;
}

}  // namespace talus
