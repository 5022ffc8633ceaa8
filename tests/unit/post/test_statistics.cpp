// Statistics: ranks, Wilson and Student intervals, resampling.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/random.hpp"
#include "post/statistics.hpp"

using namespace talus;

namespace {

std::vector<WeightedValue> random_sample(Random& random, int n, bool whole_weights) {
  std::vector<WeightedValue> sample(n);
  for (WeightedValue& v : sample)
    v = {std::floor(random.uniform(0, 20)), whole_weights ? 1.0 + random.below(4) : 1.0};
  sort_values(sample);
  return sample;
}

struct RunValue {
  double value = 0;
  double weight = 1;
  int run = 0;
};

void sort_descending(std::vector<RunValue>& values) {
  std::sort(values.begin(), values.end(),
            [](const RunValue& a, const RunValue& b) { return a.value > b.value; });
}

std::vector<ClusterWeight> weights_of(const std::vector<RunValue>& values) {
  std::vector<ClusterWeight> weights;
  for (const RunValue& v : values) weights.push_back({v.run, v.weight});
  return weights;
}

// P(Binomial(n, p) <= k) by the plain recursion, in long double.
long double binomial_cdf(int n, long double p, int k) {
  long double pmf = std::pow(1 - p, static_cast<long double>(n)), sum = 0;
  for (int j = 0; j <= k; ++j) {
    sum += pmf;
    pmf *= static_cast<long double>(n - j) / (j + 1) * p / (1 - p);
  }
  return sum;
}

}  // namespace

// A weight of 3 must say the same as three equal values; the list of copies is the reference.
TEST(WeightedPercentile, EqualsThePercentileOfRepeatedValues) {
  Random random(1);
  for (int trial = 0; trial < 300; ++trial) {
    const auto sample = random_sample(random, 1 + static_cast<int>(random.below(40)), true);
    std::vector<double> copies;
    for (const auto& v : sample)
      for (int i = 0; i < v.weight; ++i) copies.push_back(v.value);
    const auto n = static_cast<long long>(copies.size());
    for (const int per_cent : {0, 1, 5, 25, 50, 75, 90, 95, 99, 100}) {
      const auto rank = std::max(1LL, (per_cent * n + 99) / 100);  // ceil, in whole numbers
      EXPECT_EQ(weighted_percentile(sample, per_cent / 100.0), copies[rank - 1]);
    }
  }
}

TEST(WeightedPercentile, OfNothingIsNan) {
  EXPECT_TRUE(std::isnan(weighted_percentile({}, 0.5)));
  const std::vector<WeightedValue> weightless{{1, 0}};
  EXPECT_TRUE(std::isnan(weighted_percentile(weightless, 0.5)));
}

TEST(WeightedPercentile, IgnoresValuesWithoutWeight) {
  const std::vector<WeightedValue> sample{{1, 0}, {2, 1}, {3, 0}};
  for (const double p : {0.0, 0.5, 1.0}) EXPECT_EQ(weighted_percentile(sample, p), 2);
}

TEST(EffectiveSize, CountsEqualWeightsAndSeesOneHeavyOne) {
  EXPECT_DOUBLE_EQ(effective_size(7 * 0.3, 7 * 0.09), 7);
  EXPECT_NEAR(effective_size(1000 + 10, 1000.0 * 1000 + 10), 1.02, 0.001);
  EXPECT_EQ(effective_size(0, 0), 0);
}

// The bounds are the roots q of (s - q)^2 = z^2 q (1 - q) / n.
TEST(WilsonInterval, SolvesItsQuadraticEquation) {
  const double z = 1.959963984540054;
  for (const double n : {1.0, 10.0, 59.0, 1000.0})
    for (const double share : {0.1, 0.5, 0.9}) {
      const Interval i = wilson_interval(share, n);
      for (const double q : {i.low, i.high})
        EXPECT_NEAR((share - q) * (share - q), z * z * q * (1 - q) / n, 1e-12);
      EXPECT_LT(i.low, share);
      EXPECT_GT(i.high, share);
    }
}

