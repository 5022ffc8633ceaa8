// The sliding point, and the smoothed ground.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/units.hpp"
#include "terrain/slider.hpp"
#include "terrain/smooth.hpp"

namespace {

using namespace talus;

template <class Height>
Trn grid(int n, double cell, Height height) {
  Trn trn;
  trn.n_rows = trn.n_cols = n;
  trn.cell_size = cell;
  trn.node0 = {0, (n - 1) * cell};
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) trn.elevation.push_back(height(c * cell, (n - 1 - r) * cell));
  return trn;
}

SlidingFriction friction_of(double degrees) { return {{std::tan(degrees * degree)}, {}}; }

}  // namespace

// Down 40 degrees for 100 m in plan, then on the level until friction has taken its speed.
TEST(Slider, StopsWhereItsEnergyIsSpent) {
  const double slope = std::tan(40 * degree), mu = std::tan(30 * degree);
  const Trn ground =
      grid(201, 4, [&](double, double y) { return std::max(0.0, slope * (y - 500)); });
  const SliderPath slide = slide_from(ground, friction_of(30), {400, 600});
  ASSERT_FALSE(slide.left);
  const double fall = slope * 100, way = 100 / std::cos(40 * degree);
  const double a = 9.80665 * (std::sin(40 * degree) - mu * std::cos(40 * degree));
  const double speed = std::sqrt(2 * a * way);
  const double run = speed * speed / (2 * mu * 9.80665);
  EXPECT_NEAR(fall - mu * 100, mu * run, 1e-9);       // the two forms of it
  EXPECT_NEAR(slide.end.y(), 500 - run, 0.06 * run);  // a step beyond the bend
  EXPECT_NEAR(slide.time, std::sqrt(2 * way / a) + speed / (mu * 9.80665), 0.3);
}

TEST(Slider, StaysWhereFrictionHoldsIt) {
  const Trn ground = grid(51, 4, [](double, double y) { return 0.5 * y; });
  EXPECT_EQ(slide_from(ground, friction_of(30), {100, 100}).time, 0);
  EXPECT_GT(slide_from(ground, friction_of(20), {100, 100}).time, 0);
}

TEST(Slider, EndsWhereTheGroundIsNotKnown) {
  const Trn ground = grid(51, 4, [](double, double y) {
    return y < 40 ? std::numeric_limits<double>::quiet_NaN() : y;
  });
  const SliderPath slide = slide_from(ground, friction_of(30), {100, 100}, true);
  EXPECT_TRUE(slide.left);
  EXPECT_GT(slide.points.size(), 5u);
}

// Friction by class: rough ground from y = 60 downwards.
TEST(Slider, FrictionIsThatOfTheCell) {
  const Trn ground = grid(51, 4, [](double, double y) { return y; });
  SlidingFriction friction{{std::tan(20 * degree), std::tan(70 * degree)}, {}};
  for (int r = 0; r < 50; ++r)
    for (int c = 0; c < 50; ++c) friction.cell_class.push_back(r >= 35 ? 1 : 0);
  const SliderPath slide = slide_from(ground, friction, {100, 150});
  EXPECT_FALSE(slide.left);
  EXPECT_LT(slide.end.y(), 60);
}

TEST(Slider, DurationIsTakenFromTheSlowest) {
  EXPECT_EQ(duration_for({}), 10);
  EXPECT_EQ(duration_for({1, 2}), 10);
  std::vector<double> times(100, 20);
  for (int k = 0; k < 6; ++k) times[k] = 40;
  EXPECT_NEAR(duration_for(times), 1.7 * 40, 1e-12);
  times[0] = 20;
  EXPECT_NEAR(duration_for(times), 1.7 * 20, 1e-12);
}

TEST(Smoothed, KeepsAPlaneAndSpreadsAPeak) {
  Trn ground = grid(9, 1, [](double x, double y) { return 2 * x - y; });
  Trn smooth = smoothed(ground);
  EXPECT_NEAR(smooth.elevation[node_index(smooth, 4, 4)], 2 * 4 - 4, 1e-12);
  ground.elevation[node_index(ground, 4, 4)] += 9;
  ground.elevation[node_index(ground, 0, 0)] = std::numeric_limits<double>::quiet_NaN();
  smooth = smoothed(ground);
  EXPECT_NEAR(smooth.elevation[node_index(smooth, 3, 3)], 2 * 3 - 5 + 1, 1e-12);
  EXPECT_TRUE(std::isnan(smooth.elevation[node_index(smooth, 0, 0)]));
}
