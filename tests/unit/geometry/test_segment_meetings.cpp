// Meetings of segments, against their definition.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>

#include "base/random.hpp"
#include "geometry/segment_meetings.hpp"

namespace {

using talus::find_segment_meetings;
using talus::SegmentMeetings;
using talus::Vec2;
using Segments = std::vector<std::array<int, 2>>;

// All pairs, by the definition, in whole numbers (coordinates are small ones).
long area(const Vec2& a, const Vec2& b, const Vec2& c) {
  const auto whole = [](double value) { return static_cast<long>(value); };
  return (whole(a.x()) - whole(c.x())) * (whole(b.y()) - whole(c.y())) -
         (whole(a.y()) - whole(c.y())) * (whole(b.x()) - whole(c.x()));
}

bool inside(const Vec2& p, const Vec2& a, const Vec2& b) {
  return area(a, b, p) == 0 && (p - a).dot(p - b) < 0;
}

SegmentMeetings by_brute_force(const std::vector<Vec2>& points, const Segments& segments) {
  SegmentMeetings found;
  std::set<std::array<int, 2>> touches;
  const auto at = [&](int i) { return points[static_cast<std::size_t>(i)]; };
  for (std::size_t s = 0; s < segments.size(); ++s) {
    const auto [a, b] = segments[s];
    for (const auto& other : segments)
      for (const int end : other)
        if (a != b && inside(at(end), at(a), at(b))) touches.insert({static_cast<int>(s), end});
    for (std::size_t t = s + 1; t < segments.size(); ++t) {
      const auto [c, d] = segments[t];
      const long sides_cd = area(at(a), at(b), at(c)) * area(at(a), at(b), at(d));
      const long sides_ab = area(at(c), at(d), at(a)) * area(at(c), at(d), at(b));
      if (sides_cd < 0 && sides_ab < 0)
        found.crossings.push_back({static_cast<int>(s), static_cast<int>(t)});
    }
  }
  for (const auto& [segment, point] : touches) found.touches.push_back({segment, point});
  std::sort(found.crossings.begin(), found.crossings.end());
  return found;
}

// Points of a coarse raster: crossings, touches, overlaps and common ends all happen often.
TEST(SegmentMeetings, AreThoseOfTheDefinition) {
  talus::Random random(2, "segment meetings");
  std::size_t n_touches = 0, n_crossings = 0;
  for (int scene = 0; scene < 300; ++scene) {
    const std::uint64_t width = 4 + random.below(30);
    std::vector<Vec2> points;
    for (std::uint64_t i = 0; i < width * width; ++i)
      points.emplace_back(static_cast<double>(i % width), static_cast<double>(i / width));
    std::set<std::array<int, 2>> pairs;
    for (int i = 0; i < 60; ++i) {
      const int a = static_cast<int>(random.below(points.size()));
      const int b = static_cast<int>(random.below(points.size()));
      pairs.insert({std::min(a, b), std::max(a, b)});  // a == b: a lone point
    }
    const Segments segments(pairs.begin(), pairs.end());
    const SegmentMeetings found = find_segment_meetings(points, segments);
    const SegmentMeetings expected = by_brute_force(points, segments);
    ASSERT_EQ(found.touches, expected.touches) << "scene " << scene;
    ASSERT_EQ(found.crossings, expected.crossings) << "scene " << scene;
    n_touches += expected.touches.size();
    n_crossings += expected.crossings.size();
  }
  EXPECT_GT(n_touches, 1000U);
  EXPECT_GT(n_crossings, 1000U);
}

TEST(SegmentMeetings, FindALongSegmentAcrossManyShortOnes) {
  std::vector<Vec2> points = {{-1, 0.25}, {1000.5, 900.75}};
  Segments segments = {{0, 1}};
  for (int i = 0; i < 1000; ++i) {
    points.emplace_back(i, i * 0.9 - 0.5);
    points.emplace_back(i, i * 0.9 + 2.5);
    segments.push_back({2 + 2 * i, 3 + 2 * i});
  }
  EXPECT_EQ(find_segment_meetings(points, segments).crossings.size(), 1000U);
}

TEST(SegmentMeetings, CrossingShareIsThatOfTheClosedForm) {
  EXPECT_DOUBLE_EQ(talus::crossing_share({0, 0}, {4, 0}, {1, -3}, {1, 5}), 0.25);
}

}  // namespace
