// libcore/post/hazard/hazard_rates.hpp: public
// How often a cell is reached, and with what energy.
// in:    rows of one cell; the classes with their runs
// out:   rates of events with bounds, the energy that is exceeded once in a time
//
// An event of a mass is a run: however many blocks of it cross a cell, it is one. Where each block
// moved as if it were alone, or weights are frequencies, an event is a rock: a run is a sample of
// them, and each counts by its share of the weight. So a rate does not depend on how many rocks a
// run has. The share of events has its interval (post/share_interval.hpp), the frequency its own;
// the bounds of a rate are the products of both ends, so they include the uncertainty of each.
// Intervals are made over clusters (ensemble/clusters.hpp).
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "ensemble/run_set.hpp"
#include "post/hazard/event_rows.hpp"
#include "post/hazard/frequency.hpp"
#include "post/share_interval.hpp"

namespace talus {

/// A class of volumes and the runs that represent it: `first` to before `first` + `n`.
struct HazardRuns {
  HazardClass kind;
  ShareBasis basis;
  int first = 0, n = 0;
  double n_rocks = 0;  ///< released in all, where events are rocks
};

/// The runs of a class, members `first` to the last: the event that they sample, and how often it
/// comes. The one place that decides it, for every tool. Throws InputError where some runs moved
/// their blocks alone and some together, where both the class and the blocks have a frequency, and
/// where the class asks for weights that are none.
[[nodiscard]] HazardRuns hazard_runs(const HazardClass& kind, std::span<const RunMember> members,
                                     int first, double failed_share);

/// Of events that are runs, `n_hit` of those of the class; each run its own unit, or none hit.
[[nodiscard]] Rate rate_of(const HazardRuns& runs, int n_hit);
/// Of events without a frequency: the share of events, as a rate of 1 a year.
[[nodiscard]] Rate share_of(const HazardRuns& runs, int n_hit);
/// The same of the runs of these blocks, one block of each run by its place in the class; of rocks
/// by all that hit and their weights.
[[nodiscard]] Rate rate_of(const HazardRuns& runs, std::span<const BlockWeight> hit);
[[nodiscard]] Rate share_of(const HazardRuns& runs, std::span<const BlockWeight> hit);

/// What each event among these rows adds to the rate of its class, times the runs of the class, so
/// that post/paired.hpp compares rates [1/a]: `value` of its intensity, as a factor, 1 for the rate
/// itself. It must not fall with the intensity. `rows` of one place, sorted; `runs` must begin with
/// member 0, and not be of a mass that fails once: see adds_up().
[[nodiscard]] std::vector<BlockWeight> rate_amounts(
    const HazardRuns& runs, std::span<const EventRow> rows,
    const std::function<double(float intensity)>& value);
/// Whether the rate of a class is a sum over its events.
[[nodiscard]] bool adds_up(const HazardRuns& runs);

/// Upper bound of the rate at places that none of the runs reached [1/a].
[[nodiscard]] double largest_rate_elsewhere(std::span<const HazardRuns> classes);

class HazardRates {
 public:
  /// `classes` in the order of their runs; must outlive the calls.
  explicit HazardRates(std::span<const HazardRuns> classes);

  /// Rates of events whose intensity was above each limit; the first limit is being there at all.
  /// Events above a limit are some of those above a lower one, and so are their bounds.
  /// `rows` of one cell, sorted.                                            (n_breaks + 1)
  [[nodiscard]] std::vector<Rate> above(std::span<const EventRow> rows,
                                        std::span<const double> breaks);
  /// Shares of the events of one class, by the same method.
  [[nodiscard]] std::vector<Rate> shares_above(std::span<const EventRow> rows,
                                               std::span<const double> breaks, std::size_t kind);
  /// Blocks a year, by the same method, without bounds [1/a].
  [[nodiscard]] std::vector<double> passages_above(std::span<const EventRow> rows,
                                                   std::span<const double> breaks);
  /// The largest energy that is reached or exceeded at least once in each of `periods`; NaN: none.
  /// low and high are those at the bounds of the rate; high NaN also where the runs do not bound
  /// it.                                                                    (n_periods) [kJ]
  [[nodiscard]] std::vector<Rate> energies(std::span<const EventRow> rows,
                                           std::span<const double> periods);

 private:
  struct Event {
    float energy = 0;
    double weight = 0;
    std::int32_t kind = 0, run = 0, block = 0;
  };
  [[nodiscard]] std::size_t kind_of(int run) const;
  template <class Counts>
  void take_rows(std::span<const EventRow> rows, Counts&& counts);
  template <class Counts>
  [[nodiscard]] Rate rate_of_rows(std::span<const EventRow> rows, Counts&& counts);
  [[nodiscard]] Rate rate_of_first(std::size_t n_events);
  void find_events(std::span<const EventRow> rows);

  std::span<const HazardRuns> classes_;
  bool costs_all_ = false;  // a rate costs all of its events: rocks, weights, units
  std::vector<int> n_hit_;  // scratch: of each class
  std::vector<std::vector<BlockWeight>> hit_;  // scratch: of each class, see rate_of()
  std::vector<Event> events_;                  // scratch: of a cell, the largest energy first
  std::vector<std::size_t> kind_of_run_;
};

}  // namespace talus
