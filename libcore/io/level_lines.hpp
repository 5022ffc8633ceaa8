// libcore/io/level_lines.hpp: public
// Lines of equal value of a field that is sampled on a grid, by GDAL.
#pragma once

#include <vector>

#include "base/types.hpp"

namespace talus {

/// Samples at corner + spacing * (col, north * row); NaN: unknown.
struct SampledField {
  Vec2 corner = Vec2::Zero();  ///< of the first sample [m]
  double spacing = 1;          ///< [m]
  int n_rows = 0, n_cols = 0;
  std::vector<double> value;  ///<                                              (n_rows x n_cols)
  double north = -1;          ///< where rows go: -1 to the south, 1 to the north
};

struct LevelLine {
  double level = 0;
  std::vector<Vec2> points;  ///< the first again at the end where the line is closed
};

/// Each line in one piece, linear between samples, by level; it ends where a sample is unknown.
/// Lines pass a sample of their level a millionth of a spacing beside it.
[[nodiscard]] std::vector<LevelLine> level_lines(const SampledField& field,
                                                 const std::vector<double>& levels);

}  // namespace talus