// 0 of 10 and 10 of 10: z^2 / (n + z^2) and its mirror image.
TEST(WilsonInterval, HasItsClosedFormAtTheEnds) {
  EXPECT_EQ(wilson_interval(0, 10).low, 0);
  EXPECT_NEAR(wilson_interval(0, 10).high, 3.841458820694124 / 13.841458820694124, 1e-12);
  EXPECT_EQ(wilson_interval(1, 10).high, 1);
  EXPECT_NEAR(wilson_interval(1, 10).low, 10 / 13.841458820694124, 1e-12);
}

TEST(BoundRank, NeedsWilksSampleSizes) {
  EXPECT_EQ(smallest_sample(0.5), 5);
  EXPECT_EQ(smallest_sample(0.9), 29);
  EXPECT_EQ(smallest_sample(0.95), 59);
  EXPECT_EQ(smallest_sample(0.99), 299);
  EXPECT_EQ(upper_bound_rank(58, 0.95), 0);
  EXPECT_EQ(upper_bound_rank(59, 0.95), 59);
  EXPECT_EQ(upper_bound_rank(298, 0.99), 0);
  EXPECT_EQ(upper_bound_rank(299, 0.99), 299);
  EXPECT_EQ(upper_bound_rank(93, 0.95), 93 - 1);  // the second largest: Wilks' second order
}

TEST(BoundRank, IsTheSmallestThatTheBinomialDistributionAllows) {
  for (const int n : {1, 5, 30, 59, 100, 500, 2000})
    for (const double p : {0.5, 0.9, 0.95, 0.99}) {
      const int rank = upper_bound_rank(n, p);
      if (rank == 0) {
        EXPECT_LT(binomial_cdf(n, p, n - 1), 0.95L);
        continue;
      }
      EXPECT_GE(binomial_cdf(n, p, rank - 1), 0.95L - 1e-9L);
      EXPECT_LT(binomial_cdf(n, p, rank - 2), 0.95L);
    }
}

// All percentiles of all resamples, listed and sorted; with equal and with different weights.
TEST(BootstrapUpperPlaces, EqualTheListOfAllResamples) {
  Random random(3);
  const ClusterResamples resamples = resample_clusters(12, 99, 5);
  const std::vector<double> levels = {0.95, 0.9, 0.5};
  for (const int n_weights : {1, 3}) {
    std::vector<RunValue> values;
    for (int run = 0; run < 12; ++run)
      for (std::uint64_t i = 0; i < 1 + random.below(3); ++i)
        values.push_back(
            {std::floor(random.uniform(0, 9)), 0.7 * (1.0 + random.below(n_weights)), run});
    sort_descending(values);
    const std::vector<int> places = bootstrap_upper_places(weights_of(values), resamples, levels);
    for (std::size_t level = 0; level < levels.size(); ++level) {
      std::vector<double> expected;
      for (int b = 0; b < 99; ++b) {
        std::vector<WeightedValue> sample;
        for (const RunValue& v : values)
          sample.push_back({v.value, v.weight * resamples.of_cluster(v.run)[b]});
        sort_values(sample);
        const double value = weighted_percentile(sample, levels[level]);
        if (!std::isnan(value)) expected.push_back(value);
      }
      std::sort(expected.begin(), expected.end());
      const auto rank = static_cast<std::size_t>(std::ceil(0.95 * expected.size() - 1e-9));
      EXPECT_EQ(values[places[level]].value, expected[rank - 1]);
    }
  }
}

TEST(BootstrapUpperPlaces, AreNoneWithoutWeight) {
  const ClusterResamples resamples = resample_clusters(3, 20, 1);
  const std::vector<ClusterWeight> weightless = {{0, 0}, {1, 0}};
  EXPECT_EQ(bootstrap_upper_places({}, resamples, std::vector{0.9, 0.5}), (std::vector{-1, -1}));
  EXPECT_EQ(bootstrap_upper_places(weightless, resamples, std::vector{0.9}), std::vector{-1});
}

TEST(ResampleClusters, DrawsAsManyAsThereAreAndRepeatsItself) {
  const ClusterResamples a = resample_clusters(30, 50, 7);
  EXPECT_EQ(a.count, resample_clusters(30, 50, 7).count);
  EXPECT_NE(a.count, resample_clusters(30, 50, 8).count);
  for (int b = 0; b < 50; ++b) {
    int sum = 0;
    for (int run = 0; run < 30; ++run) sum += a.of_cluster(run)[b];
    EXPECT_EQ(sum, 30);
  }
}

