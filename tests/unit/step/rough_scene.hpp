// tests/unit/step/rough_scene.hpp
// A tumbling block on rough ground.
#pragma once

#include <cmath>

#include "verify/cases/cases.hpp"

namespace talus::cases {

inline double bumps(double x, double y) {
  return 2 * std::sin(0.35 * x) * std::cos(0.27 * y) +
         0.3 * std::sin(1.7 * x + 0.4) * std::sin(1.3 * y) - 0.4 * x;
}

inline Scene rough_scene(const Settings& settings) {
  GroundClass ground;
  ground.friction = 0.5;
  ground.restitution = 0.4;
  Polyhedron shape = box(Vec3(-0.8, -0.5, -0.3), Vec3(0.8, 0.5, 0.3));
  shape = moved(shape, Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix(),
                Vec3::Zero(), Vec3(-40, 3, bumps(-40, 3) + 6));
  return scene_of(make_trn(bumps, 1, 80), ground, {body_of(shape, Vec3(4, 1, 0), Vec3(1, 2, 0.5))},
                  settings);
}

}  // namespace talus::cases
