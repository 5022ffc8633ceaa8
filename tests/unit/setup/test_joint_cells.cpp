// Volumes of joint cells from spacings.
#include <gtest/gtest.h>

#include <numbers>

#include "blocks/placed_bodies.hpp"
#include "setup/joint_cells_gdal.hpp"
#include "setups.hpp"

namespace {

using namespace talus;
using namespace talus::test;

struct JointCellsOf : testing::Test {
  ScratchFolder folder;
  CollectedLog log;

  // Three sets at right angles: level, and two vertical ones.
  static std::string sets(const std::string& spacings, double x = 1, double y = 1, double z = 1) {
    const auto set = [&](const char* name, int dip, int direction, double mean) {
      return std::string("[joints.") + name + "]\ndip_deg = " + std::to_string(dip) +
             "\ndip_direction_deg = " + std::to_string(direction) +
             "\nspacing_m = " + std::to_string(mean) + "\n" + spacings;
    };
    return set("x", 90, 90, x) + set("y", 90, 0, y) + set("z", 0, 0, z);
  }
  JointCells cells(const std::string& joints, std::uint64_t seed = 1) {
    return cut_joint_cells(log, site_of(folder, joints), seed, {"site.toml", 0, "rockfall.cliff"});
  }
  // The mean of `of` over the cells, as often as each is drawn.
  template <class Quantity>
  static double mean(const JointCells& found, Quantity of) {
    double sum = 0, last = 0;
    for (std::size_t k = 0; k < found.cells.size(); ++k) {
      sum += of(volume_of(found.cells[k])) * (found.share_up_to[k] - last);
      last = found.share_up_to[k];
    }
    return sum;
  }
};

TEST_F(JointCellsOf, EvenSpacingsAreBoxes) {
  const JointCells found = cells(sets("", 1, 2, 3));
  ASSERT_GT(found.cells.size(), 1000U);
  EXPECT_DOUBLE_EQ(found.share_up_to.back(), 1);
  for (const Body& cell : found.cells) {
    ASSERT_EQ(cell.parts.size(), 1U);
    EXPECT_EQ(cell.parts[0].vertices.size(), 8U);
    EXPECT_NEAR(volume_of(cell), 6, 1e-9);
    for (const int tag : cell.parts[0].face_tag) EXPECT_EQ(tag, face_terrain);
    EXPECT_NEAR(moments(cell.parts[0]).centroid.norm(), 0, 1e-9);
  }
}

// The edges of a cell are exponential and independent: its volume has the mean of their product,
// and its logarithm three times that of an edge, -Euler's constant. Slivers are kept here.
TEST_F(JointCellsOf, RandomSpacingsHaveTheirLaw) {
  const std::string all =
      "[source]\nmin_block_volume_m3 = 1e-9\nmin_block_thickness_m = 1e-9\nmax_block_aspect = "
      "1e9\n";
  double volume = 0, logarithm = 0, unweighted = 0;
  constexpr int n_seeds = 8;
  for (int seed = 1; seed <= n_seeds; ++seed) {
    const JointCells found =
        cells(all + sets("spacing = 'exponential'\n"), static_cast<std::uint64_t>(seed));
    volume += mean(found, [](double v) { return v; }) / n_seeds;
    logarithm += mean(found, [](double v) { return std::log(v); }) / n_seeds;
    for (const Body& cell : found.cells)
      unweighted += volume_of(cell) / static_cast<double>(found.cells.size()) / n_seeds;
  }
  // Three standard deviations of so many edges of each set, 8 in each of 16 cubes of a seed.
  constexpr double n_edges = n_seeds * 16 * 8;
  EXPECT_NEAR(volume, 1, 3 * std::sqrt(3 / n_edges));
  EXPECT_NEAR(logarithm, -3 * std::numbers::egamma,
              3 * std::sqrt(3 * std::numbers::pi * std::numbers::pi / 6 / n_edges));
  EXPECT_LT(unweighted, volume);  // the cube holds large ones less often
}

TEST_F(JointCellsOf, AreTheSameForASeedAndOthersForAnother) {
  const std::string joints = sets("spacing = 'lognormal'\nspacing_std_m = 0.5\n");
  const JointCells one = cells(joints), again = cells(joints), other = cells(joints, 2);
  EXPECT_EQ(one.share_up_to, again.share_up_to);
  EXPECT_EQ(one.cells[7].parts[0].vertices, again.cells[7].parts[0].vertices);
  EXPECT_NE(one.share_up_to, other.share_up_to);
}

TEST_F(JointCellsOf, NeedSetsThatMakeCells) {
  const auto refusal = [&](const std::string& joints) {
    return refusal_of([&] { static_cast<void>(cells(joints)); });
  };
  const std::string three = sets("");
  EXPECT_NE(refusal("").find("there are 0 joint sets"), std::string::npos);
  EXPECT_NE(refusal(three.substr(0, three.find("[joints.z]"))).find("there are 2 joint sets"),
            std::string::npos);
  for (const char* hardly_parted : {"persistence = 0.01\n", "persistence = 0.9\n"})
    EXPECT_NE(refusal(sets(hardly_parted)).find("most cells are larger"), std::string::npos)
        << hardly_parted;
  EXPECT_EQ(refusal(sets("persistence = 0.99\ndisc_diameter_m = 30\n")), "accepted");
}

}  // namespace
