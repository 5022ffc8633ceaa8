#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "post/maps/map_picture.hpp"
#include "post/maps/map_style.hpp"
#include "run_maker.hpp"

using namespace talus;
using namespace talus::testing;

namespace {

MapLayer energy_layer(int n_cells, int n_without_p95) {
  MapLayer layer{"ke_total", {}, {}};
  layer.bands = {{"ke_total_p95", "kJ", "", false, {}}, {"ke_total_max", "kJ", "", false, {}}};
  for (int i = 0; i < n_cells; ++i) {
    layer.cell.push_back(static_cast<std::uint32_t>(i));
    layer.bands[0].value.push_back(i < n_without_p95 ? std::nanf("") : 10.0F);
    layer.bands[1].value.push_back(20);
  }
  return layer;
}

}  // namespace

// A percentile that is missing at the rim of the reach would make the rim look safe.
TEST(MapStyle, ShowsAPercentileOnlyWhereNearlyAllCellsHaveIt) {
  EXPECT_EQ(map_style(energy_layer(100, 0)).band, 1);
  EXPECT_EQ(map_style(energy_layer(100, 5)).band, 1);
  EXPECT_EQ(map_style(energy_layer(100, 6)).band, 2);
  EXPECT_EQ(map_style(energy_layer(0, 0)).band, 2);
}

TEST(MapStyle, BreaksEnergiesAtTheSwissLimits) {
  const RasterStyle style = map_style(energy_layer(1, 0));
  const auto label_of = [&style](double value) {
    return std::find_if(style.classes.begin(), style.classes.end(),
                        [value](const StyleClass& c) { return value <= c.upper; })
        ->label;
  };
  EXPECT_EQ(label_of(30), "10 - 30 kJ (low)");
  EXPECT_EQ(label_of(30.01), "30 - 100 kJ (medium)");
  EXPECT_EQ(label_of(300.01), "300 - 1000 kJ (high)");
  EXPECT_EQ(label_of(1e9), "above 100000 kJ (high)");
  EXPECT_EQ(colour_of(style, 0)[3], 0);
}

// Lambert's law with light from the north-west at 45 degrees: level ground, and a plane that turns
// to the east; no ground, no brightness.
TEST(Shading, FollowsTheSlopeAndLeavesOutUnknownGround) {
  const PassageGrid grid{Vec2(0, 40), 10, 4, 4};
  const auto brightness = [](double cosine) { return 40 + 215 * cosine; };
  Trn level = plane_trn(0, 10, 5, 5), slope = plane_trn(0.75, 10, 5, 5);
  for (const float b : shading_of(level, grid).brightness)
    ASSERT_NEAR(b, brightness(std::sqrt(0.5)), 1e-3);
  for (const float b : shading_of(slope, grid).brightness)
    ASSERT_NEAR(b, brightness(0.8 * std::sqrt(0.5) - 0.6 * 0.5), 1e-3);

  level.elevation[0] = std::nan("");  // the north-west corner
  const Shading shading = shading_of(level, grid);
  EXPECT_TRUE(std::isnan(shading.brightness.front()));
  EXPECT_FALSE(std::isnan(shading.brightness.back()));
  const Picture picture =
      map_picture(shading, grid, std::vector<float>(16, 20), -9999, map_style(energy_layer(1, 0)));
  EXPECT_EQ(picture.pixel.front(), (Colour{255, 255, 255, 255}));
  EXPECT_NE(picture.pixel[static_cast<std::size_t>(picture.n_cols) * 900 + 900],
            (Colour{255, 255, 255, 255}));
}
