// Groups of blocks in contact, by union-find.
#include "solver/island_groups.hpp"

#include <cstddef>

namespace talus {
namespace {

using std::size_t;

// Root of b; halves the path to it. The root is the lowest block of the set.
int root_of(std::vector<int>& parent, int b) {
  while (parent[b] != b) {
    int& up = parent[b];
    up = parent[up];
    b = up;
  }
  return b;
}

// Sorts items 0 .. n - 1 by group, stable; group_of(i) < 0 leaves i out.
template <class GroupOf>
void sort_by_group(int n, int n_groups, const GroupOf& group_of, std::vector<int>& begin,
                   std::vector<int>& items) {
  begin.assign(static_cast<size_t>(n_groups) + 1, 0);
  for (int i = 0; i < n; ++i)
    if (group_of(i) >= 0) ++begin[group_of(i) + 1];
  for (size_t k = 1; k < begin.size(); ++k) begin[k] += begin[k - 1];
  items.resize(begin.back());
  for (int i = n - 1; i >= 0; --i)  // backwards: `begin[k + 1]` counts down to the start of k
    if (group_of(i) >= 0) items[--begin[group_of(i) + 1]] = i;
  for (size_t k = 1; k + 1 < begin.size(); ++k) begin[k] = begin[k + 1];
  begin.back() = static_cast<int>(items.size());
}

}  // namespace

void find_islands(int n_blocks, std::span<const std::pair<int, int>> pairs,
                  std::span<const unsigned char> joins, IslandGroups& groups) {
  const auto joining = [&](int b) { return b >= 0 && (joins.empty() || joins[b] != 0); };
  std::vector<int>& parent = groups.scratch;
  parent.resize(n_blocks);
  for (int b = 0; b < n_blocks; ++b) parent[b] = b;
  for (const auto& [a, b] : pairs) {
    if (!joining(a) || !joining(b)) continue;
    const int root_a = root_of(parent, a), root_b = root_of(parent, b);
    parent[root_a > root_b ? root_a : root_b] = root_a < root_b ? root_a : root_b;
  }
  groups.island_of.assign(n_blocks, -1);
  int n_islands = 0;
  for (int b = 0; b < n_blocks; ++b) {  // the root is the lowest: it is met first
    if (!joining(b)) continue;
    const int root = root_of(parent, b);
    groups.island_of[b] = root == b ? n_islands++ : groups.island_of[root];
  }
  const auto island_of = [&](int b) { return b < 0 ? -1 : groups.island_of[b]; };
  sort_by_group(n_blocks, n_islands, island_of, groups.block_begin, groups.blocks);
  const auto island_of_pair = [&](int i) {
    const auto& [a, b] = pairs[i];
    return island_of(a) >= 0 ? island_of(a) : island_of(b);
  };
  sort_by_group(static_cast<int>(pairs.size()), n_islands, island_of_pair, groups.pair_begin,
                groups.pairs);
  groups.local_index.assign(n_blocks, -1);
  for (int k = 0; k < n_islands; ++k)
    for (int i = groups.block_begin[k]; i < groups.block_begin[k + 1]; ++i)
      groups.local_index[groups.blocks[i]] = i - groups.block_begin[k];
}

}  // namespace talus
