// Groups of touching blocks, against spreading of labels.
#include <gtest/gtest.h>

#include "base/random.hpp"
#include "solver/island_groups.hpp"

namespace {

using talus::IslandGroups;
using Pairs = std::vector<std::pair<int, int>>;

// Lowest block that can be reached, by spreading labels until nothing changes.
std::vector<int> labels_by_spreading(int n, const Pairs& pairs,
                                     const std::vector<unsigned char>& joins) {
  std::vector<int> label(static_cast<std::size_t>(n), -1);
  for (int b = 0; b < n; ++b)
    if (joins[static_cast<std::size_t>(b)]) label[static_cast<std::size_t>(b)] = b;
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& [a, b] : pairs) {
      if (b < 0) continue;
      int& at_a = label[static_cast<std::size_t>(a)];
      int& at_b = label[static_cast<std::size_t>(b)];
      if (at_a < 0 || at_b < 0 || at_a == at_b) continue;
      at_a = at_b = std::min(at_a, at_b);
      changed = true;
    }
  }
  return label;
}

TEST(FindIslands, AgreesWithSpreadingOfLabels) {
  talus::Random random(3, "islands");
  IslandGroups groups;
  for (int round = 0; round < 200; ++round) {
    const int n = 1 + static_cast<int>(random.below(40));
    std::vector<unsigned char> joins(static_cast<std::size_t>(n));
    for (auto& j : joins) j = random.uniform() < 0.8;
    Pairs pairs;
    for (int k = static_cast<int>(random.below(60)); k > 0 && n > 1; --k) {
      const int a = static_cast<int>(random.below(static_cast<std::uint64_t>(n)));
      const int b = static_cast<int>(random.below(static_cast<std::uint64_t>(n + 1))) - 1;
      if (a != b) pairs.emplace_back(a, b);
    }
    talus::find_islands(n, pairs, joins, groups);
    const std::vector<int> label = labels_by_spreading(n, pairs, joins);
    for (int a = 0; a < n; ++a)
      for (int b = 0; b < n; ++b) {
        const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
        EXPECT_EQ(groups.island_of[i] == groups.island_of[j], label[i] == label[j]);
        if (label[i] >= 0 && label[i] < label[j]) {
          EXPECT_LT(groups.island_of[i], groups.island_of[j]);
        }
      }
  }
}

// Blocks and pairs are ordered by island; every pair with a joining block appears once.
TEST(FindIslands, ListsBlocksAndPairsByIsland) {
  IslandGroups groups;
  const Pairs pairs = {{5, 1}, {2, -1}, {1, -1}, {4, 3}, {0, 3}};
  const std::vector<unsigned char> joins = {1, 1, 1, 0, 1, 1};  // block 3 is fixed
  talus::find_islands(6, pairs, joins, groups);
  ASSERT_EQ(talus::n_islands(groups), 4);
  EXPECT_EQ(groups.blocks, (std::vector<int>{0, 1, 5, 2, 4}));
  EXPECT_EQ(groups.block_begin, (std::vector<int>{0, 1, 3, 4, 5}));
  EXPECT_EQ(groups.pairs, (std::vector<int>{4, 0, 2, 1, 3}));
  EXPECT_EQ(groups.pair_begin, (std::vector<int>{0, 1, 3, 4, 5}));
  EXPECT_EQ(groups.local_index, (std::vector<int>{0, 0, 0, -1, 0, 1}));
}

}  // namespace
