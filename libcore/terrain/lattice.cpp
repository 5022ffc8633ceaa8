// A square lattice over a triangle mesh: triangle, distance to lines and values of its nodes.
#include "terrain/lattice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "geometry/plan2d.hpp"
#include "terrain/as_index.hpp"

namespace talus {
namespace {

// An edge that runs upwards, or along a row of nodes.
struct RisingEdge {
  double y_low, y_high, x_low, x_per_y, x_high;
};

// The ends are always taken in the same order, so that both triangles of an edge find the same bits
// and no node falls between them.
RisingEdge rising_edge(const TriangleMesh& mesh, int a, int b) {
  const Vec3 *low = &mesh.points[a], *high = &mesh.points[b];
  if (low->y() > high->y() || (low->y() == high->y() && a > b)) std::swap(low, high);
  const double rise = high->y() - low->y();
  return {low->y(), high->y(), low->x(), rise > 0 ? (high->x() - low->x()) / rise : 0, high->x()};
}

// Whole numbers not below and not above x >= 0; std::ceil and std::floor are calls on a plain
// x86-64.
int rounded_down(double x) { return static_cast<int>(x); }
int rounded_up(double x) { return static_cast<int>(x) + (x > static_cast<int>(x) ? 1 : 0); }

// Marks the nodes under triangle t, borders included. The lattice begins south-west of the mesh.
void scan_triangle(const TriangleMesh& mesh, int t, Lattice& lattice) {
  const auto& [a, b, c] = mesh.triangles[t];
  const auto [y_low, y_high] =
      std::minmax({mesh.points[a].y(), mesh.points[b].y(), mesh.points[c].y()});
  const int row_first = rounded_up((y_low - lattice.low.y()) / lattice.spacing);
  const int row_last = rounded_down((y_high - lattice.low.y()) / lattice.spacing);
  if (row_first > row_last) return;
  const std::array<RisingEdge, 3> edges = {rising_edge(mesh, a, b), rising_edge(mesh, b, c),
                                           rising_edge(mesh, c, a)};
  for (int row = row_first; row <= row_last; ++row) {
    const double y = lattice.low.y() + lattice.spacing * row;
    double x_low = std::numeric_limits<double>::infinity(), x_high = -x_low;
    for (const RisingEdge& edge : edges) {
      if (y < edge.y_low || y > edge.y_high) continue;
      const bool level = edge.y_low == edge.y_high;
      const double x = edge.x_low + (y - edge.y_low) * edge.x_per_y;
      x_low = std::min({x_low, x, level ? edge.x_high : x});
      x_high = std::max({x_high, x, level ? edge.x_high : x});
    }
    const int first = rounded_up((x_low - lattice.low.x()) / lattice.spacing);
    const int last = rounded_down((x_high - lattice.low.x()) / lattice.spacing);
    for (int i = first; i <= last; ++i)
      lattice.triangle[as_index(row) * as_index(lattice.n_x) + as_index(i)] = t;
  }
}

// Exact distances of the nodes next to a point.
void seed_distance(const Lattice& lattice, const Vec2& point, std::vector<float>& distance) {
  const Vec2 at = (point - lattice.low) / lattice.spacing;
  const int i_near = static_cast<int>(at.x()), j_near = static_cast<int>(at.y());
  for (int j = std::max(j_near - 1, 0); j <= std::min(j_near + 2, lattice.n_y - 1); ++j)
    for (int i = std::max(i_near - 1, 0); i <= std::min(i_near + 2, lattice.n_x - 1); ++i) {
      float& nearest = distance[as_index(j) * as_index(lattice.n_x) + as_index(i)];
      const double gap = lattice.spacing * (Vec2(i, j) - at).norm();
      nearest = std::min(nearest, static_cast<float>(gap));
    }
}

// One sweep of the chamfer distance, forwards or backwards through the rows.
void sweep(const Lattice& lattice, bool backwards, std::vector<float>& distance) {
  const auto straight = static_cast<float>(lattice.spacing);
  const float diagonal = straight * std::sqrt(2.0F);
  const int n_x = lattice.n_x, n_y = lattice.n_y, step = backwards ? 1 : -1;
  const auto at = [&](int i, int j) -> float& {
    return distance[as_index(j) * as_index(n_x) + as_index(i)];
  };
  for (int j_count = 0; j_count < n_y; ++j_count) {
    const int j = backwards ? n_y - 1 - j_count : j_count;
    const bool has_row = j + step >= 0 && j + step < n_y;
    for (int i_count = 0; i_count < n_x; ++i_count) {
      const int i = backwards ? n_x - 1 - i_count : i_count;
      float best = at(i, j);
      if (i + step >= 0 && i + step < n_x) best = std::min(best, at(i + step, j) + straight);
      if (has_row) {
        best = std::min(best, at(i, j + step) + straight);
        if (i > 0) best = std::min(best, at(i - 1, j + step) + diagonal);
        if (i + 1 < n_x) best = std::min(best, at(i + 1, j + step) + diagonal);
      }
      at(i, j) = best;
    }
  }
}

// The mean of the known values of each two by two nodes.
void coarsen(int n_x, int n_y, const std::vector<float>& values,
             const std::vector<std::uint8_t>& known, std::vector<float>& coarse,
             std::vector<std::uint8_t>& coarse_known) {
  const int n_coarse_x = (n_x + 1) / 2, n_coarse_y = (n_y + 1) / 2;
  coarse.assign(as_index(n_coarse_x) * as_index(n_coarse_y), 0);
  coarse_known.assign(coarse.size(), 0);
  for (int j = 0; j < n_y; ++j)
    for (int i = 0; i < n_x; ++i) {
      const std::size_t node = as_index(j) * as_index(n_x) + as_index(i);
      const std::size_t parent = as_index(j / 2) * as_index(n_coarse_x) + as_index(i / 2);
      if (known[node] == 0) continue;
      coarse[parent] += values[node];
      ++coarse_known[parent];
    }
  for (std::size_t parent = 0; parent < coarse.size(); ++parent)
    if (coarse_known[parent] > 0) coarse[parent] /= static_cast<float>(coarse_known[parent]);
}

// Bilinear value of the coarse lattice at fine node (i, j), whose parent's centre is half a node
// off.
float interpolate(const std::vector<float>& coarse, int n_x, int n_y, int i, int j) {
  const auto [i0, i1] = std::pair(i / 2, std::clamp(i / 2 + (i % 2 == 0 ? -1 : 1), 0, n_x - 1));
  const auto [j0, j1] = std::pair(j / 2, std::clamp(j / 2 + (j % 2 == 0 ? -1 : 1), 0, n_y - 1));
  const auto at = [&](int column, int row) {
    return coarse[as_index(row) * as_index(n_x) + as_index(column)];
  };
  return 0.5625F * at(i0, j0) + 0.1875F * (at(i1, j0) + at(i0, j1)) + 0.0625F * at(i1, j1);
}

}  // namespace

Lattice lay_lattice(const TriangleMesh& mesh, double spacing) {
  Vec2 low = mesh.points.front().head<2>(), high = low;
  for (const Vec3& p : mesh.points)
    low = low.cwiseMin(p.head<2>()), high = high.cwiseMax(p.head<2>());
  Lattice lattice;
  lattice.spacing = spacing;
  lattice.low = low - Vec2::Constant(spacing / 2);
  lattice.n_x = static_cast<int>((high.x() - lattice.low.x()) / spacing) + 2;
  lattice.n_y = static_cast<int>((high.y() - lattice.low.y()) / spacing) + 2;
  lattice.triangle.assign(as_index(lattice.n_x) * as_index(lattice.n_y), -1);
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) scan_triangle(mesh, t, lattice);
  return lattice;
}

