// libcore/post/observed/calibrate.hpp: public
// Which runs the observations do not contradict, and the values that these drew: a set, not one
// best run. The set is tried on observations that are left out. Refs: Craig et al. 1997, Vernon et
// al. 2010 (history matching); Pukelsheim 1994 (three sigma)
//
// A run is compared with each layer as if the observations were drawn from it. The implausibility
// is the difference of a number over its standard deviation, which has the noise of n observations
// and that of the run's own blocks. It has no term for errors of the model: where every run is
// contradicted, no values within the ranges explain what was observed.
#pragma once

#include <string>
#include <vector>

#include "post/observed/observed.hpp"
#include "site/uncertainty.hpp"

namespace talus {

/// Larger ones contradict: a unimodal distribution has 95 % or more within three deviations.
inline constexpr double most_implausible = 3;

enum class ObservedKind { boulders, scars, outline };
/// "boulders of spring"
[[nodiscard]] std::string text(ObservedKind kind, const std::string& event);

/// The number of a layer that contradicts a run most.
struct Implausibility {
  double value = 0;         ///< of the worst number; NaN: the run cannot be judged by the layer
  const char* number = "";  ///< "mean run-out"
};
/// Of the blocks of one run of `computed`, by a layer of the event with number `event`.
[[nodiscard]] Implausibility implausibility_of(const ObservedEvent& observed, int event,
                                               ObservedKind kind, const Computed& computed,
                                               int run);

struct JudgedRun {
  int run = 0;                ///< number among the runs
  double implausibility = 0;  ///< the largest over the layers; NaN: judged by none
  std::string worst;          ///< "boulders of spring: mean run-out"
  std::vector<double> drawn;  ///<                                                      (n_keys)
  [[nodiscard]] bool is_plausible() const { return implausibility <= most_implausible; }
};

/// A boulder or scar that was left out, and the result for it from the runs that the rest leaves.
struct LeftOutPoint {
  ObservedKind kind = ObservedKind::boulders;
  std::string event;
  int point = 0;          ///< number in its layer
  int n_plausible = 0;    ///< runs that the rest does not contradict
  double percentile = 0;  ///< among the blocks of these; NaN: they say nothing of it
};
/// The same of a whole layer.
struct LeftOutLayer {
  ObservedKind kind = ObservedKind::boulders;
  std::string event;
  int n_plausible = 0;
  int n_contradicted = 0;  ///< of these, by the layer that was left out
};

struct Calibration {
  std::vector<std::string> keys;  ///< that were drawn, but for those that cut the rock
  std::vector<JudgedRun> runs;
  std::vector<LeftOutPoint> points;
  std::vector<LeftOutLayer> layers;  ///< where there are several
};
[[nodiscard]] int n_plausible(const Calibration& calibration);

/// `drawn`: of each run.                                                               (n_runs)
[[nodiscard]] Calibration calibrate(const std::vector<ObservedEvent>& events,
                                    const Computed& computed,
                                    const std::vector<std::vector<DrawnKey>>& drawn);

/// Of the points that were left out and of which something is said: those between the 5th and the
/// 95th percentile, where nine in ten are expected.
struct LeftOutCount {
  int n = 0, n_within = 0;
};
[[nodiscard]] LeftOutCount left_out_count(const Calibration& calibration);

/// Lowest and highest value of a key over all runs, or over the set; NaN: it is empty.
struct DrawnRange {
  double low = 0, high = 0;
};
[[nodiscard]] DrawnRange drawn_range(const Calibration& calibration, std::size_t key, bool of_set);

/// The set as a section [uncertainty.calibrated]; a remark alone where it is empty or nothing was
/// drawn.
[[nodiscard]] std::string section_text(const Calibration& calibration);
/// A few lines.
[[nodiscard]] std::string text(const Calibration& calibration);

}  // namespace talus
