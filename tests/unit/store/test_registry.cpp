// The run registry: entries that come late.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>

#include "store/runs.hpp"

namespace talus {
namespace {

RunRecord run_of(int process_id) {
  RunRecord run;
  run.content_id = "0123456789abcdef";
  run.tool = "talus-dda";
  run.host = "here";
  run.process_id = process_id;
  run.started = "2026-01-02T03:04:05Z";
  run.status = "done";
  run.exit_code = 0;
  run.ended = "2026-01-02T03:14:05Z";
  run.outputs = {{"output", "/tmp/run.h5", std::string(64, 'a'), 5}};
  run.checks = {{"largest penetration, m", 0.2, 0.1, false}};
  return run;
}

class Registry : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(testing::TempDir()) /
              testing::UnitTest::GetInstance()->current_test_info()->name();
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  [[nodiscard]] std::string path(const std::string& name) const {
    return (folder_ / name).string();
  }

 private:
  std::filesystem::path folder_;
};

TEST_F(Registry, ARunThatIsOverIsAddedWhole) {
  const std::int64_t id = add_run(path("a.sqlite"), run_of(7));
  const RunRecord run = read_run(path("a.sqlite"), std::to_string(id));
  EXPECT_EQ(run.status, "done");
  EXPECT_EQ(run.ended, "2026-01-02T03:14:05Z");
  ASSERT_EQ(run.outputs.size(), 1u);
  ASSERT_EQ(run.checks.size(), 1u);
  EXPECT_FALSE(run.checks[0].pass);
}

TEST_F(Registry, AdoptingCompletesTheRowOfTheSameRunAndAddsOthers) {
  const std::int64_t begun = start_run(path("a.sqlite"), run_of(7));
  const std::int64_t another = start_run(path("a.sqlite"), run_of(8));
  add_run(path("late.sqlite"), run_of(7));
  add_run(path("late.sqlite"), run_of(9));
  EXPECT_EQ(adopt_runs(path("a.sqlite"), path("late.sqlite")), 2);
  EXPECT_EQ(list_runs(path("a.sqlite")).size(), 3u);
  EXPECT_EQ(read_run(path("a.sqlite"), std::to_string(begun)).status, "done");
  EXPECT_EQ(read_run(path("a.sqlite"), std::to_string(another)).status, "running");
  EXPECT_EQ(runs_that_wrote(path("a.sqlite"), std::string(64, 'a')).size(), 2u);
}

// Somebody removed the registry during the run: its number is another run's by now.
TEST_F(Registry, ARunWhoseRowIsGoneGetsANewOne) {
  RunRecord first = run_of(7);
  first.id = start_run(path("a.sqlite"), first);
  for (const char* end : {"", "-wal", "-shm"}) std::filesystem::remove(path("a.sqlite") + end);
  RunRecord other = run_of(8);
  other.outputs[0].sha256 = std::string(64, 'b');
  EXPECT_EQ(add_run(path("a.sqlite"), other), first.id);
  record_results(path("a.sqlite"), first);
  finish_run(path("a.sqlite"), first);
  const std::vector<RunRecord> runs = list_runs(path("a.sqlite"));
  ASSERT_EQ(runs.size(), 2u);
  EXPECT_EQ(runs[0].process_id, 8);
  EXPECT_EQ(runs[1].process_id, 7);
  EXPECT_EQ(runs[1].status, "done");
  EXPECT_EQ(read_run(path("a.sqlite"), "1").outputs[0].sha256, std::string(64, 'b'));
  EXPECT_EQ(read_run(path("a.sqlite"), "2").outputs[0].sha256, std::string(64, 'a'));
}

TEST_F(Registry, HasTheRightsThatTheUmaskLeaves) {
  const mode_t before = ::umask(0002);
  (void)start_run(path("a.sqlite"), run_of(7));
  ::umask(before);
  const auto rights = std::filesystem::status(path("a.sqlite")).permissions();
  EXPECT_NE(rights & std::filesystem::perms::group_write, std::filesystem::perms::none);
  EXPECT_EQ(rights & std::filesystem::perms::others_write, std::filesystem::perms::none);
}

// --- merging -----------------------------------------------------------------------------------

TEST_F(Registry, MergingTwiceAddsNoRunTwiceAndKeepsAllThatIsKnownOfIt) {
  add_run(path("a.sqlite"), run_of(1));
  add_run(path("b.sqlite"), run_of(2));
  add_run(path("b.sqlite"), run_of(1));
  const std::vector<std::string> others = {path("a.sqlite"), path("b.sqlite")};
  const RegistryMerge first = merge_runs(path("all.sqlite"), others);
  EXPECT_EQ(first.n_added, 2);
  EXPECT_EQ(first.n_known, 1);
  const RegistryMerge second = merge_runs(path("all.sqlite"), others);
  EXPECT_EQ(second.n_added, 0);
  EXPECT_EQ(second.n_known, 3);
  ASSERT_EQ(list_runs(path("all.sqlite")).size(), 2u);
  RunRecord merged = read_run(path("all.sqlite"), "1");
  merged.id = 0;
  EXPECT_EQ(merged, run_of(1));
}

TEST_F(Registry, ARegistryWhoseToolWasKilledBeforeItsFirstEntryAddsNothing) {
  std::ofstream(path("begun.sqlite")).close();
  add_run(path("b.sqlite"), run_of(2));
  EXPECT_EQ(merge_runs(path("all.sqlite"), {path("begun.sqlite"), path("b.sqlite")}).n_added, 1);
}

// A log of a node that died while it wrote, cut in the middle or overwritten.
TEST_F(Registry, MergingLeavesOutWhatIsDamagedAndNamesIt) {
  for (int process = 0; process < 20; ++process) add_run(path("cut.sqlite"), run_of(process));
  std::filesystem::resize_file(path("cut.sqlite"),
                               std::filesystem::file_size(path("cut.sqlite")) / 2);
  std::ofstream(path("other.sqlite")) << std::string(5000, '#');
  add_run(path("b.sqlite"), run_of(1001));
  const RegistryMerge merge =
      merge_runs(path("all.sqlite"), {path("cut.sqlite"), path("b.sqlite"), path("other.sqlite")});
  EXPECT_EQ(merge.n_added, 1);
  ASSERT_EQ(merge.left_out.size(), 2u);
  EXPECT_NE(merge.left_out[0].find("cut.sqlite"), std::string::npos);
  EXPECT_NE(merge.left_out[1].find("other.sqlite"), std::string::npos);
  EXPECT_EQ(list_runs(path("all.sqlite")).size(), 1u);
  EXPECT_THROW(merge_runs(path("all.sqlite"), {path("cut.sqlite")}), InputError);
  EXPECT_THROW(merge_runs(path("all.sqlite"), {path("b.sqlite"), path("absent.sqlite")}),
               InputError);
}

TEST_F(Registry, MergingRefusesTwoEntriesOfARunThatDifferAndThenMergesNothing) {
  RunRecord other = run_of(1);
  other.outputs[0].sha256 = std::string(64, 'b');
  add_run(path("a.sqlite"), run_of(2));
  add_run(path("a.sqlite"), run_of(1));
  add_run(path("b.sqlite"), other);
  add_run(path("all.sqlite"), run_of(3));
  EXPECT_THROW(merge_runs(path("all.sqlite"), {path("a.sqlite"), path("b.sqlite")}), InputError);
  EXPECT_EQ(list_runs(path("all.sqlite")).size(), 1u);
}

TEST_F(Registry, MergingCompletesARunThatWasGoingOnAndNotTheOtherWayRound) {
  (void)start_run(path("a.sqlite"), run_of(1));
  add_run(path("b.sqlite"), run_of(1));
  EXPECT_EQ(merge_runs(path("all.sqlite"), {path("a.sqlite")}).n_added, 1);
  EXPECT_EQ(list_runs(path("all.sqlite"))[0].status, "running");
  EXPECT_EQ(merge_runs(path("all.sqlite"), {path("b.sqlite")}).n_completed, 1);
  EXPECT_EQ(merge_runs(path("all.sqlite"), {path("a.sqlite")}).n_known, 1);
  ASSERT_EQ(list_runs(path("all.sqlite")).size(), 1u);
  EXPECT_EQ(list_runs(path("all.sqlite"))[0].status, "done");
}

TEST_F(Registry, MergedRunsStandInTheOrderOfTheirStarts) {
  RunRecord later = run_of(1), sooner = run_of(2);
  later.started = "2026-01-02T03:04:06Z";
  add_run(path("a.sqlite"), later);
  add_run(path("b.sqlite"), sooner);
  merge_runs(path("all.sqlite"), {path("a.sqlite"), path("b.sqlite")});
  EXPECT_EQ(list_runs(path("all.sqlite"))[0].process_id, 2);
}

}  // namespace
}  // namespace talus
