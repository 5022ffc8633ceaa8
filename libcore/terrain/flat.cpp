// Finds flat triangles of a contour map and computes heights inside them by a thin plate.
#include "terrain/flat.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "base/error.hpp"
#include "geometry/plan2d.hpp"
#include "terrain/as_index.hpp"
#include "terrain/contours.hpp"
#include "terrain/lattice.hpp"
#include "terrain/plate.hpp"

namespace talus {
namespace {

constexpr double nodes_per_contour_distance = 8;
constexpr double spacing_in_segments = 1.5;
constexpr double most_nodes = 4e7;
constexpr double steepest_slope = 10;  // 84 degrees: slivers at a cliff would rule all around
constexpr int fewest_nodes = 4;  // a flat region of fewer is narrower than the lattice can show
constexpr double nearest_in_spacings = 0.35;  // nodes nearer to a line would make slivers
constexpr double full_density_in_spacings =
    3;  // all nodes up to here, then every second, fourth ...

double plan_area(const TriangleMesh& mesh, std::size_t t) {
  const auto& [a, b, c] = mesh.triangles[t];
  const Vec3 u = mesh.points[b] - mesh.points[a];
  const Vec3 v = mesh.points[c] - mesh.points[a];
  return cross(u.head<2>(), v.head<2>()) / 2;
}

double slope(const TriangleMesh& mesh, std::size_t t) {
  const auto& [a, b, c] = mesh.triangles[t];
  const Vec3 normal = (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]);
  return normal.head<2>().norm() / std::max(normal.z(), 1e-12);
}

bool is_constrained(const TriangleMesh& mesh, std::size_t t, std::size_t edge) {
  return (mesh.constrained[t] >> edge & 1) != 0;
}

// Number of the connected flat region of each triangle, -1 for the rest; contours divide regions.
std::vector<int> number_regions(const TriangleMesh& mesh, const std::vector<std::uint8_t>& flat,
                                int& n_regions) {
  std::vector<int> region(flat.size(), -1), stack;
  n_regions = 0;
  for (std::size_t seed = 0; seed < flat.size(); ++seed) {
    if (flat[seed] == 0 || region[seed] >= 0) continue;
    region[seed] = n_regions;
    stack.push_back(static_cast<int>(seed));
    while (!stack.empty()) {
      const std::size_t t = as_index(stack.back());
      stack.pop_back();
      for (std::size_t k = 0; k < 3; ++k) {
        const int next = mesh.neighbors[t][k];
        if (next < 0 || is_constrained(mesh, t, k)) continue;
        if (flat[next] == 0 || region[next] >= 0) continue;
        region[next] = n_regions;
        stack.push_back(next);
      }
    }
    ++n_regions;
  }
  return region;
}

// Treatment of a triangle by the mending.
enum class Part : std::uint8_t { kept, flat, beside };

double rise(const TriangleMesh& mesh, std::size_t t) {
  const auto& [a, b, c] = mesh.triangles[t];
  const auto [low, high] =
      std::minmax({mesh.points[a].z(), mesh.points[b].z(), mesh.points[c].z()});
  return high - low;
}

// Flat triangles, and the sloping ones beside a flat region that the lattice can show, across a
// level edge that is not a contour: the ground there is as little level as in the region. A
// triangle that rises past the next contour bridges ground without contours, at the map's edge: it
// is kept.
std::vector<Part> find_parts(const TriangleMesh& mesh, const std::vector<std::uint8_t>& flat,
                             const Lattice& lattice, double interval) {
  int n_regions = 0;
  const std::vector<int> region = number_regions(mesh, flat, n_regions);
  std::vector<int> n_nodes(n_regions, 0);
  for (const int t : lattice.triangle)
    if (t >= 0 && region[t] >= 0) ++n_nodes[region[t]];
  std::vector<Part> part(flat.size(), Part::kept);
  for (std::size_t t = 0; t < flat.size(); ++t) {
    if (flat[t] != 0) part[t] = Part::flat;
    for (std::size_t k = 0; k < 3 && part[t] == Part::kept; ++k) {
      const int next = mesh.neighbors[t][k];
      if (next < 0 || flat[next] == 0 || is_constrained(mesh, t, k)) continue;
      if (n_nodes[region[next]] >= fewest_nodes && rise(mesh, t) < 1.5 * interval)
        part[t] = Part::beside;
    }
  }
  return part;
}

// Edges between triangles that are mended and triangles that are kept, but for constrained ones.
std::vector<std::array<int, 2>> border_of(const TriangleMesh& mesh, const std::vector<Part>& part) {
  std::vector<std::array<int, 2>> border;
  for (std::size_t t = 0; t < part.size(); ++t)
    for (std::size_t k = 0; k < 3 && part[t] != Part::kept; ++k) {
      const int next = mesh.neighbors[t][k];
      if (next < 0 || part[next] != Part::kept || is_constrained(mesh, t, k)) continue;
      border.push_back({mesh.triangles[t][(k + 1) % 3], mesh.triangles[t][(k + 2) % 3]});
    }
  return border;
}

// Squared inverse of the distance, in nodes, in which the ground around reaches the next contour.
std::vector<float> tension(const TriangleMesh& mesh, const Lattice& lattice,
                           const std::vector<Part>& part, double interval) {
  std::vector<float> tau(lattice.size(), 0);
  std::vector<std::uint8_t> known(lattice.size(), 0);
  for (std::size_t node = 0; node < lattice.size(); ++node) {
    const int t = lattice.triangle[node];
    if (t < 0 || part[t] != Part::kept) continue;
    known[node] = 1;
    tau[node] = static_cast<float>(std::min(slope(mesh, as_index(t)), steepest_slope));
  }
  spread_values(lattice.n_x, lattice.n_y, tau, std::move(known));
  const auto scale = static_cast<float>(lattice.spacing / interval);
  for (float& value : tau) value = value * scale * (value * scale);
  return tau;
}

// Whether a corner of the lattice cell at `at`, in nodes, is free.
bool touches_free_node(const PlateProblem& problem, const Vec2& at) {
  const auto n_x = as_index(problem.n_x);
  const auto corner = static_cast<std::size_t>(at.y()) * n_x + static_cast<std::size_t>(at.x());
  const auto is_free = [&](std::size_t node) {
    return problem.node[node] == PlateProblem::Node::free;
  };
  return is_free(corner) || is_free(corner + 1) || is_free(corner + n_x) ||
         is_free(corner + n_x + 1);
}

PlateProblem pose_problem(const TriangleMesh& mesh, const Lattice& lattice,
                          const std::vector<Part>& part, const std::vector<Vec3>& between,
                          double interval) {
  using Role = PlateProblem::Node;
  PlateProblem problem;
  problem.n_x = lattice.n_x;
  problem.n_y = lattice.n_y;
  problem.node.resize(lattice.size());
  std::transform(lattice.triangle.begin(), lattice.triangle.end(), problem.node.begin(),
                 [&](int t) {
                   if (t < 0) return Role::outside;
                   return part[t] == Part::kept ? Role::known : Role::free;
                 });
  problem.tension = tension(mesh, lattice, part, interval);
  const auto for_each_anchor = [&](const auto& visit) {
    for (const std::vector<Vec3>* points : {&mesh.points, &between})
      for (const Vec3& p : *points) {
        const Vec2 at = (p.head<2>() - lattice.low) / lattice.spacing;
        if (touches_free_node(problem, at)) visit(Vec3(at.x(), at.y(), p.z()));
      }
  };
  std::size_t n_anchors = 0;
  for_each_anchor([&](const Vec3&) { ++n_anchors; });
  problem.anchors.reserve(n_anchors);
  for_each_anchor([&](const Vec3& anchor) { problem.anchors.push_back(anchor); });
  return problem;
}

// Nodes are dense along lines and ever wider apart away from them, where the surface is smooth:
// a node of a lattice 2^n times as wide counts up to 2^n times the full density's distance.
bool is_wanted(std::size_t node, const Lattice& lattice, float distance) {
  const auto n_x = static_cast<std::size_t>(lattice.n_x);
  const int width = std::countr_zero(node % n_x | node / n_x | std::size_t{1} << 30);
  const double in_spacings = static_cast<double>(distance) / lattice.spacing;
  return in_spacings > nearest_in_spacings &&
         in_spacings <= std::ldexp(full_density_in_spacings, width);
}

double bounded_height(const TriangleMesh& mesh, int t, Part part, double height, double interval) {
  const auto& [a, b, c] = mesh.triangles[t];
  const auto [low, high] =
      std::minmax({mesh.points[a].z(), mesh.points[b].z(), mesh.points[c].z()});
  if (part == Part::beside) return bend_into(height, low, high);
  return bend_into(height, low - interval / 2, low + interval / 2);
}

}  // namespace

