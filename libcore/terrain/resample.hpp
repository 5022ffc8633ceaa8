// libcore/terrain/resample.hpp: public
// Elevations of one grid on the nodes of another, row by row, so that the source is never whole in
// memory.
// in:    rows of a source grid from north to south
// out:   elevations on a target grid; unknown wherever an unknown source node or the outside of the
//        source has a share in a node
//
// A source node represents its cell. A target node takes the mean of the source over a square of
// the larger of the two cell sizes about it, weighted by area. Where the cell grows this averages
// and does not sample; where it shrinks it is bilinear interpolation; on coinciding nodes of equal
// cells it is a copy, bit for bit; and nothing jumps between the three.
#pragma once

#include <vector>

#include "terrain/grid_frame.hpp"

namespace talus {

/// For each target index the source indices that have a share in it and their weights, which sum
/// to 1. No entry when the square leaves the source.
struct AxisWeights {
  std::vector<int> first;      ///< first source index               (n_target)
  std::vector<int> begin;      ///< of the weights of a target index (n_target + 1)
  std::vector<double> weight;  ///< [-]
  int source_first = 0;        ///< smallest source index with a share
  int source_last = -1;        ///< largest; below source_first when there is none
};

/// `offset`: place of target index 0 in units of source cells, with source index i covering
/// i - 1/2 .. i + 1/2; `ratio`: target over source cell size. Shares below 1e-6 of a source cell
/// are rounding and left out.
[[nodiscard]] AxisWeights axis_weights(int n_source, int n_target, double offset, double ratio);

class RowResampler {
 public:
  RowResampler(const GridFrame& source, const GridFrame& target);

  // The source rows and columns to hand over; none when the last is below the first.
  [[nodiscard]] int first_row() const { return rows_.source_first; }
  [[nodiscard]] int last_row() const { return rows_.source_last; }
  [[nodiscard]] int first_col() const { return cols_.source_first; }
  [[nodiscard]] int n_cols() const { return cols_.source_last - cols_.source_first + 1; }

  /// The next source row, beginning with first_row(): its n_cols() elevations, NaN = unknown.
  void add_row(const double* elevation);
  /// The target's elevations at [r * n_cols + c] after all rows; the object is spent afterwards.
  [[nodiscard]] std::vector<double> take();

 private:
  AxisWeights rows_, cols_;
  int target_rows_, target_cols_;
  int next_row_;                // source row that add_row() takes next
  int open_first_ = 0;          // target rows below this one are complete
  std::vector<double> across_;  // the source row on the target's columns
  std::vector<double> elevation_;
};

}  // namespace talus
