// Scan conversion of a TIN to a regular grid of nodes, triangle by triangle.
#include "terrain/grid_tin.hpp"

#include <limits>

namespace talus {
namespace {

constexpr double rounding = 1e-9;     // of a cell
constexpr double inside = 1e-6;       // of a cell: a node this far from the edges is not on the
                                      // border
constexpr double layers_apart = 0.1;  // [m]

const Vec3& corner(const Tin& tin, const std::array<int, 3>& triangle, std::size_t k) {
  return tin.points[triangle[k]];
}

double area_twice(const Vec3& a, const Vec3& b, const Vec3& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

// In grid coordinates: x is the column, y the row of a node, both real numbers.
struct Crossing {
  double col = 0, z = 0;
};

// Where the edge from a to b is in `row`, which lies between a.y() and b.y(). The caller orders the
// ends by the index of the point, so that both triangles of the edge compute the same numbers.
Crossing cross_edge(const Vec3& a, const Vec3& b, double row) {
  if (row == b.y()) return {b.x(), b.z()};
  const double t = (row - a.y()) / (b.y() - a.y());
  return {a.x() + t * (b.x() - a.x()), a.z() + t * (b.z() - a.z())};
}

// Extent of a triangle in one row of nodes.
struct Span {
  Crossing west{std::numeric_limits<double>::infinity(), 0};
  Crossing east{-std::numeric_limits<double>::infinity(), 0};
  void include(const Crossing& crossing) {
    if (crossing.col < west.col) west = crossing;
    if (crossing.col > east.col) east = crossing;
  }
};

struct GridTriangle {
  std::array<Vec3, 3> point;  // ordered by their index in the TIN
  double row_first, row_last;
};

Span span_in_row(const GridTriangle& triangle, double row) {
  const auto& [a, b, c] = triangle.point;
  Span span;
  for (const auto& [from, to] : {std::pair(&a, &b), std::pair(&a, &c), std::pair(&b, &c)}) {
    if (std::min(from->y(), to->y()) > row || std::max(from->y(), to->y()) < row) continue;
    if (from->y() == to->y()) {
      span.include({from->x(), from->z()});
      span.include({to->x(), to->z()});
    } else {
      span.include(cross_edge(*from, *to, row));
    }
  }
  return span;
}

// Whole numbers from `first` to `last`, clipped to 0 .. n - 1; a number just outside counts.
struct IndexRange {
  int first, last;
  IndexRange(double from, double to, int n)
      : first(static_cast<int>(std::clamp(std::ceil(from - rounding), 0.0, n * 1.0))),
        last(static_cast<int>(std::clamp(std::floor(to + rounding), -1.0, n - 1.0))) {}
};

// `two`: where nodes off the ends of the span are asked for another height; may be null.
void fill_span(const Span& span, int row, int n_cols, double* elevation, TwoHeights* two) {
  const IndexRange cols(span.west.col, span.east.col, n_cols);
  const double width = span.east.col - span.west.col;
  const double slope = width > 0 ? (span.east.z - span.west.z) / width : 0;
  for (int col = cols.first; col <= cols.last; ++col) {
    const double z = span.west.z + slope * std::clamp(col - span.west.col, 0.0, width);
    if (two != nullptr && std::abs(elevation[col] - z) > layers_apart &&
        col > span.west.col + inside && col < span.east.col - inside && two->n++ == 0)
      *two = {1, row, col, z, elevation[col]};
    elevation[col] = z;
  }
}

void fill_triangle(const GridTriangle& triangle, const GridFrame& frame, double* elevation,
                   TwoHeights* two) {
  const IndexRange rows(triangle.row_first, triangle.row_last, frame.n_rows);
  for (int row = rows.first; row <= rows.last; ++row) {
    const double place = std::clamp<double>(row, triangle.row_first, triangle.row_last);
    const bool is_off = row > triangle.row_first + inside && row < triangle.row_last - inside;
    fill_span(span_in_row(triangle, place), row, frame.n_cols,
              elevation + static_cast<std::size_t>(row) * static_cast<std::size_t>(frame.n_cols),
              is_off ? two : nullptr);
  }
}

}  // namespace

MapWindow extent(const Tin& tin) {
  constexpr double far = std::numeric_limits<double>::infinity();
  MapWindow window{far, far, -far, -far};
  for (const Vec3& point : tin.points) {
    window.x_min = std::min(window.x_min, point.x());
    window.x_max = std::max(window.x_max, point.x());
    window.y_min = std::min(window.y_min, point.y());
    window.y_max = std::max(window.y_max, point.y());
  }
  return {window.x_min + tin.origin.x(), window.y_min + tin.origin.y(),
          window.x_max + tin.origin.x(), window.y_max + tin.origin.y()};
}

double natural_cell_size(const Tin& tin) {
  double area = 0;
  for (const auto& triangle : tin.triangles)
    area += 0.5 * area_twice(corner(tin, triangle, 0), corner(tin, triangle, 1),
                             corner(tin, triangle, 2));
  if (!(area > 0)) return 0;
  const double distance = std::sqrt(area / static_cast<double>(tin.points.size()));
  const double power = std::pow(10, std::floor(std::log10(distance)));
  for (const double step : {5.0, 2.0})
    if (step * power <= distance) return step * power;
  return power;
}

std::vector<double> grid_tin(const Tin& tin, const GridFrame& frame,
                             const ProgressFunction& progress, TwoHeights* two) {
  std::vector<double> elevation(
      static_cast<std::size_t>(frame.n_rows) * static_cast<std::size_t>(frame.n_cols),
      std::numeric_limits<double>::quiet_NaN());
  const double west = frame.x(0) - tin.origin.x(), north = frame.y(0) - tin.origin.y();
  const auto in_grid = [&](int point) {
    const Vec3& p = tin.points[point];
    return Vec3((p.x() - west) / frame.cell_size, (north - p.y()) / frame.cell_size,
                p.z() + tin.origin.z());
  };
  for (std::size_t t = 0; t < tin.triangles.size(); ++t) {
    if (progress && t % 100'000 == 0)
      progress(static_cast<double>(t) / static_cast<double>(tin.triangles.size()));
    std::array<int, 3> index = tin.triangles[t];
    if (!(area_twice(corner(tin, index, 0), corner(tin, index, 1), corner(tin, index, 2)) > 0))
      continue;
    std::sort(index.begin(), index.end());
    GridTriangle triangle{{in_grid(index[0]), in_grid(index[1]), in_grid(index[2])}, 0, 0};
    const auto& [a, b, c] = triangle.point;
    triangle.row_first = std::min({a.y(), b.y(), c.y()});
    triangle.row_last = std::max({a.y(), b.y(), c.y()});
    fill_triangle(triangle, frame, elevation.data(), two);
  }
  return elevation;
}

}  // namespace talus
