#include "dda/start_overlaps.hpp"

#include <algorithm>
#include <limits>

namespace talus {
namespace {

using std::size_t;

constexpr int most_rounds = 200;

std::vector<Pose> poses_of(const BlockSet& blocks) {
  std::vector<Pose> poses;
  for (const Vec3& centroid : blocks.centroid) poses.push_back({centroid, Quat::Identity()});
  return poses;
}

// Smallest width of a body's parts.
double thickness_of(const Hulls& hulls, int body) {
  const auto i = static_cast<size_t>(body);
  return *std::min_element(hulls.thickness.begin() + hulls.part_begin[i],
                           hulls.thickness.begin() + hulls.part_begin[i + 1]);
}

void move_block(BlockSet& blocks, int block, const Vec3& way) {
  const auto b = static_cast<size_t>(block);
  for (int v = blocks.block_vertex_begin[b]; v < blocks.block_vertex_begin[b + 1]; ++v)
    blocks.vertices[static_cast<size_t>(v)] += way;
  blocks.centroid[b] += way;
}

}  // namespace

std::vector<StartOverlap> start_overlaps(const BlockSet& blocks,
                                         const std::vector<StandingFence>& fences,
                                         bool among_blocks, double tolerance) {
  std::vector<Pose> poses = poses_of(blocks);
  Hulls hulls = make_hulls(blocks, poses);
  for (const StandingFence& fence : fences)
    for (const Polyhedron& plate : panel_plates(fence)) {
      add_hulls(hulls, std::span(&plate, 1), Vec3::Zero(), Mat3::Identity());
      poses.push_back({Vec3::Zero(), Quat::Identity()});
    }
  PlacedHulls placed;
  place_hulls(hulls, poses, {}, {}, placed);
  std::vector<StartOverlap> found;
  const int n = n_blocks(blocks);
  for (const BlockOverlap& overlap : block_overlaps(hulls, placed, tolerance)) {
    const bool with_panel = overlap.block_b >= n;
    if (overlap.block_a >= n || (!with_panel && !among_blocks)) continue;
    StartOverlap start{overlap, 0, false};
    start.limit = most_relaxed * std::min(thickness_of(hulls, overlap.block_a),
                                          thickness_of(hulls, overlap.block_b));
    start.is_small = !with_panel && overlap.depth <= start.limit;
    found.push_back(start);
  }
  return found;
}

MovedApart move_apart(BlockSet& blocks, double tolerance) {
  MovedApart result;
  const std::vector<Vec3> start = blocks.centroid;
  std::vector<Pose> poses = poses_of(blocks);
  const Hulls hulls = make_hulls(blocks, poses);
  PlacedHulls placed;
  for (; result.rounds < most_rounds && !result.done; ++result.rounds) {
    poses = poses_of(blocks);
    place_hulls(hulls, poses, {}, {}, placed);
    const std::vector<BlockOverlap> overlaps = block_overlaps(hulls, placed, tolerance);
    result.done = overlaps.empty();
    for (const BlockOverlap& overlap : overlaps) {
      move_block(blocks, overlap.block_a, overlap.depth / 2 * overlap.normal);
      move_block(blocks, overlap.block_b, -overlap.depth / 2 * overlap.normal);
    }
  }
  for (size_t b = 0; b < start.size(); ++b)
    result.farthest = std::max(result.farthest, (blocks.centroid[b] - start[b]).norm());
  return result;
}

}  // namespace talus
