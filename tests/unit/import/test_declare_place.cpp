// The common system of a request.
#include "sources.hpp"

namespace {

using namespace talus;
using namespace talus::test;

struct DeclarePlace : ImportTest {
  RawInputs declared() {
    RawInputs raw = open_all(request);
    declare_heights(raw);
    declare_plan_units(raw);
    declare_place(raw);
    return raw;
  }
  std::string utm = crs_from_user("EPSG:32632", "a test");
  std::string degrees = crs_from_user("EPSG:4326", "a test");
};

TEST_F(DeclarePlace, TheFrameIsTheSystemOfTheGroundOrTheOneAskedFor) {
  ask(InputRole::contours, contours());
  EXPECT_TRUE(same_crs(declared().frame, utm));
  request.t_srs = crs_from_user("EPSG:31287", "a test");
  const RawInputs raw = declared();
  EXPECT_EQ(raw.frame, request.t_srs);
  EXPECT_FALSE(raw.layers[0].is_in_frame);
}

TEST_F(DeclarePlace, ALayerWithoutASystemIsInTheFrame) {
  ask(InputRole::contours, contours());
  ask(InputRole::spots, file("spots", 0, {{"Point", "[650010,5200010,104]", ""}}));
  ask(InputRole::boundary, file("ring", 4326, {{"Polygon", "[[[11,46],[12,46],[12,47]]]", ""}}));
  const RawInputs raw = declared();
  EXPECT_TRUE(raw.layers[1].is_in_frame);  // a GeoJSON without crs in metres
  EXPECT_FALSE(raw.layers[2].is_in_frame);
  EXPECT_TRUE(same_crs(raw.layers[2].crs, degrees));
}

TEST_F(DeclarePlace, TheGroundItselfMustSayItsSystem) {
  ask(InputRole::contours, contours(0));
  EXPECT_NE(error_of([&] { (void)declared(); }).find("the coordinates are not degrees"),
            std::string::npos);
  request.crs_given = true;
  request.crs = utm;
  EXPECT_EQ(declared().frame, utm);
}

TEST_F(DeclarePlace, AnotherSystemThanThatOfTheFileIsRefused) {
  ask(InputRole::contours, contours());
  request.crs_given = true;
  request.crs = crs_from_user("EPSG:31287", "a test");
  EXPECT_NE(error_of([&] { (void)declared(); }).find("not EPSG:31287"), std::string::npos);
}

TEST_F(DeclarePlace, CoordinatesThatCannotBeInTheirSystemAreRefused) {
  ask(InputRole::contours, contours());
  ask(InputRole::spots, file("spots", 32632, {{"Point", "[5200010,650010,104]", ""}}));
  RawInputs raw = declared();
  declare_height_units(raw);
  EXPECT_NE(error_of([&] { check_places(raw); }), "");
}

}  // namespace
