// Triangulates scattered ground points and finds those that contradict their neighbours.
#include "terrain/point_tin.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>

#include "base/numbers.hpp"
#include "base/percentile.hpp"
#include "terrain/lone_levels.hpp"
#include "terrain/two_heights.hpp"

namespace talus {
namespace {

constexpr double steepest = 2.7474774194546222;  // tan 70 degrees: a height field ends there

// Points in one place become one, in the order of x, y, z.
void join_repeated(std::vector<Vec3>& points, PointMesh& found) {
  std::sort(points.begin(), points.end(), [](const Vec3& a, const Vec3& b) {
    return std::tuple(a.x(), a.y(), a.z()) < std::tuple(b.x(), b.y(), b.z());
  });
  std::size_t n_kept = 0;
  for (std::size_t i = 0, end = 0; i < points.size(); i = end) {
    double sum = 0;
    while (end < points.size() && points[end].head<2>() == points[i].head<2>())
      sum += points[end++].z();
    const double low = points[i].z(), high = points[end - 1].z();
    found.repeated_differ_m = std::max(found.repeated_differ_m, high - low);
    if (high - low > same_place_noise_m) found.doubts.push_back({points[end - 1], low, low, true});
    points[n_kept] = points[i];
    if (end > i + 1) points[n_kept].z() = sum / static_cast<double>(end - i);
    ++n_kept;
  }
  found.n_repeated = points.size() - n_kept;
  points.resize(n_kept);
}

// Heights around a point, from its edges.
struct Surroundings {
  double low = infinity, high = -infinity;
  double low_in_place = infinity;  // of points so near that they are in one place
  std::int64_t n_edges = 0, n_steep_above = 0, n_steep_below = 0, n_impossible = 0;
};

void look(const Vec3& point, const Vec3& other, double near_m, Surroundings& around) {
  const double above = point.z() - other.z(), length = (point - other).head<2>().norm();
  around.low = std::min(around.low, other.z());
  around.high = std::max(around.high, other.z());
  ++around.n_edges;
  around.n_steep_above += above > steepest * length ? 1 : 0;
  around.n_steep_below += -above > steepest * length ? 1 : 0;
  around.n_impossible += std::abs(above) > impossible_step(length) ? 1 : 0;
  if (above > 0 && are_two_heights(point, other, near_m))
    around.low_in_place = std::min(around.low_in_place, other.z());
}

void find_doubts(const TriangleMesh& mesh, std::vector<PointDoubt>& doubts) {
  constexpr double share_of_spacing = 0.2;
  const double near_m = std::min(one_place_m, share_of_spacing * edge_lengths(mesh).median);
  std::vector<Surroundings> around(mesh.points.size());
  for (const auto& corners : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = corners[k], b = corners[(k + 1) % 3];
      look(mesh.points[a], mesh.points[b], near_m, around[a]);
      look(mesh.points[b], mesh.points[a], near_m, around[b]);
    }
  for (std::size_t i = 0; i < around.size(); ++i) {
    const Surroundings& s = around[i];
    const bool stands_off =
        s.n_edges > 0 && std::max(s.n_steep_above, s.n_steep_below) == s.n_edges;
    const bool is_impossible = s.n_edges > 0 && 5 * s.n_impossible >= 4 * s.n_edges;
    if (stands_off || is_impossible)
      doubts.push_back({mesh.points[i], s.low, s.high, is_impossible});
    else if (s.low_in_place < infinity)
      doubts.push_back({mesh.points[i], s.low_in_place, s.low_in_place, false});
  }
}

}  // namespace

PointMesh mesh_of_points(std::vector<Vec3> points, const std::string& source) {
  PointMesh found;
  found.n_read = points.size();
  join_repeated(points, found);
  Triangulation triangulation(std::move(points), {}, source);
  triangulation.refresh(found.mesh, true);
  find_doubts(found.mesh, found.doubts);
  return found;
}

EdgeLengths edge_lengths(const TriangleMesh& mesh) {
  std::vector<double> lengths;
  lengths.reserve(3 * mesh.triangles.size());
  for (const auto& corners : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k)
      lengths.push_back(
          (mesh.points[corners[k]] - mesh.points[corners[(k + 1) % 3]]).head<2>().norm());
  if (lengths.empty()) return {};
  const double longest = *std::max_element(lengths.begin(), lengths.end());
  return {median(std::move(lengths)), longest};
}

}  // namespace talus
