// Candidate lines of fences on planes.
#include <gtest/gtest.h>

#include <cmath>

#include "setup/fence_candidates.hpp"

namespace {

using namespace talus;

RecordObject house(double x0, double y0, double x1, double y1) {
  return {"house", "", {{{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, true}}, 0};
}

// Falls to +x; one corner at 0, 0.
Trn falling_plane(double slope, double cell_size, int n_rows, int n_cols) {
  Trn trn;
  trn.n_rows = n_rows, trn.n_cols = n_cols, trn.cell_size = cell_size;
  trn.node0 = {0, (n_rows - 1) * cell_size};
  for (int r = 0; r < n_rows; ++r)
    for (int c = 0; c < n_cols; ++c) trn.elevation.push_back(-slope * c * cell_size);
  return trn;
}

TEST(FenceCandidates, OnAPlaneAreLinesOfEqualDistanceUphill) {
  const Trn trn = falling_plane(0.5, 5, 61, 61);  // falls to +x
  CandidateSettings settings;
  settings.by_contours = false;
  settings.nearest = 10;
  settings.farthest = 50;
  settings.step = 10;
  const RecordObject object = house(200, 140, 210, 160);
  const FenceCandidates found = fence_candidates(trn, object, settings);
  ASSERT_EQ(found.lines.size(), 5u);
  for (std::size_t i = 0; i < found.lines.size(); ++i)
    for (const Vec2& p : found.lines[i]) {
      EXPECT_NEAR(gap_to(object, p), 10 + 10 * static_cast<double>(i), 0.6);
      EXPECT_LT(p.x(), 200);  // uphill
    }
}

TEST(FenceCandidates, OfAPlaneAreItsContoursWithinTheZone) {
  const Trn trn = falling_plane(0.5, 5, 61, 61);
  CandidateSettings settings;
  settings.nearest = 10;
  settings.farthest = 60;
  settings.step = 5;
  const FenceCandidates found = fence_candidates(trn, house(200, 140, 210, 160), settings);
  ASSERT_GE(found.lines.size(), 4u);
  for (const std::vector<Vec2>& line : found.lines)
    for (const Vec2& p : line) {
      EXPECT_NEAR(p.x(), line[0].x(), 1e-6);
      EXPECT_GE(gap_to(house(200, 140, 210, 160), p), 10 - 0.1);
      EXPECT_LE(gap_to(house(200, 140, 210, 160), p), 60 + 0.1);
    }
}

TEST(FenceCandidates, AreNoMoreThanAskedForAndNoneWithoutRoom) {
  const Trn trn = falling_plane(0.5, 5, 61, 61);
  CandidateSettings settings;
  settings.by_contours = false;
  settings.step = 1;
  settings.most = 7;
  const FenceCandidates few = fence_candidates(trn, house(200, 140, 210, 160), settings);
  EXPECT_LE(few.lines.size(), 7u);
  EXPECT_GE(few.lines.size(), 4u);
  EXPECT_GT(few.step, 1);
  settings.ground_slope = 0.4;  // the plane is steeper
  const FenceCandidates none = fence_candidates(trn, house(200, 140, 210, 160), settings);
  EXPECT_TRUE(none.lines.empty());
  EXPECT_GT(none.n_in_zone, 0);
  // at the upper edge of the terrain nothing lies higher
  EXPECT_EQ(fence_candidates(trn, house(0, 0, 300, 300), settings).n_in_zone, 0);
}

}  // namespace
