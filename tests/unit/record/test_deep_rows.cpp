// Rows of deep blocks and their weight for the health of a run.
#include <gtest/gtest.h>

#include "record/deep_rows.hpp"
#include "run/runner.hpp"
#include "step/step.hpp"
#include "verify/cases/cases.hpp"

namespace {

using namespace talus;
using namespace talus::cases;

/// Twenty blocks of 8 m3 in a row, and after them one of `width` cubed that was deep in the ground.
struct Row {
  explicit Row(double width)
      : scene(scene_of(plane_trn(slope_frame(0, 0), 5, 100), ground_of(30), bodies(width), {})) {
    options.duration = 1;
    options.frame_interval = 0.1;
  }
  static std::vector<Body> bodies(double width) {
    std::vector<Body> made;
    for (int i = 0; i < 20; ++i)
      made.push_back(
          body_of(box(Vec3(-60 + 3 * i, 0, 0), Vec3(-58 + 3 * i, 2, 2 + 0.1 * (20 - i)))));
    made.push_back(body_of(box(Vec3(-40, 5, 0), Vec3(-40 + width, 5 + width, width))));
    return made;
  }
  Runner begin() {
    RunFile file;
    file.blocks.mass = scene.blocks.mass;
    return begin_run(scene, options, {}, std::move(file));
  }
  static void sink(Runner& runner) {
    DeepBlock& deep = runner.state.deep[20];
    deep.steps = 7;
    deep.depth = 0.05;
    deep.time = 3;
    deep.place = Vec3(1, 2, 3);
  }
  static std::vector<std::string> broken(const Runner& runner) {
    std::vector<std::string> names;
    for (const HealthCheck& check : health_checks(runner))
      if (!check.pass) names.push_back(check.name);
    return names;
  }

