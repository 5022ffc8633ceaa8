// Cases of several blocks with a closed form: towers, piles, collisions, toppling.
#include "verify/cases/block_cases.hpp"

#include <Eigen/Geometry>
#include <utility>

#include "base/random.hpp"
#include "verify/cases/case_run.hpp"
#include "verify/cases/cases.hpp"

namespace talus::cases {
namespace {

std::vector<Vec3> places(const Run& run) {
  std::vector<Vec3> out;
  for (int b = 0; b < n_blocks(run.scene); ++b) out.push_back(run.motion(b).pose.position);
  return out;
}

double largest_distance(const std::vector<Vec3>& from, const std::vector<Vec3>& to) {
  double largest = 0;
  for (std::size_t b = 0; b < from.size(); ++b)
    largest = std::max(largest, (to[b] - from[b]).norm());
  return largest;
}

// Blocks on the plane of `frame`, friction among them and with the ground.
Scene on_plane(const SlopeFrame& frame, const std::vector<Body>& bodies, double joint_deg,
               double ground_deg, const Settings& settings) {
  Scene scene = scene_of(plane_trn(frame, 1, 20), ground_of(ground_deg), bodies, settings);
  scene.joint = ground_of(joint_deg);
  return scene;
}

// Largest movement of a block from `settling_s` on; nothing sleeps. Its movement before counts
// beyond a tenth of a metre: blocks that were thrown off have not stayed.
CaseResult movement_after(Run run, double settling_s, double duration_s) {
  run.scene.settings.sleep = false;
  const std::vector<Vec3> start = places(run);
  run.advance_to(settling_s);
  const std::vector<Vec3> before = places(run);
  run.advance_to(settling_s + duration_s);
  const double moved =
      std::max(largest_distance(before, places(run)), largest_distance(start, before) - 0.1);
  return run.finish(moved, 0, moved);
}

// How far the last block came down the dip in 1.5 s against a t^2 / 2, and how far the remaining
// ones, which should stay, moved.
CaseResult slides_on_the_others(Run run, const SlopeFrame& frame, double a) {
  const std::vector<Vec3> before = places(run);
  run.advance_to(1.5);
  const std::vector<Vec3> after = places(run);
  const double expected = a * run.state.time * run.state.time / 2;
  const Vec3 path = after.back() - before.back();
  double off = (path - expected * frame.dip).norm();
  for (std::size_t b = 0; b + 1 < before.size(); ++b)
    off = std::max(off, (after[b] - before[b]).norm());
  return run.finish(path.dot(frame.dip), expected, off / expected);
}

}  // namespace

Scene tower(int n, double dip_deg, double friction_deg, const Settings& settings) {
  const SlopeFrame frame = slope_frame(dip_deg, 30);
  std::vector<Body> bodies;
  for (int i = 0; i < n; ++i)
    bodies.push_back(
        body_of(box_in(frame, Vec3::Zero(), Vec3(-0.5, -0.5, i), Vec3(0.5, 0.5, i + 1))));
  return scene_of(plane_trn(frame, 1, 20), ground_of(friction_deg), bodies, settings);
}

CaseResult tower_slide(const CaseSettings& settings) {
  Scene scene = tower(3, 15, 10, settings);
  scene.joint = ground_of(40);
  Run run(std::move(scene), settings.paper);
  const std::vector<Vec3> before = places(run);
  run.advance_to(1);
  const Vec3 dip = slope_frame(15, 30).dip;
  const double a = g * (std::sin(15 * degree) - std::tan(10 * degree) * std::cos(15 * degree));
  const double expected = a * run.state.time * run.state.time / 2;
  double value = 0, error = 0;
  for (std::size_t b = 0; b < before.size(); ++b) {
    value = dip.dot(places(run)[b] - before[b]);
    error = std::max(error, std::abs(value / expected - 1));
  }
  return run.finish(value, expected, error);
}

CaseResult head_on(const CaseSettings& settings, double restitution) {
  const Polyhedron cube = box(Vec3::Constant(-0.5), Vec3::Constant(0.5));
  const auto body = [&](double x, double speed) {
    return body_of(moved(cube, Mat3::Identity(), Vec3::Zero(), Vec3(x, 0, 200)), Vec3(speed, 0, 0));
  };
  Run run(scene_of(plane_trn(slope_frame(0, 0), 5, 100), ground_of(0, restitution),
                   {body(-3, 4), body(3, -4)}, settings),
          settings.paper);
  run.advance_to(1);
  const double value = run.motion(1).velocity.x() - run.motion(0).velocity.x();
  const double expected = restitution * 8;
  // they met after 5/8 s, 2.5 m on their path
  const double place = -0.5 - restitution * 4 * 0.375;
  const double off = std::abs(run.motion(0).pose.position.x() - place);
  return run.finish(value, expected, std::max(std::abs(value - expected) / 8, off / 2.5));
}

CaseResult stack_stands(const CaseSettings& settings, int n, double settling_s) {
  return movement_after({tower(n, 0, 30, settings), settings.paper}, settling_s, 4);
}

CaseResult tower_holds(const CaseSettings& settings) {
  return movement_after({tower(3, 15, 15.5, settings), settings.paper}, 1, 4);
}

CaseResult pile_topples(const CaseSettings& settings) {
  CaseResult total;
  total.expected = std::atan(0.25) / degree;
  total.value = bisect(12, 16, 10, [&](double dip) {
    Run run(tower(4, dip, 40, settings), settings.paper);
    const std::vector<Vec3> before = places(run);
    double moved = 0;
    while (moved < 0.5 && run.state.time < 5) {
      run.advance();
      moved = largest_distance(before, places(run));
    }
    add_counts(run.counted(), total);
    return moved >= 0.5;
  });
  total.error = std::abs(total.value - total.expected);
  return total;
}

CaseResult block_on_block(const CaseSettings& settings) {
  const SlopeFrame frame = slope_frame(30, 25);
  const std::vector<Body> bodies = {
      body_of(box_in(frame, Vec3::Zero(), Vec3(-2, -2, 0), Vec3(8, 2, 1))),
      body_of(box_in(frame, Vec3::Zero(), Vec3(-0.5, -0.5, 1), Vec3(0.5, 0.5, 2)))};
  const double a = g * (std::sin(30 * degree) - std::tan(20 * degree) * std::cos(30 * degree));
  return slides_on_the_others({on_plane(frame, bodies, 20, 50, settings), settings.paper}, frame,
                              a);
}

CaseResult groove(const CaseSettings& settings) {
  const SlopeFrame frame = slope_frame(35, 25);
  // section in (strike, normal): counter-clockwise about +dip
  const auto prism = [&](const std::vector<Vec2>& section, double low, double high) {
    std::vector<Vec3> v;
    for (const double x : {low, high})
      for (const Vec2& p : section)
        v.push_back(x * frame.dip + p.x() * frame.strike + p.y() * frame.normal);
    const int n = static_cast<int>(section.size());
    std::vector<std::vector<int>> faces(2);
    for (int k = 0; k < n; ++k) {
      faces[0].push_back(n - 1 - k);
      faces[1].push_back(n + k);
      faces.push_back({k, (k + 1) % n, n + (k + 1) % n, n + k});
    }
    return body_of(polyhedron(v, faces));
  };
  const std::vector<Body> bodies = {
      prism({{0, 0}, {4, 0}, {4, 2.5}, {2, 2.5}, {0, 0.5}}, -2, 10),
      prism({{-4, 0}, {0, 0}, {0, 0.5}, {-2, 2.5}, {-4, 2.5}}, -2, 10),
      prism({{0.2, 0.7}, {1.5, 2}, {-1.5, 2}, {-0.2, 0.7}}, -1, 1)};
  const double a =
      g * (std::sin(35 * degree) - std::sqrt(2.0) * std::tan(20 * degree) * std::cos(35 * degree));
  return slides_on_the_others({on_plane(frame, bodies, 20, 60, settings), settings.paper}, frame,
                              a);
}

CaseResult arch_stands(const CaseSettings& settings) {
  return movement_after(
      {on_plane(slope_frame(0, 0), arch_of(7, 4, 5.5, 2), 40, 50, settings), settings.paper}, 5, 5);
}

CaseResult large_on_small(const CaseSettings& settings) {
  std::vector<Body> bodies = {body_of(box(Vec3(-5, -5, 0.1), Vec3(5, 5, 10.1)))};
  for (const double x : {-4.0, 4.0})
    for (const double y : {-4.0, 4.0})
      bodies.push_back(body_of(box(Vec3(x - 0.05, y - 0.05, 0), Vec3(x + 0.05, y + 0.05, 0.1))));
  Run run(scene_of(plane_trn(slope_frame(0, 0), 2, 40), ground_of(30), bodies, settings),
          settings.paper);
  run.advance_to(2);
  std::vector<Vec3> rest;
  for (const Pose& pose : run.scene.blocks.rest) rest.push_back(pose.position);
  const double moved = largest_distance(rest, places(run));
  return run.finish(moved, 0, moved);
}

CaseResult thin_plate(const CaseSettings& settings) {
  const std::vector<Body> bodies = {body_of(box(Vec3(-1, -1, 0), Vec3(1, 1, 2))),
                                    body_of(box(Vec3(-5, -5, 2), Vec3(5, 5, 2.1)))};
  return movement_after({on_plane(slope_frame(0, 0), bodies, 30, 30, settings), settings.paper}, 1,
                        4);
}

namespace {

// Momentum and angular momentum about the local zero, less the impulse of gravity since time 0.
Vec6 momentum(const Run& run) {
  const Vec3 fall = run.state.time * run.scene.gravity;
  Vec6 sum = Vec6::Zero();
  for (int b = 0; b < n_blocks(run.scene); ++b) {
    const Motion m = run.motion(b);
    const Vec3 p = run.scene.blocks.mass[b] * (m.velocity - fall);
    sum.head<3>() += p;
    sum.tail<3>() += m.angular_momentum + (m.pose.position - 0.5 * run.state.time * fall).cross(p);
  }
  return sum;
}

// Eight boxes at the corners of a cube, each with its own shape and spin, thrown at its centre.
std::vector<Body> thrown_boxes() {
  std::vector<Body> bodies;
  Random random(5);
  for (int i = 0; i < 8; ++i) {
    const Vec3 place = 2.5 * Vec3(i % 2 - 0.5, i / 2 % 2 - 0.5, (i < 4 ? 0 : 1) - 0.5);
    const Mat3 turn =
        Eigen::AngleAxisd(random.uniform(0, 3), Vec3(1, 2, 3).normalized()).toRotationMatrix();
    const Vec3 half{0.7, random.uniform(0.3, 0.7), random.uniform(0.3, 0.7)};  // in this order
    const Vec3 spin{random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2)};
    bodies.push_back(body_of(moved(box(-half, half), turn, Vec3::Zero(), place + Vec3(0, 0, 500)),
                             -3 * place, spin));
  }
  return bodies;
}

}  // namespace

CaseResult collision(const CaseSettings& settings, double restitution) {
  Scene scene = on_plane(slope_frame(0, 0), thrown_boxes(), 25, 25, settings);
  scene.joint.restitution = restitution;
  Run run(std::move(scene), settings.paper);
  const auto kinetic = [&run] {
    const Energies e = energies(run.scene, run.state);
    return e.translation + e.rotation;
  };
  const auto total = [&] { return kinetic() + energies(run.scene, run.state).potential; };
  const Vec6 before = momentum(run);
  const double first = kinetic(), energy = total();
  double brought = 0;
  for (std::size_t b = 0; b < run.scene.blocks.mass.size(); ++b)
    brought += run.scene.blocks.mass[b] * run.scene.blocks.velocity[b].norm();
  run.advance_to(1.5);
  const Vec6 change = momentum(run) - before;
  const double error = std::max(change.head<3>().norm(), change.tail<3>().norm()) / brought;
  return run.finish((total() - energy) / first, 0, error);
}

}  // namespace talus::cases
