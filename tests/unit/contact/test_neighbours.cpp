// Overlapping boxes against a search of all pairs.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <numeric>

#include "contact/neighbours.hpp"
#include "convex_bodies.hpp"

namespace {

using namespace talus;
using namespace talus::test;
using Pairs = std::vector<std::array<int, 2>>;

bool meet(const Box& p, const Box& q) {
  return (p.low.array() <= q.high.array()).all() && (q.low.array() <= p.high.array()).all();
}

Pairs brute_pairs(const std::vector<Box>& boxes, const std::vector<int>& owner) {
  Pairs pairs;
  for (int i = 0; i < static_cast<int>(boxes.size()); ++i)
    for (int j = i + 1; j < static_cast<int>(boxes.size()); ++j) {
      if (owner[i] != owner[j] && meet(boxes[i], boxes[j])) pairs.push_back({i, j});
    }
  return pairs;
}

std::vector<Box> random_boxes(Draws& random, int n, double size_ratio, double extent) {
  std::vector<Box> boxes;
  for (int i = 0; i < n; ++i) {
    const Vec3 centre(uniform(random, -extent, extent), uniform(random, -extent, extent),
                      uniform(random, -extent, extent));
    const double size = std::pow(size_ratio, uniform(random, 0, 1));
    const Vec3 half =
        size * Vec3(uniform(random, 0.1, 1), uniform(random, 0.1, 1), uniform(random, 0.1, 1));
    boxes.push_back({centre - half, centre + half});
  }
  return boxes;
}

RC_GTEST_PROP(FindOverlaps, AgreesWithAllPairs, ()) {
  Draws random(*rc::gen::arbitrary<std::uint64_t>());
  const int n = *rc::gen::inRange(0, 120);
  const double ratio = std::pow(10.0, *rc::gen::inRange(0, 8));
  const std::vector<Box> boxes = random_boxes(random, n, ratio, *rc::gen::inRange(1, 60));
  std::vector<int> owner(boxes.size());
  for (std::size_t i = 0; i < owner.size(); ++i) owner[i] = static_cast<int>(i) / 3;
  std::vector<BoxInStrip> strips;
  Pairs pairs;
  find_overlaps(boxes, owner, strips, pairs);
  RC_ASSERT(pairs == brute_pairs(boxes, owner));
}

// Boxes on a lattice touch exactly at their faces; identical boxes have the same cell; boxes
// without extent are points.
TEST(FindOverlaps, TouchingIdenticalAndEmptyBoxesAreFound) {
  std::vector<Box> boxes;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) boxes.push_back({Vec3(i, j, 0), Vec3(i + 1, j + 1, 1)});
  boxes.push_back(boxes[0]);
  boxes.push_back({Vec3(2, 2, 1), Vec3(2, 2, 1)});
  boxes.push_back({Vec3(1e7, 1e7, 1e7), Vec3(1e7, 1e7, 1e7)});
  std::vector<int> owner(boxes.size());
  std::iota(owner.begin(), owner.end(), 0);
  std::vector<BoxInStrip> strips;
  Pairs pairs;
  find_overlaps(boxes, owner, strips, pairs);
  EXPECT_EQ(pairs, brute_pairs(boxes, owner));
  const std::vector<Box> points(5, Box{Vec3(1, 1, 1), Vec3(1, 1, 1)});
  owner.resize(5);
  find_overlaps(points, owner, strips, pairs);
  EXPECT_EQ(pairs.size(), 10u);
}

}  // namespace
