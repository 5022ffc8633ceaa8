// Start points of bodies along lines and over areas, and their height above ground.
#include "blocks/placement.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace talus {
namespace {

double triangle_area(const std::array<Vec3, 3>& p) {
  return (p[1] - p[0]).cross(p[2] - p[0]).norm() / 2;
}

// Where the segment a-b crosses the three families of grid lines in plan, as shares of its length.
void add_grid_crossings(const Trn& trn, const Vec3& a, const Vec3& b, std::vector<double>& shares) {
  const auto in_cells = [&](const Vec3& p) {
    return Vec2((p.x() - trn.node0.x()) / trn.cell_size, (trn.node0.y() - p.y()) / trn.cell_size);
  };
  const Vec2 from = in_cells(a), to = in_cells(b);
  const auto cross_family = [&](double u, double v) {
    if (u == v) return;
    for (double line = std::ceil(std::min(u, v)); line <= std::max(u, v); line += 1)
      shares.push_back((line - u) / (v - u));
  };
  cross_family(from.x(), to.x());
  cross_family(from.y(), to.y());
  cross_family(from.x() - from.y(), to.x() - to.y());  // the diagonals, south = east
}

// Calls visit(row, col) for the cells of a grid along Hilbert's curve through the square of a power
// of two from `start` on; `a`, `b`: its sides, in columns and rows. Neighbours on the curve are
// neighbours in plan.
template <class Visit>
void along_hilbert(const Trn& grid, const Eigen::Vector2i& start, const Eigen::Vector2i& a,
                   const Eigen::Vector2i& b, Visit& visit) {
  const Eigen::Vector2i low = start.cwiseMin(start + a + b);
  if (low.x() >= grid.n_cols - 1 || low.y() >= grid.n_rows - 1) return;
  if ((a + b).cwiseAbs().maxCoeff() == 1) return visit(low.y(), low.x());
  const Eigen::Vector2i half_a = a / 2, half_b = b / 2;
  along_hilbert(grid, start, half_b, half_a, visit);
  along_hilbert(grid, Eigen::Vector2i(start + half_a), half_a, half_b, visit);
  along_hilbert(grid, Eigen::Vector2i(start + half_a + half_b), half_a, half_b, visit);
  along_hilbert(grid, Eigen::Vector2i(start + half_a + b), Eigen::Vector2i(-half_b),
                Eigen::Vector2i(-half_a), visit);
}

// Calls visit(corners, is_steep) for the triangles of the area, near ones after each other.
template <class Visit>
void for_each_triangle(const Trn& ground, const ReleaseArea& release, Visit visit) {
  const double steep = std::tan(release.min_slope);
  const auto visit_cell = [&](int row, int col) {
    for (int half = 0; half < 2; ++half) {
      const int t = first_triangle(ground, {row, col}) + half;
      if (!is_known(ground, t)) continue;
      const auto p = triangle_corners(ground, t);
      const Vec3 middle = (p[0] + p[1] + p[2]) / 3;
      if (release.area.rings.empty() || contains(release.area, middle.head<2>()))
        visit(p, triangle_gradient(ground, t).norm() >= steep);
    }
  };
  int size = 1;
  while (size < std::max(ground.n_rows, ground.n_cols) - 1) size *= 2;
  along_hilbert(ground, {0, 0}, {size, 0}, {0, size}, visit_cell);
}

// Lowest z of a convex body above or below (x, y); infinity when it is not there.
double lower_side(const Polyhedron& body, const Vec2& p) {
  double low = -std::numeric_limits<double>::infinity(), high = -low;
  for (int f = 0; f < n_faces(body); ++f) {
    const Vec3 n = face_normal(body, f);
    const double offset = n.dot(body.vertices[face(body, f)[0]]) - n.head<2>().dot(p);
    if (n.z() < -1e-12)
      low = std::max(low, offset / n.z());
    else if (n.z() > 1e-12)
      high = std::min(high, offset / n.z());
    else if (offset < 0)
      return std::numeric_limits<double>::infinity();
  }
  return low <= high ? low : std::numeric_limits<double>::infinity();
}

}  // namespace

