#include <gtest/gtest.h>

#include <numeric>

#include "base/random.hpp"
#include "post/hazard/patches.hpp"

using namespace talus;

namespace {

// Cells of a patch and of all of its value, counted another way: by flooding a copy.
std::size_t flood(std::vector<int>& left, int n_cols, std::size_t at, int value) {
  if (left[at] != value) return 0;
  left[at] = -1;
  std::size_t n = 1;
  const auto cols = static_cast<std::size_t>(n_cols), col = at % cols;
  if (at >= cols) n += flood(left, n_cols, at - cols, value);
  if (at + cols < left.size()) n += flood(left, n_cols, at + cols, value);
  if (col > 0) n += flood(left, n_cols, at - 1, value);
  if (col + 1 < cols) n += flood(left, n_cols, at + 1, value);
  return n;
}

}  // namespace

TEST(Patches, TakeTheValueOfTheLongestBorderAndOfEqualOnesTheHigher) {
  std::vector<int> values = {1, 1, 1, 2,  //
                             1, 3, 3, 2,  //
                             1, 1, 2, 2};
  const PatchRepair repair = join_small_patches(values, 4, 3);
  // 3 3 touches 1 four times and 2 twice
  EXPECT_EQ(values, (std::vector<int>{1, 1, 1, 2, 1, 1, 1, 2, 1, 1, 2, 2}));
  EXPECT_EQ(repair.n_joined, 1);
  EXPECT_EQ(repair.cells_lowered, 2);
  std::vector<int> equal = {1, 1, 3, 2, 2};
  static_cast<void>(join_small_patches(equal, 5, 2));
  EXPECT_EQ(equal, (std::vector<int>{1, 1, 2, 2, 2}));
}

TEST(Patches, FillHolesAndLeaveOutWhatStandsAlone) {
  std::vector<int> values = {1, 1, 1, 0, 0,  //
                             1, 0, 1, 0, 2,  //
                             1, 1, 1, 0, 0};
  const PatchRepair repair = join_small_patches(values, 5, 2);
  EXPECT_EQ(values, (std::vector<int>{1, 1, 1, 0, 0, 1, 1, 1, 0, 0, 1, 1, 1, 0, 0}));
  EXPECT_EQ(repair.n_joined, 1);
  EXPECT_EQ(repair.cells_raised, 1);
  EXPECT_EQ(repair.n_left_out, 1);
  EXPECT_EQ(repair.left_out, (std::vector<std::uint32_t>{9}));
}

TEST(Patches, OfAnyMapNoneIsSmallerAndTheCountsAddUp) {
  Random random(7);
  for (int trial = 0; trial < 200; ++trial) {
    const int n_cols = 3 + static_cast<int>(random.below(9));
    std::vector<int> values(static_cast<std::size_t>(n_cols) * (2 + random.below(9)));
    for (int& value : values) value = static_cast<int>(random.below(4));
    const std::vector<int> before = values;
    const std::int64_t least = 1 + static_cast<std::int64_t>(random.below(6));
    const PatchRepair repair = join_small_patches(values, n_cols, least);
    std::vector<int> left = values;
    for (std::size_t i = 0; i < values.size(); ++i)
      if (values[i] > 0 && left[i] >= 0) {
        EXPECT_GE(flood(left, n_cols, i, values[i]), static_cast<std::size_t>(least));
      }
    for (const std::uint32_t cell : repair.left_out) EXPECT_NE(before[cell], -1);
    if (least == 1) {
      EXPECT_EQ(values, before);
    }
  }
}
