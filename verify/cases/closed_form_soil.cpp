// Cases of closed_form.hpp: yielding ground.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "verify/cases/case_run.hpp"
#include "verify/cases/closed_form.hpp"
#include "verify/cases/closed_form_scenes.hpp"

namespace talus::cases {
namespace {

using std::numbers::pi;

constexpr double density = 2500;  // of Material{} [kg/m3]

// A slab that no friction turns over: 1 m wide, 0.05 m high.
Polyhedron slab_on(const SlopeFrame& frame) {
  return box_in(frame, Vec3::Zero(), Vec3(-0.5, -0.5, 0), Vec3(0.5, 0.5, 0.05));
}

Run slab_run(const CaseSettings& settings, const SlopeFrame& frame, const GroundClass& ground,
             double speed, double reach) {
  return Run(on_plane(settings, frame, ground, body_of(slab_on(frame), speed * frame.dip), reach, 1,
                      0.8 * reach * frame.dip),
             settings.paper);
}

// Distance down the dip until it is at rest, or until `longest` seconds are over.
double way_to_rest(const SlopeFrame& frame, Run& run, double longest) {
  const Vec3 from = run.motion().pose.position;
  double way = 0;
  while (run.state.time < longest) {
    run.advance();
    way = (run.motion().pose.position - from).dot(frame.dip);
    if (run.state.time > 0.1 && run.motion().velocity.norm() < 1e-4) break;
  }
  return way;
}

// Where a function that rises goes through zero.
double root_of(double low, double high, const std::function<double(double)>& f) {
  for (int i = 0; i < 200; ++i) {
    const double middle = (low + high) / 2;
    (f(middle) > 0 ? high : low) = middle;
  }
  return (low + high) / 2;
}

// Integral of scarring friction along the slid distance.
double scar_integral(const GroundClass& ground, double x) {
  const double k = ground.scar_rate;
  return ground.friction * x + 2 / pi * (ground.scar_friction - ground.friction) *
                                   (x * std::atan(k * x) - std::log1p(k * k * x * x) / (2 * k));
}

}  // namespace

GroundClass weakening_ground() {
  GroundClass ground;
  ground.friction = 0.84;
  ground.weak_friction = 0.11;
  ground.weakening_speed = 4;
  return ground;
}

double weakening_way(double speed) {
  double way = 0;  // by Simpson's rule
  constexpr int n = 2000;
  for (int i = 0; i <= n; ++i) {
    const double v = speed * i / n;
    const double mu = 0.11 + (0.84 - 0.11) / (1 + v / 4);
    way += (i == 0 || i == n ? 1 : i % 2 == 1 ? 4 : 2) * v / (g * mu) * speed / n / 3;
  }
  return way;
}

GroundClass scarring_ground(double least, double rate, double decay) {
  GroundClass ground;
  ground.friction = least;
  ground.scar_friction = 2;
  ground.scar_rate = rate;
  ground.scar_decay = decay;
  return ground;
}

CaseResult falling_restitution(const CaseSettings& settings, bool by_energy) {
  const SlopeFrame flat = slope_frame(0, 0);
  GroundClass ground = ground_of(30, 0.9);
  const Body body = body_of(moved(cube_on(flat, 1), Mat3::Identity(), Vec3::Zero(), Vec3(0, 0, 5)));
  double mass = density;
  if (by_energy)
    ground.half_energy = 20e3;
  else
    ground.half_speed = 10;
  Run run(on_plane(settings, flat, ground, body, 10), settings.paper);
  mass = run.scene.blocks.mass[0];
  const double floor = run.motion().pose.position.z() - 5;
  double speed = std::sqrt(2 * g * 5), largest = 0, height = 0, first = 0;
  for (int bounce = 0; bounce < 3; ++bounce) {
    const double fall =
        by_energy ? mass * speed * speed / 2 / ground.half_energy : speed / ground.half_speed;
    speed *= 0.9 / (1 + fall);
    const double expected = speed * speed / (2 * g);
    // down to the hit, then up to the top
    while (run.motion().velocity.z() <= 0 && run.state.time < 20) run.advance();
    Motion top = run.motion();
    while (run.motion().velocity.z() > 0 && run.state.time < 20) {
      run.advance();
      if (run.motion().velocity.z() > 0) top = run.motion();
    }
    height = top.pose.position.z() - floor + top.velocity.z() * top.velocity.z() / (2 * g);
    if (bounce == 0) first = height;
    largest = std::max(largest, std::abs(height / expected - 1));
  }
  return run.finish(first, speed * speed / (2 * g), largest);
}

CaseResult rolling_stop(const CaseSettings& settings, int n_sides, double resistance) {
  constexpr double radius = 0.5, start = 2;
  const double b = pi / n_sides;
  const double volume = 4.0 / 3 * pi * radius * radius * radius;  // of the sphere: R_e = R
  const double length = volume / (n_sides / 2.0 * radius * radius * std::sin(2 * b));
  const SlopeFrame flat = slope_frame(0, 0);
  GroundClass ground = ground_of(45);
  ground.rolling = resistance;
  const Body body = body_of(prism_on(flat, Vec3::Zero(), n_sides, radius, length / 2),
                            start * flat.dip, start / radius * flat.strike);
  Run run(on_plane(settings, flat, ground, body, 12), settings.paper);
  const double way = way_to_rest(flat, run, 30);
  const double cosine = std::cos(2 * b), kappa = (2 + 7 * cosine) / (8 + cosine);
  const double path = 2 * radius * std::sin(b) / (1 - kappa * kappa);
  const double A = 1 / (1 + (2 + cosine) / 6);
  const double expected = path * std::log(1 + start * start / (2 * A * g * resistance * path));
  return run.finish(way, expected, std::abs(way / expected - 1));
}

CaseResult resisted_rolling_angle(const CaseSettings& settings, int n_sides, double resistance) {
  const double half = pi / n_sides;
  GroundClass ground = ground_of(80);
  ground.rolling = resistance;
  CaseResult total;
  double radius = 0;  // of the sphere of its volume, over that of the prism
  const auto rolls = [&](double dip) {
    const SlopeFrame frame = slope_frame(dip, 20);
    Run run(on_plane(settings, frame, ground, body_of(prism_on(frame, Vec3::Zero(), n_sides, 1, 1)),
                     10),
            settings.paper);
    radius = std::cbrt(3 * run.scene.blocks.volume[0] / (4 * pi));
    const Quat from = run.motion().pose.attitude;
    bool rolled = false;
    while (!rolled && run.state.time < 6) {
      run.advance();
      rolled = run.motion().pose.attitude.angularDistance(from) > half / 2;
    }
    add_counts(run.counted(), total);
    return rolled;
  };
  (void)rolls(0);
  total.expected = std::atan(std::tan(half) + resistance * radius / std::cos(half)) / degree;
  total.value = bisect(0.95 * total.expected, 1.05 * total.expected, 12, rolls);
  total.error = std::abs(total.value - total.expected);
  return total;
}

CaseResult standing_on_edge(const CaseSettings& settings, double resistance) {
  const SlopeFrame flat = slope_frame(0, 0);
  GroundClass ground = ground_of(60);
  ground.rolling = resistance;
  const double arm = resistance * std::cbrt(3 / (4 * pi));
  CaseResult total;
  const auto falls = [&](double arms) {
    const double tilt = pi / 4 + std::asin(arms * arm / std::sqrt(0.5));
    Polyhedron cube =
        moved(box(Vec3(-0.5, -0.5, 0), Vec3(0.5, 0.5, 1)),
              Eigen::AngleAxisd(tilt, Vec3::UnitY()).toRotationMatrix(), Vec3::Zero());
    double lowest = 0;
    for (const Vec3& v : cube.vertices) lowest = std::min(lowest, v.z());
    cube = moved(cube, Mat3::Identity(), Vec3::Zero(), Vec3(0.13, 0.21, -lowest));
    Run run(on_plane(settings, flat, ground, body_of(cube), 10), settings.paper);
    const Quat from = run.motion().pose.attitude;
    bool fallen = false;
    while (!fallen && run.state.time < 6) {
      run.advance();
      fallen = run.motion().pose.attitude.angularDistance(from) > 0.1;
    }
    add_counts(run.counted(), total);
    return fallen;
  };
  total.expected = 1;
  total.value = bisect(0.9, 1.1, 8, falls);
  total.error = std::abs(total.value - 1);
  return total;
}

CaseResult pivoting_stop(const CaseSettings& settings) {
  constexpr double spin = 10, resistance = 0.1;
  const SlopeFrame flat = slope_frame(0, 0);
  GroundClass ground = ground_of(0);
  ground.spinning = resistance;
  Run run(on_plane(settings, flat, ground,
                   body_of(cube_on(flat, 1), Vec3::Zero(), spin * Vec3::UnitZ()), 10),
          settings.paper);
  const double radius = std::cbrt(3 / (4 * pi));
  // a quarter of the time and three quarters on: from the speeds there the time of its stop
  const double expected = spin / (6 * resistance * radius * g);
  run.advance_to(expected / 4);
  const double t0 = run.state.time, w0 = run.spin(run.motion()).z();
  run.advance_to(3 * expected / 4);
  const double t1 = run.state.time, w1 = run.spin(run.motion()).z();
  const double value = t1 + w1 * (t1 - t0) / (w0 - w1);
  return run.finish(value, expected, std::abs(value / expected - 1));
}

CaseResult scarring_stop(const CaseSettings& settings, const GroundClass& ground, double speed) {
  const SlopeFrame flat = slope_frame(0, 0);
  Run run = slab_run(settings, flat, ground, speed, 20);
  const double way = way_to_rest(flat, run, 20);
  const double expected =
      root_of(0, 1e3, [&](double x) { return g * scar_integral(ground, x) - speed * speed / 2; });
  return run.finish(way, expected, std::abs(way / expected - 1));
}

CaseResult scarring_creep(const CaseSettings& settings, const GroundClass& ground) {
  const SlopeFrame frame = slope_frame(35, 0);
  const double pull = std::sin(35 * degree), press = std::cos(35 * degree);
  Run run = slab_run(settings, frame, ground, 0, 10);
  double fastest = 0;
  const Vec3 from = run.motion().pose.position;
  double way = 0;
  while (run.state.time < 5) {
    run.advance();
    const Motion now = run.motion();
    fastest = std::max(fastest, now.velocity.norm());
    way = (now.pose.position - from).dot(frame.dip);
    if (run.state.time > 0.5 && now.velocity.norm() < 1e-4) break;
  }
  const double stop =
      root_of(1e-6, 100, [&](double x) { return press * scar_integral(ground, x) - pull * x; });
  const double at = root_of(0, 100, [&](double x) {
    return ground.friction +
           2 / pi * (ground.scar_friction - ground.friction) * std::atan(ground.scar_rate * x) -
           pull / press;
  });
  const double top = std::sqrt(2 * g * (pull * at - press * scar_integral(ground, at)));
  return run.finish(way, stop, std::max(std::abs(way / stop - 1), std::abs(fastest / top - 1)));
}

CaseResult weakening_stop(const CaseSettings& settings, double speed) {
  const SlopeFrame flat = slope_frame(0, 0);
  // the run-out of the fastest is 190 m on earth
  Run run = slab_run(settings, flat, weakening_ground(), speed, speed > 10 ? 250 : 25);
  const double way = way_to_rest(flat, run, 30);
  const double expected = weakening_way(speed);
  return run.finish(way, expected, std::abs(way / expected - 1));
}

CaseResult weakening_runaway(const CaseSettings& settings) {
  const SlopeFrame frame = slope_frame(20, 0);
  const GroundClass ground = weakening_ground();
  CaseResult total;
  const auto runs_away = [&](double speed) {
    Run run = slab_run(settings, frame, ground, speed, 25);
    run.advance_to(1);
    add_counts(run.counted(), total);
    return run.motion().velocity.norm() > speed;
  };
  total.expected = ground.weakening_speed * ((ground.friction - ground.weak_friction) /
                                                 (std::tan(20 * degree) - ground.weak_friction) -
                                             1);
  total.value = bisect(0.9 * total.expected, 1.1 * total.expected, 14, runs_away);
  total.error = std::abs(total.value / total.expected - 1);
  return total;
}

CaseResult dragged_slide(const CaseSettings& settings, bool per_way) {
  const SlopeFrame frame = slope_frame(40, 0);
  GroundClass ground = ground_of(30);
  const double a = g * (std::sin(40 * degree) - std::tan(30 * degree) * std::cos(40 * degree));
  if (per_way)
    ground.drag_per_distance = 0.02;
  else
    ground.drag_per_time = 0.6;
  Run run = slab_run(settings, frame, ground, 0, 60);
  const Vec3 from = run.motion().pose.position;
  const double duration = per_way ? 10 : 5;
  run.advance_to(duration);
  const double t = run.state.time, speed = run.motion().velocity.norm();
  const double way = (run.motion().pose.position - from).dot(frame.dip);
  if (per_way) {
    const double expected = std::sqrt(a / 0.02 * (1 - std::exp(-2 * 0.02 * way)));
    return run.finish(speed, expected, std::abs(speed / expected - 1));
  }
  const double nu = 0.6, expected = a / nu * (1 - std::exp(-nu * t));
  const double expected_way = a / nu * (t - (1 - std::exp(-nu * t)) / nu);
  return run.finish(speed, expected,
                    std::max(std::abs(speed / expected - 1), std::abs(way / expected_way - 1)));
}

CaseResult dragged_stop(const CaseSettings& settings) {
  constexpr double nu = 0.5, mu = 0.3, speed = 10;
  const SlopeFrame flat = slope_frame(0, 0);
  GroundClass ground;
  ground.friction = mu;
  ground.drag_per_time = nu;
  Run run = slab_run(settings, flat, ground, speed, 20);
  const double way = way_to_rest(flat, run, 20);
  const double expected = speed / nu - mu * g / (nu * nu) * std::log(1 + nu * speed / (mu * g));
  return run.finish(way, expected, std::abs(way / expected - 1));
}

}  // namespace talus::cases