  Scene scene;
  RunOptions options;
};

const char* const share = "mass of blocks in by more than a tenth of their thickness, share";
const char* const matters = "such blocks in the toe, at a fence, or faster than by their fall";

// A splinter of 0.004 % of the mass that was in by more than a tenth is a warning, a block of 0.6 %
// fails the run.
TEST(DeepRows, HealthWeighsTheBlocksThatWereDeep) {
  for (const auto& [width, is_broken] : {std::pair{0.2, false}, {1.0, true}}) {
    Row row(width);
    Runner runner = row.begin();
    EXPECT_TRUE(Row::broken(runner).empty());
    Row::sink(runner);
    EXPECT_EQ(Row::broken(runner),
              is_broken ? std::vector<std::string>{share} : std::vector<std::string>{});
  }
}

// The splinter fails the run where it is in the farthest twentieth of the mass, at a fence, or too
// fast.
TEST(DeepRows, ASplinterThatMattersFailsTheRun) {
  Row row(0.2);
  Runner in_toe = row.begin(), at_fence = row.begin(), fast = row.begin();
  for (Runner* runner : {&in_toe, &at_fence, &fast}) Row::sink(*runner);
  in_toe.state.motion[20].pose.position.x() = 20;
  FenceHit hit;
  hit.block = 20;
  at_fence.state.fence.hits.push_back(hit);
  fast.state.deep[20].is_too_fast = true;
  for (Runner* runner : {&in_toe, &at_fence, &fast})
    EXPECT_EQ(Row::broken(*runner), std::vector<std::string>{matters});
  at_fence.state.fence.hits[0].block = 3;
  EXPECT_TRUE(Row::broken(at_fence).empty());
}

// Rocks that fall one by one are samples, each as much as another: one in a thousand may be deep,
// however large it is.
TEST(DeepRows, RocksOneByOneAreCounted) {
  const std::vector<std::string> both = {
      "rocks in by more than a tenth of their thickness, share",
      "such rocks in the toe, at a fence, or faster than by their fall, share"};
  for (const auto& [width, max_share, is_broken] :
       {std::tuple{0.2, 0.04, true}, {0.2, 0.05, false}, {2.0, 0.05, false}}) {  // one of 21
    Row row(width);
    row.scene.settings.block_contacts = false;
    row.options.limits.max_deep_share = max_share;
    Runner runner = row.begin();
    Row::sink(runner);
    runner.state.deep[20].is_too_fast = true;
    EXPECT_EQ(Row::broken(runner), is_broken ? both : std::vector<std::string>{});
  }
}

// The last two are pieces of a rock before them: one of 19 rocks is deep.
TEST(DeepRows, PiecesOfARockCountAsOne) {
  for (const auto& [max_share, is_broken] : {std::pair{0.05, true}, {0.06, false}}) {
    Row row(0.2);
    row.scene.settings.block_contacts = false;
    row.options.limits.max_deep_share = max_share;
    Runner runner = row.begin();
    Row::sink(runner);
    runner.state.deep[19] = runner.state.deep[20];
    row.scene.fragments.resize(21);
    for (int b = 0; b < 21; ++b) row.scene.fragments[b].released = b < 19 ? b : 18;
    row.scene.fragments[19].parent = row.scene.fragments[20].parent = 18;
    EXPECT_EQ(Row::broken(runner).empty(), !is_broken);
  }
}

// Every broken limit says which block, in which body, when, where and its share of the mass.
TEST(DeepRows, BrokenLimitsNameABlock) {
  Row row(1);
  Runner deep = row.begin();
  Row::sink(deep);
  row.options.limits.max_penetration = 0.01;
  Runner shallow = row.begin();
  shallow.state.numerical_faults.deepest = {3, 4, 0.02, 1.5, Vec3(1, 2, 3)};
  shallow.state.numerical_faults.left_domain = {5, -1, 0, 2, Vec3(1, 2, 3)};
  shallow.state.counters.left_domain = 1;
  shallow.state.phase[5] = Phase::left_domain;
  shallow.file.health.push_back({});
  shallow.file.health.back().largest_penetration = 0.02;
  int n = 0;
  for (const Runner* runner : {&deep, &shallow})
    for (const HealthCheck& check : health_checks(*runner)) {
      if (check.pass) continue;
      ++n;
      for (const char* word : {"block ", " s near 1, 2, 3", "% of the mass"})
        EXPECT_NE(check.where.find(word), std::string::npos) << check.name << ": " << check.where;
    }
  EXPECT_EQ(n, 3);
}

// Blocks that rebound almost in full are watched for lost energy as well.
TEST(DeepRows, ALossOfEnergyFailsWhereHitsReturnAlmostAll) {
  for (const double restitution : {0.3, 0.95}) {
    Scene scene = scene_of(plane_trn(slope_frame(0, 0), 5, 100), ground_of(30, restitution),
                           {body_of(box(Vec3(0, 0, 10), Vec3(1, 1, 11)))}, {});
    RunOptions options;
    options.duration = options.frame_interval = 0.1;
    RunFile file;
    file.blocks.mass = scene.blocks.mass;
    Runner runner = begin_run(scene, options, {}, std::move(file));
    while (!is_over(runner)) advance(runner);
    EXPECT_TRUE(Row::broken(runner).empty());
    HealthRow& last = runner.file.health.back();
    last.translation *= 0.9;  // gone, and nothing took it
    const std::vector<std::string> lost = {
        "energy lost but by friction and hits, share of the fall energy"};
    EXPECT_EQ(Row::broken(runner), restitution < 0.9 ? std::vector<std::string>{} : lost);
  }
}

// With a depth given that will do, that depth alone counts.
TEST(DeepRows, ALimitInMetresTakesThePlaceOfTheShare) {
  Row row(1);
  row.options.limits.max_penetration = 0.5;
  Runner runner = row.begin();
  Row::sink(runner);
  EXPECT_TRUE(Row::broken(runner).empty());
}

TEST(DeepRows, WordsNameBlockPartnerTimePlaceAndShare) {
  Row row(0.2);
  Runner runner = row.begin();
  Row::sink(runner);
  const std::vector<DeepRow> rows = deep_rows(row.scene, runner.state, {});
  ASSERT_EQ(rows.size(), 1u);
  const std::string words = deep_words(rows[0], {}, Vec3(1000, 2000, 0));
  EXPECT_EQ(words,
            "block 20 was in the ground by 0.05 m of its 0.2 m at 3 s near 1001, 2002, 3, deep in "
            "7 steps, 0.00328 % of the mass");
}

// A run that is stopped while a block is deep continues its count.
TEST(DeepRows, AreResumedFromACheckpoint) {
  Row row(1);
  const auto computed = [&row](int stop) {
    Runner runner = row.begin();
    runner.state.motion[20].pose.position.z() -= 0.2;
    for (int i = 0; i < 40; ++i) {
      if (i == stop) {
        update_file(runner, true);
        Runner next = resume_run(row.scene, row.options, {}, runner.file, "memory");
        runner.state = next.state;
        runner.work = make_work(row.scene);
      }
      advance(runner);
    }
    return runner.state.deep[20];
  };
  const DeepBlock whole = computed(-1), resumed = computed(1);
  EXPECT_GT(whole.steps, 1);
  EXPECT_EQ(whole.steps, resumed.steps);
  EXPECT_EQ(whole.depth, resumed.depth);
  EXPECT_EQ(whole.place, resumed.place);
  EXPECT_EQ(whole.time, resumed.time);
}

}  // namespace
