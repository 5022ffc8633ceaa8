// Finite rotation and free spin: power series, symmetric bodies, angular momentum.
#include "motion/rotation.hpp"

#include <algorithm>
#include <cmath>

namespace talus {
namespace {

constexpr double largest_turn = 0.5;      // |omega| h of one part [rad]
constexpr double spin_tolerance = 1e-13;  // of the last term of a part
constexpr int most_terms = 18;

/// Power series in s = t / h of the spin in body axes and of the attitude, from Euler's equations
/// omega_i' = kappa_i omega_j omega_k and q' = q (0, omega) / 2. Of a rigid body |kappa| <= 1
/// (its moments keep the triangle inequality), so that |omega| h alone says how fast it converges.
///
/// The convolutions dominate the cost of a flight. Each coefficient is kept in the orders of
/// components that their products need, so that a term of all of them is four multiplications of
/// lanes: q (0, omega) = left1 right1 + left2 right2 - left3 right3, and right3 right2 for omega'.
struct SpinSeries {
  using Lanes = Eigen::Array4d;
  Lanes q[most_terms + 1];                                                       // x, y, z, w
  Lanes left1[most_terms + 1], left2[most_terms + 1], left3[most_terms + 1];     // of q
  Lanes right1[most_terms + 1], right2[most_terms + 1], right3[most_terms + 1];  // of omega
  int last = 0;                                                                  // order reached

  // Terms up to the first two in a row that no longer count.
  SpinSeries(const Quat& attitude, const Vec3& spin, const Vec3& kappa, double h) {
    const Lanes factor(kappa.x(), kappa.y(), kappa.z(), 0);
    set_spin(0, Lanes(h * spin.x(), h * spin.y(), h * spin.z(), 0));
    set_attitude(0, attitude.coeffs().array());
    double before = 1;
    for (last = 1; last <= most_terms; ++last) {
      const double size = add_term(last - 1, factor);
      if (std::max(size, before) < spin_tolerance) return;
      before = size;
    }
    last = most_terms;
  }

  void set_spin(int k, const Lanes& w) {
    right1[k] = Lanes(w[0], w[1], w[2], w[0]);
    right2[k] = Lanes(w[2], w[0], w[1], w[1]);
    right3[k] = Lanes(w[1], w[2], w[0], w[2]);
  }
  void set_attitude(int k, const Lanes& c) {
    q[k] = c;
    left1[k] = Lanes(c[3], c[3], c[3], -c[0]);
    left2[k] = Lanes(c[1], c[2], c[0], -c[1]);
    left3[k] = Lanes(c[2], c[0], c[1], c[2]);
  }

  // Term k + 1 from those up to k; its size.
  double add_term(int k, const Lanes& kappa) {
    Lanes w = Lanes::Zero(), c = Lanes::Zero();
    for (int j = 0; j <= k; ++j) {
      const int i = k - j;
      w += right3[j] * right2[i];
      c += left1[j] * right1[i] + left2[j] * right2[i] - left3[j] * right3[i];
    }
    const double per_order = 1.0 / (k + 1);
    set_spin(k + 1, per_order * kappa * w);
    set_attitude(k + 1, 0.5 * per_order * c);
    return size_of(k + 1);
  }

  [[nodiscard]] double size_of(int k) const { return right1[k].abs().max(q[k].abs()).maxCoeff(); }

  // Attitude at s; by Horner's scheme.
  [[nodiscard]] Quat at(double s) const {
    Lanes sum = q[last];
    for (int k = last - 1; k >= 0; --k) sum = sum * s + q[k];
    return Quat(Eigen::Vector4d(sum.matrix())).normalized();
  }

  // Largest s <= 1 at which the last term is small, by halving.
  [[nodiscard]] double reach() const {
    double size = size_of(last), s = 1;
    while (s > 1e-3 && size > spin_tolerance) size = std::ldexp(size, -last), s /= 2;
    return s;
  }
};

Vec3 euler_factors(const Vec3& inertia, const Vec3& inverse_inertia) {
  return Vec3(inertia.y() - inertia.z(), inertia.z() - inertia.x(), inertia.x() - inertia.y())
      .cwiseProduct(inverse_inertia);
}

bool is_axis_of_symmetry(const Vec3& inertia, int k) {
  const double a = inertia[(k + 1) % 3], b = inertia[(k + 2) % 3];
  return std::abs(a - b) <= 1e-9 * std::max(a, b);  // equal but for the rounding of coordinates
}

}  // namespace

int axis_of_symmetry(const Vec3& inertia) {
  for (int k = 0; k < 3; ++k)
    if (is_axis_of_symmetry(inertia, k)) return k;
  return -1;
}

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

Quat symmetric_rotation(const Quat& attitude, const Vec3& L, const Vec3& inertia, int axis,
                        double h) {
  const double across = inertia[(axis + 1) % 3];
  const double along = (attitude.conjugate() * L)[axis];
  const double own = h * along * (1 / inertia[axis] - 1 / across);
  return (rotation_by(L * (h / across)) * attitude * rotation_by(own * Vec3::Unit(axis)))
      .normalized();
}

Quat series_rotation(const Quat& attitude, const Vec3& L, const Vec3& inertia, double h) {
  const Vec3 inverse_inertia = inertia.cwiseInverse(),
             kappa = euler_factors(inertia, inverse_inertia);
  Quat q = attitude;
  for (double left = h; left > 0;) {
    const Vec3 spin = (q.conjugate() * L).cwiseProduct(inverse_inertia);  // L is kept exactly
    const double n = std::ceil(spin.norm() * left / largest_turn);
    const double part = n > 1 ? left / n : left;
    const SpinSeries series(q, spin, kappa, part);
    const double share = series.reach();
    q = series.at(share);
    left = n > 1 || share < 1 ? left - share * part : 0;
  }
  return q;
}

double fastest_spin(const Quat& attitude, const Vec3& L, const Vec3& inertia) {
  const double twice_energy = (attitude.conjugate() * L).cwiseAbs2().cwiseQuotient(inertia).sum();
  const double low = 1 / inertia.maxCoeff(), high = 1 / inertia.minCoeff();
  return std::sqrt(std::max(0.0, twice_energy * (low + high) - L.squaredNorm() * low * high));
}

}  // namespace talus
