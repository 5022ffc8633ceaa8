// Cases of closed_form.hpp: rolling and rocking.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "verify/cases/case_run.hpp"
#include "verify/cases/closed_form.hpp"
#include "verify/cases/closed_form_scenes.hpp"

namespace talus::cases {
CaseResult rolling_angle(const CaseSettings& settings, int n_sides) {
  const double expected = 180.0 / n_sides;
  CaseResult total;
  const auto rolls = [&](double dip) {
    const SlopeFrame frame = slope_frame(dip, 20);
    Run run(on_plane(settings, frame, ground_of(80),
                     body_of(prism_on(frame, Vec3::Zero(), n_sides, 1, 0.5)), 10),
            settings.paper);
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

CaseResult sustained_rolling(const CaseSettings& settings, int n_sides) {
  const SlopeFrame frame = slope_frame(10, 0);
  const double half = std::numbers::pi / n_sides, apothem = std::cos(half);
  const Vec3 edge = std::sin(half) * frame.dip, spin = 1.5 * frame.strike;
  const Body body = body_of(prism_on(frame, Vec3::Zero(), n_sides, 1, 0.5),
                            spin.cross(apothem * frame.normal - edge), spin);
  const Vec3 middle = 60 * frame.dip;
  Run run(on_plane(settings, frame, ground_of(80), body, 70, 2, middle), settings.paper);
  // before an impact: the fastest spin of each side's length of path
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

namespace {

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

/// Motion of a rocking column about its first impact.
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

Rocking rock(const CaseSettings& settings) {
  const SlopeFrame frame = slope_frame(0, 30);
  const double b = 0.25, h = 1, slenderness = std::atan2(b, h);
  const Polyhedron column = box_in(frame, Vec3::Zero(), Vec3(-b, -0.5, 0), Vec3(b, 0.5, 2 * h));
  const Mat3 turn = Eigen::AngleAxisd(slenderness / 2, frame.strike).toRotationMatrix();
  Run run(on_plane(settings, frame, ground_of(80), body_of(moved(column, turn, b * frame.dip)), 10),
          settings.paper);
  if (settings.paper) return rock_on_springs(run);
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

CaseResult rocking_time(const CaseSettings& settings) {
  const Rocking rocking = rock(settings);
  CaseResult result = rocking.result;
  const double t = timed_reference(result, integrated_rocking_time);
  result.value = rocking.time;
  result.expected = t;
  result.error = std::abs(rocking.time / t - 1);
  return result;
}

CaseResult rocking_ratio(const CaseSettings& settings) {
  const Rocking rocking = rock(settings);
  const double sine = std::sin(std::atan(0.25));
  CaseResult result = rocking.result;
  result.value = rocking.after / rocking.before;
  result.expected = 1 - 1.5 * sine * sine;
  result.error = std::abs(result.value / result.expected - 1);
  return result;
}

}  // namespace talus::cases
