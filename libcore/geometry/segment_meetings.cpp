// Touches and crossings among segments of a plane map, without rounding errors.
#include "geometry/segment_meetings.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "geometry/orient2d.hpp"
#include "geometry/plan2d.hpp"

namespace talus {
namespace {

using Segment = std::array<int, 2>;

// Uniform grid over all segments. entries[begin[cell] .. begin[cell + 1]) are the segments that may
// pass through the cell.
struct SegmentGrid {
  Vec2 low = Vec2::Zero();
  double cell_size = 1;
  int n_x = 1, n_y = 1;
  std::vector<std::size_t> begin;
  std::vector<int> entries;
};

// Cells twice as wide as the mean segment, but not many more cells than segments.
void lay_out(const std::vector<Vec2>& points, const std::vector<Segment>& segments,
             SegmentGrid& grid) {
  Vec2 high = points.front();
  grid.low = points.front();
  for (const Vec2& p : points) grid.low = grid.low.cwiseMin(p), high = high.cwiseMax(p);
  double length = 0;
  for (const auto& [a, b] : segments) length += (points[b] - points[a]).norm();
  const auto n = static_cast<double>(segments.size());
  const Vec2 extent = high - grid.low;
  grid.cell_size = std::max({2 * length / n, std::sqrt(extent.x() * extent.y() / (4 * n)),
                             extent.maxCoeff() / (4 * n), 1e-300});
  grid.n_x = static_cast<int>(extent.x() / grid.cell_size) + 1;
  grid.n_y = static_cast<int>(extent.y() / grid.cell_size) + 1;
}

// Calls visit(cell) for every cell that segment a, b may pass through, row by row.
template <class Visit>
void for_each_cell(const SegmentGrid& grid, Vec2 a, Vec2 b, const Visit& visit) {
  constexpr double slack =
      1e-6;  // of a cell: a neighbour too many costs time, one too few a crossing
  a = (a - grid.low) / grid.cell_size;
  b = (b - grid.low) / grid.cell_size;
  if (a.y() > b.y()) std::swap(a, b);
  const auto cell_of = [](double at, int n) {
    return std::clamp(static_cast<int>(std::floor(at)), 0, n - 1);
  };
  const double rise = b.y() - a.y();
  const auto x_at = [&](double y) {
    return rise > 0 ? a.x() + (b.x() - a.x()) * std::clamp((y - a.y()) / rise, 0.0, 1.0) : a.x();
  };
  const int row_last = cell_of(b.y() + slack, grid.n_y);
  for (int row = cell_of(a.y() - slack, grid.n_y); row <= row_last; ++row) {
    const double x1 = rise > 0 ? x_at(row - slack) : a.x();
    const double x2 = rise > 0 ? x_at(row + 1 + slack) : b.x();
    const int column_last = cell_of(std::max(x1, x2) + slack, grid.n_x);
    for (int column = cell_of(std::min(x1, x2) - slack, grid.n_x); column <= column_last; ++column)
      visit(static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.n_x) +
            static_cast<std::size_t>(column));
  }
}

SegmentGrid sort_into_cells(const std::vector<Vec2>& points, const std::vector<Segment>& segments) {
  SegmentGrid grid;
  lay_out(points, segments, grid);
  const auto end_of = [&](std::size_t s, std::size_t end) { return points[segments[s][end]]; };
  grid.begin.assign(static_cast<std::size_t>(grid.n_x) * static_cast<std::size_t>(grid.n_y) + 1, 0);
  for (std::size_t s = 0; s < segments.size(); ++s)
    for_each_cell(grid, end_of(s, 0), end_of(s, 1), [&](std::size_t cell) { ++grid.begin[cell]; });
  std::size_t total = 0;
  for (std::size_t& count : grid.begin) total += count, count = total;
  grid.entries.resize(total);
  for (std::size_t s = segments.size(); s-- > 0;)
    for_each_cell(grid, end_of(s, 0), end_of(s, 1), [&](std::size_t cell) {
      grid.entries[--grid.begin[cell]] = static_cast<int>(s);
    });
  return grid;
}

class MeetingFinder {
 public:
  MeetingFinder(const std::vector<Vec2>& points, const std::vector<Segment>& segments)
      : points_(points), segments_(segments) {}

