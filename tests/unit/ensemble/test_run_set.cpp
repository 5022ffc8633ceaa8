// Runs evaluated together: weights, agreement, faults.
#include <gtest/gtest.h>

#include "base/error.hpp"
#include "ensemble/run_set.hpp"
#include "ensemble/run_tags.hpp"

using namespace talus;

namespace {

RunMember member(const std::string& file, std::int64_t seed, const std::string& status,
                 const std::string& reason = "", const std::string& case_name = "") {
  RunMember run;
  run.file = file;
  run.info.run_id = "id" + std::to_string(seed);
  run.info.seed = seed;
  run.info.status = status;
  run.info.reason = reason;
  run.info.case_name = case_name;
  run.info.duration = 60;
  run.info.time = status == "running" ? 12.5 : 60;
  return run;
}

std::string tag(const std::vector<RunMember>& runs, const std::string& name) {
  for (const auto& [key, value] : tags_of(runs))
    if (key == name) return value;
  return "";
}

}  // namespace

TEST(RunFaults, NameTheRunsThatFailedWithLimitAndValue) {
  const std::vector<RunMember> runs = {
      member("out/runs/run_10.h5", 10, "failed", "largest penetration [m] is 0.2, limit 0.1"),
      member("out/runs/run_2.h5", 2, "done")};
  const RunFaults faults = faults_of(runs);
  EXPECT_EQ(headline(faults), "1 of 2 runs failed its numerical checks");
  EXPECT_EQ(text(faults),
            "1 of 2 runs failed its numerical checks: run_10 (largest penetration [m] is 0.2, "
            "limit 0.1)");
  EXPECT_EQ(tag(runs, "HEALTH"), text(faults));
  EXPECT_EQ(tag(runs, "N_FAILED"), "1");
}

TEST(RunFaults, AreNoneWhereAllRunsFinished) {
  const std::vector<RunMember> runs = {member("run_1.h5", 1, "done")};
  EXPECT_EQ(headline(faults_of(runs)), "");
  EXPECT_EQ(text(faults_of(runs)), "");
  EXPECT_EQ(tag(runs, "HEALTH"), "all runs finished within their limits");
}

// The order of the command line says nothing; seeds do, run_2 before run_10. Seven are not listed.
TEST(RunFaults, AreListedBySeedAndOnlyTheFirstFive) {
  std::vector<RunMember> runs;
  for (const int seed : {10, 2, 7, 3, 5, 4, 6})
    runs.push_back(member("run_" + std::to_string(seed) + ".h5", seed, "failed", "x"));
  const std::string words = text(faults_of(runs));
  EXPECT_EQ(
      words,
      "7 of 7 runs failed their numerical checks: run_2 (x), run_3 (x), run_4 (x), run_5 (x), "
      "run_6 (x) and 2 more");
  std::reverse(runs.begin(), runs.end());
  EXPECT_EQ(text(faults_of(runs)), words);
}

TEST(NamesOf, TellRunsOfTwoFoldersApart) {
  const std::vector<RunMember> runs = {member("out/runs/run_1.h5", 1, "done"),
                                       member("out/without/run_1.h5", 1, "done"),
                                       member("out/runs/run_2.h5", 2, "done")};
  const std::vector<std::string> expected = {"runs/run_1", "without/run_1", "run_2"};
  EXPECT_EQ(names_of(runs), expected);
}

// A run that a broken limit stopped is evaluated, one that was interrupted is not.
TEST(CheckMember, TakesFailedRunsAndRefusesInterruptedOnes) {
  RunMember stopped = member("run_1.h5", 1, "failed", "x is 2, limit 1");
  stopped.info.time = 3.5;
  EXPECT_NO_THROW(check_member(stopped, stopped, {"trn.tif", ""}));
  EXPECT_EQ(text(faults_of({stopped})),
            "1 of 1 run failed its numerical checks: run_1 (x is 2, limit 1; ended at 3.5 of 60 "
            "s)");
  const RunMember running = member("run_1.h5", 1, "running");
  EXPECT_THROW(check_member(running, running, {"trn.tif", ""}), InputError);
}

