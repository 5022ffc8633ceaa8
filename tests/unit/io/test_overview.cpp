// Smaller pictures of a raster keep its extremes.
#include <gtest/gtest.h>

#include "io/overview.hpp"

namespace {

using talus::overview_of;
using talus::OverviewValue;

constexpr float none = -9999;

// 4 x 3 cells in 2 x 2: the last column and the rows go in pairs.
const std::vector<float> cells = {1,    -5,   none,  //
                                  2,    9,    none,  //
                                  none, none, -7,    //
                                  none, -2,   6};

TEST(Overview, KeepsTheLargestTheSmallestOrTheFarthestFromZero) {
  const auto view = [](OverviewValue keep) { return overview_of(cells, 4, 3, 2, 2, none, keep); };
  EXPECT_EQ(view(OverviewValue::largest), (std::vector<float>{9, none, -2, 6}));
  EXPECT_EQ(view(OverviewValue::smallest), (std::vector<float>{-5, none, -2, -7}));
  EXPECT_EQ(view(OverviewValue::farthest_from_zero), (std::vector<float>{9, none, -2, -7}));
}

}  // namespace
