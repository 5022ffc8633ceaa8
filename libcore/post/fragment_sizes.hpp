// libcore/post/fragment_sizes.hpp: public
// Pieces of blocks that broke: their number, sizes, and the power law of their volumes.
// in:    a run whose pieces are merged (record/pieces.hpp)
// Ruiz-Carulla et al. 2017, 10.1007/s10346-016-0773-8, after Perfect 1997: N(> V) ~ V^(-D/3)
#pragma once

#include <span>

#include "record/run_file.hpp"

namespace talus {

/// Fractal dimension of pieces that break in turn, each with `probability`, into pieces of a
/// `ratio` (> 1) shorter size: D = 3 + log P / log b [-].
[[nodiscard]] double fractal_dimension(double ratio, double probability);

/// The dimension whose power law is the likeliest for these volumes above the least of them (Hill
/// 1975); NaN for fewer than two different ones.
[[nodiscard]] double fitted_dimension(std::span<const double> volumes);

struct FragmentSizes {
  int n_pieces = 0;           ///< that are there at the end
  int n_unbroken = 0;         ///< released blocks that did not break
  double unbroken_share = 0;  ///< their volume, of all [-]
  double largest = 0;         ///< volume of the largest piece, 0 without pieces [m3]
  double dimension = 0;       ///< fitted_dimension() of the pieces
};
[[nodiscard]] FragmentSizes fragment_sizes(const RunFile& run);

}  // namespace talus
