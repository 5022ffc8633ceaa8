// ensemble.json: derived from the run files beside it, whichever process writes it or is killed
// while writing.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "base/error.hpp"
#include "base/read_file.hpp"
#include "ensemble/ensemble.hpp"

using namespace talus;
namespace fs = std::filesystem;

namespace {

// A folder of its own for each test.
struct Folder {
  std::string path;
  explicit Folder(const std::string& name) : path(testing::TempDir() + "ensemble_" + name) {
    fs::remove_all(path);
    fs::create_directories(path);
  }
  ~Folder() { fs::remove_all(path); }
  [[nodiscard]] std::string file() const { return path + "/ensemble.json"; }
};

RunFile run_of(std::int64_t seed, const std::string& case_name = "",
               const std::string& status = "done") {
  RunFile run;
  run.info.run_id = case_name + std::to_string(seed);
  run.info.seed = seed;
  run.info.case_name = case_name;
  run.info.status = status;
  run.info.reason = status == "failed" ? "largest penetration is 0.31, limit 0.1" : "";
  run.info.config = "[ground.slope]\nfriction_deg = " +
                    std::string(case_name == "low" ? "24  # cli\n" : "30  # file, line 7\n");
  run.info.plan = "{}";
  run.frames.time = {0};
  return run;
}

void put(const Folder& folder, const std::string& name, const RunFile& run) {
  fs::create_directories(fs::path(folder.path + "/" + name).parent_path());
  replace_run_file(folder.path + "/" + name, run);
}

// The runs of seeds 1 to n, wanted.
Ensemble plan_of(const Folder& folder, int n) {
  Ensemble plan;
  plan.folder = folder.path;
  plan.is_planned = true;
  for (int seed = 1; seed <= n; ++seed) {
    plan.members.emplace_back();
    plan.members.back().file = "run_" + std::to_string(seed) + ".h5";
    plan.members.back().seed = seed;
  }
  return plan;
}

}  // namespace

TEST(Ensemble, SaysWhatBecameOfEachRunThatIsWanted) {
  const Folder folder("outcomes");
  put(folder, "run_1.h5", run_of(1));
  put(folder, "run_2.h5", run_of(2, "", "failed"));
  put(folder, "run_9.h5", run_of(9));  // of an earlier plan
  Ensemble plan = plan_of(folder, 4);
  plan.members[2].outcome = Outcome::no_result;
  plan.members[2].why = "killed by signal 9";
  write_ensemble(plan);
  const Ensemble read = read_ensemble(folder.path);
  ASSERT_EQ(read.members.size(), 4u);
  EXPECT_EQ(read.members[0].outcome, Outcome::done);
  EXPECT_EQ(read.members[0].digest.size(), 64u);
  EXPECT_EQ(read.members[1].outcome, Outcome::failed_checks);
  EXPECT_EQ(read.members[1].why, "largest penetration is 0.31, limit 0.1");
  EXPECT_EQ(read.members[2].why, "killed by signal 9");
  EXPECT_EQ(read.members[3].outcome, Outcome::not_started);
  EXPECT_EQ(n_missing(read), 2);
}

TEST(Ensemble, FollowsItsRunFiles) {
  const Folder folder("follows");
  put(folder, "run_1.h5", run_of(1));
  Ensemble plan = plan_of(folder, 2);
  write_ensemble(plan);
  const std::string first = read_file(folder.file());
  put(folder, "run_2.h5", run_of(2));
  fs::remove(folder.path + "/run_1.h5");
  const Ensemble now = read_ensemble(folder.file());
  EXPECT_EQ(now.members[0].outcome, Outcome::not_started);
  EXPECT_EQ(now.members[1].run_id, "2");
  EXPECT_NE(read_file(folder.file()), first);
  std::ofstream(folder.path + "/run_1.h5") << std::string(100, 'x');
  EXPECT_EQ(read_ensemble(folder.path).members[0].outcome, Outcome::no_result);
  fs::remove(folder.path + "/run_2.h5");
  put(folder, "run_1.h5", run_of(1));
  static_cast<void>(read_ensemble(folder.path));
  EXPECT_EQ(read_file(folder.file()), first);
}

