// Lays a wedge of two joint sets so that it daylights along the foot of the source.
#include "blocks/failure_wedge.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/text.hpp"
#include "base/units.hpp"

namespace talus {
namespace {

std::string degrees(double angle) { return text(std::round(10 * angle / degree) / 10); }

// Rise of a plane above its height at local zero, at `place`.
double fall_to(const Attitude& plane, const Vec2& place) {
  return std::tan(plane.dip) *
         place.dot(Vec2(std::sin(plane.dip_direction), std::cos(plane.dip_direction)));
}

// A point of the foot, or of the source, as the two families of planes see it: the height at local
// zero of the plane that passes through it.
struct Levels {
  double first, second, weight;
};

Levels levels_at(const FailureWedge& wedge, const Vec2& place, double z, double weight) {
  return {z + fall_to(wedge.first_plane, place), z + fall_to(wedge.second_plane, place), weight};
}

std::string why_not_by_angles(const FailureWedge& wedge, const Attitude& slope) {
  if (wedge.line.line.isZero()) return "are parallel";
  const double lateral = angle_between(wedge.line.trend, slope.dip_direction);
  const double apparent = std::atan(std::tan(slope.dip) * std::cos(lateral));
  if (lateral > 120 * degree) return "meet in a line that dips into the slope";
  if (lateral > widest_lateral_deg * degree)
    return "meet in a line that dips across the slope, " + degrees(lateral) +
           " degrees off its fall line (at most " + text(widest_lateral_deg) + ")";
  if (wedge.line.plunge >= apparent)
    return "meet in a line that is steeper than the slope, which dips " + degrees(apparent) +
           " degrees in that direction: it does not daylight";
  if (!wedge.line.on_both) return "carry no wedge: it slides on one of them alone";
  return "";
}

// Heights at local zero of the two planes.
struct Laid {
  double first = 0, second = 0;
  double volume = -1;  // a sum over nodes, for comparison
};

// The second plane that clears `weight_left` of the points from `begin` on, by their second level.
double second_level(std::vector<Levels> rest, double weight_left) {
  std::sort(rest.begin(), rest.end(),
            [](const Levels& a, const Levels& b) { return a.second > b.second; });
  double blocked = 0;
  for (const Levels& point : rest) {
    blocked += point.weight;
    if (blocked > weight_left) return point.second;
  }
  return rest.back().second;
}

Laid measured(const std::vector<Levels>& nodes, Laid laid) {
  double sum = 0;
  int n = 0, n_first = 0;
  for (const Levels& node : nodes) {
    const double over_first = node.first - laid.first, over_second = node.second - laid.second;
    const double depth = std::min(over_first, over_second);
    if (depth <= 0) continue;
    sum += depth;
    ++n;
    n_first += over_first < over_second;
  }
  const bool has_flanks = n_first >= least_flank * n && n - n_first >= least_flank * n;
  laid.volume = n > 0 && has_flanks ? sum : -1;
  return laid;
}

// Of all combinations of planes that clear the foot, the one with the most rock above both.
Laid lay(std::vector<Levels> foot, const std::vector<Levels>& nodes) {
  std::sort(foot.begin(), foot.end(),
            [](const Levels& a, const Levels& b) { return a.first < b.first; });
  double all = 0;
  for (const Levels& point : foot) all += point.weight;
  const double may_be_blocked = (1 - least_free_foot) * all * (1 + 1e-12);
  Laid best;
  for (size_t i = 0; i + 1 < foot.size(); ++i) {
    const std::vector<Levels> rest(foot.begin() + static_cast<std::ptrdiff_t>(i) + 1, foot.end());
    const Laid laid = measured(nodes, {foot[i].first, second_level(rest, may_be_blocked), 0});
    if (laid.volume > best.volume) best = laid;
  }
  return best;
}

std::vector<Levels> nodes_in(const Trn& ground, const Area& area, const FailureWedge& wedge) {
  std::vector<Levels> nodes;
  for (int r = 0; r < ground.n_rows; ++r)
    for (int c = 0; c < ground.n_cols; ++c) {
      const Vec3 node = node_point(ground, r, c);
      if (!std::isnan(node.z()) && contains(area, Vec2(node.head<2>())))
        nodes.push_back(levels_at(wedge, node.head<2>(), node.z(), 1));
    }
  return nodes;
}

// A point of the plane of this height at local zero, near `place`.
Vec3 point_on(const Attitude& plane, double level, const Vec2& place) {
  return {place.x(), place.y(), level - fall_to(plane, place)};
}

void lay_wedge(const Trn& ground, const Area& area, const Where& where, FailureWedge& wedge) {
  const std::vector<FootPoint> foot =
      find_foot(ground, area, {wedge.line.plunge, wedge.line.trend});
  std::vector<Levels> levels;
  for (const FootPoint& at : foot)
    levels.push_back(levels_at(wedge, at.place, at.ground, at.weight));
  const Laid laid = levels.size() > 1 ? lay(levels, nodes_in(ground, area, wedge)) : Laid{};
  if (!(laid.volume > 0)) {
    wedge.why_not = "make no wedge that comes out along the foot with rock above both";
    return;
  }
  const Vec2 place = foot.front().place;
  wedge.first_point = point_on(wedge.first_plane, laid.first, place);
  wedge.second_point = point_on(wedge.second_plane, laid.second, place);
  const SourceMass mass = find_source(ground, area, source_on_wedge(wedge), where);
  wedge.volume = mass.volume;
  wedge.mean_depth = mass.mean_depth;
  wedge.max_depth = mass.max_depth;
  double all = 0, free = 0;
  for (const Levels& point : levels) {
    const double step = std::min(point.first - laid.first, point.second - laid.second);
    all += point.weight;
    if (step <= 1e-9 * ground.cell_size) free += point.weight;
    wedge.largest_step = std::max(wedge.largest_step, step);
  }
  wedge.free_share = free / all;
}

}  // namespace

std::vector<FailureWedge> find_failure_wedges(const Trn& ground, const Area& area,
                                              const std::vector<JointSet>& sets, double friction,
                                              const Where& where) {
  const Attitude slope = mean_slope(ground, area);
  std::vector<FailureWedge> found;
  for (size_t i = 0; i < sets.size(); ++i)
    for (size_t j = i + 1; j < sets.size(); ++j) {
      FailureWedge wedge;
      wedge.first = sets[i].name;
      wedge.second = sets[j].name;
      wedge.first_plane = {sets[i].dip, sets[i].dip_direction};
      wedge.second_plane = {sets[j].dip, sets[j].dip_direction};
      const double tangent = std::tan(friction);
      wedge.line = wedge_of(wedge.first_plane, wedge.second_plane, tangent, tangent);
      wedge.why_not = why_not_by_angles(wedge, slope);
      const bool is_upright = std::max(sets[i].dip, sets[j].dip) > 89 * degree;
      if (wedge.why_not.empty() && is_upright)
        wedge.why_not = "make no surface of heights: one of them is upright";
      if (wedge.why_not.empty()) lay_wedge(ground, area, where, wedge);
      if (wedge.why_not.empty() && wedge.line.factor >= 1)
        wedge.why_not = "hold a wedge: its factor of safety is " + text(wedge.line.factor, 3);
      found.push_back(std::move(wedge));
    }
  return found;
}

int best_wedge(const std::vector<FailureWedge>& wedges, const std::string& wanted) {
  int best = -1;
  for (size_t i = 0; i < wedges.size(); ++i) {
    if (!wedges[i].why_not.empty()) continue;
    const std::string turned = wedges[i].second + " + " + wedges[i].first;
    if (!wanted.empty() && pair_name(wedges[i]) != wanted && turned != wanted) continue;
    if (best < 0 || wedges[i].volume > wedges[best].volume) best = static_cast<int>(i);
  }
  return best;
}

std::string pair_name(const FailureWedge& wedge) { return wedge.first + " + " + wedge.second; }

SourceOptions source_on_wedge(const FailureWedge& wedge) {
  SourceOptions options = source_on_plane(wedge.first_plane, wedge.first_point);
  options.more_planes.push_back(
      {wedge.second_plane.dip, wedge.second_plane.dip_direction, wedge.second_point});
  return options;
}

}  // namespace talus
