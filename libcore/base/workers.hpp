// libcore/base/workers.hpp: public
// A few threads that live as long as a computation and share the loops of one thread. What they
// compute may not depend on who does what: each chunk writes what is its own alone, and the caller
// adds up in the order of the chunks. Then the bits are those of one thread.
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
  /// Chunks are begun in ascending order, so that one may wait for what a lower one does. `work`
  /// throws nothing and calls no other loop of the same Workers.
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
  // number of the loop, and how many of its chunks nobody has begun: in one word, so that who
  // comes late takes nothing of another loop
  alignas(64) std::atomic<std::uint64_t> left_ = 0;
  alignas(64) std::atomic<std::uint32_t> n_done_ = 0;
  alignas(64) std::atomic<int> n_asleep_ = 0;
  std::atomic<bool> ends_ = false;
  std::mutex mutex_;
  std::condition_variable wakes_;
  std::vector<std::thread> threads_;
};

/// Calls work(begin, end) for consecutive parts of [0, n) of `chunk` elements; in one call where
/// there are no workers, or n is below `least`.
template <class Work>
void in_chunks(Workers* workers, std::size_t n, std::size_t chunk, std::size_t least,
               const Work& work) {
  if (workers == nullptr || n < least || n <= chunk) return work(std::size_t{0}, n);
  workers->run(static_cast<std::uint32_t>((n + chunk - 1) / chunk), [&](std::uint32_t i) {
    const std::size_t begin = i * chunk;
    work(begin, std::min(begin + chunk, n));
  });
}

/// Tells the processor that this thread waits for another one.
void wait_a_moment(int n_waited);

/// Threads that a computation may take when nobody says how many: those of a Slurm task; one inside
/// a make that runs several jobs; else all that the machine gives this process.
[[nodiscard]] int threads_by_default();

}  // namespace talus