// 40 runs with 25 blocks each that share their run's factor: the bound must cover the true
// percentile about as often as it says, where blocks taken as independent would not.
TEST(BootstrapUpperPlaces, CoverThePercentileOfRunsWhoseBlocksGoTogether) {
  Random random(11);
  const ClusterResamples resamples = resample_clusters(40, 200, 1);
  const auto draw = [&random](double factor) { return factor + 0.1 * random.normal(); };
  std::vector<double> population(400000);
  for (double& value : population) value = draw(random.uniform());
  std::sort(population.begin(), population.end());
  const double truth = population[population.size() / 10 * 9];

  int covered = 0, covered_as_if_independent = 0;
  for (int trial = 0; trial < 300; ++trial) {
    std::vector<RunValue> values;
    for (int run = 0; run < 40; ++run) {
      const double factor = random.uniform();
      for (int i = 0; i < 25; ++i) values.push_back({draw(factor), 1, run});
    }
    sort_descending(values);
    const int place = bootstrap_upper_places(weights_of(values), resamples, std::vector{0.9})[0];
    covered += values[place].value >= truth;
    covered_as_if_independent += values[1000 - upper_bound_rank(1000, 0.9)].value >= truth;
  }
  EXPECT_GE(covered, 300 * 0.88);
  EXPECT_LE(covered_as_if_independent, 300 * 0.80);
}

TEST(RankInterval, HasThePublishedTwoSidedRanks) {
  const auto expect = [](int n, double p, int low, int high) {
    const RankInterval ranks = rank_interval(n, p);
    EXPECT_EQ(ranks.low, low) << n << " " << p;
    EXPECT_EQ(ranks.high, high) << n << " " << p;
  };
  expect(100, 0.95, 90, 100);
  expect(1000, 0.95, 936, 964);
  expect(1000, 0.99, 983, 997);
  expect(10000, 0.95, 9457, 9543);
  expect(10000, 0.99, 9880, 9920);
  EXPECT_EQ(rank_interval(50, 0.99).high, 0);
}

// Wilks: the largest, second and third largest value bound from these sizes on, not one less.
TEST(BoundRank, HasWilksOrders) {
  struct Row {
    double p;
    int order, n;
  };
  for (const Row& row : {Row{0.9, 1, 29},
                         {0.95, 1, 59},
                         {0.99, 1, 299},
                         {0.999, 1, 2995},
                         {0.95, 2, 93},
                         {0.95, 3, 124},
                         {0.99, 2, 473},
                         {0.99, 3, 628}}) {
    EXPECT_EQ(upper_bound_rank(row.n, row.p), row.n - row.order + 1) << row.n;
    EXPECT_NE(upper_bound_rank(row.n - 1, row.p), row.n - row.order) << row.n;
  }
}

TEST(Quantiles, AreThoseOfTheTables) {
  EXPECT_NEAR(normal_quantile(0.975), 1.959963984540054, 1e-12);
  EXPECT_NEAR(normal_quantile(0.95), 1.6448536269514722, 1e-12);
  EXPECT_NEAR(normal_quantile(0.2), -0.8416212335729143, 1e-12);
  const std::array<std::pair<int, double>, 8> table = {{{1, 12.706204736432095},
                                                        {2, 4.302652729911275},
                                                        {3, 3.182446305284263},
                                                        {4, 2.7764451051977987},
                                                        {5, 2.570581835636314},
                                                        {10, 2.2281388519649385},
                                                        {39, 2.0226909200367604},
                                                        {100, 1.983971518523552}}};
  for (const auto& [degrees, t] : table) EXPECT_NEAR(student_quantile(degrees, 0.975), t, 1e-9);
  EXPECT_NEAR(student_quantile(10, 0.95), 1.8124611228107335, 1e-9);
  // the expansion continues where the finite sums end
  EXPECT_NEAR(student_quantile(100, 0.95), student_quantile(101, 0.95), 2e-4);
  EXPECT_GT(student_quantile(100, 0.975), student_quantile(101, 0.975));
  EXPECT_NEAR(student_quantile(120, 0.975), 1.979930405082417, 1e-9);
}
