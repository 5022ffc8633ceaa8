// libcore/base/index_set.hpp: public
// Indices: a set below a size, for work that goes with how many there are and not with the size,
// and a run of consecutive ones.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace talus {

struct IndexSet {
  std::vector<int> items;         ///< in the order in which they came
  std::vector<std::uint8_t> has;  ///< 1: in the set                                       (size)

  /// Makes it an empty set of indices below `size`.
  void reset(std::size_t size) {
    items.clear();
    has.assign(size, 0);
  }
  void clear() {
    for (const int i : items) has[i] = 0;
    items.clear();
  }
  /// All indices, ascending.
  void fill() {
    items.resize(has.size());
    std::iota(items.begin(), items.end(), 0);
    has.assign(has.size(), 1);
  }
  void add(int i) {
    std::uint8_t& is_in = has[i];
    if (is_in == 0) items.push_back(i);
    is_in = 1;
  }
  [[nodiscard]] bool contains(int i) const { return has[i] != 0; }
};

/// first, first + 1, ..., last - 1, for a loop.
struct IndexRange {
  struct Place {
    std::size_t at;
    std::size_t operator*() const { return at; }
    Place& operator++() {
      ++at;
      return *this;
    }
    bool operator==(const Place&) const = default;
  };
  std::size_t first = 0, last = 0;

  [[nodiscard]] Place begin() const { return {first}; }
  [[nodiscard]] Place end() const { return {last}; }
};

}  // namespace talus
