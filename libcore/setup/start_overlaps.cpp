// Finds blocks that overlap before anything moves, and moves them apart.
#include "setup/start_overlaps.hpp"

#include <algorithm>
#include <cmath>

#include "setup/start_depth.hpp"

namespace talus {
namespace {

using std::size_t;

constexpr int most_rounds = 1000;
/// Of lifts alone. Blocks that still overlap lean on one another in a circle, which lifts would
/// raise for ever.
constexpr int lifting_rounds = 60;
/// A pair whose normal rises by more than this (60 degrees from the vertical) lies on each other.
constexpr double least_rise = 0.5;

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

// Adds the displacement that parts one pair: z is how far a block is lifted, by the pair that lifts
// it most. `risen` is how far the blocks were lifted so far [m]. The upper block is also lifted off
// a steep face where that face's own rise made the overlap: so a wedged block goes with its
// neighbours.
void add_ways(const BlockOverlap& overlap, const std::vector<double>& risen,
              std::vector<Vec3>& ways) {
  const bool a_is_upper = overlap.normal.z() > 0;
  const auto upper = static_cast<size_t>(a_is_upper ? overlap.block_a : overlap.block_b);
  const auto lower = static_cast<size_t>(a_is_upper ? overlap.block_b : overlap.block_a);
  const double rise = std::abs(overlap.normal.z());
  const double lift = overlap.depth / rise;
  if (rise > least_rise || lift <= risen[lower] - risen[upper] + settled_tolerance) {
    ways[upper].z() = std::max(ways[upper].z(), lift);
    return;
  }
  const Vec2 from_lower = (a_is_upper ? 1 : -1) * overlap.normal.head<2>();
  const Vec2 half = overlap.depth / 2 / from_lower.squaredNorm() * from_lower;
  ways[upper].head<2>() += half;
  ways[lower].head<2>() -= half;
}

// Moves both along the normal, by half.
void part_along_normal(const BlockOverlap& overlap, std::vector<Vec3>& ways) {
  const Vec3 half = overlap.depth / 2 * overlap.normal;
  ways[static_cast<size_t>(overlap.block_a)] += half;
  ways[static_cast<size_t>(overlap.block_b)] -= half;
}

}  // namespace

std::vector<StartOverlap> start_overlaps(const BlockSet& blocks,
                                         const std::vector<StandingFence>& fences,
                                         bool among_blocks, double tolerance) {
  if (!among_blocks && fences.empty()) return {};
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
  for (const BlockOverlap& overlap : block_overlaps(hulls, placed, tolerance, n, among_blocks)) {
    const bool with_panel = overlap.block_b >= n;
    StartOverlap start{overlap, 0, false};
    start.limit = most_relaxed * std::min(thickness_of(hulls, overlap.block_a),
                                          thickness_of(hulls, overlap.block_b));
    start.is_small = !with_panel && overlap.depth <= start.limit;
    found.push_back(start);
  }
  return found;
}

Settled settle(BlockSet& blocks, const Trn& trn, bool among_blocks, double tolerance) {
  Settled result;
  const std::vector<Vec3> start = blocks.centroid;
  std::vector<Pose> poses = poses_of(blocks);
  const Hulls hulls = make_hulls(blocks, poses);
  PlacedHulls placed;
  for (; result.rounds < most_rounds && !result.done; ++result.rounds) {
    std::vector<Vec3> ways(start.size(), Vec3::Zero());
    std::vector<double> risen(start.size());
    for (size_t b = 0; b < start.size(); ++b) risen[b] = blocks.centroid[b].z() - start[b].z();
    const std::vector<double> depths = depths_below_ground(trn, blocks);
    for (size_t b = 0; b < ways.size(); ++b)
      if (depths[b] > tolerance) ways[b].z() = depths[b];
    if (among_blocks) {
      poses = poses_of(blocks);
      place_hulls(hulls, poses, {}, {}, placed);
      for (const BlockOverlap& overlap : block_overlaps(hulls, placed, tolerance))
        if (result.rounds < lifting_rounds)
          add_ways(overlap, risen, ways);
        else
          part_along_normal(overlap, ways);
    }
    result.done = true;
    for (size_t b = 0; b < ways.size(); ++b) {
      if (ways[b].isZero(0)) continue;
      result.done = false;
      move_block(blocks, static_cast<int>(b), ways[b]);
    }
  }
  for (size_t b = 0; b < start.size(); ++b)
    result.farthest = std::max(result.farthest, (blocks.centroid[b] - start[b]).norm());
  return result;
}

}  // namespace talus
