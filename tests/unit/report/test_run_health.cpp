// The health of runs on the page.
#include <gtest/gtest.h>

#include "report/run_health.hpp"

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
  EXPECT_EQ(
      csv_of(limit_fields(), limits),
      "limit,worst,largest,n_failed,verdict\npenetration_m,0.7,0.5,1,fail\nlost,0,0,0,pass\n");
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
  const std::vector<RunFile> runs = {run};
  const std::vector<std::string> names = {"CASE_1"};
  const std::vector<RunHealth> health = health_of(runs, names);
  EXPECT_EQ(csv_row(values_of(counter_fields(), health[0])),
            "CASE_1,running,0,0,300,0.001,0,0,0,0\n");
}

TEST(RunHealth, CutsAreSummedByReason) {
  RunFile run;
  run.health.resize(2);
  const auto deep = static_cast<std::size_t>(SubstepCut::deep);
  run.health[0].cuts[deep] = 3;
  run.health[1].cuts[deep] = 4;
  const std::vector<RunFile> runs = {run};
  const std::vector<std::string> names = {"CASE_1"};
  EXPECT_EQ(csv_of(cut_fields(), health_of(runs, names)),
            "run,yielding_touched,unconverged,deep,hit,inaccurate,bond_broken,woken,"
            "yielding_used_up\nCASE_1,0,0,7,0,0,0,0,0\n");
}

TEST(RunHealth, BlocksThatWereDeepAreNamedWithTheirPlaceOnTheMap) {
  std::vector<RunFile> runs(2);
  const std::vector<std::string> names = {"1", "2"};
  EXPECT_TRUE(deep_of_runs(runs, names).empty());
  runs[1].info.origin = {500000, 5000000, 0};
  DeepRow row;
  row.block = 43;
  row.depth = 0.185;
  row.place = {12.5, 7, 900};
  row.met_fence = 1;
  runs[1].deep = {row};
  EXPECT_EQ(csv_row(values_of(deep_fields(), deep_of_runs(runs, names).at(0))),
            "2,43,the ground,0.185,0,0,0,500013,5000007,900,0,,yes,\n");
}
