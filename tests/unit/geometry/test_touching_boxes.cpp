// Touching boxes, against a search of all pairs.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/random.hpp"
#include "geometry/touching_boxes.hpp"

using namespace talus;

namespace {

Box2 box_around(const Vec2& a, const Vec2& b) { return {a.cwiseMin(b), a.cwiseMax(b)}; }

// Of the sides of an outline whose corners `corner(k)` gives.
template <class Corner>
std::vector<Box2> side_boxes(int n, const Corner& corner) {
  std::vector<Box2> boxes;
  for (int k = 0; k < n; ++k) boxes.push_back(box_around(corner(k), corner((k + 1) % n)));
  return boxes;
}

Vec2 on_circle(int k, int n) {
  const double angle = 2 * std::numbers::pi * k / n;
  return {std::cos(angle), std::sin(angle)};
}

// Up and down 100 m every 0.01 m along x, or along y.
Vec2 of_comb(int k, bool turned) {
  const Vec2 at(0.01 * k, k % 2 == 0 ? 0 : 100);
  return turned ? Vec2(at.y(), at.x()) : at;
}

}  // namespace

TEST(TouchingBoxes, AreThoseThatAPairwiseSearchFinds) {
  Random random(3);
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<Box2> boxes;
    for (int i = 0; i < 60; ++i) {
      const Vec2 a(random.uniform(0, 10), random.uniform(0, 10));
      boxes.push_back(box_around(a, a + Vec2(random.uniform(-1, 1), random.uniform(-2, 2))));
    }
    boxes.push_back(boxes[7]);                                     // the same box twice
    boxes.push_back({boxes[9].high, boxes[9].high + Vec2(1, 1)});  // touches in a corner
    std::vector<std::array<int, 2>> expected;
    for (int i = 0; i < static_cast<int>(boxes.size()); ++i)
      for (int j = i + 1; j < static_cast<int>(boxes.size()); ++j)
        if ((boxes[i].low.array() <= boxes[j].high.array()).all() &&
            (boxes[j].low.array() <= boxes[i].high.array()).all())
          expected.push_back({i, j});
    EXPECT_EQ(touching_boxes(boxes).pairs, expected);
  }
  EXPECT_TRUE(touching_boxes({}).pairs.empty());
}

TEST(TouchingBoxes, OfAnOutlineTakeStepsInProportionToItsCorners) {
  for (const int n : {100, 1000, 10000, 100000}) {
    const auto circle = touching_boxes(side_boxes(n, [n](int k) { return on_circle(k, n); }));
    EXPECT_LE(circle.n_compared, 8 * n);
    for (const bool turned : {false, true}) {
      const auto comb =
          touching_boxes(side_boxes(n, [turned](int k) { return of_comb(k, turned); }));
      EXPECT_LE(comb.n_compared, 8 * n);
    }
  }
}
