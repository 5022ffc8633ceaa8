// Cases of closed_form.hpp: sliding, toppling, bonds, shaking, the energy line.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

#include "motion/displacement.hpp"
#include "verify/cases/case_run.hpp"
#include "verify/cases/closed_form.hpp"
#include "verify/cases/closed_form_scenes.hpp"

namespace talus::cases {
namespace {

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

}  // namespace

CaseResult sliding(const CaseSettings& settings, double friction_deg, double azimuth_deg,
                   double duration_s, const Vec3& offset, double cell_size) {
  const SlopeFrame frame = slope_frame(30, azimuth_deg);
  Run run(on_plane(settings, frame, ground_of(friction_deg), body_of(cube_on(frame, 1, offset)), 60,
                   cell_size, offset),
          settings.paper);
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

CaseResult oblique_slide(const CaseSettings& settings, double azimuth_deg) {
  const SlopeFrame frame = slope_frame(30, azimuth_deg);
  Run run(
      on_plane(settings, frame, ground_of(20), body_of(cube_on(frame, 1), 10 * frame.strike), 40),
      settings.paper);
  const Vec3 from = run.motion().pose.position;
  run.advance_to(2);
  const Path2 path =
      timed_reference(run.result, [&] { return integrated_oblique_slide(run.state.time); });
  const Vec3 moved = run.motion().pose.position - from;
  const Vec2 in_plane(moved.dot(frame.dip), moved.dot(frame.strike));
  return run.finish(in_plane.y(), path.end.y(), (in_plane - path.end).norm() / path.length);
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

Run wedge_run(const CaseSettings& settings, double friction_deg) {
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
                      {body_of(polyhedron(corners, faces))}, settings),
             settings.paper);
}

}  // namespace

