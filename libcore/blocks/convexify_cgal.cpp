// blocks/convexify.hpp with CGAL: convex hulls of the pieces, supporting planes of the bed,
// volume kept.
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "blocks/block_set.hpp"
#include "blocks/convexify.hpp"
#include "blocks/cut.hpp"
#include "blocks/solid.hpp"
#include "geometry/face_overlap.hpp"

namespace talus {
namespace {

double volume_of(const Polyhedron& body) { return n_faces(body) > 0 ? moments(body).volume : 0; }

double largest_along(const Polyhedron& body, const Vec3& direction) {
  double largest = -std::numeric_limits<double>::infinity();
  for (const Vec3& v : body.vertices) largest = std::max(largest, direction.dot(v));
  return largest;
}

// A triangle of the bed: the rock is below its plane, within its three vertical sides.
struct Facet {
  std::array<Vec3, 3> corners;
  Plane above;                 // inside = above the bed
  std::array<Plane, 3> sides;  // inside = over the triangle
};

Facet facet_of(const Trn& bed, int triangle) {
  const auto corners = triangle_corners(bed, triangle);
  const TrianglePlane plane = triangle_plane(bed, triangle);
  Facet facet;
  facet.corners = corners;
  facet.above = plane_through(plane.point, -plane.normal);
  for (int k = 0; k < 3; ++k) {
    const Vec3 along = corners[(k + 1) % 3] - corners[k];
    const Vec3 outward = Vec3(along.y(), -along.x(), 0).normalized();
    facet.sides[k] = plane_through(corners[k], outward);
  }
  return facet;
}

// The triangles of the bed below the box of a body.
std::vector<Facet> facets_below(const Trn& bed, const Polyhedron& body) {
  Vec3 low = body.vertices[0], high = low;
  for (const Vec3& v : body.vertices) low = low.cwiseMin(v), high = high.cwiseMax(v);
  const auto column = [&](double x) {
    return std::clamp(static_cast<int>(std::floor((x - bed.node0.x()) / bed.cell_size)), 0,
                      bed.n_cols - 2);
  };
  const auto row = [&](double y) {
    return std::clamp(static_cast<int>(std::floor((bed.node0.y() - y) / bed.cell_size)), 0,
                      bed.n_rows - 2);
  };
  std::vector<Facet> facets;
  for (int r = row(high.y()); r <= row(low.y()); ++r)
    for (int c = column(low.x()); c <= column(high.x()); ++c)
      for (int half = 0; half < 2; ++half) {
        const int triangle = 2 * ((bed.n_cols - 1) * r + c) + half;
        if (is_known(bed, triangle)) facets.push_back(facet_of(bed, triangle));
      }
  return facets;
}

// Supporting planes of the body at its faces that look down or sideways, and at its box: a facet
// outside of one has no part of the body at it or below it.
std::vector<Plane> lower_planes(const Polyhedron& body) {
  std::vector<Plane> planes;
  for (int f = 0; f < n_faces(body); ++f) {
    const Vec3 normal = face_normal(body, f);
    if (normal.z() <= 0) planes.push_back({normal, largest_along(body, normal)});
  }
  for (const Vec3& side : {Vec3(-1, 0, 0), Vec3(1, 0, 0), Vec3(0, -1, 0), Vec3(0, 1, 0)})
    planes.push_back({side, largest_along(body, side)});
  return planes;
}

// Leaves out facets that the body clears by so much that no tolerance makes an overlap: where it
// covers thousands, nearly all are such. A body that is cut clears them for good.
void leave_out_cleared(std::vector<Facet>& facets, const Polyhedron& body, double tolerance) {
  const std::vector<Plane> planes = lower_planes(body);
  std::erase_if(facets, [&](const Facet& facet) {
    return std::any_of(planes.begin(), planes.end(), [&](const Plane& plane) {
      return std::all_of(facet.corners.begin(), facet.corners.end(), [&](const Vec3& corner) {
        return distance(plane, corner) > 1000 * tolerance;
      });
    });
  });
}

// The part of the body in the rock below the facet.
Polyhedron overlap(const Polyhedron& body, const Facet& facet, double tolerance) {
  const bool is_clear = std::all_of(body.vertices.begin(), body.vertices.end(), [&](const Vec3& v) {
    return distance(facet.above, v) <= tolerance;
  });
  if (is_clear) return {};
  Polyhedron part = clip_convex(body, flipped(facet.above), 0, tolerance);
  for (const Plane& side : facet.sides)
    if (n_faces(part) > 0) part = clip_convex(part, side, 0, tolerance);
  return part;
}

// Half-space above the plane with this upward normal that just clears the points of `rock`.
Plane clearing(const Vec3& upward, const Polyhedron& rock) {
  return {-upward, -largest_along(rock, upward)};
}

struct Overlaps {
  std::vector<Polyhedron> parts;
  std::vector<Vec3> normals;  // upward, of the facets
  int largest = -1;           // part with the largest volume
};

// Leaves out facets that can have none, now and when more is cut off the body.
Overlaps find_overlaps(const Polyhedron& body, std::vector<Facet>& facets, double tolerance) {
  leave_out_cleared(facets, body, tolerance);
  Overlaps found;
  double largest_volume = 0;
  for (const Facet& facet : facets) {
    Polyhedron part = overlap(body, facet, tolerance);
    if (n_faces(part) == 0) continue;
    const double volume = volume_of(part);
    if (found.largest < 0 || volume > largest_volume) {
      found.largest = static_cast<int>(found.parts.size());
      largest_volume = volume;
    }
    found.parts.push_back(std::move(part));
    found.normals.push_back(-facet.above.normal);
  }
  return found;
}

// One plane above all of the bed.
Polyhedron raised_off_at_once(Polyhedron body, std::vector<Facet> facets, const Vec3& normal,
                              double tolerance) {
  const Overlaps overlaps = find_overlaps(body, facets, tolerance);
  double offset = -std::numeric_limits<double>::infinity();
  for (const Polyhedron& part : overlaps.parts)
    offset = std::max(offset, largest_along(part, normal));
  if (overlaps.largest < 0) return body;
  return clip_convex(body, {-normal, -offset}, face_failure, tolerance);
}

// One plane after the other, each clearing the largest overlap left; of the normals that `choose`
// gives, the one that costs least.
template <class Choose>
Polyhedron raised_off_by_steps(Polyhedron body, std::vector<Facet> facets, Choose choose,
                               double tolerance) {
  const size_t most_steps = facets.size();
  for (size_t step = 0; step <= most_steps && n_faces(body) > 0; ++step) {
    const Overlaps overlaps = find_overlaps(body, facets, tolerance);
    if (overlaps.largest < 0) return body;
    Polyhedron best;
    double best_volume = -1;
    for (const Vec3& normal : choose(overlaps)) {
      Polyhedron kept = clip_convex(body, clearing(normal, overlaps.parts[overlaps.largest]),
                                    face_failure, tolerance);
      const double volume = volume_of(kept);
      if (volume > best_volume) best = std::move(kept), best_volume = volume;
    }
    body = std::move(best);
  }
  return body;
}

// The largest convex body above the bed among those tried here.
Polyhedron raised_off(const Polyhedron& body, const Trn& bed, const Vec3& mean_normal,
                      double tolerance) {
  if (n_faces(body) == 0) return body;
  const std::vector<Facet> facets = facets_below(bed, body);
  constexpr size_t max_choices = 24;
  const auto own = [](const Overlaps& o) { return std::vector<Vec3>{o.normals[o.largest]}; };
  const auto any = [&](const Overlaps& o) {
    std::vector<Vec3> normals = {o.normals[o.largest], mean_normal};
    for (size_t k = 0; k < std::min(o.normals.size(), max_choices); ++k)
      normals.push_back(o.normals[k]);
    return normals;
  };
  Polyhedron best = raised_off_by_steps(body, facets, own, tolerance);
  for (Polyhedron other : {raised_off_at_once(body, facets, mean_normal, tolerance),
                           raised_off_by_steps(body, facets, any, tolerance)})
    if (volume_of(other) > volume_of(best)) best = std::move(other);
  return best;
}

// Lowers the plane with this normal, from `high` down, until the volume is `wanted`: safeguarded
// false position (Illinois), since the volume grows monotonically with the height.
Polyhedron cut_to_volume(const Polyhedron& body, const Vec3& normal, double low, double high,
                         double wanted, double tolerance) {
  const auto below = [&](double offset) {
    return clip_convex(body, {normal, offset}, face_terrain, tolerance);
  };
  double excess_low = -wanted, excess_high = volume_of(below(high)) - wanted;
  if (excess_high <= 0) return below(high);
  int last_side = 0;
  for (int round = 0; round < 100 && high - low > tolerance; ++round) {
    const double middle = (low * excess_high - high * excess_low) / (excess_high - excess_low);
    const double excess = volume_of(below(middle)) - wanted;
    if (std::abs(excess) <= 1e-13 * wanted) return below(middle);
    if (excess > 0) {
      high = middle, excess_high = excess;
      if (last_side > 0) excess_low /= 2;
      last_side = 1;
    } else {
      low = middle, excess_low = excess;
      if (last_side < 0) excess_high /= 2;
      last_side = -1;
    }
  }
  return below((low + high) / 2);
}

// Shape of a block from its cells.
struct RockShape {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 high = -low;
  Vec3 terrain_normal = Vec3::Zero();  // upward, mean; zero when the block has no such face
  Vec3 bed_normal = Vec3::Zero();
};

Vec3 upward_unit(Vec3 sum, double size) {
  if (sum.norm() < 1e-12 * size * size) return Vec3::Zero();
  return sum.z() < 0 ? Vec3(-sum.normalized()) : Vec3(sum.normalized());
}

RockShape shape_of(const std::vector<Polyhedron>& cells) {
  RockShape shape;
  Vec3 terrain = Vec3::Zero(), failure = Vec3::Zero();
  for (const Polyhedron& cell : cells) {
    for (const Vec3& v : cell.vertices)
      shape.low = shape.low.cwiseMin(v), shape.high = shape.high.cwiseMax(v);
    for (int f = 0; f < n_faces(cell); ++f) {
      if (cell.face_tag[f] == cut_terrain) terrain += face_area_vector(cell, f);
      if (cell.face_tag[f] == cut_failure) failure += face_area_vector(cell, f);
    }
  }
  const double size = (shape.high - shape.low).norm();
  shape.terrain_normal = upward_unit(terrain, size);
  shape.bed_normal = upward_unit(failure, size);
  return shape;
}

double largest_along(const std::vector<Polyhedron>& cells, const Vec3& direction) {
  double largest = -std::numeric_limits<double>::infinity();
  for (const Polyhedron& cell : cells) largest = std::max(largest, largest_along(cell, direction));
  return largest;
}

// The part of a task on the inside of a plane.
ConvexTask part_of(const ConvexTask& task, const Plane& plane, double tolerance) {
  ConvexTask part;
  part.room = clip_convex(task.room, plane, face_internal, tolerance);
  double whole = 0;
  for (const Polyhedron& cell : task.cells) {
    Polyhedron clipped = clip_convex(cell, plane, cut_wall, tolerance);
    whole += volume_of(cell);
    if (n_faces(clipped) == 0) continue;
    part.volume += volume_of(clipped);
    part.cells.push_back(std::move(clipped));
  }
  // Volume given to the block by its neighbours is shared out by volume.
  if (whole > 0) part.volume *= task.volume / whole;
  return part;
}

std::vector<Vec3> corners_of(const Polyhedron& body, int f) {
  std::vector<Vec3> corners;
  for (const int v : face(body, f)) corners.push_back(body.vertices[v]);
  return corners;
}

// Where the block was divided, or where the line of a side of the source continues into it.
bool may_part_a_block(int face_tag) {
  return face_tag == face_internal || face_tag == face_source_side;
}

// Do two bodies share a part of a face where the block was divided?
bool meet(const Polyhedron& one, const Polyhedron& other, double tolerance) {
  for (int f = 0; f < n_faces(one); ++f) {
    if (!may_part_a_block(one.face_tag[f])) continue;
    const Vec3 normal = face_normal(one, f), centre = face_centroid(one, f);
    for (int g = 0; g < n_faces(other); ++g) {
      if (!may_part_a_block(other.face_tag[g]) || face_normal(other, g).dot(normal) > -1 + 1e-9 ||
          std::abs(normal.dot(face_centroid(other, g) - centre)) > tolerance)
        continue;
      const double least = 1e-6 * std::min(face_area(one, f), face_area(other, g));
      if (face_overlap(corners_of(one, f), normal, corners_of(other, g)).area > least) return true;
    }
  }
  return false;
}

// Where the bed rises between the parts of a block, each may have been cut off from the rest.
bool hang_together(const std::vector<Polyhedron>& bodies, double tolerance) {
  std::vector<bool> reached(bodies.size(), false);
  std::vector<size_t> next = {0};
  for (size_t n_reached = 0; !next.empty();) {
    const size_t at = next.back();
    next.pop_back();
    if (reached[at]) continue;
    reached[at] = true;
    if (++n_reached == bodies.size()) return true;
    for (size_t k = 0; k < bodies.size(); ++k)
      if (!reached[k] && meet(bodies[at], bodies[k], tolerance)) next.push_back(k);
  }
  return false;
}

}  // namespace

Polyhedron made_convex(const ConvexTask& task, const Trn& bed, const ConvexOptions& options) {
  const double tolerance = options.tolerance_m;
  const RockShape shape = shape_of(task.cells);
  const bool has_top = shape.terrain_normal.squaredNorm() > 0;
  const bool has_bed = shape.bed_normal.squaredNorm() > 0;
  Polyhedron room = task.room;
  const std::array<Plane, 4> box_sides = {{{-Vec3::UnitX(), -shape.low.x()},
                                           {Vec3::UnitX(), shape.high.x()},
                                           {-Vec3::UnitY(), -shape.low.y()},
                                           {Vec3::UnitY(), shape.high.y()}}};
  // The joint cell may reach beyond the rock, even beyond the terrain: the block does not.
  for (const Plane& side : box_sides)
    if (n_faces(room) > 0) room = clip_convex(room, side, face_terrain, tolerance);
  if (n_faces(room) == 0) return {};
  const auto cleaned = [&](const Polyhedron& body) {
    return without_short_edges(body, options.min_edge, options.max_loss);
  };
  const Vec3 up = has_bed ? shape.bed_normal : shape.terrain_normal;
  if (!has_top) return cleaned(has_bed ? raised_off(room, bed, up, tolerance) : room);

  // First with the top where it was; only when that is too little, with a higher one.
  const double support = largest_along(task.cells, shape.terrain_normal);
  const double height = support + largest_along(task.cells, -shape.terrain_normal);
  for (const double rise : {0.0, 0.25, 1.0}) {
    const double top = support + rise * height;
    const Polyhedron below =
        clip_convex(room, {shape.terrain_normal, top}, face_terrain, tolerance);
    const Polyhedron body = raised_off(below, bed, up, tolerance);
    if (n_faces(body) == 0) continue;
    if (volume_of(body) < task.volume && rise < 1) continue;
    return cleaned(cut_to_volume(body, shape.terrain_normal,
                                 -largest_along(body, -shape.terrain_normal), top, task.volume,
                                 tolerance));
  }
  return {};
}

std::vector<Polyhedron> made_convex_parts(const std::vector<ConvexTask>& tasks, const Trn& bed,
                                          const ConvexOptions& options) {
  struct Part {
    ConvexTask task;
    Polyhedron body;
    [[nodiscard]] double missing() const { return task.volume - volume_of(body); }
  };
  std::vector<Part> parts;
  double volume = 0;
  for (const ConvexTask& task : tasks) {
    parts.push_back({task, task.volume > 0 ? made_convex(task, bed, options) : Polyhedron{}});
    volume += task.volume;
  }
  const auto missing = [&] {
    double sum = 0;
    for (const Part& part : parts) sum += std::abs(part.missing());
    return sum;
  };
  // The part that misses most is divided across the direction that then misses least.
  while (missing() > options.max_loss * volume) {
    if (parts.size() == tasks.size() + 3) return {};
    const auto worst =
        std::max_element(parts.begin(), parts.end(),
                         [](const Part& a, const Part& b) { return a.missing() < b.missing(); });
    Moments sum;
    for (const Polyhedron& cell : worst->task.cells) sum = joined(sum, moments(cell));
    std::array<Part, 2> best;
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 4; ++k) {
      const double angle = k * std::numbers::pi / 4;
      const Plane plane = plane_through(sum.centroid, Vec3(std::cos(angle), std::sin(angle), 0));
      std::array<Part, 2> halves;
      halves[0].task = part_of(worst->task, plane, options.tolerance_m);
      halves[1].task = part_of(worst->task, flipped(plane), options.tolerance_m);
      double lost = 0;
      for (Part& half : halves) {
        if (half.task.volume > 0) half.body = made_convex(half.task, bed, options);
        lost += half.missing();
      }
      if (lost < least) least = lost, best = std::move(halves);
    }
    if (!(least < worst->missing())) return {};
    *worst = std::move(best[0]);
    parts.push_back(std::move(best[1]));
  }
  std::vector<Polyhedron> bodies;
  for (Part& part : parts)
    if (n_faces(part.body) > 0) bodies.push_back(std::move(part.body));
  if (bodies.size() == 1)  // the bed took the rest
    std::replace(bodies[0].face_tag.begin(), bodies[0].face_tag.end(), int{face_internal},
                 int{face_failure});
  if (!bodies.empty() && !hang_together(bodies, 1e3 * options.tolerance_m)) return {};
  return bodies;
}