// Their seeds draw nothing: three runs are one, and intervals know it. Draws by a seed make a trial
// of its own, whatever the result.
TEST(RunSet, RunsThatAreTheSameButForTheirSeedCountOnce) {
  RunFile file;
  file.info.config = "[solver]\nseed = 1  # cli\nduration_s = 6  # default\n";
  file.info.seed_draws = false;
  const RunMember first = member_of("run_1.h5", file);
  file.info.config = "[solver]\nseed = 2  # cli\nduration_s = 6  # default\n";
  file.info.run_id = "b";
  const RunMember second = member_of("run_2.h5", file);
  file.info.run_id = "c";
  const RunMember third = member_of("run_3.h5", file);
  EXPECT_EQ(n_repeats({first, second, third}), 2);
  EXPECT_EQ(units_of(std::vector<RunMember>{first, second, third}), (std::vector<int>{0, 0, 0}));
  EXPECT_EQ(repeats_text({first, second, third}),
            "2 of 3 runs repeat another one: their seeds draw nothing");
  EXPECT_EQ(tag({first, second, third}, "N_REPEATS"), "2");
  file.info.case_name = "far";
  const RunMember other = member_of("far/run_2.h5", file);
  EXPECT_EQ(units_of(std::vector<RunMember>{second, other, first}), (std::vector<int>{0, 1, 0}));
  EXPECT_EQ(repeats_text({first, other}), "");
  EXPECT_TRUE(units_of(std::vector<RunMember>{second, other}).empty());
  file.info.seed_draws = true;
  EXPECT_EQ(n_repeats({member_of("run_1.h5", file), member_of("run_2.h5", file)}), 0);
}

// Beds of rock masses differ; the terrain that they were cut from does not.
TEST(RunSet, RunsOfSeveralRockMassesBelongTogetherOnTheTerrainBefore) {
  RunMember first;
  first.info.status = "done";
  first.info.trn_sha256 = "bed 1";
  first.info.terrain_digest = "ground";
  first.info.blocks_hash = "blocks 1";
  RunMember second = first;
  second.info.trn_sha256 = "bed 2";
  second.info.blocks_hash = "blocks 2";
  EXPECT_NO_THROW(check_member(second, first, {"trn.tif", "sha of trn.tif", "ground"}));
  EXPECT_THROW(check_member(second, first, {"bed_1.tif", "bed 1", "digest of bed 1"}), InputError);
  EXPECT_THROW(check_member(second, first, {"other.tif", "sha", "other"}), InputError);
  EXPECT_EQ(units_of(std::vector<RunMember>{first, second, first}), (std::vector<int>{0, 1, 0}));
  EXPECT_TRUE(
      units_of(std::vector<RunMember>{first, second}).empty());  // each has a mass of its own
  EXPECT_TRUE(units_of(std::vector<RunMember>{first, first})
                  .empty());  // one mass: no message on further ones
  RunMember plain = first;
  plain.info.terrain_digest.clear();
  RunMember other = plain;
  other.info.blocks_hash = "blocks 2";
  EXPECT_TRUE(units_of(std::vector<RunMember>{plain, other, plain}).empty());
}

// Cases of 1 and 3 runs that shall count 1 : 1: the lone run counts for three of the second case.
TEST(CaseWeights, MakeRunsCountSoThatCasesHaveTheirShares) {
  const std::vector<RunMember> runs = {
      member("high/run_1.h5", 1, "done", "", "high"), member("low/run_1.h5", 2, "done", "", "low"),
      member("low/run_2.h5", 3, "done", "", "low"), member("low/run_3.h5", 4, "done", "", "low")};
  const std::vector<CaseWeight> cases = cases_of(runs, {{"low", 2}, {"high", 2}});
  const std::vector<double> weights = run_weights(runs, cases);
  EXPECT_EQ(text(cases), "high 0.5 (1 run), low 0.5 (3 runs)");
  EXPECT_DOUBLE_EQ(weights[0], 2);
  for (int k = 1; k < 4; ++k) EXPECT_DOUBLE_EQ(weights[k], 2.0 / 3);
  const std::vector<double> alike = run_weights(runs, cases_of(runs, {}));
  for (const double weight : alike) EXPECT_DOUBLE_EQ(weight, 1);
  EXPECT_EQ(tag(runs, "CASES"), "high 0.25 (1 run), low 0.75 (3 runs)");
}

TEST(CaseWeights, AreOfEachCaseAndOfNoOther) {
  const std::vector<RunMember> runs = {member("high/run_1.h5", 1, "done", "", "high"),
                                       member("low/run_1.h5", 2, "done", "", "low")};
  EXPECT_THROW((void)cases_of(runs, {{"low", 1}}), InputError);
  EXPECT_THROW((void)cases_of(runs, {{"low", 1}, {"high", 1}, {"mid", 1}}), InputError);
}
