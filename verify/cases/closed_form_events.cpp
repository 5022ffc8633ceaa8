// Cases whose error is that of when something happens: bounces, hits of a rolling prism, take-off,
// an edge that is passed, a border of the ground's classes; and a top, whose axis adds it up.
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "verify/cases/case_run.hpp"
#include "verify/cases/closed_form.hpp"
#include "verify/cases/closed_form_scenes.hpp"

namespace talus::cases {
namespace {

/// A step of the classic Runge-Kutta method, y' = rate(y).
template <std::size_t n, class Rate>
std::array<double, n> runge_kutta(const std::array<double, n>& y, double h, const Rate& rate) {
  const auto at = [&](double part, const std::array<double, n>& k) {
    std::array<double, n> sum = y;
    for (std::size_t i = 0; i < n; ++i) sum[i] += part * k[i];
    return sum;
  };
  const auto k1 = rate(y), k2 = rate(at(h / 2, k1)), k3 = rate(at(h / 2, k2)), k4 = rate(at(h, k3));
  std::array<double, n> end = y;
  for (std::size_t i = 0; i < n; ++i) end[i] += h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
  return end;
}

// Distance down 20 degrees of a slab that falls on its face from `drop` above, restitution e,
// friction 25 degrees: bounce after bounce; then it slides to rest.
double way_of_bounces(double drop, double e, double duration_s) {
  const double across = g * std::cos(20 * degree), along = g * std::sin(20 * degree),
               friction = std::tan(25 * degree);
  double t = std::sqrt(2 * drop / across), way = along * t * t / 2, speed = along * t,
         hit = across * t;
  while (hit > 1e-9) {
    speed = std::max(0.0, speed - friction * (1 + e) * hit);
    hit *= e;
    const double flight = std::min(2 * hit / across, duration_s - t);
    way += speed * flight + along * flight * flight / 2;
    speed += along * flight;
    t += flight;
  }
  const double slows = friction * across - along;
  const double slides = std::clamp(speed / slows, 0.0, duration_s - t);
  return way + slides * (speed - slows / 2 * slides);
}

}  // namespace

CaseResult bouncing_slab(const CaseSettings& settings, double restitution) {
  const SlopeFrame frame = slope_frame(20, 25);
  constexpr double drop = 1, duration_s = 5;
  const Body body = body_of(box_in(frame, drop * frame.normal, Vec3(-1, -1, 0), Vec3(1, 1, 0.3)));
  Run run(on_plane(settings, frame, ground_of(25, restitution), body, 12), settings.paper);
  const Vec3 from = run.motion().pose.position;
  run.advance_to(duration_s);
  const double value = (run.motion().pose.position - from).dot(frame.dip),
               expected = way_of_bounces(drop, restitution, duration_s);
  return run.finish(value, expected, std::abs(value / expected - 1));
}

namespace {

/// A prism on the edge about which it turns.
struct Pivoting {
  double angle = 0;  // of the centroid about the edge, from the slope's normal [rad]
  double spin = 0;   // down the slope [rad/s]
  int sides = 0;     // gone down
  bool rests = false;
};

// A side comes down flat, plastically: the next edge, down or up the slope, is the pivot then.
void touch_down(double half, double dip, Pivoting& at) {
  const double c = std::cos(2 * half), left = std::max(0.0, (2 + 7 * c) / (8 + c));
  const int down = at.angle > 0 ? 1 : -1;
  at.sides += down;
  at.angle -= 2 * half * down;
  at.spin *= left;
  at.rests = std::abs(at.spin) < 1e-6 && dip < half;
}

void pivot_on(double half, double dip, double h, Pivoting& at) {
  if (at.rests) return;
  const double inertia = (2 + std::cos(2 * half)) / 6 + 1;
  at.spin += h / 2 * g * std::sin(at.angle + dip) / inertia;
  at.angle += h * at.spin;
  at.spin += h / 2 * g * std::sin(at.angle + dip) / inertia;
  if (std::abs(at.angle) >= half && at.angle * at.spin > 0) touch_down(half, dip, at);
}

double way_of(double half, const Pivoting& at) {
  return 2 * std::sin(half) * at.sides + std::sin(at.angle);
}

}  // namespace

CaseResult prism_rolls(const CaseSettings& settings, const Rolling& rolling, double duration_s) {
  const SlopeFrame frame = slope_frame(rolling.dip_deg, 0);
  const double half = std::numbers::pi / rolling.n_sides, dip = rolling.dip_deg * degree,
               angle = rolling.begin * half;
  const Vec3 spin = rolling.spin * frame.strike,
             lever = std::cos(angle) * frame.normal + std::sin(angle) * frame.dip,
             edge = std::sin(half) * frame.dip;
  const Mat3 turn = rotation_by((angle + half) * frame.strike).toRotationMatrix();
  const Polyhedron shape = prism_on(frame, Vec3::Zero(), rolling.n_sides, 1, 0.5);
  const Body body = body_of(moved(shape, turn, edge), spin.cross(lever), spin);
  Run run(on_plane(settings, frame, ground_of(85), body, 30, 1, 10 * frame.dip), settings.paper);
  const Vec3 from = run.motion().pose.position;
  Pivoting at{.angle = angle, .spin = rolling.spin};
  double value = 0, expected = 0, farthest = 0;
  while (run.state.time < duration_s - settings.dt / 2) {
    run.advance();
    value = (run.motion().pose.position - from).dot(frame.dip);
    expected = timed_reference(run.result, [&] {
      const int n = static_cast<int>(std::lround(settings.dt * 1e5));
      for (int i = 0; i < n; ++i) pivot_on(half, dip, settings.dt / n, at);
      return way_of(half, at) - std::sin(angle);
    });
    farthest = std::max(farthest, std::abs(value - expected));
  }
  return run.finish(value, expected, farthest / std::abs(expected));
}

namespace {

// A cone of twelve sides on its tip at the origin, its axis along z.
Polyhedron top_of(double radius, double height) {
  constexpr int n = 12;
  std::vector<Vec3> vertices = {Vec3::Zero()};
  std::vector<std::vector<int>> faces(1);
  for (int k = 0; k < n; ++k) {
    const double angle = 2 * std::numbers::pi * k / n;
    vertices.push_back(Vec3(radius * std::cos(angle), radius * std::sin(angle), height));
    faces[0].push_back(k + 1);
    faces.push_back({0, (k + 1) % n + 1, k + 1});
  }
  return polyhedron(std::move(vertices), faces);
}

// Lean, its rate and azimuth of a top let go without precession (Lagrange), from azimuth 0.
std::array<double, 3> integrated_top(double lean, double along, double across, double weight,
                                     double spin, double time) {
  const double own = along * spin, upright = own * std::cos(lean);
  std::array<double, 3> y = {lean, 0, 0};
  constexpr int n = 20000;
  const auto rate = [&](const std::array<double, 3>& at) {
    const double s = std::sin(at[0]), c = std::cos(at[0]),
                 turning = (upright - own * c) / (across * s * s);
    return std::array<double, 3>{
        at[1], turning * turning * s * c - own * turning * s / across + weight * s / across,
        turning};
  };
  for (int i = 0; i < n; ++i) y = runge_kutta(y, time / n, rate);
  return y;
}

}  // namespace

CaseResult spinning_top(const CaseSettings& settings, double spin) {
  constexpr double lean = 20 * degree, height = 0.56, duration_s = 3;
  const Mat3 turn = Eigen::AngleAxisd(lean, Vec3::UnitY()).toRotationMatrix();
  const Vec3 axis = turn * Vec3::UnitZ();
  const Body body =
      body_of(moved(top_of(0.5, height), turn, Vec3::Zero()), Vec3::Zero(), spin * axis);
  Run run(on_plane(settings, slope_frame(0, 0), ground_of(80), body, 4), settings.paper);
  const Quat from = run.motion().pose.attitude;
  const double mass = run.scene.blocks.mass[0], arm = run.motion().pose.position.norm();
  const Mat3 R = from.toRotationMatrix();
  const Mat3 inertia = R * run.scene.blocks.inertia[0].asDiagonal() * R.transpose();
  const double along = axis.dot(inertia * axis),
               across = (inertia.trace() - along) / 2 + mass * arm * arm;
  run.advance_to(duration_s);
  const auto [theta, rate, phi] = timed_reference(run.result, [&] {
    return integrated_top(lean, along, across, mass * g * arm, spin, run.state.time);
  });
  const Vec3 expected(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                      std::cos(theta));
  const Vec3 value = run.motion().pose.attitude * (from.conjugate() * axis);
  const double apart = std::atan2(value.cross(expected).norm(), value.dot(expected)) / degree;
  return run.finish(std::acos(value.z()) / degree, theta / degree, apart);
}

namespace {

// The ground drops away at twice gravity for 0.3 s, with ramps of 1 ms.
AccelerationRecord drop_of_ground() {
  AccelerationRecord base;
  base.time = {0, 0.2, 0.201, 0.5, 0.501, 3};
  for (const double share : {0.0, 0.0, 1.0, 1.0, 0.0, 0.0})
    base.acceleration.push_back(Vec3(0, 0, -2 * share * g));
  return base;
}

// Height of a body dropped by the ground of drop_of_ground(), above the ground, after `time`.
double height_above_drop(double time) {
  constexpr double ramp = 1e-3, away = 0.2 + ramp / 2, plain = 0.3 - ramp;
  double z = 0, v = 0;
  const auto go = [&](double from, double to, double a_from, double a_to) {
    const double h = to - from;
    if (h <= 0) return;
    z += h * (v + h * (2 * a_from + a_to) / 6);
    v += h * (a_from + a_to) / 2;
  };
  const double rises = 0.2 + ramp, ends = rises + plain, falls = ends + ramp;
  go(away, std::min(time, rises), 0, g * (std::min(time, rises) - away) / (ramp / 2));
  go(rises, std::min(time, ends), g, g);
  go(ends, std::min(time, falls), g, g - 2 * g * (std::min(time, falls) - ends) / ramp);
  go(falls, time, -g, -g);
  return std::max(0.0, z);
}

}  // namespace

CaseResult lifted_slab(const CaseSettings& settings) {
  const SlopeFrame frame = slope_frame(0, 30);
  const Body body = body_of(box_in(frame, Vec3::Zero(), Vec3(-1, -0.7, 0), Vec3(1, 0.7, 0.4)));
  Scene scene = on_plane(settings, frame, ground_of(30), body, 5);
  scene.base = drop_of_ground();
  Run run(std::move(scene), settings.paper);
  const double from = run.motion().pose.position.z();
  double highest = 0, value = 0, error = 0;
  while (run.state.time < 1.2) {
    run.advance();
    const double z = run.motion().pose.position.z() - from,
                 expected = height_above_drop(run.state.time);
    highest = std::max(highest, expected);
    value = std::max(value, z);
    error = std::max(error, std::abs(z - expected));
  }
  return run.finish(value, highest, error / highest);
}

CaseResult slab_over_edge(const CaseSettings& settings) {
  constexpr double length = 4, thickness = 0.4, speed = 3, begin = -2.2, duration_s = 1.5;
  const SlopeFrame frame = slope_frame(0, 0);
  const Body body = body_of(box_in(frame, begin * Vec3::UnitX(), Vec3(-length / 2, -0.6, 0),
                                   Vec3(length / 2, 0.6, thickness)),
                            speed * Vec3::UnitX());
  const auto height = [](double x, double) { return x < 0.25 ? 0.0 : -8.0; };
  Run run(scene_of(make_trn(height, 0.5, 8), ground_of(0), {body}, settings), settings.paper);
  run.advance_to(duration_s);
  // x, z and turn of the slab, and their rates, from where its middle passes the edge
  const double inertia = (length * length + thickness * thickness) / 12;
  std::array<double, 6> y = {0, thickness / 2, 0, speed, 0, 0};
  const auto rate = [&](const std::array<double, 6>& at) {
    const Vec2 normal(std::sin(at[2]), std::cos(at[2])), face(normal.y(), -normal.x()),
        x(at[0], at[1]), v(at[3], at[4]), gravity(0, -g);
    const double lever = face.dot(x), w = at[5];
    const double force = -(normal.dot(gravity) + 2 * w * face.dot(v) - w * w * normal.dot(x)) /
                         (1 + lever * lever / inertia);
    return std::array<double, 6>{
        v.x(), v.y(), w, force * normal.x(), force * normal.y() - g, force * lever / inertia};
  };
  constexpr int n = 20000;
  const double h = (run.state.time + begin / speed) / n;
  for (int i = 0; i < n; ++i) y = runge_kutta(y, h, rate);
  const Motion end = run.motion();
  const double dx = end.pose.position.x() - y[0], dz = end.pose.position.z() - y[1];
  return run.finish(end.pose.position.z(), y[1], std::hypot(dx, dz));
}

namespace {

// Distance down a slope of `dip` of a slab whose front and rear corners cross, one after the other,
// onto ground of other friction `ahead` and `behind` them; friction is that of the corners by their
// loads.
double way_across_border(double dip, double length, double height, double ahead, double rear_at,
                         double friction_before, double friction_after, double duration_s) {
  double x = 0, v = 0;
  constexpr double h = 1e-5;
  const auto acceleration = [&] {
    const double front = x > ahead ? friction_after : friction_before,
                 rear = x > rear_at ? friction_after : friction_before;
    // (N_f - N_r) length = (front N_f + rear N_r) height, N_f + N_r = 1
    const double on_front = (length + rear * height) / (2 * length - (front - rear) * height);
    const double friction = front * on_front + rear * (1 - on_front);
    return g * (std::sin(dip) - friction * std::cos(dip));
  };
  for (double t = 0; t < duration_s - h / 2; t += h) {
    const double a = acceleration();
    x += h * (v + h / 2 * a);
    v += h * a;
  }
  return x;
}

}  // namespace

CaseResult border_slide(const CaseSettings& settings) {
  constexpr double dip_deg = 30, length = 0.4, height = 0.2, border = 2, duration_s = 1.6;
  const SlopeFrame frame = slope_frame(dip_deg, 0);
  const Vec3 base(0, 0.1, 0);
  const Body body =
      body_of(box_in(frame, base, Vec3(-length / 2, -0.15, 0), Vec3(length / 2, 0.15, height)));
  Scene scene = on_plane(settings, frame, ground_of(10), body, 8, 0.5);
  scene.ground.classes = {ground_of(10), ground_of(22)};
  const Trn& trn = scene.ground.trn;
  for (int row = 0; row < trn.n_rows - 1; ++row)
    for (int col = 0; col < trn.n_cols - 1; ++col)
      scene.ground.cell_class.push_back(node_point(trn, row, col).x() > border - 0.1 ? 1 : 0);
  Run run(std::move(scene), settings.paper);
  const Vec3 from = run.motion().pose.position;
  run.advance_to(duration_s);
  const double value = (run.motion().pose.position - from).dot(frame.dip);
  const double to_border = border / std::cos(dip_deg * degree);
  const double expected = timed_reference(run.result, [&] {
    return way_across_border(dip_deg * degree, length, height, to_border - length / 2,
                             to_border + length / 2, std::tan(10 * degree), std::tan(22 * degree),
                             run.state.time);
  });
  return run.finish(value, expected, std::abs(value / expected - 1));
}

}  // namespace talus::cases
