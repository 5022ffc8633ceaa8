// libcore/scene/hit_chain.hpp
// Finds the hits of one block among those of all, which are in the order of their times: a look
// through all of them at each touch would cost a run of many rocks the square of their number.
#pragma once

#include <cstdint>
#include <vector>

namespace talus {

/// Part of the state, beside a list of hits.
struct HitChain {  // clang-format off
  std::vector<std::int32_t> latest;  ///< of each block the row of its latest hit, -1; empty: no hits (n_blocks)
  std::vector<std::int32_t> before;  ///< of each row that of the hit before of its block, -1 (n_hits)
};  // clang-format on

/// The latest hit of `block` for which `is_wanted`; nullptr: none.
template <class Hit, class IsWanted>
[[nodiscard]] Hit* find_hit(std::vector<Hit>& hits, const HitChain& chain, int block,
                            IsWanted&& is_wanted) {
  if (chain.latest.empty()) return nullptr;
  for (std::int32_t i = chain.latest[block]; i >= 0; i = chain.before[i])
    if (is_wanted(hits[i])) return &hits[i];
  return nullptr;
}

/// Appends a hit of hit.block. `n_blocks`: of the scene.
template <class Hit>
Hit& add_hit(const Hit& hit, int n_blocks, std::vector<Hit>& hits, HitChain& chain) {
  if (chain.latest.empty()) chain.latest.assign(n_blocks, -1);
  chain.before.push_back(chain.latest[hit.block]);
  chain.latest[hit.block] = static_cast<std::int32_t>(hits.size());
  return hits.emplace_back(hit);
}

}  // namespace talus