double height_in_triangle(const TriangleMesh& mesh, int t, const Vec2& place) {
  const auto& [a, b, c] = mesh.triangles[t];
  const Vec3& origin = mesh.points[a];
  const Vec3 u = mesh.points[b] - origin, v = mesh.points[c] - origin;
  const Vec2 w = place - origin.head<2>();
  const double area = cross(u.head<2>(), v.head<2>());
  const double share_b = cross(w, v.head<2>()) / area, share_c = cross(u.head<2>(), w) / area;
  return origin.z() + share_b * u.z() + share_c * v.z();
}

std::vector<Vec3> points_between(const TriangleMesh& mesh, double spacing) {
  std::vector<Vec3> between;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const bool constrained = (mesh.constrained[t] >> k & 1) != 0;
      if (!constrained || mesh.neighbors[t][k] > static_cast<int>(t)) continue;  // once for both
      const Vec3& a = mesh.points[mesh.triangles[t][(k + 1) % 3]];
      const Vec3& b = mesh.points[mesh.triangles[t][(k + 2) % 3]];
      const int n = static_cast<int>(std::ceil((b - a).head<2>().norm() / spacing));
      for (int i = 1; i < n; ++i) between.push_back(a + (b - a) * (static_cast<double>(i) / n));
    }
  return between;
}

std::vector<float> distance_to_points(const Lattice& lattice, const std::vector<Vec3>& points,
                                      const std::vector<Vec3>& more) {
  std::vector<float> distance(lattice.size(), std::numeric_limits<float>::infinity());
  for (const std::vector<Vec3>* list : {&points, &more})
    for (const Vec3& point : *list) seed_distance(lattice, point.head<2>(), distance);
  sweep(lattice, false, distance);
  sweep(lattice, true, distance);
  return distance;
}

void spread_values(int n_x, int n_y, std::vector<float>& values, std::vector<std::uint8_t> known) {
  const auto is_known = [](std::uint8_t k) { return k != 0; };
  if (std::all_of(known.begin(), known.end(), is_known)) return;
  if (n_x == 1 && n_y == 1) {
    values[0] = 0;
    return;
  }
  std::vector<float> coarse;
  std::vector<std::uint8_t> coarse_known;
  coarsen(n_x, n_y, values, known, coarse, coarse_known);
  const int n_coarse_x = (n_x + 1) / 2, n_coarse_y = (n_y + 1) / 2;
  spread_values(n_coarse_x, n_coarse_y, coarse, std::move(coarse_known));
  for (int j = 0; j < n_y; ++j)
    for (int i = 0; i < n_x; ++i) {
      const std::size_t node = as_index(j) * as_index(n_x) + as_index(i);
      if (known[node] == 0) values[node] = interpolate(coarse, n_coarse_x, n_coarse_y, i, j);
    }
}

}  // namespace talus
