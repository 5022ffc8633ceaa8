// Runs with crushed blocks: file, deposit, resuming.
#include <gtest/gtest.h>

#include "post/deposit.hpp"
#include "post/moved.hpp"
#include "run/runner.hpp"
#include "step/step.hpp"
#include "verify/cases/cases.hpp"

namespace {

using namespace talus;
using namespace talus::cases;

/// A cube of 2 m on a splinter of 0.5 m x 0.5 m x 0.1 m that can carry 0.9 times its weight.
struct Pinched {
  Pinched() {
    set.material_names = {"rock"};
    add_body(set, body_of(box(Vec3(-0.25, -0.25, 0), Vec3(0.25, 0.25, 0.1))));
    add_body(set, body_of(box(Vec3(-1, -1, 0.1), Vec3(1, 1, 2.1))));
    scene = scene_of(plane_trn(slope_frame(0, 0), 1, 30), ground_of(30), {}, {});
    add_blocks(scene, set, std::vector<Material>(1));
    scene.crush_load = {0.9 * scene.blocks.mass[1] * 10, 1e300};
    options.duration = 2;
    options.frame_interval = 0.1;
  }
  RunFile computed(int stop) {
    RunFile file;
    file.blocks = run_blocks(scene, set);
    Runner runner = begin_run(scene, options, {}, std::move(file));
    for (int i = 0; !is_over(runner); ++i) {
      if (i == stop && i > 0) {
        update_file(runner, true);
        Runner next = resume_run(scene, options, {}, runner.file, "memory");
        runner.state = next.state;
        runner.work = make_work(scene);
        runner.sampler = next.sampler;
      }
      advance(runner);
    }
    finish(runner);
    update_file(runner, false);
    return runner.file;
  }
  BlockSet set;
  Scene scene;
  RunOptions options;
};

// Crushed blocks are in the run file, count as deposit where they lie, and no mass is missing.
TEST(CrushedRun, KeepsTheDebrisInItsFileAndInTheDeposit) {
  Pinched pinched;
  const RunFile run = pinched.computed(0);
  ASSERT_EQ(run.crushed.size(), 1u);
  EXPECT_EQ(run.phase[0], Phase::crushed);
  EXPECT_EQ(fate_of(run, 0, 0.1), Fate::deposited);
  const Balance balance = balance_of(run, 0.1);
  EXPECT_EQ(balance.n_deposited, 2);
  EXPECT_NEAR(balance.deposited, 8 + 0.025, 1e-9);
  DepositSums sums;
  add_deposit(sums, run.grid, run, 0.1);
  double volume = 0;
  for (const auto& [cell, v] : sums.volume) volume += v;
  EXPECT_NEAR(volume, 8 + 0.025, 1e-6);
  EXPECT_EQ(frame_block(run, n_frames(run.frames) - 1, 0).velocity, Vec3::Zero());
  EXPECT_NEAR(moved_of(displacements(run)).mass,
              pinched.scene.blocks.mass[0] + pinched.scene.blocks.mass[1], 1e-6);
}

// The mean load is part of the state: a run stopped while it rises crushes at the same step.
TEST(CrushedRun, ResumedIsTheSameToTheBit) {
  Pinched pinched;
  const RunFile whole = pinched.computed(0);
  for (const int stop : {20, 46, 200}) {
    const RunFile resumed = pinched.computed(stop);
    ASSERT_EQ(resumed.crushed.size(), 1u) << stop;
    EXPECT_EQ(resumed.crushed[0].time, whole.crushed[0].time) << stop;
    EXPECT_EQ(resumed.crushed[0].load, whole.crushed[0].load) << stop;
    EXPECT_EQ(resumed.frames.position.back(), whole.frames.position.back()) << stop;
  }
}

}  // namespace
