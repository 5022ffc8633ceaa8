// Number and sizes of the pieces of blocks that broke, and the power law of their volumes.
#include "post/fragment_sizes.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/numbers.hpp"

namespace talus {

double fractal_dimension(double ratio, double probability) {
  return 3 + std::log(probability) / std::log(ratio);
}

double fitted_dimension(std::span<const double> volumes) {
  if (volumes.size() < 2) return no_value;
  const double least = *std::min_element(volumes.begin(), volumes.end());
  double sum = 0;
  for (const double volume : volumes) sum += std::log(volume / least);
  return sum > 0 ? 3 * static_cast<double>(volumes.size() - 1) / sum : no_value;
}

FragmentSizes fragment_sizes(const RunFile& run) {
  FragmentSizes out;
  std::vector<double> volumes;
  double all = 0, unbroken = 0;
  for (std::size_t b = 0; b < run.blocks.volume.size(); ++b) {
    const double volume = run.blocks.volume[b];
    all += volume;
    if (run.blocks.generation.empty() || run.blocks.generation[b] == 0) {
      ++out.n_unbroken;
      unbroken += volume;
    } else {
      volumes.push_back(volume);
      out.largest = std::max(out.largest, volume);
    }
  }
  out.n_pieces = static_cast<int>(volumes.size());
  out.unbroken_share = all > 0 ? unbroken / all : 0;
  out.dimension = fitted_dimension(volumes);
  return out;
}

}  // namespace talus
