// Flags of the nodes of a TRN: which edges and nodes are convex.
#include "terrain/trn_flags.hpp"

#include <cstddef>
#include <numbers>

namespace talus {
namespace {

// Below, z points at a node and n is the distance from row to row: z[-n] is its northern,
// z[n + 1] its south-eastern neighbour. Comparisons with NaN are false, so that an unknown
// neighbour never makes a feature convex.

bool east_is_convex(const double* z, std::ptrdiff_t n, double least) {
  return z[0] + z[1] - z[-n] - z[n + 1] > least;
}

bool south_is_convex(const double* z, std::ptrdiff_t n, double least) {
  return z[0] + z[n] - z[-1] - z[n + 1] > least;
}

bool diagonal_is_convex(const double* z, std::ptrdiff_t n, double least) {
  return z[0] + z[n + 1] - z[n] - z[1] > least;
}

// A plane with the slopes p eastwards and q southwards, per cell, stays above the neighbours when
// p, q and p + q lie inside the open intervals that the three opposite pairs of neighbours leave.
bool vertex_is_convex(const double* z, std::ptrdiff_t n, double least) {
  const double least_diagonal = std::numbers::sqrt2 * least;
  const double p_low = z[1] - z[0] + least, p_high = z[0] - z[-1] - least;
  const double q_low = z[n] - z[0] + least, q_high = z[0] - z[-n] - least;
  const double sum_low = z[n + 1] - z[0] + least_diagonal;
  const double sum_high = z[0] - z[-n - 1] - least_diagonal;
  return p_low < p_high && q_low < q_high && sum_low < sum_high && p_low + q_low < sum_high &&
         sum_low < p_high + q_high;
}

}  // namespace

std::vector<std::uint8_t> ground_flags(const Trn& trn, double convex_slope) {
  const std::ptrdiff_t n = trn.n_cols;
  const double least = convex_slope * trn.cell_size;
  const double least_diagonal = least / std::numbers::sqrt2;
  std::vector<std::uint8_t> flags(trn.elevation.size(), 0);
  for (int row = 0; row < trn.n_rows - 1; ++row) {
    const double* z = trn.elevation.data() + node_index(trn, row, 0);
    std::uint8_t* flag = flags.data() + node_index(trn, row, 0);
    for (int col = 0; col < trn.n_cols - 1; ++col, ++z) {
      int bits = diagonal_is_convex(z, n, least_diagonal) ? trn_flag::convex_diagonal : 0;
      if (row > 0 && east_is_convex(z, n, least)) bits |= trn_flag::convex_east;
      if (col > 0 && south_is_convex(z, n, least)) bits |= trn_flag::convex_south;
      if (row > 0 && col > 0 && vertex_is_convex(z, n, least)) bits |= trn_flag::convex_vertex;
      flag[col] = static_cast<std::uint8_t>(bits);
    }
  }
  return flags;
}

}  // namespace talus
