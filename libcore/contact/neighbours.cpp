#include "contact/neighbours.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "base/error.hpp"

namespace talus {
namespace {

constexpr int max_levels = 20;  // smaller boxes share the finest grid
constexpr int cell_bits = 19;   // a cell's index along an axis; farther cells share the last
constexpr std::int64_t last_cell = (std::int64_t{1} << cell_bits) - 2;

struct Grids {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity());
  double finest = 0;       // cell size of level 0 [m]
  std::uint32_t used = 0;  // bit k: level k holds boxes
};

double largest_side(const Box& box) { return (box.high - box.low).maxCoeff(); }

Grids grids_for(std::span<const Box> boxes) {
  Grids grids;
  double smallest = std::numeric_limits<double>::infinity(), largest = 0;
  for (const Box& box : boxes) {
    grids.low = grids.low.cwiseMin(box.low);
    smallest = std::min(smallest, largest_side(box));
    largest = std::max(largest, largest_side(box));
  }
  grids.finest = std::max(smallest, std::ldexp(largest, 1 - max_levels));
  if (!(grids.finest > 0)) grids.finest = 1;
  return grids;
}

int level_of(const Grids& grids, const Box& box) {
  const double ratio = largest_side(box) / grids.finest;
  int level = ratio > 1 ? std::ilogb(ratio) : 0;
  if (std::ldexp(1.0, level) < ratio) ++level;
  return std::min(level, max_levels);
}

using CellIndex = std::array<std::int64_t, 3>;

CellIndex cell_index(const Grids& grids, const Box& box, int level) {
  const Vec3 centre = (box.low + box.high) / 2;
  const double scale = std::ldexp(1 / grids.finest, -level);
  CellIndex index;
  for (int k = 0; k < 3; ++k)
    index[k] = static_cast<std::int64_t>(
        std::clamp(std::floor((centre[k] - grids.low[k]) * scale), 0.0, double(last_cell)));
  return index;
}

// Cells count from 1, so that the cell before the first is 0 and needs no test.
std::uint64_t pack(int level, const CellIndex& index) {
  std::uint64_t key = static_cast<std::uint64_t>(level);
  for (const std::int64_t i : index) key = key << cell_bits | static_cast<std::uint64_t>(i + 1);
  return key;
}

std::size_t hash(std::uint64_t key, std::size_t mask) {
  key *= 0x9E3779B97F4A7C15u;
  return (key ^ key >> 29) & mask;
}

void fill_table(OverlapScratch& scratch) {
  const std::size_t size = std::bit_ceil(2 * scratch.items.size() + 1);
  scratch.table.assign(size, {0, 0, 0});
  const int n = static_cast<int>(scratch.items.size());
  for (int begin = 0, end; begin < n; begin = end) {
    const std::uint64_t cell = scratch.items[begin].cell;
    for (end = begin + 1; end < n && scratch.items[end].cell == cell;) ++end;
    std::size_t slot = hash(cell, size - 1);
    while (scratch.table[slot].begin != scratch.table[slot].end) slot = (slot + 1) & (size - 1);
    scratch.table[slot] = {cell, begin, end};
  }
}

const OverlapScratch::Cell* find_cell(const OverlapScratch& scratch, std::uint64_t cell) {
  const std::size_t mask = scratch.table.size() - 1;
  for (std::size_t slot = hash(cell, mask);; slot = (slot + 1) & mask) {
    const OverlapScratch::Cell& entry = scratch.table[slot];
    if (entry.begin == entry.end) return nullptr;
    if (entry.cell == cell) return &entry;
  }
}

struct Query {
  std::span<const Box> boxes;
  std::span<const int> owner;
  std::span<const std::uint8_t> fixed;
};

// Tests box i against the boxes of one cell; on its own level every pair is met from both sides.
void test_cell(const Query& query, int i, bool own_level, const OverlapScratch::Cell& cell,
               OverlapScratch& scratch) {
  for (int k = cell.begin; k < cell.end; ++k) {
    const int j = scratch.items[k].box;
    if (own_level && j <= i) continue;
    if (query.owner[i] == query.owner[j]) continue;
    if (!query.fixed.empty() && query.fixed[i] != 0 && query.fixed[j] != 0) continue;
    if (overlap(query.boxes[i], query.boxes[j]))
      scratch.found.push_back({std::min(i, j), std::max(i, j)});
  }
}

void test_around(const Query& query, const Grids& grids, int i, int own_level,
                 OverlapScratch& scratch) {
  for (int level = own_level; level <= max_levels; ++level) {
    if ((grids.used >> level & 1u) == 0) continue;
    const CellIndex centre = cell_index(grids, query.boxes[i], level);
    for (std::int64_t dx = -1; dx <= 1; ++dx)
      for (std::int64_t dy = -1; dy <= 1; ++dy)
        for (std::int64_t dz = -1; dz <= 1; ++dz) {
          const OverlapScratch::Cell* cell =
              find_cell(scratch, pack(level, {centre[0] + dx, centre[1] + dy, centre[2] + dz}));
          if (cell != nullptr) test_cell(query, i, level == own_level, *cell, scratch);
        }
  }
}

// Sorts `found` into `pairs`: by the first box through counting, then by the second.
void sort_pairs(std::size_t n_boxes, OverlapScratch& scratch,
                std::vector<std::array<int, 2>>& pairs) {
  std::vector<int>& begin = scratch.begin;
  begin.assign(n_boxes + 1, 0);
  for (const auto& pair : scratch.found) ++begin[pair[0] + 1];
  for (std::size_t i = 0; i < n_boxes; ++i) begin[i + 1] += begin[i];
  pairs.resize(scratch.found.size());
  for (auto pair = scratch.found.rbegin(); pair != scratch.found.rend(); ++pair)
    pairs[--begin[(*pair)[0] + 1]] = *pair;
  for (auto first = pairs.begin(); first != pairs.end();) {
    const auto last =
        std::find_if(first, pairs.end(), [&](const auto& p) { return p[0] != (*first)[0]; });
    std::sort(first, last);
    first = last;
  }
}

// Where all that moves has one owner (blocks each as if alone), it can only meet what is fixed: the
// box around all of that. Otherwise everything.
Box reach_of(std::span<const Box> boxes, std::span<const int> owner,
             std::span<const std::uint8_t> fixed) {
  constexpr double far = std::numeric_limits<double>::infinity();
  const Box everything{Vec3::Constant(-far), Vec3::Constant(far)};
  if (fixed.empty()) return everything;
  Box reach{Vec3::Constant(far), Vec3::Constant(-far)};
  int owner_of_moving = -1;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (fixed[i] != 0) {
      reach.low = reach.low.cwiseMin(boxes[i].low);
      reach.high = reach.high.cwiseMax(boxes[i].high);
      continue;
    }
    if (owner_of_moving >= 0 && owner[i] != owner_of_moving) return everything;
    owner_of_moving = owner[i];
  }
  return reach;
}

}  // namespace

