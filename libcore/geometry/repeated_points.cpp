// Finds points of a layer that have the same place.
#include "geometry/repeated_points.hpp"

#include <array>
#include <cmath>
#include <map>

namespace talus {
namespace {

using Cell = std::array<double, 2>;  // whole numbers, as large as coordinates may be

bool is_one_place(const Vec3& a, const Vec3& b, double within) {
  const bool knows_height = !std::isnan(a.z()) && !std::isnan(b.z());
  return (a.head<2>() - b.head<2>()).norm() <= within &&
         !(knows_height && std::abs(a.z() - b.z()) > within);
}

}  // namespace

std::vector<int> repeated_points(const std::vector<Vec3>& points, double within) {
  std::map<Cell, std::vector<int>> in_cell;  // those that repeat none
  std::vector<int> first(points.size(), -1);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Cell cell = {std::floor(points[i].x() / within), std::floor(points[i].y() / within)};
    for (int dx = -1; dx <= 1; ++dx)
      for (int dy = -1; dy <= 1; ++dy) {
        const auto near = in_cell.find({cell[0] + dx, cell[1] + dy});
        if (near == in_cell.end()) continue;
        for (const int other : near->second)
          if (is_one_place(points[i], points[other], within) && (first[i] < 0 || other < first[i]))
            first[i] = other;
      }
    if (first[i] < 0) in_cell[cell].push_back(static_cast<int>(i));
  }
  return first;
}

}  // namespace talus
