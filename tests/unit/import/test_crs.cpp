// Coordinate systems: metres, degrees, feet, systems of heights.
#include <gtest/gtest.h>

#include "base/error.hpp"
#include "import/crs_operation_gdal.hpp"
#include "import/crs_place_gdal.hpp"
#include "io/crs_gdal.hpp"

namespace {

using talus::crs_from_user;
using talus::find_crs_problem;
using talus::Vec2;
using talus::Vec3;

bool reproject(const std::string& from, const std::string& to, std::vector<Vec3>& points) {
  return carry_out(find_operation(from, to, talus::window_of(points, from), {}), points);
}

TEST(Crs, ProjectedMetresAreFit) {
  for (const char* crs : {"EPSG:31287", "EPSG:27700", "EPSG:2193", "EPSG:32632", "EPSG:5972",
                          "+proj=utm +zone=32 +datum=WGS84"})
    EXPECT_EQ(find_crs_problem(crs_from_user(crs, "--crs"), {500000, 5200000}).finding, "") << crs;
}

TEST(Crs, DegreesAndFeetAreNot) {
  const auto problem = [](const char* crs, double x, double y) {
    return find_crs_problem(crs_from_user(crs, "--crs"), {x, y});
  };
  const auto says = [](const talus::CrsProblem& found, const char* words) {
    return found.finding.find(words) != std::string::npos;
  };
  EXPECT_TRUE(says(problem("EPSG:4326", 11.3, 47), "in degrees"));
  EXPECT_TRUE(says(problem("EPSG:4979", 11.3, 47), "in degrees"));
  EXPECT_TRUE(says(problem("EPSG:4978", 4e6, 1e6), "centre of the Earth"));
  EXPECT_TRUE(says(problem("EPSG:2225", 6e6, 2.1e6), "US survey foot"));
  EXPECT_TRUE(says(problem("EPSG:32632+6360", 5e5, 5e6), "heights in US survey foot"));
  EXPECT_TRUE(says(find_crs_problem("", {0, 0}), "there is no CRS"));
}

// One rule for all that is read: the system of heights says the unit, a plan in feet does not.
TEST(Crs, TheUnitOfHeightsIsThatOfTheirSystem) {
  const auto unit = [](const char* crs) {
    return talus::height_unit_m(crs_from_user(crs, "--crs"));
  };
  constexpr double us_foot = 1200.0 / 3937;
  for (const char* crs : {"EPSG:26912", "EPSG:4326", "none", "EPSG:3566+5703", "EPSG:26912+5703"})
    EXPECT_EQ(unit(crs), 1) << crs;
  EXPECT_NEAR(*unit("EPSG:26912+6360"), us_foot, 1e-12);
  EXPECT_NEAR(*unit("EPSG:4269+6360"), us_foot, 1e-12);
  EXPECT_NEAR(*unit("EPSG:3566+8228"), 0.3048, 1e-12) << "plan in US survey feet, heights in feet";
  for (const char* crs : {"EPSG:3566", "EPSG:2994", "+proj=utm +zone=12 +datum=NAD83 +units=ft"})
    EXPECT_FALSE(unit(crs)) << crs;
}

// A GeoPackage calls the reference of a layer without one "undefined".
TEST(Crs, AnUndefinedReferenceIsNone) {
  EXPECT_EQ(
      crs_from_user("GEOGCRS[\"Undefined geographic SRS\",DATUM[\"unknown\",ELLIPSOID["
                    "\"unknown\",6378137,298.257223563]],CS[ellipsoidal,2],AXIS[\"latitude\","
                    "north],AXIS[\"longitude\",east],ANGLEUNIT[\"degree\",0.0174532925199433]]",
                    "--crs"),
      "");
  EXPECT_EQ(crs_from_user("LOCAL_CS[\"Undefined Cartesian SRS\"]", "--crs"), "");
}

TEST(Crs, MetresAreBeyondDegrees) {
  const std::string degrees = crs_from_user("EPSG:4326", "--crs");
  EXPECT_FALSE(talus::is_beyond_degrees(degrees, {{11, 47, 0}, {360, -90, 3000}}));
  EXPECT_TRUE(talus::is_beyond_degrees(degrees, {{11, 47, 0}, {11, 91, 0}}));
  EXPECT_TRUE(talus::is_beyond_degrees(degrees, {{500000, 47, 0}}));
  EXPECT_FALSE(talus::is_beyond_degrees(crs_from_user("EPSG:32632", "--crs"), {{500000, 5e6, 0}}));
  EXPECT_FALSE(talus::is_beyond_degrees("", {{500000, 5e6, 0}}));
}

// The zone of the place, north and south, is the remedy; longitude comes first.
TEST(Crs, TheUtmZoneOfThePlaceIsOffered) {
  const std::string degrees = crs_from_user("EPSG:4326", "--crs");
  EXPECT_EQ(find_crs_problem(degrees, {11.3, 47}).mend_to, "EPSG:32632");
  EXPECT_EQ(find_crs_problem(degrees, {174.76, -36.88}).mend_to, "EPSG:32760");
  EXPECT_EQ(find_crs_problem(degrees, {180, -10}).mend_to, "EPSG:32760");
  EXPECT_EQ(find_crs_problem(degrees, {-122.2, 46.2}).mend_to, "EPSG:32610");
  EXPECT_EQ(find_crs_problem(degrees, {11, 89}).mend_to, "");
  EXPECT_EQ(find_crs_problem(crs_from_user("EPSG:2225", "--crs"), {6e6, 2.1e6}).mend_to,
            "EPSG:26910");
}

TEST(Crs, SameSystemsAreRecognisedHoweverTheyAreWritten) {
  const std::string utm = crs_from_user("EPSG:32632", "--crs");
  EXPECT_TRUE(talus::same_crs(utm, utm));
  EXPECT_TRUE(talus::same_crs(utm, crs_from_user("urn:ogc:def:crs:EPSG::32632", "--crs")));
  EXPECT_FALSE(talus::same_crs(utm, crs_from_user("EPSG:32633", "--crs")));
  EXPECT_FALSE(talus::same_crs(utm, ""));
  EXPECT_TRUE(talus::same_crs("", ""));
  EXPECT_EQ(talus::crs_name(utm), "EPSG:32632 (WGS 84 / UTM zone 32N)");
  const std::string nameless = crs_from_user("+proj=utm +zone=10 +datum=NAD27", "--crs");
  EXPECT_EQ(talus::crs_name(nameless), "a CRS without a name");
}

// UTM alone and UTM with EGM96 heights are one system in plan.
TEST(Crs, SystemsAreComparedInPlan) {
  const std::string utm = crs_from_user("EPSG:25832", "--crs");
  const std::string egm96 = crs_from_user("EPSG:25832+5773", "--crs");
  const std::string dhhn = crs_from_user("EPSG:25832+7837", "--crs");
  EXPECT_TRUE(talus::same_crs(utm, egm96));
  EXPECT_TRUE(talus::same_crs(egm96, dhhn));
  EXPECT_TRUE(talus::same_crs(crs_from_user("EPSG:5972", "--crs"), utm));  // with NN2000 heights
  EXPECT_TRUE(
      talus::same_crs(crs_from_user("EPSG:4979", "--crs"), crs_from_user("EPSG:4326", "--crs")));
  EXPECT_FALSE(talus::same_crs(egm96, crs_from_user("EPSG:25833+5773", "--crs")));
  EXPECT_EQ(talus::crs_code(egm96), "EPSG:25832");
  EXPECT_EQ(talus::height_crs(utm), "");
  EXPECT_EQ(talus::crs_name(talus::height_crs(egm96)), "EPSG:5773 (EGM96 height)");
  EXPECT_TRUE(talus::same_heights(utm, egm96));  // one of them does not say
  EXPECT_TRUE(talus::same_heights(egm96, crs_from_user("EPSG:25833+5773", "--crs")));
  EXPECT_FALSE(talus::same_heights(egm96, dhhn));
}

// Data reprojected in plan keep their heights, and the system that these are in.
TEST(Crs, HeightsAreCarriedOn) {
  const std::string utm33 = crs_from_user("EPSG:25833", "--t-srs");
  const std::string egm96 = crs_from_user("EPSG:25832+5773", "--crs");
  const std::string carried = talus::with_heights_of(egm96, utm33, {});
  EXPECT_TRUE(talus::same_crs(carried, utm33));
  EXPECT_EQ(talus::crs_name(talus::height_crs(carried)), "EPSG:5773 (EGM96 height)");
  EXPECT_EQ(talus::with_heights_of(utm33, utm33, {}), utm33);
  const std::string dhhn = crs_from_user("EPSG:25833+7837", "--t-srs");
  EXPECT_THROW(static_cast<void>(talus::with_heights_of(egm96, dhhn, {})), talus::InputError);
  EXPECT_THROW(static_cast<void>(talus::with_heights_of(utm33, dhhn, {})), talus::InputError);
  std::vector<Vec3> points = {{650'000, 5'200'000, 1234}};
  ASSERT_TRUE(reproject(egm96, utm33, points));
  EXPECT_EQ(points[0].z(), 1234);
}

TEST(Crs, FeetOfHeightsAreNotMendedByReprojection) {
  const talus::CrsProblem problem =
      find_crs_problem(crs_from_user("EPSG:32632+6360", "--crs"), {5e5, 5e6});
  EXPECT_NEAR(problem.height_unit_m, 0.3048006096, 1e-10);
  EXPECT_EQ(problem.mend_to, "");
  EXPECT_EQ(find_crs_problem(crs_from_user("EPSG:4326", "--crs"), {11, 47}).height_unit_m, 1);
}

TEST(Crs, WhatIsNoCrsIsRefused) {
  EXPECT_EQ(crs_from_user("none", "--crs"), "");
  for (const char* words : {"", "EPSG:nonsense", "somewhere", "EPSG:99999999"})
    EXPECT_THROW(static_cast<void>(crs_from_user(words, "--crs")), talus::InputError) << words;
}

TEST(Crs, ReprojectionTakesLongitudeFirst) {
  std::vector<Vec3> points = {{9, 0, 5}, {9, 47, 7}};
  ASSERT_TRUE(
      reproject(crs_from_user("EPSG:4326", "--crs"), crs_from_user("EPSG:32632", "--crs"), points));
  EXPECT_NEAR(points[0].x(), 500'000, 1e-6);
  EXPECT_NEAR(points[0].y(), 0, 1e-6);
  EXPECT_NEAR(points[1].y(), 5'205'264, 300);  // 47 degrees along a meridian, times 0.9996
  EXPECT_EQ(points[1].z(), 7);
}

}  // namespace
