// libcore/post/hazard/frequency.hpp: public
// Frequency of the simulated events.
// in:    [hazard] and [hazard.class.*] of the site file
// out:   a frequency a class, or the probability of a single failure, with bounds
//
// Events that were counted have the frequency of Jeffreys' posterior, Gamma(k + 1/2, T): its mean,
// and its 5 and 95 % as bounds. A frequency that is given is taken as exact.
#pragma once

#include <string>
#include <vector>

#include "site/site.hpp"

namespace talus {

/// Events a year; also frequency times share at a cell.
struct Rate {
  double value = 0, low = 0, high = 0;  ///< [1/a]
};

/// The x that a Gamma variable of `shape` > 0 and rate 1 stays below with probability p, 0 < p < 1;
/// to 1e-10 of x.
[[nodiscard]] double gamma_quantile(double shape, double p);

/// Of k events in `years`.
[[nodiscard]] Rate rate_of_events(double events, double years);

enum class FrequencyKind {
  of_events,   ///< of the whole class
  of_failure,  ///< of the one failure that may come
  of_weights,  ///< each block is a source of its own, with its weight as its frequency
};

/// A class of volumes.
struct HazardClass {
  std::string name;
  FrequencyKind kind = FrequencyKind::of_events;
  /// An event is a rock, not a run; known from the runs (hazard_runs).
  bool of_rocks = false;
  Rate frequency;                     ///< of_events; of_weights: of all blocks of a run together
  double probability = 0, years = 0;  ///< of_failure: within so many years [a]
};

/// The classes of a site, none where it has none. One that says nothing takes the frequencies of
/// [rockfall.*]. Throws InputError where there are none either, for a class with several, for
/// failures beside frequencies or within different numbers of years, and where release points and
/// all classes have frequencies.
[[nodiscard]] std::vector<HazardClass> hazard_classes(const Site& site);

/// The class of number `index`; "all", without a frequency, where there are none.
[[nodiscard]] inline HazardClass class_at(const std::vector<HazardClass>& classes,
                                          std::size_t index) {
  if (!classes.empty()) return classes[index];
  HazardClass all;
  all.name = "all";
  return all;
}

/// Remedy where a class and its sources both have a frequency.
inline constexpr const char* two_frequencies_hint =
    "without one of its own, the class counts each source by its frequency; or take the frequency "
    "out of [rockfall.*]: that of the class is then of all its sources together";

/// "0.0233 a year (90 % within 0.0072 - 0.0471)", "0.28 rocks a year"
[[nodiscard]] std::string rate_words(const HazardClass& kind);

/// A year of a constant danger that adds up to `probability` within `years` [1/a].
[[nodiscard]] double equivalent_rate(double probability, double years);

}  // namespace talus
