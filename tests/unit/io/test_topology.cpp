#include <gtest/gtest.h>

#include "base/error.hpp"
#include "io/topology_gdal.hpp"

using namespace talus;

namespace {

using Polygon = std::vector<std::vector<Vec2>>;

Polygon box(double west, double south, double east, double north) {
  return {{{west, south}, {east, south}, {east, north}, {west, north}}};
}

std::string refusal(const std::vector<Polygon>& polygons, const TopologyRules& rules = {}) {
  try {
    check_topology(polygons, rules, "f.gpkg", "areas");
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

bool has(const std::string& words, const std::string& part) {
  return words.find(part) != std::string::npos;
}

}  // namespace

TEST(Topology, NeighboursAndHolesAreSound) {
  Polygon ring = box(0, 0, 30, 30);
  ring.push_back({{10, 10}, {10, 20}, {20, 20}, {20, 10}});
  EXPECT_EQ(refusal({ring, box(10, 10, 20, 20), box(30, 0, 40, 30), box(30, 30, 40, 40)}, {100, 5}),
            "accepted");
}

TEST(Topology, RefusesWhatMayNotBeFiled) {
  EXPECT_TRUE(has(refusal({box(0, 0, 10, 10), box(9, 9, 20, 20)}), "0, 0 lies over that at 9, 9"));
  EXPECT_TRUE(has(refusal({box(0, 0, 10, 10), box(2, 2, 4, 4)}), "lies over"));
  EXPECT_TRUE(has(refusal({box(0, 0, 10, 10), box(0, 0, 10, 10)}), "lies over"));
  EXPECT_TRUE(has(refusal({box(5, 5, 10, 10)}, {30, 0}), "has 25 m2, less than 30"));
  EXPECT_TRUE(has(refusal({box(0, 0, 100, 1)}, {30, 2}), "is a sliver"));
  EXPECT_TRUE(has(refusal({{{{0, 0}, {10, 10}, {10, 0}, {0, 10}}}}), "is not sound"));
}
