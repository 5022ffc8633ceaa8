// Taking layers to a common system, in plan and in height.
#include "sources.hpp"

namespace {

using namespace talus;
using namespace talus::test;

struct TakeToFrame : ImportTest {};

// 9 degrees of longitude is the central meridian of zone 32, x 500,000 m.
TEST_F(TakeToFrame, EachLayerIsTakenByAnOperationThatIsNamed) {
  ask(InputRole::contours,
      file("contours", 32632,
           {{"LineString", "[[499000,5200000,100],[501000,5200000,100]]", ""},
            {"LineString", "[[499000,5201000,110],[501000,5201000,110]]", ""}}));
  ask(InputRole::spots, file("spots", 4326, {{"Point", "[9.0,46.955,105]", ""}}));
  const RawInputs raw = read_inputs(request);
  const Vec3& spot = raw.layers[1].lines.points.front();
  EXPECT_NEAR(spot.x(), 500000, 1e-6);
  EXPECT_NEAR(spot.y(), 5200000, 1000);
  EXPECT_EQ(spot.z(), 105);
  EXPECT_EQ(raw.layers[0].taken.operation, "");
  ASSERT_EQ(raw.reading.operations.size(), 1U);
  EXPECT_NE(raw.reading.operations[0].find("spots.geojson: reprojected from EPSG:4326"),
            std::string::npos);
}

TEST_F(TakeToFrame, HeightsBecomeMetres) {
  ask(InputRole::contours, contours());
  ask(InputRole::spots, file("spots", 32632, {{"Point", "[650010,5200010,104]", ""}}));
  request.elevation_unit_m = 0.5;
  const RawInputs raw = read_inputs(request);
  EXPECT_EQ(raw.layers[0].lines.points[0].z(), 50);
  EXPECT_EQ(raw.layers[1].lines.points[0].z(), 52);
}

}  // namespace
