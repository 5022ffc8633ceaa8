// A stem that stops a block, or breaks; a forest that drags.
#include "verify/cases/stem_case.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "scene/stems.hpp"
#include "verify/cases/case_run.hpp"
#include "verify/cases/cases.hpp"

namespace talus::cases {
namespace {

constexpr double capacity = 91111, mass = 500;  // [J], [kg]

Scene scene_with_stem(const Settings& settings, double speed) {
  const Material material;
  const double half = std::cbrt(mass / material.density) / 2;
  Body body;
  body.parts = {box(Vec3(-2 - half, -half, 0), Vec3(-2 + half, half, 2 * half))};
  body.velocity = Vec3(speed, 0, 0);
  Scene scene = scene_of(plane_trn(slope_frame(0, 0), 1, 60), {}, {body}, settings, material);
  Stem stem;
  stem.height = 20;
  stem.radius = 0.15;
  stem.capacity = capacity;
  stem.deflection = 0.5;
  add_forest(scene, {stem}, {GroundClass{}});
  return scene;
}

}  // namespace

CaseResult stem(const CaseSettings& settings) {
  CaseResult all;
  for (const double speed : {10.0, 15.0, 20.0, 25.0}) {
    Run run(scene_with_stem(settings, speed), settings.paper);
    run.advance_to(4.0 / speed);
    const double expected = std::sqrt(std::max(0.0, speed * speed - 2 * capacity / mass));
    const double value = run.motion(0).velocity.x();
    const CaseResult one = run.finish(value, expected, std::abs(value - expected) / speed);
    all.value = one.value;
    all.expected = one.expected;
    all.error = std::max(all.error, one.error);
    add_counts(one, all);
  }
  return all;
}

CaseResult dragged_flight(const CaseSettings& settings) {
  constexpr double heavy = 1000, drag = 500, speed = 15, low = 5;
  const Material material;
  const double half = std::cbrt(heavy / material.density) / 2;
  const Body body =
      body_of(box(Vec3(-half, -half, low - half), Vec3(half, half, low + half)), Vec3(speed, 0, 0));
  Scene scene = scene_of(plane_trn(slope_frame(0, 0), 1, 60), {}, {body}, settings, material);
  scene.gravity = Vec3::Zero();
  const Area around{{{Vec2(-50, -50), Vec2(50, -50), Vec2(50, 50), Vec2(-50, 50)}}};
  scene.canopies = {make_canopy(around, 20, drag)};
  Run run(std::move(scene), settings.paper);
  const double from = run.motion().pose.position.x(), expected = heavy * speed / drag;
  run.advance_to(40);
  const double way = run.motion().pose.position.x() - from;
  return run.finish(way, expected, std::abs(way / expected - 1));
}

}  // namespace talus::cases
