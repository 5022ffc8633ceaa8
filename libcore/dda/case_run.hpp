// libcore/dda/case_run.hpp
// Moves the scene of a case on and counts what its steps report.
// in:    a Scene
// out:   a CaseResult, complete once finish() has its error
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include "dda/closed_form.hpp"
#include "dda/rotation.hpp"
#include "dda/step.hpp"

namespace talus::cases {

/// A scene on its way, and the sums that a case reports of it.
struct Run {
  Scene scene;
  State state;
  Work work;
  CaseResult result;

  explicit Run(Scene s) : scene(std::move(s)), state(start(scene)), work(make_work(scene)) {}

  StepReport advance() {
    const StepReport report = step(scene, state, work);
    ++result.steps;
    result.passes += report.passes;
    result.unconverged += report.n_unconverged;
    result.largest_penetration = std::max(result.largest_penetration, report.largest_penetration);
    result.flags = result.flags | report.flags;
    return report;
  }
  void advance_to(double time) {
    const long n = std::lround((time - state.time) / scene.settings.dt);
    for (long i = 0; i < n; ++i) advance();
  }
  /// Of block b, now.
  [[nodiscard]] Motion motion(int b = 0) const { return motion_at(scene, state, b, state.time); }
  /// Of the first block [rad/s].
  [[nodiscard]] Vec3 spin(const Motion& m) const {
    return angular_velocity(m.pose.attitude, m.angular_momentum, scene.blocks.inertia[0]);
  }
  CaseResult finish(double value, double expected, double error) {
    result.value = value;
    result.expected = expected;
    result.error = error;
    return result;
  }
};

}  // namespace talus::cases
