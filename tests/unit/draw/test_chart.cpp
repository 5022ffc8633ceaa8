// Round ticks and line charts.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "draw/chart.hpp"
#include "draw/ticks.hpp"

using namespace talus;

TEST(RoundTicks, AreRoundAndInside) {
  EXPECT_EQ(round_ticks(0, 10, 5), (std::vector<double>{0, 2, 4, 6, 8, 10}));
  const auto ticks = round_ticks(-0.7, 13.2, 5);
  ASSERT_GE(ticks.size(), 2u);
  EXPECT_GE(ticks.front(), -0.7);
  EXPECT_LE(ticks.back(), 13.2);
  EXPECT_DOUBLE_EQ(ticks[1] - ticks[0], 5);
}

namespace {

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

}  // namespace

// A gap starts the line anew: two pens down, none through the missing value.
TEST(Chart, MissingValuesAreGaps) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  Chart chart{"t", "x", "y", {{"", "#123456", {0, 1, 2, 3, 4}, {1, 2, none, 4, 5}}}, false};
  const std::string svg = chart_svg(chart);
  const std::size_t line = svg.find("rgb(7.058824%");  // 0x12 of 255
  const std::size_t begin = svg.find("d=\"", line), end = svg.find('"', begin + 3);
  const std::string path = svg.substr(begin, end - begin);
  EXPECT_EQ(count(path, "M"), 2u);
  EXPECT_EQ(count(path, "L"), 2u);
}

TEST(Chart, HoldsWhateverComes) {
  const double huge = std::numeric_limits<double>::infinity();
  EXPECT_NE(chart_svg({"empty", "x", "y", {}, false}).find("</svg>"), std::string::npos);
  const std::string svg =
      chart_svg({"<odd>", "x", "y", {{"", "#ff0000", {0, huge, 2}, {-1, 5, 0}}}, true});
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
  EXPECT_NE(svg.find("&lt;odd&gt;"), std::string::npos);
}
