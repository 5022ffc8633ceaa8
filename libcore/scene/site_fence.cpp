// From a fence of the site file to the posts and panels of a run.
#include "scene/site_fence.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/text.hpp"
#include "base/units.hpp"
#include "geometry/plan2d.hpp"
#include "geometry/segment_meetings.hpp"
#include "terrain/trn_edge_crossings.hpp"

namespace talus {
namespace {

constexpr double most_hanging = 0.25;  // of the height, above the ground
constexpr double below_ground = 0.5;   // that panels reach into the ground [m]
constexpr double same_place = 0.1;     // nearer lines cannot both be built [m]

std::string place_text(const Trn& trn, const Vec2& at) {
  return text(at.x() + trn.origin.x(), 9) + ", " + text(at.y() + trn.origin.y(), 9);
}

/// How far the ground lies below the straight line between two feet, at most, and where.
struct Dip {
  double depth = 0;
  Vec2 at = Vec2::Zero();
};

Dip dip_between(const Trn& trn, const Vec3& a, const Vec3& b) {
  Dip dip;
  for_each_edge_crossing(trn, a.head<2>(), b.head<2>(), [&](double share) {
    const Vec3 at = a + share * (b - a);
    const double depth = at.z() - elevation_at(trn, at.x(), at.y());
    if (depth > dip.depth) dip = {depth, at.head<2>()};
  });
  return dip;
}

bool is_on(const Vec2& p, const std::vector<Vec3>& line) {
  for (std::size_t i = 0; i + 1 < line.size(); ++i)
    if (distance_to_segment<Vec2>(p, line[i].head<2>(), line[i + 1].head<2>()) <= same_place)
      return true;
  return false;
}

}  // namespace

void check_no_crossing(const Trn& trn, const std::vector<Vec3>& posts, const Where& where) {
  std::vector<Vec2> points;
  for (const Vec3& post : posts) points.push_back(post.head<2>());
  const std::string hint = "draw it anew, or in two parts";
  const bool closed = points.front() == points.back();
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = i + 1; j < points.size(); ++j)
      if (points[i] == points[j] && !(closed && i == 0 && j + 1 == points.size()))
        throw InputError(where, "comes back to itself at " + place_text(trn, points[i]), hint);
  std::vector<std::array<int, 2>> segments;
  for (int i = 0; i + 1 < static_cast<int>(points.size()); ++i) segments.push_back({i, i + 1});
  if (closed) {
    segments.back()[1] = 0;
    points.pop_back();
  }
  const SegmentMeetings meetings = find_segment_meetings(points, segments);
  if (!meetings.crossings.empty()) {
    const auto [p, q] = meetings.crossings.front();
    const Vec2 a = points[segments[p][0]], b = points[segments[p][1]];
    const double share = crossing_share(a, b, points[segments[q][0]], points[segments[q][1]]);
    throw InputError(where, "crosses itself at " + place_text(trn, a + share * (b - a)), hint);
  }
  if (!meetings.touches.empty())
    throw InputError(where,
                     "touches itself at " + place_text(trn, points[meetings.touches.front().point]),
                     hint);
}

StandingFence standing_fence(const FenceSettings& settings, const Trn& trn, int line,
                             std::vector<Vec3> posts, const Where& where) {
  check_no_crossing(trn, posts, where);
  StandingFence fence;
  fence.line = line;
  fence.height = settings.height_m;
  for (std::size_t i = 0; i + 1 < posts.size(); ++i) {
    const Dip dip = dip_between(trn, posts[i], posts[i + 1]);
    if (dip.depth > most_hanging * settings.height_m)
      throw InputError(where,
                       "does not reach the ground between its posts " + std::to_string(i) +
                           " and " + std::to_string(i + 1) + ": it hangs " + text(dip.depth, 3) +
                           " m above it at " + place_text(trn, dip.at) + ", expected at most " +
                           text(most_hanging * settings.height_m, 3),
                       "set posts closer together (post_spacing_m), or a corner in the dip");
    fence.depth.push_back(dip.depth + below_ground);
  }
  fence.posts = std::move(posts);
  if (!std::isnan(settings.capacity_kj)) {
    fence.capacity = 1e3 * settings.capacity_kj;
    fence.deflection =
        std::isnan(settings.max_deflection_m) ? 0.5 * settings.height_m : settings.max_deflection_m;
  }
  fence.contact.friction = std::tan(settings.friction_deg * degree);
  fence.contact.restitution = settings.cor;
  return fence;
}

void check_feet(const FenceSettings& fence, const Trn& trn, const std::vector<Vec3>& points,
                const Where& where) {
  for (const Vec3& point : points) {
    const double above = point.z() - elevation_at(trn, point.x(), point.y());
    if (!(above > most_hanging * fence.height_m)) continue;
    throw InputError(where,
                     "does not reach the ground: its point at " + place_text(trn, point.head<2>()) +
                         " lies " + text(above, 3) + " m above it",
                     "leave the elevation out, and the posts stand on the ground");
  }
}

bool lies_along(const std::vector<Vec3>& line, const std::vector<Vec3>& other) {
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Vec2 a = line[i].head<2>(), b = line[i + 1].head<2>();
    for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0})
      if (!is_on(a + share * (b - a), other)) return false;
  }
  return true;
}

}  // namespace talus
