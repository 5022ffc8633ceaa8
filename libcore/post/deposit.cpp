// Fates, places and volumes of the blocks when a run ends.
#include "post/deposit.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/convex_outline.hpp"
#include "geometry/plan2d.hpp"

namespace talus {
namespace {

// A corner of a face seen from above; z is taken from the block's centroid.
using Corners = std::vector<Vec3>;

// The part of a polygon where sign * (coordinate - limit) <= 0; z goes linearly along its sides.
Corners cut(const Corners& polygon, int axis, double limit, double sign) {
  Corners out;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double off_a = sign * (a[axis] - limit), off_b = sign * (b[axis] - limit);
    if (off_a <= 0) out.push_back(a);
    if ((off_a < 0 && off_b > 0) || (off_a > 0 && off_b < 0)) {
      Vec3 at = a + off_a / (off_a - off_b) * (b - a);
      at[axis] = limit;
      out.push_back(at);
    }
  }
  return out;
}

// Integral of z over the polygon's area in plan; positive when counter-clockwise from above.
double volume_below(const Corners& polygon) {
  double sum = 0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const Vec3 &a = polygon[0], &b = polygon[i], &c = polygon[i + 1];
    const Vec2 u = (b - a).head<2>(), v = (c - a).head<2>();
    sum += cross(u, v) / 2 * (a.z() + b.z() + c.z()) / 3;
  }
  return sum;
}

struct Window {
  int row_first, row_last, col_first, col_last;
};

Window window_of(const PassageGrid& grid, const Corners& polygon) {
  Vec2 low = polygon[0].head<2>(), high = low;
  for (const Vec3& p : polygon) {
    low = low.cwiseMin(p.head<2>());
    high = high.cwiseMax(p.head<2>());
  }
  const auto index = [&grid](double length, int n) {
    return static_cast<int>(std::clamp(std::floor(length / grid.cell_size), -1.0, 1.0 * n));
  };
  return {std::max(0, index(grid.corner.y() - high.y(), grid.n_rows)),
          std::min(grid.n_rows - 1, index(grid.corner.y() - low.y(), grid.n_rows)),
          std::max(0, index(low.x() - grid.corner.x(), grid.n_cols)),
          std::min(grid.n_cols - 1, index(high.x() - grid.corner.x(), grid.n_cols))};
}

void add_triangle(std::map<std::uint32_t, double>& volume, const PassageGrid& grid,
                  const Corners& triangle) {
  const Window window = window_of(grid, triangle);
  for (int row = window.row_first; row <= window.row_last; ++row) {
    const double north = grid.corner.y() - row * grid.cell_size;
    const Corners strip = cut(cut(triangle, 1, north, 1), 1, north - grid.cell_size, -1);
    if (strip.size() < 3) continue;
    for (int col = window.col_first; col <= window.col_last; ++col) {
      const double west = grid.corner.x() + col * grid.cell_size;
      const Corners part = cut(cut(strip, 0, west, -1), 0, west + grid.cell_size, 1);
      if (part.size() < 3) continue;
      const std::uint32_t cell =
          static_cast<std::uint32_t>(row) * static_cast<std::uint32_t>(grid.n_cols) +
          static_cast<std::uint32_t>(col);
      volume[cell] += volume_below(part);
    }
  }
}

Pose frame_pose(const RunFile& run, int frame, int block) {
  const FrameBlock at = frame_block(run, frame, block);
  return {at.position, at.attitude};
}

}  // namespace

const char* text(Fate fate) {
  switch (fate) {
    case Fate::deposited:
      return "deposited";
    case Fate::moving:
      return "moving";
    case Fate::left_domain:
      break;
  }
  return "left_domain";
}

Fate fate_of(const RunFile& run, int block, double rest_speed) {
  if (!run.phase.empty()) {
    if (run.phase[block] == Phase::left_domain) return Fate::left_domain;
    if (run.phase[block] == Phase::asleep || run.phase[block] == Phase::crushed)
      return Fate::deposited;
  }
  const int n = n_frames(run.frames);
  const bool at_rest = n > 0 && frame_block(run, n - 1, block).velocity.norm() < rest_speed;
  return at_rest ? Fate::deposited : Fate::moving;
}

std::vector<double> weights_of(const RunFile& run) {
  if (run.run_weight == 1) return run.blocks.weight;
  std::vector<double> weights;
  for (int block = 0; block < n_blocks(run); ++block) weights.push_back(weight_of(run, block));
  return weights;
}

Pose first_pose(const RunFile& run, int block) {
  return n_frames(run.frames) > 0 ? frame_pose(run, 0, block) : run.blocks.rest[block];
}

Pose last_pose(const RunFile& run, int block) {
  const int n = n_frames(run.frames);
  return n > 0 ? frame_pose(run, n - 1, block) : run.blocks.rest[block];
}

