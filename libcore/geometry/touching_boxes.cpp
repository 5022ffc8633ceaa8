// Which of many boxes in plan touch, without a test of each pair.
#include "geometry/touching_boxes.hpp"

#include <algorithm>
#include <numeric>

namespace talus {
namespace {

// How many boxes a line across the axis meets, on average.
double mean_overlap(const std::vector<Box2>& boxes, Eigen::Index axis) {
  double low = boxes[0].low[axis], high = boxes[0].high[axis], sum = 0;
  for (const Box2& box : boxes) {
    low = std::min(low, box.low[axis]);
    high = std::max(high, box.high[axis]);
    sum += box.high[axis] - box.low[axis];
  }
  return high > low ? sum / (high - low) : static_cast<double>(boxes.size());
}

}  // namespace

TouchingBoxes touching_boxes(const std::vector<Box2>& boxes) {
  TouchingBoxes out;
  if (boxes.empty()) return out;
  const Eigen::Index along = mean_overlap(boxes, 0) <= mean_overlap(boxes, 1) ? 0 : 1;
  const Eigen::Index across = 1 - along;
  std::vector<int> order(boxes.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    return boxes[a].low[along] != boxes[b].low[along] ? boxes[a].low[along] < boxes[b].low[along]
                                                      : a < b;
  });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Box2& box = boxes[order[i]];
    for (std::size_t j = i + 1; j < order.size(); ++j) {
      const Box2& other = boxes[order[j]];
      if (other.low[along] > box.high[along]) break;
      ++out.n_compared;
      if (other.low[across] <= box.high[across] && box.low[across] <= other.high[across])
        out.pairs.push_back({std::min(order[i], order[j]), std::max(order[i], order[j])});
    }
  }
  std::sort(out.pairs.begin(), out.pairs.end());
  return out;
}

}  // namespace talus
