// libcore/post/fence/fence_runs.hpp: public
// Runs at the fences of a site, and a check that fences and runs belong together.
// in:    run files one by one, the fences of the site file, the terrain
// out:   of each run its arrivals and verdicts at every fence and how far it came
#pragma once

#include <string>
#include <vector>

#include "ensemble/clusters.hpp"
#include "post/fence/fence.hpp"
#include "post/fence/fence_change.hpp"
#include "post/fence/fence_design.hpp"
#include "post/runout/runout.hpp"

namespace talus {

/// A fence of the site file, on the ground.
struct FenceCase {
  FenceSettings settings;
  RecordLine line;
  Fence fence;
};

/// The line of a run that belongs to a fence. `file` and `site_file` are named in messages. Throws
/// InputError when the run recorded none for it, or one in another place.
[[nodiscard]] int find_line(const RunFile& run, const FenceCase& fence, const std::string& file,
                            const std::string& site_file);

/// Throws InputError unless the fence that `stood` in the run of `file` is built as that of the
/// site file; that its posts are where they were, find_line() checks.
void check_same_fence(const FenceSettings& stood, const FenceSettings& expected,
                      const std::string& file, const std::string& site_file);

/// The hardest hit of the roof of a gallery by a block.
struct RoofLoad {
  int run = 0, block = 0;
  double weight = 1;
  int n_hits = 0;                                            ///< by the block
  double mass = 0, volume = 0, speed = 0, normal_speed = 0;  ///< just before [kg, m3, m/s]

  [[nodiscard]] double normal_energy() const { return 0.5 * mass * normal_speed * normal_speed; }
};

/// A run at one fence.
struct RunAtFence {
  std::vector<FenceArrival> arrivals;   ///< at the fence
  std::vector<FenceArrival> crossings;  ///< of its line
  std::vector<BlockVerdict> verdicts;   ///<                                         (n_blocks)
  bool standing = false;
  int n_unsettled = 0;           ///< blocks that the built fence stopped and that move at the end
  std::vector<PanelRow> broken;  ///< panels of the fence that broke, by time; rock by rock
  std::vector<RoofLoad> loads;   ///< of the gallery's roof, by block
};
/// Crossings of blocks that passed a fence for good; one that hangs in a panel has not.
[[nodiscard]] std::vector<FenceArrival> passed_for_good(const RunAtFence& at);

/// Data kept of a run after it was read.
struct FenceRun {
  std::vector<double> volume;        ///< of each block [m3]                         (n_blocks)
  std::vector<double> weight;        ///<                                            (n_blocks)
  double run_weight = 1;             ///< weight among the runs [-]
  bool independent = false;          ///< its rocks fell one by one, each on a fence of its own
  std::vector<char> moves;           ///< at the end                                 (n_blocks)
  std::vector<Vec3> end;             ///< where each block is then, local [m]        (n_blocks)
  std::vector<int> world;            ///< whose fence each block met (worlds_of)     (n_blocks)
  double density = 0;                ///< of all its rock [kg/m3]
  double block_size = 0;             ///< mean of the cube roots of the volumes [m]
  ReachLine event, centre;           ///< of the whole run, and of its centre of mass
  std::vector<RunAtFence> at_fence;  ///< (n_fences)
};

struct FenceRunSettings {
  double free_border = 0;  ///< f_min [m]; NaN: that of the code for the run's blocks
  double rest_speed = 0;   ///< [m/s]
};
/// `index`: the `run` of arrivals and verdicts; `line` of each fence (find_line) (n_fences)
[[nodiscard]] FenceRun run_at_fences(const RunFile& run, int index,
                                     const std::vector<FenceCase>& fences,
                                     const std::vector<int>& line, const DesignCode& code,
                                     const FenceRunSettings& settings, const Trn& trn);

/// Runs that are one sample, in the order of their ids and numbered in that order.
struct FenceRunGroup {
  std::vector<RunMember> members;  ///<                                              (n_runs)
  std::vector<FenceRun> runs;      ///<                                              (n_runs)
  Clusters clusters;               ///< of the members
};
/// Sum of the runs' weights.
[[nodiscard]] double weight_of_runs(const FenceRunGroup& group);
[[nodiscard]] inline int n_runs(const FenceRunGroup& group) {
  return static_cast<int>(group.runs.size());
}
/// Whether a fence was built in the runs: in all of them or in none (check_one_kind).
[[nodiscard]] inline bool stood(const FenceRunGroup& group, std::size_t fence) {
  return group.runs[0].at_fence[fence].standing;
}
[[nodiscard]] std::vector<FenceArrival> arrivals_at(const FenceRunGroup& group, std::size_t fence);
[[nodiscard]] int n_unsettled(const FenceRunGroup& group, std::size_t fence);
/// Whether rocks fell one by one in all runs: none dams another, or finds what it broke.
[[nodiscard]] bool fell_one_by_one(const FenceRunGroup& group);

/// Throws InputError when a fence was built in some runs and not in all: what it lets through and
/// the blocks at its line without it are two samples.
void check_one_kind(const FenceRunGroup& group, const std::vector<FenceCase>& fences);

/// The runs with the fences and those to compare with, and where their blocks came to rest.
struct FenceRuns {
  FenceRunGroup with, without;  ///< `without` may hold no run
  GroundSums ground_with, ground_without;
  PassageGrid grid;  ///< of the ground sums
};

}  // namespace talus
