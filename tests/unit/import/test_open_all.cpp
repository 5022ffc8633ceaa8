// Opening the layers of a request: parts, rings, attributes.
#include <cmath>

#include "sources.hpp"

namespace {

using namespace talus;
using namespace talus::test;

struct OpenAll : ImportTest {};

TEST_F(OpenAll, LayersStandAsTheyAreInTheirFiles) {
  ask(InputRole::contours, contours());
  ask(InputRole::spots, file("spots", 4326, {{"Point", "[11.0,46.9]", "\"elev\":\"none\""}}));
  const RawInputs raw = open_all(request);
  ASSERT_EQ(raw.layers.size(), 2U);
  EXPECT_EQ(raw.layers[0].lines.n_lines(), 2);
  EXPECT_EQ(raw.layers[0].lines.points.front(), Vec3(650000, 5200000, 100));
  EXPECT_EQ(raw.layers[1].lines.points.front(), Vec3(11.0, 46.9, 0));  // degrees, and no opinion
  EXPECT_FALSE(raw.layers[1].has_z);
  EXPECT_TRUE(std::isnan(raw.layers[1].field->values().front()));
  EXPECT_TRUE(same_crs(raw.layers[1].own_crs, crs_from_user("EPSG:4326", "a test")));
}

TEST_F(OpenAll, RingsKnowTheirPolygonAndDoNotRepeatTheirFirstPoint) {
  ask(InputRole::boundary,
      file("boundary", 32632,
           {{"Polygon", "[[[0,0],[9,0],[9,9],[0,0]],[[5,1],[8,1],[8,4],[5,1]]]", ""},
            {"Polygon", "[[[20,0],[29,0],[29,9],[20,0]]]", ""}}));
  const RawInputs raw = open_all(request);
  EXPECT_EQ(raw.layers[0].polygon, (std::vector<int>{0, 0, 1}));
  EXPECT_EQ(raw.layers[0].lines.points.size(), 9U);
}

TEST_F(OpenAll, HeightsThatNobodyAsksForAreUnknownWithoutZ) {
  ask(InputRole::site_points, file("stems", 32632, {{"Point", "[1,2]", ""}}));
  EXPECT_TRUE(std::isnan(open_all(request).layers[0].lines.points[0].z()));
}

TEST_F(OpenAll, LaserScansAreRefusedWhateverTheyAreFor) {
  std::ofstream(folder / "scan.laz") << "LASF";
  for (const InputRole role : {InputRole::points, InputRole::spots, InputRole::site_points}) {
    request.layers.clear();
    ask(role, (folder / "scan.laz").string());
    EXPECT_NE(error_of([&] { (void)open_all(request); }).find("is a laser scan"),
              std::string::npos);
  }
}

}  // namespace
