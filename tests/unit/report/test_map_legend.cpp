// Legends of maps on the page.
#include <gtest/gtest.h>

#include <limits>

#include "io/style.hpp"
#include "report/map_legend.hpp"
#include "unit/report/shipped_texts.hpp"

using namespace talus;

TEST(HtmlLegend, NamesTheClassesThatAreDrawn) {
  RasterStyle style;
  style.title = "speed [m/s]";
  style.classes = {{0, {0, 0, 0, 0}, "none"},
                   {10, {255, 0, 0, 255}, "up to 10 m/s"},
                   {std::numeric_limits<double>::infinity(), {0, 0, 255, 255}, "> 10 m/s"}};
  EXPECT_EQ(
      html_legend(talus::testing::shipped_texts(), raster_qml(style)),
      "<span class=\"legend\"><span><i style=\"background-color:#ff0000\"></i>up to 10 m/s</span> "
      "<span><i style=\"background-color:#0000ff\"></i>&gt; 10 m/s</span> </span>");
}

TEST(HtmlLegend, ShowsWhatIsHatched) {
  RasterStyle style;
  style.classes = {{1, {255, 248, 103, 255}, "residual"}, {2, {255, 248, 103, 255}, "low"}};
  const std::string legend =
      html_legend(talus::testing::shipped_texts(), raster_qml(style), {1}, true);
  EXPECT_NE(legend.find("<i class=\"weak\" style=\"background-color:#fff867\"></i>residual<"),
            std::string::npos)
      << legend;
  EXPECT_NE(legend.find("<i style=\"background-color:#fff867\"></i>low<"), std::string::npos);
  EXPECT_NE(legend.find("<i class=\"unsure\"></i>class not certain<"), std::string::npos);
}

TEST(HtmlLegend, IsEmptyWithoutAStyle) {
  EXPECT_EQ(html_legend(talus::testing::shipped_texts(), ""), "");
}

TEST(StyleOf, ReadsWhatRasterQmlWrites) {
  RasterStyle style;
  style.band = 3;
  style.classes = {{0.25, {0, 0, 0, 0}, "none"},
                   {std::numeric_limits<double>::infinity(), {1, 128, 255, 255}, "above"}};
  const RasterStyle read = style_of(raster_qml(style));
  EXPECT_EQ(read.band, 3);
  ASSERT_EQ(read.classes.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(read.classes[i].upper, style.classes[i].upper);
    EXPECT_EQ(read.classes[i].colour, style.classes[i].colour);
    EXPECT_EQ(read.classes[i].label, style.classes[i].label);
  }
}
