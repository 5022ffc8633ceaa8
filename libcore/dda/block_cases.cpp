#include "dda/block_cases.hpp"

#include <numbers>

#include "dda/case_run.hpp"
#include "dda/cases.hpp"

namespace talus::cases {
namespace {

constexpr double g = 10;
constexpr double degree = std::numbers::pi / 180;

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

}  // namespace

Scene tower(int n, double dip_deg, double friction_deg, const Settings& settings) {
  const SlopeFrame frame = slope_frame(dip_deg, 30);
  std::vector<Body> bodies;
  for (int i = 0; i < n; ++i)
    bodies.push_back(
        body_of(box_in(frame, Vec3::Zero(), Vec3(-0.5, -0.5, i), Vec3(0.5, 0.5, i + 1))));
  return scene_of(plane_trn(frame, 1, 20), ground_of(friction_deg), bodies, settings);
}

CaseResult tower_slide(const Settings& settings) {
  Scene scene = tower(3, 15, 10, settings);
  scene.joint = ground_of(40);
  Run run(std::move(scene));
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

CaseResult head_on(const Settings& settings, double restitution) {
  const Polyhedron cube = box(Vec3::Constant(-0.5), Vec3::Constant(0.5));
  const auto body = [&](double x, double speed) {
    return body_of(moved(cube, Mat3::Identity(), Vec3::Zero(), Vec3(x, 0, 200)), Vec3(speed, 0, 0));
  };
  Run run(scene_of(plane_trn(slope_frame(0, 0), 5, 100), ground_of(0, restitution),
                   {body(-3, 4), body(3, -4)}, settings));
  run.advance_to(1);
  const double value = run.motion(1).velocity.x() - run.motion(0).velocity.x();
  const double expected = restitution * 8;
  // they met after 5/8 s, 2.5 m on their way
  const double place = -0.5 - restitution * 4 * 0.375;
  const double off = std::abs(run.motion(0).pose.position.x() - place);
  return run.finish(value, expected, std::max(std::abs(value - expected) / 8, off / 2.5));
}

CaseResult stack_stands(const Settings& settings, int n, double settling_s) {
  Settings awake = settings;
  awake.sleep = false;
  Run run(tower(n, 0, 30, awake));
  run.advance_to(settling_s);
  const std::vector<Vec3> before = places(run);
  run.advance_to(settling_s + 4);
  const double moved = largest_distance(before, places(run));
  return run.finish(moved, 0, moved);
}

CaseResult large_on_small(const Settings& settings) {
  std::vector<Body> bodies = {body_of(box(Vec3(-5, -5, 0.1), Vec3(5, 5, 10.1)))};
  for (const double x : {-4.0, 4.0})
    for (const double y : {-4.0, 4.0})
      bodies.push_back(body_of(box(Vec3(x - 0.05, y - 0.05, 0), Vec3(x + 0.05, y + 0.05, 0.1))));
  Run run(scene_of(plane_trn(slope_frame(0, 0), 2, 40), ground_of(30), bodies, settings));
  run.advance_to(2);
  std::vector<Vec3> rest;
  for (const Pose& pose : run.scene.blocks.rest) rest.push_back(pose.position);
  const double moved = largest_distance(rest, places(run));
  return run.finish(moved, 0, moved);
}

}  // namespace talus::cases
