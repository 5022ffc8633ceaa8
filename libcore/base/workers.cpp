// Threads that share the chunks of a loop: taking chunks, waiting, sleeping and waking.
#include "base/workers.hpp"

#include <cstdlib>
#include <string>

namespace talus {
namespace {

constexpr int n_waits_alone = 500;    // before a waiting thread yields
constexpr int n_waits_awake = 2'000;  // of at most a microsecond each; then it sleeps

constexpr std::uint64_t chunks_of(std::uint64_t left) { return left & 0xFFFF'FFFFu; }

}  // namespace

void wait_a_moment(int n_waited) {
  if (n_waited > n_waits_alone) return std::this_thread::yield();
#if defined(__x86_64__)
  __builtin_ia32_pause();
#endif
}

Workers::Workers(int n_threads) {
  for (int i = 1; i < n_threads; ++i) threads_.emplace_back([this] { serve(); });
}

Workers::~Workers() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  wakes_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void Workers::run(const Loop& loop) {
  if (loop.n_chunks == 0) return;
  loop_ = loop;
  n_done_.store(0, std::memory_order_relaxed);
  const std::uint64_t number = (left_.load(std::memory_order_relaxed) >> 32) + 1;
  left_.store(number << 32 | loop.n_chunks);
  if (n_asleep_ > 0) {
    { const std::lock_guard lock(mutex_); }  // a thread about to sleep does so first
    wakes_.notify_all();
  }
  while (take_chunk()) {
  }
  for (int n = 0; n_done_.load(std::memory_order_acquire) != loop.n_chunks; ++n) wait_a_moment(n);
}

// False when no chunk is left.
bool Workers::take_chunk() {
  std::uint64_t left = left_.load(std::memory_order_acquire);
  do
    if (chunks_of(left) == 0) return false;
  while (!left_.compare_exchange_weak(left, left - 1, std::memory_order_acq_rel,
                                      std::memory_order_acquire));
  // from here on the loop cannot end without this chunk
  loop_.call(loop_.work, loop_.n_chunks - static_cast<std::uint32_t>(chunks_of(left)));
  n_done_.fetch_add(1, std::memory_order_release);
  return true;
}

void Workers::serve() {
  while (!ends_) {
    for (int n = 0; n < n_waits_awake; ++n) {
      if (take_chunk()) n = 0;
      wait_a_moment(n);
    }
    std::unique_lock lock(mutex_);
    ++n_asleep_;
    wakes_.wait(lock, [this] { return ends_ || chunks_of(left_) > 0; });
    --n_asleep_;
  }
}

int threads_by_default() {
  const auto value_of = [](const char* name) {
    const char* value = std::getenv(name);
    return std::string(value == nullptr ? "" : value);
  };
  if (!value_of("SLURM_JOB_ID").empty())
    return std::max(1, std::atoi(value_of("SLURM_CPUS_PER_TASK").c_str()));
  if (value_of("MAKEFLAGS").find("--jobserver") != std::string::npos) return 1;
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

}  // namespace talus