std::vector<Vec2> points_along(const std::vector<Vec2>& line, double spacing) {
  std::vector<Vec2> points;
  double next = 0, walked = 0;
  for (size_t k = 0; k + 1 < line.size(); ++k) {
    const double length = (line[k + 1] - line[k]).norm();
    for (; length > 0 && next <= walked + length * (1 + 1e-12); next += spacing)
      points.push_back(line[k] + (next - walked) / length * (line[k + 1] - line[k]));
    walked += length;
  }
  return points;
}

SlopingArea sloping_area(const Trn& ground, const ReleaseArea& release) {
  SlopingArea sum;
  for_each_triangle(ground, release, [&](const std::array<Vec3, 3>& p, bool is_steep) {
    const double area = triangle_area(p);
    sum.all += area;
    if (is_steep) sum.steep += area;
  });
  return sum;
}

std::vector<Vec2> points_over(const Trn& ground, const ReleaseArea& release, double spacing,
                              const Vec3& shift) {
  const double area = sloping_area(ground, release).steep;
  std::vector<Vec2> points;
  if (!(area > 0)) return points;
  const double n = std::max(1.0, std::round(area / (spacing * spacing)));
  const auto at_area = [&](double k) {  // of point k; below all of it in spite of rounding
    return std::min((k + shift.z()) * area / n, std::nextafter(area, 0.0));
  };
  // R2 sequence: steps by the plastic number fill the unit square evenly.
  constexpr double step_u = 0.7548776662466927, step_v = 0.5698402909980532;
  double u = shift.x(), v = shift.y(), sum = 0;
  for_each_triangle(ground, release, [&](const std::array<Vec3, 3>& p, bool is_steep) {
    if (!is_steep) return;
    sum += triangle_area(p);
    while (static_cast<double>(points.size()) < n &&
           at_area(static_cast<double>(points.size())) < sum) {
      u = std::fmod(u + step_u, 1), v = std::fmod(v + step_v, 1);
      const bool fold = u + v > 1;
      const double a = fold ? 1 - u : u, b = fold ? 1 - v : v;
      const Vec3 at = p[0] + a * (p[1] - p[0]) + b * (p[2] - p[0]);
      points.emplace_back(at.x(), at.y());
    }
  });
  return points;
}

double clearance(const Polyhedron& convex, const Trn& ground) {
  double smallest = std::numeric_limits<double>::infinity();
  bool is_known_below = true;
  const auto compare = [&](const Vec3& p) {
    const double gap = p.z() - elevation_at(ground, p.x(), p.y());
    if (std::isnan(gap))
      is_known_below = false;
    else
      smallest = std::min(smallest, gap);
  };
  Vec3 low = convex.vertices[0], high = low;
  for (const Vec3& v : convex.vertices) {
    compare(v);
    low = low.cwiseMin(v), high = high.cwiseMax(v);
  }
  if (!is_known_below) return std::numeric_limits<double>::quiet_NaN();
  std::vector<double> shares;
  for (const PolyhedronEdge& edge : edges(convex)) {
    const Vec3 &a = convex.vertices[edge.a], &b = convex.vertices[edge.b];
    shares.clear();
    add_grid_crossings(ground, a, b, shares);
    for (const double s : shares) compare(a + std::clamp(s, 0.0, 1.0) * (b - a));
  }
  const Cell first = locate(ground, low.x(), high.y()).cell;
  const Cell last = locate(ground, high.x(), low.y()).cell;
  for (int r = first.row; r <= last.row + 1; ++r)
    for (int c = first.col; c <= last.col + 1; ++c) {
      const Vec3 node = node_point(ground, r, c);
      const double side = lower_side(convex, Vec2(node.x(), node.y()));
      if (std::isfinite(side)) smallest = std::min(smallest, side - node.z());
    }
  return is_known_below ? smallest : std::numeric_limits<double>::quiet_NaN();
}

double clearance(const Body& body, const Trn& ground) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const Polyhedron& part : body.parts) {
    const double gap = clearance(part, ground);
    if (std::isnan(gap)) return gap;
    smallest = std::min(smallest, gap);
  }
  return smallest;
}

void move_by(Body& body, const Vec3& shift) {
  for (Polyhedron& part : body.parts)
    for (Vec3& v : part.vertices) v += shift;
  for (Vec3& v : body.shell.vertices) v += shift;
}

void rotate(Body& body, const Mat3& rotation) {
  for (Polyhedron& part : body.parts)
    for (Vec3& v : part.vertices) v = rotation * v;
  for (Vec3& v : body.shell.vertices) v = rotation * v;
}

}  // namespace talus
