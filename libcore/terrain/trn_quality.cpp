// Quality of a TRN: errors against better data, and steep or two-layered places.
#include "terrain/trn_quality.hpp"

#include "base/percentile.hpp"
#include "base/units.hpp"

namespace talus {

double elevation_or_node(const Trn& trn, double x, double y) {
  constexpr double tolerance = 1e-6;
  const double col = (x - trn.node0.x()) / trn.cell_size;
  const double row = (trn.node0.y() - y) / trn.cell_size;
  const double near_col = std::round(col), near_row = std::round(row);
  const bool at_node = std::abs(col - near_col) <= tolerance &&
                       std::abs(row - near_row) <= tolerance && near_col >= 0 && near_row >= 0 &&
                       near_col < trn.n_cols && near_row < trn.n_rows;
  if (!at_node) return elevation_at(trn, x, y);
  return trn.elevation[node_index(trn, static_cast<int>(near_row), static_cast<int>(near_col))];
}

void ErrorCollector::add(const Trn& trn, double x, double y, double truth) {
  const double error = elevation_or_node(trn, x, y) - truth;
  if (std::isnan(error)) {
    ++n_uncovered_;
    return;
  }
  errors_.push_back(error);
  if (errors_.size() > 1 && std::abs(error) <= std::abs(largest_)) return;
  largest_ = error;
  largest_at_ = {x, y};
}

ErrorStatistics ErrorCollector::statistics() const {
  ErrorStatistics result;
  result.n = static_cast<std::int64_t>(errors_.size());
  result.n_uncovered = n_uncovered_;
  if (errors_.empty()) return result;
  std::vector<double> sizes;
  sizes.reserve(errors_.size());
  double sum = 0, sum_abs = 0, sum_sq = 0;
  for (const double error : errors_) {
    sizes.push_back(std::abs(error));
    sum += error;
    sum_abs += std::abs(error);
    sum_sq += error * error;
  }
  const auto n = static_cast<double>(result.n);
  result.mean = sum / n;
  result.mae = sum_abs / n;
  result.rmse = std::sqrt(sum_sq / n);
  result.p95 = percentile(std::move(sizes), 0.95);
  result.largest = largest_;
  result.largest_at = largest_at_;
  return result;
}

namespace {

// Squares of the gradients at which the bins end, all but the last.
std::array<double, 17> bin_ends() {
  std::array<double, 17> ends{};
  for (std::size_t k = 0; k < ends.size(); ++k) {
    const double slope = std::tan(static_cast<double>(k + 1) * SlopeStatistics::bin_deg * degree);
    ends[k] = slope * slope;
  }
  return ends;
}

// One triangle of known ground with its gradient squared. Counting the ends below it costs half of
// an arc tangent.
void add_triangle(double slope_sq, const std::array<double, 17>& ends, SlopeStatistics& result) {
  std::size_t bin = 0;
  for (const double end : ends) bin += slope_sq >= end;
  ++result.n_in_bin[bin];
  ++result.n_triangles;
  result.n_flat += slope_sq == 0;
}

}  // namespace

SlopeStatistics slope_statistics(const Trn& trn) {
  const double steep = std::tan(steep_deg * degree);
  const std::array<double, 17> ends = bin_ends();
  SlopeStatistics result;
  for (const double z : trn.elevation) result.n_nodes_known += !std::isnan(z);
  double sum = 0, largest_sq = 0;
  for (Cell cell; cell.row < trn.n_rows - 1; ++cell.row)
    for (cell.col = 0; cell.col < trn.n_cols - 1; ++cell.col) {
      const double lower = triangle_gradient(trn, cell, false).squaredNorm();
      const double upper = triangle_gradient(trn, cell, true).squaredNorm();
      for (const double slope_sq : {lower, upper}) {
        if (std::isnan(slope_sq)) continue;
        add_triangle(slope_sq, ends, result);
        sum += std::sqrt(slope_sq);
        largest_sq = std::max(largest_sq, slope_sq);
      }
      result.n_cells += !std::isnan(lower) || !std::isnan(upper);
      result.n_cells_steep += lower > steep * steep || upper > steep * steep;
    }
  if (result.n_triangles > 0)
    result.mean_deg = std::atan(sum / static_cast<double>(result.n_triangles)) / degree;
  result.largest_deg = std::atan(std::sqrt(largest_sq)) / degree;
  return result;
}

}  // namespace talus
