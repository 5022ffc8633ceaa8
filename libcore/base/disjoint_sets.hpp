// libcore/base/disjoint_sets.hpp: public
// Numbers from 0 on in sets that are joined one by one.
#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

namespace talus {

class DisjointSets {
 public:
  explicit DisjointSets(std::size_t n) : above_(n) { std::iota(above_.begin(), above_.end(), 0); }

  /// The lowest number of the set that holds i.
  [[nodiscard]] int root(int i) {
    while (above_[i] != i) i = above_[i] = above_[above_[i]];
    return i;
  }
  void join(int a, int b) {
    const auto [low, high] = std::minmax({root(a), root(b)});
    above_[high] = low;
  }

 private:
  std::vector<int> above_;  // one of the same set, no higher
};

}  // namespace talus
