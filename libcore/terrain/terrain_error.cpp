// Draws a terrain within the known error of its elevations.
#include "terrain/terrain_error.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/error.hpp"
#include "base/hash_random.hpp"

namespace talus {
namespace {

// Weights at whole distances from -n to n whose squares sum to 1: a weighted sum of independent
// numbers of variance 1 has variance 1, and the correlation exp(-(d / length)^2).
std::vector<double> kernel_of(double length) {
  const int n = std::max(1, static_cast<int>(std::ceil(2.2 * length)));
  std::vector<double> kernel;
  double squares = 0;
  for (int k = -n; k <= n; ++k) {
    kernel.push_back(std::exp(-2 * (k / length) * (k / length)));
    squares += kernel.back() * kernel.back();
  }
  for (double& weight : kernel) weight /= std::sqrt(squares);
  return kernel;
}

// Independent numbers at the nodes from (row, col) on.
struct Noise {
  int n_rows = 0, n_cols = 0;
  std::vector<double> value;
};

Noise white_noise(std::int64_t row0, std::int64_t col0, int n_rows, int n_cols,
                  std::uint64_t seed) {
  Noise noise{n_rows, n_cols, {}};
  noise.value.reserve(static_cast<std::size_t>(n_rows) * n_cols);
  for (int r = 0; r < n_rows; ++r)
    for (int c = 0; c < n_cols; ++c)
      noise.value.push_back(HashRandom({seed, static_cast<std::uint64_t>(row0 + r),
                                        static_cast<std::uint64_t>(col0 + c)})
                                .normal());
  return noise;
}

// Along the rows; the result is as much narrower as the kernel is wide.
Noise along_rows(const Noise& noise, const std::vector<double>& kernel) {
  const int width = static_cast<int>(kernel.size());
  Noise out{noise.n_rows, noise.n_cols - width + 1, {}};
  out.value.reserve(static_cast<std::size_t>(out.n_rows) * out.n_cols);
  for (int r = 0; r < out.n_rows; ++r)
    for (int c = 0; c < out.n_cols; ++c) {
      double sum = 0;
      for (int k = 0; k < width; ++k)
        sum += kernel[k] * noise.value[static_cast<std::size_t>(r) * noise.n_cols + c + k];
      out.value.push_back(sum);
    }
  return out;
}

Noise transposed(const Noise& noise) {
  Noise out{noise.n_cols, noise.n_rows, std::vector<double>(noise.value.size())};
  for (int r = 0; r < noise.n_rows; ++r)
    for (int c = 0; c < noise.n_cols; ++c)
      out.value[static_cast<std::size_t>(c) * out.n_cols + r] =
          noise.value[static_cast<std::size_t>(r) * noise.n_cols + c];
  return out;
}

}  // namespace

Trn with_error(const Trn& trn, double rmse, double correlation, std::uint64_t seed) {
  TALUS_ASSERT(correlation > 0);
  Trn out = trn;
  if (rmse == 0) return out;
  const std::vector<double> kernel = kernel_of(correlation / trn.cell_size);
  const int margin = static_cast<int>(kernel.size() / 2);
  const Vec2 corner = trn.origin.head<2>() + trn.node0;
  const std::int64_t col0 = std::llround(corner.x() / trn.cell_size) - margin,
                     row0 = -std::llround(corner.y() / trn.cell_size) - margin;
  const Noise white =
      white_noise(row0, col0, trn.n_rows + 2 * margin, trn.n_cols + 2 * margin, seed);
  const Noise error = transposed(along_rows(transposed(along_rows(white, kernel)), kernel));
  for (std::size_t i = 0; i < out.elevation.size(); ++i) out.elevation[i] += rmse * error.value[i];
  return out;
}

}  // namespace talus
