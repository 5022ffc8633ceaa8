// The set-up of a scene from a site, without a tool.
#include "setup/dda_inputs.hpp"
#include "setup/scene_inputs_gdal.hpp"
#include "setup/set_up_gdal.hpp"
#include "setup/site_crs_gdal.hpp"
#include "setups.hpp"

namespace {

using namespace talus;
using namespace talus::test;

struct SetUpTest : testing::Test {
  ScratchFolder folder;
  CollectedLog log;
  SetUpRequest request;

  void SetUp() override {
    request.files = {folder.file("slope.tif"), folder.file("blocks.h5"), false};
    write_trn(request.files.trn, slope_trn());
    write_blocks(request.files.blocks, three_boxes());
  }
  std::string how = "alone";  ///< [solver] blocks
  talus::SetUp made(const std::string& more = "") {
    talus::Site site = site_of(folder, more);
    site.solver.blocks = how;
    return set_up(site, request, log);
  }
  std::string refusal(const std::string& more = "") {
    return refusal_of([&] { static_cast<void>(made(more)); });
  }
};

TEST_F(SetUpTest, MakesTheSceneOfASiteWithoutATool) {
  const talus::SetUp setup = made();
  EXPECT_EQ(n_blocks(setup.scene), 3);
  EXPECT_EQ(n_blocks(setup.blocks), 3);
  EXPECT_FALSE(setup.plan.block_contacts);
  EXPECT_EQ(setup.inputs.crs_wkt, slope_trn().crs_wkt);
  EXPECT_NEAR(setup.scene.ground.classes[0].friction, std::tan(20 * std::acos(-1) / 180), 1e-15);
  EXPECT_EQ(log.digest_of("trn"), setup.inputs.trn_digest);
  EXPECT_TRUE(log.has_warning("3 blocks move as if each were alone"));
}

TEST_F(SetUpTest, ALogThatHearsNothingIsEnough) {
  InputLog deaf;
  EXPECT_EQ(n_blocks(set_up(site_of(folder), request, deaf).scene), 3);
}

TEST_F(SetUpTest, FencesStandWhereTheyAreActive) {
  const std::string line = "line = [[500060, 5000010], [500060, 5000090]]\n";
  const talus::SetUp standing = made("[fence.low]\n" + line + "capacity_kj = 500\n");
  ASSERT_EQ(standing.inputs.lines.size(), 1u);
  EXPECT_TRUE(standing.inputs.lines[0].standing);
  EXPECT_GT(standing.scene.fixed.panels.size(), 0u);
  const talus::SetUp watched = made("[fence.low]\n" + line + "active = false\n");
  EXPECT_FALSE(watched.inputs.lines[0].standing);
  EXPECT_TRUE(watched.scene.fixed.panels.empty());
}

TEST_F(SetUpTest, BlocksBesideTheTerrainAreRefusedWithHowFar) {
  write_blocks(request.files.blocks, boxes_on(slope_trn(), {{20, 30}, {250, 50}}));
  EXPECT_HOLDS(refusal(), "block 1: lies 101 m outside the terrain");
}

TEST_F(SetUpTest, BlocksOfAnotherCrsAreRefused) {
  BlockSet set = three_boxes();
  set.crs_wkt = crs_from_user("EPSG:32633", "a test");
  write_blocks(request.files.blocks, set);
  EXPECT_HOLDS(refusal(), "is in EPSG:32632");
  EXPECT_HOLDS(refusal(), "cut the blocks from this terrain");
}

TEST_F(SetUpTest, BlocksInTheGroundAreRefusedOrLifted) {
  write_blocks(request.files.blocks, boxes_on(slope_trn(), {{120, 30}, {120, 50}}, -0.25));
  EXPECT_HOLDS(refusal(), "2 of 2 blocks start below the ground, block 0 by 0.25 m");
  request.files.settle = true;
  const talus::SetUp setup = made();
  EXPECT_TRUE(log.has(Severity::info, "lifted onto it, by 0.25 m at most"));
  for (const Vec3& at : setup.blocks.centroid)
    EXPECT_GE(at.z() + setup.blocks.origin.z(), ground_height(120) + 0.5 - 1e-3);
}

TEST_F(SetUpTest, BlocksThatOverlapAreRefusedOrMovedApartWhereItIsLittle) {
  how = "together";
  write_blocks(request.files.blocks, boxes_on(slope_trn(), {{120, 30}, {120, 31.1}}, 0.01));
  EXPECT_HOLDS(refusal(), "1 pair overlaps: block 0 and block 1 by 0.4 m");
  EXPECT_HOLDS(refusal(), "a twentieth of their thickness");
  write_blocks(request.files.blocks, boxes_on(slope_trn(), {{120, 30}, {120, 31.47}}, 0.01));
  EXPECT_HOLDS(refusal(), "by 0.03 m");
  request.files.settle = true;
  EXPECT_EQ(refusal(), "accepted");
  EXPECT_TRUE(log.has(Severity::info, "moved apart, by 0.015 m at most"));
}

TEST_F(SetUpTest, ATerrainThatTheBlocksWereNotMadeForIsSaid) {
  BlockSet set = three_boxes();
  set.ground_digests = {"of another one"};
  write_blocks(request.files.blocks, set);
  const talus::SetUp setup = made();
  EXPECT_TRUE(log.has_warning("is not the terrain that"));
  EXPECT_EQ(setup.inputs.warnings.front(),
            "the terrain is not the one that the blocks were made for");
}

TEST_F(SetUpTest, TinyBlocksAndNoBlocksAreRefused) {
  BlockSet set;
  set.origin = map_origin;
  set.material_names = {"rock"};
  write_blocks(request.files.blocks, set);
  EXPECT_HOLDS(refusal(), "there is no block in it");
  const Vec3 low(120, 30, ground_height(120) + 1);
  add_body(set, {{box(low, low + Vec3::Constant(5e-4), face_terrain)}, {}});
  write_blocks(request.files.blocks, set);
  EXPECT_HOLDS(refusal(), "(a cube of 1 mm) or more");
}

TEST_F(SetUpTest, ABaseMotionThatEndsEarlyIsRefused) {
  folder.write("short.csv", "time_s,ax_m_s2,ay_m_s2,az_m_s2\n0,0,0,0\n5,1,0,0\n");
  EXPECT_HOLDS(refusal("[base_motion]\nfile = 'short.csv'\n"),
               "the base motion ends at 5 s, the run lasts 8 s");
}

TEST(SiteCrs, IsLookedAtBeforeItIsNeeded) {
  const ScratchFolder folder;
  EXPECT_NO_THROW(check_site_crs(site_of(folder)));
  EXPECT_NO_THROW(check_site_crs(site_of(folder, "[site]\ncrs = 'EPSG:32632'\n")));
  EXPECT_THROW(check_site_crs(site_of(folder, "[site]\ncrs = 'EPSG:1'\n")), InputError);
}

}  // namespace
