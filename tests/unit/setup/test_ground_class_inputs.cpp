// Classes of ground from polygons and rasters.
#include "setup/ground_class_inputs_gdal.hpp"
#include "setups.hpp"

namespace {

using namespace talus;
using namespace talus::test;

struct GroundClasses : testing::Test {
  ScratchFolder folder;
  CollectedLog log;
  Trn trn = slope_trn();

  std::vector<std::uint8_t> classes(const std::string& more) {
    return ground_classes(log, site_of(folder, more), trn);
  }
  std::string refusal(const std::string& more) {
    return refusal_of([&] { static_cast<void>(classes(more)); });
  }
  // Values of pixels of 10 m over the terrain; the rows south of row 5 have `other`.
  void write_raster(int value, int other) const {
    std::string text =
        "ncols 16\nnrows 11\nxllcorner 499995\nyllcorner 4999995\ncellsize 10\n"
        "NODATA_value -9999\n";
    for (int r = 0; r < 11; ++r) {
      for (int c = 0; c < 16; ++c) text += std::to_string(r < 5 ? value : other) + " ";
      text += "\n";
    }
    folder.write("classes.asc", text);
  }
};

const std::string west =
    "polygon = [[500000, 5000000], [500075, 5000000], [500075, 5000100], [500000, 5000100]]\n";
const std::string from_raster =
    "[terrain]\nground_raster = 'classes.asc'\n[ground.rough]\nraster_values = [3, 4]\n"
    "[ground.smooth]\nraster_values = [9]\n";

TEST_F(GroundClasses, OneSectionWithoutAnAreaHoldsEverywhere) { EXPECT_TRUE(classes("").empty()); }

TEST_F(GroundClasses, APolygonHasTheClassOfItsSection) {
  const auto found = classes("[ground.scree]\n" + west);
  ASSERT_EQ(found.size(), 600u);
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_EQ(found[i], i % 30 < 15 ? 1 : 0) << i;
}

TEST_F(GroundClasses, PolygonsOfAFileAreUnited) {
  const std::string ring =
      "Polygon|[[[500000,5000000],[500075,5000000],[500075,5000100],[500000,5000100],"
      "[500000,5000000]]]|";
  folder.write("scree.geojson", geojson_of({ring, ring}));
  const std::string named = "[ground.scree]\npolygon_file = 'scree.geojson'\n";
  const auto written = classes("[ground.scree]\n" + west);
  EXPECT_EQ(classes(named), written);
  EXPECT_TRUE(log.has(Severity::info,
                      "scree.geojson: layer scree, 2 polygons of 7500 m2 in all; 2 that overlap or "
                      "touch were united to 1"));
  EXPECT_EQ(classes(named + west), written) << "a polygon in file and site file cancels itself";
}

TEST_F(GroundClasses, TheRasterSaysWhatPolygonsDoNot) {
  write_raster(3, 9);
  const auto found = classes(from_raster);
  EXPECT_EQ(found.front(), 1);
  EXPECT_EQ(found.back(), 2);
  EXPECT_FALSE(log.digest_of("ground_raster").empty());
  write_raster(-9999, -9999);
  EXPECT_EQ(classes(from_raster).front(), 0);
  write_raster(9, 9);
  EXPECT_EQ(classes(from_raster + "[ground.scree]\n" + west).front(), 3) << "polygons win";
}

TEST_F(GroundClasses, GroundWithoutAClassIsRefused) {
  for (const std::string& area : {west, std::string("raster_values = [1]\n")}) {
    const Site site = parse_site("[ground.only]\n" + area, folder.file("site.toml"));
    EXPECT_HOLDS(refusal_of([&] { static_cast<void>(ground_classes(log, site, trn)); }),
                 "no section [ground.*] holds outside the polygons")
        << area;
  }
  EXPECT_HOLDS(refusal("[ground.scree]\n" + west + "[ground.rock]\nfriction_deg = 33\n"),
               "has no polygon, and neither has");
}

TEST_F(GroundClasses, ValuesThatNoSectionOrTwoNameAreRefused) {
  write_raster(3, 5);
  EXPECT_HOLDS(refusal(from_raster), "holds the value 5 below the terrain");
  EXPECT_HOLDS(refusal(from_raster + "[ground.third]\nraster_values = [4]\n"),
               "the raster's value 4 stands for two grounds");
  EXPECT_HOLDS(refusal("[ground.rough]\nraster_values = [3]\n"), "there is no raster");
}

TEST_F(GroundClasses, CornersOutOfOrderAreRefused) {
  const std::string words = refusal(
      "[ground.scree]\npolygon = [[500000, 5000000], [500150, 5000100], [500150, 5000000], "
      "[500000, 5000100]]\n");
  EXPECT_HOLDS(words, "the polygon is not sound: Self-intersection");
  EXPECT_HOLDS(words, "500075 5000050");
  EXPECT_HOLDS(words, "put the corners in order around the area");
}

}  // namespace