std::vector<std::uint8_t> find_flat_triangles(const TriangleMesh& mesh, MeasuredPoints measured) {
  std::vector<std::uint8_t> flat(mesh.triangles.size(), 0);
  for (std::size_t t = 0; t < flat.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const auto [low, high] =
        std::minmax({mesh.points[a].z(), mesh.points[b].z(), mesh.points[c].z()});
    const bool on_contours = std::none_of(
        mesh.triangles[t].begin(), mesh.triangles[t].end(),
        [&](int corner) { return corner >= measured.first && corner < measured.last; });
    flat[t] = on_contours && high - low <= same_height_m ? 1 : 0;
  }
  return flat;
}

AreaShare area_of(const TriangleMesh& mesh, const std::vector<std::uint8_t>& marked) {
  AreaShare area;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    area.all_m2 += plan_area(mesh, t);
    if (marked[t] != 0) area.marked_m2 += plan_area(mesh, t);
  }
  return area;
}

double finest_spacing(const TriangleMesh& mesh) {
  Vec2 low = mesh.points.front().head<2>(), high = low;
  for (const Vec3& p : mesh.points)
    low = low.cwiseMin(p.head<2>()), high = high.cwiseMax(p.head<2>());
  const Vec2 extent = high - low;
  return std::max(std::sqrt(extent.x() * extent.y() / most_nodes), extent.maxCoeff() / most_nodes);
}

