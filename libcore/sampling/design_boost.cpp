// Points of designs: sampling/design.hpp, with the direction numbers of Boost.
#include <boost/random/sobol.hpp>
#include <numeric>
#include <vector>

#include "base/error.hpp"
#include "base/hash_random.hpp"
#include "base/random.hpp"
#include "sampling/design.hpp"

namespace talus {
namespace {

constexpr double below_one = 1 - 0x1p-53;

// Never 0 and never 1.
double open_unit(std::uint64_t bits) {
  const double value = (static_cast<double>(bits >> 11) + 0.5) * 0x1p-53;
  return value < below_one ? value : below_one;
}

// Each bit is turned or not by the bits above it: Owen's scrambling, which keeps the net.
std::uint64_t scrambled(std::uint64_t bits, std::uint64_t seed, std::uint64_t word,
                        std::uint64_t dimension) {
  constexpr int n_bits = 53;
  std::uint64_t out = 0;
  for (int k = 0; k < n_bits; ++k) {
    const std::uint64_t above = k == 0 ? 0 : bits >> (64 - k);
    HashRandom random({seed, word, dimension, static_cast<std::uint64_t>(k), above});
    const std::uint64_t bit = (bits >> (63 - k)) & 1;
    out |= (bit ^ (random.next() >> 63)) << (63 - k);
  }
  HashRandom rest({seed, word, dimension, n_bits, bits});  // bits below those of the sequence
  return out | (rest.next() >> n_bits);
}

// The numbers 0 to n - 1 in an order that the words decide.
std::vector<std::uint64_t> shuffled(std::uint64_t n, std::uint64_t seed, const std::string& name) {
  std::vector<std::uint64_t> order(n);
  std::iota(order.begin(), order.end(), std::uint64_t{0});
  Random random(seed, name);
  for (std::uint64_t i = n; i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
  return order;
}

double in_hypercube(const Design& design, std::uint64_t point, int dimension,
                    const std::string& name) {
  TALUS_ASSERT(point < design.n_points);
  const std::string stream = "hypercube " + name + " " + std::to_string(dimension);
  const std::uint64_t stratum = shuffled(design.n_points, design.seed, stream)[point];
  HashRandom random({design.seed, HashRandom::word_of(stream), point});
  return (static_cast<double>(stratum) + open_unit(random.next())) /
         static_cast<double>(design.n_points);
}

}  // namespace

std::uint64_t sobol_bits(std::uint64_t point, int dimension) {
  if (point == 0) return 0;
  boost::random::sobol sequence(static_cast<std::size_t>(dimension) + 1);
  sequence.seed(point - 1);  // Boost begins with point 1
  if (dimension > 0) sequence.discard(static_cast<std::uint64_t>(dimension));
  return sequence();
}

double unit_value(const Design& design, std::uint64_t point, int dimension,
                  const std::string& name) {
  const std::uint64_t word = HashRandom::word_of(name);
  const auto axis = static_cast<std::uint64_t>(dimension);
  switch (design.sampling) {
    case Sampling::sobol:
      return open_unit(scrambled(sobol_bits(point, dimension), design.seed, word, axis));
    case Sampling::hypercube:
      return in_hypercube(design, point, dimension, name);
    case Sampling::random:
      break;
  }
  HashRandom random({design.seed, word, axis, point});
  return open_unit(random.next());
}

std::uint64_t point_of_run(const Design& design, std::uint64_t run, std::uint64_t n_masses) {
  if (n_masses < 2 || design.sampling != Sampling::sobol || run < n_masses) return run;
  const std::uint64_t round = run / n_masses;
  const std::string stream = "round " + std::to_string(round);
  return round * n_masses + shuffled(n_masses, design.seed, stream)[run % n_masses];
}

}  // namespace talus
