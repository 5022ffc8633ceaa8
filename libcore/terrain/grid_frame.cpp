// Where the nodes of a grid lie on the map: windows, alignment, memory.
#include "terrain/grid_frame.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/memory.hpp"
#include "base/text.hpp"

namespace talus {
namespace {

constexpr double rounding = 1e-6;  // of a cell: coordinates are not told apart below it

struct NodeRange {
  double first, last;  // multiples of the cell size, whole numbers
};

void refuse_size(double n_rows, double n_cols, const std::string& file) {
  throw InputError({file},
                   "the grid would have " + text(n_cols, 9) + " x " + text(n_rows, 9) +
                       " nodes, expected at most " + std::to_string(largest_n_nodes),
                   "choose a larger cell or a smaller window");
}

GridFrame frame_of_nodes(const NodeRange& cols, const NodeRange& rows, double cell_size) {
  const double n_cols = cols.last - cols.first + 1, n_rows = rows.last - rows.first + 1;
  if (!(n_cols * n_rows <= static_cast<double>(largest_n_nodes))) refuse_size(n_rows, n_cols, {});
  GridFrame frame;
  if (n_cols < 1 || n_rows < 1) return frame;
  frame.n_cols = static_cast<int>(n_cols);
  frame.n_rows = static_cast<int>(n_rows);
  frame.cell_size = cell_size;
  frame.north_west = {cols.first * cell_size, rows.last * cell_size};
  return frame;
}

NodeRange nodes_inside(double low, double high, double cell_size) {
  return {std::ceil(low / cell_size - rounding), std::floor(high / cell_size + rounding)};
}

NodeRange nodes_covering(double low, double high, double cell_size) {
  return {std::floor(low / cell_size + rounding), std::ceil(high / cell_size - rounding)};
}

}  // namespace

void check_size(const GridFrame& frame, const std::string& file) {
  if (std::int64_t{frame.n_rows} * frame.n_cols > largest_n_nodes)
    refuse_size(frame.n_rows, frame.n_cols, file);
  // An elevation each, and as much again for results of them or rows that wait to be written.
  constexpr double bytes_per_node = 16;
  require_memory(bytes_per_node * frame.n_rows * frame.n_cols, {file},
                 std::to_string(frame.n_cols) + " x " + std::to_string(frame.n_rows) + " nodes",
                 "choose a larger cell or a smaller window");
}

MapWindow extent(const GridFrame& frame) {
  return {frame.x(0), frame.y(frame.n_rows - 1), frame.x(frame.n_cols - 1), frame.y(0)};
}

MapWindow intersection(const MapWindow& a, const MapWindow& b) {
  return {std::max(a.x_min, b.x_min), std::max(a.y_min, b.y_min), std::min(a.x_max, b.x_max),
          std::min(a.y_max, b.y_max)};
}

std::optional<MapWindow> other_order_within(const MapWindow& w, const MapWindow& data) {
  if (!std::isfinite(w.x_min + w.y_min + w.x_max + w.y_max)) return std::nullopt;
  const MapWindow as_is = intersection(w, data);
  if (as_is.x_min == w.x_min && as_is.y_min == w.y_min && as_is.x_max == w.x_max &&
      as_is.y_max == w.y_max)
    return std::nullopt;
  for (const MapWindow& other : {MapWindow{w.x_min, w.x_max, w.y_min, w.y_max},
                                 MapWindow{w.y_min, w.x_min, w.y_max, w.x_max}}) {
    const MapWindow common = intersection(other, data);
    const double width = other.x_max - other.x_min, height = other.y_max - other.y_min;
    const double common_width = common.x_max - common.x_min;
    const double common_height = common.y_max - common.y_min;
    if (width > 0 && height > 0 && common_width > width / 2 && common_height > height / 2)
      return other;
  }
  return std::nullopt;
}

GridFrame frame_inside(const MapWindow& window, double cell_size) {
  return frame_of_nodes(nodes_inside(window.x_min, window.x_max, cell_size),
                        nodes_inside(window.y_min, window.y_max, cell_size), cell_size);
}

GridFrame frame_covering(const MapWindow& window, double cell_size) {
  return frame_of_nodes(nodes_covering(window.x_min, window.x_max, cell_size),
                        nodes_covering(window.y_min, window.y_max, cell_size), cell_size);
}

GridFrame part_covering(const GridFrame& frame, const MapWindow& window) {
  const auto clamped = [](double first, double last, int n) {
    return NodeRange{std::max(first, 0.0), std::min(last, n - 1.0)};
  };
  const NodeRange cols =
      clamped(std::floor((window.x_min - frame.x(0)) / frame.cell_size + rounding),
              std::ceil((window.x_max - frame.x(0)) / frame.cell_size - rounding), frame.n_cols);
  const NodeRange rows =
      clamped(std::floor((frame.y(0) - window.y_max) / frame.cell_size + rounding),
              std::ceil((frame.y(0) - window.y_min) / frame.cell_size - rounding), frame.n_rows);
  GridFrame part;
  if (!(cols.first <= cols.last && rows.first <= rows.last)) return part;
  part.n_cols = static_cast<int>(cols.last - cols.first) + 1;
  part.n_rows = static_cast<int>(rows.last - rows.first) + 1;
  part.cell_size = frame.cell_size;
  part.north_west = {frame.x(cols.first), frame.y(rows.first)};
  return part;
}

bool is_own_cell_size(const GridFrame& frame, double cell_size) {
  const double drift = std::abs(cell_size - frame.cell_size) * std::max(frame.n_rows, frame.n_cols);
  return drift < 0.01 * frame.cell_size;
}

GridFrame frame_on_dem(const GridFrame& dem, double cell_size, const MapWindow& window) {
  if (cell_size == 0 || is_own_cell_size(dem, cell_size)) return part_covering(dem, window);
  const double margin = 0.5 * (std::max(cell_size, dem.cell_size) - dem.cell_size);
  const MapWindow nodes = extent(dem);
  const MapWindow reach{nodes.x_min + margin, nodes.y_min + margin, nodes.x_max - margin,
                        nodes.y_max - margin};
  const MapWindow common = intersection(window, nodes);
  if (!(common.x_min <= common.x_max && common.y_min <= common.y_max)) return {};
  return frame_inside(intersection(reach, extent(frame_covering(common, cell_size))), cell_size);
}

Trn make_trn(const GridFrame& frame, std::string crs_wkt, std::vector<double> elevation) {
  const auto whole = [](double value) { return 100 * std::floor(value / 100); };
  Trn trn;
  trn.n_rows = frame.n_rows;
  trn.n_cols = frame.n_cols;
  trn.cell_size = frame.cell_size;
  trn.origin = {whole(frame.x(0)), whole(frame.y(frame.n_rows - 1)), 0};
  trn.node0 = frame.north_west - trn.origin.head<2>();
  trn.crs_wkt = std::move(crs_wkt);
  trn.elevation = std::move(elevation);
  return trn;
}

GridFrame frame_of(const Trn& trn) {
  return {trn.n_rows, trn.n_cols, trn.cell_size, trn.node0 + trn.origin.head<2>()};
}

}  // namespace talus
