// The common part of two faces that lie against each other.
#include "geometry/face_overlap.hpp"

#include <Eigen/Geometry>
#include <utility>
#include <vector>

namespace talus {
namespace {

// The part of `polygon` on the inner side of the line through `start` with the inward direction.
std::vector<Vec3> inside_of(const std::vector<Vec3>& polygon, const Vec3& start,
                            const Vec3& inward) {
  std::vector<Vec3> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3& p = polygon[i];
    const Vec3& q = polygon[(i + 1) % polygon.size()];
    const double d_p = inward.dot(p - start), d_q = inward.dot(q - start);
    if (d_p >= 0) kept.push_back(p);
    if ((d_p > 0 && d_q < 0) || (d_p < 0 && d_q > 0))
      kept.push_back(p + d_p / (d_p - d_q) * (q - p));
  }
  return kept;
}

}  // namespace

FaceOverlap face_overlap(std::span<const Vec3> one, const Vec3& normal,
                         std::span<const Vec3> other) {
  std::vector<Vec3> polygon;
  for (const Vec3& p : other) polygon.push_back(p - normal.dot(p - one[0]) * normal);
  for (std::size_t k = 0; k < one.size() && !polygon.empty(); ++k)
    polygon = inside_of(polygon, one[k], normal.cross(one[(k + 1) % one.size()] - one[k]));
  FaceOverlap overlap;
  if (polygon.size() < 3) return overlap;
  double twice_area = 0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const double twice = normal.dot((polygon[i] - polygon[0]).cross(polygon[i + 1] - polygon[0]));
    twice_area += twice;
    overlap.centre += twice * (polygon[0] + polygon[i] + polygon[i + 1]) / 3;
  }
  if (twice_area == 0) return {};
  overlap.centre /= twice_area;
  overlap.area = std::abs(twice_area) / 2;
  overlap.outline = std::move(polygon);
  return overlap;
}

}  // namespace talus
