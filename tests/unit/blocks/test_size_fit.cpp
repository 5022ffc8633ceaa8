// Fits of block sizes: laws, design volumes, bounds.
#include <gtest/gtest.h>

#include <cmath>

#include "base/random.hpp"
#include "blocks/size_fit.hpp"

namespace {

using namespace talus;  // NOLINT: a test

std::vector<double> exponential_list(int n, double mean) {
  std::vector<double> edges;  // quantiles of the law: a list with its mean and shape
  for (int i = 0; i < n; ++i) edges.push_back(-mean * std::log1p(-(i + 0.5) / n));
  return edges;
}

}  // namespace

TEST(SizeFit, DesignVolumesOfTheExponentialLawAreTheClosedForm) {
  // edges with mean 0.5 m, a block of 1 m3 every 10 years
  SizeFit fit;
  fit.law = SizeLaw::exponential;
  fit.first = 0.5;
  const SizeAnchor anchor{1, 10};
  EXPECT_NEAR(rate_of_all(fit, anchor), 0.7389, 5e-5);
  EXPECT_NEAR(volume_of_years(fit, anchor, 30), 3.719, 5e-4);
  EXPECT_NEAR(volume_of_years(fit, anchor, 100), 9.956, 5e-4);
  EXPECT_NEAR(volume_of_years(fit, anchor, 300), 19.696, 5e-4);
  EXPECT_NEAR(volume_of_years(fit, anchor, 10), 1, 1e-12);  // the anchor itself
}

TEST(SizeFit, FindsTheLawThatAListWasDrawnFrom) {
  const std::vector<double> edges = exponential_list(2000, 0.5);
  EXPECT_NEAR(fit_sizes(SizeLaw::exponential, edges).first, 0.5, 2e-3);
  const SizeFit weibull = fit_sizes(SizeLaw::weibull, edges);
  EXPECT_NEAR(weibull.first, 1, 0.01);  // an exponential law is one of Weibull's
  EXPECT_NEAR(weibull.second, 0.5, 5e-3);
  EXPECT_EQ(fit_sizes(edges).front().law, SizeLaw::exponential);
  EXPECT_LT(fit_sizes(edges).front().ks, 0.01);
  std::vector<double> logs;
  Random random(1, "sizes");
  for (int i = 0; i < 2000; ++i) logs.push_back(std::exp(-0.7 + 0.4 * random.normal()));
  const SizeFit best = fit_sizes(logs).front();
  EXPECT_EQ(best.law, SizeLaw::lognormal);
  EXPECT_NEAR(best.first, -0.7, 0.03);
  EXPECT_NEAR(best.second, 0.4, 0.03);
}

TEST(SizeFit, QuantilesAreTheInverseOfTheLaw) {
  for (const SizeLaw law : {SizeLaw::exponential, SizeLaw::lognormal, SizeLaw::weibull}) {
    const SizeFit fit = fit_sizes(law, exponential_list(100, 0.8));
    for (const double p : {0.9, 0.5, 0.1, 1e-3, 1e-6})
      EXPECT_NEAR(fit.exceedance(fit.edge_of(p)), p, 1e-9 * p + 1e-15) << text(law);
    EXPECT_EQ(fit.exceedance(0), 1);
  }
}

TEST(SizeFit, BoundsHoldTheVolumeAndNarrowWithTheList) {
  const SizeAnchor anchor{1, 10};
  const auto width = [&](int n) {
    const std::vector<double> edges = exponential_list(n, 0.5);
    const auto [low, high] = volume_bounds(SizeLaw::exponential, edges, anchor, 100);
    const double v = volume_of_years(fit_sizes(SizeLaw::exponential, edges), anchor, 100);
    EXPECT_LT(low, v);
    EXPECT_GT(high, v);
    return high - low;
  };
  EXPECT_LT(width(400), 0.5 * width(50));
}
