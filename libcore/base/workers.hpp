// libcore/base/workers.hpp: public
// A few threads that live as long as a computation and share the loops of one thread. Results may
// not depend on which thread runs a chunk: each chunk writes only its own data, and the caller adds
// up in the order of the chunks. Then the bits are those of one thread.
#pragma once

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <thread>
#include <vector>

namespace talus {

class Workers {
 public:
  /// `n_threads`, the caller's among them, > 0.
  explicit Workers(int n_threads);
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  [[nodiscard]] int n_threads() const { return static_cast<int>(threads_.size()) + 1; }

  /// Calls work(chunk) for each chunk in [0, n_chunks), in this thread too, and waits for all.
  /// Chunks are begun in ascending order, so that one may wait for a lower one. `work` throws
  /// nothing and calls no other loop of the same Workers.
  template <class Work>
  void run(std::uint32_t n_chunks, const Work& work) {
    run({[](const void* of, std::uint32_t chunk) { (*static_cast<const Work*>(of))(chunk); }, &work,
         n_chunks});
  }

 private:
  struct Loop {
    void (*call)(const void*, std::uint32_t) = nullptr;
    const void* work = nullptr;
    std::uint32_t n_chunks = 0;
  };
  void run(const Loop& loop);
  bool take_chunk();
  void serve();

  Loop loop_;
  // number of the loop, and how many of its chunks are not begun: in one word, so that a late
  // thread takes no chunk of another loop
  alignas(64) std::atomic<std::uint64_t> left_ = 0;
  alignas(64) std::atomic<std::uint32_t> n_done_ = 0;
  alignas(64) std::atomic<int> n_asleep_ = 0;
  std::atomic<bool> ends_ = false;
  std::mutex mutex_;
  std::condition_variable wakes_;
  std::vector<std::thread> threads_;
};

/// Elements of a chunk, and the most parts of a loop whose parts fill each a buffer of their own.
inline constexpr std::size_t chunk_size = 16, most_parts = 64;

/// Whether threads share a loop over n elements. Of fewer they wait more than they spare.
[[nodiscard]] inline bool are_shared(const Workers* workers, std::size_t n) {
  return workers != nullptr && n >= 64;
}

/// Calls work(begin, end) for consecutive chunks of [0, n); in one call where they are not shared.
template <class Work>
void in_chunks(Workers* workers, std::size_t n, const Work& work) {
  if (!are_shared(workers, n)) return work(std::size_t{0}, n);
  workers->run(static_cast<std::uint32_t>((n + chunk_size - 1) / chunk_size),
               [&](std::uint32_t i) { work(i * chunk_size, std::min((i + 1) * chunk_size, n)); });
}

/// Elements of each part of [0, n) but the last, and the number of parts: one where they are not
/// shared.
[[nodiscard]] inline std::size_t part_size(const Workers* workers, std::size_t n) {
  return n / (are_shared(workers, n) ? most_parts : 1) + 1;
}
[[nodiscard]] inline std::size_t n_parts(const Workers* workers, std::size_t n) {
  return n / part_size(workers, n) + 1;
}

/// Calls work(part, begin, end) for the parts of [0, n).
template <class Work>
void in_parts(Workers* workers, std::size_t n, const Work& work) {
  const std::size_t size = part_size(workers, n);
  const auto call = [&](std::size_t i) {
    work(i, std::min(i * size, n), std::min((i + 1) * size, n));
  };
  if (!are_shared(workers, n)) return call(0);
  workers->run(static_cast<std::uint32_t>(n_parts(workers, n)), call);
}

/// Tells the processor that this thread waits for another one.
void wait_a_moment(int n_waited);

/// Default number of threads of a computation: those of a Slurm task; one inside a make that runs
/// several jobs; else all that the machine gives this process.
[[nodiscard]] int threads_by_default();

}  // namespace talus
