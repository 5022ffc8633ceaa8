// Sloping local base level: curvature from sag, profiles, cell sizes.
#include <gtest/gtest.h>

#include <cmath>

#include "blocks/base_level.hpp"
#include "blocks/source.hpp"
#include "scenes.hpp"

namespace {

using namespace talus;
using namespace talus::test;

}  // namespace

TEST(BaseLevel, CurvatureFollowsFromTheSag) {
  EXPECT_NEAR(curvature_of_sag(22.05, 210, 5), 0.05, 1e-12);
  EXPECT_NEAR(largest_sag(100), 41.42, 0.005);
}

TEST(BaseLevel, ProfileRunsThroughTheMiddleDownTheSlope) {
  const Trn ground = grid(101, 101, 2, [](double, double y) { return 0.8 * y; });
  const Area area{{{{60, 50}, {120, 50}, {120, 130}, {60, 130}}}};
  const SourceProfile profile = source_profile(ground, area);
  EXPECT_NEAR(profile.length, 80, 0.05);
  EXPECT_NEAR(profile.height, 64, 0.05);
  EXPECT_NEAR(profile.top.x(), 90, 1e-9);
  EXPECT_NEAR(profile.foot.y(), 50, 0.03);
}

// The surface sags by the requested depth whatever the cells: along a strip that is long across the
// slope the base level is that of a profile.
TEST(BaseLevel, SagIsTheSameOnEveryCellSize) {
  for (const double cell : {4.0, 2.0}) {
    const int n = static_cast<int>(480 / cell) + 1;
    const Trn ground = grid(n, n, cell, [](double, double y) { return 0.8 * y; });
    const Area strip{{{{40, 200}, {440, 200}, {440, 280}, {40, 280}}}};
    SourceOptions options;
    options.kind = FailureSurface::slbl;
    options.slbl_curvature = curvature_of_sag(6, source_profile(ground, strip).length, cell);
    const SourceMass mass = find_source(ground, strip, options, {});
    // It is fixed at the first nodes outside, a cell beyond each end.
    const double longer = (80 + 2 * cell) / 80;
    EXPECT_NEAR(mass.max_depth, 6 * longer * longer, 0.03 * 6) << cell;
  }
}
