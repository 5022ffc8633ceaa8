// Lays a failure plane of a joint set so that it daylights along the foot of the source.
#include "blocks/failure_plane.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "base/text.hpp"
#include "base/units.hpp"
#include "base/words.hpp"
#include "geometry/plan2d.hpp"

namespace talus {
namespace {

Vec2 heading(double azimuth) { return {std::sin(azimuth), std::cos(azimuth)}; }

// Height of the plane of this attitude through `point`, at `place`.
double plane_height(const Attitude& plane, const Vec3& point, const Vec2& place) {
  return point.z() -
         std::tan(plane.dip) * (place - point.head<2>()).dot(heading(plane.dip_direction));
}

// --- the foot ----------------------------------------------------------------------------------

// Whether the area lies on the left of a ring as it runs: of outlines that run counter-clockwise,
// of holes that run clockwise.
bool is_left_inside(const Area& area, size_t ring) {
  int n_around = 0;
  for (size_t other = 0; other < area.rings.size(); ++other)
    n_around += other != ring && contains(Area{{area.rings[other]}}, area.rings[ring][0]);
  return (ring_area(area.rings[ring]) > 0) == (n_around % 2 == 0);
}

// Ground that rises within three cells before the mass stops it as the foot itself does.
double highest_ahead(const Trn& ground, const Vec2& place, const Vec2& motion) {
  double highest = elevation_at(ground, place.x(), place.y());
  for (int half_cells = 1; half_cells <= 6; ++half_cells) {
    const Vec2 ahead = place + 0.5 * half_cells * ground.cell_size * motion;
    const double z = elevation_at(ground, ahead.x(), ahead.y());
    if (z > highest) highest = z;
  }
  return highest;
}

// Up from a point of the foot against the motion: the last place below the mass that has no rock.
// The point itself where the mass reaches it; nothing where no rock lies above it.
std::optional<Vec2> exit_of_mass(const Trn& ground, const Trn& bed, const Area& area,
                                 const Vec2& foot, const Vec2& motion) {
  constexpr double thin = 0.1;  // [m]
  const double half = ground.cell_size / 2;
  Vec2 exit = foot;
  for (Vec2 place = foot; place == foot || contains(area, place); place -= half * motion) {
    const double depth =
        elevation_at(ground, place.x(), place.y()) - elevation_at(bed, place.x(), place.y());
    if (depth > thin) return exit;
    exit = place;
  }
  return std::nullopt;
}

// Points every half cell along a side of the outline, in the middle of their pieces.
void add_side(const Trn& ground, const Vec2& from, const Vec2& to, double facing,
              const Attitude& plane, std::vector<FootPoint>& foot) {
  const Vec2 motion = heading(plane.dip_direction);
  const double length = (to - from).norm();
  const int n = std::max(1, static_cast<int>(std::ceil(2 * length / ground.cell_size)));
  for (int k = 0; k < n; ++k) {
    FootPoint point;
    point.place = from + (k + 0.5) / n * (to - from);
    point.ground = highest_ahead(ground, point.place, motion);
    if (std::isnan(point.ground)) continue;
    point.level = point.ground + std::tan(plane.dip) * point.place.dot(motion);
    point.weight = length / n * facing;
    foot.push_back(point);
  }
}

double total_weight(const std::vector<FootPoint>& foot) {
  double sum = 0;
  for (const FootPoint& point : foot) sum += point.weight;
  return sum;
}

// The lowest point of the foot whose plane clears `share` of it.
const FootPoint& point_that_clears(const std::vector<FootPoint>& foot, double share) {
  const double wanted = share * total_weight(foot) * (1 - 1e-12);
  double sum = 0;
  for (const FootPoint& point : foot)
    if ((sum += point.weight) >= wanted) return point;
  return foot.back();
}

// Up from a point of the foot against the motion to where rock begins above the plane: the height
// of the plane there. NaN where none begins inside the area.
double exit_height(const Trn& ground, const Area& area, const Attitude& plane, const Vec3& point,
                   const Vec2& foot) {
  const Vec2 motion = heading(plane.dip_direction);
  const double half = ground.cell_size / 2;
  const double reach = ground.cell_size * (ground.n_rows + ground.n_cols);
  for (double back = 0; back < reach; back += half) {
    const Vec2 place = foot - back * motion;
    if (back > 0 && !contains(area, place)) break;
    const double height = plane_height(plane, point, place);
    if (elevation_at(ground, place.x(), place.y()) >= height) return height;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

// --- the planes of the sets --------------------------------------------------------------------

struct Covered {
  int n_inside = 0, n_covered = 0;  // nodes of the terrain in the area, with rock above the plane
};

Covered count_covered(const Trn& ground, const Area& area, const Attitude& plane,
                      const Vec3& point) {
  Covered count;
  for (int r = 0; r < ground.n_rows; ++r)
    for (int c = 0; c < ground.n_cols; ++c) {
      const Vec3 node = node_point(ground, r, c);
      if (!contains(area, Vec2(node.head<2>()))) continue;
      ++count.n_inside;
      count.n_covered += node.z() > plane_height(plane, point, node.head<2>());
    }
  return count;
}

double angle_between(double a, double b) {
  const double turn = std::fmod(std::abs(a - b), 2 * std::numbers::pi);
  return std::min(turn, 2 * std::numbers::pi - turn);
}

std::string degrees(double angle) { return text(std::round(10 * angle / degree) / 10); }

// Why no plane of a set of this attitude comes out of the slope; empty when one may.
std::string why_not_by_angles(const FailurePlane& plane) {
  if (plane.lateral > 120 * degree) return "dips into the slope";
  if (plane.lateral > widest_lateral_deg * degree)
    return "dips across the slope, " + degrees(plane.lateral) +
           " degrees off its fall line (at most " + text(widest_lateral_deg) + ")";
  if (plane.attitude.dip >= plane.apparent_slope)
    return "is steeper than the slope, which dips " + degrees(plane.apparent_slope) +
           " degrees in that direction: it does not daylight";
  return "";
}

void lay_plane(const Trn& ground, const Area& area, const Where& where, FailurePlane& plane) {
  const std::vector<FootPoint> foot = find_foot(ground, area, plane.attitude);
  if (foot.empty()) {
    plane.why_not = "finds no known ground along the foot of the source";
    return;
  }
  const FootPoint& touched = point_that_clears(foot, least_free_foot);
  plane.point = Vec3(touched.place.x(), touched.place.y(), touched.ground);
  plane.level_spread = foot.back().level - foot.front().level;
  const Covered covered = count_covered(ground, area, plane.attitude, plane.point);
  if (covered.n_covered < std::max(1.0, least_covered * covered.n_inside)) {
    plane.why_not = "daylights so high that rock stays above it on " +
                    percent(static_cast<double>(covered.n_covered) / covered.n_inside) +
                    " of the source only: as the set sees it, the foot is uneven by " +
                    text(plane.level_spread, 3) + " m";
    return;
  }
  plane.foot = plane_at_foot(ground, area, plane.attitude, plane.point);
  const SourceMass mass =
      find_source(ground, area, source_on_plane(plane.attitude, plane.point), where);
  plane.volume = mass.volume;
  plane.mean_depth = mass.mean_depth;
  plane.max_depth = mass.max_depth;
  plane.rising_share = share_over_rising_bed(ground, mass.bed, area, plane.attitude.dip_direction);
}

// Inputs that find_source refuses are refused before the foot is looked for.
void check_source(const Trn& ground, const Area& area, const Where& where) {
  SourceOptions options;
  options.kind = FailureSurface::vertical_depth;
  options.depth = 1;
  static_cast<void>(find_source(ground, area, options, where));
}

}  // namespace

std::vector<FootPoint> find_foot(const Trn& ground, const Area& area, const Attitude& plane) {
  const Vec2 motion = heading(plane.dip_direction);
  std::vector<FootPoint> foot;
  for (size_t i = 0; i < area.rings.size(); ++i) {
    const auto& ring = area.rings[i];
    const double side = is_left_inside(area, i) ? 1 : -1;
    for (size_t k = 0; k < ring.size(); ++k) {
      const Vec2 &from = ring[k], &to = ring[(k + 1) % ring.size()];
      const Vec2 along = (to - from).normalized();
      const double facing = side * Vec2(along.y(), -along.x()).dot(motion);
      if (facing > least_facing) add_side(ground, from, to, facing, plane, foot);
    }
  }
  std::stable_sort(foot.begin(), foot.end(),
                   [](const FootPoint& a, const FootPoint& b) { return a.level < b.level; });
  return foot;
}

PlaneAtFoot plane_at_foot(const Trn& ground, const Area& area, const Attitude& plane,
                          const Vec3& point) {
  const std::vector<FootPoint> foot = find_foot(ground, area, plane);
  const double rounding = 1e-9 * ground.cell_size;
  PlaneAtFoot result;
  result.exit_low = std::numeric_limits<double>::infinity();
  result.exit_high = -result.exit_low;
  double free = 0;
  for (const FootPoint& at : foot) {
    const double step = at.ground - plane_height(plane, point, at.place);
    if (step > rounding) {
      result.largest_step = std::max(result.largest_step, step);
      continue;
    }
    free += at.weight;
    const double height = exit_height(ground, area, plane, point, at.place);
    if (std::isnan(height)) continue;
    result.exit_low = std::min(result.exit_low, height);
    result.exit_high = std::max(result.exit_high, height);
  }
  const double all = total_weight(foot);
  result.free_share = all > 0 ? free / all : 0;
  return result;
}

std::vector<FootStep> steps_at_foot(const Trn& ground, const Trn& bed, const Area& area,
                                    double azimuth) {
  const Vec2 motion = heading(azimuth);
  std::vector<FootStep> steps;
  for (const FootPoint& at : find_foot(ground, area, {0, azimuth})) {
    double step = 0;
    if (const auto exit = exit_of_mass(ground, bed, area, at.place, motion))
      step = highest_ahead(ground, *exit, motion) - elevation_at(bed, exit->x(), exit->y());
    steps.push_back({at.place, step > 0 ? step : 0.0, at.weight});
  }
  return steps;
}

std::vector<PlaneAtShare> planes_by_share(const Trn& ground, const Area& area,
                                          const Attitude& plane, const std::vector<double>& shares,
                                          const Where& where) {
  std::vector<PlaneAtShare> rows;
  const std::vector<FootPoint> foot = find_foot(ground, area, plane);
  if (foot.empty()) return rows;
  for (const double share : shares) {
    const FootPoint& touched = point_that_clears(foot, share);
    PlaneAtShare row;
    row.share = share;
    row.point = Vec3(touched.place.x(), touched.place.y(), touched.ground);
    if (count_covered(ground, area, plane, row.point).n_covered > 0) {
      const SourceMass mass = find_source(ground, area, source_on_plane(plane, row.point), where);
      row.volume = mass.volume;
      row.mean_depth = mass.mean_depth;
    }
    rows.push_back(row);
  }
  return rows;
}

std::vector<BedColumn> bed_columns(const Trn& ground, const Trn& bed, const Area& area,
                                   double friction) {
  std::vector<BedColumn> columns;
  for (int t = 0; t < n_triangles(ground); ++t) {
    if (!is_known(ground, t)) continue;
    const auto above = triangle_corners(ground, t), below = triangle_corners(bed, t);
    const Vec3 middle = (above[0] + above[1] + above[2]) / 3;
    const double depth = middle.z() - (below[0].z() + below[1].z() + below[2].z()) / 3;
    if (!(depth > 0) || !contains(area, Vec2(middle.head<2>()))) continue;
    columns.push_back({triangle_gradient(bed, t), depth, friction, 0});
  }
  return columns;
}

double share_over_rising_bed(const Trn& ground, const Trn& bed, const Area& area, double azimuth) {
  const Vec2 motion = heading(azimuth);
  double all = 0, rising = 0;
  for (const BedColumn& column : bed_columns(ground, bed, area, 0)) {
    all += column.weight;
    if (column.gradient.dot(motion) > 0) rising += column.weight;
  }
  return all > 0 ? rising / all : 0;
}

Attitude mean_slope(const Trn& ground, const Area& area) {
  Vec2 sum = Vec2::Zero();
  int n = 0;
  for (int t = 0; t < n_triangles(ground); ++t) {
    if (!is_known(ground, t)) continue;
    const auto p = triangle_corners(ground, t);
    const Vec3 middle = (p[0] + p[1] + p[2]) / 3;
    if (!contains(area, Vec2(middle.head<2>()))) continue;
    sum += triangle_gradient(ground, t);
    ++n;
  }
  if (n == 0) {  // an area within a triangle or two
    const Vec2& corner = area.rings[0][0];
    sum = triangle_gradient(ground, triangle_at(ground, corner.x(), corner.y()));
    n = 1;
  }
  return attitude(Vec3(-sum.x() / n, -sum.y() / n, 1).normalized());
}

SourceOptions source_on_plane(const Attitude& plane, const Vec3& point) {
  SourceOptions options;
  options.kind = FailureSurface::plane;
  options.plane_dip = plane.dip;
  options.plane_dip_direction = plane.dip_direction;
  options.plane_point = point;
  return options;
}

FailurePlanes find_failure_planes(const Trn& ground, const Area& area,
                                  const std::vector<JointSet>& sets, double friction,
                                  const std::string& wanted, const Where& where) {
  check_source(ground, area, where);
  FailurePlanes found;
  found.slope = mean_slope(ground, area);
  found.friction = friction;
  for (const JointSet& set : sets) {
    FailurePlane plane;
    plane.set = set.name;
    plane.attitude = {set.dip, set.dip_direction};
    plane.lateral = angle_between(set.dip_direction, found.slope.dip_direction);
    plane.apparent_slope = std::atan(std::tan(found.slope.dip) * std::cos(plane.lateral));
    plane.why_not = why_not_by_angles(plane);
    if (plane.why_not.empty()) lay_plane(ground, area, where, plane);
    if (plane.why_not.empty() && plane.attitude.dip <= friction)
      plane.why_not = "is no steeper than the friction angle of " + degrees(friction) +
                      " degrees: nothing slides on it";
    found.planes.push_back(std::move(plane));
  }
  for (size_t i = 0; i < found.planes.size(); ++i) {
    const FailurePlane& plane = found.planes[i];
    if (!plane.why_not.empty() || (!wanted.empty() && plane.set != wanted)) continue;
    const bool is_larger = found.best < 0 || plane.volume > found.planes[found.best].volume;
    if (is_larger) found.best = static_cast<int>(i);
  }
  return found;
}

std::vector<JointSet> assumed_joint_sets(const Trn& ground, const Area& area, double friction,
                                         int n_blocks, const Where& where) {
  check_source(ground, area, where);
  const Attitude slope = mean_slope(ground, area);
  if (slope.dip < friction + least_room_deg * degree) return {};
  const double fall_deg = std::round(slope.dip_direction / degree);
  const auto set = [](const char* name, double dip_deg, double direction_deg) {
    JointSet made;
    made.name = name;
    made.dip = dip_deg * degree;
    made.dip_direction = std::fmod(direction_deg, 360.0) * degree;
    return made;
  };
  std::vector<JointSet> sets = {
      set("sliding", std::round((friction + 2 * slope.dip) / 3 / degree), fall_deg),
      set("rear", 80, fall_deg), set("lateral", 85, fall_deg + 90)};
  const FailurePlanes found = find_failure_planes(ground, area, {sets[0]}, friction, "", where);
  if (found.best < 0) return {};
  const auto normal = [&](int k) { return pole(sets[k].dip, sets[k].dip_direction); };
  const double skew = std::abs(normal(0).dot(normal(1).cross(normal(2))));
  // The outline of a mass of k cells cuts cells: about (cbrt(k) + 1)^3 are met.
  const double n_cells = std::pow(std::max(1.0, std::cbrt(n_blocks) - 1), 3);
  const double spacing = std::cbrt(found.planes[0].volume / n_cells * skew);
  for (JointSet& made : sets) made.mean_spacing = std::max(0.1, std::round(10 * spacing) / 10);
  return sets;
}

}  // namespace talus
