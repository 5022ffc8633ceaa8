// Free rotation: closed form, series, bounds of spin.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/random.hpp"
#include "motion/free_rotation.hpp"
#include "motion/free_spin.hpp"
#include "motion/rotation.hpp"

namespace {

using talus::Quat;
using talus::Vec3;

double degrees(double radians) { return radians * 180 / std::numbers::pi; }

// Independent reference: Euler's equations and the attitude by the classic Runge-Kutta method.
struct EulerState {
  Vec3 omega;         // body axes
  Eigen::Vector4d q;  // w x y z
};
EulerState rate(const EulerState& s, const Vec3& I) {
  const Vec3 Iw = I.cwiseProduct(s.omega);
  EulerState r;
  r.omega = (Iw.cross(s.omega)).cwiseQuotient(I);
  const Vec3& w = s.omega;
  const auto& q = s.q;
  r.q << -q[1] * w.x() - q[2] * w.y() - q[3] * w.z(), q[0] * w.x() + q[2] * w.z() - q[3] * w.y(),
      q[0] * w.y() + q[3] * w.x() - q[1] * w.z(), q[0] * w.z() + q[1] * w.y() - q[2] * w.x();
  r.q *= 0.5;
  return r;
}
Quat reference_attitude(const Vec3& I, const Vec3& omega0, double t_end, int n) {
  EulerState s{omega0, {1, 0, 0, 0}};
  const double h = t_end / n;
  const auto plus = [](const EulerState& a, const EulerState& b, double f) {
    return EulerState{a.omega + f * b.omega, a.q + f * b.q};
  };
  for (int i = 0; i < n; ++i) {
    const auto k1 = rate(s, I), k2 = rate(plus(s, k1, h / 2), I);
    const auto k3 = rate(plus(s, k2, h / 2), I), k4 = rate(plus(s, k3, h), I);
    s.omega += h / 6 * (k1.omega + 2 * k2.omega + 2 * k3.omega + k4.omega);
    s.q += h / 6 * (k1.q + 2 * k2.q + 2 * k3.q + k4.q);
  }
  return Quat(s.q[0], s.q[1], s.q[2], s.q[3]).normalized();
}

Vec3 box_inertia(double a, double b, double c) {  // of unit density
  const double m = a * b * c;
  return {m * (b * b + c * c) / 12, m * (a * a + c * c) / 12, m * (a * a + b * b) / 12};
}

double attitude_error_deg(double dt, double t_end) {
  const Vec3 I = box_inertia(2, 3, 5), omega(0.02, 5, 0.01);
  const Quat truth = reference_attitude(I, omega, t_end, 400000);
  const Vec3 L = I.cwiseProduct(omega);
  Quat q = Quat::Identity();
  const int n = static_cast<int>(std::lround(t_end / dt));
  for (int i = 0; i < n; ++i) q = talus::free_rotation(q, L, I, dt);
  return degrees(q.angularDistance(truth));
}

// Row 7: free rotation about the middle axis within 0.01 degrees after 10 s at dt = 2e-3.
TEST(FreeRotation, MiddleAxisWithinHundredthOfADegree) {
  EXPECT_LT(attitude_error_deg(2e-3, 10), 1e-5);
  EXPECT_LT(attitude_error_deg(1e-2, 10), 1e-3);
  EXPECT_LT(attitude_error_deg(10, 10), 1e-3);  // one call: its own substeps decide
}

// Errors of the series are those of rounding, whatever the steps asked for (the reference: 1e-8).
TEST(FreeRotation, StepsDoNotMatter) {
  for (const double dt : {4.0, 0.4, 0.01}) EXPECT_LT(attitude_error_deg(dt, 4), 1e-7) << dt;
}

// Plates, needles and rods near the flip: no spin in between is faster than the bound.
TEST(FreeRotation, FastestSpinBounds) {
  for (const Vec3& sides : {Vec3(1, 2, 3), Vec3(0.01, 1, 1.2), Vec3(1, 0.02, 0.013)})
    for (const Vec3& omega : {Vec3(0.01, 5, 0.02), Vec3(3, -4, 5), Vec3(40, 1, 2)}) {
      const Vec3 I = box_inertia(sides.x(), sides.y(), sides.z()), L = I.cwiseProduct(omega);
      const double bound = talus::fastest_spin(Quat::Identity(), L, I);
      const talus::FreeSpin spin = talus::free_spin(Quat::Identity(), L, I);
      double fastest = 0;
      for (int k = 0; k <= 180; ++k) {
        const Quat q = talus::attitude_after(spin, k * 0.25 / bound);
        fastest = std::max(fastest, talus::angular_velocity(q, L, I).norm());
      }
      EXPECT_LE(fastest, bound * (1 + 1e-9));
      EXPECT_GT(fastest, 0.5 * omega.norm());
    }
}

double apart(const Quat& a, const Quat& b) {  // of either sign
  return std::min((a.coeffs() - b.coeffs()).norm(), (a.coeffs() + b.coeffs()).norm());
}

// Bodies of any shape that spin about any axis, among them some about a principal axis but for
// 1e-8, and some with moments that differ by 1e-6: the closed form is the series.
TEST(FreeSpin, ClosedFormIsTheSeries) {
  talus::Random random(11, "free spin");
  const auto size = [&] { return std::exp(random.uniform(-2, 2)); };
  const auto share = [&] { return random.uniform(-1, 1); };
  int n_kinds[5] = {};
  for (int trial = 0; trial < 3000; ++trial) {
    const Vec3 sides = trial % 4 == 1 ? Vec3(1, 1 + std::pow(10, random.uniform(-6, -1)), 2)
                                      : Vec3(size(), size(), size());
    const Vec3 I = box_inertia(sides.x(), sides.y(), sides.z());
    const Quat attitude = Quat(share(), share(), share(), share()).normalized();
    Vec3 omega(share(), share(), share());
    if (trial % 3 == 1)
      for (int k = 0; k < 3; ++k)
        if (k != trial / 3 % 3) omega[k] *= std::pow(10, random.uniform(-8, 0));
    const Vec3 L = attitude * I.cwiseProduct(omega).eval();  // omega in body axes
    const talus::FreeSpin spin = talus::free_spin(attitude, L, I);
    ++n_kinds[static_cast<int>(spin.kind)];
    EXPECT_LT(apart(talus::attitude_after(spin, 0), attitude), 1e-12) << trial;
    const double t = random.uniform(0, 6) / omega.norm();
    const double error =
        apart(talus::attitude_after(spin, t), talus::series_rotation(attitude, L, I, t));
    EXPECT_LT(error, 1e-9) << trial;  // near the flip, rounding grows tenfold in 2.3 rad
  }
  EXPECT_GT(n_kinds[static_cast<int>(talus::FreeSpin::Kind::elliptic)], 2500);
  EXPECT_GT(n_kinds[static_cast<int>(talus::FreeSpin::Kind::series)], 10);
}

// Far from the flip the closed form keeps its digits however far the body turns: half of the time
// twice is the whole of it, after 2,000 turns.
TEST(FreeSpin, TimeDoesNotMatter) {
  const Vec3 I = box_inertia(1, 2, 3), L = I.cwiseProduct(Vec3(3, -1, 5));
  const talus::FreeSpin spin = talus::free_spin(Quat::Identity(), L, I);
  const double t = 2000;
  const Quat half = talus::attitude_after(spin, t / 2);
  const Quat twice = talus::attitude_after(talus::free_spin(half, L, I), t / 2);
  EXPECT_LT(apart(twice, talus::attitude_after(spin, t)), 1e-10);
}

TEST(FreeSpin, StillAndAboutAnAxis) {
  const Vec3 I = box_inertia(1, 2, 3);
  const talus::FreeSpin still = talus::free_spin(Quat(0.6, 0, 0.8, 0), Vec3::Zero(), I);
  EXPECT_EQ(talus::attitude_after(still, 5).coeffs(), Quat(0.6, 0, 0.8, 0).coeffs());
  for (int k = 0; k < 3; ++k) {
    const talus::FreeSpin spin = talus::free_spin(Quat::Identity(), 7 * I[k] * Vec3::Unit(k), I);
    const Quat truth(Eigen::AngleAxisd(7 * 0.9, Vec3::Unit(k)));
    EXPECT_LT(apart(talus::attitude_after(spin, 0.9), truth), 1e-13) << k;
  }
}

// The classic DDA update keeps omega: the attitude is then wrong by tens of degrees at every dt.
TEST(FreeRotation, SpinVectorMovesAsItMust) {
  const Vec3 I = box_inertia(1, 2, 3), omega0(0.1, 5, 0.1);
  const Vec3 L = I.cwiseProduct(omega0);
  const double energy = 0.5 * omega0.dot(L);
  Quat q = Quat::Identity();
  double largest_change = 0;
  for (int i = 0; i < 1000; ++i) {
    q = talus::free_rotation(q, L, I, 0.01);
    const Vec3 omega = talus::angular_velocity(q, L, I);
    EXPECT_NEAR(0.5 * omega.dot(L) / energy, 1, 1e-6);
    EXPECT_LT((talus::angular_momentum(q, omega, I) - L).norm() / L.norm(), 1e-12);
    largest_change = std::max(largest_change, (q.conjugate() * omega - omega0).norm());
  }
  EXPECT_GT(largest_change, 5);  // it tumbles
}

TEST(FreeRotation, EqualMomentsTurnExactly) {
  const Vec3 I = Vec3::Constant(2.0), omega(0.3, -2, 1);
  const Quat q = talus::free_rotation(Quat::Identity(), 2 * omega, I, 1.7);
  const Quat truth(Eigen::AngleAxisd(1.7 * omega.norm(), omega.normalized()));
  EXPECT_LT(q.angularDistance(truth), 1e-14);
}

TEST(FreeRotation, TwoEqualMomentsTurnExactly) {
  const Vec3 I(1, 3, 3), omega(4, 1, -2);
  const Vec3 L = I.cwiseProduct(omega);
  const Quat q = talus::free_rotation(Quat::Identity(), L, I, 5);
  EXPECT_LT(degrees(q.angularDistance(reference_attitude(I, omega, 5, 200000))), 1e-8);
}

// Theory 1.9: the linear update multiplies areas by 1 + |r|^2 a step; the exponential does not.
TEST(RotationBy, IsARotationForAnyAngle) {
  for (const double angle : {0.0, 1e-9, 1e-5, 1e-4, 1e-3, 0.1, 1.0, 3.0, 20.0}) {
    const Vec3 axis = Vec3(1, -2, 0.5).normalized();
    const Quat q = talus::rotation_by(angle * axis);
    EXPECT_NEAR(q.norm(), 1, 1e-15);
    EXPECT_LT((q.toRotationMatrix() - Eigen::AngleAxisd(angle, axis).toRotationMatrix()).norm(),
              1e-14);
  }
}

}  // namespace
