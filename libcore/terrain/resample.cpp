// Resamples elevations of one grid to the nodes of another, row by row.
#include "terrain/resample.hpp"

#include <limits>
#include <utility>

namespace talus {
namespace {

constexpr double least_share = 1e-6;  // of a source cell

}  // namespace

AxisWeights axis_weights(int n_source, int n_target, double offset, double ratio) {
  const double half = 0.5 * std::max(ratio, 1.0);
  AxisWeights axis;
  axis.begin.push_back(0);
  axis.source_first = n_source;
  for (int target = 0; target < n_target; ++target) {
    // in the coordinate in which source index i covers i .. i + 1
    const double centre = offset + target * ratio + 0.5;
    const double low = centre - half, high = centre + half;
    const double least = std::clamp(std::floor(low + least_share), 0.0, n_source - 1.0);
    const double most = std::clamp(std::ceil(high - least_share) - 1, 0.0, n_source - 1.0);
    const int from = static_cast<int>(least), last = static_cast<int>(most);
    const bool inside = low >= -least_share && high <= n_source + least_share;
    axis.first.push_back(from);
    if (inside) {
      double sum = 0;
      for (int i = from; i <= last; ++i) {
        axis.weight.push_back(std::min(i + 1.0, high) - std::max(static_cast<double>(i), low));
        sum += axis.weight.back();
      }
      for (auto k = static_cast<std::size_t>(axis.begin.back()); k < axis.weight.size(); ++k)
        axis.weight[k] /= sum;
      axis.source_first = std::min(axis.source_first, from);
      axis.source_last = std::max(axis.source_last, last);
    }
    axis.begin.push_back(static_cast<int>(axis.weight.size()));
  }
  return axis;
}

RowResampler::RowResampler(const GridFrame& source, const GridFrame& target)
    : rows_(axis_weights(source.n_rows, target.n_rows,
                         (source.y(0) - target.y(0)) / source.cell_size,
                         target.cell_size / source.cell_size)),
      cols_(axis_weights(source.n_cols, target.n_cols,
                         (target.x(0) - source.x(0)) / source.cell_size,
                         target.cell_size / source.cell_size)),
      target_rows_(target.n_rows),
      target_cols_(target.n_cols),
      next_row_(rows_.source_first),
      across_(static_cast<std::size_t>(target.n_cols)),
      elevation_(static_cast<std::size_t>(target.n_rows) * static_cast<std::size_t>(target.n_cols),
                 std::numeric_limits<double>::quiet_NaN()) {}

void RowResampler::add_row(const double* elevation) {
  const auto at = [](int index) { return static_cast<std::size_t>(index); };
  for (int col = 0; col < target_cols_; ++col) {
    const int begin = cols_.begin[at(col)], end = cols_.begin[at(col) + 1];
    const double* z = elevation + (cols_.first[at(col)] - cols_.source_first);
    double mean = begin == end ? std::numeric_limits<double>::quiet_NaN() : 0;
    for (int k = begin; k < end; ++k) mean += cols_.weight[at(k)] * z[k - begin];
    across_[at(col)] = mean;
  }
  const int row = next_row_++;
  for (int target = open_first_; target < target_rows_; ++target) {
    const int begin = rows_.begin[at(target)], n = rows_.begin[at(target) + 1] - begin;
    const int share = row - rows_.first[at(target)];
    if (n == 0) continue;
    if (share < 0) break;
    if (share >= n) {
      open_first_ = target + 1;
      continue;
    }
    const double weight = rows_.weight[at(begin + share)];
    double* out = elevation_.data() + at(target) * across_.size();
    for (std::size_t col = 0; col < across_.size(); ++col)
      out[col] = share == 0 ? weight * across_[col] : out[col] + weight * across_[col];
  }
}

std::vector<double> RowResampler::take() { return std::move(elevation_); }

}  // namespace talus
