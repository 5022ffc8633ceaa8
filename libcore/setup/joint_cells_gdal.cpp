// Cells that [joints.*] cut in rock far from its surface: the forms of single rocks.
#include "setup/joint_cells_gdal.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/text.hpp"
#include "base/words.hpp"
#include "blocks/placed_bodies.hpp"
#include "setup/source_cut_gdal.hpp"

namespace talus {
namespace {

/// Many small cubes: in one, the number of joints of each set would have a say in all cells.
constexpr int n_cubes = 16;
constexpr double n_cells_wanted = 500;  ///< of a cube
/// Where whole cells hold less of the cubes, most cells are larger than a cube.
constexpr double least_share_whole = 0.1;
/// Mean spacings: a cube with the first joint of a set in it would hold more joints than the rest.
constexpr double first_joint_beside = 10;

// A cube of rock below a level ground that continues around it.
void make_cube(double side, BlocksWork& work) {
  Trn& ground = work.ground;
  ground.n_rows = ground.n_cols = 2;
  ground.cell_size = 2 * side;
  ground.node0 = Vec2(-side, side);
  ground.elevation.assign(4, side / 2);
  work.mass.bed = ground;
  work.mass.bed.elevation.assign(4, -side / 2);
  work.mass.volume = side * side * side;
  const double h = side / 2;
  work.area.rings = {{Vec2(-h, -h), Vec2(h, -h), Vec2(h, h), Vec2(-h, h)}};
}

// The smallest cube that should hold enough cells, and some joints of each set.
double smallest_side(BlocksWork& work) {
  std::vector<JointSet> sets;
  double side = 0;
  for (const PlannedSet& planned : work.sets) {
    sets.push_back(planned.set);
    side = std::max(side, 4 * planned.set.mean_spacing);
  }
  for (;; side *= 1.1) {
    make_cube(side, work);
    if (expected_cells(sets, measure_mass(work.ground, work.mass.bed, work.area)) >= n_cells_wanted)
      return side;
  }
}

bool is_whole(const BlockSet& set, int block) {
  const auto begin = set.joint_set.begin() + set.block_face_begin[block];
  const auto end = set.joint_set.begin() + set.block_face_begin[block + 1];
  return std::none_of(begin, end, [](int origin) { return origin < 0 && origin != face_internal; });
}

// How many cells like this one there are for each that is whole in the cube.
double weight_of(const BlockSet& set, int block, double side) {
  Vec3 low = set.centroid[block], high = low;
  for (int v = set.block_vertex_begin[block]; v < set.block_vertex_begin[block + 1]; ++v) {
    low = low.cwiseMin(set.vertices[v]);
    high = high.cwiseMax(set.vertices[v]);
  }
  return 1 / (Vec3::Ones() - (high - low) / side).prod();
}

// A rock alone is without joint faces.
Body body_of(const BlockSet& set, int block) {
  Body body;
  for (int p = set.convex_part_begin[block]; p < set.convex_part_begin[block + 1]; ++p)
    body.parts.push_back(convex_part(set, p));
  if (body.parts.size() > 1) body.shell = block_shell(set, block);
  const auto forget_joints = [](Polyhedron& one) {
    std::fill(one.face_tag.begin(), one.face_tag.end(), int{face_terrain});
  };
  std::for_each(body.parts.begin(), body.parts.end(), forget_joints);
  forget_joints(body.shell);
  std::vector<Body> bodies = {std::move(body)};
  centre(bodies);
  return std::move(bodies.front());
}

/// Cells while they are cut.
struct WholeCells {
  JointCells found;
  double volume = 0, least = 0, most = 0;  ///< of all, of the smallest, of the largest [m3]
};

WholeCells cut_cubes(InputLog& log, double side, std::uint64_t seed, BlocksWork& work) {
  make_cube(side, work);
  const MassMeasure cube = measure_mass(work.ground, work.mass.bed, work.area);
  WholeCells whole{{}, 0, cube.volume, 0};
  double sum = 0;
  for (std::uint64_t k = 0; k < n_cubes; ++k) {
    work.site.source.seed = static_cast<std::int64_t>(seed * n_cubes + k);
    work.joints.clear();
    work.blocks = {};
    cut_by_joints(log, false, cube, first_joint_beside, work);
    for (int b = 0; b < n_blocks(work.blocks); ++b) {
      if (!is_whole(work.blocks, b)) continue;
      whole.found.cells.push_back(body_of(work.blocks, b));
      whole.found.share_up_to.push_back(sum += weight_of(work.blocks, b, side));
      whole.volume += work.blocks.volume[b];
      whole.least = std::min(whole.least, work.blocks.volume[b]);
      whole.most = std::max(whole.most, work.blocks.volume[b]);
    }
  }
  for (double& share : whole.found.share_up_to) share /= sum;
  return whole;
}

}  // namespace

JointCells cut_joint_cells(InputLog& log, const Site& site, std::uint64_t seed,
                           const Where& where) {
  BlocksWork work;
  work.site = site;
  plan_sets(log, work);
  if (work.sets.size() < 3)
    throw InputError(where,
                     "shape is joint_cell, and there are " +
                         counted(work.sets.size(), "joint set") + ": three or more make cells",
                     "give [joints.NAME] the sets of the rock, or take another shape");
  double side = smallest_side(work);
  WholeCells whole = cut_cubes(log, side, seed, work);
  const auto share = [&] { return whole.volume / (n_cubes * std::pow(side, 3)); };
  for (int grown = 0; share() < least_share_whole && grown < 2; ++grown) {
    side *= std::sqrt(2);
    whole = cut_cubes(log, side, seed, work);
  }
  if (share() < least_share_whole)
    throw InputError(where,
                     "cells that are whole in cubes of rock of " + text(side, 3) + " m hold " +
                         percent(share()) + " of them: most cells are larger",
                     "raise persistence or disc_diameter_m in [joints.*], so that joints part the "
                     "rock; sets that are all parallel to one line do not");
  log.info(where.item + ": " +
           counted(static_cast<std::int64_t>(whole.found.cells.size()), "joint cell") + " of " +
           text(whole.least, 2) + " to " + text(whole.most, 2) + " m3 in " +
           std::to_string(n_cubes) + " cubes of rock of " + text(side, 3) + " m, " +
           percent(share()) + " of their volume");
  return std::move(whole.found);
}

}  // namespace talus
