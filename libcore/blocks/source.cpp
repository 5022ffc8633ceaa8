#include "blocks/source.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/text.hpp"
#include "terrain/extent_text.hpp"

namespace talus {
namespace {

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

double ring_area(const std::vector<Vec2>& ring) {
  double twice = 0;
  for (size_t k = 0; k < ring.size(); ++k)
    twice += cross(ring[k] - ring[0], ring[(k + 1) % ring.size()] - ring[0]);
  return twice / 2;
}

bool on_segment(const Vec2& a, const Vec2& b, const Vec2& p) {
  const Vec2 along = b - a;
  const double length_sq = along.squaredNorm();
  if (length_sq == 0) return (p - a).squaredNorm() == 0;
  const double t = (p - a).dot(along) / length_sq;
  return t >= 0 && t <= 1 && std::abs(cross(along, p - a)) <= 1e-9 * length_sq;
}

struct Segment {
  Vec2 a, b;
  size_t ring, index, n;  // of its ring
};

// Neighbours share an end; anything more is a fault, as is any touch of other segments.
bool collide(const Segment& s, const Segment& t) {
  const bool follows = s.ring == t.ring && (s.index + 1) % s.n == t.index;
  const bool precedes = s.ring == t.ring && (t.index + 1) % t.n == s.index;
  if (follows || precedes) {
    const Vec2& far = follows ? t.b : t.a;  // the end that is not shared
    return s.n > 2 && on_segment(s.a, s.b, far);
  }
  const double d1 = cross(s.b - s.a, t.a - s.a), d2 = cross(s.b - s.a, t.b - s.a);
  const double d3 = cross(t.b - t.a, s.a - t.a), d4 = cross(t.b - t.a, s.b - t.a);
  if (((d1 > 0) != (d2 > 0)) && ((d3 > 0) != (d4 > 0)) && d1 != 0 && d2 != 0 && d3 != 0 && d4 != 0)
    return true;
  return on_segment(s.a, s.b, t.a) || on_segment(s.a, s.b, t.b) || on_segment(t.a, t.b, s.a) ||
         on_segment(t.a, t.b, s.b);
}

std::string place_text(const Vec2& local, const Vec3& origin) {
  return "(" + text(local.x() + origin.x(), 10) + ", " + text(local.y() + origin.y(), 10) + ")";
}

InputError crossing(const Segment& s, const Segment& t, const Vec3& origin, const Where& where) {
  const auto ends = [&](const Segment& side) {
    return place_text(side.a, origin) + " and " + place_text(side.b, origin);
  };
  if (s.ring == t.ring)
    return {where,
            "the source area crosses itself between " + ends(s) + ", where " +
                place_text(t.a, origin) + " - " + place_text(t.b, origin) + " meets it",
            "put the corners in order around the area"};
  return {where,
          "two outlines of the source area meet: the side between " + ends(s) +
              " and that between " + ends(t),
          "dissolve areas that share a side into one; a hole must not touch the outline"};
}

// Nodes of the TRN inside the area; throws when they are too few or unknown.
std::vector<int> nodes_inside(const Trn& ground, const Area& area, const Where& where) {
  for (const auto& ring : area.rings)
    for (const Vec2& p : ring)
      if (!contains(ground, p.x(), p.y()))
        throw InputError(where,
                         "the source area reaches outside the terrain at " +
                             place_text(p, ground.origin) + "; " + extent_text(ground),
                         "move the source or make the terrain larger; if it lies far away, check "
                         "the order (x east, y north) and the coordinate system of its points");
  std::vector<int> nodes;
  for (int r = 0; r < ground.n_rows; ++r)
    for (int c = 0; c < ground.n_cols; ++c) {
      const Vec2 p(ground.node0.x() + c * ground.cell_size,
                   ground.node0.y() - r * ground.cell_size);
      if (contains(area, p)) nodes.push_back(static_cast<int>(node_index(ground, r, c)));
    }
  if (nodes.empty())
    throw InputError(where,
                     "no node of the terrain lies in the source area of " + text(area_of(area), 4) +
                         " m2; the cells are " + text(ground.cell_size, 4) + " m",
                     "make the TRN with a smaller --cell-size-m, or the area larger");
  return nodes;
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
                             (exists ? "nodata" : "the edge of the terrain") + " at " +
                             place_text(p, ground.origin),
                         "fill the terrain there, or keep the source a cell away from it");
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

double plane_elevation(const SourceOptions& options, const Vec2& p) {
  const Vec3 n = pole(options.plane_dip, options.plane_dip_direction);
  return options.plane_point.z() -
         (n.x() * (p.x() - options.plane_point.x()) + n.y() * (p.y() - options.plane_point.y())) /
             n.z();
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
  const int r = node / ground.n_cols, c = node % ground.n_cols;
  const Vec2 p(ground.node0.x() + c * ground.cell_size, ground.node0.y() - r * ground.cell_size);
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
    throw InputError(where, "the failure surface has no data at " + place_text(p, ground.origin),
                     "the raster must cover the whole source area");
  return options.raster[node];
}

}  // namespace

Area without_repeated_corners(Area area) {
  for (auto& ring : area.rings) {
    ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
    while (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
  }
  return area;
}

bool contains(const Area& area, const Vec2& point) {
  bool inside = false;
  for (const auto& ring : area.rings)
    for (size_t k = 0; k < ring.size(); ++k) {
      const Vec2 &a = ring[k], &b = ring[(k + 1) % ring.size()];
      if (on_segment(a, b, point)) return true;
      if ((a.y() > point.y()) == (b.y() > point.y())) continue;
      const double x = a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
      if (point.x() < x) inside = !inside;
    }
  return inside;
}

double area_of(const Area& area) {
  double sum = 0;
  for (size_t i = 0; i < area.rings.size(); ++i) {
    int n_around = 0;
    for (size_t j = 0; j < area.rings.size(); ++j)
      n_around += i != j && contains(Area{{area.rings[j]}}, area.rings[i][0]);
    sum += (n_around % 2 ? -1 : 1) * std::abs(ring_area(area.rings[i]));
  }
  return sum;
}

void check_area(const Area& area, const Vec3& origin, const Where& where) {
  if (area.rings.empty()) throw InputError(where, "the source area is empty");
  std::vector<Segment> segments;
  for (size_t i = 0; i < area.rings.size(); ++i) {
    const auto& ring = area.rings[i];
    for (const Vec2& p : ring)
      if (!p.allFinite()) throw InputError(where, "a corner of the source area is not finite");
    if (ring.size() < 3 || std::abs(ring_area(ring)) == 0)
      throw InputError(where, "a ring of the source area has no area",
                       "give at least three corners that are not in line");
    for (size_t k = 0; k < ring.size(); ++k)
      segments.push_back({ring[k], ring[(k + 1) % ring.size()], i, k, ring.size()});
  }
  for (size_t i = 0; i < segments.size(); ++i)
    for (size_t j = i + 1; j < segments.size(); ++j)
      if (collide(segments[i], segments[j]))
        throw crossing(segments[i], segments[j], origin, where);
}

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

MassMeasure measure_mass(const Trn& ground, const Trn& bed) {
  MassMeasure mass;
  mass.volume = prism_volume(ground, bed);
  for (int t = 0; t < n_triangles(ground); ++t) {
    const auto above = triangle_corners(ground, t), below = triangle_corners(bed, t);
    if (!is_known(ground, t) || above == below) continue;
    for (const auto& corners : {above, below}) {
      mass.vertices.insert(mass.vertices.end(), corners.begin(), corners.end());
      mass.area_vectors.push_back((corners[1] - corners[0]).cross(corners[2] - corners[0]) / 2);
    }
  }
  return mass;
}

SourceMass find_source(const Trn& ground, const Area& area, const SourceOptions& options,
                       const Where& where) {
  check_area(area, ground.origin, where);
  SourceMass mass;
  const std::vector<int> inside = nodes_inside(ground, area, where);
  check_known(ground, inside, where);
  mass.bed = ground;
  mass.polygon_area = area_of(area);
  for (const int node : inside) {
    const double z = surface_at(ground, node, options, where);
    if (z > ground.elevation[node]) ++mass.n_above_ground;
    mass.bed.elevation[node] = std::min(z, ground.elevation[node]);
  }
  if (options.kind == FailureSurface::slbl)
    mass.slbl_unsettled = lower_to_base_level(ground, inside, options, mass.bed.elevation);
  double sum = 0;
  for (const int node : inside) {
    const double depth = ground.elevation[node] - mass.bed.elevation[node];
    if (depth <= 0) continue;
    mass.nodes.push_back(node);
    mass.max_depth = std::max(mass.max_depth, depth);
    sum += depth;
  }
  if (mass.nodes.empty())
    throw InputError(where, "the failure surface lies nowhere below the ground inside the source",
                     "check depth, plane or raster, and that elevations are in the same datum");
  mass.mean_depth = sum / static_cast<double>(mass.nodes.size());
  mass.volume = prism_volume(ground, mass.bed);
  return mass;
}

}  // namespace talus
