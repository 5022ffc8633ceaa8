// The outline of a set of cells, as polygons with holes.
#include "post/outline.hpp"

#include <algorithm>
#include <array>
#include <map>

#include "geometry/plan2d.hpp"

namespace talus {
namespace {

// A node of the grid by row and column; sides run from node to node with the cell on their left.
struct Node {
  int row = 0, col = 0;
  auto operator<=>(const Node&) const = default;
};

// Directions in the order of left turns: south, east, north, west.
constexpr std::array<Node, 4> steps = {{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};

Node next(const Node& node, int direction) {
  return {node.row + steps[direction].row, node.col + steps[direction].col};
}

class Tracer {
 public:
  Tracer(const PassageGrid& grid, std::span<const std::uint32_t> cells)
      : grid_(grid), cells_(cells), group_(cells.size(), -1) {
    find_groups();
    find_sides();
  }

  std::vector<std::vector<std::vector<Vec2>>> trace() {
    std::vector<std::vector<std::vector<Vec2>>> polygons(n_groups_);
    while (!sides_.empty()) {
      const auto [start, direction] = sides_.begin()->first;
      const int group = group_[sides_.begin()->second];
      const std::vector<Vec2> ring = take_ring(start, direction, group);
      auto& rings = polygons[group];
      rings.insert(twice_area(ring) > 0 ? rings.begin() : rings.end(), ring);
    }
    return polygons;
  }

 private:
  using Side = std::pair<Node, int>;  // start and direction

  // Place of the cell at (row, col) in the list, -1 when it is not there.
  [[nodiscard]] std::ptrdiff_t find(int row, int col) const {
    if (row < 0 || col < 0 || row >= grid_.n_rows || col >= grid_.n_cols) return -1;
    const auto cell = static_cast<std::uint32_t>(row) * static_cast<std::uint32_t>(grid_.n_cols) +
                      static_cast<std::uint32_t>(col);
    const auto at = std::lower_bound(cells_.begin(), cells_.end(), cell);
    return at != cells_.end() && *at == cell ? at - cells_.begin() : -1;
  }
  [[nodiscard]] Node place(std::size_t i) const {
    const auto n_cols = static_cast<std::uint32_t>(grid_.n_cols);
    return {static_cast<int>(cells_[i] / n_cols), static_cast<int>(cells_[i] % n_cols)};
  }

  void find_groups() {
    for (std::size_t first = 0; first < cells_.size(); ++first) {
      if (group_[first] >= 0) continue;
      std::vector<std::size_t> open{first};
      group_[first] = n_groups_;
      while (!open.empty()) {
        const Node at = place(open.back());
        open.pop_back();
        for (const Node& step : steps) {
          const std::ptrdiff_t other = find(at.row + step.row, at.col + step.col);
          if (other < 0 || group_[other] >= 0) continue;
          group_[other] = n_groups_;
          open.push_back(static_cast<std::size_t>(other));
        }
      }
      ++n_groups_;
    }
  }

  void find_sides() {
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      const Node nw = place(i);
      const std::array<Node, 4> corners = {
          {nw, {nw.row + 1, nw.col}, {nw.row + 1, nw.col + 1}, {nw.row, nw.col + 1}}};
      // West side southwards, south side eastwards, and so on: neighbour on the right-hand side.
      const std::array<Node, 4> right = {{{0, -1}, {1, 0}, {0, 1}, {-1, 0}}};
      for (int direction = 0; direction < 4; ++direction)
        if (find(nw.row + right[direction].row, nw.col + right[direction].col) < 0)
          sides_[{corners[direction], direction}] = i;
    }
  }

  // Follows the sides of one group, turning right first: where the group meets itself in a corner
  // its outline is parted into an outer ring and a hole, neither of which meets itself.
  std::vector<Vec2> take_ring(const Node& start, int direction, int group) {
    std::vector<Vec2> ring;
    Node at = start;
    int previous = -1;
    while (true) {
      const auto side = sides_.find({at, direction});
      if (side == sides_.end()) break;
      sides_.erase(side);
      if (direction != previous) ring.push_back(point(at));
      previous = direction;
      at = next(at, direction);
      for (const int turn : {3, 0, 1}) {
        const auto ahead = sides_.find({at, (direction + turn) % 4});
        if (ahead == sides_.end() || group_[ahead->second] != group) continue;
        direction = (direction + turn) % 4;
        break;
      }
    }
    return ring;
  }

  [[nodiscard]] Vec2 point(const Node& node) const {
    return grid_.corner + grid_.cell_size * Vec2(node.col, -node.row);
  }

  static double twice_area(const std::vector<Vec2>& ring) {
    double sum = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
      sum += cross(a, b);
    }
    return sum;
  }

  const PassageGrid& grid_;
  std::span<const std::uint32_t> cells_;
  std::vector<int> group_;  // of each cell
  int n_groups_ = 0;
  std::map<Side, std::size_t> sides_;  // and the cell on the left
};

}  // namespace

std::vector<std::vector<std::vector<Vec2>>> outline(const PassageGrid& grid,
                                                    std::span<const std::uint32_t> cells) {
  return Tracer(grid, cells).trace();
}

}  // namespace talus
