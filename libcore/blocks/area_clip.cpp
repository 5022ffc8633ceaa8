// Clips the triangles of a TRN by an area into convex pieces.
#include "blocks/area_clip.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "blocks/prepared_area.hpp"
#include "geometry/plan2d.hpp"

namespace talus {
namespace {

using Ring = std::vector<Vec2>;

struct PlanBox {
  Vec2 low = Vec2::Constant(std::numeric_limits<double>::infinity());
  Vec2 high = -low;
};

PlanBox box_of(const Area& area) {
  PlanBox box;
  for (const auto& ring : area.rings)
    for (const Vec2& p : ring) box.low = box.low.cwiseMin(p), box.high = box.high.cwiseMax(p);
  return box;
}

Vec2 middle_of(const Ring& ring) {
  Vec2 sum = Vec2::Zero();
  for (const Vec2& p : ring) sum += p;
  return sum / static_cast<double>(ring.size());
}

Vec3 at_zero(const Vec2& p) { return {p.x(), p.y(), 0}; }

// Cuts a convex ring along the line of the side, if the side itself runs through it.
bool cut_ring(const Ring& ring, const AreaSide& side, double tolerance, Ring& left, Ring& right) {
  std::vector<double> at;
  bool has_left = false, has_right = false;
  for (const Vec2& p : ring) {
    at.push_back(distance(side.plane, at_zero(p)));
    if (std::abs(at.back()) <= tolerance) at.back() = 0;
    has_left |= at.back() < 0;
    has_right |= at.back() > 0;
  }
  if (!has_left || !has_right) return false;
  SideRange section;
  const auto add_on_line = [&](const Vec2& p) {
    include(section, side, p);
    left.push_back(p);
    right.push_back(p);
  };
  for (size_t k = 0; k < ring.size(); ++k) {
    const size_t next = (k + 1) % ring.size();
    if (at[k] == 0)
      add_on_line(ring[k]);
    else
      (at[k] < 0 ? left : right).push_back(ring[k]);
    if (at[k] * at[next] >= 0) continue;
    const size_t inner = at[k] < 0 ? k : next, outer = at[k] < 0 ? next : k;
    add_on_line(ring[inner] + at[inner] / (at[inner] - at[outer]) * (ring[outer] - ring[inner]));
  }
  return runs_through(side, section, tolerance);
}

void cut_triangle(TriangleInArea& found, const std::vector<AreaSide>& sides,
                  const std::set<int>& candidates, double tolerance) {
  for (const int s : candidates) {
    std::vector<Ring> next;
    for (Ring& ring : found.pieces) {
      Ring left, right;
      if (!cut_ring(ring, sides[s], tolerance, left, right)) {
        next.push_back(std::move(ring));
        continue;
      }
      next.push_back(std::move(left));
      next.push_back(std::move(right));
      if (found.sides.empty() || found.sides.back() != s) found.sides.push_back(s);
    }
    found.pieces = std::move(next);
  }
}

int clamped_floor(double value, int last) {
  return static_cast<int>(std::clamp(std::floor(value), 0.0, static_cast<double>(last)));
}

int column_at(const Trn& trn, double x) {
  return clamped_floor((x - trn.node0.x()) / trn.cell_size, trn.n_cols - 2);
}

int row_at(const Trn& trn, double y) {
  return clamped_floor((trn.node0.y() - y) / trn.cell_size, trn.n_rows - 2);
}

// Adds the side to the triangles of each cell that it passes, row by row.
void register_side(const Trn& trn, const AreaSide& side, int number, double tolerance,
                   std::map<int, std::set<int>>& sides_at) {
  const Vec2 a = side.start, b = side.start + side.length * side.direction;
  const double y_low = std::min(a.y(), b.y()) - tolerance;
  const double y_high = std::max(a.y(), b.y()) + tolerance;
  for (int r = row_at(trn, y_high); r <= row_at(trn, y_low); ++r) {
    const double top = trn.node0.y() - r * trn.cell_size + tolerance;
    const double bottom = top - trn.cell_size - 2 * tolerance;
    double first = 0, last = 1;  // the share of the side that lies in the row
    if (std::abs(b.y() - a.y()) > tolerance) {
      const double to_top = (top - a.y()) / (b.y() - a.y());
      const double to_bottom = (bottom - a.y()) / (b.y() - a.y());
      first = std::clamp(std::min(to_top, to_bottom), 0.0, 1.0);
      last = std::clamp(std::max(to_top, to_bottom), 0.0, 1.0);
    }
    const double x1 = a.x() + first * (b.x() - a.x()), x2 = a.x() + last * (b.x() - a.x());
    for (int c = column_at(trn, std::min(x1, x2) - tolerance);
         c <= column_at(trn, std::max(x1, x2) + tolerance); ++c)
      for (int half = 0; half < 2; ++half)
        sides_at[first_triangle(trn, {r, c}) + half].insert(number);
  }
}

}  // namespace

std::vector<AreaSide> sides_of(const Area& area) {
  std::vector<AreaSide> sides;
  for (const auto& ring : area.rings) {
    // the area is left of a side where its ring runs anticlockwise around it or clockwise in a hole
    const double right = is_hole(area, ring) == (ring_area(ring) < 0) ? 1 : -1;
    for (size_t k = 0; k < ring.size(); ++k) {
      AreaSide side;
      const Vec2 along = ring[(k + 1) % ring.size()] - ring[k];
      side.start = ring[k];
      side.length = along.norm();
      side.direction = along / side.length;
      side.plane =
          plane_through(at_zero(ring[k]), right * Vec3(side.direction.y(), -side.direction.x(), 0));
      sides.push_back(side);
    }
  }
  return sides;
}

Area snapped(const Trn& trn, Area area) {
  const double reach = 10 * side_tolerance(area) / trn.cell_size;  // in cells
  for (Ring& ring : area.rings)
    for (Vec2& p : ring) {
      Vec2 at = (p - trn.node0) / trn.cell_size;
      const Vec2 node = at.array().round();
      const double off_diagonal = at.sum() - std::round(at.sum());  // they run to the south-east
      if ((at - node).cwiseAbs().minCoeff() <= reach) {
        for (int k = 0; k < 2; ++k)
          if (std::abs(at[k] - node[k]) <= reach) at[k] = node[k];
      } else if (std::abs(off_diagonal) <= reach) {
        at.array() -= off_diagonal / 2;
      } else {
        continue;
      }
      p = trn.node0 + trn.cell_size * at;
    }
  return without_repeated_corners(area);
}

double side_tolerance(const Area& area) {
  const PlanBox box = box_of(area);
  return 1e-8 * (box.high - box.low).norm();
}

void include(SideRange& range, const AreaSide& side, const Vec2& point) {
  const double along = side.direction.dot(point - side.start);
  range.low = std::min(range.low, along);
  range.high = std::max(range.high, along);
}

bool runs_through(const AreaSide& side, const SideRange& range, double tolerance) {
  return std::min(range.high, side.length) - std::max(range.low, 0.0) > tolerance;
}

bool runs_through(const AreaSide& side, const Polyhedron& body, double tolerance) {
  std::vector<double> at;
  bool has_left = false, has_right = false;
  for (const Vec3& v : body.vertices) {
    at.push_back(distance(side.plane, v));
    has_left |= at.back() < -tolerance;
    has_right |= at.back() > tolerance;
  }
  if (!has_left || !has_right) return false;
  SideRange section;
  for (int f = 0; f < n_faces(body); ++f) {
    const auto loop = face(body, f);
    for (size_t k = 0; k < loop.size(); ++k) {
      const int from = loop[k], to = loop[(k + 1) % loop.size()];
      if (at[from] * at[to] > 0 || at[from] == at[to]) continue;
      const double share = at[from] / (at[from] - at[to]);
      const Vec3 p = body.vertices[from] + share * (body.vertices[to] - body.vertices[from]);
      include(section, side, p.head<2>());
    }
  }
  return runs_through(side, section, tolerance);
}

std::vector<TriangleInArea> triangles_in(const Trn& trn, const Area& given) {
  const Area area = snapped(trn, given);
  const std::vector<AreaSide> sides = sides_of(area);
  const double tolerance = side_tolerance(area);
  std::map<int, std::set<int>> sides_at;
  for (size_t s = 0; s < sides.size(); ++s)
    register_side(trn, sides[s], static_cast<int>(s), tolerance, sides_at);
  const PlanBox box = box_of(area);
  const PreparedArea prepared(area);
  std::vector<TriangleInArea> found;
  for (int r = row_at(trn, box.high.y()); r <= row_at(trn, box.low.y()); ++r)
    for (int c = column_at(trn, box.low.x()); c <= column_at(trn, box.high.x()); ++c)
      for (int half = 0; half < 2; ++half) {
        TriangleInArea one;
        one.triangle = first_triangle(trn, {r, c}) + half;
        const auto corners = triangle_corners(trn, one.triangle);
        one.pieces = {{corners[0].head<2>(), corners[1].head<2>(), corners[2].head<2>()}};
        const auto near = sides_at.find(one.triangle);
        if (near != sides_at.end()) cut_triangle(one, sides, near->second, tolerance);
        std::erase_if(one.pieces,
                      [&](const Ring& ring) { return !prepared.contains(middle_of(ring)); });
        if (!one.pieces.empty()) found.push_back(std::move(one));
      }
  return found;
}

}  // namespace talus
