// Finds overlapping boxes by strips, each sorted along one axis.
#include "contact/neighbours.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/error.hpp"

namespace talus {

void find_overlaps(std::span<const Box> boxes, std::span<const int> owner,
                   std::vector<BoxInStrip>& strips, std::vector<std::array<int, 2>>& pairs) {
  pairs.clear();
  strips.clear();
  if (boxes.size() < 2) return;
  Vec3 low = boxes[0].low, high = boxes[0].high, sides = Vec3::Zero();
  for (const Box& box : boxes) {
    TALUS_ASSERT(box.low.allFinite() && box.high.allFinite());
    low = low.cwiseMin(box.low), high = high.cwiseMax(box.high);
    sides += box.high - box.low;
  }
  const Vec3 extent = high - low;
  int across = 0;
  extent.maxCoeff(&across);
  const int next = (across + 1) % 3, last = (across + 2) % 3;
  const int along = extent[next] >= extent[last] ? next : last;
  // as wide as the mean box, and no more of them than boxes: so a box is in few of them
  const double width = std::max(sides[across], extent[across]) / static_cast<double>(boxes.size());
  const auto strip_of = [&](double x) {
    return width > 0 ? static_cast<int>(std::floor((x - low[across]) / width)) : 0;
  };
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const int first = strip_of(boxes[i].low[across]), end = strip_of(boxes[i].high[across]) + 1;
    for (int strip = first; strip < end; ++strip)
      strips.push_back({strip, first, static_cast<int>(i), boxes[i].low[along]});
  }
  std::sort(strips.begin(), strips.end(), [](const BoxInStrip& p, const BoxInStrip& q) {
    return std::tie(p.strip, p.low, p.box) < std::tie(q.strip, q.low, q.box);
  });
  for (auto p = strips.begin(); p != strips.end(); ++p)
    for (auto q = p + 1;
         q != strips.end() && q->strip == p->strip && q->low <= boxes[p->box].high[along]; ++q)
      if (std::max(p->first, q->first) == p->strip && owner[p->box] != owner[q->box] &&
          overlap(boxes[p->box], boxes[q->box]))
        pairs.push_back({std::min(p->box, q->box), std::max(p->box, q->box)});
  std::sort(pairs.begin(), pairs.end());
}

}  // namespace talus
