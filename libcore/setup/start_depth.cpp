// Depth of blocks in the ground before anything moves.
#include "setup/start_depth.hpp"

#include <algorithm>
#include <cmath>

#include "base/numbers.hpp"
#include "terrain/trn_pyramid.hpp"
#include "terrain/trn_walk.hpp"

namespace talus {
namespace {

void deepen(double& depth, double candidate) {
  if (candidate > depth) depth = candidate;  // false for NaN: unknown ground
}

// Along an edge the ground is linear between the terrain's lines.
double depth_of_edge(const Trn& trn, const Vec3& a, const Vec3& b) {
  double depth = -infinity;
  const auto try_at = [&](double t) {
    const Vec3 point = a + t * (b - a);
    deepen(depth, elevation_at(trn, point.x(), point.y()) - point.z());
  };
  try_at(0);
  try_at(1);
  walk_cells(trn, a.head<2>(), b.head<2>(), [&](const CellPart& part) {
    try_at(part.t_in);
    try_at(part.t_out);
    const auto off_diagonal = [&](double t) {
      const Vec2 at = (a + t * (b - a)).head<2>();
      return (trn.node0.y() - at.y()) / trn.cell_size - part.cell.row -
             ((at.x() - trn.node0.x()) / trn.cell_size - part.cell.col);
    };
    const double d_in = off_diagonal(part.t_in), d_out = off_diagonal(part.t_out);
    if (d_in * d_out < 0) try_at(part.t_in + d_in / (d_in - d_out) * (part.t_out - part.t_in));
  });
  return depth;
}

// Depth of the lowest point of a convex part above or below (x, y); -infinity beside the part.
double lowest_over(const Polyhedron& part, const Vec2& at) {
  double low = -infinity, high = infinity;
  for (int f = 0; f < n_faces(part); ++f) {
    const Vec3 normal = face_normal(part, f);
    const Vec3& corner = part.vertices[face(part, f)[0]];
    const double rest = normal.dot(corner) - normal.head<2>().dot(at);  // n_z z <= rest inside
    if (std::abs(normal.z()) < 1e-12) {
      if (rest < 0) return infinity;
    } else if (normal.z() > 0) {
      high = std::min(high, rest / normal.z());
    } else {
      low = std::max(low, rest / normal.z());
    }
  }
  return low <= high ? low : infinity;
}

double depth_of_part(const Trn& trn, const Polyhedron& part) {
  double depth = -infinity;
  for (const PolyhedronEdge& edge : edges(part))
    deepen(depth, depth_of_edge(trn, part.vertices[edge.a], part.vertices[edge.b]));
  Vec3 low = part.vertices[0], high = low;
  for (const Vec3& vertex : part.vertices) {
    low = low.cwiseMin(vertex);
    high = high.cwiseMax(vertex);
  }
  const CellRange cells = cells_near(trn, low, high, 0);
  for (int row = cells.row_first; row <= cells.row_last + 1; ++row)
    for (int col = cells.col_first; col <= cells.col_last + 1; ++col) {
      const Vec3 node = node_point(trn, row, col);
      deepen(depth, node.z() - lowest_over(part, node.head<2>()));
    }
  return depth;
}

}  // namespace

std::vector<double> depths_below_ground(const Trn& trn, const BlockSet& blocks) {
  std::vector<double> depths;
  for (int b = 0; b < n_blocks(blocks); ++b) {
    double depth = -infinity;
    for (int p = blocks.convex_part_begin[b]; p < blocks.convex_part_begin[b + 1]; ++p)
      deepen(depth, depth_of_part(trn, convex_part(blocks, p)));
    depths.push_back(depth);
  }
  return depths;
}

void move_to_origin(BlockSet& blocks, const Vec3& origin) {
  const Vec3 shift = blocks.origin - origin;
  for (Vec3& vertex : blocks.vertices) vertex += shift;
  for (Vec3& centroid : blocks.centroid) centroid += shift;
  for (Vec3& point : blocks.pair_point) point += shift;
  blocks.origin = origin;
}

void move_block(BlockSet& blocks, int b, const Vec3& way) {
  const auto i = static_cast<std::size_t>(b);
  for (int v = blocks.block_vertex_begin[i]; v < blocks.block_vertex_begin[i + 1]; ++v)
    blocks.vertices[v] += way;
  blocks.centroid[i] += way;
}

}  // namespace talus
