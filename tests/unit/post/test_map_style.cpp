// Colours, shading and classes of maps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "post/maps/map_layers.hpp"
#include "post/maps/map_style.hpp"
#include "post/maps/shading.hpp"
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

TEST(MapStyle, SaysInWordsWhatIsShown) {
  const RasterStyle p95 = map_style(energy_layer(100, 0)), largest = map_style(energy_layer(1, 1));
  EXPECT_EQ(p95.heading, "Kinetic energy of a block, with its rotation");
  EXPECT_EQ(p95.legend, "95 % of all blocks over the cell stay below [kJ]");
  EXPECT_EQ(largest.legend, "Largest value of all blocks over the cell [kJ]");
  for (const MapLayerKind& kind : map_layers()) {
    MapLayer layer{kind.name, {}, {{kind.shown_band, kind.unit, "", false, {}}}};
    const RasterStyle style = map_style(layer);
    for (const std::string& words : {style.heading, style.legend})
      EXPECT_TRUE(!words.empty() && words.find('_') == std::string::npos) << kind.name << words;
  }
}

// The colour-blind tell lightness apart: each ramp grows lighter or darker throughout, and no two
// kinds have the same colours.
TEST(Ramp, HasItsOwnColoursThatGrowLighterOrDarkerAllTheWay) {
  const auto lightness = [](const Colour& c) {
    const auto linear = [](std::uint8_t v) { return std::pow(v / 255.0, 2.2); };
    return std::cbrt(0.2126 * linear(c[0]) + 0.7152 * linear(c[1]) + 0.0722 * linear(c[2]));
  };
  std::vector<std::array<Colour, 2>> ends;
  for (int kind = 0; kind <= static_cast<int>(Ramp::more); ++kind) {
    const auto ramp = static_cast<Ramp>(kind);
    constexpr int n = 8;
    const bool darker = lightness(ramp_colour(ramp, 1)) < lightness(ramp_colour(ramp, 0));
    for (int i = 0; i < n; ++i) {
      const double change = lightness(ramp_colour(ramp, (i + 1.0) / n)) -
                            lightness(ramp_colour(ramp, static_cast<double>(i) / n));
      EXPECT_GT(darker ? -change : change, 0.01) << kind << " " << i;
    }
    ends.push_back({ramp_colour(ramp, 0), ramp_colour(ramp, 1)});
  }
  std::sort(ends.begin(), ends.end());
  EXPECT_EQ(std::adjacent_find(ends.begin(), ends.end()), ends.end());
}

// Lambert's law with light from the north-west at 45 degrees: level ground, and a plane that turns
// to the east; it stays light; no ground, no brightness.
TEST(Shading, FollowsTheSlopeAndLeavesOutUnknownGround) {
  const PassageGrid grid{Vec2(0, 40), 10, 4, 4};
  const auto brightness = [](double cosine) { return 185 + 70 * cosine; };
  Trn level = plane_trn(0, 10, 5, 5), slope = plane_trn(0.75, 10, 5, 5);
  for (const float b : shading_of(level, grid).brightness)
    ASSERT_NEAR(b, brightness(std::sqrt(0.5)), 1e-3);
  for (const float b : shading_of(slope, grid).brightness)
    ASSERT_NEAR(b, brightness(0.8 * std::sqrt(0.5) - 0.6 * 0.5), 1e-3);

  level.elevation[0] = std::nan("");  // the north-west corner
  const Shading shading = shading_of(level, grid);
  ASSERT_EQ(shading.brightness.size(), 16U);
  EXPECT_TRUE(std::isnan(shading.brightness.front()));
  EXPECT_FALSE(std::isnan(shading.brightness.back()));
}
