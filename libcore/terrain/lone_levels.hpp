// libcore/terrain/lone_levels.hpp: public
// Areas of one value in an elevation raster that differ much from their neighbours: fillings of
// gaps and rims where a file declares no nodata value (0, -999, 255, 9999 ...).
// in:    rows of elevations, from the first one on
// out:   the area that differs most
// method: docs/guide/limits.md, "Rasters"
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <vector>

namespace talus {

/// Height between two cells side by side that ground does not have [m]: 200 m, and 5 cells where
/// those are more.
[[nodiscard]] double impossible_step(double cell_size);

/// Cells of one value that are connected by their sides.
struct LoneLevel {
  double value = 0;           ///< [m]
  int row = 0, col = 0;       ///< of the first cell, row by row
  std::int64_t n_cells = 0;   ///< in it
  std::int64_t n_beside = 0;  ///< pairs of a cell in it and a known one beside it
  std::int64_t n_far = 0;     ///< pairs with more than the step between them
};

/// First look: the values at both ends of every step that is too high. None in a sound raster.
class StepFinder {
 public:
  StepFinder(int n_cols, double step) : step_(step), above_(static_cast<std::size_t>(n_cols)) {}
  /// NaN = unknown.                                                                     (n_cols)
  void add_row(const double* elevation);
  [[nodiscard]] const std::set<double>& values() const { return values_; }

 private:
  double step_;
  bool first_ = true;
  std::vector<double> above_;
  std::set<double> values_;
};

/// Second look, at the same rows: the areas of those values.
class LoneLevels {
 public:
  LoneLevels(int n_cols, double step, std::set<double> values);
  void add_row(const double* elevation);
  /// Of the areas that differ much from more than half of their neighbours, the one with most such
  /// neighbours.
  [[nodiscard]] std::optional<LoneLevel> worst() const;
  /// All of these areas, by their first cells.
  [[nodiscard]] std::vector<LoneLevel> all() const;

 private:
  [[nodiscard]] std::size_t leader(std::size_t area) const;
  void join(std::size_t a, std::size_t b);
  int area_of(const double* elevation, int col);
  void compare(int area_a, double a, int area_b, double b);

  double step_;
  std::set<double> values_;
  int row_ = 0;
  std::vector<double> above_;
  std::vector<int> area_above_, area_;  // of each cell of two rows, -1: none
  std::vector<LoneLevel> areas_;
  std::vector<std::size_t> parent_;
};

}  // namespace talus
