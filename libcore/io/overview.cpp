#include "io/overview.hpp"

#include <cmath>
#include <cstddef>

namespace talus {
namespace {

bool is_better(float value, float known, OverviewValue keep) {
  switch (keep) {
    case OverviewValue::smallest:
      return value < known;
    case OverviewValue::farthest_from_zero:
      return std::abs(value) > std::abs(known);
    case OverviewValue::largest:
      break;
  }
  return value > known;
}

}  // namespace

std::vector<float> overview_of(const std::vector<float>& value, int from_rows, int from_cols,
                               int n_rows, int n_cols, float nodata, OverviewValue keep) {
  const auto width = static_cast<std::size_t>(n_cols);
  std::vector<float> overview(static_cast<std::size_t>(n_rows) * width, nodata);
  auto cell = value.begin();
  for (std::int64_t r = 0; r < from_rows; ++r)
    for (std::int64_t c = 0; c < from_cols; ++c, ++cell) {
      const auto row = static_cast<std::size_t>(r * n_rows / from_rows);
      const auto col = static_cast<std::size_t>(c * n_cols / from_cols);
      float& kept = overview[row * width + col];
      if (*cell != nodata && (kept == nodata || is_better(*cell, kept, keep))) kept = *cell;
    }
  return overview;
}

}  // namespace talus
