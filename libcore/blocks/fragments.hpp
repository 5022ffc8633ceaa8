// libcore/blocks/fragments.hpp: public
// The pieces into which a block may break: a binary tree, cut before anything moves by planes
// through the blocks. Each piece is a body of the block set; it does not exist until its parent
// breaks.
// in:    convex blocks
// out:   the same set with the pieces behind them, and the parent and cut plane of each
//
// Binary cuts and not Voronoi cells: they have the 7 faces and 9 vertices of natural fragments
// (Domokos et al. 2020).
#pragma once

#include <cstdint>
#include <vector>

#include "blocks/block_set.hpp"

namespace talus {

/// A body that may break, or a piece of one.
struct Fragment {
  int parent = -1;                   ///< body that it is a piece of, -1: released as it is
  int released = 0;                  ///< body of the released block that it was part of
  int generation = 0;                ///< cuts since then
  int first_piece = -1;              ///< its pieces are this body and the next; -1: none
  double volume_share = 1;           ///< of the released block's volume [-]
  double cut_area = 0;               ///< of the section between its pieces [m2]
  double bonded = 1;                 ///< share of the section that holds [-]
  Vec3 cut_normal = Vec3::UnitZ();   ///< from the first piece to the second, as cut
  Vec3 cut_centroid = Vec3::Zero();  ///< of the section, local, as cut [m]
};

enum class Splitting : std::uint8_t {
  random,  ///< planes of any direction
  joints,  ///< planes parallel to the joint sets of the block set
};

struct SplitSettings {
  Splitting splitting = Splitting::random;
  double min_volume = 0.01;    ///< no piece is smaller [m3]
  int max_generation = 6;      ///< cuts, one after the other
  std::uint64_t seed = 1;      ///< of directions and places
  std::vector<double> bonded;  ///< by joint set; empty: 1 each
};

/// Adds the pieces of all convex blocks to the set, and says so of each body of the set; blocks of
/// several parts stay whole. A plane goes through the centroid, or past it by at most a fifth of
/// the width. It is drawn from the seed and the body alone, so other blocks do not change it.
/// Throws InputError for joints in a set that has none, and for more than two million bodies.
[[nodiscard]] std::vector<Fragment> add_fragments(BlockSet& set, const SplitSettings& settings);

/// Mean normal of each joint set of a block set by the area of its faces; zero where it has none.
[[nodiscard]] std::vector<Vec3> joint_normals(const BlockSet& set);

}  // namespace talus
