// libcore/base/hash_random.hpp: public
// Random numbers that depend only on a few whole numbers (a seed, a cell, an index), not on earlier
// draws: a place draws the same number in whatever order places are asked. The generator is
// splitmix64 (Steele, Lea and Flood 2014), the distributions are written out as in base/random.hpp.
#pragma once

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <numbers>
#include <string_view>

namespace talus {

class HashRandom {
 public:
  explicit HashRandom(std::initializer_list<std::uint64_t> words) {
    for (const std::uint64_t word : words) state_ = mixed(state_ ^ mixed(word + step));
  }

  [[nodiscard]] std::uint64_t next() { return mixed(state_ += step); }
  /// In [0, 1), 53 bits.
  [[nodiscard]] double uniform() { return static_cast<double>(next() >> 11) * 0x1p-53; }
  /// Mean 0, standard deviation 1 (Box-Muller).
  [[nodiscard]] double normal() {
    const double radius = std::sqrt(-2 * std::log(1 - uniform()));
    return radius * std::cos(2 * std::numbers::pi * uniform());
  }
  /// Mean 1.
  [[nodiscard]] double exponential() { return -std::log(1 - uniform()); }
  /// Poisson distributed; its time grows with the mean.
  [[nodiscard]] int poisson(double mean) {
    int n = 0;
    for (double sum = exponential(); sum < mean; sum += exponential()) ++n;
    return n;
  }
  /// Gamma distributed with this shape, > 0, and scale 1 (Marsaglia and Tsang 2000).
  [[nodiscard]] double gamma(double shape) {
    if (shape < 1) {
      const double power = std::pow(1 - uniform(), 1 / shape);
      return power * gamma(shape + 1);
    }
    const double d = shape - 1.0 / 3, c = 1 / std::sqrt(9 * d);
    for (;;) {
      const double x = normal(), v = std::pow(1 + c * x, 3);
      if (v > 0 && std::log(1 - uniform()) < x * x / 2 + d * (1 - v + std::log(v))) return d * v;
    }
  }

  /// A word for a name.
  [[nodiscard]] static std::uint64_t word_of(std::string_view name) {
    std::uint64_t hash = 14695981039346656037ULL;  // FNV-1a
    for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
    return hash;
  }

 private:
  static constexpr std::uint64_t step = 0x9e3779b97f4a7c15ULL;
  static std::uint64_t mixed(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
  }
  std::uint64_t state_ = 0;
};

}  // namespace talus
