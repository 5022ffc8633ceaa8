// Threads that share a loop: each chunk once, in ascending order, bits of one thread.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <thread>
#include <vector>

#include "base/workers.hpp"

namespace {

using namespace talus;

TEST(Workers, DoEveryChunkOnce) {
  for (const int n_threads : {1, 2, 3, 8}) {
    Workers workers(n_threads);
    EXPECT_EQ(workers.n_threads(), n_threads);
    for (std::uint32_t n : {0u, 1u, 2u, 7u, 100u}) {
      std::vector<int> times(n, 0);
      for (int loop = 0; loop < 200; ++loop) workers.run(n, [&](std::uint32_t i) { ++times[i]; });
      EXPECT_EQ(times, std::vector<int>(n, 200)) << n_threads << " threads";
    }
  }
}

// A thread that slept between two loops misses none.
TEST(Workers, WakeForALoopThatComesLate) {
  Workers workers(3);
  std::vector<int> times(50, 0);
  for (int loop = 0; loop < 5; ++loop) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    workers.run(50, [&](std::uint32_t i) { ++times[i]; });
  }
  EXPECT_EQ(times, std::vector<int>(50, 5));
}

// Each chunk waits for the one before it: in any other order of beginning the loop would not end.
TEST(Workers, BeginChunksInAscendingOrder) {
  Workers workers(4);
  for (int loop = 0; loop < 100; ++loop) {
    std::atomic<std::uint32_t> next = 0;
    workers.run(40, [&](std::uint32_t i) {
      for (int n = 0; next != i; ++n) wait_a_moment(n);
      ++next;
    });
    EXPECT_EQ(next, 40u);
  }
}

TEST(Workers, ShareALoopInPartsThatCoverIt) {
  Workers workers(2);
  for (Workers* const who : {static_cast<Workers*>(nullptr), &workers})
    for (const std::size_t n : {0u, 5u, 63u, 64u, 65u, 1000u}) {
      std::vector<int> times(n, 0);
      in_chunks(who, n, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) ++times[i];
      });
      EXPECT_EQ(times, std::vector<int>(n, 1)) << n;
      std::vector<int> of_parts(n_parts(who, n), 0);
      in_parts(who, n, [&](std::size_t part, std::size_t begin, std::size_t end) {
        ++of_parts[part];
        for (std::size_t i = begin; i < end; ++i) ++times[i];
      });
      EXPECT_EQ(times, std::vector<int>(n, 2)) << n;
      EXPECT_EQ(of_parts, std::vector<int>(of_parts.size(), 1)) << n;
    }
}

TEST(Workers, AreAsManyAsTheTaskOrMakeLeaves) {
  const auto with = [](const char* job, const char* cpus, const char* flags) {
    setenv("SLURM_JOB_ID", job, 1);
    setenv("SLURM_CPUS_PER_TASK", cpus, 1);
    setenv("MAKEFLAGS", flags, 1);
    const int n = threads_by_default();
    for (const char* name : {"SLURM_JOB_ID", "SLURM_CPUS_PER_TASK", "MAKEFLAGS"}) unsetenv(name);
    return n;
  };
  EXPECT_EQ(with("17", "3", ""), 3);
  EXPECT_EQ(with("17", "", ""), 1);
  EXPECT_EQ(with("", "", " -j8 --jobserver-auth=3,4"), 1);
  EXPECT_GE(with("", "", ""), 1);
}

}  // namespace
