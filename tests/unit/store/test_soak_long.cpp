// Long and many runs: memory, size, drift of energy.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <fstream>

#include "run/runner.hpp"
#include "verify/cases/cases.hpp"

// Ten hours of simulated time, as many runs in one process and as one run, and one run of many
// frames: memory stays within the bound that the page of talus-dda states, and the health figures
// do not drift.
namespace {

using namespace talus;
using namespace talus::cases;

// Cubes in a loose stack that collapses on a rough plane of 20 degrees: islands form and part.
Scene falling_stack(int n_cubes, double friction_deg) {
  const SlopeFrame frame = slope_frame(20, 0);
  std::vector<Body> bodies;
  for (int i = 0; i < n_cubes; ++i) {
    Body body;
    const Vec3 low(1.05 * (i % 3), 0.3 * (i / 3), 0.05 + 1.1 * (i / 3));  // in the slope's axes
    body.parts.push_back(box_in(frame, Vec3::Zero(), low, low + Vec3::Ones()));
    body.spin = {0.2, 0.1 * i, 0};
    bodies.push_back(body);
  }
  const GroundClass ground = ground_of(friction_deg, 0.4);
  return scene_of(plane_trn(frame, 2, 400), ground, bodies, Settings{});
}

RunFile run_of(const Scene& scene, const RunOptions& options) {
  RunFile file;
  file.blocks.mass = scene.blocks.mass;
  Runner runner = begin_run(scene, options, {}, std::move(file));
  while (!is_over(runner)) advance(runner);
  finish(runner);
  update_file(runner, false);
  return std::move(runner.file);
}

double resident_mb() {
  std::ifstream statm("/proc/self/statm");
  double size = 0, resident = 0;
  statm >> size >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1 << 20);
}

// Present energy and energy gone since the start: stays the same [J].
double energy(const HealthRow& row) {
  return row.translation + row.rotation + row.potential + row.elastic + row.friction + row.impact +
         row.contact + row.removed - row.base;
}

void expect_sound(const RunFile& file) {
  for (const HealthRow& row : file.health) {
    EXPECT_EQ(row.fell_through, 0);
    EXPECT_EQ(row.not_finite, 0);
  }
}

long n_impacts(const RunFile& file) {
  long n = 0;
  for (const HealthRow& row : file.health) n += row.impacts;
  return n;
}

// 64 bytes a block and frame and 200 a frame; twice that while an array doubles its room, and 16 MB
// for the rest.
double allowed_mb(const Scene& scene, const RunOptions& options) {
  const double n_frames = options.duration / options.frame_interval + 1;
  const double stored_mb = n_frames * (n_blocks(scene) * 64 + 200) / (1 << 20);
  EXPECT_GT(stored_mb, 10);
  return 2 * stored_mb + 16;
}

TEST(Soak, ManyRunsInOneProcessDoNotGrow) {
  const Scene scene = falling_stack(4, 25);
  RunOptions options;
  options.duration = 2;
  options.frame_interval = 0.05;
  const RunFile first = run_of(scene, options);
  ASSERT_GT(n_impacts(first), 0);
  constexpr int n_warm = 100, n_runs = 18000;  // of two seconds each
  double warm_mb = 0;
  for (int run = 1; run <= n_runs; ++run) {
    const RunFile file = run_of(scene, options);
    ASSERT_EQ(file.frames.position, first.frames.position) << "run " << run;
    ASSERT_EQ(energy(file.health.back()), energy(first.health.back())) << "run " << run;
    if (run == n_warm) warm_mb = resident_mb();
  }
  EXPECT_LT(resident_mb() - warm_mb, 1);
}

TEST(Soak, OneRunOfManyFramesStaysWithinItsBound) {
  const Scene scene = falling_stack(9, 15);  // slides to the end
  RunOptions options;
  options.duration = 20;
  options.frame_interval = 0.001;
  options.passages = false;
  const double before_mb = resident_mb();
  const RunFile file = run_of(scene, options);
  EXPECT_LT(resident_mb() - before_mb, allowed_mb(scene, options));
  expect_sound(file);
  const HealthRow& last = file.health.back();
  const HealthRow& start = file.health.front();
  const double fallen = start.potential - last.potential;
  ASSERT_GT(fallen, 0);
  EXPECT_LT(std::abs(energy(last) - energy(start)) / fallen, 1e-3);
}

// Three spinning cubes that lose nothing bounce where they are. A hit is off by the compliance of
// the impact solver, 5e-7 of the energy (bounce_elastic of talus-verify); the energy that it takes
// or gives is in the balance.
TEST(Soak, TenHoursOfBouncingDoNotDrift) {
  const SlopeFrame frame = slope_frame(0, 0);
  std::vector<Body> bodies;
  for (int i = 0; i < 3; ++i) {
    Body body;
    const Vec3 low(6 * i, 0, 2 + i);
    body.parts.push_back(box_in(frame, Vec3::Zero(), low, low + Vec3::Ones()));
    body.spin = {0.2, 0.1 * i, 0.3};
    bodies.push_back(body);
  }
  const Scene scene = scene_of(plane_trn(frame, 2, 40), ground_of(0, 1), bodies, Settings{});
  RunOptions options;
  options.duration = 36000;
  options.frame_interval = 0.1;
  const double before_mb = resident_mb();
  const RunFile file = run_of(scene, options);
  EXPECT_LT(resident_mb() - before_mb, allowed_mb(scene, options));
  expect_sound(file);
  const HealthRow &start = file.health.front(), &last = file.health.back();
  const auto n_hits = static_cast<double>(n_impacts(file));
  EXPECT_GT(n_hits, 30000);
  EXPECT_EQ(last.unconverged, 0);
  EXPECT_EQ(last.left_domain, 0);
  const double fall = 20 * 2500 * 3;  // of all cubes, from 2 m [J]
  EXPECT_LT(std::abs(energy(last) - energy(start)), 1e-6 * fall);
  EXPECT_LT(std::abs(last.impact + last.contact), 1e-6 * n_hits * fall / 3);
}

}  // namespace
