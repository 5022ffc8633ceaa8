// Rocks that fall one by one: same bits in any group, thread or order.
#include <gtest/gtest.h>

#include <atomic>
#include <numbers>

#include "run/runner.hpp"
#include "scene/fence.hpp"
#include "scene/make_scene.hpp"
#include "store/checkpoint.hpp"
#include "verify/cases/cases.hpp"

namespace {

using namespace talus;
using namespace talus::cases;

double height(double x, double y) {
  return -std::tan(std::numbers::pi / 6) * x + 0.3 * std::sin(0.7 * x) * std::cos(0.9 * y);
}

// Boxes `first` to `end` of a row above a rough slope.
std::vector<Body> boxes(int first, int end) {
  std::vector<Body> bodies;
  for (int i = first; i < end; ++i) {
    Body body;
    const double x = -20 + 0.1 * i, y = -30 + i;
    body.parts.push_back(box_in(slope_frame(30, 0), Vec3(x, y, height(x, y) + 1.5), {0, 0, 0},
                                {1.2, 1, 0.6 + 0.01 * i}));
    body.velocity = {3, 0.02 * i, 0};
    body.spin = {0.5, 1, -0.03 * i};
    bodies.push_back(body);
  }
  return bodies;
}

// They fall one by one.
Scene rocks(int first, int end) {
  Settings settings;
  settings.dt = 0.01;
  settings.block_contacts = false;
  return scene_of(make_trn(height, 2, 80), ground_of(30, 0.5), boxes(first, end), settings);
}

void add_fence_below(Scene& scene) {
  StandingFence fence;
  for (const double y : {-35.0, -10.0, 10.0, 35.0}) fence.posts.emplace_back(0, y, height(0, y));
  fence.depth = {1, 1, 1};
  fence.height = 4;
  fence.capacity = 2e5;
  fence.deflection = 2;
  add_fence(scene, fence);
}

Scene fenced_rocks(int n) {
  Scene scene = rocks(0, n);
  add_fence_below(scene);
  return scene;
}

RunOptions options() {
  RunOptions made;
  made.duration = 5;
  made.frame_interval = 0.5;
  made.limits.max_lost_share = 1;
  return made;
}

Runner begun(const Scene& scene, const RunOptions& wanted) {
  RunFile file;
  file.blocks.mass = scene.blocks.mass;
  return begin_run(scene, wanted, {record_line("low", {{5, -60, 0}, {5, 60, 0}})}, file);
}

Runner over(Runner runner) {
  while (!is_over(runner)) advance(runner);
  finish(runner);
  update_file(runner, false);
  return runner;
}
RunFile ended(Runner runner) { return over(std::move(runner)).file; }

void expect_same(const RunFile& a, const RunFile& b) {
  ASSERT_EQ(a.passages.size(), b.passages.size());
  for (std::size_t i = 0; i < a.passages.size(); ++i) {
    EXPECT_EQ(a.passages[i].block, b.passages[i].block);
    EXPECT_EQ(a.passages[i].cell, b.passages[i].cell);
    EXPECT_EQ(a.passages[i].first_time, b.passages[i].first_time);
    EXPECT_EQ(a.passages[i].largest.total_energy, b.passages[i].largest.total_energy);
  }
  ASSERT_EQ(a.crossings.size(), b.crossings.size());
  for (std::size_t i = 0; i < a.crossings.size(); ++i) {
    EXPECT_EQ(a.crossings[i].block, b.crossings[i].block);
    EXPECT_EQ(a.crossings[i].time, b.crossings[i].time);
  }
  EXPECT_EQ(a.frames.time, b.frames.time);
  EXPECT_EQ(a.frames.position, b.frames.position);
  EXPECT_EQ(a.frames.attitude, b.frames.attitude);
  ASSERT_EQ(a.health.size(), b.health.size());
  for (std::size_t i = 0; i < a.health.size(); ++i) {
    EXPECT_EQ(a.health[i].friction, b.health[i].friction);
    EXPECT_EQ(a.health[i].substeps, b.health[i].substeps);
  }
  ASSERT_EQ(a.fence_hits.size(), b.fence_hits.size());
  for (std::size_t i = 0; i < a.fence_hits.size(); ++i) {
    EXPECT_EQ(a.fence_hits[i].block, b.fence_hits[i].block);
    EXPECT_EQ(a.fence_hits[i].work, b.fence_hits[i].work);
  }
  ASSERT_EQ(a.panels.size(), b.panels.size());
  for (std::size_t i = 0; i < a.panels.size(); ++i) {
    EXPECT_EQ(a.panels[i].rock, b.panels[i].rock);
    EXPECT_EQ(a.panels[i].work, b.panels[i].work);
  }
}

// A few rocks move among many, to the bit, as in a scene of their own.
TEST(Rocks, FallAmongManyAsAmongFew) {
  const Scene many = rocks(0, 50), few = rocks(20, 30);
  const RunFile all = ended(begun(many, options())), some = ended(begun(few, options()));
  std::vector<Passage> of_some;
  for (Passage row : all.passages)
    if (row.block >= 20 && row.block < 30) row.block -= 20, of_some.push_back(row);
  ASSERT_EQ(of_some.size(), some.passages.size());
  EXPECT_GT(of_some.size(), 50U);
  for (std::size_t i = 0; i < of_some.size(); ++i) {
    EXPECT_EQ(of_some[i].cell, some.passages[i].cell);
    EXPECT_EQ(of_some[i].first_time, some.passages[i].first_time);
    EXPECT_EQ(of_some[i].largest.total_energy, some.passages[i].largest.total_energy);
  }
  EXPECT_EQ(all.frames.time, some.frames.time);
  const int last = n_frames(all.frames) - 1;
  for (int b = 0; b < 10; ++b)
    EXPECT_EQ(frame_block(all, last, 20 + b).position, frame_block(some, last, b).position);
  double energy = 0;  // of all rocks, summed over runs of a few
  for (int first = 0; first < 50; first += 10) {
    const Scene scene = rocks(first, first + 10);
    energy += ended(begun(scene, options())).health.back().friction;
  }
  EXPECT_NEAR(all.health.back().friction, energy, 1e-12 * energy);
}

TEST(Rocks, HaveTheSameBitsInTwoThreads) {
  const Scene scene = fenced_rocks(40);
  Workers workers(2);
  RunOptions shared = options();
  shared.workers = &workers;
  const RunFile one = ended(begun(scene, options()));
  EXPECT_GT(one.fence_hits.size(), 10U);
  expect_same(one, ended(begun(scene, shared)));
}

TEST(Rocks, FallTheSameWhereTheirSurfacesAreMadeAsTheyFall) {
  const Scene scene = fenced_rocks(40);
  BlockSet set;
  set.material_names = {"rock"};
  for (const Body& body : boxes(0, 40)) add_body(set, body);
  Scene without = rocks(0, 40);
  without.blocks = {};
  const Material material;
  add_blocks_without_surfaces(without, set, std::span(&material, 1));
  add_fence_below(without);
  EXPECT_TRUE(vertices_of(without.blocks.shapes, 39).empty());
  RunOptions later = options();
  later.surfaces = &set;
  expect_same(ended(begun(scene, options())), ended(begun(without, later)));
}

TEST(Rocks, HaveTheSamePassagesWhereThoseWentThroughAFile) {
  const Scene scene = fenced_rocks(40);
  RunOptions few = options();
  few.folder = testing::TempDir();
  few.passages_in_memory = 100;
  const Runner whole = over(begun(scene, options())), parted = over(begun(scene, few));
  ASSERT_TRUE(parted.earlier);
  EXPECT_LE(parted.file.passages.size(), 100U);
  ASSERT_EQ(parted.earlier->size() + parted.file.passages.size(), whole.file.passages.size());
  for (std::size_t i = 0; i < parted.earlier->size(); ++i) {
    EXPECT_EQ((*parted.earlier)[i].block, whole.file.passages[i].block);
    EXPECT_EQ((*parted.earlier)[i].cell, whole.file.passages[i].cell);
  }
  few.folder = testing::TempDir() + "no such folder";
  EXPECT_THROW(ended(begun(scene, few)), InputError);
}

TEST(Rocks, GoOnWhereTheyWereStopped) {
  const Scene scene = fenced_rocks(49);  // of which one is left over after three batches
  std::atomic<int> n_asked = 0;
  RunOptions stopped = options();
  stopped.is_stopped = [&] { return ++n_asked > 2; };
  Runner runner = begun(scene, stopped);
  EXPECT_TRUE(advance(runner));
  EXPECT_FALSE(is_over(runner));
  EXPECT_GT(done_share(runner), 0.5);
  EXPECT_LT(done_share(runner), 0.8);
  update_file(runner, true);
  for (int b = runner.n_done; b < n_blocks(scene); ++b)
    EXPECT_EQ(frame_block(runner.file, 3, b).position, scene.blocks.rest[b].position);
  Runner next =
      resume_run(scene, options(), runner.crossings.lines, std::move(runner.file), "memory");
  expect_same(ended(std::move(next)), ended(begun(scene, options())));
}

}  // namespace
