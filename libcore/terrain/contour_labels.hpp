// libcore/terrain/contour_labels.hpp: public
// Heights of contours from the labels beside them, as in drawings without heights.
// in:    lines in plan, places of labels with their heights
// out:   a height a line; labels and lines that do not find each other
#pragma once

#include <array>
#include <vector>

#include "terrain/contours.hpp"

namespace talus {

struct LabelledLines {
  std::vector<double> height;         ///< NaN: no label                             (n_lines)
  std::vector<int> without;           ///< lines without a label, ascending
  std::vector<int> unclear;           ///< labels that may belong to either of two lines, ascending
  int line_at_two = -1;               ///< first line with labels of two heights; -1: none
  std::array<double, 2> two_heights;  ///< of that line
};

/// A label belongs to the nearest line, if the next line is more than twice as far. Where both are
/// nearest at ends that look at each other, the line is broken there for the label: both have it.
/// Lines that share an end are one contour.
[[nodiscard]] LabelledLines heights_from_labels(const Polylines& lines,
                                                const std::vector<Vec3>& labels);

}  // namespace talus
