// Coordinates that a program has rounded as it wrote them.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <vector>

#include "geometry/rounding.hpp"

namespace {

using namespace talus;

// Corners of a turned box in map coordinates, as `write` leaves each number.
template <class Write>
RoundingFinder written(const Write& write) {
  RoundingFinder rounding;
  for (int k = 0; k < 8; ++k) {
    const double a = 2.0 * (k & 1), b = 1.3 * (k >> 1 & 1), c = 1.1 * (k >> 2);
    rounding.add({write(650100.371264 + 0.8 * a - 0.6 * b),
                  write(5200100.613427 + 0.6 * a + 0.8 * b), write(1051.541738 + c)});
  }
  return rounding;
}

double with_digits(double value, const char* format) {
  char words[40];
  std::snprintf(words, sizeof words, format, value);
  return std::strtod(words, nullptr);
}

TEST(Rounding, SinglePrecisionHasStepsOfTheLargestCoordinate) {
  const auto rounding = written([](double v) { return static_cast<float>(v); });
  EXPECT_EQ(rounding.step(), 0.5);
  EXPECT_EQ(rounding.words(), "single precision");
}

TEST(Rounding, SignificantDigitsLeaveMetresOfNorthings) {
  for (const auto& [format, step] : {std::pair("%.7g", 1.0), {"%.8g", 0.1}, {"%.9g", 0.01}}) {
    const auto rounding = written([f = format](double v) { return with_digits(v, f); });
    EXPECT_NEAR(rounding.step(), step, 1e-12) << format;
  }
}

TEST(Rounding, DoublesAndDecimalsAreNotRounded) {
  EXPECT_EQ(written([](double v) { return v; }).step(), 0);
  for (const char* format : {"%.0f", "%.1f", "%.2f", "%.3f", "%.5g", "%.10g"})
    EXPECT_EQ(written([format](double v) { return with_digits(v, format); }).step(), 0) << format;
}

}  // namespace
