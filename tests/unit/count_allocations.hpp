// tests/unit/count_allocations.hpp
// Counts calls of operator new by an executable, for tests that a step allocates nothing. It
// replaces the operators: one source of an executable may include it.
#pragma once

#include <atomic>
#include <cstdlib>
#include <new>

// The thread sanitizer has operators of its own, which cannot be replaced.
#if defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define TALUS_COUNTS_ALLOCATIONS 0
#endif
#endif
#ifndef TALUS_COUNTS_ALLOCATIONS
#define TALUS_COUNTS_ALLOCATIONS 1
#endif

namespace talus::test {

inline constexpr bool counts_allocations = TALUS_COUNTS_ALLOCATIONS;
inline std::atomic<long> n_allocations = 0;

}  // namespace talus::test

#if TALUS_COUNTS_ALLOCATIONS
// Not inlined, or the compiler sees half of the pair, malloc meets delete, and it warns.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++talus::test::n_allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  ++talus::test::n_allocations;
  return std::malloc(size);
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
#endif
