// Percentiles and medians, with and without weights.
#include <gtest/gtest.h>

#include <cmath>

#include "base/percentile.hpp"

namespace {

using talus::median;
using talus::percentile;

TEST(Median, IsTheMeanOfTheTwoMiddleValuesOfAnEvenCount) {
  EXPECT_EQ(median({1, 10}), 5.5);
  EXPECT_EQ(median({9, 1, 4, 2}), 3);
  EXPECT_EQ(median({7, 7, 1, 7}), 7);
}

TEST(Median, IsTheMiddleValueOfAnOddCount) {
  EXPECT_EQ(median({5}), 5);
  EXPECT_EQ(median({9, 1, 4}), 4);
}

TEST(Median, OfNothingIsNoNumber) { EXPECT_TRUE(std::isnan(median({}))); }

TEST(Percentile, IsTheSmallestValueThatItsShareDoesNotExceed) {
  const std::vector<double> values = {40, 10, 30, 20};
  EXPECT_EQ(percentile(values, 0.25), 10);
  EXPECT_EQ(percentile(values, 0.26), 20);
  EXPECT_EQ(percentile(values, 0), 10);
  EXPECT_EQ(percentile(values, 1), 40);
  EXPECT_TRUE(std::isnan(percentile({}, 0.5)));
}

TEST(Percentile, IsThatOfEqualWeights) {
  std::vector<double> values;
  std::vector<talus::WeightedValue> weighted;
  for (int n = 1; n <= 200; ++n) {
    values.push_back(n);
    weighted.push_back({static_cast<double>(n)});
    for (const double p : {0.05, 0.1, 0.5, 0.9, 0.95, 0.99})
      EXPECT_EQ(percentile(values, p), talus::weighted_percentile(weighted, p)) << n << " " << p;
  }
}

}  // namespace
