// Settings of a run: times, lengths, contradictions.
#include "setup/run_settings.hpp"
#include "setups.hpp"

namespace {

using namespace talus;
using namespace talus::test;

// The last table of site_text is [solver].
struct RunSettings : testing::Test {
  ScratchFolder folder;
  CollectedLog log;
  std::string times(const std::string& more) {
    return refusal_of([&] { check_times(site_of(folder, more)); });
  }
  std::vector<std::string> warnings(const std::string& more) {
    return warn_of_settings(log, site_of(folder, more));
  }
};

TEST_F(RunSettings, TimesThatContradictOneAnotherAreRefused) {
  EXPECT_EQ(times(""), "accepted");
  Site site = site_of(folder, "time_step_s = 1\n");
  site.solver.duration_s = 0.4;
  EXPECT_HOLDS(refusal_of([&] { check_times(site); }),
               "duration_s is 0.4, less than a time step of 1 s");
  EXPECT_HOLDS(times("[output]\nframe_interval_s = 1e-9\n"),
               "gives 8e+09 frames, expected up to 1e+07");
}

TEST_F(RunSettings, ARunOfOtherLengthThanAskedForIsSaid) {
  EXPECT_TRUE(warnings("").empty());
  EXPECT_EQ(warnings("time_step_s = 0.03\n").front(),
            "the run lasts 8.01 s, not 8 s: it is whole steps of 0.03 s");
  EXPECT_TRUE(log.has_warning("the run lasts 8.01 s"));
}

TEST_F(RunSettings, KeysThatDoNothingAreSaid) {
  const std::string fence =
      "[fence.low]\nline = [[500060, 5000010], [500060, 5000090]]\nmax_deflection_m = 2\n";
  EXPECT_EQ(warnings(fence).front(),
            "fence.low.max_deflection_m does nothing without capacity_kj: the fence is rigid");
  EXPECT_EQ(warnings("law = 'paper'\n[fence.low]\nactive = true\n").front(),
            "fences stop nothing with law paper: what crosses their lines is recorded");
  EXPECT_HOLDS(warnings("seed = 7\n").front(), "so other seeds give the same run");
  EXPECT_TRUE(warnings("seed = 7\nstart_jitter_m_s = 0.1\n").empty());
}

TEST_F(RunSettings, BlocksBreakIntoPiecesOrSayWhyNot) {
  DdaInputs inputs;
  inputs.parts.blocks = three_boxes();
  cut_fragments(log, site_of(folder, "[fragmentation]\nenabled = true\nmin_volume_m3 = 0.1\n"),
                inputs);
  EXPECT_GT(n_blocks(inputs.parts.blocks), 3);
  EXPECT_TRUE(log.has(Severity::detail, "3 blocks may break into"));
  DdaInputs small;
  small.parts.blocks = three_boxes();
  cut_fragments(log, site_of(folder, "[fragmentation]\nenabled = true\nmin_volume_m3 = 100\n"),
                small);
  EXPECT_EQ(n_blocks(small.parts.blocks), 3);
  EXPECT_HOLDS(small.warnings.front(), "3 blocks cannot break into pieces");
}

TEST_F(RunSettings, BlocksThatPassThroughEachOtherAreSaid) {
  DdaInputs inputs;
  inputs.parts.blocks = three_boxes();
  ScenePlan plan;
  warn_of_plan(log, site_of(folder), plan, inputs);
  EXPECT_HOLDS(inputs.warnings.front(), "3 blocks move as if each were alone");
  plan.block_contacts = true;
  DdaInputs together;
  together.parts.blocks = three_boxes();
  Site strained = site_of(folder);
  override_value(strained, "solver.strain", "on");
  warn_of_plan(log, strained, plan, together);
  EXPECT_HOLDS(together.warnings.front(), "computes blocks that touch each other rigid");
}

}  // namespace