  void test(int s, int t) {
    if (boxes_apart(s, t)) return;
    const auto [a, b] = segments_[s];
    const auto [c, d] = segments_[t];
    if (a == c || a == d || b == c || b == d) {
      test_joined(s, t);
      return;
    }
    const int side_c = side(a, b, c), side_d = side(a, b, d);
    if (side_c * side_d > 0) return;
    const int side_a = side(c, d, a), side_b = side(c, d, b);
    if (side_a * side_b > 0) return;
    if (side_c * side_d < 0 && side_a * side_b < 0) {
      found.crossings.push_back({std::min(s, t), std::max(s, t)});
      return;
    }
    if (side_c == 0) touch(s, c);
    if (side_d == 0) touch(s, d);
    if (side_a == 0) touch(t, a);
    if (side_b == 0) touch(t, b);
  }

  SegmentMeetings found;

 private:
  [[nodiscard]] const Vec2& at(int point) const { return points_[point]; }
  [[nodiscard]] int side(int a, int b, int c) const { return orient2d(at(a), at(b), at(c)); }

  [[nodiscard]] bool boxes_apart(int s, int t) const {
    const auto [a, b] = segments_[s];
    const auto [c, d] = segments_[t];
    for (const Eigen::Index axis : {0, 1}) {
      const auto [s_low, s_high] = std::minmax(at(a)[axis], at(b)[axis]);
      const auto [t_low, t_high] = std::minmax(at(c)[axis], at(d)[axis]);
      if (s_high < t_low || t_high < s_low) return true;
    }
    return false;
  }

  // Segments with a common end meet elsewhere only where they lie on one line.
  void test_joined(int s, int t) {
    const auto [a, b] = segments_[s];
    const auto [c, d] = segments_[t];
    const int common = a == c || a == d ? a : b;
    const int end_s = common == a ? b : a, end_t = common == c ? d : c;
    if (end_s == end_t || side(common, end_s, end_t) != 0) return;
    touch(s, end_t);
    touch(t, end_s);
  }

  // `point` is on the line of segment s; is it between the ends?
  void touch(int s, int point) {
    const auto [a, b] = segments_[s];
    if (point == a || point == b || a == b) return;
    const Vec2 low = at(a).cwiseMin(at(b)), high = at(a).cwiseMax(at(b));
    const Vec2& p = at(point);
    if (p.x() < low.x() || p.x() > high.x() || p.y() < low.y() || p.y() > high.y()) return;
    found.touches.push_back({s, point});
  }

  const std::vector<Vec2>& points_;
  const std::vector<Segment>& segments_;
};

template <class T>
void sort_and_keep_one(std::vector<T>& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

}  // namespace

SegmentMeetings find_segment_meetings(const std::vector<Vec2>& points,
                                      const std::vector<Segment>& segments) {
  if (segments.empty()) return {};
  const SegmentGrid grid = sort_into_cells(points, segments);
  MeetingFinder finder(points, segments);
  for (std::size_t cell = 0; cell + 1 < grid.begin.size(); ++cell)
    for (std::size_t i = grid.begin[cell]; i < grid.begin[cell + 1]; ++i)
      for (std::size_t j = i + 1; j < grid.begin[cell + 1]; ++j)
        finder.test(grid.entries[i], grid.entries[j]);
  sort_and_keep_one(finder.found.touches);
  sort_and_keep_one(finder.found.crossings);
  return std::move(finder.found);
}

double crossing_share(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const Vec2 along = b - a, other = d - c, gap = c - a;
  return cross(gap, other) / cross(along, other);
}

}  // namespace talus
