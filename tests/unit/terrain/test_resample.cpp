// Resampling of rasters: means, interpolation, copies.
#include <gtest/gtest.h>

#include <cmath>

#include "base/random.hpp"
#include "terrain/resample.hpp"

namespace {

using talus::GridFrame;

struct Source {
  GridFrame frame;
  std::vector<double> z;
  double at(int r, int c) const { return z[static_cast<std::size_t>(r * frame.n_cols + c)]; }
};

Source random_source(talus::Random& random, int n_rows, int n_cols, double unknown = 0) {
  Source source{{n_rows, n_cols, 2.5, {1000, 9000}}, {}};
  for (int i = 0; i < n_rows * n_cols; ++i)
    source.z.push_back(random.uniform() < unknown ? std::nan("") : random.uniform(0, 100));
  return source;
}

std::vector<double> resample(const Source& source, const GridFrame& target) {
  talus::RowResampler resampler(source.frame, target);
  for (int row = resampler.first_row(); row <= resampler.last_row(); ++row)
    resampler.add_row(source.z.data() + row * source.frame.n_cols + resampler.first_col());
  return resampler.take();
}

// The mean over a square by the area that it has in common with every cell of the source; unknown
// when it leaves the source or touches an unknown cell.
double square_mean(const Source& source, double x, double y, double side) {
  const GridFrame& f = source.frame;
  double sum = 0, area = 0;
  for (int r = 0; r < f.n_rows; ++r)
    for (int c = 0; c < f.n_cols; ++c) {
      const auto common = [&](double a, double b) {
        return std::min(a + side / 2, b + f.cell_size / 2) -
               std::max(a - side / 2, b - f.cell_size / 2);
      };
      const double width = common(x, f.x(c)), height = common(y, f.y(r));
      if (width <= 1e-6 * f.cell_size || height <= 1e-6 * f.cell_size) continue;
      sum += width * height * source.at(r, c);
      area += width * height;
    }
  return area > side * side * (1 - 1e-6) ? sum / area : std::nan("");
}

void expect_square_means(const Source& source, const GridFrame& target) {
  const std::vector<double> z = resample(source, target);
  const double side = std::max(source.frame.cell_size, target.cell_size);
  int n_known = 0;
  for (int r = 0; r < target.n_rows; ++r)
    for (int c = 0; c < target.n_cols; ++c) {
      const double expected = square_mean(source, target.x(c), target.y(r), side);
      const double found = z[static_cast<std::size_t>(r * target.n_cols + c)];
      ASSERT_EQ(std::isnan(found), std::isnan(expected)) << r << ' ' << c;
      if (std::isnan(expected)) continue;
      EXPECT_NEAR(found, expected, 1e-9);
      ++n_known;
    }
  EXPECT_GT(n_known, 5);
}

TEST(RowResampler, CoarserNodesAreAreaWeightedMeans) {
  talus::Random random(1, "coarser");
  for (const double unknown : {0.0, 0.02})
    for (const double size : {2.6, 4.0, 5.0, 7.5, 11.3}) {
      const Source source = random_source(random, 40, 50, unknown);
      expect_square_means(source, talus::frame_covering({990, 8890, 1130, 9010}, size));
    }
}

TEST(RowResampler, FinerNodesAreBilinear) {
  talus::Random random(2, "finer");
  const Source source = random_source(random, 12, 14, 0.02);
  expect_square_means(source, talus::frame_covering({990, 8960, 1045, 9010}, 0.7));
  const GridFrame one{1, 1, 1, {1000 + 2.5 * 3.25, 9000 - 2.5 * 4.5}};
  const Source known = random_source(random, 12, 14);
  const double north = 0.75 * known.at(4, 3) + 0.25 * known.at(4, 4);
  const double south = 0.75 * known.at(5, 3) + 0.25 * known.at(5, 4);
  EXPECT_NEAR(resample(known, one)[0], 0.5 * (north + south), 1e-12);
}

TEST(RowResampler, TheDemsOwnNodesAreCopiedBitForBit) {
  talus::Random random(3, "own");
  Source source = random_source(random, 30, 31, 0.1);
  source.frame.cell_size = 4.997678230579;
  source.frame.north_west = {248362.7612662384, 351760.3630344};
  const auto same = [](double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); };
  const std::vector<double> whole = resample(source, source.frame);
  ASSERT_EQ(whole.size(), source.z.size());
  for (std::size_t i = 0; i < whole.size(); ++i) EXPECT_TRUE(same(whole[i], source.z[i]));

  const GridFrame part{7, 9, source.frame.cell_size, {source.frame.x(11), source.frame.y(5)}};
  const std::vector<double> z = resample(source, part);
  for (int r = 0; r < 7; ++r)
    for (int c = 0; c < 9; ++c)
      EXPECT_TRUE(same(z[static_cast<std::size_t>(r * 9 + c)], source.at(r + 5, c + 11)));
}

TEST(RowResampler, OnlyTheRowsAndColumnsOfTheWindowAreAskedFor) {
  const GridFrame source{1'000'000, 900'000, 1, {0, 0}};
  const talus::RowResampler resampler(source, {11, 21, 4, {500'000, -600'000}});
  EXPECT_EQ(resampler.first_row(), 600'000 - 2);
  EXPECT_EQ(resampler.last_row(), 600'000 + 42);
  EXPECT_EQ(resampler.first_col(), 500'000 - 2);
  EXPECT_EQ(resampler.n_cols(), 85);
}

TEST(RowResampler, NothingIsExtrapolated) {
  talus::Random random(4, "outside");
  const Source source = random_source(random, 6, 6);
  const std::vector<double> z = resample(source, {40, 40, 2.5, {950, 9050}});
  int n_known = 0;
  for (const double value : z) n_known += !std::isnan(value);
  EXPECT_EQ(n_known, 36);
  for (const double value : resample(source, {3, 3, 2.5, {-2e7, 2e7}}))
    EXPECT_TRUE(std::isnan(value));
}

}  // namespace
