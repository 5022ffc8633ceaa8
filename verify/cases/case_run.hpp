// verify/cases/case_run.hpp
// Moves the scene of a case on and counts the reports of its steps; finds where something begins.
// in:    a Scene
// out:   a CaseResult, complete once finish() has its error
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/processor_time.hpp"
#include "base/units.hpp"
#include "motion/rotation.hpp"
#include "run/law.hpp"
#include "verify/cases/closed_form.hpp"

namespace talus::cases {

inline constexpr double g = 10;  // [m/s2]

/// Least time to read the processor's clock: not part of a case, some of which take a few
/// microseconds [s].
inline double clock_seconds() {
  static const double seconds = [] {
    double least = 1;
    for (int i = 0; i < 100; ++i) {
      const double begin = processor_seconds();
      least = std::min(least, processor_seconds() - begin);
    }
    return least;
  }();
  return seconds;
}

/// A scene moved by law talus, or by law paper where `paper` has its settings, and the sums that a
/// case reports of it.
struct Run {
  Scene scene;
  double clock = clock_seconds();      ///< [s]
  double begin = processor_seconds();  ///< before the start, after the set-up of the scene [s]
  RunLaw law;
  Work work;
  State state;
  CaseResult result;

  Run(Scene s, const std::optional<PaperSettings>& paper)
      : scene(std::move(s)),
        law(law_of(paper)),
        work(make_work(scene)),
        state(start_by(law, scene, work)) {}

  StepReport advance() {
    const StepReport report = step_by(law, scene, state, work);
    ++result.steps;
    result.passes += report.passes;
    result.unconverged += report.n_unconverged;
    result.largest_penetration = std::max(result.largest_penetration, report.largest_penetration);
    result.flags = result.flags | report.flags;
    return report;
  }
  void advance_to(double time) {
    while (state.time < time - scene.settings.dt / 2) advance();
  }
  /// Of block b, now.
  [[nodiscard]] Motion motion(int b = 0) const { return motion_at(scene, state, b, state.time); }
  /// Of the first block [rad/s].
  [[nodiscard]] Vec3 spin(const Motion& m) const {
    return angular_velocity(m.pose.attitude, m.angular_momentum, scene.blocks.inertia[0]);
  }
  /// Counts and times so far.
  [[nodiscard]] CaseResult counted() const {
    CaseResult counts = result;
    counts.cpu = std::max(0.0, processor_seconds() - begin - clock - counts.reference_cpu);
    return counts;
  }
  [[nodiscard]] CaseResult finish(double value, double expected, double error) const {
    CaseResult outcome = counted();
    outcome.value = value;
    outcome.expected = expected;
    outcome.error = error;
    return outcome;
  }
};

/// Adds the counts of `one` to `total`; value, expected and error stay.
inline void add_counts(const CaseResult& one, CaseResult& total) {
  total.steps += one.steps;
  total.passes += one.passes;
  total.unconverged += one.unconverged;
  total.cpu += one.cpu;
  total.reference_cpu += one.reference_cpu;
  total.largest_penetration = std::max(total.largest_penetration, one.largest_penetration);
  total.flags = total.flags | one.flags;
}

/// Where `happens(x)` turns from false to true between low and high, after n halvings.
template <class Happens>
double bisect(double low, double high, int n, const Happens& happens) {
  for (int i = 0; i < n; ++i) {
    const double middle = (low + high) / 2;
    (happens(middle) ? high : low) = middle;
  }
  return (low + high) / 2;
}

/// `compute()`, its CPU time noted as not the engine's.
template <class Compute>
auto timed_reference(CaseResult& result, const Compute& compute) {
  const double begin = processor_seconds();
  const auto value = compute();
  result.reference_cpu += processor_seconds() - begin;
  return value;
}

}  // namespace talus::cases
