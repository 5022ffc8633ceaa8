// The run registry: entries that come late.
#include <gtest/gtest.h>

#include <filesystem>

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

}  // namespace
}  // namespace talus
