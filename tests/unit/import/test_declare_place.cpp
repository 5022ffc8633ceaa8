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

// y to the east and x to the north, as surveyors of some countries write them.
TEST_F(DeclarePlace, LocalMetresWithYBeforeXAreDoubted) {
  request.crs_given = true;
  const auto n_doubts = [&](const char* names) {
    const std::string path = (folder / "list.csv").string();
    std::ofstream(path) << names << "\n1;2;5\n3;4;6\n4;1;6\n";
    request.layers.clear();
    ask(InputRole::points, path);
    return declared().reading.doubts.size();
  };
  EXPECT_EQ(n_doubts("Y;X;H"), 1u);
  EXPECT_EQ(n_doubts("X;Y;H"), 0u);
  EXPECT_EQ(n_doubts("Hochwert;Rechtswert;H"), 0u);
}

TEST_F(DeclarePlace, ALocalSystemInFeetIsOfLocalMetresOnceItIsScaled) {
  const char* const feet = R"(LOCAL_CS["site",UNIT["foot",0.3048]])";
  const std::string path = (folder / "list.csv").string();
  std::ofstream(path) << "X;Y;H\n1000;2000;500\n3000;4000;600\n4000;1000;600\n";
  ask(InputRole::points, path);
  request.crs_given = true;
  request.crs = crs_from_user(feet, "a test");
  const std::string error = error_of([&] { (void)declared(); });
  EXPECT_NE(error.find("in units of 0.3048 m"), std::string::npos) << error;
  request.layers[0].ref.unit_m = 0.3048;
  RawInputs raw = open_all(request);
  raw.layers[0].own_crs = request.crs;  // of the file
  request.crs_given = false;
  request.crs.clear();
  declare_heights(raw);
  declare_plan_units(raw);
  declare_place(raw);
  EXPECT_EQ(raw.frame, "");
  EXPECT_NEAR(raw.layers[0].lines.points[0].x(), 304.8, 1e-9);
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
