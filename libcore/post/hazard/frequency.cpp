// Frequency of the simulated events, from [hazard] and [hazard.class.*] of the site file.
#include "post/hazard/frequency.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "base/text.hpp"

namespace talus {
namespace {

// P(Gamma(a) <= x): the series below a + 1, the continued fraction above (Abramowitz and Stegun
// 6.5.29, 6.5.31).
double gamma_below(double a, double x) {
  if (x <= 0) return 0;
  const double front = std::exp(a * std::log(x) - x - std::lgamma(a));
  if (x < a + 1) {
    double term = 1 / a, sum = term;
    for (double n = a + 1; term > 1e-17 * sum; ++n) sum += term *= x / n;
    return front * sum;
  }
  constexpr double least = std::numeric_limits<double>::min() / 1e-16;
  double b = x + 1 - a, c = 1 / least, d = 1 / b, h = d;
  for (int i = 1; i < 10000; ++i) {
    const double an = -i * (i - a);
    b += 2;
    d = an * d + b;
    if (std::abs(d) < least) d = least;
    c = b + an / c;
    if (std::abs(c) < least) c = least;
    d = 1 / d;
    h *= d * c;
    if (std::abs(d * c - 1) < 1e-16) break;
  }
  return 1 - front * h;
}

Where where_of_class(const Site& site, const HazardClassSettings& section) {
  return {site.file, section.line, "hazard.class." + section.name};
}

bool is_given(double value) { return !std::isnan(value); }

// The pair of keys that only say something together.
void check_pair(const Where& where, const char* one, double value, const char* other,
                double other_value) {
  if (is_given(value) == is_given(other_value)) return;
  throw InputError(where,
                   std::string("has ") + (is_given(value) ? one : other) + " without " +
                       (is_given(value) ? other : one),
                   std::string("give both ") + one + " and " + other);
}

// The key of [rockfall.*] that says how often; null where none does.
const char* frequency_key(const RockfallSettings& section) {
  if (is_given(section.frequency_per_a)) return "frequency_per_a";
  return is_given(section.frequency_per_m2_a) ? "frequency_per_m2_a" : nullptr;
}

// Sources that say themselves how often rocks come.
bool any_source_says(const Site& site) {
  return std::any_of(site.rockfalls.begin(), site.rockfalls.end(),
                     [](const RockfallSettings& section) { return frequency_key(section); });
}

HazardClass class_of(const Site& site, const HazardClassSettings& s) {
  const Where where = where_of_class(site, s);
  check_pair(where, "events", s.events, "observed_a", s.observed_a);
  check_pair(where, "failure_probability", s.failure_probability, "in_years", s.in_years);
  const int n = is_given(s.frequency_per_a) + is_given(s.events) + is_given(s.failure_probability);
  if (n > 1 || (n == 0 && !any_source_says(site)))
    throw InputError(where, n == 0 ? "has no frequency" : "has more than one frequency",
                     "give one of frequency_per_a, events with observed_a, or failure_probability "
                     "with in_years; or none of them, and frequency_per_a to [rockfall.*]");
  HazardClass out;
  out.name = s.name;
  if (is_given(s.failure_probability)) {
    out.kind = FrequencyKind::of_failure;
    out.probability = s.failure_probability;
    out.years = s.in_years;
  } else if (n == 0) {
    out.kind = FrequencyKind::of_weights;
  } else if (is_given(s.events)) {
    out.frequency = rate_of_events(s.events, s.observed_a);
  } else {
    out.frequency = {s.frequency_per_a, s.frequency_per_a, s.frequency_per_a};
  }
  return out;
}

// Two classes that take the frequencies of the sources would count each rock twice, for they share
// them. One may, beside classes with a frequency: the runs tell which are of the sources. Where
// none does, sources may have no frequency.
void check_sources(const Site& site, const std::vector<HazardClass>& classes) {
  const HazardClassSettings* by_weights = nullptr;
  for (std::size_t i = 0; i < classes.size(); ++i) {
    if (classes[i].kind != FrequencyKind::of_weights) continue;
    if (by_weights)
      throw InputError(where_of_class(site, site.hazard_classes[i]),
                       "takes the frequencies of [rockfall.*], class " + by_weights->name +
                           " takes them too: each rock would count twice",
                       "keep one of the classes: alternatives of one class count by their weights");
    by_weights = &site.hazard_classes[i];
  }
  if (by_weights) return;
  for (const RockfallSettings& section : site.rockfalls) {
    const char* const key = frequency_key(section);
    if (!key || classes.empty()) continue;
    throw InputError(where_of_class(site, site.hazard_classes[0]),
                     "has a frequency, and [rockfall." + section.name + "] has " + key +
                         ": both say how often rocks come",
                     two_frequencies_hint);
  }
}

}  // namespace

double gamma_quantile(double shape, double p) {
  TALUS_ASSERT(shape > 0 && p > 0 && p < 1);
  double low = 0, high = shape + 1;
  while (gamma_below(shape, high) < p) high *= 2;
  for (int i = 0; i < 2000 && high - low > 1e-12 * high; ++i) {
    const double middle = low > 0 ? (low + high) / 2 : high / 16;
    (gamma_below(shape, middle) < p ? low : high) = middle;
  }
  return (low + high) / 2;
}

Rate rate_of_events(double events, double years) {
  const double shape = events + 0.5;
  return {shape / years, gamma_quantile(shape, 0.05) / years, gamma_quantile(shape, 0.95) / years};
}

std::vector<HazardClass> hazard_classes(const Site& site) {
  std::vector<HazardClass> classes;
  for (const HazardClassSettings& section : site.hazard_classes) {
    classes.push_back(class_of(site, section));
    const auto fails_once = [](const HazardClass& kind) {
      return kind.kind == FrequencyKind::of_failure;
    };
    if (fails_once(classes.back()) != fails_once(classes.front()))
      throw InputError(where_of_class(site, section),
                       std::string(fails_once(classes.back()) ? "may fail once" : "fails again") +
                           ", class " + classes.front().name + " does not",
                       "one map is of masses that may fail once (failure_probability), or of "
                       "sources that fail again and again (a frequency)");
    if (classes.back().years != classes.front().years)
      throw InputError(where_of_class(site, section),
                       "is of a failure within " + text(section.in_years) + " years, class " +
                           classes.front().name + " within " + text(classes.front().years),
                       "probabilities of one map need one number of years");
  }
  check_sources(site, classes);
  return classes;
}

std::string rate_words(const HazardClass& kind) {
  if (kind.kind == FrequencyKind::of_failure)
    return "fails with probability " + text(kind.probability, 4) + " in " + text(kind.years, 4) +
           " years";
  const Rate& f = kind.frequency;
  std::string out = text(f.value, 3) + (kind.of_rocks ? " rocks a year" : " a year");
  if (kind.kind == FrequencyKind::of_weights) out += ", each by its weight";
  if (f.low != f.high) out += " (90 % within " + text(f.low, 3) + " - " + text(f.high, 3) + ")";
  return out;
}

double equivalent_rate(double probability, double years) {
  return -std::log1p(-probability) / years;
}

}  // namespace talus
