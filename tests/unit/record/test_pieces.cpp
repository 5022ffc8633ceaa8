// Runs with breakage: pieces in place of blocks.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "post/deposit.hpp"
#include "post/moved.hpp"
#include "record/pieces.hpp"
#include "run/runner.hpp"
#include "step/step.hpp"
#include "verify/cases/cases.hpp"

namespace {

using namespace talus;
using namespace talus::cases;

/// Blocks that are thrown down a slope of 30 degrees and break on it; a line across their path.
struct Thrown {
  Thrown() {
    set.material_names = {"rock"};
    const SlopeFrame slope = slope_frame(30, 0);
    for (int i = 0; i < 3; ++i)
      add_body(set, body_of(box_in(slope, Vec3(0, 4.0 * i, 4), Vec3(0, 0, 0), Vec3(2, 1.5, 1)),
                            Vec3(8, 0, -8), Vec3(0, 2, 0.3 * i)));
    scene = scene_of(plane_trn(slope, 2, 80), ground_of(35, 0.3), {}, {});
    scene.fragments = add_fragments(set, {});
    scene.fragmentation.energy = 3e4;
    add_blocks(scene, set, std::vector<Material>(1));
    options.duration = 4;
    options.frame_interval = 0.1;
    options.limits.max_lost_share = 1;
  }
  Runner begin() const {
    RunFile file;
    file.blocks = run_blocks(scene, set);
    return begin_run(scene, options, {record_line("low", {{15, -80, -9}, {15, 80, -9}})},
                     std::move(file));
  }
  // Stopped after this many steps, and resumed; 0: never.
  RunFile computed(int stop) const {
    Runner runner = begin();
    for (int i = 0; !is_over(runner); ++i) {
      if (i == stop && i > 0) {
        update_file(runner, true);
        Runner next = resume_run(scene, options, runner.crossings.lines, runner.file, "memory");
        runner.state = next.state;
        runner.work = make_work(scene);
        runner.passages = next.passages;
        runner.crossings = next.crossings;
        runner.sampler = next.sampler;
        runner.interval = next.interval;
        runner.energy_start = next.energy_start;
        runner.file = next.file;
      }
      advance(runner);
    }
    finish(runner);
    update_file(runner, false);
    checks = health_checks(runner);
    return runner.file;
  }
  BlockSet set;
  Scene scene;
  RunOptions options;
  mutable std::vector<HealthCheck> checks;
};

double sum(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

// Sums of maps and tables over the pieces are those of the released blocks: mass, volume, weight.
TEST(Pieces, HoldTheMassVolumeAndWeightOfTheReleasedBlocks) {
  const Thrown thrown;
  RunFile run = thrown.computed(0);
  ASSERT_GT(run.breaks.size(), 3u);
  for (const HealthCheck& check : thrown.checks) EXPECT_TRUE(check.pass) << check.name;
  merge_pieces(run);
  EXPECT_EQ(n_blocks(run), 3 + static_cast<int>(run.breaks.size()));
  EXPECT_NEAR(sum(run.blocks.volume), 9, 1e-9);
  EXPECT_NEAR(sum(run.blocks.mass), 9 * Material{}.density, 1e-6);
  EXPECT_NEAR(sum(run.blocks.weight), 3, 1e-12);
  EXPECT_EQ(run.blocks.body.size(), run.blocks.mass.size());
  const Balance balance = balance_of(run, 0.1);
  EXPECT_NEAR(balance.released, 9, 1e-9);
  EXPECT_NEAR(balance.deposited + balance.moving + balance.left, 9, 1e-9);
  EXPECT_NEAR(moved_of(displacements(run)).mass, 9 * Material{}.density, 1e-6);
}

// Before it comes off, a piece is where its block carries it: in the first frame as cut, and the
// centroid of all pieces is that of the blocks.
TEST(Pieces, RideInTheirBlockUntilTheyComeOff) {
  const Thrown thrown;
  const RunFile raw = thrown.computed(0);
  RunFile run = raw;
  merge_pieces(run);
  ASSERT_EQ(n_frames(run.frames), n_frames(raw.frames));
  for (int b = 0; b < n_blocks(run); ++b)
    EXPECT_LT((frame_block(run, 0, b).position - run.blocks.rest[b].position).norm(), 1e-6);
  double first = 1e9;
  for (const Break& broken : raw.breaks) first = std::min(first, broken.time);
  for (int k = 0; raw.frames.time[k] < first; ++k) {
    Vec3 blocks = Vec3::Zero(), pieces = Vec3::Zero();
    for (int b = 0; b < 3; ++b) blocks += raw.blocks.mass[b] * frame_block(raw, k, b).position;
    for (int b = 0; b < n_blocks(run); ++b)
      pieces += run.blocks.mass[b] * frame_block(run, k, b).position;
    EXPECT_LT((blocks - pieces).norm(), 1e-4 * run.blocks.mass[0]) << k;
  }
}

// No cell is passed by more weight than was released, and the line neither.
TEST(Pieces, PassAndCrossWithTheirShareOfTheBlock) {
  const Thrown thrown;
  RunFile run = thrown.computed(0);
  merge_pieces(run);
  std::map<int, double> weight;
  for (const Passage& row : run.passages) weight[row.cell] += run.blocks.weight[row.block];
  for (const auto& [cell, w] : weight) EXPECT_LE(w, 3 + 1e-9) << cell;
  double crossed = 0;
  ASSERT_FALSE(run.crossings.empty());
  for (const Crossing& row : run.crossings) crossed += run.blocks.weight[row.block];
  EXPECT_LE(crossed, 3 + 1e-9);
  EXPECT_TRUE(std::is_sorted(run.passages.begin(), run.passages.end(),
                             [](const Passage& a, const Passage& b) {
                               return std::pair(a.block, a.cell) < std::pair(b.block, b.cell);
                             }));
}

// A run that was stopped before, between and after breaks continues to the same bits.
TEST(Pieces, OfAResumedRunAreTheSameToTheBit) {
  const Thrown thrown;
  const RunFile whole = thrown.computed(0);
  ASSERT_GT(whole.breaks.size(), 3u);
  const int between = static_cast<int>(whole.breaks[1].time / thrown.scene.settings.dt) + 1;
  for (const int stop : {10, between, 700}) {
    const RunFile resumed = thrown.computed(stop);
    EXPECT_EQ(resumed.breaks.size(), whole.breaks.size()) << stop;
    EXPECT_EQ(resumed.frames.position, whole.frames.position) << stop;
    EXPECT_EQ(resumed.passages.size(), whole.passages.size()) << stop;
  }
}

}  // namespace
