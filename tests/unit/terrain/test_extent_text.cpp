// The extent of a terrain as text.
#include <gtest/gtest.h>

#include "terrain/extent_text.hpp"

namespace {

TEST(ExtentText, NamesTheOutermostNodesInMapCoordinates) {
  talus::Trn trn;
  trn.n_rows = 3;
  trn.n_cols = 5;
  trn.cell_size = 2;
  trn.node0 = {-1, 10};
  trn.origin = {500000, 5200000, 100};
  EXPECT_EQ(talus::extent_text(trn), "the terrain covers x 499999 to 500007, y 5200006 to 5200010");
}

}  // namespace
