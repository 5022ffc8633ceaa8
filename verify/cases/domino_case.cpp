// The wave along a row of dominoes, by the engine and by angles alone.
#include <array>

#include "verify/cases/block_cases.hpp"
#include "verify/cases/case_run.hpp"
#include "verify/cases/cases.hpp"

namespace talus::cases {
namespace {

constexpr std::size_t n_plates = 14;
constexpr double height = 1, thickness = 0.15, pitch = 0.5;  // [m]
constexpr double first_spin = 1.5;                           // [rad/s]

// Upright plates in a row, fixed about their leading edges, rigid, without rebound and friction
// among each other: angles alone, contacts by projected Gauss-Seidel at tiny steps.
struct DominoModel {
  std::vector<double> angle = std::vector<double>(n_plates, 0), rate = angle, pushed = angle;

  // Gap of the top corner of plate i to the back of the next, and its slopes by both angles.
  struct Gap {
    double value, by_this, by_next;
  };
  [[nodiscard]] Gap gap(std::size_t i) const {
    const double a = angle[i], b = angle[i + 1];
    const double x = height * std::sin(a) - pitch + thickness * std::cos(b);
    const double z = height * std::cos(a) - thickness * std::sin(b);
    return {-std::cos(b) * x + std::sin(b) * z,
            -std::cos(b) * height * std::cos(a) - std::sin(b) * height * std::sin(a),
            std::sin(b) * x + std::cos(b) * z};
  }

  void push(std::size_t i, const Gap& at) {
    if (at.value > 0) return;
    const double closing = at.by_this * rate[i] + at.by_next * rate[i + 1];
    const double mobility = at.by_this * at.by_this + at.by_next * at.by_next;
    const double impulse = std::max(-pushed[i], -closing / mobility);
    pushed[i] += impulse;
    rate[i] += impulse * at.by_this;
    rate[i + 1] += impulse * at.by_next;
    for (const std::size_t k : {i, i + 1})
      if (angle[k] <= 0) rate[k] = std::max(rate[k], 0.0);
  }

  void advance(double dt) {
    const double inertia = (height * height + thickness * thickness) / 3;  // over mass
    for (std::size_t i = 0; i < n_plates; ++i) {
      const double torque = g * (height * std::sin(angle[i]) - thickness * std::cos(angle[i])) / 2;
      rate[i] += dt * torque / inertia;
      if (angle[i] <= 0) rate[i] = std::max(rate[i], 0.0);
      pushed[i] = 0;
    }
    std::array<Gap, n_plates - 1> gaps;  // angles stay until the end
    for (std::size_t i = 0; i < gaps.size(); ++i) gaps[i] = gap(i);
    for (int sweep = 0; sweep < 60; ++sweep)
      for (std::size_t i = 0; i < gaps.size(); ++i) push(i, gaps[i]);
    for (std::size_t i = 0; i < n_plates; ++i) angle[i] = std::max(0.0, angle[i] + dt * rate[i]);
  }
};

// Time between the moments at which the fourth and the twelfth plate lean by 2 degrees, linear
// within a step; no more than 4 s are waited for.
template <class LeanOf, class Advance>
double wave_time(double dt, const LeanOf& lean, const Advance& advance) {
  constexpr std::size_t watched[2] = {3, 11};
  double time[2] = {0, 0}, last[2] = {0, 0};
  for (int i = 0; i * dt < 4 && time[1] == 0; ++i) {
    advance();
    for (const int k : {0, 1}) {
      const double now = lean(watched[k]), limit = 2 * degree;
      if (time[k] == 0 && now > limit) time[k] = (i + (limit - last[k]) / (now - last[k])) * dt;
      last[k] = now;
    }
  }
  return time[1] - time[0];
}

}  // namespace

CaseResult dominoes(const CaseSettings& settings) {
  std::vector<Body> bodies;
  for (std::size_t i = 0; i < n_plates; ++i) {
    const double front = pitch * static_cast<double>(i), spin = i == 0 ? first_spin : 0;
    bodies.push_back(body_of(box(Vec3(front - thickness, -0.4, 0), Vec3(front, 0.4, height)),
                             spin * Vec3(height / 2, 0, thickness / 2), Vec3(0, spin, 0)));
  }
  Scene scene = scene_of(plane_trn(slope_frame(0, 0), 1, 20), ground_of(75), bodies, settings);
  scene.joint = ground_of(0);
  Run run(std::move(scene), settings.paper);
  const auto lean = [&](std::size_t k) {
    const Vec3 up = run.motion(static_cast<int>(k)).pose.attitude *
                    (run.scene.blocks.rest[k].attitude.conjugate() * Vec3::UnitZ());
    return std::atan2(up.x(), up.z());
  };
  const double value = wave_time(settings.dt, lean, [&] { run.advance(); });
  const double expected = timed_reference(run.result, [] {
    DominoModel model;
    model.rate[0] = first_spin;
    constexpr double dt = 2e-5;
    return wave_time(
        dt, [&](std::size_t k) { return model.angle[k]; }, [&] { model.advance(dt); });
  });
  return run.finish(value, expected, std::abs(value / expected - 1));
}

}  // namespace talus::cases
