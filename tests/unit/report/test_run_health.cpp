#include <gtest/gtest.h>

#include "report/run_health.hpp"
#include "unit/report/shipped_texts.hpp"

using namespace talus;

TEST(RunHealth, ALimitKeepsTheWorstOfItsRuns) {
  std::vector<LimitOverRuns> limits;
  add_limits({{"penetration_m", 0.1, 0.5, true}}, limits);
  add_limits({{"penetration_m", 0.7, 0.5, false}, {"lost", 0, 0, true}}, limits);
  add_limits({{"penetration_m", 0.2, 0.5, true}}, limits);
  ASSERT_EQ(limits.size(), 2u);
  EXPECT_EQ(limits[0].worst, 0.7);
  EXPECT_EQ(limits[0].n_failed, 1);
  EXPECT_EQ(limits[1].n_failed, 0);
  EXPECT_NE(
      limit_table(talus::testing::shipped_texts(), limits, 3).find("<td class=\"n\">1 of 3</td>"),
      std::string::npos);
}

TEST(RunHealth, PassesWhenAllRunsAreDoneWithinTheirLimits) {
  std::vector<RunFile> runs(2);
  runs[0].info.status = runs[1].info.status = "done";
  EXPECT_TRUE(all_pass(runs, {}));
  EXPECT_FALSE(all_pass(runs, {{"penetration_m", 0.7, 0.5, 1}}));
  runs[1].info.status = "running";
  EXPECT_FALSE(all_pass(runs, {}));
}

// Steps add up over the intervals; the shortest one is that of the steps that searched contacts.
TEST(RunHealth, CountersAreThoseOfTheWholeRun) {
  RunFile run;
  run.health.resize(3);
  for (HealthRow& row : run.health) row.steps = 100;
  run.health[0].shortest_dt = 0.002;
  run.health[1].shortest_dt = 0.001;
  const std::string table = counter_table(talus::testing::shipped_texts(), {run}, {"CASE_1"});
  EXPECT_NE(table.find("<td>CASE_1</td>"), std::string::npos);
  EXPECT_NE(table.find("<td class=\"n\">300</td><td class=\"n\">0.001</td>"), std::string::npos);
}

TEST(RunHealth, CutsAreSummedByReason) {
  RunFile run;
  run.health.resize(2);
  EXPECT_EQ(cut_table(talus::testing::shipped_texts(), {run}, {"CASE_1"}), "");
  const auto deep = static_cast<std::size_t>(SubstepCut::deep);
  run.health[0].cuts[deep] = 3;
  run.health[1].cuts[deep] = 4;
  const std::string table = cut_table(talus::testing::shipped_texts(), {run}, {"CASE_1"});
  EXPECT_NE(table.find("bond_broken"), std::string::npos);
  EXPECT_NE(table.find("<td class=\"n\">7</td><td class=\"n\">0</td>"), std::string::npos);
}

TEST(RunHealth, BlocksThatWereDeepAreNamedWithTheirPlaceOnTheMap) {
  std::vector<RunFile> runs(2);
  EXPECT_EQ(deep_table(talus::testing::shipped_texts(), runs, {"1", "2"}), "");
  runs[1].info.origin = {500000, 5000000, 0};
  DeepRow row;
  row.block = 43;
  row.depth = 0.185;
  row.place = {12.5, 7, 900};
  row.met_fence = 1;
  runs[1].deep = {row};
  const std::string table = deep_table(talus::testing::shipped_texts(), runs, {"1", "2"});
  EXPECT_NE(table.find("<td>the ground</td><td class=\"n\">0.185</td>"), std::string::npos);
  EXPECT_NE(table.find("500012.5"), std::string::npos);
  EXPECT_NE(table.find("met a fence"), std::string::npos);
}
