// Contact of a convex part with a vertical cylinder, such as the stem of a tree.
#include "contact/cylinder_contact.hpp"

#include <algorithm>
#include <cmath>

#include "base/numbers.hpp"
#include "contact/scales.hpp"
#include "geometry/plan2d.hpp"

namespace talus {
namespace {

constexpr double hardly_more = 0.05;  // farther than the nearest point, of the part's thickness

// The point of a segment that is nearest to the origin.
Vec2 nearest_of(const Vec2& a, const Vec2& b) {
  const Vec2 along = b - a;
  const double length_sq = along.squaredNorm();
  const double share = length_sq > 0 ? std::clamp(-a.dot(along) / length_sq, 0.0, 1.0) : 0.0;
  return a + share * along;
}

/// A part seen from above, from the axis of the cylinder.
struct PlanView {
  const Hulls& hulls;
  const PlacedHulls& placed;
  int part;
  Vec2 axis;

  [[nodiscard]] const Vec3& vertex(int v) const {
    return placed.vertices[hulls.vertex_begin[part] + v];
  }
  [[nodiscard]] Vec2 in_plan(int v) const { return vertex(v).head<2>() - axis; }

  template <class Visit>
  void for_each_edge(Visit&& visit) const {
    for (int e = hulls.edge_begin[part]; e < hulls.edge_begin[part + 1]; ++e)
      visit(e, hulls.edges[e]);
  }
  // How far the part reaches along a direction at least.
  [[nodiscard]] double lowest_along(const Vec2& direction) const {
    double low = infinity;
    for (int v = 0; v < hulls.vertex_begin[part + 1] - hulls.vertex_begin[part]; ++v)
      low = std::min(low, direction.dot(in_plan(v)));
    return low;
  }

  // Direction and distance at which the axis is outside. Where all of the part is on one side
  // of the axis, the nearest point of an edge is that of the outline, since all edges lie in it.
  [[nodiscard]] bool is_outside(Vec2& direction, double& distance) const {
    Vec2 nearest = Vec2::Zero();
    distance = infinity;
    for_each_edge([&](int, const HullEdge& edge) {
      const Vec2 at = nearest_of(in_plan(edge.a), in_plan(edge.b));
      if (at.norm() < distance) distance = at.norm(), nearest = at;
    });
    if (!(distance > 0)) return false;
    direction = nearest / distance;
    return lowest_along(direction) >= distance - rounding * hulls.radius[hulls.body[part]];
  }

  // The axis is inside the part: the direction to push it out over the shortest distance.
  void find_way_out(Vec2& direction, double& distance) const {
    distance = -infinity;
    for_each_edge([&](int, const HullEdge& edge) {
      const Vec2 along = in_plan(edge.b) - in_plan(edge.a);
      if (along.squaredNorm() == 0) return;
      for (const double side : {-1.0, 1.0}) {
        const Vec2 across = side * Vec2(-along.y(), along.x()).normalized();
        const double low = lowest_along(across);
        if (low > distance) distance = low, direction = across;
      }
    });
  }
};

bool is_known(const PairPoint& point, std::size_t begin, const std::vector<PairPoint>& points,
              double apart) {
  return std::any_of(points.begin() + static_cast<std::ptrdiff_t>(begin), points.end(),
                     [&](const PairPoint& other) {
                       return (other.point_b - point.point_b).norm() <= apart &&
                              std::abs(other.gap - point.gap) <= apart;
                     });
}

}  // namespace

int find_cylinder_contact(const Hulls& hulls, const PlacedHulls& placed, int part,
                          const VerticalCylinder& cylinder, double margin, Vec3& normal,
                          std::vector<PairPoint>& points) {
  const PlanView view{hulls, placed, part, cylinder.axis};
  Vec2 direction(1, 0);
  double distance = 0;
  if (!view.is_outside(direction, distance)) view.find_way_out(direction, distance);
  if (distance - cylinder.radius > margin) return 0;
  normal = Vec3(direction.x(), direction.y(), 0);
  const int body = hulls.body[part];
  const double apart = rounding * hulls.radius[body];
  const double farthest =
      std::min(cylinder.radius + margin, distance + hardly_more * hulls.thickness[part]);
  const std::size_t begin = points.size();
  const auto add = [&](int edge, const Vec3& at) {
    const double along = direction.dot(at.head<2>() - cylinder.axis);
    if (along > farthest || at.z() > cylinder.top) return;
    PairPoint point;
    point.key.mode = ContactMode::edge_edge;
    point.key.feature_a = edge - hulls.body_edge_begin[body];
    point.key.feature_b = 0;
    point.gap = along - cylinder.radius;
    point.point_b = at - point.gap * normal;
    if (!is_known(point, begin, points, apart)) points.push_back(point);
  };
  view.for_each_edge([&](int e, const HullEdge& edge) {
    const Vec3 &a = view.vertex(edge.a), &b = view.vertex(edge.b);
    const double side_a = cross(direction, view.in_plan(edge.a)),
                 side_b = cross(direction, view.in_plan(edge.b));
    const bool a_is_on = std::abs(side_a) <= apart, b_is_on = std::abs(side_b) <= apart;
    if (a_is_on) add(e, a);
    if (b_is_on) add(e, b);
    if (!a_is_on && !b_is_on && side_a * side_b < 0)
      add(e, a + side_a / (side_a - side_b) * (b - a));
  });
  return static_cast<int>(points.size() - begin);
}

}  // namespace talus
