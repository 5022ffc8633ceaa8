// From a triangulation to a TIN: cut to a boundary, unused points left out.
#include "terrain/tin_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <span>
#include <utility>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "base/source_path.hpp"
#include "base/text.hpp"
#include "geometry/plan2d.hpp"
#include "geometry/segment_meetings.hpp"

namespace talus {
namespace {

struct RingEdge {
  Vec2 a = Vec2::Zero(), b = Vec2::Zero();
  int polygon = 0;
};

// Edges of all rings in bands of y, so that a point is tested against those beside it only.
class RingBands {
 public:
  explicit RingBands(const std::vector<BoundaryRing>& rings) {
    std::size_t n = 0;
    for (const auto& [polygon, ring] : rings) {
      n += ring.size();
      for (const Vec2& p : ring) low_ = std::min(low_, p.y()), high_ = std::max(high_, p.y());
    }
    bands_.resize(std::max<std::size_t>(n / 4, 1));
    for (const auto& [polygon, ring] : rings)
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const RingEdge edge{ring[i], ring[(i + 1) % ring.size()], polygon};
        const auto [bottom, top] = std::minmax(edge.a.y(), edge.b.y());
        for (std::size_t band = band_of(bottom); band <= band_of(top); ++band)
          bands_[band].push_back(edge);
      }
  }

  // Even-odd rule along a ray to the east, for one polygon after the other.
  [[nodiscard]] bool contains(const Vec2& p) const {
    if (!(p.y() >= low_ && p.y() <= high_)) return false;
    bool inside = false;
    int current = 0;
    for (const auto& [a, b, polygon] : bands_[band_of(p.y())]) {
      if (inside && polygon != current) return true;
      current = polygon;
      if (is_left_of(a, b, p)) inside = !inside;
    }
    return inside;
  }

 private:
  [[nodiscard]] std::size_t band_of(double y) const {
    const auto n = static_cast<double>(bands_.size());
    const double band = high_ > low_ ? std::floor((y - low_) / (high_ - low_) * n) : 0;
    return static_cast<std::size_t>(std::clamp(band, 0.0, n - 1));
  }

  double low_ = std::numeric_limits<double>::infinity();
  double high_ = -std::numeric_limits<double>::infinity();
  std::vector<std::vector<RingEdge>> bands_;
};

// The edges of one polygon, between points that differ.
struct PolygonEdges {
  std::vector<Vec2> points;
  std::vector<std::array<int, 2>> edges;
};

PolygonEdges edges_of(std::span<const BoundaryRing> rings) {
  PolygonEdges found;
  std::map<std::pair<double, double>, int> number;
  const auto number_of = [&](const Vec2& p) {
    const auto [at, is_new] =
        number.try_emplace({p.x(), p.y()}, static_cast<int>(found.points.size()));
    if (is_new) found.points.push_back(p);
    return at->second;
  };
  for (const auto& [polygon, ring] : rings)
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const int a = number_of(ring[i]), b = number_of(ring[(i + 1) % ring.size()]);
      if (a != b) found.edges.push_back({a, b});
    }
  return found;
}

}  // namespace

void check_boundary(const ContourMap& map, const std::string& source) {
  const std::span<const BoundaryRing> rings(map.boundary);
  for (std::size_t begin = 0, end = 0; begin < rings.size(); begin = end) {
    while (end < rings.size() && rings[end].polygon == rings[begin].polygon) ++end;
    const auto [points, edges] = edges_of(rings.subspan(begin, end - begin));
    const SegmentMeetings meetings = find_segment_meetings(points, edges);
    if (meetings.crossings.empty()) continue;
    const auto [first, second] = meetings.crossings.front();
    const Vec2 a = points[edges[first][0]], b = points[edges[first][1]];
    const double share = crossing_share(a, b, points[edges[second][0]], points[edges[second][1]]);
    const Vec2 place = a + share * (b - a) + map.origin.head<2>();
    throw InputError({source},
                     "polygon " + std::to_string(rings[begin].polygon + 1) +
                         " of the boundary crosses itself at x " + text(place.x(), 10) + ", y " +
                         text(place.y(), 10),
                     "mend the polygon at this place, or ogr2ogr -makevalid mended.gpkg " +
                         command_words(source));
  }
}

void cut_to_rings(const std::vector<BoundaryRing>& rings, TriangleMesh& mesh) {
  if (rings.empty()) return;
  const RingBands bands(rings);
  const bool has_neighbors = !mesh.neighbors.empty();
  std::vector<int> new_number(mesh.triangles.size(), -1);
  int n_kept = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const Vec3 sum = mesh.points[a] + mesh.points[b] + mesh.points[c];
    if (!bands.contains(sum.head<2>() / 3)) continue;
    mesh.triangles[n_kept] = mesh.triangles[t];
    if (has_neighbors) mesh.neighbors[n_kept] = mesh.neighbors[t];
    if (has_neighbors) mesh.constrained[n_kept] = mesh.constrained[t];
    new_number[t] = n_kept++;
  }
  mesh.triangles.resize(n_kept);
  if (!has_neighbors) return;
  mesh.neighbors.resize(n_kept);
  mesh.constrained.resize(n_kept);
  for (auto& neighbors : mesh.neighbors)
    for (int& t : neighbors) t = t < 0 ? -1 : new_number[t];
}

double area_of(const std::vector<BoundaryRing>& rings) {
  if (rings.empty()) return 0;
  constexpr int n = 300;  // places along a side
  Vec2 low(infinity, infinity), high = -low;
  for (const BoundaryRing& ring : rings)
    for (const Vec2& p : ring.points) low = low.cwiseMin(p), high = high.cwiseMax(p);
  const RingBands bands(rings);
  const Vec2 step = (high - low) / n;
  std::int64_t n_inside = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      n_inside += bands.contains(low + step.cwiseProduct(Vec2(i + 0.5, j + 0.5))) ? 1 : 0;
  return static_cast<double>(n_inside) * step.x() * step.y();
}

Tin to_tin(TriangleMesh mesh, const ContourMap& map) {
  mesh.neighbors = {};
  Tin tin;
  tin.origin = map.origin;
  tin.crs_wkt = map.crs_wkt;
  std::vector<int> new_number(mesh.points.size(), -1);
  for (const auto& corners : mesh.triangles)
    for (const int corner : corners) new_number[corner] = 0;
  int n_used = 0;
  for (std::size_t i = 0; i < new_number.size(); ++i) {
    if (new_number[i] < 0) continue;
    mesh.points[n_used] = mesh.points[i];
    new_number[i] = n_used++;
  }
  mesh.points.resize(n_used);
  for (auto& corners : mesh.triangles)
    for (int& corner : corners) corner = new_number[corner];
  tin.points = std::move(mesh.points);
  tin.triangles = std::move(mesh.triangles);
  return tin;
}

}  // namespace talus
