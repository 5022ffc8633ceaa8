// The source: its area, its failure surface, and the mass between that and the ground.
#include "blocks/source.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "base/text.hpp"
#include "blocks/area_clip.hpp"
#include "blocks/prepared_area.hpp"
#include "geometry/plan2d.hpp"
#include "terrain/extent_text.hpp"

namespace talus {
namespace {

// Nodes of the TRN inside the area; throws when they are too few or unknown.
std::vector<int> nodes_inside(const Trn& ground, const Area& area, const Where& where) {
  for (const auto& ring : area.rings)
    for (const Vec2& p : ring)
      if (!contains(ground, p.x(), p.y())) {
        Doubt doubt = doubt_on(
            where,
            "the source area reaches outside the terrain at (" + place_text(p, ground.origin) +
                "); " + extent_text(ground),
            "move the source or make the terrain larger; if it lies far away, check the order (x "
            "east, y north) and the coordinate system of its points");
        doubt.at = {{p.x() + ground.origin.x(), p.y() + ground.origin.y(), Doubt::none}};
        throw InputError(std::move(doubt));
      }
  const PreparedArea prepared(area);
  std::vector<int> nodes;
  for (int r = 0; r < ground.n_rows; ++r)
    for (int c = 0; c < ground.n_cols; ++c) {
      const Vec2 p(ground.node0.x() + c * ground.cell_size,
                   ground.node0.y() - r * ground.cell_size);
      if (prepared.contains(p)) nodes.push_back(static_cast<int>(node_index(ground, r, c)));
    }
  if (nodes.empty())
    throw InputError(where,
                     "no node of the terrain lies in the source area of " + text(area_of(area), 4) +
                         " m2; the cells are " + text(ground.cell_size, 4) + " m",
                     "make the TRN with a smaller --cell-size-m, or the area larger");
  return nodes;
}

std::array<size_t, 3> triangle_nodes(const Trn& trn, int triangle) {
  const auto [r, c] = cell_of_triangle(trn, triangle);
  const size_t north_west = node_index(trn, r, c), south_east = node_index(trn, r + 1, c + 1);
  if (triangle % 2 == 0) return {north_west, node_index(trn, r + 1, c), south_east};
  return {north_west, south_east, node_index(trn, r, c + 1)};
}

// Corners of the triangles that the area overlaps, ascending: below all of it the bed is then the
// failure surface.
std::vector<int> corners_of(const Trn& ground, const std::vector<TriangleInArea>& triangles) {
  std::vector<int> nodes;
  for (const TriangleInArea& one : triangles)
    for (const size_t node : triangle_nodes(ground, one.triangle))
      nodes.push_back(static_cast<int>(node));
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

Vec2 place_of(const Trn& trn, int node) {
  const int r = node / trn.n_cols, c = node % trn.n_cols;
  return {trn.node0.x() + c * trn.cell_size, trn.node0.y() - r * trn.cell_size};
}

bool has_node(const Trn& trn, int r, int c) {
  return r >= 0 && c >= 0 && r < trn.n_rows && c < trn.n_cols;
}

void check_known(const Trn& ground, const std::vector<int>& nodes, const Where& where) {
  for (const int node : nodes) {
    const int r = node / ground.n_cols, c = node % ground.n_cols;
    for (int dr = -1; dr <= 1; ++dr)
      for (int dc = -1; dc <= 1; ++dc) {
        const bool exists = has_node(ground, r + dr, c + dc);
        if (exists && !std::isnan(ground.elevation[node_index(ground, r + dr, c + dc)])) continue;
        const Vec2 p(ground.node0.x() + c * ground.cell_size,
                     ground.node0.y() - r * ground.cell_size);
        throw InputError(where,
                         std::string("the source area touches ") +
                             (exists ? "nodata" : "the edge of the terrain") + " at (" +
                             place_text(p, ground.origin) + ")",
                         "fill the terrain there, or keep the source two cells away from it");
      }
  }
}

// Slope by central differences over the two neighbours of a node along each axis.
double cosine_of_slope(const Trn& ground, int node) {
  const size_t i = static_cast<size_t>(node), row = static_cast<size_t>(ground.n_cols);
  const double dz_dx = (ground.elevation[i + 1] - ground.elevation[i - 1]) / (2 * ground.cell_size);
  const double dz_dy =
      (ground.elevation[i - row] - ground.elevation[i + row]) / (2 * ground.cell_size);
  return 1 / std::sqrt(1 + dz_dx * dz_dx + dz_dy * dz_dy);
}

double height_of(const SurfacePlane& plane, const Vec2& p) {
  const Vec3 n = pole(plane.dip, plane.dip_direction);
  return plane.point.z() -
         (n.x() * (p.x() - plane.point.x()) + n.y() * (p.y() - plane.point.y())) / n.z();
}

double plane_elevation(const SourceOptions& options, const Vec2& p) {
  double z = height_of({options.plane_dip, options.plane_dip_direction, options.plane_point}, p);
  for (const SurfacePlane& plane : options.more_planes) z = std::max(z, height_of(plane, p));
  return z;
}

// Sloping local base level: a node goes down to the mean of its highest and lowest of four
// neighbours minus C, sweep by sweep, until none moves by more than a micrometre. Along a profile
// this is a parabola with a second derivative of 2 C / cell^2. Neighbours of a node exist: the
// source keeps a cell away from the edge of the terrain. Returns how far the nodes would still go
// when they have not come to rest, from the last moves, which shrink by a constant ratio.
double lower_to_base_level(const Trn& ground, const std::vector<int>& nodes,
                           const SourceOptions& options, std::vector<double>& z) {
  constexpr int max_sweeps = 20000;
  const int row = ground.n_cols;
  double largest_move = 0, move_before = 0;
  for (int sweep = 0; sweep < max_sweeps; ++sweep) {
    move_before = largest_move, largest_move = 0;
    for (const int node : nodes) {
      const auto [low, high] =
          std::minmax({z[node - 1], z[node + 1], z[node - row], z[node + row]});
      double base = std::min(z[node], (low + high) / 2 - options.slbl_curvature);
      if (options.slbl_max_depth > 0)
        base = std::max(base, ground.elevation[node] - options.slbl_max_depth);
      largest_move = std::max(largest_move, z[node] - base);
      z[node] = base;
    }
    if (largest_move < 1e-6) return 0;
  }
  return largest_move * largest_move / std::max(move_before - largest_move, 1e-12);
}

double surface_at(const Trn& ground, int node, const SourceOptions& options, const Where& where) {
  const Vec2 p = place_of(ground, node);
  switch (options.kind) {
    case FailureSurface::vertical_depth:
      return ground.elevation[node] - options.depth;
    case FailureSurface::normal_depth:
      return ground.elevation[node] - options.depth / cosine_of_slope(ground, node);
    case FailureSurface::plane:
      return plane_elevation(options, p);
    case FailureSurface::slbl:
      return ground.elevation[node];
    case FailureSurface::raster:
      break;
  }
  if (std::isnan(options.raster[node]))
    throw InputError(where,
                     "the failure surface has no data at (" + place_text(p, ground.origin) + ")",
                     "the raster must cover the whole source area");
  return options.raster[node];
}

// Depth below the ground of the failure raster at its known nodes nearest to `node`, their mean
// where several are as near.
double nearest_raster_depth(const Trn& ground, const std::vector<int>& nodes, int node,
                            const SourceOptions& options) {
  double nearest_sq = std::numeric_limits<double>::infinity(), sum = 0;
  int n = 0;
  for (const int other : nodes) {
    if (std::isnan(options.raster[other])) continue;
    const double dr = other / ground.n_cols - node / ground.n_cols;
    const double dc = other % ground.n_cols - node % ground.n_cols;
    const double distance_sq = dr * dr + dc * dc;
    if (distance_sq > nearest_sq) continue;
    if (distance_sq < nearest_sq) nearest_sq = distance_sq, sum = 0, n = 0;
    sum += ground.elevation[other] - options.raster[other];
    ++n;
  }
  return n > 0 ? sum / n : 0;
}

// Lowers `nodes` to the failure surface, never raises them. The sloping local base level starts
// from the ground.
void lower_to_surface(const Trn& ground, const Area& area, const std::vector<int>& nodes,
                      const SourceOptions& options, const Where& where, SourceMass& mass) {
  const PreparedArea prepared(area);
  for (const int node : nodes) {
    const bool is_inside = prepared.contains(place_of(ground, node));
    double z;
    if (!is_inside && options.kind == FailureSurface::raster && std::isnan(options.raster[node])) {
      z = ground.elevation[node] - nearest_raster_depth(ground, nodes, node, options);
      ++mass.n_extended;
    } else {
      z = surface_at(ground, node, options, where);
    }
    if (is_inside && z > ground.elevation[node]) ++mass.n_above_ground;
    mass.bed.elevation[node] = std::min(z, ground.elevation[node]);
  }
}

// Of the plane of a triangle, also beside it.
double elevation_on(const Trn& trn, int triangle, const Vec2& p) {
  const Vec3 corner = triangle_corners(trn, triangle)[0];
  return corner.z() + triangle_gradient(trn, triangle).dot(p - corner.head<2>());
}

struct RingMeasure {
  double area = 0;             // [m2]
  Vec2 centre = Vec2::Zero();  // of area
};

RingMeasure measure_convex(const std::vector<Vec2>& ring) {
  RingMeasure measure;
  Vec2 moment = Vec2::Zero();
  for (size_t k = 1; k + 1 < ring.size(); ++k) {
    const Vec2 a = ring[k] - ring[0], b = ring[k + 1] - ring[0];
    const double area = cross(a, b) / 2;
    measure.area += area;
    moment += area * (a + b) / 3;
  }
  measure.centre = ring[0];
  if (measure.area > 0) measure.centre += moment / measure.area;
  return measure;
}

// The prism over a piece of a triangle: depth is linear there, so its volume is exact.
void add_prism(const Trn& ground, const Trn& bed, int triangle, const std::vector<Vec2>& piece,
               MassMeasure& mass) {
  const RingMeasure measure = measure_convex(piece);
  const double area = measure.area;
  const Vec2& centre = measure.centre;
  mass.volume +=
      area * (elevation_on(ground, triangle, centre) - elevation_on(bed, triangle, centre));
  mass.plan_area += area;
  for (const Trn* trn : {&ground, &bed}) {
    const Vec2 gradient = triangle_gradient(*trn, triangle);
    mass.area_vectors.emplace_back(-area * gradient.x(), -area * gradient.y(), area);
  }
  for (const Vec2& p : piece) {
    const double high = elevation_on(ground, triangle, p), low = elevation_on(bed, triangle, p);
    mass.vertices.emplace_back(p.x(), p.y(), high);
    mass.vertices.emplace_back(p.x(), p.y(), low);
    mass.max_depth = std::max(mass.max_depth, high - low);
  }
}

// Where a value that goes from `first` to `last` passes whole numbers, as shares of the path.
void add_whole_numbers(double first, double last, std::vector<double>& shares) {
  for (double k = std::ceil(std::min(first, last)); k <= std::max(first, last); ++k)
    if (first != last) shares.push_back((k - first) / (last - first));
}

// The wall of the mass along a side; its height is linear between grid lines and diagonals.
void add_wall(const Trn& ground, const Trn& bed, const AreaSide& side, MassMeasure& mass) {
  const auto east_south = [&](const Vec2& p) -> Vec2 {
    return Vec2((p - ground.node0).x(), (ground.node0 - p).y()) / ground.cell_size;
  };
  const Vec2 a = east_south(side.start);
  const Vec2 b = east_south(side.start + side.length * side.direction);
  std::vector<double> shares = {0, 1};
  add_whole_numbers(a.x(), b.x(), shares);
  add_whole_numbers(a.y(), b.y(), shares);
  add_whole_numbers(a.x() - a.y(), b.x() - b.y(), shares);
  std::sort(shares.begin(), shares.end());
  const auto height = [&](double share) {
    const Vec2 p = side.start + share * side.length * side.direction;
    return elevation_at(ground, p.x(), p.y()) - elevation_at(bed, p.x(), p.y());
  };
  double area = 0;
  for (size_t k = 0; k + 1 < shares.size(); ++k)
    area +=
        (shares[k + 1] - shares[k]) * side.length * (height(shares[k]) + height(shares[k + 1])) / 2;
  mass.area_vectors.push_back(area * side.plane.normal);
}

}  // namespace

double prism_volume(const Trn& ground, const Trn& bed) {
  double sum = 0;
  const auto depth = [&](int r, int c) {
    const size_t i = node_index(ground, r, c);
    return ground.elevation[i] - bed.elevation[i];
  };
  for (int r = 0; r + 1 < ground.n_rows; ++r)
    for (int c = 0; c + 1 < ground.n_cols; ++c) {
      const double lower_left = depth(r, c) + depth(r + 1, c) + depth(r + 1, c + 1);
      const double upper_right = depth(r, c) + depth(r + 1, c + 1) + depth(r, c + 1);
      if (std::isfinite(lower_left)) sum += lower_left;
      if (std::isfinite(upper_right)) sum += upper_right;
    }
  return sum * ground.cell_size * ground.cell_size / 6;
}

MassMeasure measure_mass(const Trn& ground, const Trn& bed, const Area& area) {
  MassMeasure mass;
  for (const TriangleInArea& one : triangles_in(ground, area)) {
    if (!is_known(ground, one.triangle) ||
        triangle_corners(ground, one.triangle) == triangle_corners(bed, one.triangle))
      continue;
    for (const auto& piece : one.pieces) add_prism(ground, bed, one.triangle, piece, mass);
  }
  for (const AreaSide& side : sides_of(area)) add_wall(ground, bed, side, mass);
  return mass;
}

SourceMass find_source(const Trn& ground, const Area& area, const SourceOptions& options,
                       const Where& where) {
  check_area(area, ground.origin, where);
  SourceMass mass;
  const std::vector<int> inside = nodes_inside(ground, area, where);
  const std::vector<int> below = corners_of(ground, triangles_in(ground, area));
  check_known(ground, inside, where);
  check_known(ground, below, where);
  mass.bed = ground;
  lower_to_surface(ground, area, below, options, where, mass);
  if (options.kind == FailureSurface::slbl)
    mass.slbl_unsettled = lower_to_base_level(ground, inside, options, mass.bed.elevation);
  Trn bed = std::move(mass.bed);
  return mass_over(ground, area, std::move(mass), std::move(bed), where);
}

SourceMass mass_over(const Trn& ground, const Area& area, SourceMass mass, Trn bed,
                     const Where& where) {
  mass.bed = std::move(bed);
  mass.nodes.clear();
  for (size_t node = 0; node < ground.elevation.size(); ++node)
    if (mass.bed.elevation[node] < ground.elevation[node])
      mass.nodes.push_back(static_cast<int>(node));
  const MassMeasure measure = measure_mass(ground, mass.bed, area);
  if (mass.nodes.empty() || !(measure.volume > 0))
    throw InputError(where, "the failure surface lies nowhere below the ground inside the source",
                     "check depth, plane or raster, and that elevations are in the same datum");
  mass.polygon_area = area_of(area);
  mass.volume = measure.volume;
  mass.area = measure.plan_area;
  mass.mean_depth = measure.volume / measure.plan_area;
  mass.max_depth = measure.max_depth;
  return mass;
}

}  // namespace talus
