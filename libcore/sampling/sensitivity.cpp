// Sensitivity indices of a result to a quantity that the runs drew.
#include "sampling/sensitivity.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "base/error.hpp"
#include "base/numbers.hpp"

namespace talus {
namespace {

constexpr int most_degree = 8;  // of the polynomial: two waves over the range are followed

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

bool is_constant(const std::vector<double>& values) {
  return values.empty() || std::all_of(values.begin(), values.end(),
                                       [&](double value) { return value == values.front(); });
}

// Pairs in an order that depends on the pairs alone, so that sums do too.
struct Pairs {
  std::vector<double> x, y;
};
Pairs in_order(const std::vector<double>& x, const std::vector<double>& y) {
  std::vector<std::size_t> order(x.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::tie(x[a], y[a]) < std::tie(x[b], y[b]);
  });
  Pairs pairs;
  for (const std::size_t i : order) {
    pairs.x.push_back(x[i]);
    pairs.y.push_back(y[i]);
  }
  const double mean = mean_of(pairs.y);  // which may be large beside the variance
  for (double& value : pairs.y) value -= mean;
  return pairs;
}

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

int n_distinct(const std::vector<double>& ascending) {
  int n = 1;
  for (std::size_t i = 1; i < ascending.size(); ++i) n += ascending[i] != ascending[i - 1];
  return n;
}

// The adjusted share of n values' squares: less the part that `n_terms` explain by chance.
double adjusted(double explained, int n_terms, std::size_t n) {
  const auto rest = static_cast<double>(n) - 1 - n_terms;
  return rest < 1 ? no_value : 1 - (1 - explained) * (static_cast<double>(n) - 1) / rest;
}

}  // namespace

std::vector<double> ranks_of(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  std::vector<double> ranks(values.size());
  for (std::size_t first = 0, end = 0; first < order.size(); first = end) {
    while (end < order.size() && values[order[end]] == values[order[first]]) ++end;
    const double mean = (static_cast<double>(first + end) + 1) / 2;
    for (std::size_t i = first; i < end; ++i) ranks[order[i]] = mean;
  }
  return ranks;
}

double rank_correlation(const std::vector<double>& x, const std::vector<double>& y) {
  TALUS_ASSERT(x.size() == y.size());
  if (is_constant(x) || is_constant(y)) return no_value;
  const std::vector<double> a = ranks_of(x), b = ranks_of(y);
  const double mean = (static_cast<double>(x.size()) + 1) / 2;
  double ab = 0, aa = 0, bb = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    ab += (a[i] - mean) * (b[i] - mean);
    aa += (a[i] - mean) * (a[i] - mean);
    bb += (b[i] - mean) * (b[i] - mean);
  }
  return ab / std::sqrt(aa * bb);
}

double first_order_index(const std::vector<double>& x, const std::vector<double>& y) {
  TALUS_ASSERT(x.size() == y.size());
  if (is_constant(x) || is_constant(y)) return no_value;
  const Pairs pairs = in_order(x, y);
  const std::size_t n = x.size();
  const int degree = std::min(most_degree, n_distinct(pairs.x) - 1);
  std::vector<double> place = ranks_of(pairs.x);
  for (double& value : place) value = (2 * value - 1) / static_cast<double>(n) - 1;
  // polynomials that are orthogonal on these places, by their three-term recurrence
  std::vector<double> before(n, 0), now(n, 1);
  double squares_before = 1, explained = 0;
  const double squares_of_y = dot(pairs.y, pairs.y);
  for (int d = 0; d <= degree; ++d) {
    const double squares = dot(now, now), part = dot(now, pairs.y);
    if (d > 0) explained += part * part / squares;
    double shift = 0;
    for (std::size_t i = 0; i < n; ++i) shift += place[i] * now[i] * now[i];
    const double a = shift / squares, b = d == 0 ? 0 : squares / squares_before;
    for (std::size_t i = 0; i < n; ++i) {
      const double next = (place[i] - a) * now[i] - b * before[i];
      before[i] = now[i];
      now[i] = next;
    }
    squares_before = squares;
  }
  return adjusted(explained / squares_of_y, degree, n);
}

double share_between_groups(const std::vector<double>& group, const std::vector<double>& y) {
  TALUS_ASSERT(group.size() == y.size());
  if (is_constant(group) || is_constant(y)) return no_value;
  const Pairs pairs = in_order(group, y);
  double explained = 0;
  for (std::size_t first = 0, end = 0; first < pairs.x.size(); first = end) {
    double sum = 0;
    for (; end < pairs.x.size() && pairs.x[end] == pairs.x[first]; ++end) sum += pairs.y[end];
    explained += sum * sum / static_cast<double>(end - first);
  }
  return adjusted(explained / dot(pairs.y, pairs.y), n_distinct(pairs.x) - 1, pairs.x.size());
}

}  // namespace talus
