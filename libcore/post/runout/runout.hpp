// libcore/post/runout/runout.hpp: public
// How far a run came: paths, streamline, H, L and the angle of reach of the event, of each block
// and of the centre of mass; curves over time; where the energy went.
// in:    frames of one run, its terrain
// paper: Zhang et al. 2018, Eq. (29) and Fig. 14; definitions in docs/reference/formats.md#run-out
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "post/deposit.hpp"
#include "post/moved.hpp"
#include "record/reach.hpp"
#include "terrain/trn.hpp"

namespace talus {

/// The path of a point through the frames, and its motion in each.
struct TimedPath {
  std::vector<double> time;      ///< [s]                                             (n_points)
  std::vector<Vec3> point;       ///< local [m]                                       (n_points)
  std::vector<double> speed;     ///< [m/s]                                           (n_points)
  std::vector<double> distance;  ///< of shown_path(), along the whole path in plan [m]
  std::vector<double> spin;      ///< of a block [rad/s]                     (n_points, or none)
  std::vector<double> energy;    ///< of a block, with spin [J]              (n_points, or none)
  std::vector<double> height;    ///< of shown_path(), above the ground; NaN: no ground [m]
  std::vector<bool> is_impact;   ///< since the frame before; of a block                   (same)
};

/// An impact lies between two frames if the velocity changed by more than 0.5 m/s, and by more than
/// twice the effect of the weight, once gravity is taken off: sliding and rolling change it by
/// less.
[[nodiscard]] TimedPath block_path(const RunFile& run, int block);
/// Of the centre of mass of all blocks; its speed is that of the mean momentum.
[[nodiscard]] TimedPath centre_of_mass_path(const RunFile& run);

/// Indices of the points to keep so that no point lies farther than `tolerance` from the line
/// through the kept ones (Douglas and Peucker); first and last always [m].
[[nodiscard]] std::vector<int> simplified(std::span<const Vec3> points, double tolerance);
[[nodiscard]] TimedPath simplified(const TimedPath& path, double tolerance);
/// The simplified path of a block, with both ends of each impact and the highest point above the
/// ground between two of them, so that no bounce is lost.
[[nodiscard]] TimedPath shown_path(const RunFile& run, int block, const Trn& trn, double tolerance);

[[nodiscard]] double horizontal_length(
    std::span<const Vec3> points);  ///< along the path, in plan [m]

/// H and L from the first to the last point.
[[nodiscard]] ReachLine reach_along(std::span<const Vec3> points);

/// The angle from a path's first point to each of its points, along the path.
///
/// On a path that flattens it falls from start to end. Where a steeper part comes later it rises
/// again: then the angle at the end is not the smallest one, an energy line of some angles would
/// have stopped the mass higher up, and Eq. (29) at the toe hides that.
struct AngleProfile {
  std::vector<double> angle;  ///< [rad]; NaN at the start                        (n_points)
  double smallest = 0;        ///< the energy line that clears the whole path [rad]
  double smallest_at = 0;     ///< its horizontal distance from the start [m]
  /// How far an energy line from the start to a later point runs below the ground at an earlier
  /// one, at most: the head that a mass on that line lacks to come by there [m].
  double missing_head = 0;
  bool monotone = true;                 ///< falls throughout: no head above `tolerance` is missing
  [[nodiscard]] double at_end() const;  ///< [rad]; NaN for no path
};
/// `tolerance`: a missing head of no more is not told from the error of the points' heights [m].
/// Points nearer than `from` to the start are left out, since the first steps of a fall say nothing
/// of reach [m].
[[nodiscard]] AngleProfile angle_profile(std::span<const Vec3> points, double from,
                                         double tolerance);

struct BlockReach {
  int block = 0;
  Fate fate = Fate::deposited;
  ReachLine reach;        ///< of the centroid
  double max_speed = 0;   ///< over all steps, or the frames when passages are missing [m/s]
  double max_energy = 0;  ///< of translation and rotation, over the same [J]
};

/// How far a mass came without its few farthest blocks.
inline constexpr double reach_share = 0.95;    ///< of the mass that moved
inline constexpr double outlier_factor = 1.2;  ///< a block beyond so many times that reach is one

/// Plan distance from the highest point of what moved within which `reach_share` of the mass that
/// moved is at the end, by centroids. NaN where no block moved. A block has left the source where
/// it ends outside the convex outline of all blocks at the start, in plan, by centroids.
struct MassReach {
  double height = 0;                   ///< H95, down to the block that is as far [m]
  double length = 0;                   ///< L95, straight, in plan [m]
  int n_beyond = 0;                    ///< blocks farther than that
  double beyond_share = 0;             ///< their share of the mass that moved [-]
  double toe_share = 0;                ///< of the farthest block [-]
  int n_outliers = 0;                  ///< blocks beyond outlier_factor times L95
  double moved_volume = 0;             ///< of the blocks that moved [m3]
  double left_share = 0;               ///< of the released mass, that left its source [-]
  [[nodiscard]] double angle() const;  ///< atan(H95 / L95) [rad]
};

/// Input of Eq. (29), and the results beside it.
///
/// Where no block moved (moved.hpp) run-out is undefined: there is neither a toe block nor a
/// streamline, and the reach of event and centre of mass is NaN.
struct EventReach {
  Moved moved;                      ///< how much of the mass, and how far
  Vec3 top = Vec3::Zero();          ///< highest point of the mass before it moved [m]
  Vec3 toe = Vec3::Zero();          ///< outermost point of the toe block, on the ground
  int toe_block = -1;               ///< that moved and is at the end farthest from the top, in plan
  Fate toe_fate = Fate::deposited;  ///< a toe block that still moves goes farther yet
  std::vector<Vec3> streamline;     ///< top, the toe block's path on the ground, toe [m]
  ReachLine event;                  ///< along the streamline
  MassReach mass;                   ///< of the moved mass, without its few farthest blocks
  AngleProfile profile;             ///< along the streamline from the toe block's start
  ReachLine centre_of_mass;         ///< H_cm, L_cm along the path of the centre of mass
  double sum_angle = 0;  ///< atan(sum m H / sum m L) over blocks: tan(phi) for pure sliding [rad]
  std::vector<BlockReach> blocks;  ///< of each block                                (n_blocks)
};

struct ReachSettings {
  double tolerance = 0.5;    ///< of simplified paths, on which lengths are measured [m]
  double rest_speed = 0.05;  ///< [m/s]
};

/// Reach of a run from its frames and passages.
[[nodiscard]] RunReach reach_of_frames(const RunFile& run, const Trn& trn,
                                       const ReachSettings& settings);

/// Throws nothing; a run without frames has not moved. Where `run.reach` replaces the frames, the
/// settings' tolerance must be that of it.
[[nodiscard]] EventReach event_reach(const RunFile& run, const Trn& trn,
                                     const ReachSettings& settings);

/// Of the blocks that moved; `displacement` [m] and mass of each block.
[[nodiscard]] MassReach mass_reach(const RunFile& run,
                                   const std::vector<WeightedValue>& displacement);

/// One row of the curves over time.
struct CurveRow {
  double time = 0;                     ///< [s]
  Vec3 centre_of_mass = Vec3::Zero();  ///< local [m]
  double mean_speed = 0;               ///< weighted by mass [m/s]
  double max_speed = 0;                ///< [m/s]
  double front = 0;  ///< largest horizontal distance of a centroid from its start [m]
  double translation = 0, rotation = 0;  ///< [J]
};
[[nodiscard]] std::vector<CurveRow> curves(const RunFile& run);

/// Where the energy went, as shares of the input by gravity and at the start; they sum to 1 but for
/// the run's own balance error.
struct EnergyShares {
  double put_in = 0;  ///< loss of potential energy + kinetic energy at the start + input [J]
  double friction = 0, impact = 0, contact = 0, breakage = 0, removed = 0, kinetic = 0, elastic = 0;
  double fence = 0;              ///< taken by panels of fences that yielded
  double rolling = 0, drag = 0;  ///< by resistance to rolling, by drag of the ground
  double unaccounted = 0;
};
/// Zero everywhere when the run has no health record or nothing was put in.
[[nodiscard]] EnergyShares energy_shares(const RunFile& run);

}  // namespace talus