CaseResult wedge(const CaseSettings& settings, double friction_deg) {
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

CaseResult wedge_critical(const CaseSettings& settings) {
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
CaseResult column_angle(const CaseSettings& settings, double friction_deg, double low, double high,
                        double expected, const std::function<bool(const SlopeFrame&, Run&)>& does) {
  CaseResult total;
  total.expected = expected;
  total.value = bisect(low, high, 12, [&](double dip) {
    const SlopeFrame frame = slope_frame(dip, 25);
    const Body body =
        body_of(box_in(frame, Vec3::Zero(), Vec3(-0.25, -0.25, 0), Vec3(0.25, 0.25, 1)));
    Run run(on_plane(settings, frame, ground_of(friction_deg), body, 10), settings.paper);
    const bool done = does(frame, run);
    add_counts(run.counted(), total);
    return done;
  });
  total.error = std::abs(total.value - expected);
  return total;
}

}  // namespace

CaseResult toppling_angle(const CaseSettings& settings) {
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

// By its displacement in the second second: the motion of a block that drops into its springs is
// over then.
CaseResult sliding_angle(const CaseSettings& settings) {
  return column_angle(settings, 20, 19, 21, 20, [](const SlopeFrame& frame, Run& run) {
    run.advance_to(1);
    const Vec3 from = run.motion().pose.position;
    run.advance_to(2);
    return (run.motion().pose.position - from).dot(frame.dip) > 1e-3;
  });
}

CaseResult bond_angle(const CaseSettings& settings) {
  const double share = 0.3, friction = std::tan(20 * degree);  // of the weight, density 2500 kg/m3
  GroundClass ground = ground_of(20);
  ground.cohesion = ground.tension = share * 2500 * g;
  CaseResult total;
  total.expected = 20 + std::asin(share * std::cos(20 * degree)) / degree;
  total.value = bisect(20, 45, 15, [&](double dip) {
    const SlopeFrame frame = slope_frame(dip, 20);
    Run run(on_plane(settings, frame, ground, body_of(cube_on(frame, 1)), 10), settings.paper);
    run.advance_to(1);
    add_counts(run.counted(), total);
    const double a = g * (std::sin(dip * degree) - friction * std::cos(dip * degree));
    // once broken it slides by friction alone
    return run.motion().velocity.dot(frame.dip) > 0.99 * a;
  });
  total.error = std::abs(total.value - total.expected);
  return total;
}

CaseResult shaken_block(const CaseSettings& settings) {
  const SlopeFrame frame = slope_frame(20, 0);
  const Body body = body_of(box_in(frame, Vec3::Zero(), Vec3(-0.5, -0.5, 0), Vec3(0.5, 0.5, 0.2)));
  Scene scene = on_plane(settings, frame, ground_of(30), body, 15);
  constexpr int n = 20000;
  for (int i = 0; i <= n; ++i) {
    const double t = 10.0 * i / n;
    scene.base.time.push_back(t);
    scene.base.acceleration.push_back(Vec3(-5 * std::sin(2 * std::numbers::pi * t), 0, 0));
  }
  Run run(std::move(scene), settings.paper);
  const Vec3 from = run.motion().pose.position;
  run.advance_to(10);
  const double value = (run.motion().pose.position - from).dot(frame.dip), expected = 3.196940;
  return run.finish(value, expected, std::abs(value / expected - 1));
}

CaseResult harmonic_slide(const CaseSettings& settings) {
  constexpr double amplitude = 4, frequency = 2 * std::numbers::pi * 0.7, begin = 0.3, end = 2.7;
  const Vec3 along(std::sin(60 * degree), std::cos(60 * degree), 0);
  const Body body = body_of(box(Vec3(-0.5, -0.5, 0), Vec3(0.5, 0.5, 0.2)));
  Scene scene = on_plane(settings, slope_frame(0, 0), ground_of(15), body, 15);
  scene.base.harmonic = {amplitude * along, frequency, begin, end};
  Run run(std::move(scene), settings.paper);
  const Vec3 from = run.motion().pose.position;
  run.advance_to(4);
  const Vec3 way = run.motion().pose.position - from;
  const double expected = timed_reference(run.result, [&] {
    constexpr double h = 2e-5;
    const double friction = g * std::tan(15 * degree);
    double x = 0, v = 0;
    for (double t = 0; t < run.state.time; t += h) {
      const bool shakes = t >= begin && t < end;
      const double a = shakes ? -amplitude * std::sin(frequency * (t + h / 2 - begin)) : 0;
      // friction within the interval brings it to rest at most
      const double driven = v + h * a;
      const double next = driven - std::copysign(std::min(h * friction, std::abs(driven)), driven);
      x += h * (v + next) / 2;
      v = next;
    }
    return x;
  });
  const double off = std::hypot(way.dot(along) - expected, way.cross(along).norm());
  return run.finish(way.dot(along), expected, std::abs(off / expected));
}

CaseResult energy_line(const CaseSettings& settings) {
  // The slope eases from 27 to 23 degrees over 400 m: v^2 / R stays below g / 500
  const double steep = std::tan(27 * degree), gentle = std::tan(23 * degree), reach = 400;
  const auto height = [&](double x, double) {
    return -steep * x + (steep - gentle) * x * x / (2 * reach);
  };
  const SlopeFrame frame = slope_frame(27, 0);
  const Body body = body_of(
      box_in(frame, Vec3(0.3, 0.4, height(0.3, 0)), Vec3(-0.1, -0.1, 1e-3), Vec3(0.1, 0.1, 0.05)));
  Run run(scene_of(make_trn(height, 0.5, 210, Vec2(200, 0)), ground_of(25), {body}, settings),
          settings.paper);
  const Vec3 from = run.motion().pose.position;
  while (run.state.time < 120) {
    run.advance();
    if (run.state.time > 20 && run.motion().velocity.norm() < 1e-4) break;
  }
  const Vec3 moved = run.motion().pose.position - from;
  const double expected = -moved.z() / std::tan(25 * degree), value = moved.head<2>().norm();
  return run.finish(value, expected, std::abs(value / expected - 1));
}

CaseResult own_weight(const CaseSettings& settings) {
  CaseSettings with_strains = settings;
  with_strains.strains = true;
  const SlopeFrame flat = slope_frame(0, 0);
  Run run(on_plane(with_strains, flat, ground_of(30), body_of(cube_on(flat, 10)), 20),
          with_strains.paper);
  run.advance_to(1);
  const Material material;
  const Vec6 stress = elastic_matrix(material.young, material.poisson) * run.state.strain[0];
  const double expected = -material.density * g * 10 / 2;
  return run.finish(stress[2], expected, std::abs(stress[2] / expected - 1));
}

CaseResult ghost_collisions(const CaseSettings& settings, double dip_deg) {
  const SlopeFrame frame = slope_frame(dip_deg, 33);
  const Mat3 turn = Eigen::AngleAxisd(0.3, frame.normal).toRotationMatrix();
  const Vec3 velocity = 20 * (0.6 * frame.dip + 0.8 * frame.strike);
  const Body body = body_of(moved(cube_on(frame, 1.7), turn, Vec3::Zero()), velocity);
  Run run(on_plane(settings, frame, ground_of(0), body, 120, 1), settings.paper);
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

}  // namespace talus::cases
