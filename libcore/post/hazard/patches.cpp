// Joins patches of cells that are too small to be filed to their neighbours.
#include "post/hazard/patches.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace talus {
namespace {

class Patches {
 public:
  Patches(std::vector<int>& values, int n_cols)
      : values_(values), n_cols_(static_cast<std::size_t>(n_cols)), seen_(values.size(), false) {}

  // Of fewer cells than `least`, the smallest first. A patch that is open to the edge of the grid
  // is not a hole.
  std::vector<std::vector<std::size_t>> small_ones(std::int64_t least) {
    std::fill(seen_.begin(), seen_.end(), false);
    std::vector<std::vector<std::size_t>> small;
    for (std::size_t first = 0; first < values_.size(); ++first) {
      if (seen_[first]) continue;
      std::vector<std::size_t> cells{first};
      bool is_at_edge = false;
      seen_[first] = true;
      for (std::size_t k = 0; k < cells.size(); ++k) {
        const std::size_t n = for_each_neighbour(cells[k], [&](std::size_t other) {
          if (seen_[other] || values_[other] != values_[first]) return;
          seen_[other] = true;
          cells.push_back(other);
        });
        is_at_edge = is_at_edge || n < 4;
      }
      if (static_cast<std::int64_t>(cells.size()) >= least || (values_[first] == 0 && is_at_edge))
        continue;
      std::sort(cells.begin(), cells.end());
      small.push_back(std::move(cells));
    }
    std::stable_sort(small.begin(), small.end(),
                     [](const auto& a, const auto& b) { return a.size() < b.size(); });
    return small;
  }

  // Whether the patch still is one: a neighbour may have been joined to it.
  [[nodiscard]] bool is_alone(const std::vector<std::size_t>& cells) const {
    for (const std::size_t cell : cells) {
      bool is_joined = values_[cell] != values_[cells[0]];
      for_each_neighbour(cell, [&](std::size_t other) {
        is_joined = is_joined || (values_[other] == values_[cell] &&
                                  !std::binary_search(cells.begin(), cells.end(), other));
      });
      if (is_joined) return false;
    }
    return true;
  }

  // The value, not 0, of the longest border; 0 where there is none.
  [[nodiscard]] int neighbour_of(const std::vector<std::size_t>& cells) const {
    std::map<int, int> sides;
    for (const std::size_t cell : cells)
      for_each_neighbour(cell, [&](std::size_t other) {
        if (values_[other] != values_[cell] && values_[other] != 0) ++sides[values_[other]];
      });
    int best = 0, longest = 0;
    for (const auto& [value, n] : sides)
      if (n >= longest) best = value, longest = n;
    return best;
  }

 private:
  // Returns how many there are.
  template <class Take>
  std::size_t for_each_neighbour(std::size_t cell, Take&& take) const {
    const std::size_t col = cell % n_cols_;
    std::size_t n = 0;
    const auto at = [&](bool is_there, std::size_t other) {
      if (!is_there) return;
      ++n;
      take(other);
    };
    at(cell >= n_cols_, cell - n_cols_);
    at(col > 0, cell - 1);
    at(col + 1 < n_cols_, cell + 1);
    at(cell + n_cols_ < values_.size(), cell + n_cols_);
    return n;
  }

  std::vector<int>& values_;
  std::size_t n_cols_;
  std::vector<bool> seen_;
};

}  // namespace

PatchRepair join_small_patches(std::vector<int>& values, int n_cols, std::int64_t least) {
  PatchRepair repair;
  Patches patches(values, n_cols);
  for (auto small = patches.small_ones(least); !small.empty(); small = patches.small_ones(least))
    for (const std::vector<std::size_t>& cells : small) {
      if (!patches.is_alone(cells)) continue;
      const int before = values[cells[0]], after = patches.neighbour_of(cells);
      const auto n = static_cast<std::int64_t>(cells.size());
      (after > before ? repair.cells_raised : repair.cells_lowered) += n;
      ++(after == 0 ? repair.n_left_out : repair.n_joined);
      for (const std::size_t cell : cells) {
        if (after == 0) repair.left_out.push_back(static_cast<std::uint32_t>(cell));
        values[cell] = after;
      }
    }
  std::sort(repair.left_out.begin(), repair.left_out.end());
  return repair;
}

}  // namespace talus
