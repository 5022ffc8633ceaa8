// tests/stability/block_scenes.hpp
// Scenes of many blocks and measures of them: walls and heaps on a plane; energy and the largest
// displacement of a block.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/text.hpp"
#include "base/units.hpp"
#include "step/step.hpp"
#include "verify/cases/cases.hpp"

namespace talus::stability {

inline GroundClass rough(double phi_deg, double restitution = 0) {
  GroundClass ground;
  ground.friction = std::tan(phi_deg * degree);
  ground.restitution = restitution;
  return ground;
}

/// Blocks on the plane of `frame`; `joint_phi_deg` between them, `ground_phi_deg` below.
inline Scene on_plane(const cases::SlopeFrame& frame, const std::vector<Body>& bodies,
                      double joint_phi_deg, double ground_phi_deg, const Settings& settings = {},
                      double cell_size = 1, double reach = 20) {
  Scene scene = cases::scene_of(cases::plane_trn(frame, cell_size, reach), rough(ground_phi_deg),
                                bodies, settings);
  scene.joint = rough(joint_phi_deg);
  return scene;
}

/// Running bond of stones of 1 x `thickness` x 0.5 m; every second course begins and ends with half
/// a one.
inline std::vector<Body> wall_of(int n_courses, int n_long, double thickness) {
  std::vector<Body> bodies;
  for (int row = 0; row < n_courses; ++row) {
    const double z = 0.5 * row, shift = row % 2 == 0 ? 0.0 : 0.5;
    for (int i = 0; i < n_long + (row % 2); ++i) {
      const double low = std::max(0.0, i - shift), high = std::min(1.0 * n_long, i + 1 - shift);
      bodies.push_back(cases::body_of(box(Vec3(low, 0, z), Vec3(high, thickness, z + 0.5))));
    }
  }
  return bodies;
}

inline void run(const Scene& scene, double time, State& state, Work& work) {
  const int n = static_cast<int>(std::lround(time / scene.settings.dt));
  for (int i = 0; i < n; ++i) step(scene, state, work);
}

inline void run(const Scene& scene, double time, State& state) {
  Work work = make_work(scene);
  run(scene, time, state, work);
}

inline std::vector<Vec3> places(const Scene& scene, const State& state) {
  std::vector<Vec3> out;
  for (int b = 0; b < n_blocks(scene); ++b)
    out.push_back(motion_at(scene, state, b, state.time).pose.position);
  return out;
}

/// The farthest that a block is from where it was [m].
inline double farthest(const std::vector<Vec3>& before, const std::vector<Vec3>& after) {
  double most = 0;
  for (std::size_t b = 0; b < before.size(); ++b)
    most = std::max(most, (after[b] - before[b]).norm());
  return most;
}

/// Kinetic and potential energy [J].
inline double mechanical_energy(const Scene& scene, const State& state) {
  const Energies e = energies(scene, state);
  return e.translation + e.rotation + e.potential;
}

/// Twelve blocks thrown on a slope of 10 degrees in a heap; each `number` is another heap.
inline Scene heap(const Settings& settings, int number = 0) {
  std::vector<Body> bodies;
  const double other = 0.37 * number;
  for (int i = 0; i < 12; ++i) {
    const Mat3 turn =
        Eigen::AngleAxisd(0.5 + i + other, Vec3(1, i, 2 + other).normalized()).toRotationMatrix();
    const int layer = i / 4;
    bodies.push_back(cases::body_of(
        cases::moved(box(Vec3(-0.6, -0.4, -0.3), Vec3(0.6, 0.4, 0.3)), turn, Vec3::Zero(),
                     1.7 * Vec3(i % 2, i / 2 % 2, layer) + Vec3::UnitZ()),
        Vec3(0.5, 0, -3)));
  }
  Scene scene = on_plane(cases::slope_frame(10, 0), bodies, 25, 25, settings, 1, 60);
  scene.joint.restitution = scene.ground.classes[0].restitution = 0.3;
  return scene;
}

/// Energy of the springs of pressed contacts [J].
inline double spring_energy(const State& state) {
  double sum = 0;
  for (const std::vector<ContactMemory>& of_block : state.memory)
    for (const ContactMemory& contact : of_block) {
      const double pressed_in = std::max(0.0, -contact.gap_end);
      sum += contact.stiffness * pressed_in * pressed_in / 2;
    }
  return sum;
}

/// Heaps stay finite and above the ground and lose energy. No step of any gains more than 5 % of
/// the kinetic energy at the start, 0.1 % with the stiffness and the steps that talus would choose,
/// besides the energy of springs that were pressed before.
inline void expect_bounded(double stiffness, double dt, double duration, int n_heaps) {
  Settings settings;
  settings.dt = dt;
  settings.normal_stiffness = stiffness;
  double sum_of_gains = 0, largest_gain = 0;
  std::int64_t unconverged = 0, substeps = 0;
  for (int number = 0; number < n_heaps; ++number) {
    const Scene scene = heap(settings, number);
    State state = start(scene);
    Work work = make_work(scene);
    const double first = mechanical_energy(scene, state);
    const double kinetic = first - energies(scene, state).potential;
    double last = first, springs = 0, gain = 0;
    StepFlag flags = StepFlag::none;
    while (state.time < duration) {
      flags = flags | step(scene, state, work).flags;
      const double now = mechanical_energy(scene, state), held = spring_energy(state);
      gain = std::max(gain, (now - last - std::max(0.0, springs - held)) / kinetic);
      last = now;
      springs = held;
    }
    sum_of_gains += gain;
    largest_gain = std::max(largest_gain, gain);
    const std::string which = text(stiffness, 3) + ' ' + text(dt, 3) + ' ' + std::to_string(number);
    EXPECT_FALSE(has(flags, StepFlag::not_finite)) << which;
    EXPECT_FALSE(has(flags, StepFlag::fell_through)) << which;
    EXPECT_LT(last, first) << which;
    EXPECT_LT(gain, stiffness > 0 || dt > 1e-2 ? 0.05 : 1e-3) << which;
    EXPECT_LE(state.counters.unconverged, 1 + state.counters.substeps / 1000) << which;
    unconverged += state.counters.unconverged;
    substeps += state.counters.substeps;
  }
  EXPECT_LE(unconverged, substeps / 1000) << text(stiffness, 3) << ' ' << text(dt, 3);
  // --gtest_output=json prints them
  const std::string setting = "_k" + text(stiffness, 3) + "_dt" + text(dt, 3);
  testing::Test::RecordProperty("mean_gain" + setting, text(sum_of_gains / n_heaps, 2));
  testing::Test::RecordProperty("largest_gain" + setting, text(largest_gain, 2));
}

}  // namespace talus::stability
