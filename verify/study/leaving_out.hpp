// verify/study/leaving_out.hpp
// Parts that the scene plan leaves out, on scenes that show them: with and without, side by side.
// in:    the slide of 39 blocks; the other scenes are made here
// out:   how far the answers are apart, and the time saved
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "verify/study/ensemble.hpp"

namespace talus {

/// A run with something kept or left out.
struct OmissionRun {
  std::vector<double> numbers;  ///< place, attitude and velocity of all blocks at the end
  std::vector<Vec3> places;     ///< of the blocks at the end; of an ensemble, the mean path [m]
  double uncertainty = 0;       ///< standard error of an ensemble's mean path [m]
  double path = 0;              ///< largest of the blocks [m]
  double cpu = 0;               ///< the start, all steps and their records [s]
  long shown = 0;               ///< hits, skipped steps: counts that must not be 0 to show anything
};

/// Something that a scene can do without.
struct Omission {
  std::string item;  ///< of the scene plan
  std::string scene;
  double tolerance = 0;        ///< on how far blocks end apart [m]; 0, and no share: to the bit
  double tolerance_share = 0;  ///< the same as a share of the path [-]
  std::function<OmissionRun(bool kept)> run;
  bool matters = false;  ///< the plan keeps it here: without it blocks end farther apart than that
};

/// The plans of six scenes against the full plan, then items one by one. Chaotic scenes, where a
/// last bit ends metres away, compare means of many starts within three standard errors. `full`:
/// with the whole slide, half a minute. `slide` must outlive them.
[[nodiscard]] std::vector<Omission> omissions(const SlideData& slide, bool full);

/// Both runs of an omission, CPU times as medians.
struct OmissionRow {
  Omission about;
  double kept_cpu = 0, left_out_cpu = 0;  ///< [s]
  double apart = 0;                       ///< largest distance of a block's two ends [m]
  double path = 0;                        ///< [m]
  double limit = 0;                       ///< on `apart` [m]; 0: to the bit
  long shown = 0;                         ///< the lesser of both runs
  bool holds = false;
};
/// Runs it `n` times each path, in turn.
[[nodiscard]] OmissionRow compare(const Omission& omission, int n);

/// Markdown, a line an omission.
[[nodiscard]] std::string omission_table(const std::vector<OmissionRow>& rows);

}  // namespace talus
