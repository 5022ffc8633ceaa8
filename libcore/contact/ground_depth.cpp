// Depth of overlap of a body and the ground, independent of contacts.
#include "contact/ground_depth.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "contact/scales.hpp"
#include "geometry/plan2d.hpp"
#include "terrain/trn_pyramid.hpp"

namespace talus {
namespace {

using std::size_t;
using Corners = std::array<Vec3, 3>;

template <class Visit>
void for_each_triangle(const Trn& trn, const Vec3& low, const Vec3& high, double around,
                       Visit&& visit) {
  const CellRange cells = cells_near(trn, low, high, around);
  for (int row = cells.row_first; row <= cells.row_last; ++row)
    for (int col = cells.col_first; col <= cells.col_last; ++col) {
      const int first = first_triangle(trn, {row, col});
      for (const int triangle : {first, first + 1})
        if (is_known(trn, triangle)) visit(triangle_corners(trn, triangle));
    }
}

// Of a triangle that is not vertical.
double distance_to_triangle(const Vec3& x, const Corners& corners) {
  const Vec3 normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
  const double height = normal.dot(x - corners[0]);
  const Vec3 foot = x - height * normal;
  bool left = true, right = true;
  double nearest = INFINITY;
  for (size_t k = 0; k < 3; ++k) {
    const Vec3 &a = corners[k], &b = corners[(k + 1) % 3];
    const double side = (b - a).cross(foot - a).dot(normal);
    left &= side >= 0;
    right &= side <= 0;
    nearest = std::min(nearest, distance_to_segment(x, a, b));
  }
  return left || right ? std::abs(height) : nearest;
}

// Distance from the ground's surface of a point below it; 0 above it.
double depth_of_point(const Trn& trn, const Vec3& x) {
  if (!contains(trn, x.x(), x.y())) return 0;
  double depth = elevation_at(trn, x.x(), x.y()) - x.z();
  if (!(depth > 0)) return 0;
  for_each_triangle(trn, x, x, depth, [&](const Corners& corners) {
    depth = std::min(depth, distance_to_triangle(x, corners));
  });
  return depth;
}

// Cuts off the part of a polygon beyond a plane.
void clip(const Vec3& normal, double offset, GroundDepthScratch& scratch) {
  const std::vector<Vec3>& from = scratch.polygon;
  scratch.clipped.clear();
  for (size_t k = 0; k < from.size(); ++k) {
    const Vec3 &a = from[k], &b = from[(k + 1) % from.size()];
    const double over_a = normal.dot(a) - offset, over_b = normal.dot(b) - offset;
    if (over_a <= 0) scratch.clipped.push_back(a);
    if ((over_a < 0 && over_b > 0) || (over_a > 0 && over_b < 0))
      scratch.clipped.push_back(a + over_a / (over_a - over_b) * (b - a));
  }
  scratch.polygon.swap(scratch.clipped);
}

// Is any point of a triangle inside a part, and `depth` inside those of its faces that are the
// body's surface?
bool reaches(const Hulls& hulls, const PlacedHulls& placed, int part, const Corners& corners,
             double depth, GroundDepthScratch& scratch) {
  scratch.polygon.assign(corners.begin(), corners.end());
  const int begin = hulls.face_begin[part], end = begin + hulls.n_faces[part];
  for (int face = begin; face < end && !scratch.polygon.empty(); ++face) {
    const auto slot = static_cast<size_t>(face);
    const double inside = hulls.cover[slot] == FaceCover::all ? 0 : depth;
    clip(normal_at(placed, face), placed.offset[slot] - inside, scratch);
  }
  return !scratch.polygon.empty();
}

// Deepest point of the ground's surface in a part, if it is deeper than `depth`.
double depth_inside(const Trn& trn, const Hulls& hulls, const PlacedHulls& placed, int part,
                    double depth, GroundDepthScratch& scratch) {
  const double thickness = hulls.thickness[part];
  const Box box = box_of_part(hulls, placed, part);
  for_each_triangle(trn, box.low, box.high, 0, [&](const Corners& corners) {
    double high = thickness;
    if (depth >= high || !reaches(hulls, placed, part, corners, depth, scratch)) return;
    while (high - depth > negligible * thickness) {
      const double middle = (depth + high) / 2;
      (reaches(hulls, placed, part, corners, middle, scratch) ? depth : high) = middle;
    }
  });
  return depth;
}

}  // namespace

double depth_in_ground(const Trn& trn, const Hulls& hulls, const PlacedHulls& placed, int body,
                       GroundDepthScratch& scratch) {
  double depth = 0;
  for (int part = hulls.part_begin[body]; part < hulls.part_begin[body + 1]; ++part) {
    for (int v = hulls.vertex_begin[part]; v < hulls.vertex_begin[part + 1]; ++v)
      depth = std::max(depth, depth_of_point(trn, placed.vertices[v]));
    depth = depth_inside(trn, hulls, placed, part, depth, scratch);
  }
  return depth;
}

}  // namespace talus
