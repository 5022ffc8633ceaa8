#include "verify/closed_form.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

#include "dda/displacement.hpp"
#include "verify/case_run.hpp"
#include "verify/cases.hpp"

namespace talus::cases {
namespace {

Scene on_plane(const Settings& settings, const SlopeFrame& frame, const GroundClass& ground,
               const Body& body, double reach, double cell_size = 0.5,
               const Vec3& through = Vec3::Zero()) {
  return scene_of(plane_trn(frame, cell_size, reach, through), ground, {body}, settings);
}

Polyhedron cube_on(const SlopeFrame& frame, double side, const Vec3& base = Vec3::Zero()) {
  const double h = side / 2;
  return box_in(frame, base, Vec3(-h, -h, 0), Vec3(h, h, side));
}

struct Path2 {
  Vec2 end = Vec2::Zero();  // down the dip, along the strike [m]
  double length = 0;        // [m]
};

// From 10 m/s along the strike of 30 degrees, friction 20 degrees, after `time`:
// dv/dt = g sin(30) dip - mu g cos(30) v / |v|, by the classic Runge-Kutta method.
Path2 integrated_oblique_slide(double time) {
  const double drive = g * std::sin(30 * degree);
  const double brake = g * std::cos(30 * degree) * std::tan(20 * degree);
  const auto rate = [&](const Vec2& v) { return Vec2(Vec2(drive, 0) - brake * v.normalized()); };
  Path2 path;
  Vec2 v(0, 10);
  constexpr int n = 20000;
  const double h = time / n;
  for (int i = 0; i < n; ++i) {
    const Vec2 k1 = rate(v), k2 = rate(v + h / 2 * k1), k3 = rate(v + h / 2 * k2),
               k4 = rate(v + h * k3);
    path.end += h * v + h * h / 6 * (k1 + k2 + k3);
    path.length += h * v.norm();
    v += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  return path;
}

// Spin in body axes and attitude of a free body, from an attitude of 1, after `time`: Euler's
// equations by the classic Runge-Kutta method.
using State7 = Eigen::Matrix<double, 7, 1>;
State7 integrated_free_spin(const Vec3& inertia, const Vec3& spin, double time) {
  const auto rate = [&](const State7& s) {
    const Vec3 w = s.head<3>();
    State7 r;
    r.head<3>() = (inertia.cwiseProduct(w).cross(w)).cwiseQuotient(inertia);
    const Quat q(s[3], s[4], s[5], s[6]), dq = q * Quat(0, w.x() / 2, w.y() / 2, w.z() / 2);
    r.tail<4>() << dq.w(), dq.x(), dq.y(), dq.z();
    return r;
  };
  State7 s;
  s << spin, 1, 0, 0, 0;
  constexpr int n = 200000;
  const double h = time / n;
  for (int i = 0; i < n; ++i) {
    const State7 k1 = rate(s), k2 = rate(s + h / 2 * k1), k3 = rate(s + h / 2 * k2),
                 k4 = rate(s + h * k3);
    s += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  return s;
}

// Time in which the column falls from half its slenderness to upright:
// (theta - alpha)'' = p^2 sin(theta - alpha), p^2 = 3 g / (4 R), by velocity Verlet.
double integrated_rocking_time() {
  const double alpha = std::atan(0.25), R = std::hypot(0.25, 1.0), p_sq = 3 * g / (4 * R);
  double theta = alpha / 2, rate = 0, t = 0;
  const double step_s = 1e-6;
  while (theta > 0) {
    rate -= step_s / 2 * p_sq * std::sin(alpha - theta);
    theta += step_s * rate;
    rate -= step_s / 2 * p_sq * std::sin(alpha - theta);
    t += step_s;
  }
  return t;
}

}  // namespace

CaseResult parabola(const Settings& settings) {
  const SlopeFrame flat = slope_frame(0, 0);
  const Body body =
      body_of(box_in(flat, Vec3(0, 0, 50), Vec3(-1, -1, -1), Vec3(1, 1, 1)), Vec3(0, 10, 0));
  Run run(on_plane(settings, flat, ground_of(0), body, 40, 2));
  const Vec3 from = run.motion().pose.position;
  run.advance_to(1);
  const double t = run.state.time;
  const Vec3 moved = run.motion().pose.position - from;
  const Vec3 expected(0, 10 * t, -g * t * t / 2);
  return run.finish(moved.z(), expected.z(), (moved - expected).cwiseAbs().maxCoeff());
}

CaseResult sliding(const Settings& settings, double friction_deg, double azimuth_deg,
                   double duration_s, const Vec3& offset, double cell_size) {
  const SlopeFrame frame = slope_frame(30, azimuth_deg);
  Run run(on_plane(settings, frame, ground_of(friction_deg), body_of(cube_on(frame, 1, offset)), 60,
                   cell_size, offset));
  const bool sticks = friction_deg >= 30;
  if (sticks) run.advance_to(duration_s / 4);
  const Vec3 from = run.motion().pose.position;
  run.advance_to(duration_s);
  const Vec3 moved = run.motion().pose.position - from;
  if (sticks) return run.finish(moved.norm(), 0, moved.norm());
  const double a =
      g * (std::sin(30 * degree) - std::tan(friction_deg * degree) * std::cos(30 * degree));
  const double expected = a * run.state.time * run.state.time / 2;  // (26)
  return run.finish(moved.dot(frame.dip), expected,
                    (moved - expected * frame.dip).norm() / expected);
}

CaseResult oblique_slide(const Settings& settings, double azimuth_deg) {
  const SlopeFrame frame = slope_frame(30, azimuth_deg);
  Run run(
      on_plane(settings, frame, ground_of(20), body_of(cube_on(frame, 1), 10 * frame.strike), 40));
  const Vec3 from = run.motion().pose.position;
  run.advance_to(2);
  const Path2 path =
      timed_reference(run.result, [&] { return integrated_oblique_slide(run.state.time); });
  const Vec3 moved = run.motion().pose.position - from;
  const Vec2 in_plane(moved.dot(frame.dip), moved.dot(frame.strike));
  return run.finish(in_plane.y(), path.end.y(), (in_plane - path.end).norm() / path.length);
}

CaseResult rolling_angle(const Settings& settings, int n_sides) {
  const double expected = 180.0 / n_sides;
  CaseResult total;
  const auto rolls = [&](double dip) {
    const SlopeFrame frame = slope_frame(dip, 20);
    Run run(on_plane(settings, frame, ground_of(80),
                     body_of(prism_on(frame, Vec3::Zero(), n_sides, 1, 0.5)), 10));
    const Quat from = run.motion().pose.attitude;
    bool rolled = false;
    while (!rolled && run.state.time < 6) {
      run.advance();
      rolled = run.motion().pose.attitude.angularDistance(from) > 90 / n_sides * degree;
    }
    add_counts(run.counted(), total);
    return rolled;
  };
  total.expected = expected;
  total.value = bisect(0.95 * expected, 1.05 * expected, 14, rolls);
  total.error = std::abs(total.value - expected);
  return total;
}

CaseResult sustained_rolling(const Settings& settings, int n_sides) {
  const SlopeFrame frame = slope_frame(10, 0);
  const double half = std::numbers::pi / n_sides, apothem = std::cos(half);
  const Vec3 edge = std::sin(half) * frame.dip, spin = 1.5 * frame.strike;
  const Body body = body_of(prism_on(frame, Vec3::Zero(), n_sides, 1, 0.5),
                            spin.cross(apothem * frame.normal - edge), spin);
  const Vec3 middle = 60 * frame.dip;
  Run run(on_plane(settings, frame, ground_of(80), body, 70, 2, middle));
  // before an impact: the fastest spin of each side's length of way
  const double side = 2 * std::sin(half);
  double before = 0, fastest = 0, next = side;
  for (double at = 0; at < 100 && run.state.time < 60;) {
    run.advance();
    at = run.motion().pose.position.dot(frame.dip);
    if (at > next) before = std::exchange(fastest, 0), next += side;
    for (const Segment& segment : run.work.segments)
      fastest = std::max(fastest, run.spin(segment.end).norm());
  }
  const double c = std::cos(2 * half), kappa = (2 + 7 * c) / (8 + c);
  const double inertia = (2 + c) / 6 + 1, s = 2 * std::sin(half);  // about an edge, over m R^2
  const double expected =
      std::sqrt(2 * g * s * std::sin(10 * degree) / (inertia * (1 - kappa * kappa)));
  return run.finish(before, expected, std::abs(before / expected - 1));
}

CaseResult bounce(const Settings& settings, double restitution, Landing landing) {
  Polyhedron cube = box(Vec3::Constant(-0.5), Vec3::Constant(0.5));
  if (landing == Landing::edge)
    cube =
        moved(cube, Eigen::AngleAxisd(45 * degree, Vec3::UnitX()).toRotationMatrix(), Vec3::Zero());
  if (landing == Landing::corner)
    cube = moved(cube, Quat::FromTwoVectors(Vec3::Ones(), Vec3::UnitZ()).toRotationMatrix(),
                 Vec3::Zero());
  double low = 0;
  for (const Vec3& v : cube.vertices) low = std::max(low, -v.z());
  const Body body = body_of(moved(cube, Mat3::Identity(), Vec3::Zero(), Vec3(0.1, 0.2, low + 5)));
  Run run(on_plane(settings, slope_frame(0, 0), ground_of(25, restitution), body, 10));
  double error = 0, expected = 5, height = 0;
  int found = 0;
  while (found < 3 && run.state.time < 9) {
    run.advance();
    for (const Segment& segment : run.work.segments) {
      const double up = segment.start.velocity.z(), z = segment.start.pose.position.z() - low;
      if (found == 3 || up <= 0 || segment.end.velocity.z() > 0) continue;
      height = z + up * up / (2 * g);
      expected *= restitution * restitution;
      error = std::max(error, std::abs(height / expected - 1));
      ++found;
    }
  }
  return run.finish(height, expected, found == 3 ? error : 1);
}

namespace {

// (1 + e)(-v_n) / (n^T W n) of a cube that lands on its lowest corner as `before` says.
double impulse_on_corner(const Run& run, const Motion& before, double restitution) {
  Vec3 lever = Vec3::Zero();
  for (const Vec3& X : vertices_of(run.scene.blocks.shapes, 0)) {
    const Vec3 arm = before.pose.attitude * X;
    if (arm.z() < lever.z()) lever = arm;
  }
  const double inertia = run.scene.blocks.inertia[0].x();
  const double W =
      1 / run.scene.blocks.mass[0] + lever.cross(Vec3::UnitZ()).squaredNorm() / inertia;
  return -(1 + restitution) * (before.velocity.z() + run.spin(before).cross(lever).z()) / W;
}

// Momentum that the ground gives from the step in which law paper's springs touch to that in which
// they let go.
CaseResult impulse_of_springs(Run& run, double restitution) {
  Motion before = run.motion();
  double since = 0;
  bool touched = false;
  while (run.state.time < 2) {
    const Motion start = run.motion();
    const double t = run.state.time;
    run.advance();
    const bool touches = !run.state.memory[0].empty();
    if (touches && !touched) before = start, since = t;
    if (touched && !touches) {
      const double rise = (run.motion().velocity - before.velocity).z();
      const double impulse = run.scene.blocks.mass[0] * (rise + g * (run.state.time - since));
      const double expected = impulse_on_corner(run, before, restitution);
      return run.finish(impulse, expected, std::abs(impulse / expected - 1));
    }
    touched = touches;
  }
  return run.finish(0, 1, 1);
}

}  // namespace

CaseResult corner_impulse(const Settings& settings, double restitution) {
  const Mat3 turn = (Eigen::AngleAxisd(0.4, Vec3::UnitX()) * Eigen::AngleAxisd(0.3, Vec3::UnitY()))
                        .toRotationMatrix();
  const Polyhedron cube = box(Vec3::Constant(-0.5), Vec3::Constant(0.5));
  const Body body = body_of(moved(cube, turn, Vec3::Zero(), Vec3(0, 0, 2)), Vec3(3, 1, 0));
  Run run(on_plane(settings, slope_frame(0, 0), ground_of(0, restitution), body, 20));
  if (settings.law == Law::paper) return impulse_of_springs(run, restitution);
  const double mass = run.scene.blocks.mass[0];
  while (run.state.time < 2) {
    run.advance();
    const auto& segments = run.work.segments;
    for (std::size_t k = 1; k < segments.size(); ++k) {
      const Motion &before = segments[k - 1].end, &after = segments[k].start;
      const double impulse = mass * (after.velocity - before.velocity).z();
      if (impulse < 0.1 * mass) continue;
      const double expected = impulse_on_corner(run, before, restitution);
      return run.finish(impulse, expected, std::abs(impulse / expected - 1));
    }
  }
  return run.finish(0, 1, 1);
}

namespace {

// A box high above the ground, thrown up and spinning about its middle axis; back after the
// duration.
const Vec3 throw_spin(0.02, 5, 0.01);
Vec3 throw_velocity(double duration_s) { return {1, 0, g * duration_s / 2}; }
Scene thrown_box(const Settings& settings, double duration_s) {
  const SlopeFrame flat = slope_frame(0, 0);
  const Body body = body_of(box_in(flat, Vec3(0, 0, 600), Vec3(-1, -1.5, -2.5), Vec3(1, 1.5, 2.5)),
                            throw_velocity(duration_s), throw_spin);
  return on_plane(settings, flat, ground_of(0), body, 100, 10);
}

}  // namespace

CaseResult tumbling_flight(const Settings& settings, double duration_s) {
  Run run(thrown_box(settings, duration_s));
  const Vec3 from = run.motion().pose.position;
  run.advance_to(duration_s);
  const double t = run.state.time;
  const Vec3 moved = run.motion().pose.position - from;
  const Vec3 expected = t * throw_velocity(duration_s) - Vec3(0, 0, g * t * t / 2);
  return run.finish(moved.x(), expected.x(), (moved - expected).cwiseAbs().maxCoeff());
}

CaseResult free_spin(const Settings& settings, double duration_s) {
  Run run(thrown_box(settings, duration_s));
  const Vec3 inertia = run.scene.blocks.inertia[0], L = run.motion().angular_momentum;
  run.advance_to(duration_s);
  const State7 s = timed_reference(
      run.result, [&] { return integrated_free_spin(inertia, throw_spin, run.state.time); });
  const Quat truth = Quat(s[3], s[4], s[5], s[6]).normalized();
  const double error = run.motion().pose.attitude.angularDistance(truth) / degree;
  run.result.momentum_change = (run.motion().angular_momentum - L).norm() / L.norm();
  return run.finish(error, 0, error);
}

namespace {

/// The valley of the wedge, turned so that its line runs along a row of nodes.
struct WedgeGeometry {
  Vec3 normal_a, normal_b, line;
};
WedgeGeometry wedge_geometry() {
  const auto normal = [](double dip_deg, double direction_deg) {
    const double dip = dip_deg * degree, azimuth = (90 - direction_deg) * degree;
    return Vec3(std::sin(dip) * std::cos(azimuth), std::sin(dip) * std::sin(azimuth),
                std::cos(dip));
  };
  Vec3 a = normal(40, 130), b = normal(60, 220);
  Vec3 line = a.cross(b).normalized();
  if (line.z() > 0) line = -line;
  const Mat3 turn =
      Eigen::AngleAxisd(-std::atan2(line.y(), line.x()), Vec3::UnitZ()).toRotationMatrix();
  return {turn * a, turn * b, turn * line};
}

Run wedge_run(const Settings& settings, double friction_deg) {
  const WedgeGeometry w = wedge_geometry();
  const auto height = [&](double x, double y) {
    return std::max(-(w.normal_a.x() * x + w.normal_a.y() * y) / w.normal_a.z(),
                    -(w.normal_b.x() * x + w.normal_b.y() * y) / w.normal_b.z());
  };
  const auto up = [&](const Vec3& normal, const Vec3& other) {
    const Vec3 u = normal.cross(w.line).normalized();
    return Vec3(u.dot(other) < 0 ? -u : u);
  };
  const Vec3 on_a = up(w.normal_a, w.normal_b), on_b = up(w.normal_b, w.normal_a);
  std::vector<Vec3> corners = {Vec3::Zero(), w.line, on_a, on_a + w.line, on_b, on_b + w.line};
  std::vector<std::vector<int>> faces = {
      {0, 2, 4}, {1, 5, 3}, {0, 1, 3, 2}, {0, 4, 5, 1}, {2, 3, 5, 4}};
  if (moments(polyhedron(corners, faces)).volume < 0)
    for (auto& f : faces) std::reverse(f.begin(), f.end());
  return Run(scene_of(make_trn(height, 0.5, 15), ground_of(friction_deg),
                      {body_of(polyhedron(corners, faces))}, settings));
}

}  // namespace

CaseResult wedge(const Settings& settings, double friction_deg) {
  const WedgeGeometry w = wedge_geometry();
  Run run = wedge_run(settings, friction_deg);
  const Vec3 from = run.motion().pose.position;
  run.advance_to(1);
  const double value =
      2 * (run.motion().pose.position - from).dot(w.line) / (g * run.state.time * run.state.time);
  // N_a n_a + N_b n_b carries the weight across the line; friction on both faces acts along it
  const Vec3 weight(0, 0, -1);
  const Vec3 across = weight - weight.dot(w.line) * w.line;
  Eigen::Matrix<double, 3, 2> normals;
  normals << w.normal_a, w.normal_b;
  const Vec2 N = (normals.transpose() * normals).inverse() * normals.transpose() * -across;
  const double expected = weight.dot(w.line) - std::tan(friction_deg * degree) * N.sum();
  return run.finish(value, expected, std::abs(value / expected - 1));
}

CaseResult wedge_critical(const Settings& settings) {
  const WedgeGeometry w = wedge_geometry();
  CaseResult total;
  total.expected = 33.357;
  total.value = bisect(33, 34, 12, [&](double friction_deg) {
    Run run = wedge_run(settings, friction_deg);
    run.advance_to(1);
    add_counts(run.counted(), total);
    return run.motion().velocity.dot(w.line) < 1e-5;
  });
  total.error = std::abs(total.value - total.expected);
  return total;
}

namespace {

// Angle at which a column `does` something on its slope.
CaseResult column_angle(const Settings& settings, double friction_deg, double low, double high,
                        double expected, const std::function<bool(const SlopeFrame&, Run&)>& does) {
  CaseResult total;
  total.expected = expected;
  total.value = bisect(low, high, 12, [&](double dip) {
    const SlopeFrame frame = slope_frame(dip, 25);
    const Body body =
        body_of(box_in(frame, Vec3::Zero(), Vec3(-0.25, -0.25, 0), Vec3(0.25, 0.25, 1)));
    Run run(on_plane(settings, frame, ground_of(friction_deg), body, 10));
    const bool done = does(frame, run);
    add_counts(run.counted(), total);
    return done;
  });
  total.error = std::abs(total.value - expected);
  return total;
}

}  // namespace

CaseResult toppling_angle(const Settings& settings) {
  return column_angle(settings, 60, 25.5, 27.5, std::atan(0.5) / degree,
                      [](const SlopeFrame&, Run& run) {
                        const Quat from = run.motion().pose.attitude;
                        double turned = 0;
                        while (turned <= 0.05 && run.state.time < 2) {
                          run.advance();
                          turned = run.motion().pose.attitude.angularDistance(from);
                        }
                        return turned > 0.05;
                      });
}

// By its way in the second second: what a block does when it drops into its springs is over then.
CaseResult sliding_angle(const Settings& settings) {
  return column_angle(settings, 20, 19, 21, 20, [](const SlopeFrame& frame, Run& run) {
    run.advance_to(1);
    const Vec3 from = run.motion().pose.position;
    run.advance_to(2);
    return (run.motion().pose.position - from).dot(frame.dip) > 1e-3;
  });
}

CaseResult bond_angle(const Settings& settings) {
  const double share = 0.3, friction = std::tan(20 * degree);  // of the weight, density 2500 kg/m3
  GroundClass ground = ground_of(20);
  ground.cohesion = ground.tension = share * 2500 * g;
  CaseResult total;
  total.expected = 20 + std::asin(share * std::cos(20 * degree)) / degree;
  total.value = bisect(20, 45, 15, [&](double dip) {
    const SlopeFrame frame = slope_frame(dip, 20);
    Run run(on_plane(settings, frame, ground, body_of(cube_on(frame, 1)), 10));
    run.advance_to(1);
    add_counts(run.counted(), total);
    const double a = g * (std::sin(dip * degree) - friction * std::cos(dip * degree));
    // once broken it slides by friction alone
    return run.motion().velocity.dot(frame.dip) > 0.99 * a;
  });
  total.error = std::abs(total.value - total.expected);
  return total;
}

namespace {

/// What a rocking column did at its first impact.
struct Rocking {
  CaseResult result;
  double time = 0, before = 0, after = 0;
};

// Law paper's springs take some steps for an impact: it is where the spin was fastest, and the spin
// after it is that of a little later, followed back.
Rocking rock_on_springs(Run& run) {
  Rocking rocking;
  const double later = std::max(0.02, 4 * run.scene.settings.dt);
  double after_1 = 0, after_2 = 0;
  while (run.state.time < std::min(2.0, rocking.time + 2 * later)) {
    run.advance();
    const double spin = run.spin(run.motion()).norm(), t = run.state.time;
    if (spin > rocking.before) rocking.before = spin, rocking.time = t;
    if (t <= rocking.time + later) after_1 = spin;
    after_2 = spin;
  }
  rocking.after = 2 * after_1 - after_2;
  rocking.result = run.counted();
  return rocking;
}

Rocking rock(const Settings& settings) {
  const SlopeFrame frame = slope_frame(0, 30);
  const double b = 0.25, h = 1, slenderness = std::atan2(b, h);
  const Polyhedron column = box_in(frame, Vec3::Zero(), Vec3(-b, -0.5, 0), Vec3(b, 0.5, 2 * h));
  const Mat3 turn = Eigen::AngleAxisd(slenderness / 2, frame.strike).toRotationMatrix();
  Run run(
      on_plane(settings, frame, ground_of(80), body_of(moved(column, turn, b * frame.dip)), 10));
  if (settings.law == Law::paper) return rock_on_springs(run);
  Rocking rocking;
  while (rocking.time == 0 && run.state.time < 2) {
    run.advance();
    const auto& segments = run.work.segments;
    for (std::size_t k = 1; k < segments.size() && rocking.time == 0; ++k) {
      const double before = run.spin(segments[k - 1].end).norm();
      const double after = run.spin(segments[k].start).norm();
      if (after < 0.98 * before)
        rocking.time = segments[k].t_start, rocking.before = before, rocking.after = after;
    }
  }
  rocking.result = run.counted();
  return rocking;
}

}  // namespace

CaseResult rocking_time(const Settings& settings) {
  const Rocking rocking = rock(settings);
  CaseResult result = rocking.result;
  const double t = timed_reference(result, integrated_rocking_time);
  result.value = rocking.time;
  result.expected = t;
  result.error = std::abs(rocking.time / t - 1);
  return result;
}

CaseResult rocking_ratio(const Settings& settings) {
  const Rocking rocking = rock(settings);
  const double sine = std::sin(std::atan(0.25));
  CaseResult result = rocking.result;
  result.value = rocking.after / rocking.before;
  result.expected = 1 - 1.5 * sine * sine;
  result.error = std::abs(result.value / result.expected - 1);
  return result;
}

CaseResult shaken_block(const Settings& settings) {
  const SlopeFrame frame = slope_frame(20, 0);
  const Body body = body_of(box_in(frame, Vec3::Zero(), Vec3(-0.5, -0.5, 0), Vec3(0.5, 0.5, 0.2)));
  Scene scene = on_plane(settings, frame, ground_of(30), body, 15);
  constexpr int n = 20000;
  for (int i = 0; i <= n; ++i) {
    const double t = 10.0 * i / n;
    scene.base.time.push_back(t);
    scene.base.acceleration.push_back(Vec3(-5 * std::sin(2 * std::numbers::pi * t), 0, 0));
  }
  Run run(std::move(scene));
  const Vec3 from = run.motion().pose.position;
  run.advance_to(10);
  const double value = (run.motion().pose.position - from).dot(frame.dip), expected = 3.196940;
  return run.finish(value, expected, std::abs(value / expected - 1));
}

CaseResult energy_line(const Settings& settings) {
  // The slope eases from 27 to 23 degrees over 400 m: v^2 / R stays below g / 500
  const double steep = std::tan(27 * degree), gentle = std::tan(23 * degree), reach = 400;
  const auto height = [&](double x, double) {
    return -steep * x + (steep - gentle) * x * x / (2 * reach);
  };
  const SlopeFrame frame = slope_frame(27, 0);
  const Body body = body_of(
      box_in(frame, Vec3(0.3, 0.4, height(0.3, 0)), Vec3(-0.1, -0.1, 1e-3), Vec3(0.1, 0.1, 0.05)));
  Run run(scene_of(make_trn(height, 0.5, 210, Vec2(200, 0)), ground_of(25), {body}, settings));
  const Vec3 from = run.motion().pose.position;
  while (run.state.time < 120) {
    run.advance();
    if (run.state.time > 20 && run.motion().velocity.norm() < 1e-4) break;
  }
  const Vec3 moved = run.motion().pose.position - from;
  const double expected = -moved.z() / std::tan(25 * degree), value = moved.head<2>().norm();
  return run.finish(value, expected, std::abs(value / expected - 1));
}

CaseResult own_weight(const Settings& settings) {
  Settings with_strains = settings;
  with_strains.strains = true;
  const SlopeFrame flat = slope_frame(0, 0);
  Run run(on_plane(with_strains, flat, ground_of(30), body_of(cube_on(flat, 10)), 20));
  run.advance_to(1);
  const Material material;
  const Vec6 stress = elastic_matrix(material.young, material.poisson) * run.state.strain[0];
  const double expected = -material.density * g * 10 / 2;
  return run.finish(stress[2], expected, std::abs(stress[2] / expected - 1));
}

CaseResult ghost_collisions(const Settings& settings, double dip_deg) {
  const SlopeFrame frame = slope_frame(dip_deg, 33);
  const Mat3 turn = Eigen::AngleAxisd(0.3, frame.normal).toRotationMatrix();
  const Vec3 velocity = 20 * (0.6 * frame.dip + 0.8 * frame.strike);
  const Body body = body_of(moved(cube_on(frame, 1.7), turn, Vec3::Zero()), velocity);
  Run run(on_plane(settings, frame, ground_of(0), body, 120, 1));
  const Vec3 from = run.motion().pose.position;
  const Vec3 a = g * std::sin(dip_deg * degree) * frame.dip;
  double largest = 0;
  while (run.state.time < 4 - settings.dt / 2) {
    run.advance();
    const double t = run.state.time;
    const Vec3 expected = from + t * velocity + t * t / 2 * a;
    largest = std::max(largest, (run.motion().pose.position - expected).norm());
  }
  return run.finish(largest, 0, largest);
}

CaseResult elastic_restitution(const Settings& settings, double young) {
  Settings with_strains = settings;
  with_strains.strains = true;
  with_strains.post_adjustment = false;
  const SlopeFrame flat = slope_frame(0, 0);
  Material material;
  material.young = young;
  const double fall = 20 * settings.dt;
  const Body body = body_of(cube_on(flat, 1, Vec3(0, 0, fall)), Vec3(0, 0, -4));
  Run run(scene_of(plane_trn(flat, 0.5, 5), ground_of(0, 1), {body}, with_strains, material));
  double before = 0, height = 0;  // fastest downwards; the hit is over long before the end
  while (run.state.time < 0.02 + fall / 4) {
    run.advance();
    const Motion m = run.motion();
    if (m.velocity.z() < before) before = m.velocity.z(), height = m.pose.position.z();
  }
  const Motion end = run.motion();
  const double after =
      std::sqrt(end.velocity.z() * end.velocity.z() + 2 * g * (end.pose.position.z() - height));
  return run.finish(-after / before, 1, std::abs(1 + after / before));
}

}  // namespace talus::cases
