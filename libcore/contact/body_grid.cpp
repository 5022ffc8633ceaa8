// Puts bodies into the columns of a grid, and finds those near a box.
#include "contact/body_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/error.hpp"

namespace talus {
namespace {

using std::size_t;

struct Columns {
  int x0 = 0, x1 = -1, y0 = 0, y1 = -1;  // first and last
};

int column(double x, double low, double cell_size, int n) {
  return static_cast<int>(std::clamp(std::floor((x - low) / cell_size), -1.0, double(n)));
}

Columns columns_of(const BodyGrid& grid, const Vec2& low, const Vec2& high) {
  const auto first = [&](int k, int n) {
    return std::max(0, column(low[k], grid.low[k], grid.cell_size, n));
  };
  const auto last = [&](int k, int n) {
    return std::min(n - 1, column(high[k], grid.low[k], grid.cell_size, n));
  };
  return {first(0, grid.nx), last(0, grid.nx), first(1, grid.ny), last(1, grid.ny)};
}

template <class Visit>
void for_each_column(const BodyGrid& grid, const Vec2& low, const Vec2& high, Visit&& visit) {
  const Columns c = columns_of(grid, low, high);
  for (int y = c.y0; y <= c.y1; ++y)
    for (int x = c.x0; x <= c.x1; ++x)
      visit(static_cast<size_t>(y) * static_cast<size_t>(grid.nx) + static_cast<size_t>(x));
}

// Columns are as wide as the bodies, so that all entries together are a few times the number of
// bodies, and there are no more columns than that where bodies are far apart.
void choose_columns(std::span<const double> radius, const Vec2& low, const Vec2& high,
                    BodyGrid& grid) {
  double sum_sq = 0;
  for (const double r : radius) sum_sq += 4 * r * r;
  const auto n = static_cast<double>(radius.size());
  const Vec2 extent = high - low;
  grid.low = low;
  grid.cell_size = std::max(std::sqrt(sum_sq / n), 1e-9 * extent.maxCoeff());
  if (!(grid.cell_size > 0)) grid.cell_size = 1;
  const auto count = [&](double side) { return std::floor(side / grid.cell_size) + 1; };
  while (count(extent.x()) * count(extent.y()) > 4 * n + 16) grid.cell_size *= 2;
  grid.nx = static_cast<int>(count(extent.x()));
  grid.ny = static_cast<int>(count(extent.y()));
}

}  // namespace

BodyGrid make_body_grid(std::span<const Vec3> centre, std::span<const double> radius) {
  TALUS_ASSERT(centre.size() == radius.size());
  BodyGrid grid;
  grid.n_bodies = static_cast<int>(centre.size());
  if (centre.empty()) return grid;
  // beyond the rounding of the vertices that the ball is around
  const auto ball = [&](size_t i) { return Vec2::Constant(radius[i] * (1 + 1e-9) + 1e-9); };
  Vec2 low = Vec2::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (size_t i = 0; i < centre.size(); ++i) {
    low = low.cwiseMin(centre[i].head<2>() - ball(i));
    high = high.cwiseMax(centre[i].head<2>() + ball(i));
  }
  choose_columns(radius, low, high, grid);
  grid.begin.assign(static_cast<size_t>(grid.nx) * static_cast<size_t>(grid.ny) + 1, 0);
  const auto for_each = [&](auto&& visit) {
    for (size_t i = 0; i < centre.size(); ++i) {
      const Vec2 at = centre[i].head<2>();
      for_each_column(grid, at - ball(i), at + ball(i), [&](size_t c) { visit(i, c); });
    }
  };
  for_each([&](size_t, size_t c) { ++grid.begin[c + 1]; });
  std::partial_sum(grid.begin.begin(), grid.begin.end(), grid.begin.begin());
  grid.bodies.resize(grid.begin.back());
  std::vector<int> next(grid.begin.begin(), grid.begin.end() - 1);
  for_each([&](size_t i, size_t c) { grid.bodies[next[c]++] = static_cast<int>(i); });
  return grid;
}

void find_near(const BodyGrid& grid, const Box& box, std::vector<int>& near) {
  near.clear();
  if (grid.n_bodies == 0) return;
  if (!box.low.allFinite() || !box.high.allFinite()) {
    near.resize(grid.n_bodies);
    std::iota(near.begin(), near.end(), 0);
    return;
  }
  for_each_column(grid, box.low.head<2>(), box.high.head<2>(), [&](size_t c) {
    near.insert(near.end(), grid.bodies.begin() + grid.begin[c],
                grid.bodies.begin() + grid.begin[c + 1]);
  });
  std::sort(near.begin(), near.end());
  near.erase(std::unique(near.begin(), near.end()), near.end());
}

}  // namespace talus