double lattice_spacing(const TriangleMesh& mesh) {
  double length = 0, area = 0;
  std::size_t n_segments = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    area += plan_area(mesh, t);
    for (std::size_t k = 0; k < 3; ++k) {
      if (!is_constrained(mesh, t, k) || mesh.neighbors[t][k] > static_cast<int>(t)) continue;
      const Vec3& a = mesh.points[mesh.triangles[t][(k + 1) % 3]];
      length += (mesh.points[mesh.triangles[t][(k + 2) % 3]] - a).head<2>().norm();
      ++n_segments;
    }
  }
  if (n_segments == 0) return std::sqrt(area / static_cast<double>(mesh.points.size()));
  return std::max(spacing_in_segments * length / static_cast<double>(n_segments),
                  area / length / nodes_per_contour_distance);
}

double bend_into(double value, double low, double high) {
  constexpr double border = 0.2;
  const double share = (value - low) / (high - low);
  if (share < border) return low + (high - low) * border * std::exp((share - border) / border);
  if (share > 1 - border)
    return high - (high - low) * border * std::exp((1 - border - share) / border);
  return value;
}

MendingPoints mend_flat_triangles(TriangleMesh& mesh, const std::vector<std::uint8_t>& flat,
                                  const FlatMending& mending, const ProgressFunction& progress) {
  TALUS_ASSERT(mending.contour_interval > 0);
  MendingPoints mended;
  mended.spacing =
      std::max(mending.spacing > 0 ? mending.spacing : lattice_spacing(mesh), finest_spacing(mesh));
  const Lattice lattice = lay_lattice(mesh, mended.spacing);
  const std::vector<Part> part = find_parts(mesh, flat, lattice, mending.contour_interval);
  mended.border = border_of(mesh, part);
  const std::vector<Vec3> between = points_between(mesh, mended.spacing);
  mesh.neighbors = {};
  mesh.constrained = {};
  const auto height_of = [&](std::size_t node) {
    return height_in_triangle(mesh, lattice.triangle[node], lattice.place(node));
  };
  const PlateSolution plate = solve_plate(
      pose_problem(mesh, lattice, part, between, mending.contour_interval), height_of, progress);
  mended.n_regions = plate.n_regions;
  mended.n_unsolved = plate.n_unsolved;
  const std::vector<float> distance = distance_to_points(lattice, mesh.points, between);
  std::size_t unknown = 0;
  for (std::size_t node = 0; node < lattice.size(); ++node) {
    const int t = lattice.triangle[node];
    if (t < 0 || part[t] == Part::kept) continue;
    const double solved = plate.height[unknown++];
    if (!std::isfinite(solved) || !is_wanted(node, lattice, distance[node])) continue;
    const double height = bounded_height(mesh, t, part[t], solved, mending.contour_interval);
    mended.largest_change = std::max(mended.largest_change, std::abs(height - height_of(node)));
    mended.points.emplace_back(lattice.place(node).x(), lattice.place(node).y(), height);
  }
  return mended;
}

}  // namespace talus
