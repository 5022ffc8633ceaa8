// verify/cases/pile_scenes.hpp
// Piles of equal cubes, face on face and side by side, on a slope.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "step/step.hpp"
#include "verify/cases/cases.hpp"

namespace talus::cases {

/// On a dip of `share` of that at which a column of the pile topples, atan(1 / high).
struct Pile {
  int along = 1, across = 1, high = 1;  ///< columns down the dip and across it, cubes in each
  double side = 1;                      ///< [m]
  double share = 0;
  double step = 0.005;  ///< [s]
  double friction_deg = 35;
  double heavy = 1;  ///< mass of the last block over that of the rest
};

[[nodiscard]] inline double dip_of(const Pile& pile) {
  return pile.share * std::atan(1.0 / pile.high);
}

[[nodiscard]] inline Scene scene_of_pile(const Pile& pile, Settings settings = {}) {
  settings.dt = pile.step;
  settings.sleep = false;
  const SlopeFrame frame = slope_frame(dip_of(pile) * 180 / std::numbers::pi, 30);
  std::vector<Body> bodies;
  for (int k = 0; k < pile.high; ++k)
    for (int j = 0; j < pile.across; ++j)
      for (int i = 0; i < pile.along; ++i) {
        const Vec3 low = pile.side * Vec3(i - 0.5 * pile.along, j - 0.5 * pile.across, k);
        bodies.push_back(
            body_of(box_in(frame, Vec3::Zero(), low, low + Vec3::Constant(pile.side))));
      }
  Scene scene = scene_of(plane_trn(frame, 3 * pile.side, (60 + pile.high) * pile.side),
                         ground_of(pile.friction_deg), bodies, settings);
  scene.blocks.mass.back() *= pile.heavy;
  scene.blocks.inertia.back() *= pile.heavy;
  return scene;
}

/// The farthest that the centroid of a cube gets from where it began within `time` [m].
[[nodiscard]] inline double farthest(const Pile& pile, double time) {
  const Scene scene = scene_of_pile(pile);
  State state = start(scene);
  Work work = make_work(scene);
  double most = 0;
  while (state.time < time && most < pile.side) {
    step(scene, state, work);
    for (std::size_t b = 0; b < state.motion.size(); ++b)
      most = std::max(most, (state.motion[b].pose.position - scene.blocks.rest[b].position).norm());
  }
  return most;
}

/// When a cube has turned by `angle` [s]; `latest` where none has.
[[nodiscard]] inline double topple_time(const Pile& pile, double angle, double latest) {
  const Scene scene = scene_of_pile(pile);
  State state = start(scene);
  Work work = make_work(scene);
  double turned = 0;
  while (state.time < latest) {
    step(scene, state, work);
    const double before = turned;
    for (std::size_t b = 0; b < state.motion.size(); ++b)
      turned = std::max(
          turned, state.motion[b].pose.attitude.angularDistance(scene.blocks.rest[b].attitude));
    if (turned >= angle) return state.time - pile.step * (turned - angle) / (turned - before);
  }
  return latest;
}

/// The same of one rigid column of the pile's height that turns about its lower edge: with q the
/// angle since the start, q'' = g R sin(q + q_0) / (i^2 + R^2), in steps so short that the midpoint
/// rule is exact to 1e-6.
[[nodiscard]] inline double rigid_topple_time(const Pile& pile, double angle) {
  const double half = pile.side / 2, middle = half * pile.high, gravity = 10;
  const double square = (half * half + middle * middle) / 3;  // of the radius of gyration
  const double arm_sq = half * half + middle * middle;
  const double lean = dip_of(pile) - std::atan(half / middle);  // of the centroid over the edge
  const double rate = gravity * std::sqrt(arm_sq) / (square + arm_sq), dt = 1e-5;
  double q = 0, speed = 0, time = 0;
  while (q < angle) {
    speed += dt * rate * std::sin(lean + q + dt / 2 * speed);
    q += dt * speed;
    time += dt;
  }
  return time;
}

}  // namespace talus::cases
