// Cutting a source into blocks.
#include "setup/sliding_sets.hpp"
#include "setup/source_cut_gdal.hpp"
#include "setup/source_work.hpp"
#include "setups.hpp"

namespace {

using namespace talus;
using namespace talus::test;

const std::string square =
    "polygon = [[500030, 5000030], [500060, 5000030], [500060, 5000060], [500030, 5000060]]\n";
const std::string normal = "failure_surface = 'normal_depth'\ndepth_m = 4\n";
const std::string joints =
    "[joints.sliding]\ndip_deg = 25\ndip_direction_deg = 90\nspacing_m = 6\n"
    "[joints.rear]\ndip_deg = 80\ndip_direction_deg = 280\nspacing_m = 8\n"
    "[joints.lateral]\ndip_deg = 85\ndip_direction_deg = 5\nspacing_m = 8\n";

struct SourceCut : testing::Test {
  ScratchFolder folder;
  CollectedLog log;

  BlocksWork work_of(const std::string& source, const std::string& more = joints) {
    BlocksWork work;
    work.site = site_of(folder, "[source]\n" + source + more);
    work.ground = slope_trn();
    work.area = read_source_area(log, work);
    return work;
  }
  BlocksWork cut(const std::string& source, const std::string& more = joints) {
    BlocksWork work = work_of(source, more);
    cut_source(log, true, work);
    return work;
  }
  std::string refusal(const std::string& source, const std::string& more = joints) {
    return refusal_of([&] { static_cast<void>(cut(source, more)); });
  }
};

TEST_F(SourceCut, BlocksFillTheMass) {
  const BlocksWork work = cut(square + normal);
  EXPECT_GT(n_blocks(work.blocks), 20);
  EXPECT_LE(volume_error(work), 1e-9);
  double volume = 0;
  for (const double v : work.blocks.volume) volume += v;
  EXPECT_NEAR(volume, work.mass.volume, 1e-6 * work.mass.volume);
}

TEST_F(SourceCut, AMassWithoutJointsStaysInOnePiece) {
  EXPECT_EQ(n_blocks(cut(square + normal, "").blocks), 1);
  EXPECT_TRUE(log.has_warning("the mass stays in one piece: there are no [joints.*]"));
}

TEST_F(SourceCut, ThePolygonOfAFileIsThatOfTheSiteFile) {
  folder.write("area.geojson",
               geojson_of({"Polygon|[[[500030,5000030],[500060,5000030],[500060,5000060],"
                           "[500030,5000060],[500030,5000030]]]|"}));
  const BlocksWork named = work_of("polygon_file = 'area.geojson'\n" + normal);
  EXPECT_NEAR(area_of(named.area), 900, 1e-9);
  EXPECT_EQ(log.layers.front().role, "source");
  EXPECT_HOLDS(refusal("polygon_file = 'nowhere.geojson'\n" + normal),
               "nowhere.geojson: cannot be opened");
}

TEST_F(SourceCut, SourcesThatCannotBeMeantAreRefused) {
  EXPECT_HOLDS(refusal(normal), "has neither polygon nor polygon_file");
  EXPECT_HOLDS(refusal("polygon = [[500030, 5000030], [500060, 5000060], [500060, 5000030], "
                       "[500030, 5000050]]\n" +
                       normal),
               "the source area crosses itself");
  EXPECT_HOLDS(refusal(square + "failure_surface = 'plane'\nplane_dip_deg = 10\n"
                                "plane_dip_direction_deg = 90\n"
                                "plane_point_m = [500040, 5000040, 1900]\n"),
               "lies nowhere below the ground");
  EXPECT_HOLDS(refusal(square + normal + "max_blocks = 5\n"), "blocks, expected at most 5");
  EXPECT_HOLDS(
      refusal(square + "failure_surface = 'slbl'\nslbl_sag_m = 2\nslbl_scenario = 'max'\n"),
      "two of slbl_curvature_m, slbl_sag_m and slbl_scenario are given");
}

TEST_F(SourceCut, ADaylightingSurfaceIsFoundOrRefusedWithReasons) {
  const std::string daylighting = square + "failure_surface = 'daylighting'\n";
  const BlocksWork work = cut(daylighting);
  ASSERT_GE(work.planes.best, 0);
  EXPECT_EQ(work.planes.planes[work.planes.best].set, "sliding");
  const std::string rough = joints + "[ground.rough]\nfriction_deg = 28\n" + square;
  const std::string words = refusal(daylighting, rough);
  EXPECT_HOLDS(words, "no joint set makes a failure surface that daylights");
  EXPECT_HOLDS(words, "sliding (25 degrees towards 90) is no steeper than the friction angle");
  EXPECT_HOLDS(words, "rear (80 degrees towards 280) dips into the slope");
  EXPECT_HOLDS(words, "would let the mass go");
  EXPECT_HOLDS(refusal(daylighting + "sliding_set = 'bedding'\n"),
               "there is no joint set bedding; there are: sliding, rear, lateral");
  EXPECT_HOLDS(refusal(daylighting + "sliding_set = 'a + b + c'\n"), "sliding_set names 3 sets");
}

TEST_F(SourceCut, APlaneThatDoesNotComeOutIsSaid) {
  const std::string plane =
      square + "failure_surface = 'plane'\nplane_dip_deg = 25\nplane_dip_direction_deg = 90\n";
  static_cast<void>(cut(plane + "plane_point_m = [500060, 5000040, 959]\n"));
  EXPECT_TRUE(log.has_warning("the failure plane comes out of the ground along 0 % of the foot"));
}

TEST_F(SourceCut, MeasuredOrientationsAreReadAndSaid) {
  folder.write("poles.csv", "dip_direction,dip\n90,25\n92,26\n88,24\n");
  const BlocksWork work =
      cut(square + normal, "[joints.bedding]\nmeasured_file = 'poles.csv'\nspacing_m = 6\n");
  EXPECT_TRUE(log.has(Severity::info, "3 orientations from"));
  EXPECT_EQ(log.files.front().first, "joints.bedding");
  EXPECT_EQ(work.sets.size(), 1u);
}

TEST(SourceWork, IsCutWhereThereIsASourceOfItsOwn) {
  BlocksWork work;
  work.site = parse_site("[source]\n" + square, "s.toml");
  EXPECT_TRUE(work.is_cut());
  work.site = parse_site("[source]\n" + square + "[blocks.a]\nposition_m = [[0, 0]]\n", "s.toml");
  EXPECT_TRUE(work.has_source());
  EXPECT_FALSE(work.is_cut());
  work.site = parse_site("[ground.a]\n", "s.toml");
  EXPECT_FALSE(work.has_source());
}

TEST(NamesJoined, AreWithoutBlanks) {
  EXPECT_EQ(names_joined("one + other"), (std::vector<std::string>{"one", "other"}));
  EXPECT_EQ(names_joined("one"), std::vector<std::string>{"one"});
  EXPECT_TRUE(names_joined("").empty());
  EXPECT_EQ(tenths(28.44), "28.4");
}

TEST(FrictionBelow, IsTheLargestOfTheCellsInTheArea) {
  const Site site =
      parse_site("[ground.a]\nfriction_deg = 20\n[ground.b]\nfriction_deg = 36\n", "s.toml");
  const Trn trn = slope_trn();
  const Area area{{{{30, 30}, {60, 30}, {60, 60}, {30, 60}}}};
  std::vector<std::uint8_t> classes(600, 0);
  EXPECT_NEAR(friction_below(site, trn, area, classes), 20 * std::acos(-1) / 180, 1e-15);
  classes[10 * 30 + 9] = 1;  // in the area
  EXPECT_NEAR(friction_below(site, trn, area, classes), 36 * std::acos(-1) / 180, 1e-15);
  classes[10 * 30 + 9] = 0;
  classes[0] = 1;  // beside it
  EXPECT_NEAR(friction_below(site, trn, area, classes), 20 * std::acos(-1) / 180, 1e-15);
}

}  // namespace
