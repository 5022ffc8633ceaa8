// libcore/post/observed/observed.hpp: public
// Observations beside results, with a score, and how much the observations can tell.
// in:    observed boulders, scars and outlines; the runs one by one
// out:   run-out along and across the path, shares inside, heights, each with an interval
//
// The run-out is the displacement in plan from the start, `across` its part across the mean
// direction of the observed boulders, positive to the left. Where starts of the boulders are known,
// each has its own, and each computed block too; else all start at the blocks' mean start.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "post/share_interval.hpp"
#include "record/run_file.hpp"
#include "setup/observed.hpp"

namespace talus {

// --- what was computed ---------------------------------------------------------------------------

/// A block that counts: of rocks that fall one by one each, of a mass those that moved (moved.hpp).
struct ComputedBlock {
  int run = 0, block = 0;
  double weight = 1;
  Vec2 start = Vec2::Zero(), end = Vec2::Zero();  ///< of its centroid [m]
  double volume = 0;                              ///< [m3]
  bool is_deposited = false, has_left = false;
};

/// A block that passed the cell of a scar.
struct ScarPass {
  int run = 0, block = 0;
  double weight = 1;
  double height = 0;  ///< largest of its centroid above the ground there [m]
};

struct Computed {
  std::vector<ComputedBlock> blocks;                       ///< by run
  PassageGrid grid;                                        ///< of passages
  std::vector<std::uint8_t> is_passed;                     ///< by any block       (n_cells)
  std::vector<std::vector<std::vector<ScarPass>>> passes;  ///< [event][scar]
  /// An observed event is one run: its blocks move together, or share the values that the run
  /// drew. Else it is of rocks from any of the runs.
  bool is_event_a_run = false;
  // finish()
  Vec2 start = Vec2::Zero();  ///< mean of the blocks [m]
  double left_share = 0;      ///< of their weight, that left the terrain; NaN: there are none
};
/// Adds a run, number `index` among them.
void add_blocks(Computed& computed, const RunFile& run, int index, double rest_speed);
/// Adds all passages of it; `run` holds only these.
void add_passages(Computed& computed, const std::vector<ObservedEvent>& events, const RunFile& run,
                  int index, const std::vector<Passage>& passages);
/// Once all are there: their sums, and the same order however runs are spread over files.
void finish(Computed& computed);

// --- along and across ----------------------------------------------------------------------------

struct RunoutAxis {
  bool has_starts = false;     ///< each block and boulder has its own
  Vec2 start = Vec2::Zero();   ///< mean of the computed blocks, else of all [m]
  Vec2 along = Vec2::UnitX();  ///< mean direction of the observed boulders
};
[[nodiscard]] RunoutAxis runout_axis(const Computed& computed,
                                     std::span<const ObservedPoint> boulders);

struct AlongAcross {
  double runout = 0, across = 0;  ///< [m]
};
[[nodiscard]] AlongAcross along_and_across(const RunoutAxis& axis, const ObservedPoint& boulder);
[[nodiscard]] AlongAcross along_and_across(const RunoutAxis& axis, const ComputedBlock& block);

/// Area between the distribution functions of two samples (first Wasserstein distance), in the unit
/// of the values. Both ascend by value.
[[nodiscard]] double area_between(std::span<const WeightedValue> a,
                                  std::span<const WeightedValue> b);

// --- scores --------------------------------------------------------------------------------------

/// A share of computed blocks, and its 95 % interval over clusters; NaN where they are too few.
struct ComputedShare {
  double share = std::numeric_limits<double>::quiet_NaN();
  Interval interval{std::numeric_limits<double>::quiet_NaN(),
                    std::numeric_limits<double>::quiet_NaN()};
};

/// A number of the observations with its 95 % interval, NaN where the points are too few for one,
/// and the computed one.
struct Compared {
  double observed = 0;
  Interval interval;
  double computed = 0;
};

struct BoulderRow {
  std::string event;
  ObservedPoint point;
  AlongAcross at;
  ComputedShare percentile;  ///< of the computed run-outs, that are not longer
  double volume_share = 0;   ///< of the computed blocks, that are not larger; NaN: not known
  bool is_in_reach = false;  ///< in a cell that a computed block passed
};

inline constexpr std::array<double, 3> observed_levels = {0.1, 0.5, 0.9};

struct BoulderScore {
  RunoutAxis axis;
  std::vector<BoulderRow> rows;
  Compared mean;                                        ///< run-out [m]
  std::array<Compared, observed_levels.size()> levels;  ///< percentiles of the run-out [m]
  Compared across;                                      ///< standard deviation across [m]
  double area = 0;        ///< between the distributions of the run-outs [m]
  double noise = 0;       ///< as many points drawn from a run, or from all: the area's median [m]
  double noise_high = 0;  ///< and its 95 % bound [m]
  double mean_percentile = 0;                ///< of the observed among the computed run-outs [-]
  Interval by_chance;                        ///< 95 % of the drawn points [-]
  std::vector<double> computed_percentiles;  ///< run-outs at 0, 1 ... 100 %, for a chart   (101)
  Compared reached;  ///< share of the points that lie in the computed reach; computed: 1
  /// The observations tell that the computed distribution is not theirs.
  [[nodiscard]] bool is_told_apart() const { return area > noise_high; }
};

struct ScarRow {
  std::string event;
  ObservedPoint point;
  int n_passes = 0;          ///< computed blocks that passed the cell
  ComputedShare percentile;  ///< of their heights, that are not above the scar; NaN: none passed
  double p50 = 0, p95 = 0;   ///< of their heights [m]; NaN: none passed
};

struct ScarScore {
  std::vector<ScarRow> rows;
  int n_passed = 0;            ///< scars that a computed block passed
  double mean_percentile = 0;  ///< of those [-]; NaN: none
  Interval by_chance;          ///< 95 % of as many even shares [-]
};

struct OutlineScore {
  ComputedShare inside;      ///< of the deposit, within the outline
  double reached_share = 0;  ///< of the outline's cells, that a computed block passed [-]
};

struct EventScore {
  std::string name;
  std::optional<BoulderScore> boulders;
  std::optional<ScarScore> scars;
  std::optional<OutlineScore> outline;
};

/// Of an event whose number is `event`. Throws nothing; no computed block: NaN.
[[nodiscard]] EventScore score_of(const ObservedEvent& observed, int event,
                                  const Computed& computed, const ShareBasis& basis);

/// The smallest number of points that bound the p-percentile on both sides with 95 %.
[[nodiscard]] int points_needed(double p);

/// "n = 4 points cannot tell the median (6 can) nor the 10th and 90th percentiles (36 can)"
[[nodiscard]] std::string what_they_tell(const BoulderScore& score);
/// A few lines on the event.
[[nodiscard]] std::string text(const EventScore& score);

}  // namespace talus
