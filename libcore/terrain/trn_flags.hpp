// libcore/terrain/trn_flags.hpp: public
// One byte a node: which of its edges are convex, and whether the node itself is.
// Only these can be met by an edge or a face of a convex block (contact modes 3 and 2): flat and
// concave features have an empty Gauss arc. On smooth ground nearly all bytes are 0.
#pragma once

#include <cstdint>
#include <vector>

#include "terrain/trn.hpp"

namespace talus {

namespace trn_flag {
inline constexpr std::uint8_t convex_east = 1;      ///< edge (r, c) - (r, c + 1)
inline constexpr std::uint8_t convex_south = 2;     ///< edge (r, c) - (r + 1, c)
inline constexpr std::uint8_t convex_diagonal = 4;  ///< edge (r, c) - (r + 1, c + 1)
inline constexpr std::uint8_t convex_vertex = 8;    ///< node (r, c)
}  // namespace trn_flag

/// The default of `convex_slope` below. On 5 m of ground a feature without a flag protrudes by less
/// than 0.3 mm; double elevations of a plane stay four decades below it.
inline constexpr double default_convex_slope = 1e-4;

/// Flags of every node, at [r * n_cols + c].                                  (n_rows * n_cols)
///
/// An edge is convex when the ground's slope breaks downwards across it by more than
/// `convex_slope` [-]. A slope break is at least the angle between the normals in radians, so an
/// edge without its flag opens by less than `convex_slope` radians. The two triangles of an edge
/// make a parallelogram in plan, so the break is the sum of the edge's elevations less that of
/// the two other corners, over the cell size (times sqrt 2 for the diagonal).
/// A node is convex when some plane through it stays above its six neighbours by more than
/// `convex_slope` times their distance: then a flat face can rest on it alone.
/// Edges and nodes on the rim of the grid or of known ground have no flag: there is no ground
/// beyond.
[[nodiscard]] std::vector<std::uint8_t> ground_flags(const Trn& trn,
                                                     double convex_slope = default_convex_slope);

}  // namespace talus
