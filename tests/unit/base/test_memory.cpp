// Refusals of work larger than the memory, and the memory of a machine and its control groups.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "base/memory.hpp"
#include "base/read_file.hpp"

using namespace talus;
namespace fs = std::filesystem;

namespace {

// A machine with 8 GB free and 1 GB of swap, as its kernel tells it.
struct FakeMachine {
  std::string root = (fs::temp_directory_path() / ("talus_memory_" + std::to_string(getpid())));
  FakeMachine() {
    put("/proc/meminfo",
        "MemTotal:       16000000 kB\nMemFree: 1 kB\nMemAvailable:    8000000 kB\n"
        "SwapTotal: 2000000 kB\nSwapFree:        1000000 kB\n");
  }
  ~FakeMachine() { fs::remove_all(root); }
  FakeMachine(const FakeMachine&) = delete;
  FakeMachine& operator=(const FakeMachine&) = delete;
  void put(const std::string& path, const std::string& content) const {
    fs::create_directories(fs::path(root + path).parent_path());
    std::ofstream(root + path) << content;
  }
};

// The limit of the process goes with the test.
struct Limited {
  explicit Limited(double bytes) { limit_memory(bytes); }
  ~Limited() { limit_memory(0); }
  Limited(const Limited&) = delete;
  Limited& operator=(const Limited&) = delete;
};

std::string refusal(double bytes) {
  try {
    require_memory(bytes, {"run.h5"}, "7 frames", "set a longer frame_interval_s");
  } catch (const InputError& error) {
    return std::string(error.what()) + " | " + error.hint();
  }
  return "taken";
}

}  // namespace

TEST(FreeMemory, IsWhatTheMachineHasWithItsSwap) {
  const FakeMachine machine;
  EXPECT_EQ(free_memory(machine.root), 9e6 * 1024);
  EXPECT_GT(free_memory(), 1e6);
}

TEST(FreeMemory, IsNoMoreThanTheControlGroupsLeave) {
  const FakeMachine machine;
  machine.put("/proc/self/cgroup", "0::/slurm/job_7/step_0\n");
  machine.put("/sys/fs/cgroup/slurm/job_7/step_0/memory.max", "max\n");
  EXPECT_EQ(free_memory(machine.root), 9e6 * 1024);
  machine.put("/sys/fs/cgroup/slurm/job_7/memory.max", "3000000000\n");  // of the job, above
  machine.put("/sys/fs/cgroup/slurm/job_7/memory.current", "1000000000\n");
  machine.put("/sys/fs/cgroup/slurm/job_7/memory.stat", "anon 5\ninactive_file 200000000\n");
  EXPECT_EQ(free_memory(machine.root), 2.2e9);
}

TEST(FreeMemory, KnowsTheFirstVersionOfControlGroups) {
  const FakeMachine machine;
  machine.put("/proc/self/cgroup", "5:cpu,cpuacct:/a\n4:memory:/docker/b\n");
  machine.put("/sys/fs/cgroup/memory/memory.limit_in_bytes", "9223372036854771712\n");
  machine.put("/sys/fs/cgroup/memory/memory.usage_in_bytes", "5\n");
  EXPECT_EQ(free_memory(machine.root), 9e6 * 1024);
  machine.put("/sys/fs/cgroup/memory/docker/b/memory.limit_in_bytes", "500000000\n");
  machine.put("/sys/fs/cgroup/memory/docker/b/memory.usage_in_bytes", "600000000\n");
  EXPECT_EQ(free_memory(machine.root), 0);
}

TEST(RequireMemory, RefusesWithPlaceNeedLimitAndWayOut) {
  const Limited limited(50e6);
  EXPECT_EQ(refusal(900e3), "taken");  // small pieces are not looked at
  EXPECT_EQ(refusal(20e6), "taken");
  const std::string words = refusal(123.4e6);
  EXPECT_TRUE(words.starts_with("run.h5: 7 frames need about 124 MB of memory, expected at most "))
      << words;
  EXPECT_NE(words.find(", what --memory-mb leaves | set a longer frame_interval_s, or give more "
                       "with --memory-mb"),
            std::string::npos)
      << words;
}

TEST(RequireMemory, WhatWasTakenCounts) {
  const Limited limited(60e6);
  EXPECT_EQ(refusal(40e6), "taken");
  const std::vector<char> taken(50'000'000, 1);
  EXPECT_NE(refusal(40e6), "taken");
  EXPECT_EQ(taken.back(), 1);
}

TEST(RequireMemory, CountsTheWordsOfATable) {
  std::string table;
  for (int line = 0; line < 100000; ++line) table += "1.25, -2,3\n";
  const Limited limited(14e6);  // 1.1 MB twice, 300,000 words, 100,000 lines
  EXPECT_THROW(talus::require_memory_for_words(table, "t.csv"), InputError);
  const Limited wider(20e6);
  EXPECT_NO_THROW(talus::require_memory_for_words(table, "t.csv"));
}

// A device that never ends, given as an input.
TEST(RequireMemory, EndsTheReadingOfAFileWithoutEnd) {
  const Limited limited(200e6);
  try {
    (void)talus::read_file("/dev/zero");
    FAIL() << "read";
  } catch (const InputError& error) {
    EXPECT_TRUE(std::string(error.what()).starts_with("/dev/zero: more of its bytes need about "))
        << error.what();
  }
}

TEST(RequireMemory, WithoutALimitTheMachineDecides) {
  EXPECT_EQ(refusal(2e6), "taken");
  const std::string words = refusal(1e18);
  EXPECT_NE(words.find("need about 1000000000000 MB"), std::string::npos) << words;
  EXPECT_NE(words.find("what is free on this machine"), std::string::npos) << words;
}
