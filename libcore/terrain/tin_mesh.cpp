#include "terrain/tin_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace talus {
namespace {

std::size_t index(int i) { return static_cast<std::size_t>(i); }

struct RingEdge {
  Vec2 a = Vec2::Zero(), b = Vec2::Zero();
};

// Edges of all rings in bands of y, so that a point is tested against those beside it only.
class RingBands {
 public:
  explicit RingBands(const std::vector<std::vector<Vec2>>& rings) {
    std::size_t n = 0;
    for (const auto& ring : rings) {
      n += ring.size();
      for (const Vec2& p : ring) low_ = std::min(low_, p.y()), high_ = std::max(high_, p.y());
    }
    bands_.resize(std::max<std::size_t>(n / 4, 1));
    for (const auto& ring : rings)
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const RingEdge edge{ring[i], ring[(i + 1) % ring.size()]};
        const auto [bottom, top] = std::minmax(edge.a.y(), edge.b.y());
        for (std::size_t band = band_of(bottom); band <= band_of(top); ++band)
          bands_[band].push_back(edge);
      }
  }

  // Even-odd rule along a ray to the east.
  [[nodiscard]] bool contains(const Vec2& p) const {
    if (!(p.y() >= low_ && p.y() <= high_)) return false;
    bool inside = false;
    for (const auto& [a, b] : bands_[band_of(p.y())]) {
      if ((a.y() > p.y()) == (b.y() > p.y())) continue;
      if (p.x() < a.x() + (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y())) inside = !inside;
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

}  // namespace

void cut_to_rings(const std::vector<std::vector<Vec2>>& rings, TriangleMesh& mesh) {
  if (rings.empty()) return;
  const RingBands bands(rings);
  const bool has_neighbors = !mesh.neighbors.empty();
  std::vector<int> new_number(mesh.triangles.size(), -1);
  int n_kept = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const Vec3 sum = mesh.points[index(a)] + mesh.points[index(b)] + mesh.points[index(c)];
    if (!bands.contains(sum.head<2>() / 3)) continue;
    mesh.triangles[index(n_kept)] = mesh.triangles[t];
    if (has_neighbors) mesh.neighbors[index(n_kept)] = mesh.neighbors[t];
    if (has_neighbors) mesh.constrained[index(n_kept)] = mesh.constrained[t];
    new_number[t] = n_kept++;
  }
  mesh.triangles.resize(index(n_kept));
  if (!has_neighbors) return;
  mesh.neighbors.resize(index(n_kept));
  mesh.constrained.resize(index(n_kept));
  for (auto& neighbors : mesh.neighbors)
    for (int& t : neighbors) t = t < 0 ? -1 : new_number[index(t)];
}

Tin to_tin(TriangleMesh mesh, const ContourMap& map) {
  mesh.neighbors = {};
  Tin tin;
  tin.origin = map.origin;
  tin.crs_wkt = map.crs_wkt;
  std::vector<int> new_number(mesh.points.size(), -1);
  for (const auto& corners : mesh.triangles)
    for (const int corner : corners) new_number[index(corner)] = 0;
  int n_used = 0;
  for (std::size_t i = 0; i < new_number.size(); ++i) {
    if (new_number[i] < 0) continue;
    mesh.points[index(n_used)] = mesh.points[i];
    new_number[i] = n_used++;
  }
  mesh.points.resize(index(n_used));
  for (auto& corners : mesh.triangles)
    for (int& corner : corners) corner = new_number[index(corner)];
  tin.points = std::move(mesh.points);
  tin.triangles = std::move(mesh.triangles);
  return tin;
}

}  // namespace talus
