// Areas in plan, as of the source: polygons with holes; points inside, and refusal of bad outlines.
#include "blocks/area.hpp"

#include <algorithm>
#include <cmath>

#include "base/text.hpp"
#include "blocks/area_side.hpp"
#include "geometry/touching_boxes.hpp"
#include "terrain/extent_text.hpp"

namespace talus {
namespace {

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

std::vector<Box2> boxes_of(const std::vector<Segment>& segments) {
  std::vector<Box2> boxes;
  boxes.reserve(segments.size());
  for (const Segment& s : segments) {
    const Vec2 room = Vec2::Constant(reach_of(s.a, s.b));
    boxes.push_back({s.a.cwiseMin(s.b) - room, s.a.cwiseMax(s.b) + room});
  }
  return boxes;
}

InputError crossing(const Segment& s, const Segment& t, const Vec3& origin, const Where& where) {
  const auto ends = [&](const Segment& side) {
    return "(" + place_text(side.a, origin) + ") and (" + place_text(side.b, origin) + ")";
  };
  if (s.ring == t.ring)
    return {where,
            "the source area crosses itself between " + ends(s) + ", where (" +
                place_text(t.a, origin) + ") - (" + place_text(t.b, origin) + ") meets it",
            "put the corners in order around the area"};
  return {where,
          "two outlines of the source area meet: the side between " + ends(s) +
              " and that between " + ends(t),
          "dissolve areas that share a side into one; a hole must not touch the outline"};
}

// Of an outline that crosses itself the two halves may cancel: its area says nothing.
bool are_in_line(const std::vector<Vec2>& ring) {
  for (const Vec2& p : ring) {
    if (cross(ring[1] - ring[0], p - ring[0]) != 0) return false;
  }
  return true;
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
      if (is_left_of(a, b, point)) inside = !inside;
    }
  return inside;
}

bool is_hole(const Area& area, const std::vector<Vec2>& ring) {
  int n_around = 0;
  for (const auto& other : area.rings)
    n_around += &other != &ring && contains(Area{{other}}, ring[0]);
  return n_around % 2 != 0;
}

double area_of(const Area& area) {
  double sum = 0;
  for (const auto& ring : area.rings)
    sum += (is_hole(area, ring) ? -1 : 1) * std::abs(ring_area(ring));
  return sum;
}

void check_area(const Area& area, const Vec3& origin, const Where& where) {
  if (area.rings.empty()) throw InputError(where, "the source area is empty");
  std::vector<Segment> segments;
  for (size_t i = 0; i < area.rings.size(); ++i) {
    const auto& ring = area.rings[i];
    for (const Vec2& p : ring)
      if (!p.allFinite()) throw InputError(where, "a corner of the source area is not finite");
    if (ring.size() < 3 || are_in_line(ring))
      throw InputError(where, "a ring of the source area has no area",
                       "give at least three corners that are not in line");
    for (size_t k = 0; k < ring.size(); ++k)
      segments.push_back({ring[k], ring[(k + 1) % ring.size()], i, k, ring.size()});
  }
  for (const auto& [i, j] : touching_boxes(boxes_of(segments)).pairs)
    if (collide(segments[i], segments[j])) throw crossing(segments[i], segments[j], origin, where);
}

}  // namespace talus
