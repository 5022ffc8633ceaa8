// Water of a site: planes, points, rasters.
#include "setup/set_up_gdal.hpp"
#include "setup/water_inputs_gdal.hpp"
#include "setups.hpp"

namespace {

using namespace talus;
using namespace talus::test;

struct WaterInputs : testing::Test {
  ScratchFolder folder;
  CollectedLog log;
  Trn ground = slope_trn();
  BlockSet blocks = three_boxes();
  std::vector<std::string> sets = {"bed", "rear_1", "rear_2"};

  std::optional<JointWater> made(const std::string& keys) {
    Site site = site_of(folder, keys);
    site.solver.blocks = "together";
    const std::optional<JointWater> water = joint_water(log, site, ground, sets);
    if (water) check_water_cover(log, site, ground, *water, blocks);
    return water;
  }
  std::string refusal(const std::string& keys) {
    return refusal_of([&] { static_cast<void>(made("[water]\n" + keys)); });
  }
};

TEST_F(WaterInputs, AreNoneWithoutTheSection) {
  EXPECT_FALSE(made("").has_value());
  Site site = site_of(folder);
  override_value(site, "water.depth_m", "2");
  EXPECT_TRUE(joint_water(log, site, ground, sets).has_value());
}

// A plane by three points, and the raster of that plane: with the nodes' cells, and with smaller
// ones in another place, whose resampling errs by a part of the drop over a cell, 1 m.
TEST_F(WaterInputs, APlaneIsTheSameByPointsAndByRaster) {
  const auto plane = [](double x, double y) { return 950 - 0.2 * x + 0.1 * y; };
  const auto points = made(
      "[water]\nsurface_m = [[500000, 5000000, 950], [500100, 5000000, 930], [500000, 5000100, "
      "960]]\n");
  ASSERT_TRUE(points.has_value());
  ASSERT_EQ(points->surface.size(), ground.elevation.size());
  for (const auto& [cell, x0, y0, error] : {std::tuple(5, -10, 110, 1e-3), {4, -3, 109, 0.1}}) {
    Trn raster = ground;
    raster.cell_size = cell, raster.n_rows = 160 / cell, raster.n_cols = 200 / cell;
    raster.node0 = Vec2(x0, y0);
    raster.elevation.clear();
    for (int r = 0; r < raster.n_rows; ++r)
      for (int c = 0; c < raster.n_cols; ++c)
        raster.elevation.push_back(plane(x0 + cell * c, y0 - cell * r));
    const std::string file = "heads" + std::to_string(cell) + ".tif";
    write_trn(folder.file(file), raster);
    const auto by_raster = made("[water]\nraster = \"" + file + "\"\n");
    ASSERT_TRUE(by_raster.has_value());
    ASSERT_EQ(by_raster->surface.size(), ground.elevation.size());
    for (int r = 0; r < ground.n_rows; ++r)
      for (int c = 0; c < ground.n_cols; ++c) {
        const std::size_t node = node_index(ground, r, c);
        const double z = plane(5 * c, 100 - 5 * r);
        EXPECT_NEAR(points->surface[node], z, 1e-6);
        EXPECT_NEAR(by_raster->surface[node], z, error) << cell;
      }
  }
}

// Unknown under a part of the mass: a doubt; under all of it, and beside it: refused.
TEST_F(WaterInputs, ARasterCoversTheMass) {
  const auto refused_from = [&](double y_known) {
    Trn raster = ground;
    for (int r = 0; r < raster.n_rows; ++r)
      for (int c = 0; c < raster.n_cols; ++c)
        raster.elevation[node_index(raster, r, c)] =
            node_point(raster, r, c).y() < y_known ? 940 : std::nan("");
    write_trn(folder.file("heads.tif"), raster);
    return refusal("raster = \"heads.tif\"\n");
  };
  double low = 1e9, high = -1e9;
  for (const Vec3& at : blocks.vertices) low = std::min(low, at.y()), high = std::max(high, at.y());
  EXPECT_EQ(refused_from(high + 20), "accepted");
  EXPECT_FALSE(log.has_warning("of the corners of the mass"));
  EXPECT_EQ(refused_from((low + high) / 2), "accepted");
  EXPECT_TRUE(log.has_warning("of the corners of the mass: no water there"));
  EXPECT_HOLDS(refused_from(low - 20), "is unknown over the whole mass hint: give a raster");
}

TEST_F(WaterInputs, OnePointIsALevel) {
  const auto water = made("[water]\nsurface_m = [500010, 5000010, 940]\n");
  ASSERT_TRUE(water.has_value());
  for (const double z : water->surface) EXPECT_DOUBLE_EQ(z, 940);
  EXPECT_DOUBLE_EQ(water->unit_weight, 1000 * 9.80665);
}

TEST_F(WaterInputs, SetsAreNamedBySectionAndBySet) {
  const auto water = made(
      "[water]\ndepth_m = 2\ncracks = [\"rear\", \"source_side\"]\ncrack_fill_m = 3\n"
      "drained = \"bed\"\n");
  ASSERT_TRUE(water.has_value());
  using enum JointFill;
  EXPECT_EQ(water->of_set, (std::vector<JointFill>{drained, crack, crack}));
  EXPECT_EQ(water->of_side, crack);
  EXPECT_EQ(water->crack_fill, 3);
  EXPECT_EQ(water->depth, 2);
}

TEST_F(WaterInputs, AreRefusedWithAWayOut) {
  EXPECT_HOLDS(refusal("drained_at_m = 1\n"),
               "[water] does not say how high water is hint: give surface_m, raster or depth_m, or "
               "cracks and crack_fill_m");
  EXPECT_HOLDS(refusal("depth_m = 1\nraster = \"a.tif\"\n"),
               "[water] gives the piezometric surface 2 times hint: keep one of");
  EXPECT_HOLDS(refusal("cracks = [\"rear\"]\n"), "crack_fill_m of the cracks is not given");
  EXPECT_HOLDS(refusal("depth_m = 1\ncrack_fill_m = 2\n"), "crack_fill_m fills no joint set");
  EXPECT_HOLDS(refusal("depth_m = 1\ndrained = [\"side\"]\n"),
               "drained names side, which is not a joint set of the blocks hint: they have bed, "
               "rear_1, rear_2, source_side");
  EXPECT_HOLDS(refusal("cracks = [\"rear\"]\ncrack_fill_m = 1\ndrained = [\"rear_2\"]\n"),
               "joint set rear_2 is among the cracks and drained hint: name it in one of the two");
  EXPECT_HOLDS(refusal("surface_m = [[0, 0, 1], [1, 1, 1]]\n"),
               "surface_m is a list of 2, expected one point, or three");
  EXPECT_HOLDS(refusal("surface_m = [500010, 5000010]\n"), "a point of surface_m has no z");
  EXPECT_HOLDS(refusal("surface_m = [[500010, 5000010, 1], [500020, 5000020, 2], [500030, 5000030, "
                       "5]]\n"),
               "the three points of surface_m are in a line, or upright");
  Site alone = site_of(folder, "[water]\ndepth_m = 1\n");
  alone.solver.blocks = "alone";
  EXPECT_HOLDS(refusal_of([&] { static_cast<void>(joint_water(log, alone, ground, sets)); }),
               "each block moves alone hint: leave [water] out");
}

// From files to loads: boxes that lie on flat ground of a level have its head on their base.
TEST_F(WaterInputs, BecomeLoadsOfTheScene) {
  SetUpRequest request;
  request.files = {folder.file("slope.tif"), folder.file("blocks.h5"), false};
  write_trn(request.files.trn, ground);
  const BlockSet flat = boxes_on(ground, {{110, 30}, {112, 30}}, 0);
  write_blocks(request.files.blocks, flat);
  const double floor = ground_height(110);
  Site site = site_of(folder, "[water]\nsurface_m = [500110, 5000030, " +
                                  std::to_string(floor + 0.5) + "]\ndrained_at_m = 0.2\n");
  site.solver.blocks = "together";
  const talus::SetUp setup = set_up(site, request, log);
  EXPECT_TRUE(log.has(Severity::info, "[water] is in 3 joint faces"));
  EXPECT_EQ(setup.scene.drained_at, 0.2);
  EXPECT_EQ(setup.scene.wet_faces.size(), 3u);
  Vec3 sum = Vec3::Zero();
  for (const PointLoad& load : setup.scene.loads) sum += load.force;
  EXPECT_NEAR((sum - Vec3(0, 0, 9806.65 * 0.5 * 6)).norm(), 0, 0.1);
  override_value(site, "water.surface_m", "[500110, 5000030, 10]");
  EXPECT_TRUE(set_up(site, request, log).scene.loads.empty());
  EXPECT_TRUE(log.has_warning("the mass is dry"));
}

}  // namespace
