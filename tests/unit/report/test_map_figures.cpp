// Figures of maps on the page.
#include <gtest/gtest.h>

#include <algorithm>

#include "io/style.hpp"
#include "post/maps/map_layers.hpp"
#include "post/maps/map_style.hpp"
#include "report/map_figures.hpp"
#include "unit/report/shipped_texts.hpp"

using namespace talus;

namespace {

std::size_t count(const std::string& text, const std::string& word) {
  std::size_t n = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++n;
  return n;
}

// The style of a layer over no cell: its classes do not depend on the values.
std::string qml_of(const MapLayerKind& kind) {
  return raster_qml(map_style(make_layer(kind, {{}, {}, 1, {}, {}})));
}

}  // namespace

// Every row of the table has its place in the report, with a legend of all classes that are drawn.
TEST(MapFigures, ShowEveryLayerOfTheTableWithItsLegend) {
  std::vector<MapPicture> pictures;
  for (const MapLayerKind& kind : map_layers()) pictures.push_back({kind.name, qml_of(kind), {}});
  std::reverse(pictures.begin(), pictures.end());
  const std::string all = map_figures(talus::testing::shipped_texts(), {}, pictures);
  EXPECT_EQ(count(all, "<figure"), map_layers().size());
  std::size_t at = 0;
  for (const MapLayerKind& kind : map_layers()) {
    const std::string file = "<code>maps/" + std::string(kind.name) + ".tif</code>";
    const std::size_t here = all.find(file);
    ASSERT_NE(here, std::string::npos) << kind.name;
    EXPECT_GT(here, at) << kind.name << ": not in the order of the table";
    at = here;
    const std::string legend = all.substr(here, all.find("</figure>", here) - here);
    EXPECT_EQ(count(legend, "<i style"), kind.breaks.size() + 1) << kind.name;
    EXPECT_NE(all.find("<b>" + std::string(kind.title) + "</b>: " + kind.caption + " [" +
                       kind.unit + "]"),
              std::string::npos)
        << kind.name;
  }
}

TEST(MapFigures, LeaveOutLayersWithoutAPicture) {
  const std::string one =
      map_figures(talus::testing::shipped_texts(), {}, {{map_layers().back().name, "", {}}});
  EXPECT_EQ(count(one, "<figure"), 1U);
  EXPECT_NE(one.find(map_layers().back().title), std::string::npos);
}

// Each layer once a case, in one of the two parts.
TEST(CaseFigures, StandSideBySideLayerByLayer) {
  std::vector<MapPicture> pictures;
  for (const MapLayerKind& kind : map_layers()) pictures.push_back({kind.name, "", {}});
  const CasePictures cases = {{"far", pictures}, {"<near>", pictures}};
  const std::string first = case_figures(talus::testing::shipped_texts(), {}, cases, true),
                    rest = case_figures(talus::testing::shipped_texts(), {}, cases, false);
  EXPECT_EQ(count(first, "<figure") + count(rest, "<figure"), 2 * map_layers().size());
  EXPECT_EQ(count(first, "<h3>"), 4U);
  EXPECT_EQ(count(first, "<div class=\"maps\">"), 4U);
  EXPECT_EQ(count(first, "<code>maps/far/velocity.tif</code>"), 1U);
  EXPECT_EQ(count(first + rest, "<near>"), 0U);
  EXPECT_LT(first.find("maps/far/velocity"), first.find("maps/&lt;near&gt;/velocity"));
  EXPECT_LT(first.find("maps/&lt;near&gt;/velocity"), first.find("maps/far/ke_total"));
}
