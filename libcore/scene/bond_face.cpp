// Checks a bonded face: normal, shear and bending loads against its strength.
#include "scene/bond_face.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "contact/scales.hpp"
#include "geometry/convex_outline.hpp"
#include "geometry/plan2d.hpp"

namespace talus {
namespace {

using std::size_t;

/// The corners of a bonded face in its plane.
struct PlaneFace {
  Vec2 centre = Vec2::Zero();    ///< mean of the corners
  double size = 0;               ///< distance of the farthest corner from that [m]
  std::vector<Vec2> at;          ///< from the centre, over the size
  std::vector<Vec2> shear;       ///< [N]
  std::vector<double> normal;    ///< > 0: pressed [N]
  double pressed = 0, area = 0;  ///< sums of the last and of the shares

  explicit PlaneFace(const BondFace& face) {
    const Vec3& n = face.normal;
    const Vec3 u = n.unitOrthogonal(), v = n.cross(u);
    for (const BondCorner& corner : face.corners) {
      at.emplace_back(u.dot(corner.point), v.dot(corner.point));
      shear.emplace_back(u.dot(corner.force), v.dot(corner.force));
      normal.push_back(n.dot(corner.force));
      centre += at.back() / static_cast<double>(face.corners.size());
      pressed += normal.back();
      area += corner.area;
    }
    for (Vec2& x : at) x -= centre, size = std::max(size, x.norm());
    if (size > 0)
      for (Vec2& x : at) x /= size;
  }
};

// Pressure may be of any size, so stresses above -t balance the normal forces where these and t
// over the whole area together press within the face: not out across any of its sides.
bool holds_normal_force(const BondFace& face, const PlaneFace& plane) {
  double all_over = plane.pressed;
  for (const BondCorner& corner : face.corners) all_over += corner.tension * corner.area;
  if (all_over < 0) return false;
  const std::vector<Vec2> outline = convex_outline(plane.at);
  for (size_t i = 0; i < outline.size(); ++i) {
    const Vec2 &from = outline[i], &to = outline[(i + 1) % outline.size()];
    const Vec2 inward = Vec2(from.y() - to.y(), to.x() - from.x()).normalized();
    double moment = 0, all = 0;
    for (size_t k = 0; k < face.corners.size(); ++k) {
      const double strength = face.corners[k].tension * face.corners[k].area;
      // a corner outside the outline's side by rounding counts as on it
      const double distance = std::max(0.0, inward.dot(plane.at[k] - from));
      moment += (plane.normal[k] + strength) * distance;
      all += std::abs(plane.normal[k]) + strength;
    }
    if (moment < -rounding * all) return false;
  }
  return true;
}

/// Shear strength of a piece of the face.
struct ShearPiece {
  Vec2 at = Vec2::Zero();  ///< as in PlaneFace
  double strength = 0;     ///< [N]
};

// Points of a quadrature of degree 5 over triangles (Radon), barycentric, and their weights.
struct QuadraturePoint {
  double a, b, c, weight;
};
constexpr std::array<QuadraturePoint, 7> quadrature = [] {
  std::array<QuadraturePoint, 7> points{{{1.0 / 3, 1.0 / 3, 1.0 / 3, 9.0 / 40}}};
  for (const int sign : {-1, 1}) {
    const double root = sign * 3.872983346207417;  // sqrt(15)
    const double a = (6 + root) / 21, weight = (155 + root) / 1200;
    const auto at = static_cast<size_t>(sign < 0 ? 1 : 4);
    points[at] = {1 - 2 * a, a, a, weight};
    points[at + 1] = {a, 1 - 2 * a, a, weight};
    points[at + 2] = {a, a, 1 - 2 * a, weight};
  }
  return points;
}();

// A triangle of even strength, divided n times along each side.
void add_triangle(const std::array<Vec2, 3>& corner, double strength, int n,
                  std::vector<ShearPiece>& pieces) {
  const Vec2 along = (corner[1] - corner[0]) / n, up = (corner[2] - corner[0]) / n;
  const auto add = [&](const Vec2& p, const Vec2& q, const Vec2& r) {
    for (const auto& [a, b, c, weight] : quadrature)
      pieces.push_back({a * p + b * q + c * r, weight * strength / (n * n)});
  };
  for (int i = 0; i < n; ++i)
    for (int k = 0; i + k < n; ++k) {
      const Vec2 p = corner[0] + i * along + k * up;
      add(p, p + along, p + up);
      if (i + k + 1 < n) add(p + along, p + along + up, p + up);
    }
}

// Corners [begin, end) of `order` in the order of their angle about their mean.
void order_ring(const PlaneFace& plane, std::vector<size_t>& ring) {
  Vec2 mean = Vec2::Zero();
  for (const size_t k : ring) mean += plane.at[k] / static_cast<double>(ring.size());
  const auto angle = [&](size_t k) {
    const Vec2 x = plane.at[k] - mean;
    return std::atan2(x.y(), x.x());
  };
  std::sort(ring.begin(), ring.end(), [&](size_t i, size_t k) { return angle(i) < angle(k); });
}

// The pieces of one convex part of the face: each corner has half of the two triangles that it
// makes with the centre of area, over which its strength is even.
void add_pieces(const BondFace& face, const PlaneFace& plane, int n_parts,
                std::vector<size_t>& ring, std::vector<ShearPiece>& pieces) {
  const double pressure = std::max(0.0, plane.pressed) / plane.area;
  const auto strength = [&](const BondCorner& corner) {
    return (corner.cohesion + corner.friction * pressure) * corner.area;
  };
  order_ring(plane, ring);
  const size_t n = ring.size();
  const auto at = [&](size_t i) -> const Vec2& { return plane.at[ring[i % n]]; };
  double twice = 0;
  Vec2 centre = Vec2::Zero();
  for (size_t i = 1; i + 1 < n; ++i) {
    const double part = cross(at(i) - at(0), at(i + 1) - at(0));
    twice += part;
    centre += part / 3 * (at(0) + at(i) + at(i + 1));
  }
  if (twice > 0) centre /= twice;
  for (size_t i = 0; i < n; ++i) {
    const Vec2 before = (at(i + n - 1) + at(i)) / 2, after = (at(i) + at(i + 1)) / 2;
    const double first = cross(before - centre, at(i) - centre),
                 second = cross(at(i) - centre, after - centre);
    const double all = strength(face.corners[ring[i]]);
    if (!(twice > 0) || !(first + second > 0)) {
      pieces.push_back({at(i), all});
      continue;
    }
    add_triangle({centre, before, at(i)}, all * std::max(0.0, first) / (first + second), n_parts,
                 pieces);
    add_triangle({centre, at(i), after}, all * std::max(0.0, second) / (first + second), n_parts,
                 pieces);
  }
}

std::vector<ShearPiece> shear_pieces(const BondFace& face, const PlaneFace& plane, int n_parts) {
  std::vector<ShearPiece> pieces;
  std::vector<size_t> left(face.corners.size()), ring;
  std::iota(left.begin(), left.end(), 0);
  while (!left.empty()) {
    const int polygon = face.corners[left.front()].polygon;
    const auto others = std::stable_partition(
        left.begin(), left.end(), [&](size_t k) { return face.corners[k].polygon == polygon; });
    ring.assign(left.begin(), others);
    left.erase(left.begin(), others);
    add_pieces(face, plane, n_parts, ring, pieces);
  }
  return pieces;
}

// Speed of a piece of a plate that moves by (v_x, v_y, turn about the centre).
double speed_of(const ShearPiece& piece, const Vec3& motion) {
  return std::hypot(motion.x() - motion.z() * piece.at.y(), motion.y() + motion.z() * piece.at.x());
}

// Shear stresses of the strength's size at most balance the load where the load does less work in
// every motion of the face than they would (theorems of limit analysis). The motion that they do
// the least work in is found by least squares, again and again with the weights strength / speed:
// the stresses of each solution balance the load, which shows that the face holds where none is
// too large, and its motion shows that it fails where the load does more work.
bool holds_shear_force(const BondFace& face, const PlaneFace& plane) {
  constexpr int most_rounds = 60;
  // The speed has a kink where the face turns about a point inside a triangle, which a quadrature
  // over the whole of it misses by up to 0.7 % of the strength; in these parts by 0.03 %.
  constexpr int n_parts = 4;
  Vec3 load = Vec3::Zero();
  double all = 0;
  for (size_t k = 0; k < plane.at.size(); ++k) {
    load += Vec3(plane.shear[k].x(), plane.shear[k].y(), cross(plane.at[k], plane.shear[k]));
    all += plane.shear[k].norm();
  }
  if (!(all > 0)) return true;
  std::vector<ShearPiece> pieces;
  std::vector<double> speed;
  const auto divide = [&](int n) {
    pieces = shear_pieces(face, plane, n);
    std::erase_if(pieces, [](const ShearPiece& piece) { return !(piece.strength > 0); });
    speed.assign(pieces.size(), 1);
  };
  divide(1);
  for (int round = 0; round < most_rounds; ++round) {
    Mat3 stiffness = Mat3::Zero();
    for (size_t i = 0; i < pieces.size(); ++i) {
      const double weight = pieces[i].strength / speed[i], x = pieces[i].at.x(),
                   y = pieces[i].at.y();
      stiffness.diagonal() += weight * Vec3(1, 1, x * x + y * y);
      stiffness(2, 0) -= weight * y;
      stiffness(2, 1) += weight * x;
    }
    stiffness(0, 2) = stiffness(2, 0);
    stiffness(1, 2) = stiffness(2, 1);
    const Vec3 motion = stiffness.ldlt().solve(load);
    if (!motion.allFinite()) return false;
    double resists = 0, fastest = 0, stressed = 0;
    for (size_t i = 0; i < pieces.size(); ++i) {
      const double now = speed_of(pieces[i], motion);
      stressed = std::max(stressed, now / speed[i]);
      resists += pieces[i].strength * now;
      fastest = std::max(fastest, now);
      speed[i] = now;
    }
    if (stressed <= 1) return !pieces.empty();
    if (round == 0) {  // most faces hold by their elastic stresses
      divide(n_parts);
      continue;
    }
    if (resists < load.dot(motion)) return false;
    for (double& s : speed) s = std::max(s, rounding * fastest);
  }
  return true;  // as near to its strength as the rounds can tell
}

}  // namespace

BondFace& face_of(int bond, int block, const Vec3& normal, std::vector<BondFace>& faces) {
  for (BondFace& face : faces)
    if (face.bond == bond && face.block == block &&
        (bond >= 0 || is_same_face(face.normal, normal)))
      return face;
  faces.push_back({bond, block, normal, false, {}});
  return faces.back();
}

bool holds(const BondFace& face) {
  if (face.opened) return false;
  const PlaneFace plane(face);
  return holds_normal_force(face, plane) && holds_shear_force(face, plane);
}

}  // namespace talus
