#include "dda/rotation.hpp"

#include <algorithm>
#include <cmath>

namespace talus {
namespace {

constexpr double largest_turn = 0.06;  // |omega| h of one substep of order 4 [rad]

/// Spin split into turns about the body axes; carries attitude and body momentum along.
struct SplitSpin {
  Quat q;
  Vec3 momentum;  // body axes
  Vec3 per_inertia;

  // Turn about body axis K by h Pi_K / I_K: exact for the part of the energy in that axis.
  template <int K>
  void turn(double h) {
    constexpr int I = (K + 1) % 3, J = (K + 2) % 3;
    const double half = 0.5 * h * momentum[K] * per_inertia[K];
    const double s = std::sin(half), c = std::cos(half);
    const double sin2 = 2 * s * c, cos2 = 1 - 2 * s * s;
    const double pi = momentum[I], pj = momentum[J];
    momentum[I] = cos2 * pi + sin2 * pj;
    momentum[J] = cos2 * pj - sin2 * pi;
    auto& v = q.coeffs();  // x y z w; q <- q * (c, s e_K)
    const double w = v[3], k = v[K], i = v[I], j = v[J];
    v[3] = c * w - s * k;
    v[K] = c * k + s * w;
    v[I] = c * i + s * j;
    v[J] = c * j - s * i;
  }

  void order2(double h) {
    turn<0>(h / 2);
    turn<1>(h / 2);
    turn<2>(h);
    turn<1>(h / 2);
    turn<0>(h / 2);
  }

  void order4(double h) {  // Suzuki 1990: p, p, 1 - 4p, p, p
    static const double p = 1 / (4 - std::cbrt(4.0));
    order2(p * h);
    order2(p * h);
    order2((1 - 4 * p) * h);
    order2(p * h);
    order2(p * h);
  }
};

bool is_axis_of_symmetry(const Vec3& inertia, int k) {
  const double a = inertia[(k + 1) % 3], b = inertia[(k + 2) % 3];
  return std::abs(a - b) <= 1e-9 * std::max(a, b);  // equal but for the rounding of coordinates
}

// A body with two equal moments precesses steadily: about L at |L| / I_across, and about its own
// axis at what is left of its spin there.
Quat symmetric_rotation(const Quat& attitude, const Vec3& L, const Vec3& inertia, int axis,
                        double h) {
  const double across = inertia[(axis + 1) % 3];
  const double along = (attitude.conjugate() * L)[axis];
  const double own = h * along * (1 / inertia[axis] - 1 / across);
  return (rotation_by(L * (h / across)) * attitude * rotation_by(own * Vec3::Unit(axis)))
      .normalized();
}

}  // namespace

Quat rotation_by(const Vec3& r) {
  const double angle_sq = r.squaredNorm();
  if (angle_sq < 1e-8) {  // series: relative error below 1e-20
    const double s = 0.5 - angle_sq / 48;
    return Quat(1 - angle_sq / 8 + angle_sq * angle_sq / 384, s * r.x(), s * r.y(), s * r.z());
  }
  const double angle = std::sqrt(angle_sq);
  const double s = std::sin(angle / 2) / angle;
  return Quat(std::cos(angle / 2), s * r.x(), s * r.y(), s * r.z());
}

Quat free_rotation(const Quat& attitude, const Vec3& L, const Vec3& inertia, double h) {
  if (L.isZero(0) || h == 0) return attitude;
  for (int k = 0; k < 3; ++k)
    if (is_axis_of_symmetry(inertia, k)) return symmetric_rotation(attitude, L, inertia, k, h);
  SplitSpin spin{attitude, attitude.conjugate() * L, inertia.cwiseInverse()};
  double left = h;
  while (left > 0) {
    const double speed = spin.momentum.cwiseProduct(spin.per_inertia).norm();
    const double n = std::ceil(speed * left / largest_turn);
    const double part = n > 1 ? left / n : left;
    if (speed * part < 1e-3)  // order 2 errs by turn^3 / 12 < 1e-10 rad
      spin.order2(part);
    else
      spin.order4(part);
    left = n > 1 ? left - part : 0;
  }
  return spin.q.normalized();
}

}  // namespace talus