void find_overlaps(std::span<const Box> boxes, std::span<const int> owner,
                   std::span<const std::uint8_t> fixed, OverlapScratch& scratch,
                   std::vector<std::array<int, 2>>& pairs) {
  const int n = static_cast<int>(boxes.size());
  pairs.clear();
  scratch.items.clear();
  scratch.found.clear();
  if (n < 2) return;
  Grids grids = grids_for(boxes);
  const Box reach = reach_of(boxes, owner, fixed);
  bool any_moves = fixed.empty();
  for (int i = 0; i < n; ++i) {
    TALUS_ASSERT(boxes[i].low.allFinite() && boxes[i].high.allFinite());
    if (!overlap(boxes[i], reach)) continue;
    any_moves |= !fixed.empty() && fixed[i] == 0;
    const int level = level_of(grids, boxes[i]);
    grids.used |= 1u << level;
    scratch.items.push_back({pack(level, cell_index(grids, boxes[i], level)), i});
  }
  if (!any_moves) return;
  std::sort(scratch.items.begin(), scratch.items.end(), [](const auto& p, const auto& q) {
    return p.cell != q.cell ? p.cell < q.cell : p.box < q.box;
  });
  fill_table(scratch);
  const Query query{boxes, owner, fixed};
  for (const OverlapScratch::Item& item : scratch.items)
    test_around(query, grids, item.box, static_cast<int>(item.cell >> 3 * cell_bits), scratch);
  sort_pairs(boxes.size(), scratch, pairs);
}

}  // namespace talus
