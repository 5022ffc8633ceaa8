// libcore/post/maps/level_lines.hpp
// Lines of equal value of a field that is sampled on a grid.
#pragma once

#include <vector>

#include "base/types.hpp"

namespace talus {

/// Samples at corner + spacing * (col, -row); NaN: unknown.
struct SampledField {
  Vec2 corner = Vec2::Zero();  ///< of the north-western sample [m]
  double spacing = 1;          ///< [m]
  int n_rows = 0, n_cols = 0;
  std::vector<double> value;  ///<                                              (n_rows x n_cols)
};

struct LevelLine {
  double level = 0;
  std::vector<Vec2> points;  ///< the first again at the end where the line is closed
};

/// Each line in one piece, linear between samples; none through a square with an unknown sample. A
/// sample that has the level counts as above it.
[[nodiscard]] std::vector<LevelLine> level_lines(const SampledField& field,
                                                 const std::vector<double>& levels);

}  // namespace talus