Balance balance_of(const RunFile& run, double rest_speed) {
  Balance b;
  for (int block = 0; block < n_blocks(run); ++block) {
    const double volume = run.blocks.volume[block];
    ++b.n_released;
    b.released += volume;
    switch (fate_of(run, block, rest_speed)) {
      case Fate::deposited:
        ++b.n_deposited;
        b.deposited += volume;
        break;
      case Fate::moving:
        ++b.n_moving;
        b.moving += volume;
        break;
      case Fate::left_domain:
        ++b.n_left;
        b.left += volume;
        break;
    }
  }
  return b;
}

void add(Balance& sum, const Balance& other) {
  sum.n_released += other.n_released;
  sum.n_deposited += other.n_deposited;
  sum.n_moving += other.n_moving;
  sum.n_left += other.n_left;
  sum.released += other.released;
  sum.deposited += other.deposited;
  sum.moving += other.moving;
  sum.left += other.left;
}

std::vector<Vec2> footprint(const RunFile& run, int block, const Pose& pose) {
  std::vector<Vec2> points;
  for (int v = run.blocks.vertex_begin[block]; v < run.blocks.vertex_begin[block + 1]; ++v)
    points.push_back(place(pose, run.blocks.vertices[v]).head<2>());
  return convex_outline(std::move(points));
}

void add_volume(std::map<std::uint32_t, double>& volume, const PassageGrid& grid,
                const RunFile& run, int block, const Pose& pose) {
  const RunBlocks& blocks = run.blocks;
  const Vec3 lift(0, 0, pose.position.z());
  const auto corner = [&](int i) -> Vec3 {
    return place(pose, blocks.vertices[blocks.face_vertices[i]]) - lift;
  };
  for (int f = blocks.block_face_begin[block]; f < blocks.block_face_begin[block + 1]; ++f)
    for (int i = blocks.face_begin[f] + 1; i + 1 < blocks.face_begin[f + 1]; ++i)
      add_triangle(volume, grid, {corner(blocks.face_begin[f]), corner(i), corner(i + 1)});
}

void add_deposit(DepositSums& sums, const PassageGrid& grid, const RunFile& run, double rest_speed,
                 double least) {
  for (int block = 0; block < n_blocks(run); ++block) {
    if (fate_of(run, block, rest_speed) != Fate::deposited) continue;
    const Pose pose = last_pose(run, block);
    if (least >= 0 && !((pose.position - run.blocks.rest[block].position).norm() > least)) continue;
    if (run.run_weight == 1) {
      add_volume(sums.volume, grid, run, block, pose);
    } else {
      std::map<std::uint32_t, double> volume;
      add_volume(volume, grid, run, block, pose);
      for (const auto& [cell, value] : volume) sums.volume[cell] += run.run_weight * value;
    }
    const double row = std::floor((grid.corner.y() - pose.position.y()) / grid.cell_size);
    const double col = std::floor((pose.position.x() - grid.corner.x()) / grid.cell_size);
    if (!(row >= 0 && row < grid.n_rows && col >= 0 && col < grid.n_cols)) continue;
    const auto cell = static_cast<std::uint32_t>(row * grid.n_cols + col);
    sums.count[cell] += 1;
    sums.weight[cell] += weight_of(run, block);
  }
}

void add(DepositSums& sums, const DepositSums& other) {
  for (const auto& [cell, value] : other.count) sums.count[cell] += value;
  for (const auto& [cell, value] : other.weight) sums.weight[cell] += value;
  for (const auto& [cell, value] : other.volume) sums.volume[cell] += value;
}

MapLayer deposit_layer(const DepositSums& sums, double cell_size, const ShareBasis& basis) {
  MapLayer layer{"", {}, {}};
  for (const auto& [cell, volume] : sums.volume) layer.cell.push_back(cell);
  for (const auto& [cell, count] : sums.count)
    if (!sums.volume.contains(cell)) layer.cell.push_back(cell);
  std::sort(layer.cell.begin(), layer.cell.end());
  const auto fill = [&](const std::string& name, const std::string& unit,
                        const std::string& description,
                        const std::map<std::uint32_t, double>& values, double divisor) {
    MapBand band{name, unit, description, true, {}};
    for (const std::uint32_t cell : layer.cell) {
      const auto at = values.find(cell);
      // cutting at the cells' sides leaves rounding, of either sign, where a block does not reach
      const double value = at == values.end() ? 0 : std::max(0.0, at->second);
      band.value.push_back(static_cast<float>(value / divisor));
    }
    layer.bands.push_back(std::move(band));
  };
  const double n = n_runs(basis.clusters);
  fill("n_deposit", "1", "number of blocks of all runs at rest with their centroid in the cell",
       sums.count, 1);
  fill("deposit_fraction", "1",
       "weight of the blocks at rest with their centroid in the cell / weight of all released "
       "blocks",
       sums.weight, basis.over.whole);
  fill("deposit_thickness", "m",
       "volume of the blocks at rest over the cell / cell area, mean over the runs", sums.volume,
       cell_size * cell_size * n);
  return layer;
}

}  // namespace talus
