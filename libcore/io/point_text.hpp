// Points of the ground in text: CSV and XYZ of surveys and point clouds.
// in:    columns by name, or x y z in the first three
// out:   points in coordinates and units of the file; what was taken, to be said
#pragma once

#include <string>
#include <vector>

#include "base/types.hpp"

namespace talus {

/// Whether the name ends like that of such a file: csv, xyz, txt, pts, asc ...
[[nodiscard]] bool is_point_text(const std::string& path);

struct PointText {
  std::vector<Vec3> points;
  std::string taken_from;  ///< "columns east, north, height; 2 other columns passed over"
};

/// Throws InputError with the line: text, fewer than three columns, columns whose names tell no
/// coordinates, first columns that are running numbers.
[[nodiscard]] PointText parse_points(const std::string& text, const std::string& file);

}  // namespace talus
