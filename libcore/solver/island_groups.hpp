// libcore/solver/island_groups.hpp: public
// Which blocks touch each other, directly or through other blocks: union-find over the pairs in
// contact. The ground and fixed blocks join no groups.
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace talus {

/// Islands in the order of their lowest block; blocks ascend within an island, pairs keep their
/// order.
struct IslandGroups {  // clang-format off
  std::vector<int> island_of;      ///< island of block b, -1: not asked for            (n_blocks)
  std::vector<int> block_begin{0};  ///< blocks of island k: blocks[[k], [k + 1])    (n_islands + 1)
  std::vector<int> blocks;         ///< grouped by island                               (n_asked)
  std::vector<int> local_index;    ///< place of block b in its island, -1: none        (n_blocks)
  std::vector<int> pair_begin{0};  ///< pairs of island k: pairs[[k], [k + 1])       (n_islands + 1)
  std::vector<int> pairs;          ///< indices into the pairs given, grouped by island (n_used)
  std::vector<int> scratch;
};  // clang-format on

[[nodiscard]] inline int n_islands(const IslandGroups& groups) {
  return static_cast<int>(groups.block_begin.size()) - 1;
}

/// Blocks of island k, ascending.
[[nodiscard]] inline std::span<const int> blocks_of(const IslandGroups& groups, int k) {
  const auto at = static_cast<std::size_t>(k);
  return std::span(groups.blocks)
      .subspan(static_cast<std::size_t>(groups.block_begin[at]),
               static_cast<std::size_t>(groups.block_begin[at + 1] - groups.block_begin[at]));
}

/// Groups blocks 0 .. n_blocks - 1 with `joins[b]` != 0 (all when `joins` is empty).
///
/// A pair (a, b) with a block that does not join, or b = -1, belongs to the island of the other;
/// with no block that joins it belongs to none. Buffers of `groups` are kept.
void find_islands(int n_blocks, std::span<const std::pair<int, int>> pairs,
                  std::span<const unsigned char> joins, IslandGroups& groups);

}  // namespace talus
