// tests/stability/random_blocks.hpp
// Throws random blocks at a terrain and watches them: plates and needles 1:100, boxes and cubes, 1
// cm to 10 m, up to 100 m/s and 10 rad/s.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "base/random.hpp"
#include "base/text.hpp"
#include "motion/rotation.hpp"
#include "step/step.hpp"
#include "unit/contact/ground_overlap.hpp"
#include "verify/cases/cases.hpp"

namespace talus::stability {

/// A block may reach below the ground by this part of its radius, or this length if that is more
/// [m].
inline constexpr double depth_tolerance = 0.02, least_depth_m = 5e-3;

/// Findings of a run.
struct Outcome {
  int not_finite = 0, too_deep = 0, gained = 0;
  std::set<int> thin_too_deep;  ///< plates and needles that were too deep at some time
  int left = 0, still_there = 0;
  double deepest = 0, deepest_thin = 0;  ///< over the tolerance [-]
  double balance = 0;                    ///< of all energies over the energy lost [-]
  long unconverged = 0, substeps = 0;
  StepFlag flags = StepFlag::none;
};

/// Fractal ground by midpoint sums, n x n nodes.
inline Trn rough_trn(int n, double cell_size, std::uint64_t seed) {
  Random random(seed, "rough ground");
  double phase[8][3];
  for (auto& p : phase)
    for (double& x : p) x = random.uniform(0, 6.283);
  return cases::make_trn(
      [&](double x, double y) {
        double z = 0.35 * x, length = 200;
        for (const auto& p : phase) {
          z += 0.07 * length *
               std::sin(6.283 * (x * std::cos(p[2]) + y * std::sin(p[2])) / length + p[0]) *
               std::cos(p[1]);
          length *= 0.55;
        }
        return z;
      },
      cell_size, cell_size * (n - 1) / 2);
}

inline Polyhedron random_shape(Random& random, double size) {
  const auto kind = random.below(4);
  Vec3 edges = Vec3::Constant(size);
  if (kind == 1) edges.z() = size / 100;
  if (kind == 2) edges.y() = edges.z() = size / 100;
  if (kind == 3) edges = size * Vec3(1, random.uniform(0.2, 1), random.uniform(0.1, 1));
  return box(-edges / 2, edges / 2);
}

inline Body random_body(const Trn& trn, Random& random) {
  const double size = std::pow(10, random.uniform(-2, 1));
  const Polyhedron shape = random_shape(random, size);
  double x = 0, y = 0, ground = std::nan("");
  const double width = (trn.n_cols - 1) * trn.cell_size, height = (trn.n_rows - 1) * trn.cell_size;
  const double radius = shape.vertices[0].norm();
  while (std::isnan(ground)) {
    x = trn.node0.x() + random.uniform(0.15, 0.85) * width;
    y = trn.node0.y() - random.uniform(0.15, 0.85) * height;
    ground = elevation_at(trn, x, y);
  }
  for (int i = 0; i < 60; ++i)
    ground = std::max(ground, elevation_at(trn, x + radius * random.uniform(-1, 1),
                                           y + radius * random.uniform(-1, 1)));
  Quat q(random.normal(), random.normal(), random.normal(), random.normal());
  Body body;
  body.parts = {cases::moved(shape, q.normalized().toRotationMatrix(), Vec3::Zero(),
                             Vec3(x, y, ground + radius + 1 + random.uniform(0, 5)))};
  const double speed = random.uniform() < 0.3 ? random.uniform(0, 100) : random.uniform(0, 10);
  const Vec3 direction(random.normal(), random.normal(), random.normal() - 0.5);
  body.velocity = speed * direction.normalized();
  body.spin = random.uniform(0, 10) * Vec3(random.normal(), random.normal(), random.normal());
  return body;
}

/// Energy of a block over its mass [J/kg].
inline double energy_of(const Scene& scene, const Motion& m, int b) {
  const auto i = static_cast<std::size_t>(b);
  const Vec3 spin = angular_velocity(m.pose.attitude, m.angular_momentum, scene.blocks.inertia[i]);
  return 0.5 * m.velocity.squaredNorm() +
         0.5 * spin.dot(m.angular_momentum) / scene.blocks.mass[i] -
         scene.gravity.dot(m.pose.position);
}

/// Depth of a block in the ground, normal to it where it is deepest [m]; 0 where part of it
/// lies beside the terrain.
inline double depth_in_ground(const Scene& scene, const Body& body, int b, const Motion& m) {
  const Trn& trn = scene.ground.trn;
  const Pose& rest = scene.blocks.rest[static_cast<std::size_t>(b)];
  Polyhedron placed = body.parts[0];
  for (Vec3& v : placed.vertices) {
    v = place(m.pose, rest.attitude.conjugate() * (v - rest.position));
    if (!contains(trn, v.x(), v.y())) return 0;
  }
  const test::GroundOverlap overlap = test::vertical_overlap(trn, placed);
  return overlap.height *
         triangle_plane(trn, triangle_at(trn, overlap.at.x(), overlap.at.y())).normal.z();
}

inline void watch(const Scene& scene, const std::vector<Body>& bodies, const State& state,
                  std::vector<double>& energy, Outcome& out) {
  for (int b = 0; b < n_blocks(scene); ++b) {
    const auto i = static_cast<std::size_t>(b);
    if (state.phase[i] == Phase::left_domain) continue;
    const Motion m = motion_at(scene, state, b, state.time);
    const bool finite = m.pose.position.allFinite() && m.velocity.allFinite() &&
                        m.angular_momentum.allFinite() && m.pose.attitude.coeffs().allFinite();
    out.not_finite += !finite;
    const double depth = depth_in_ground(scene, bodies[i], b, m);
    const double allowed = std::max(least_depth_m, depth_tolerance * scene.blocks.shapes.radius[i]);
    if (scene.blocks.shapes.thickness[i] < scene.blocks.shapes.radius[i] / 20) {
      if (!(depth <= allowed)) out.thin_too_deep.insert(b);
      out.deepest_thin = std::max(out.deepest_thin, depth / allowed);
    } else {
      out.too_deep += !(depth <= allowed);
      out.deepest = std::max(out.deepest, depth / allowed);
    }
    const double now = energy_of(scene, m, b);
    out.gained += !(now <= energy[i] + 0.05 + 1e-4 * 0.5 * m.velocity.squaredNorm());
    // out of an overlap a block is lifted again
    energy[i] = std::min(energy[i], now + scene.gravity.norm() * std::max(0.0, depth));
  }
}

inline Outcome run_random_blocks(const Trn& trn, int n, double duration_s, std::uint64_t seed) {
  Random random(seed, "random blocks");
  std::vector<Body> bodies;
  for (int i = 0; i < n; ++i) bodies.push_back(random_body(trn, random));
  GroundClass ground;
  ground.friction = 0.6;
  ground.restitution = 0.5;
  Settings settings;
  settings.block_contacts = false;  // each alone: they start wherever chance puts them
  const Scene scene = cases::scene_of(trn, ground, bodies, settings);
  State state = start(scene);
  Work work = make_work(scene);
  Outcome out;
  std::vector<double> energy;
  for (int b = 0; b < n; ++b) energy.push_back(energy_of(scene, motion_at(scene, state, b, 0), b));
  const auto total = [&] {
    const Energies e = energies(scene, state);
    const EnergyLedger& l = state.ledger;
    return e.translation + e.rotation + e.potential + l.friction + l.impact + l.contact + l.removed;
  };
  const double before = total();
  for (int i = 0; state.time < duration_s; ++i) {
    out.flags = out.flags | step(scene, state, work).flags;
    if (i % 10 == 0) watch(scene, bodies, state, energy, out);
  }
  out.balance = std::abs(total() - before) / (state.ledger.friction + state.ledger.impact);
  out.left = state.counters.left_domain;
  for (const Phase phase : state.phase) out.still_there += phase != Phase::left_domain;
  out.unconverged = state.counters.unconverged;
  out.substeps = state.counters.substeps;
  return out;
}

inline void expect_sound(const Outcome& out, int n) {
  // --gtest_output=json prints them
  testing::Test::RecordProperty("deepest_over_tolerance", text(out.deepest, 3));
  testing::Test::RecordProperty("left_terrain", out.left);
  testing::Test::RecordProperty("unconverged_substeps", static_cast<int>(out.unconverged));
  testing::Test::RecordProperty("substeps", static_cast<int>(out.substeps));
  EXPECT_EQ(out.not_finite, 0);
  testing::Test::RecordProperty("deepest_thin_over_tolerance", text(out.deepest_thin, 3));
  EXPECT_LT(out.deepest_thin, 2);
  testing::Test::RecordProperty("thin_too_deep", static_cast<int>(out.thin_too_deep.size()));
  EXPECT_LE(static_cast<int>(out.thin_too_deep.size()), n / 1000);
  EXPECT_EQ(out.too_deep, 0) << "deepest " << out.deepest << " of what is allowed";
  EXPECT_EQ(out.gained, 0);
  EXPECT_FALSE(has(out.flags, StepFlag::fell_through));
  EXPECT_EQ(out.left + out.still_there, n);
  EXPECT_LT(out.balance, 1e-3);
  EXPECT_LT(out.unconverged, 1 + out.substeps / 1000);
}

}  // namespace talus::stability
