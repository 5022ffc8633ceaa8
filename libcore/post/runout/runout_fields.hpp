// libcore/post/runout/runout_fields.hpp: public
// Fields of the tables of a run-out: blocks, runs, and points of the curves over time.
#pragma once

#include "base/fields.hpp"
#include "post/runout/runout_runs.hpp"

namespace talus {

/// A block at the end of its run.
struct RunBlock {
  const RunoutRun& run;
  const BlockReach& block;
  Vec3 origin;  ///< map coordinates of the local zero [m]
};
[[nodiscard]] const std::vector<Field<RunBlock>>& block_fields();

[[nodiscard]] const std::vector<Field<RunoutRun>>& run_fields();

/// A point of a shown_path(): of the layer path_points, and of the report's charts of a trajectory.
struct PathPoint {
  const TimedPath& path;
  std::size_t point;
};
[[nodiscard]] const std::vector<Field<PathPoint>>& path_point_fields();
/// Of a point after an impact; the one before it is that before the impact.
[[nodiscard]] const std::vector<Field<PathPoint>>& impact_fields();

struct CurvePoint {
  const RunoutRun& run;
  const CurveRow& row;
  Vec3 origin;  ///< as above
};
[[nodiscard]] const std::vector<Field<CurvePoint>>& curve_fields();

}  // namespace talus
