// libcore/base/random.hpp: public
// Seeded random numbers that are the same on every machine and compiler: std::mt19937_64 is fixed
// by the standard, the standard library's distributions are not, so they are written out here.
#pragma once

#include <cstdint>
#include <random>
#include <string_view>

namespace talus {

/// A stream of random numbers. Streams with different names or seeds are independent.
class Random {
 public:
  /// `stream` names the use of the numbers, so that adding one use does not shift another.
  explicit Random(std::uint64_t seed, std::string_view stream = {});
  double uniform();                         ///< in [0, 1), 53 bits
  double uniform(double low, double high);  ///< in [low, high)
  double normal();                          ///< mean 0, standard deviation 1 (Box-Muller)
  double exponential();                     ///< mean 1
  std::uint64_t below(std::uint64_t n);     ///< whole number in [0, n), n > 0, unbiased

 private:
  std::mt19937_64 engine_;
};

}  // namespace talus
