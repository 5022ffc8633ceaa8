// Runs: checkpoints, resuming, rows that do not depend on frames.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "base/error.hpp"
#include "run/runner.hpp"
#include "scene/fence.hpp"
#include "scene/stems.hpp"
#include "step/step.hpp"
#include "store/checkpoint.hpp"
#include "verify/cases/cases.hpp"

namespace {

using namespace talus;
using namespace talus::cases;

// Boxes that fall on a rough slope, spin, bounce and slide; far enough apart not to meet.
Scene bouncing_scene() {
  const double slope = std::tan(std::numbers::pi / 6);
  const auto height = [&](double x, double y) {
    return -slope * x + 0.3 * std::sin(0.7 * x) * std::cos(0.9 * y);
  };
  std::vector<Body> bodies;
  for (int i = 0; i < 3; ++i) {
    Body body;
    const SlopeFrame frame = slope_frame(30, 0);
    const Vec3 base(-30 + 2.0 * i, -20 + 15.0 * i, height(-30 + 2.0 * i, -20 + 15.0 * i) + 2);
    body.parts.push_back(box_in(frame, base, {0, 0, 0}, {2, 1.5, 1 + 0.2 * i}));
    body.velocity = {4, 0.5 * i, 0};
    body.spin = {0.5, 1, -0.3 * i};
    bodies.push_back(body);
  }
  Settings settings;
  settings.dt = 0.01;
  const GroundClass ground = ground_of(25, 0.5);
  return scene_of(make_trn(height, 2, 80), ground, bodies, settings);
}

RunOptions options(double frame_interval) {
  RunOptions made;
  made.duration = 4;
  made.frame_interval = frame_interval;
  made.limits.max_lost_share = 1;
  return made;
}

std::vector<RecordLine> lines() {
  return {record_line("low", {{-10, -60, 0}, {-10, 60, 0}}),
          record_line("lower", {{0, -60, 0}, {5, 0, 0}, {0, 60, 0}})};
}

RunFile blocks_of(const Scene& scene) {
  RunFile file;
  file.blocks.mass = scene.blocks.mass;
  return file;
}

// A run that packs and unpacks its checkpoint after each of the given steps.
RunFile computed(const Scene& scene, const RunOptions& wanted, const std::vector<int>& stops = {}) {
  Runner runner = begin_run(scene, wanted, lines(), blocks_of(scene));
  std::vector<int> left = stops;
  for (int step = 0; !is_over(runner); ++step) {
    if (!left.empty() && step == left.front()) {
      update_file(runner, true);
      Runner next = resume_run(scene, wanted, lines(), runner.file, "memory");
      runner.law = next.law;
      runner.state = next.state;
      runner.work = make_work(scene);
      runner.passages = next.passages;
      runner.crossings = next.crossings;
      runner.sampler = next.sampler;
      runner.interval = next.interval;
      runner.energy_start = next.energy_start;
      runner.file = next.file;
      left.erase(left.begin());
    }
    advance(runner);
  }
  finish(runner);
  update_file(runner, false);
  return runner.file;
}

bool same(const Passage& a, const Passage& b) {
  return a.block == b.block && a.cell == b.cell && a.largest.speed == b.largest.speed &&
         a.largest.translational_energy == b.largest.translational_energy &&
         a.largest.total_energy == b.largest.total_energy &&
         a.largest.centroid_height == b.largest.centroid_height &&
         a.largest.top_height == b.largest.top_height && a.first_time == b.first_time;
}

void expect_same_rows(const RunFile& a, const RunFile& b) {
  ASSERT_EQ(a.passages.size(), b.passages.size());
  for (std::size_t i = 0; i < a.passages.size(); ++i)
    ASSERT_TRUE(same(a.passages[i], b.passages[i])) << i;
  ASSERT_EQ(a.crossings.size(), b.crossings.size());
  for (std::size_t i = 0; i < a.crossings.size(); ++i) {
    EXPECT_EQ(a.crossings[i].time, b.crossings[i].time);
    EXPECT_EQ(a.crossings[i].position, b.crossings[i].position);
    EXPECT_EQ(a.crossings[i].spin, b.crossings[i].spin);
    EXPECT_EQ(a.crossings[i].n_crossings, b.crossings[i].n_crossings);
  }
}

// A fence across the path of the boxes, which yields.
Scene fenced_scene() {
  Scene scene = bouncing_scene();
  StandingFence fence;
  for (const double y : {-30.0, -10.0, 10.0, 30.0})
    fence.posts.emplace_back(-10, y, elevation_at(scene.ground.trn, -10, y));
  fence.depth = {1, 1, 1};
  fence.height = 4;
  fence.capacity = 2e5;
  fence.deflection = 2;
  add_fence(scene, fence);
  return scene;
}

TEST(Runner, ResumesWhatFencesHaveMet) {
  const Scene scene = fenced_scene();
  const RunFile whole = computed(scene, options(0.1));
  ASSERT_GE(whole.fence_hits.size(), 2u);
  ASSERT_EQ(whole.panels.size(), 3u);
  double work = 0;
  for (const PanelRow& panel : whole.panels) work += panel.work;
  EXPECT_GT(work, 1e4);
  EXPECT_NEAR(whole.health.back().fence, work, 1e-9 * work);
  // the panels were touched within substeps, which ended there; counts are those of the interval
  std::int64_t n_touches = 0;
  for (const HealthRow& row : whole.health)
    n_touches += row.cuts[static_cast<std::size_t>(SubstepCut::yielding_touched)];
  EXPECT_GE(n_touches, 1);
  const RunFile resumed = computed(scene, options(0.1), {100, 190, 230});
  EXPECT_EQ(whole.frames.position, resumed.frames.position);
  ASSERT_EQ(whole.fence_hits.size(), resumed.fence_hits.size());
  for (std::size_t i = 0; i < whole.fence_hits.size(); ++i) {
    EXPECT_EQ(whole.fence_hits[i].time, resumed.fence_hits[i].time);
    EXPECT_EQ(whole.fence_hits[i].work, resumed.fence_hits[i].work);
  }
  for (std::size_t i = 0; i < whole.health.size(); ++i)
    EXPECT_EQ(whole.health[i].cuts, resumed.health[i].cuts);
  for (std::size_t p = 0; p < whole.panels.size(); ++p) {
    EXPECT_EQ(whole.panels[p].deflection, resumed.panels[p].deflection);
    EXPECT_EQ(whole.panels[p].broken_by, resumed.panels[p].broken_by);
  }
}

// The boxes run into a stand of trees.
Scene wooded_scene() {
  Scene scene = bouncing_scene();
  std::vector<Stem> stems;
  for (int i = 0; i < 20; ++i)
    for (int j = 0; j < 30; ++j) {
      Stem& stem = stems.emplace_back();
      const double x = -22 + 1.7 * i, y = -25 + 1.9 * j;
      stem.foot = Vec3(x, y, elevation_at(scene.ground.trn, x, y));
      stem.height = 20;
      stem.radius = 0.1;
      stem.capacity = 5e3 + 1e3 * j;
      stem.deflection = 0.5;
      stem.id = 30 * i + j;
    }
  GroundClass face;
  face.friction = 0.3;
  add_forest(scene, stems, {face});
  return scene;
}

TEST(Runner, ResumesWhatStemsHaveMet) {
  const Scene scene = wooded_scene();
  const RunFile whole = computed(scene, options(0.1));
  ASSERT_GE(whole.tree_hits.size(), 5u);
  EXPECT_TRUE(std::any_of(whole.tree_hits.begin(), whole.tree_hits.end(),
                          [](const TreeHitRow& row) { return row.broken_by >= 0; }));
  double work = 0;
  for (const TreeHitRow& row : whole.tree_hits) work += row.hit.work;
  EXPECT_NEAR(whole.health.back().fence, work, 1e-9 * work);
  const RunFile resumed = computed(scene, options(0.1), {60, 100, 131, 190, 230});
  EXPECT_EQ(whole.frames.position, resumed.frames.position);
  ASSERT_EQ(whole.tree_hits.size(), resumed.tree_hits.size());
  for (std::size_t i = 0; i < whole.tree_hits.size(); ++i) {
    EXPECT_EQ(whole.tree_hits[i].stem, resumed.tree_hits[i].stem);
    EXPECT_EQ(whole.tree_hits[i].hit.time, resumed.tree_hits[i].hit.time);
    EXPECT_EQ(whole.tree_hits[i].hit.work, resumed.tree_hits[i].hit.work);
    EXPECT_EQ(whole.tree_hits[i].left, resumed.tree_hits[i].left);
  }
}

TEST(Runner, RowsDoNotDependOnTheFrameIntervalToTheBit) {
  const Scene scene = bouncing_scene();
  const RunFile coarse = computed(scene, options(1)), fine = computed(scene, options(0.037));
  ASSERT_GT(coarse.passages.size(), 60u);
  ASSERT_GE(coarse.crossings.size(), 4u);
  expect_same_rows(coarse, fine);
  EXPECT_EQ(n_frames(coarse.frames), 5);
  EXPECT_EQ(n_frames(fine.frames), 110);  // 109 of them regular, and the end
}

TEST(Runner, FramesAreTheSameToTheBitWithoutPassages) {
  const Scene scene = bouncing_scene();
  RunOptions bare = options(0.1);
  bare.passages = false;
  const RunFile all = computed(scene, options(0.1)), few = computed(scene, bare);
  ASSERT_GT(n_frames(all.frames), 30);
  EXPECT_EQ(all.frames.position, few.frames.position);
  EXPECT_EQ(all.frames.velocity, few.frames.velocity);
  EXPECT_EQ(few.passages.size(), 0u);
}

TEST(Runner, ResumedAnywhereGoesOnToTheSameBits) {
  const Scene scene = bouncing_scene();
  const RunFile whole = computed(scene, options(0.1));
  for (const std::vector<int>& stops :
       std::vector<std::vector<int>>{{1}, {57}, {100, 101, 102}, {30, 199, 333, 398}}) {
    const RunFile resumed = computed(scene, options(0.1), stops);
    expect_same_rows(whole, resumed);
    EXPECT_EQ(whole.frames.time, resumed.frames.time);
    EXPECT_EQ(whole.frames.position, resumed.frames.position);
    EXPECT_EQ(whole.frames.attitude, resumed.frames.attitude);
    EXPECT_EQ(whole.frames.spin, resumed.frames.spin);
    ASSERT_EQ(whole.health.size(), resumed.health.size());
    for (std::size_t i = 0; i < whole.health.size(); ++i) {
      EXPECT_EQ(whole.health[i].passes, resumed.health[i].passes);
      EXPECT_EQ(whole.health[i].friction, resumed.health[i].friction);
      EXPECT_EQ(whole.health[i].cuts, resumed.health[i].cuts);
      EXPECT_EQ(whole.health[i].largest_penetration, resumed.health[i].largest_penetration);
    }
  }
}

void expect_same_frames(const RunFile& a, const RunFile& b) {
  EXPECT_EQ(a.frames.time, b.frames.time);
  EXPECT_EQ(a.frames.position, b.frames.position);
  EXPECT_EQ(a.frames.attitude, b.frames.attitude);
  EXPECT_EQ(a.frames.velocity, b.frames.velocity);
}

// A column of cubes sleeps until a block falls on it.
TEST(Runner, ResumesWhileBlocksSleep) {
  std::vector<Body> bodies;
  for (int k = 0; k < 3; ++k)
    bodies.push_back(body_of(box(Vec3(-0.5, -0.5, k), Vec3(0.5, 0.5, k + 1))));
  bodies.push_back(body_of(box(Vec3(-0.4, -0.3, 35), Vec3(0.6, 0.7, 36))));
  const Scene scene =
      scene_of(plane_trn(slope_frame(0, 0), 0.5, 60), ground_of(30, 0.3), bodies, {});
  RunOptions wanted = options(0.1);
  wanted.duration = 2;
  const RunFile asleep = computed(scene, wanted);
  EXPECT_EQ(std::count(asleep.phase.begin(), asleep.phase.end(), Phase::asleep), 3);
  wanted.duration = 3;
  const RunFile whole = computed(scene, wanted);
  EXPECT_EQ(std::count(whole.phase.begin(), whole.phase.end(), Phase::asleep), 0);
  expect_same_frames(whole, computed(scene, wanted, {300, 400, 507, 520}));
}

// Steps are longer while most of the moving rock is a mass; a resumed run continues with them.
TEST(Runner, ResumesInAMassOfLongSteps) {
  const SlopeFrame frame = slope_frame(40, 30);
  std::vector<Body> bodies;
  for (int i = 0; i < 48; ++i) {
    const Vec3 low(i % 4, i / 4 % 4, i / 16);
    bodies.push_back(body_of(box_in(frame, Vec3::Zero(), low, low + Vec3(1, 1, 1))));
  }
  const Scene scene = scene_of(plane_trn(frame, 4, 200), ground_of(25, 0.3), bodies, {});
  RunOptions wanted = options(0.1);
  wanted.duration = 1;
  wanted.limits.max_deep_share = 1;
  const RunFile whole = computed(scene, wanted);
  EXPECT_NEAR(whole.info.time, 1, 1e-9);
  std::int64_t steps = 0;
  for (const HealthRow& row : whole.health) steps += row.steps;
  EXPECT_LT(steps, 150);
  expect_same_frames(whole, computed(scene, wanted, {3, 50, 51, 77}));
}

// The rebound of a block is found where it hits, and given to it where it lifts off.
TEST(Runner, ResumesTheReboundsOfLawPaper) {
  Scene scene = bouncing_scene();
  scene.settings.dt = 1e-3;
  scene.settings.normal_stiffness = 1e9;
  scene.settings.block_contacts = false;
  RunOptions wanted = options(0.1);
  wanted.paper.emplace();
  std::vector<int> often;
  for (int step = 5; step < 4000; step += 5) often.push_back(step);
  const RunFile whole = computed(scene, wanted), resumed = computed(scene, wanted, often);
  EXPECT_GT(whole.health.back().impact, 1e3);
  EXPECT_EQ(whole.frames.position, resumed.frames.position);
}

TEST(Runner, FramesStandAtTheirTimesAndAtTheEnd) {
  const Scene scene = bouncing_scene();
  RunOptions wanted = options(0.3);
  const RunFile file = computed(scene, wanted);
  ASSERT_EQ(n_frames(file.frames), 15);
  for (int k = 0; k < 14; ++k) EXPECT_DOUBLE_EQ(file.frames.time[k], 0.3 * k);
  EXPECT_NEAR(file.frames.time[14], 4, 1e-9);
  EXPECT_EQ(file.health.size(), 14u);
}

TEST(Runner, ABrokenLimitFailsTheRun) {
  Scene scene = bouncing_scene();
  for (GroundClass& ground : scene.ground.classes) ground.restitution = 0;  // they come to slide
  RunOptions wanted = options(0.1);
  wanted.limits.max_penetration = 1e-15;
  Runner runner = begin_run(scene, wanted, lines(), blocks_of(scene));
  while (!is_over(runner) && !has_failed(runner)) advance(runner);
  EXPECT_TRUE(has_failed(runner));
  EXPECT_LT(runner.state.time, 3.9);
  int n_broken = 0;
  for (const HealthCheck& check : health_checks(runner)) n_broken += check.pass ? 0 : 1;
  EXPECT_EQ(n_broken, 1);
}

TEST(Runner, UnconvergedStepsAreLimited) {
  const Scene scene = bouncing_scene();
  RunOptions wanted = options(0.1);
  wanted.limits.max_unconverged_share = 0.01;
  Runner runner = begin_run(scene, wanted, lines(), blocks_of(scene));
  for (int i = 0; i < 100; ++i) advance(runner);
  const auto broken = [&] {
    std::vector<std::string> names;
    for (const HealthCheck& check : health_checks(runner))
      if (!check.pass) names.push_back(check.name);
    return names;
  };
  EXPECT_TRUE(broken().empty());
  runner.state.counters.unconverged = 2;
  EXPECT_EQ(broken(), std::vector<std::string>{"steps accepted unconverged, share"});
}

// One block of three is a third of the number, and here 0.17 % of the mass.
TEST(Runner, BlocksThatLeftTheTerrainCountByTheirMass) {
  Scene scene = bouncing_scene();
  scene.blocks.mass = {1000, 997, 3.4};
  RunOptions wanted = options(0.1);
  wanted.limits = RunLimits{};
  Runner runner = begin_run(scene, wanted, lines(), blocks_of(scene));
  const auto lost = [&] {
    for (const HealthCheck& check : health_checks(runner))
      if (check.name.find("left the terrain") != std::string::npos) return check;
    return HealthCheck{};
  };
  EXPECT_EQ(lost().value, 0);
  leave_domain(runner.state, 2);
  ++runner.state.counters.left_domain;
  EXPECT_NEAR(lost().value, 0.0017, 1e-5);
  EXPECT_TRUE(lost().pass);
  leave_domain(runner.state, 1);
  ++runner.state.counters.left_domain;
  EXPECT_NEAR(lost().value, 0.5, 1e-3);
  EXPECT_FALSE(lost().pass);
}

// Runs of one rock and of many that were asked for to be alone belong together.
TEST(Runner, ARunOfALoneBlockSaysWhatWasAskedFor) {
  const Scene lone = scene_of(plane_trn(slope_frame(0, 0), 1, 20), {},
                              {body_of(box(Vec3(0, 0, 1), Vec3(1, 1, 2)))}, {});
  for (const bool asked : {false, true}) {
    RunFile file = blocks_of(lone);
    file.info.independent = asked;
    EXPECT_EQ(begin_run(lone, options(0.1), {}, file).file.info.independent, asked);
  }
}

}  // namespace
