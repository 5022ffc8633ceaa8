// Frames of grids: windows, alignment, local origin.
#include <gtest/gtest.h>

#include "base/random.hpp"
#include "terrain/grid_frame.hpp"

namespace {

using talus::GridFrame;
using talus::MapWindow;

TEST(GridFrame, NodesAreMultiplesOfTheCellSizeInsideOrAroundTheWindow) {
  talus::Random random(1, "frames");
  for (int trial = 0; trial < 2000; ++trial) {
    const double size = trial % 2 == 0 ? 2.5 : random.uniform(0.3, 12);
    const double x = random.uniform(-1e6, 1e6), y = random.uniform(-1e6, 6e6);
    const MapWindow window{x, y, x + random.uniform(40, 300), y + random.uniform(40, 300)};
    const GridFrame inside = talus::frame_inside(window, size);
    const GridFrame around = talus::frame_covering(window, size);
    for (const GridFrame& frame : {inside, around}) {
      const double col = frame.x(0) / size, row = frame.y(0) / size;
      EXPECT_NEAR(col, std::round(col), 1e-9 * std::abs(col) + 1e-9);
      EXPECT_NEAR(row, std::round(row), 1e-9 * std::abs(row) + 1e-9);
    }
    const MapWindow a = talus::extent(inside), b = talus::extent(around);
    const double slack = 1e-6 * size + 1e-8;
    EXPECT_GE(a.x_min, window.x_min - slack);
    EXPECT_LE(a.y_max, window.y_max + slack);
    EXPECT_LT(a.x_min - size, window.x_min);  // and there is no further node inside
    EXPECT_GT(a.x_max + size, window.x_max);
    EXPECT_LE(b.x_min, window.x_min + slack);
    EXPECT_LE(b.y_min, window.y_min + slack);
    EXPECT_GE(b.x_max, window.x_max - slack);
    EXPECT_GE(b.y_max, window.y_max - slack);
    EXPECT_LE(around.n_cols, inside.n_cols + 2);
  }
}

// 0.1 is not a binary number: 0.3 / 0.1 must still be three cells.
TEST(GridFrame, RoundingDoesNotCostANode) {
  const GridFrame frame = talus::frame_inside({0.3, 0.1, 0.9, 0.7}, 0.1);
  EXPECT_EQ(frame.n_cols, 7);
  EXPECT_EQ(frame.n_rows, 7);
  EXPECT_EQ(talus::frame_covering({0.3, 0.1, 0.9, 0.7}, 0.1).n_cols, 7);
}

TEST(GridFrame, PartsKeepTheLatticeAndCoverTheWindow) {
  const GridFrame whole{100, 80, 4.99768, {248'362.76, 351'760.36}};
  const MapWindow window{whole.x(10.2), whole.y(40.7), whole.x(20), whole.y(30.1)};
  const GridFrame part = talus::part_covering(whole, window);
  EXPECT_EQ(part.n_cols, 11);
  EXPECT_EQ(part.n_rows, 12);
  EXPECT_EQ(part.x(0), whole.x(10));
  EXPECT_EQ(part.y(0), whole.y(30));
  EXPECT_TRUE(talus::part_covering(whole, {0, 0, 10, 10}).empty());
  const GridFrame all = talus::part_covering(whole, {0, 0, 1e6, 1e6});
  EXPECT_EQ(all.n_rows, 100);
  EXPECT_EQ(all.n_cols, 80);
}

TEST(FrameOnDem, TakesTheDemsOwnNodesForItsOwnCellSize) {
  const GridFrame dem{146, 172, 4.997678230579, {248362.7612662384, 351760.3630344}};
  const MapWindow everywhere{-1e9, -1e9, 1e9, 1e9};
  for (const double size : {0.0, 4.997678230579, 4.99768, 4.9977}) {
    const GridFrame frame = talus::frame_on_dem(dem, size, everywhere);
    EXPECT_EQ(frame.cell_size, dem.cell_size);
    EXPECT_EQ(frame.north_west, dem.north_west);
    EXPECT_EQ(frame.n_rows, 146);
    EXPECT_EQ(frame.n_cols, 172);
  }
  EXPECT_EQ(talus::frame_on_dem(dem, 5, everywhere).cell_size, 5);
}

// The square of every node lies on the cells of the DEM, and another row would not fit.
TEST(FrameOnDem, UsesTheDemUpToItsBorder) {
  const GridFrame dem{40, 60, 2.5, {1001.25, 8998.75}};  // cells over 1000..1150, 8900..9000
  const MapWindow everywhere{-1e9, -1e9, 1e9, 1e9};
  for (const double size : {1.0, 2.0, 3.0, 5.0, 10.0, 12.5}) {
    const MapWindow nodes = talus::extent(talus::frame_on_dem(dem, size, everywhere));
    const double half = std::max(size, 2.5) / 2;
    EXPECT_GE(nodes.x_min - half, 1000);
    EXPECT_LT(nodes.x_min - half, 1000 + size);
    EXPECT_LE(nodes.x_max + half, 1150);
    EXPECT_GT(nodes.x_max + half, 1150 - size);
    EXPECT_GE(nodes.y_min - half, 8900);
    EXPECT_LE(nodes.y_max + half, 9000);
  }
  const MapWindow part = talus::extent(talus::frame_on_dem(dem, 10, {1044, 8931, 1071, 8969}));
  EXPECT_EQ(part.x_min, 1040);
  EXPECT_EQ(part.x_max, 1080);
  EXPECT_EQ(part.y_min, 8930);
  EXPECT_EQ(part.y_max, 8970);
  EXPECT_TRUE(talus::frame_on_dem(dem, 10, {2000, 8931, 2071, 8969}).empty());
}

TEST(GridFrame, TooManyNodesAreRefused) {
  EXPECT_THROW(static_cast<void>(talus::frame_inside({0, 0, 1e6, 1e6}, 0.01)), talus::InputError);
  EXPECT_TRUE(talus::frame_inside({0.1, 0.1, 0.9, 0.9}, 1).empty());
}

// Coordinates of the map survive the change to the local origin and back, bit for bit.
TEST(GridFrame, LocalOriginLosesNothing) {
  const GridFrame frame{146, 172, 4.997678230579, {248362.7612662384, 351760.3630344}};
  const talus::Trn trn = talus::make_trn(frame, "", {});
  EXPECT_LT(trn.node0.norm(), 2000);
  EXPECT_GE(trn.node0.x(), 0);
  EXPECT_EQ(talus::frame_of(trn).north_west, frame.north_west);
  EXPECT_EQ(trn.origin.z(), 0);
}

}  // namespace
