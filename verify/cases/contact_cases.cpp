// Cases of piles, hits, edges and bodies of several parts that meet.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "base/numbers.hpp"
#include "base/random.hpp"
#include "verify/cases/block_cases.hpp"
#include "verify/cases/case_run.hpp"
#include "verify/cases/cases.hpp"
#include "verify/cases/pile_scenes.hpp"

namespace talus::cases {
namespace {

// All contacts of one class, without gravity where bodies fly.
Scene all_alike(Trn trn, const GroundClass& ground, const std::vector<Body>& bodies,
                const Settings& settings) {
  Scene scene = scene_of(std::move(trn), ground, bodies, settings);
  scene.joint = ground;
  return scene;
}

Scene in_space(double restitution, const std::vector<Body>& bodies, const Settings& settings) {
  Scene scene =
      all_alike(plane_trn(slope_frame(0, 0), 5, 100), ground_of(0, restitution), bodies, settings);
  scene.gravity.setZero();
  return scene;
}

double kinetic(const Run& run) {
  const Energies e = energies(run.scene, run.state);
  return e.translation + e.rotation;
}

}  // namespace

// --- piles ---------------------------------------------------------------------------------------

CaseResult tower_topples(const CaseSettings& settings) {
  const Pile pile{.high = 8, .share = 1.05, .step = settings.dt};
  constexpr double angle = 0.2;  // [rad]
  Run run(scene_of_pile(pile, settings), settings.paper);
  const double expected =
      timed_reference(run.result, [&] { return rigid_topple_time(pile, angle); });
  double value = no_value, turned = 0;
  while (run.state.time < 1.5 * expected && std::isnan(value)) {
    run.advance();
    const double before = turned;
    for (int b = 0; b < n_blocks(run.scene); ++b)
      turned = std::max(
          turned, run.motion(b).pose.attitude.angularDistance(run.scene.blocks.rest[b].attitude));
    if (turned >= angle)
      value = run.state.time - settings.dt * (turned - angle) / (turned - before);
  }
  return run.finish(value, expected, std::abs(value / expected - 1));
}

CaseResult pile_moves(const CaseSettings& settings, const Pile& pile, double duration_s) {
  Pile of_step = pile;
  of_step.step = settings.dt;
  Run run(scene_of_pile(of_step, settings), settings.paper);
  double most = 0;
  while (run.state.time < duration_s && most < pile.side) {
    run.advance();
    for (int b = 0; b < n_blocks(run.scene); ++b)
      most =
          std::max(most, (run.motion(b).pose.position - run.scene.blocks.rest[b].position).norm());
  }
  return run.finish(most, 0, most / pile.side);
}

// --- hits ----------------------------------------------------------------------------------------

namespace {

// Normal speeds of two cubes' point of contact before and after their motions changed, derived from
// the changes of momentum and angular momentum.
double restitution_of(const Run& run, const std::vector<Motion>& before) {
  double speed_before = 0, speed_after = 0;
  const Vec3 p = run.scene.blocks.mass[0] * (run.state.motion[0].velocity - before[0].velocity);
  for (const std::size_t k : {0, 1}) {
    const Motion& after = run.state.motion[k];
    const Vec3 n = (k == 0 ? 1 : -1) * p.normalized();
    const Vec3 turn = (after.angular_momentum - before[k].angular_momentum) / p.norm();
    const auto speed = [&](const Motion& m) {
      return n.dot(m.velocity) + turn.dot(m.angular_momentum) / run.scene.blocks.inertia[k].x();
    };
    speed_before += speed(before[k]);
    speed_after += speed(after);
  }
  return -speed_after / speed_before;
}

Body tumbling_cube(const Vec3& place, const Vec3& velocity, Random& random) {
  const Vec3 axis = Vec3(random.normal(), random.normal(), random.normal()).normalized();
  const Mat3 turn = Eigen::AngleAxisd(random.uniform(0, 3), axis).toRotationMatrix();
  const Vec3 half = Vec3::Constant(random.uniform(0.3, 0.8));
  Vec3 spin;
  for (double& w : spin) w = random.uniform(-8, 8);
  return body_of(moved(box(-half, half), turn, Vec3::Zero(), place), velocity, spin);
}

}  // namespace

CaseResult tumbling_pairs(const CaseSettings& settings, double restitution) {
  CaseResult worst;
  worst.value = no_value;
  Random random(11, "cubes");
  for (int i = 0; i < 12; ++i) {
    const std::vector<Body> bodies = {tumbling_cube(Vec3(0, 0, 50), Vec3::Zero(), random),
                                      tumbling_cube(Vec3(0.2, -0.1, 53), Vec3(0, 0, -6), random)};
    Run run(in_space(restitution, bodies, settings), settings.paper);
    while (run.state.time < 0.6) {
      const std::vector<Motion> before = run.state.motion;
      if (run.advance().n_impacts != 1) continue;
      const double found = restitution_of(run, before);
      const double error = std::abs(found - restitution);
      if (!(error < worst.error)) worst.value = found, worst.error = error;
    }
    add_counts(run.counted(), worst);
  }
  worst.expected = restitution;
  if (std::isnan(worst.value)) worst.error = no_value;
  return worst;
}

CaseResult borne_slab(const CaseSettings& settings) {
  constexpr double e = 0.7, height = 2, thick = 0.5, half = 2, until = 0.1;
  const std::vector<Body> bodies = {
      body_of(box(Vec3(-half, -half, 0), Vec3(half, half, thick))),
      body_of(box(Vec3(-0.5, -0.5, thick + height), Vec3(0.5, 0.5, thick + height + 1)))};
  Run run(all_alike(plane_trn(slope_frame(0, 0), 1, 20), ground_of(30, e), bodies, settings),
          settings.paper);
  const double fall = std::sqrt(2 * height / g);
  run.advance_to(fall + until);
  const double value = run.motion(1).velocity.z() + g * (run.state.time - fall);
  // hit by hit in one dimension: the ground hits the slab that the cube has hit
  double cube = -g * fall, slab = 0;
  const double m = run.scene.blocks.mass[1], of_slab = run.scene.blocks.mass[0];
  while (cube < slab - 1e-9 || slab < -1e-9) {
    if (cube < slab - 1e-9) {
      const double p = (1 + e) * (slab - cube) / (1 / m + 1 / of_slab);
      cube += p / m;
      slab -= p / of_slab;
    } else {
      slab *= -e;
    }
  }
  return run.finish(value, cube, std::abs(value / cube - 1));
}

CaseResult unequal_row(const CaseSettings& settings, double e) {
  const std::vector<double> length = {1, 3, 0.5, 2, 1};
  std::vector<Body> bodies;
  std::vector<double> place, speed(length.size(), 0);
  double x = 0;
  for (std::size_t i = 0; i < length.size(); ++i) {
    bodies.push_back(
        body_of(box(Vec3(x, -0.5, 50), Vec3(x + length[i], 0.5, 51)), Vec3(i == 0 ? 10 : 0, 0, 0)));
    place.push_back(x);
    x += length[i] + (i == 0 ? 0.5 : 0.02);
  }
  speed[0] = 10;
  Run run(in_space(e, bodies, settings), settings.paper);
  run.advance_to(1);
  for (double time = 0; time < run.state.time;) {
    double wait = run.state.time - time;
    std::size_t next = length.size();
    for (std::size_t i = 0; i + 1 < length.size(); ++i) {
      const double closing = speed[i] - speed[i + 1];
      const double gap = std::max(0.0, place[i + 1] - place[i] - length[i]);
      if (closing > 1e-9 && gap / closing < wait) wait = gap / closing, next = i;
    }
    for (std::size_t i = 0; i < length.size(); ++i) place[i] += wait * speed[i];
    time += wait;
    if (next == length.size()) break;
    const double p = (1 + e) * (speed[next] - speed[next + 1]) /
                     (1 / length[next] + 1 / length[next + 1]);  // masses are as lengths
    speed[next] -= p / length[next];
    speed[next + 1] += p / length[next + 1];
  }
  double error = 0;
  for (std::size_t i = 0; i < length.size(); ++i)
    error = std::max(error, std::abs(run.motion(static_cast<int>(i)).velocity.x() - speed[i]) / 10);
  return run.finish(run.motion(4).velocity.x(), speed[4], error);
}

CaseResult plastic_row(const CaseSettings& settings) {
  constexpr int n = 6;
  std::vector<Body> bodies;
  for (int i = 0; i < n; ++i)
    bodies.push_back(
        body_of(box(Vec3(1.4 * i, 0, 50), Vec3(1.4 * i + 1, 1, 51)), Vec3(i == 0 ? 10 : 0, 0, 0)));
  Run run(in_space(0, bodies, settings), settings.paper);
  run.advance_to(2);
  double error = 0;
  for (int i = 0; i < n; ++i) {
    error = std::max(error, std::abs(run.motion(i).velocity.x() / (10.0 / n) - 1));
    if (i == 0) continue;
    const Vec3 apart = run.motion(i).pose.position - run.motion(i - 1).pose.position;
    error = std::max(error, std::abs(apart.x() - 1));
  }
  return run.finish(run.motion(n - 1).velocity.x(), 10.0 / n, error);
}

CaseResult elastic_bowl(const CaseSettings& settings) {
  Random random(3, "bowl");
  std::vector<Body> bodies;
  for (int i = 0; i < 8; ++i)
    bodies.push_back(
        tumbling_cube(Vec3(2.4 * (i % 2) - 1.2, 2.4 * (i / 2 % 2) - 1.2, 4 + 2.5 * (i / 4)),
                      Vec3::Zero(), random));
  Run run(all_alike(make_trn([](double x, double y) { return (x * x + y * y) / 12; }, 1, 30),
                    ground_of(0, 1), bodies, settings),
          settings.paper);
  const auto total = [&] { return kinetic(run) + energies(run.scene, run.state).potential; };
  const double before = total();
  run.advance_to(4);
  const double error = std::abs(total() / before - 1);
  return run.finish(total() / before, 1, run.state.counters.impacts > 50 ? error : no_value);
}

// --- edges and bodies of several parts -----------------------------------------------------------

Body ridge_wall(double half_angle_deg, double x) {
  const double cot = 1 / std::tan(half_angle_deg * degree), top = ridge_height;
  const double w = std::min(1.4, 0.9 * top / cot);
  std::vector<Vec3> vertices;
  for (const double y : {-3.0, 3.0})
    for (const Vec2& p :
         {Vec2(-w, 0), Vec2(w, 0), Vec2(w, top - w * cot), Vec2(0, top), Vec2(-w, top - w * cot)})
      vertices.emplace_back(x + p.x(), y, p.y());
  return body_of(polyhedron(vertices, {{0, 1, 2, 3, 4},
                                       {9, 8, 7, 6, 5},
                                       {1, 0, 5, 6},
                                       {2, 1, 6, 7},
                                       {3, 2, 7, 8},
                                       {4, 3, 8, 9},
                                       {0, 4, 9, 5}}));
}

Body split_plate(double azimuth_deg, double off) {
  const Vec3 normal(std::cos(azimuth_deg * degree), std::sin(azimuth_deg * degree), 0);
  const Polyhedron whole = box(Vec3(-3, -2, ridge_height), Vec3(3, 2, ridge_height + 0.6));
  Body body;
  body.parts = {clip_convex(whole, {normal, off}, 0, 1e-9),
                clip_convex(whole, {-normal, -off}, 0, 1e-9)};
  return body;
}

CaseResult parts_on_ridge(const CaseSettings& settings, double half_angle_deg) {
  constexpr double size = 6;  // of the plate [m]
  const std::vector<Body> bodies = {split_plate(30, 0.1), ridge_wall(half_angle_deg, 0)};
  Run run(scene_of(plane_trn(slope_frame(0, 0), 5, 50), ground_of(60), bodies, settings),
          settings.paper);
  const double before = run.motion().pose.position.z();
  double deepest = 0;
  while (run.state.time < 1 - settings.dt / 2) {
    run.advance();
    deepest = std::max(deepest, before - run.motion().pose.position.z());
  }
  return run.finish(deepest, 0, deepest / size);
}

CaseResult parts_land_flat(const CaseSettings& settings) {
  constexpr double height = 1.25, speed = 5, side = 1;
  Body slab;
  slab.parts = {box(Vec3(-2, -1, side + height), Vec3(0.3, 1, side + height + 0.5)),
                box(Vec3(0.3, -1, side + height), Vec3(2, 1, side + height + 0.5))};
  slab.velocity = Vec3(1, 0, 0);  // for half a second: to the middle of the lower body
  const std::vector<Body> bodies = {slab, body_of(box(Vec3(-7.5, -8, 0), Vec3(8.5, 8, side)))};
  Run run(all_alike(plane_trn(slope_frame(0, 0), 5, 50), ground_of(30, 0.5), bodies, settings),
          settings.paper);
  run.advance_to(0.6);
  const Motion after = run.motion();
  const double value = run.spin(after).norm() * run.scene.blocks.shapes.radius[0];
  // it flies after its first hit
  const bool has_hit = run.state.counters.impacts > 0 && after.pose.position.z() > side + 0.3;
  return run.finish(value, 0, has_hit ? value / speed : no_value);
}

}  // namespace talus::cases
