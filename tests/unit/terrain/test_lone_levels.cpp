// Areas of an undeclared value.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "terrain/lone_levels.hpp"

namespace {

using namespace talus;

constexpr int n_rows = 30, n_cols = 40;
constexpr double cell_size = 5;

double slope(int row, int col) { return 1000 + 4.0 * row + 0.5 * col; }

// Result on a raster of 30 x 40 cells.
std::optional<LoneLevel> find(const std::function<double(int, int)>& elevation,
                              double size = cell_size) {
  const double step = impossible_step(size);
  const auto each_row = [&](auto&& take) {
    std::vector<double> row(n_cols);
    for (int r = 0; r < n_rows; ++r) {
      for (int c = 0; c < n_cols; ++c) row[static_cast<std::size_t>(c)] = elevation(r, c);
      take(row.data());
    }
  };
  StepFinder steps(n_cols, step);
  each_row([&](const double* row) { steps.add_row(row); });
  if (steps.values().empty()) return std::nullopt;
  LoneLevels levels(n_cols, step, steps.values());
  each_row([&](const double* row) { levels.add_row(row); });
  return levels.worst();
}

TEST(LoneLevels, RimsOfAnUndeclaredValueAreFound) {
  for (const double value : {0.0, -1.0, -999.0, 255.0, 9999.0}) {
    const auto found = find([&](int r, int c) { return r < 6 || c < 8 ? value : slope(r, c); });
    ASSERT_TRUE(found) << value;
    EXPECT_EQ(found->value, value);
    EXPECT_EQ(found->n_cells, 6 * n_cols + 24 * 8);
    EXPECT_EQ(found->n_beside, 32 + 24);
    EXPECT_EQ(found->n_far, found->n_beside);
    EXPECT_EQ(found->row, 0);
  }
}

TEST(LoneLevels, GapsAndSingleCellsAreFound) {
  const auto gap = find([](int r, int c) { return c == 20 || c == 21 ? 0 : slope(r, c); });
  ASSERT_TRUE(gap);
  EXPECT_EQ(gap->n_cells, 2 * n_rows);
  EXPECT_EQ(gap->col, 20);
  const auto cell = find([](int r, int c) { return r == 7 && c == 9 ? 2500 : slope(r, c); });
  ASSERT_TRUE(cell);
  EXPECT_EQ(cell->n_cells, 1);
  EXPECT_EQ(cell->n_beside, 4);
  EXPECT_EQ(cell->row, 7);
  EXPECT_EQ(cell->col, 9);
}

// An area in the shape of a U, whose arms are joined by a later row.
TEST(LoneLevels, ArmsThatMeetFartherDownAreOneArea) {
  const auto found = find([](int r, int c) {
    const bool arm = (c == 5 || c == 15) && r >= 4 && r <= 12;
    return arm || (r == 13 && c >= 5 && c <= 15) ? 0 : slope(r, c);
  });
  ASSERT_TRUE(found);
  EXPECT_EQ(found->n_cells, 9 + 9 + 11);
}

TEST(LoneLevels, GroundIsLeftAlone) {
  // a wall of 300 m over one cell between slopes: no level, so no area to refuse
  EXPECT_FALSE(find([](int r, int c) { return slope(r, c) + (c < 20 ? 300 : 0); }));
  // a lake below a cliff of 150 m, with a shore elsewhere
  EXPECT_FALSE(find([](int r, int c) { return r > 20 ? 900 : 905 + 150.0 * (c < 20) + r; }));
  // steps of 240 m on cells of 90 m: a slope of 69 degrees
  EXPECT_FALSE(find([](int r, int c) { return r == 7 && c == 9 ? 1270 : slope(r, c); }, 90));
  // unknown ground beside a level says nothing
  EXPECT_FALSE(find([](int r, int c) {
    return c == 11 ? std::nan("") : c < 11 ? 0 : slope(r, c);
  }));
}

}  // namespace
