// Covered faces, common volume and connection of the convex parts of a body.
#include "blocks/part_faces.hpp"

#include <algorithm>
#include <cmath>

#include "blocks/block_set.hpp"
#include "blocks/solid.hpp"
#include "geometry/face_overlap.hpp"
#include "geometry/plane.hpp"

namespace talus {
namespace {

struct Extent {
  Vec3 low, high;
};

Extent extent_of(const Polyhedron& part) {
  Extent extent{part.vertices[0], part.vertices[0]};
  for (const Vec3& v : part.vertices)
    extent.low = extent.low.cwiseMin(v), extent.high = extent.high.cwiseMax(v);
  return extent;
}

std::vector<Extent> extents_of(const std::vector<Polyhedron>& parts) {
  std::vector<Extent> extents;
  for (const Polyhedron& part : parts) extents.push_back(extent_of(part));
  return extents;
}

bool are_apart(const Extent& one, const Extent& other, double same) {
  return (one.low.array() > other.high.array() + same).any() ||
         (other.low.array() > one.high.array() + same).any();
}

// Lengths below it count as zero.
double same_length(const std::vector<Extent>& extents) {
  double size = 0;
  for (const Extent& extent : extents) size = std::max(size, (extent.high - extent.low).norm());
  return 1e-6 * size;
}

std::vector<Vec3> corners_of(const Polyhedron& part, int f) {
  std::vector<Vec3> corners;
  for (const int v : face(part, f)) corners.push_back(part.vertices[v]);
  return corners;
}

// Area of face f of `one` that lies against faces of `other`.
double covered_area(const Polyhedron& one, int f, const Polyhedron& other, double same) {
  const Plane plane = plane_through(face_centroid(one, f), face_normal(one, f));
  double area = 0;
  for (int g = 0; g < n_faces(other); ++g)
    if (face_normal(other, g).dot(plane.normal) < -1 + 1e-9 &&
        std::abs(distance(plane, face_centroid(other, g))) <= same)
      area += face_overlap(corners_of(one, f), plane.normal, corners_of(other, g)).area;
  return area;
}

}  // namespace

double shared_volume(const std::vector<Polyhedron>& parts) {
  const std::vector<Extent> extents = extents_of(parts);
  double volume = 0;
  for (size_t p = 0; p < parts.size(); ++p)
    for (size_t q = p + 1; q < parts.size(); ++q)
      if (!are_apart(extents[p], extents[q], 0)) volume += common_volume(parts[p], parts[q]);
  return volume;
}

void name_covered_faces(std::vector<Polyhedron>& parts) {
  const std::vector<Extent> extents = extents_of(parts);
  const double same = same_length(extents);
  for (size_t p = 0; p < parts.size(); ++p)
    for (int f = 0; f < n_faces(parts[p]); ++f) {
      double covered = 0;
      for (size_t q = 0; q < parts.size(); ++q)
        if (q != p && !are_apart(extents[p], extents[q], same))
          covered += covered_area(parts[p], f, parts[q], same);
      const bool is_covered = covered >= (1 - 1e-6) * face_area(parts[p], f);
      parts[p].face_tag[f] = is_covered ? face_internal : face_terrain;
    }
}

bool hang_together(const std::vector<Polyhedron>& parts) {
  const std::vector<Extent> extents = extents_of(parts);
  const double same = same_length(extents);
  const auto touch = [&](size_t p, size_t q) {
    if (are_apart(extents[p], extents[q], same)) return false;
    for (int f = 0; f < n_faces(parts[p]); ++f)
      if (covered_area(parts[p], f, parts[q], same) > 0) return true;
    return false;
  };
  std::vector<bool> reached(parts.size(), false);
  std::vector<size_t> next = {0};
  size_t n_reached = 0;
  while (!next.empty()) {
    const size_t at = next.back();
    next.pop_back();
    if (reached[at]) continue;
    reached[at] = true;
    ++n_reached;
    for (size_t q = 0; q < parts.size(); ++q)
      if (!reached[q] && touch(at, q)) next.push_back(q);
  }
  return n_reached == parts.size();
}

}  // namespace talus
