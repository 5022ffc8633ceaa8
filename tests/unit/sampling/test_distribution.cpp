// Distributions: moments, quantiles, truncation.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/units.hpp"
#include "sampling/distribution.hpp"

namespace {

using namespace talus;  // NOLINT: a test

struct Moments {
  double mean = 0, std = 0;
};
// Of the values at the middles of n equal shares of the probability.
Moments moments_of(const Distribution& d, int n = 20000) {
  double sum = 0, squares = 0;
  for (int i = 0; i < n; ++i) {
    const double x = quantile(d, (i + 0.5) / n);
    sum += x, squares += x * x;
  }
  return {sum / n, std::sqrt(squares / n - sum / n * (sum / n))};
}

Distribution of(DistributionKind kind) {
  Distribution d;
  d.kind = kind;
  return d;
}

TEST(Distribution, MomentsAreThoseThatWereGiven) {
  Distribution normal = of(DistributionKind::normal);
  normal.mean = 28, normal.std = 2;
  EXPECT_NEAR(moments_of(normal).mean, 28, 1e-9);
  EXPECT_NEAR(moments_of(normal).std, 2, 1e-3);

  Distribution lognormal = of(DistributionKind::lognormal);
  lognormal.mean = 5, lognormal.std = 2;  // of the value, not of its logarithm
  EXPECT_NEAR(moments_of(lognormal).mean, 5, 1e-3);
  EXPECT_NEAR(moments_of(lognormal).std, 2, 1e-2);

  Distribution uniform = of(DistributionKind::uniform);
  uniform.min = 2, uniform.max = 8;
  EXPECT_NEAR(moments_of(uniform).mean, 5, 1e-9);
  EXPECT_NEAR(moments_of(uniform).std, 6 / std::sqrt(12), 1e-6);

  Distribution triangular = of(DistributionKind::triangular);  // mean (a + b + c) / 3
  triangular.min = 0, triangular.mode = 1, triangular.max = 5;
  EXPECT_NEAR(moments_of(triangular).mean, 2, 1e-6);
  EXPECT_NEAR(moments_of(triangular).std, std::sqrt((25 + 1 - 5) / 18.0), 1e-5);
  triangular.mode = 0;  // at an end
  EXPECT_NEAR(moments_of(triangular).mean, 5 / 3.0, 1e-6);
}

TEST(Distribution, QuantilesUndoProbabilities) {
  for (const auto kind : {DistributionKind::normal, DistributionKind::lognormal,
                          DistributionKind::uniform, DistributionKind::triangular}) {
    Distribution d = of(kind);
    d.mean = 3, d.std = 1.5, d.min = 1, d.mode = 2, d.max = 7;
    for (const double u : {1e-6, 0.05, 0.4, 0.5, 0.83, 0.999})
      EXPECT_NEAR(probability_below(d, quantile(d, u)), u, 1e-12) << static_cast<int>(kind);
  }
}

// A normal from -1 to 2 standard deviations: mean (phi(-1) - phi(2)) / (Phi(2) - Phi(-1)) = 0.2296.
TEST(Distribution, WhatIsLeftOfATruncatedOneIsScaledUp) {
  Distribution d = of(DistributionKind::normal);
  d.low = -1, d.high = 2;
  EXPECT_NEAR(quantile(d, 1e-12), -1, 1e-9);
  EXPECT_NEAR(quantile(d, 1 - 1e-12), 2, 1e-9);
  const double kept = probability_between(d, -1, 2);
  EXPECT_NEAR(kept, 0.8185946141203637, 1e-12);
  const auto density = [](double x) {
    return std::exp(-x * x / 2) / std::sqrt(2 * std::numbers::pi);
  };
  EXPECT_NEAR(moments_of(d).mean, (density(-1) - density(2)) / kept, 1e-6);
}

TEST(Distribution, DiscreteValuesComeAsOftenAsTheirWeights) {
  Distribution d = of(DistributionKind::discrete);
  d.values = {1, 2, 4}, d.weights = {1, 0, 3};
  int n_one = 0;
  for (int i = 0; i < 1000; ++i) {
    const double x = quantile(d, (i + 0.5) / 1000);
    ASSERT_TRUE(x == 1 || x == 4);
    n_one += x == 1;
  }
  EXPECT_EQ(n_one, 250);
}

// K = 40: half of the directions within 10.682 degrees, 95 % within 22.316; mean cosine coth K -
// 1/K.
TEST(Distribution, FisherAnglesHaveTheirClosedForm) {
  EXPECT_NEAR(fisher_draw(40, 0.5, 0).angle / degree, 10.682, 5e-4);
  EXPECT_NEAR(fisher_draw(40, 1 - 0.95, 0).angle / degree, 22.316, 5e-4);
  EXPECT_NEAR(fisher_draw(40, 0.5, 0.25).azimuth / degree, 90, 1e-12);
  for (const double k : {0.5, 3.0, 40.0, 1951.0, 1e6}) {
    double sum = 0;
    constexpr int n = 20000;
    for (int i = 0; i < n; ++i) sum += 1 - std::cos(fisher_draw(k, (i + 0.5) / n, 0).angle);
    const double off = 1 - (1 / std::tanh(k) - 1 / k);
    EXPECT_NEAR(sum / n, off, 2e-4 * off) << k;
  }
}

// The mean of n poles is known better than a pole: n = 50, K = 40 gives 1,951 and a cone of 3.18
// degrees; n = 20 gives 781 and 5.02.
TEST(Distribution, TheMeanOfManyPolesIsSurerThanOne) {
  EXPECT_NEAR(concentration_of_mean(40, 50), 1951, 0.5);
  EXPECT_NEAR(cone_95(concentration_of_mean(40, 50)) / degree, 3.18, 5e-3);
  EXPECT_NEAR(concentration_of_mean(40, 20), 781, 0.5);
  EXPECT_NEAR(cone_95(concentration_of_mean(40, 20)) / degree, 5.02, 5e-3);
}

}  // namespace
