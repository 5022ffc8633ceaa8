// Change by a fence: maps with and without, their colours.
#include <gtest/gtest.h>

#include <map>

#include "post/fence/fence_change.hpp"
#include "post/maps/map_style.hpp"
#include "run_maker.hpp"

using namespace talus;
using namespace talus::testing;

namespace {

const PassageGrid grid{Vec2(0, 8), 4, 2, 3};

// A cube of 2 m that comes to rest in the middle of the cell (row 0, col) and passed the cells
// before it with speed 5.
RunFile run_to(int col) {
  RunFile run;
  add_box(run, {2, 2, 2}, {2, 6, 10});
  add_frame(run, 0, {standing({2, 6, 10})});
  add_frame(run, 9, {standing({2.0 + 4 * col, 6, 1})});
  for (int c = 0; c <= col; ++c) {
    Passage passage;
    passage.cell = c;
    passage.largest.speed = 5;
    run.passages.push_back(passage);
  }
  return run;
}

}  // namespace

// Two runs without the fence end in column 2; of two with it, one is held in column 1.
TEST(FenceChange, IsWithMinusWithoutARun) {
  GroundSums with, without;
  for (const int col : {1, 2}) add_run(with, grid, run_to(col), 0.05);
  for (const int col : {2, 2}) add_run(without, grid, run_to(col), 0.05);
  const MapLayer layer = change_layer(with, without, grid.cell_size);
  for (const MapBand& band : layer.bands)
    EXPECT_EQ(band.overview, OverviewValue::farthest_from_zero) << band.name;
  std::map<std::uint32_t, float> thickness;
  for (std::size_t i = 0; i < layer.cell.size(); ++i)
    thickness[layer.cell[i]] = layer.bands[0].value[i];
  EXPECT_NEAR(thickness[0], 0, 1e-7);
  EXPECT_NEAR(thickness[1], 8.0 / 16 / 2, 1e-6);
  EXPECT_NEAR(thickness[2], -8.0 / 16 / 2, 1e-6);
  for (const float change : layer.bands[1].value) EXPECT_EQ(change, 0);

  const DepositChange change = deposit_change(with, without);
  EXPECT_NEAR(change.with, 8, 1e-9);
  EXPECT_NEAR(change.without, 8, 1e-9);
  EXPECT_NEAR(change.more, 4, 1e-9);
  EXPECT_NEAR(change.less, 4, 1e-9);
}

TEST(FenceChange, TakesNoPassageAsSpeedZero) {
  GroundSums with, without;
  add_run(with, grid, run_to(1), 0.05);
  add_run(without, grid, run_to(2), 0.05);
  const MapLayer layer = change_layer(with, without, grid.cell_size);
  EXPECT_EQ(layer.bands[1].value, (std::vector<float>{0, 0, -5}));
}

// Each side of the colours holds the values of its label; no change is transparent.
TEST(ChangeStyle, TellsLessFromMore) {
  MapLayer layer = change_layer({}, {}, 4);
  const RasterStyle style = change_style(layer, {"Change", "with minus without"});
  EXPECT_EQ(colour_of(style, 0)[3], 0);
  EXPECT_EQ(colour_of(style, 0.04)[3], 0);
  EXPECT_EQ(colour_of(style, -0.04)[3], 0);
  EXPECT_GT(colour_of(style, -3)[2], colour_of(style, -3)[0]);  // blue
  EXPECT_GT(colour_of(style, 3)[0], colour_of(style, 3)[2]);    // red
  EXPECT_EQ(style.legend, "with minus without");
  EXPECT_EQ(style.classes.front().label, "less by more than 4 m");
  EXPECT_EQ(style.classes.back().label, "more by more than 4 m");
}

TEST(ChangeStyle, ShowsSmallChangesWhereAllAreSmall) {
  MapLayer layer = change_layer({}, {}, 4);
  const auto label_with = [&layer](std::vector<float> values) {
    layer.bands[0].value = std::move(values);
    return change_style(layer, {"Change", "with minus without"}).classes.back().label;
  };
  EXPECT_EQ(label_with({0.001F, -0.06F}), "more by more than 4 m");
  EXPECT_EQ(label_with({0.001F, -0.04F}), "more by more than 0.4 m");
  EXPECT_EQ(label_with({0.001F}), "more by more than 0.04 m");
  EXPECT_EQ(change_style(layer, {"Change", ""}).classes[5].label, "less by 0.0005 - 0.0025 m");
  EXPECT_EQ(label_with({1e-12F}), "more by more than 4 m");  // rounding
}
