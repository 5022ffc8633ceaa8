// Cases of closed_form.hpp: flight, free spin, rebounds.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "verify/cases/case_run.hpp"
#include "verify/cases/closed_form.hpp"
#include "verify/cases/closed_form_scenes.hpp"

namespace talus::cases {
CaseResult parabola(const CaseSettings& settings) {
  const SlopeFrame flat = slope_frame(0, 0);
  const Body body =
      body_of(box_in(flat, Vec3(0, 0, 50), Vec3(-1, -1, -1), Vec3(1, 1, 1)), Vec3(0, 10, 0));
  Run run(on_plane(settings, flat, ground_of(0), body, 40, 2), settings.paper);
  const Vec3 from = run.motion().pose.position;
  run.advance_to(1);
  const double t = run.state.time;
  const Vec3 moved = run.motion().pose.position - from;
  const Vec3 expected(0, 10 * t, -g * t * t / 2);
  return run.finish(moved.z(), expected.z(), (moved - expected).cwiseAbs().maxCoeff());
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

}  // namespace

CaseResult tumbling_flight(const CaseSettings& settings, double duration_s) {
  Run run(thrown_box(settings, duration_s), settings.paper);
  const Vec3 from = run.motion().pose.position;
  run.advance_to(duration_s);
  const double t = run.state.time;
  const Vec3 moved = run.motion().pose.position - from;
  const Vec3 expected = t * throw_velocity(duration_s) - Vec3(0, 0, g * t * t / 2);
  return run.finish(moved.x(), expected.x(), (moved - expected).cwiseAbs().maxCoeff());
}

CaseResult free_spin(const CaseSettings& settings, double duration_s) {
  Run run(thrown_box(settings, duration_s), settings.paper);
  const Vec3 inertia = run.scene.blocks.inertia[0], L = run.motion().angular_momentum;
  run.advance_to(duration_s);
  const State7 s = timed_reference(
      run.result, [&] { return integrated_free_spin(inertia, throw_spin, run.state.time); });
  const Quat truth = Quat(s[3], s[4], s[5], s[6]).normalized();
  const double error = run.motion().pose.attitude.angularDistance(truth) / degree;
  run.result.momentum_change = (run.motion().angular_momentum - L).norm() / L.norm();
  return run.finish(error, 0, error);
}

CaseResult bounce(const CaseSettings& settings, double restitution, Landing landing) {
  constexpr double fall = 5;  // places of hits round with it, whatever is left of the height
  Polyhedron cube = box(Vec3::Constant(-0.5), Vec3::Constant(0.5));
  if (landing == Landing::edge)
    cube =
        moved(cube, Eigen::AngleAxisd(45 * degree, Vec3::UnitX()).toRotationMatrix(), Vec3::Zero());
  if (landing == Landing::corner)
    cube = moved(cube, Quat::FromTwoVectors(Vec3::Ones(), Vec3::UnitZ()).toRotationMatrix(),
                 Vec3::Zero());
  double low = 0;
  for (const Vec3& v : cube.vertices) low = std::max(low, -v.z());
  const Body body =
      body_of(moved(cube, Mat3::Identity(), Vec3::Zero(), Vec3(0.1, 0.2, low + fall)));
  Run run(on_plane(settings, slope_frame(0, 0), ground_of(25, restitution), body, 10),
          settings.paper);
  double error = 0, expected = fall, height = 0;
  int found = 0;
  // a piece of the path: does it lead over a top?
  const auto look_at = [&](const Motion& start, double speed_end) {
    const double up = start.velocity.z();
    if (found == 3 || up <= 0 || speed_end > 0) return;
    height = start.pose.position.z() - low + up * up / (2 * g);
    expected *= restitution * restitution;
    error = std::max(error, std::abs(height - expected) / fall);
    ++found;
  };
  while (found < 3 && run.state.time < 9) {
    run.advance();
    for (const Segment& segment : run.work.segments)
      look_at(segment.start, segment.end.velocity.z());
    if (found < 2 || run.state.phase[0] != Phase::flight) continue;
    const Motion& start = run.state.motion[0];  // of the last flight, which need not come down
    look_at(start, start.velocity.z() - g * (run.state.time - run.state.local_time[0]));
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

CaseResult corner_impulse(const CaseSettings& settings, double restitution) {
  const Mat3 turn = (Eigen::AngleAxisd(0.4, Vec3::UnitX()) * Eigen::AngleAxisd(0.3, Vec3::UnitY()))
                        .toRotationMatrix();
  const Polyhedron cube = box(Vec3::Constant(-0.5), Vec3::Constant(0.5));
  const Body body = body_of(moved(cube, turn, Vec3::Zero(), Vec3(0, 0, 2)), Vec3(3, 1, 0));
  Run run(on_plane(settings, slope_frame(0, 0), ground_of(0, restitution), body, 20),
          settings.paper);
  if (settings.paper) return impulse_of_springs(run, restitution);
  const double mass = run.scene.blocks.mass[0];
  while (run.state.time < 2) {
    run.advance();
    const auto& segments = run.work.segments;
    for (std::size_t k = 0; k < segments.size(); ++k) {
      // after the last one the block may be on its flight from the hit
      const Motion &before = segments[k].end,
                   &after = k + 1 < segments.size() ? segments[k + 1].start : run.state.motion[0];
      const double impulse = mass * (after.velocity - before.velocity).z();
      if (impulse < 0.1 * mass) continue;
      const double expected = impulse_on_corner(run, before, restitution);
      return run.finish(impulse, expected, std::abs(impulse / expected - 1));
    }
  }
  return run.finish(0, 1, 1);
}

CaseResult elastic_restitution(const CaseSettings& settings, double young) {
  CaseSettings with_strains = settings;
  with_strains.strains = true;
  if (with_strains.paper) with_strains.paper->post_adjustment = false;
  const SlopeFrame flat = slope_frame(0, 0);
  Material material;
  material.young = young;
  const double fall = 20 * settings.dt;
  const Body body = body_of(cube_on(flat, 1, Vec3(0, 0, fall)), Vec3(0, 0, -4));
  Run run(scene_of(plane_trn(flat, 0.5, 5), ground_of(0, 1), {body}, with_strains, material),
          with_strains.paper);
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