// Without a plan, the files in the folder count: a damaged or missing one is made anew, and nothing
// is lost.
TEST(Ensemble, IsRebuiltFromAFolderOfRuns) {
  const Folder folder("rebuilt");
  put(folder, "low/run_1.h5", run_of(1, "low"));
  put(folder, "high/run_1.h5", run_of(1, "high"));
  const Ensemble made = read_ensemble(folder.path);
  ASSERT_EQ(made.members.size(), 2u);
  EXPECT_EQ(made.members[1].case_name, "low");
  EXPECT_EQ(made.differs,
            (std::vector<std::string>{"case low: ground.slope.friction_deg = 24; case high: 30"}));
  const std::string bytes = read_file(folder.file());
  std::ofstream(folder.file()) << bytes.substr(0, bytes.size() / 2);
  static_cast<void>(read_ensemble(folder.path));
  EXPECT_EQ(read_file(folder.file()), bytes);
  put(folder, "low/run_2.h5", run_of(2, "low"));
  EXPECT_EQ(read_ensemble(folder.path).members.size(), 3u);
  const Folder none("none");
  EXPECT_THROW(static_cast<void>(read_ensemble(none.path)), InputError);
}

TEST(Ensemble, WeighsCasesAndCountsUnits) {
  const Folder folder("weights");
  put(folder, "low/run_1.h5", run_of(1, "low"));
  for (const int seed : {1, 2, 3}) {
    RunFile run = run_of(seed, "high");
    run.info.seed_draws = false;
    put(folder, "high/run_" + std::to_string(seed) + ".h5", run);
  }
  Ensemble weighed = read_ensemble(folder.path);
  EXPECT_DOUBLE_EQ(weighed.members[3].weight, 1);
  weighed.cases = {{"high", 1, 0}, {"low", 1, 0}};
  write_ensemble(weighed);
  const Ensemble read = read_ensemble(folder.path);
  EXPECT_DOUBLE_EQ(read.members[0].weight, 2. / 3);
  EXPECT_DOUBLE_EQ(read.members[3].weight, 2);
  EXPECT_EQ(read.members[0].unit, read.members[2].unit);
  EXPECT_NE(read.members[0].unit, read.members[3].unit);
}

// Twenty processes add runs and write at a time, half of them are killed while they do.
TEST(Ensemble, LosesNoMemberToTwentyWritersAndKills) {
  const Folder folder("writers");
  constexpr int n_writers = 20, n_runs = 8;
  std::vector<pid_t> writers;
  for (int w = 0; w < n_writers; ++w) {
    writers.push_back(fork());
    ASSERT_GE(writers.back(), 0);
    if (writers.back() != 0) continue;
    for (int r = 0; r < n_runs; ++r) {
      const std::int64_t seed = w * n_runs + r;
      put(folder, "run_" + std::to_string(seed) + ".h5", run_of(seed));
      static_cast<void>(read_ensemble(folder.path));
    }
    _exit(0);
  }
  for (int w = 0; w < n_writers; w += 2) {
    usleep(20'000);
    kill(writers[w], SIGKILL);
  }
  int n_killed = 0;
  for (const pid_t writer : writers) {
    int status = 0;
    waitpid(writer, &status, 0);
    n_killed += WIFSIGNALED(status) ? 1 : 0;
    EXPECT_TRUE(WIFSIGNALED(status) || WEXITSTATUS(status) == 0);
  }
  EXPECT_GT(n_killed, 0);
  int n_files = 0;
  for (const auto& entry : fs::directory_iterator(folder.path))
    n_files += entry.path().extension() == ".h5" && entry.path().filename().string()[0] != '.';
  EXPECT_FALSE(stored_ensemble(folder.path).members.empty());
  const Ensemble read = read_ensemble(folder.path);
  EXPECT_EQ(count_of(read, Outcome::done), n_files);
  EXPECT_EQ(static_cast<int>(read.members.size()), n_files);
  EXPECT_GE(n_files, n_writers / 2 * n_runs);
}
