// Values of failure rasters: depths, thicknesses, elevations.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "blocks/failure_raster.hpp"

namespace {

using namespace talus;

// A slope of 41 x 41 nodes, 5 m apart, that rises 1 : 2 to the north from `lowest` on.
Trn slope(double lowest) {
  Trn trn;
  trn.n_rows = trn.n_cols = 41;
  trn.cell_size = 5;
  trn.node0 = {0, 200};
  trn.origin = {650000, 5200000, 0};
  for (int r = 0; r < 41; ++r)
    for (int c = 0; c < 41; ++c) trn.elevation.push_back(lowest + 2.5 * (40 - r));
  return trn;
}

const Area source{{{{60, 60}, {140, 60}, {140, 140}, {60, 140}}}};

std::string refusal(const std::function<void()>& work) {
  try {
    work();
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

std::vector<double> lowered(const Trn& trn, double depth) {
  std::vector<double> z = trn.elevation;
  for (double& value : z) value -= depth;
  return z;
}

TEST(FailureRaster, DepthsAreNoSurface) {
  for (const double lowest : {1000.0, 300.0}) {
    const Trn ground = slope(lowest);
    for (const double depth : {0.0, 12.0}) {
      const std::vector<double> raster(ground.elevation.size(), depth);
      EXPECT_NE(refusal([&] {
                  check_is_surface(ground, source, raster, {"r.tif"});
                }).find("these are depths"),
                std::string::npos);
    }
    for (const double depth : {0.0, 5.0, 39.0})
      EXPECT_EQ(refusal([&] { check_is_surface(ground, source, lowered(ground, depth), {}); }),
                "accepted");
  }
  // near the sea a surface of a few metres is one
  const Trn low = slope(5);
  EXPECT_EQ(refusal([&] { check_is_surface(low, source, lowered(low, 30), {}); }), "accepted");
}

TEST(FailureRaster, ThicknessLowersTheGround) {
  const Trn ground = slope(1000);
  std::vector<double> depth(ground.elevation.size(), 7);
  depth[0] = std::nan("");
  lower_by_thickness(ground, source, {}, depth);
  EXPECT_TRUE(std::isnan(depth[0]));
  for (std::size_t i = 1; i < depth.size(); ++i) EXPECT_EQ(depth[i], ground.elevation[i] - 7);
}

TEST(FailureRaster, ElevationsAndNegativeDepthsAreNoThickness) {
  const Trn ground = slope(1000);
  std::vector<double> raster = lowered(ground, 9);
  EXPECT_NE(refusal([&] {
              lower_by_thickness(ground, source, {"r.tif"}, raster);
            }).find("these are elevations"),
            std::string::npos);
  raster.assign(ground.elevation.size(), 7);
  raster[node_index(ground, 20, 20)] = -0.5;
  EXPECT_EQ(refusal([&] { lower_by_thickness(ground, source, {"r.tif"}, raster); }),
            "r.tif: the thickness is -0.5 m at x 650100, y 5200100, expected 0 or more");
  raster.assign(ground.elevation.size(), 7);
  raster[0] = -0.5;  // outside
  EXPECT_EQ(refusal([&] { lower_by_thickness(ground, source, {}, raster); }), "accepted");
}

}  // namespace
