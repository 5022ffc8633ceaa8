// Angles in degrees and percentages as words.
#include <gtest/gtest.h>

#include <cmath>

#include "base/units.hpp"
#include "base/words.hpp"

namespace {

using talus::degree;
using talus::percent;

TEST(Percent, HasThreeSignificantDigits) {
  EXPECT_EQ(percent(0.12345), "12.3 %");
  EXPECT_EQ(percent(1), "100 %");
  EXPECT_EQ(percent(0), "0 %");
}

TEST(Percent, OfASmallShareIsNotZeroAndOfALargeOneNotAll) {
  EXPECT_EQ(percent(0.000123), "0.0123 %");
  EXPECT_EQ(percent(0.996), "99.6 %");
}

TEST(Degree, TimesANumberIsAnAngle) {
  EXPECT_NEAR(180 * degree, 3.14159265358979, 1e-14);
  EXPECT_NEAR(std::tan(45 * degree), 1, 1e-15);
}

}  // namespace
