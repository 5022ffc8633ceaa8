// Seeded random numbers and distributions that are the same on every machine and compiler.
#include "base/random.hpp"

#include <cmath>
#include <numbers>

#include "base/error.hpp"

namespace talus {
namespace {

// FNV-1a over the name, mixed into the seed by the finaliser of splitmix64.
std::uint64_t mix(std::uint64_t seed, std::string_view stream) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (const char c : stream) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  std::uint64_t z = seed + hash;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

}  // namespace

Random::Random(std::uint64_t seed, std::string_view stream) : engine_(mix(seed, stream)) {}

double Random::uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }

double Random::uniform(double low, double high) { return low + (high - low) * uniform(); }

double Random::normal() {
  const double radius = std::sqrt(-2 * std::log(1 - uniform()));
  return radius * std::cos(2 * std::numbers::pi * uniform());
}

double Random::exponential() { return -std::log(1 - uniform()); }

std::uint64_t Random::below(std::uint64_t n) {
  TALUS_ASSERT(n > 0);
  const std::uint64_t limit = UINT64_MAX - UINT64_MAX % n;
  std::uint64_t drawn = engine_();
  while (drawn >= limit) drawn = engine_();
  return drawn % n;
}

}  // namespace talus
