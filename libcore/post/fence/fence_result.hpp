// libcore/post/fence/fence_result.hpp: public
// All that is said of one fence over many runs: shares of verdicts, statistics and design check of
// the whole, its fields and posts, storage, and the ground behind it with and without the fence.
// in:    runs at the fences (fence_runs.hpp), the design code
// out:   numbers; their words are in fence_text.hpp
// Definitions: docs/reference/formats.md#fence
#pragma once

#include <vector>

#include "post/fence/fence_runs.hpp"
#include "post/share_interval.hpp"

namespace talus {

struct FenceResultSettings {
  DesignInput design;    ///< block_volume NaN: 95th percentile of the blocks that arrive
  double bulking = 1.3;  ///< volume of piled blocks over that of their rock [-]
};

/// Where the arrivals of the design check come from. Design values are those of a line that stops
/// nothing: rocks held by a built fence stop those behind them.
enum class DesignBasis {
  open_line,      ///< the line of these runs, which are without the fence
  without_fence,  ///< its line in the runs compared with, which are without it
  first_touches,  ///< neither: touches of the built fence
};

struct FieldResult {
  FencePartSummary part;
  DesignResult design;
  double storage = 0;  ///< [m3]
};

struct FenceResult {
  std::vector<FenceArrival> arrivals;   ///< at the line itself, not beside it
  std::vector<FieldResult> fields;      ///<                                         (n_fields)
  std::vector<FencePartSummary> posts;  ///<                                         (n_posts)
  FencePartSummary whole;
  DesignBasis basis = DesignBasis::open_line;
  FencePartSummary at_basis;  ///< basis of the design check: `whole`, or without the fence
  int n_basis_runs = 0;
  DesignResult design;
  double storage = 0;   ///< of all fields [m3]
  double retained = 0;  ///< by the verdicts, as it lies, in the run where it is most; of rocks that
                        ///< fell one by one, of one of them [m3]
  double kept = 0;      ///< from passing, a run or such a rock, by the comparison, as it lies [m3];
                        ///< NaN: none
  int side = 0;         ///< where blocks come from: +1 left of the line, -1 right
};
/// The design block: the 95th percentile of the blocks that arrive, the largest of too few.
void set_design_block(DesignInput& input, const std::vector<FenceArrival>& arrivals);

/// Of fence number `index` of the site.
[[nodiscard]] FenceResult fence_result(const FenceCase& fence, std::size_t index,
                                       const FenceRuns& runs, const DesignCode& code,
                                       const std::vector<BarrierClass>& classes,
                                       const FenceResultSettings& settings, const Trn& trn);

/// How many blocks of all runs have a verdict at a fence. `basis`: of the group's clusters.
struct VerdictShare {
  int n = 0;          ///< blocks
  double share = 0;   ///< of the released weight [-]; NaN: nothing was released
  Interval interval;  ///< 95 %; NaN: too few clusters
};
[[nodiscard]] VerdictShare verdict_share(const FenceRunGroup& group, std::size_t fence,
                                         Verdict verdict, const ShareBasis& basis);

/// Blocks behind the line of a fence, and how far the runs came. NaN where unknown.
struct GroundBehind {
  int n = 0;                  ///< blocks that crossed for good and that the fence does not hold
  double share = 0;           ///< of the released weight [-]
  double volume = 0;          ///< of their rock, a run [m3]
  double energy_p50 = 0;      ///< at the line [J]; NaN: too few blocks
  double energy_largest = 0;  ///< [J]
  int n_moved = 0;            ///< runs in which a block moved: those that the means are over
  double path = 0;            ///< L of the event along the path, mean over runs [m]
  double path_angle_deg = 0;  ///< angle of reach along the path, mean over runs
  double centre_of_mass_path = 0;  ///< L_cm along the path, mean over runs [m]
};
[[nodiscard]] GroundBehind ground_behind(const FenceRunGroup& group, std::size_t fence);

}  // namespace talus
