#include <gtest/gtest.h>

#include <limits>

#include "io/style.hpp"
#include "report/map_legend.hpp"

using namespace talus;

TEST(HtmlLegend, NamesTheClassesThatAreDrawn) {
  RasterStyle style;
  style.title = "speed [m/s]";
  style.classes = {{0, {0, 0, 0, 0}, "none"},
                   {10, {255, 0, 0, 255}, "up to 10 m/s"},
                   {std::numeric_limits<double>::infinity(), {0, 0, 255, 255}, "> 10 m/s"}};
  EXPECT_EQ(html_legend(raster_qml(style)),
            "<span class=\"legend\"><span><i style=\"background:#ff0000\"></i>up to 10 m/s</span> "
            "<span><i style=\"background:#0000ff\"></i>&gt; 10 m/s</span> </span>");
}

TEST(HtmlLegend, IsEmptyWithoutAStyle) { EXPECT_EQ(html_legend(""), ""); }
