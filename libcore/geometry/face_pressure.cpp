// Resultant of a linear pressure on plane polygons, zero where it would be negative.
#include "geometry/face_pressure.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace talus {
namespace {

// integral of l_i l_j over a triangle is A (1 + delta_ij) / 12, l the barycentric coordinates
void add_all_positive(const std::array<Vec3, 3>& corner, const Vec3& pressure, FacePressure& sum) {
  const double area = (corner[1] - corner[0]).cross(corner[2] - corner[0]).norm() / 2;
  const Vec3 all = corner[0] + corner[1] + corner[2];
  sum.force += area * pressure.sum() / 3;
  for (int i = 0; i < 3; ++i)
    sum.first_moment += area / 12 * pressure[i] * (corner[static_cast<std::size_t>(i)] + all);
}

void add_parts(const std::array<Vec3, 3>& corner, double resolution,
               const std::function<double(const Vec3&)>& pressure_at, FacePressure& sum) {
  double longest = 0;
  for (std::size_t i = 0; i < 3; ++i)
    longest = std::max(longest, (corner[(i + 1) % 3] - corner[i]).norm());
  if (longest <= resolution) {
    add_pressure(corner,
                 Vec3(pressure_at(corner[0]), pressure_at(corner[1]), pressure_at(corner[2])), sum);
    return;
  }
  const Vec3 a = (corner[0] + corner[1]) / 2, b = (corner[1] + corner[2]) / 2,
             c = (corner[2] + corner[0]) / 2;
  add_parts({corner[0], a, c}, resolution, pressure_at, sum);
  add_parts({a, corner[1], b}, resolution, pressure_at, sum);
  add_parts({c, b, corner[2]}, resolution, pressure_at, sum);
  add_parts({a, b, c}, resolution, pressure_at, sum);
}

}  // namespace

void add_pressure(const std::array<Vec3, 3>& corner, const Vec3& pressure, FacePressure& sum) {
  std::array<Vec3, 4> at;  // the part under pressure, and the pressure there
  std::array<double, 4> p{};
  std::size_t n = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t k = (i + 1) % 3;
    const double here = pressure[static_cast<int>(i)], next = pressure[static_cast<int>(k)];
    if (here > 0) at[n] = corner[i], p[n++] = here;
    if ((here > 0) != (next > 0))
      at[n] = corner[i] + here / (here - next) * (corner[k] - corner[i]), p[n++] = 0;
  }
  for (std::size_t i = 2; i < n; ++i)
    add_all_positive({at[0], at[i - 1], at[i]}, Vec3(p[0], p[i - 1], p[i]), sum);
}

FacePressure pressure_on(std::span<const Vec3> polygon, double resolution,
                         const std::function<double(const Vec3&)>& pressure_at) {
  FacePressure sum;
  for (std::size_t i = 2; i < polygon.size(); ++i)
    add_parts({polygon[0], polygon[i - 1], polygon[i]}, resolution, pressure_at, sum);
  return sum;
}

}  // namespace talus
