// Finds areas of one value in a raster that differ much from their neighbours.
#include "terrain/lone_levels.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace talus {

double impossible_step(double cell_size) { return std::max(200.0, 5 * cell_size); }

void StepFinder::add_row(const double* elevation) {
  const auto look = [this](double a, double b) {
    if (std::abs(a - b) > step_) values_.insert({a, b});
  };
  for (std::size_t c = 0; c < above_.size(); ++c) {
    if (!first_) look(above_[c], elevation[c]);
    if (c > 0) look(elevation[c - 1], elevation[c]);
  }
  std::copy_n(elevation, above_.size(), above_.begin());
  first_ = false;
}

LoneLevels::LoneLevels(int n_cols, double step, std::set<double> values)
    : step_(step),
      values_(std::move(values)),
      above_(static_cast<std::size_t>(n_cols), std::numeric_limits<double>::quiet_NaN()),
      area_above_(static_cast<std::size_t>(n_cols), -1),
      area_(static_cast<std::size_t>(n_cols), -1) {}

std::size_t LoneLevels::leader(std::size_t area) const {
  while (parent_[area] != area) area = parent_[area];
  return area;
}

void LoneLevels::join(std::size_t a, std::size_t b) {
  const auto [first, second] = std::minmax({leader(a), leader(b)});
  if (first == second) return;
  parent_[second] = first;
  areas_[first].n_cells += areas_[second].n_cells;
  areas_[first].n_beside += areas_[second].n_beside;
  areas_[first].n_far += areas_[second].n_far;
}

// The area of a cell: that of the cell to the left or above of the same value, which it joins.
int LoneLevels::area_of(const double* elevation, int col) {
  const auto c = static_cast<std::size_t>(col);
  if (std::isnan(elevation[c]) || !values_.contains(elevation[c])) return -1;
  const int left = c > 0 && elevation[c - 1] == elevation[c] ? area_[c - 1] : -1;
  const int up = above_[c] == elevation[c] ? area_above_[c] : -1;
  if (left >= 0 && up >= 0) join(static_cast<std::size_t>(left), static_cast<std::size_t>(up));
  if (left < 0 && up < 0) {
    parent_.push_back(areas_.size());
    areas_.push_back({elevation[c], row_, col, 0, 0, 0});
    return static_cast<int>(areas_.size()) - 1;
  }
  return static_cast<int>(leader(static_cast<std::size_t>(std::max(left, up))));
}

void LoneLevels::compare(int area_a, double a, int area_b, double b) {
  if (a == b || std::isnan(a) || std::isnan(b)) return;
  const bool is_far = std::abs(a - b) > step_;
  for (const int area : {area_a, area_b}) {
    if (area < 0) continue;
    LoneLevel& level = areas_[leader(static_cast<std::size_t>(area))];
    ++level.n_beside;
    level.n_far += is_far ? 1 : 0;
  }
}

void LoneLevels::add_row(const double* elevation) {
  for (std::size_t c = 0; c < above_.size(); ++c) {
    area_[c] = area_of(elevation, static_cast<int>(c));
    if (area_[c] >= 0) ++areas_[leader(static_cast<std::size_t>(area_[c]))].n_cells;
    compare(area_above_[c], above_[c], area_[c], elevation[c]);
    if (c > 0) compare(area_[c - 1], elevation[c - 1], area_[c], elevation[c]);
  }
  std::copy_n(elevation, above_.size(), above_.begin());
  std::swap(area_, area_above_);
  ++row_;
}

std::vector<LoneLevel> LoneLevels::all() const {
  std::vector<LoneLevel> found;
  for (std::size_t i = 0; i < areas_.size(); ++i)
    if (parent_[i] == i && 2 * areas_[i].n_far > areas_[i].n_beside) found.push_back(areas_[i]);
  return found;
}

std::optional<LoneLevel> LoneLevels::worst() const {
  std::optional<LoneLevel> found;
  for (const LoneLevel& level : all())
    if (!found || level.n_far > found->n_far) found = level;
  return found;
}

}  // namespace talus