Polyhedron without_short_edges(const Polyhedron& body, double shortest, double max_loss) {
  if (n_faces(body) == 0 || talus::shortest_edge(body) >= shortest) return body;
  // Of vertices that near the first one stays; the order that leaves most volume is taken.
  const Vec3 centre = moments(body).centroid;
  const auto hull_in_order = [&](const std::vector<Vec3>& order) {
    std::vector<Vec3> kept;
    for (const Vec3& v : order) {
      const bool is_apart = std::all_of(kept.begin(), kept.end(), [&](const Vec3& k) {
        return (k - v).squaredNorm() >= shortest * shortest;
      });
      if (is_apart) kept.push_back(v);
    }
    return convex_hull(kept, 0);
  };
  Polyhedron hull = hull_in_order(body.vertices);
  std::vector<Vec3> order = body.vertices;
  for (const double sign : {1.0, -1.0}) {
    std::stable_sort(order.begin(), order.end(), [&](const Vec3& a, const Vec3& b) {
      return sign * (a - centre).squaredNorm() > sign * (b - centre).squaredNorm();
    });
    Polyhedron other = hull_in_order(order);
    if (volume_of(other) > volume_of(hull)) hull = std::move(other);
  }
  if (n_faces(hull) == 0) return body;
  // Each new face takes the tag of the old one that it lies along best.
  std::vector<Vec3> normals;
  for (int f = 0; f < n_faces(body); ++f) normals.push_back(face_normal(body, f));
  for (int f = 0; f < n_faces(hull); ++f) {
    const Vec3 normal = face_normal(hull, f);
    const auto along = [&](const Vec3& a, const Vec3& b) { return a.dot(normal) < b.dot(normal); };
    const auto best = std::max_element(normals.begin(), normals.end(), along);
    hull.face_tag[f] = body.face_tag[best - normals.begin()];
  }
  hull = in_standard_order(with_joined_faces(hull));
  const bool is_sound = check_surface(hull).fault == SurfaceFault::none &&
                        volume_of(hull) >= (1 - max_loss) * volume_of(body);
  return is_sound ? hull : body;
}

}  // namespace talus
