// Makes smaller pictures of a raster that keep its extreme values.
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
  std::vector<std::size_t> col_of(static_cast<std::size_t>(from_cols));
  for (std::int64_t c = 0; c < from_cols; ++c)
    col_of[static_cast<std::size_t>(c)] = static_cast<std::size_t>(c * n_cols / from_cols);
  auto cell = value.begin();
  for (std::int64_t r = 0; r < from_rows; ++r) {
    float* const row = overview.data() + static_cast<std::size_t>(r * n_rows / from_rows) * width;
    for (const std::size_t col : col_of) {
      const float v = *cell++;
      if (v != nodata && (row[col] == nodata || is_better(v, row[col], keep))) row[col] = v;
    }
  }
  return overview;
}

}  // namespace talus
