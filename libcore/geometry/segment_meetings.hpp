// libcore/geometry/segment_meetings.hpp: public
// Where the segments of a plane map meet other than at common ends, decided without rounding
// errors.
#pragma once

#include <array>
#include <vector>

#include "base/types.hpp"

namespace talus {

/// `point` lies on `segment` between its ends.
struct SegmentTouch {
  int segment = 0, point = 0;
  friend auto operator<=>(const SegmentTouch&, const SegmentTouch&) = default;
};

/// The insides of two segments cross in one point, first < second.
struct SegmentCrossing {
  int first = 0, second = 0;
  friend auto operator<=>(const SegmentCrossing&, const SegmentCrossing&) = default;
};

/// Sorted, each once.
struct SegmentMeetings {
  std::vector<SegmentTouch> touches;
  std::vector<SegmentCrossing> crossings;
};

/// All touches and crossings among `segments`, pairs of indices into `points`. A segment with two
/// equal indices is a lone point. Points must differ in x, y. Compares only segments that share a
/// cell of a uniform grid: time and memory grow with the number of segments.
[[nodiscard]] SegmentMeetings find_segment_meetings(
    const std::vector<Vec2>& points, const std::vector<std::array<int, 2>>& segments);

/// Where the lines through a, b and c, d cross, as a share of the path from a to b. Not parallel.
[[nodiscard]] double crossing_share(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d);

}  // namespace talus
