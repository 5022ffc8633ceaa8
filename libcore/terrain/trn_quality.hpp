// libcore/terrain/trn_quality.hpp: public
// How good a TRN is: its errors against better data, and where a height field is a poor model of
// the ground.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "terrain/trn.hpp"

namespace talus {

/// Elevation of the ground at local (x, y): the node's own where a node lies there (to 1e-6 of a
/// cell), else that of the triangle; NaN where neither is known [m]. With it a grid can be compared
/// node by node up to its very rim, where the triangle that owns a node may be unknown.
[[nodiscard]] double elevation_or_node(const Trn& trn, double x, double y);

/// Errors of a TRN, terrain less truth.
struct ErrorStatistics {
  std::int64_t n = 0;              ///< truths that the ground covers
  std::int64_t n_uncovered = 0;    ///< truths over unknown ground
  double rmse = 0;                 ///< root mean square error [m]
  double mae = 0;                  ///< mean absolute error [m]
  double mean = 0;                 ///< mean error, > 0 when the terrain is too high [m]
  double p95 = 0;                  ///< 95 % of the absolute errors are at most this [m]
  double largest = 0;              ///< with its sign [m]
  Vec2 largest_at = Vec2::Zero();  ///< local x, y of the largest one [m]
};

/// Collects errors one by one; remembers 8 bytes each, for the percentile.
class ErrorCollector {
 public:
  /// `truth` at local (x, y), finite [m].
  void add(const Trn& trn, double x, double y, double truth);
  /// p95 is the smallest error that at least 95 % of all do not exceed. All zero without a truth.
  [[nodiscard]] ErrorStatistics statistics() const;

 private:
  std::vector<double> errors_;
  std::int64_t n_uncovered_ = 0;
  double largest_ = 0;
  Vec2 largest_at_ = Vec2::Zero();
};

/// Slopes of the ground, by triangles; all triangles are equal in plan, so shares are of the area.
struct SlopeStatistics {
  static constexpr int bin_deg = 5;
  std::int64_t n_nodes_known = 0;  ///< nodes with an elevation
  std::int64_t n_triangles = 0;    ///< of known ground
  std::int64_t n_flat = 0;         ///< triangles with three equal corners
  std::int64_t n_cells = 0;        ///< cells with ground
  std::int64_t n_cells_steep = 0;  ///< cells with a triangle steeper than steep_deg
  double mean_deg = 0;             ///< angle of the mean gradient
  double largest_deg = 0;          ///< of the steepest triangle
  std::array<std::int64_t, 18>
      n_in_bin{};  ///< triangles of 0 to below 5 degrees, 5 to below 10 ...
};

/// A height field is a poor model of ground steeper than this: overhangs are lost, and the width of
/// a cliff is that of a cell [deg].
inline constexpr double steep_deg = 70;

[[nodiscard]] SlopeStatistics slope_statistics(const Trn& trn);

}  // namespace talus
