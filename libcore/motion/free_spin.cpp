// Free spin of a rigid body in closed form (elliptic functions and theta series).
#include "motion/free_spin.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "motion/rotation.hpp"

namespace talus {
namespace {

constexpr double pi = std::numbers::pi;
// Parameters nearer to 1 make theta series long and lossy: there the body is about to flip.
constexpr double nearest_flip = 1e-7;

Phasor operator*(const Phasor& a, const Phasor& b) {
  return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}
Phasor conjugate(const Phasor& a) { return {a.re, -a.im}; }
Phasor phasor(double angle) { return {std::cos(angle), std::sin(angle)}; }
Phasor unit_of(const Phasor& a) {
  const double per_size = 1 / std::sqrt(a.re * a.re + a.im * a.im);
  return {a.re * per_size, a.im * per_size};
}

double geometric_mean_limit(double a, double b) {  // Gauss's AGM
  while (std::abs(a - b) > 1e-8 * a) {             // it halves the digits that are left
    const double mean = (a + b) / 2;
    b = std::sqrt(a * b);
    a = mean;
  }
  return (a + b) / 2;
}

// Carlson's R_F(x, y, 1), by duplication.
double carlson(double x, double y) {
  double z = 1, mean = (x + y + z) / 3;
  while (std::max({std::abs(mean - x), std::abs(mean - y), std::abs(mean - z)}) > 2e-3 * mean) {
    const double a = std::sqrt(x), b = std::sqrt(y), c = std::sqrt(z), l = a * b + b * c + c * a;
    x = (x + l) / 4, y = (y + l) / 4, z = (z + l) / 4, mean = (x + y + z) / 3;
  }
  const double dx = 1 - x / mean, dy = 1 - y / mean, dz = -dx - dy;
  const double e2 = dx * dy - dz * dz, e3 = dx * dy * dz;
  return (1 - e2 / 10 + e3 / 14 + e2 * e2 / 24 - 3 * e2 * e3 / 44) / std::sqrt(mean);
}

// F(phi | m), the incomplete integral of the first kind, for |phi| <= pi / 2.
double elliptic_integral(double sine, double cosine, double m) {
  return sine * carlson(cosine * cosine, 1 - m * sine * sine);
}

// theta_1 and theta_2 without their factor 2 q^(1/4), theta_3, theta_4, and theta_4(v + iy).
struct Thetas {
  double one = 0, two = 0, three = 1, four = 1;
  Phasor shifted, shifted_rate{0, 0};  // and its derivative by v
};

Thetas thetas(const FreeSpin& s, double v) {
  Thetas t;
  const Phasor unit = phasor(v), twice = unit * unit;
  Phasor odd = unit, even = twice;  // of (2 n + 1) v, of 2 n v
  t.one = s.terms[0].odd_signed * odd.im;
  t.two = s.terms[0].odd * odd.re;
  for (int n = 1; n < s.n_terms; ++n, even = even * twice) {
    const FreeSpin::Term& term = s.terms[n];
    odd = odd * twice;
    t.one += term.odd_signed * odd.im;
    t.two += term.odd * odd.re;
    t.three += term.even * even.re;
    t.four += term.even_signed * even.re;
    t.shifted.re += term.re * even.re;
    t.shifted.im -= term.im * even.im;
    t.shifted_rate.re -= 2 * n * term.re * even.im;
    t.shifted_rate.im -= 2 * n * term.im * even.re;
  }
  return t;
}

// Series in the nome q; those of theta_4(v + iy) with p = exp(-pi xi / K), y = pi (K' - xi) / 2 K.
void set_series(double q, double p, FreeSpin& s) {
  double sign = 1, q_n = 1, p_n = 1;
  double below = 1;  // q^(n (n - 1))
  for (s.n_terms = 0; s.n_terms < FreeSpin::most_terms; ++s.n_terms) {
    const double odd = below * q_n * q_n, even = 2 * below * q_n;
    const double less = below * p_n, more = odd / p_n;
    if (s.n_terms > 1 && less < 1e-17) return;
    s.terms[s.n_terms] = {odd,         sign * odd,           even,
                          sign * even, sign * (less + more), sign * (less - more)};
    below = odd;
    q_n *= q;
    p_n *= p;
    sign = -sign;
  }
}

// The momentum in the axes e, as a unit vector.
Vec3 momentum(const FreeSpin& s, const Thetas& t) {
  const double per_four = 1 / t.four;
  return Vec3(s.amplitude[0] * t.two * per_four, s.amplitude[1] * t.one * per_four,
              s.amplitude[2] * t.three * per_four)
      .normalized();
}

// Of half the angle, or that and half a turn.
Phasor half_angle(const Phasor& unit) {
  const double more = std::sqrt((1 + std::abs(unit.re)) / 2), less = unit.im / (2 * more);
  return unit.re >= 0 ? Phasor{more, less} : Phasor{less, more};
}

// Rotation by Euler's angles phi about z, theta about x, chi about z; body axes.
Quat euler_turn(const FreeSpin& s, const Vec3& l, const Phasor& phi) {
  const double across = std::sqrt(l.x() * l.x() + l.y() * l.y());
  const Phasor chi = across > 0 ? Phasor{l.y() / across, l.x() / across} : Phasor{};
  const Phasor sum = half_angle(phi * chi), difference = phi * conjugate(sum);
  const double larger = std::sqrt((1 + std::abs(l.z())) / 2), smaller = across / (2 * larger);
  const double c = l.z() >= 0 ? larger : smaller, d = l.z() >= 0 ? smaller : larger;
  Vec3 turn;
  turn[s.e[0]] = d * difference.re;
  turn[s.e[1]] = s.sense * d * difference.im;
  turn[s.e[2]] = c * sum.im;
  return Quat(c * sum.re, turn.x(), turn.y(), turn.z());
}

Quat elliptic_attitude(const FreeSpin& s, double t) {
  const Thetas theta = thetas(s, s.v_start + s.v_rate * t);
  const Phasor turned = unit_of(theta.shifted * conjugate(s.shifted_start));
  const Phasor phi = phasor(s.phase_rate * t) * (s.phase_sign > 0 ? turned : conjugate(turned));
  return (s.base * euler_turn(s, momentum(s, theta), phi)).normalized();
}

// L^2 - 2 E I_k, summed without cancellation where k is an extreme moment.
double excess(const Vec3& body, const Vec3& inertia, int k) {
  double sum = 0;
  for (int i = 0; i < 3; ++i)
    if (i != k) sum += body[i] * body[i] * ((inertia[i] - inertia[k]) / inertia[i]);
  return sum;
}

void set_axes(const Vec3& body, const Vec3& inertia, FreeSpin& s) {
  std::sort(s.e.begin(), s.e.end(), [&](int a, int b) { return inertia[a] < inertia[b]; });
  if (excess(body, inertia, s.e[1]) < 0) std::swap(s.e[0], s.e[2]);
  s.sense = (s.e[1] - s.e[0] + 3) % 3 == 1 ? 1 : -1;
}

// Everything for Kind::elliptic, or the kind to fall back on. `body`: momentum in body axes.
void set_elliptic(const Vec3& body, FreeSpin& s) {
  set_axes(body, s.inertia, s);
  const double I1 = s.inertia[s.e[0]], I2 = s.inertia[s.e[1]], I3 = s.inertia[s.e[2]];
  const double L1 = body[s.e[0]], L2 = s.sense * body[s.e[1]], L3 = body[s.e[2]];
  const double L_sq = body.squaredNorm();
  const double f1 = excess(body, s.inertia, s.e[0]), f3 = excess(body, s.inertia, s.e[2]);
  if (std::abs(f3) < 1e-30 * L_sq) {
    s.kind = FreeSpin::Kind::axis;
    return;
  }
  const double per_m = 1 / (f1 * (I3 - I2)), m = f3 * (I1 - I2) * per_m;
  const double m_rest = excess(body, s.inertia, s.e[1]) * (I3 - I1) * per_m;  // 1 - m
  s.kind = m_rest > nearest_flip ? FreeSpin::Kind::elliptic : FreeSpin::Kind::series;
  if (s.kind == FreeSpin::Kind::series) return;

  const double sign1 = L1 < 0 ? -1 : 1, sign3 = L3 < 0 ? -1 : 1;
  const double most1 = sign1 * std::sqrt(f3 * I1 / (I1 - I3));
  const double most2 = -sign1 * std::sqrt(f3 * I2 / (I2 - I3));
  const double most3 = sign3 * std::sqrt(f1 * I3 / (I3 - I1));
  const double u_rate = (I2 > I3 ? sign3 : -sign3) * std::sqrt(f1 * (I3 - I2) / (I1 * I2 * I3));
  const double K = pi / 2 / geometric_mean_limit(1, std::sqrt(m_rest));
  const double q = std::exp(-pi * pi / 2 / geometric_mean_limit(1, std::sqrt(m)) / K);
  const Phasor start = unit_of({L1 / most1, L2 / most2});  // cn, sn
  const Phasor xi = unit_of({std::sqrt(m) * std::abs(most3), std::abs(most1)});
  set_series(q, std::exp(-pi * elliptic_integral(xi.im, xi.re, m_rest) / K), s);
  s.v_rate = pi / 2 / K * u_rate;
  s.v_start = pi / 2 / K * elliptic_integral(start.im, start.re, m);

  const Thetas zero = thetas(s, 0), now = thetas(s, s.v_start);
  s.amplitude = {most1 * zero.four / zero.two, most2 * zero.three / zero.two,
                 most3 * zero.four / zero.three};
  s.shifted_start = now.shifted;
  const double by_axes = (L1 * L1 / I1 + L2 * L2 / I2) / (L1 * L1 + L2 * L2);
  const double difference = L1 * L1 * (I3 - I1) / (I1 * I3) + L2 * L2 * (I3 - I2) / (I2 * I3);
  s.phase_sign = (difference > 0) == (u_rate > 0) ? 1 : -1;
  const Phasor& z = now.shifted;
  const double angle_rate = (now.shifted_rate * conjugate(z)).im / (z.re * z.re + z.im * z.im);
  s.phase_rate = std::sqrt(L_sq) * by_axes - s.phase_sign * s.v_rate * angle_rate;
  s.base = s.attitude * euler_turn(s, momentum(s, now), {}).conjugate();
}

}  // namespace

FreeSpin free_spin(const Quat& attitude, const Vec3& L, const Vec3& inertia) {
  FreeSpin spin;
  spin.attitude = attitude;
  spin.L = L;
  spin.inertia = inertia;
  if (L.isZero(0)) return spin;
  if (has_two_equal_moments(inertia))
    spin.kind = FreeSpin::Kind::symmetric;
  else
    set_elliptic(attitude.conjugate() * L, spin);
  return spin;
}

Quat attitude_after(const FreeSpin& spin, double t) {
  switch (spin.kind) {
    case FreeSpin::Kind::still:
      break;
    case FreeSpin::Kind::axis:
      return (rotation_by(spin.L * (t / spin.inertia[spin.e[2]])) * spin.attitude).normalized();
    case FreeSpin::Kind::elliptic:
      return elliptic_attitude(spin, t);
    case FreeSpin::Kind::series:
      return series_rotation(spin.attitude, spin.L, spin.inertia, t);
    case FreeSpin::Kind::symmetric:
      if (t == 0) break;
      return symmetric_rotation(spin.attitude, spin.L, spin.inertia, axis_of_symmetry(spin.inertia),
                                t);
  }
  return spin.attitude;
}

}  // namespace talus
