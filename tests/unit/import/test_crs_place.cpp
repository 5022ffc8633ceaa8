// Coordinates that cannot be in their system, and the hints about them.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "import/crs_place_gdal.hpp"
#include "io/crs_gdal.hpp"

namespace {

using talus::check_place;
using talus::crs_from_user;
using talus::CrsExtent;
using talus::InputError;
using talus::MapWindow;
using talus::Vec2;

std::string wkt(const std::string& crs) { return crs_from_user(crs, "--crs"); }

// A window of 200 m from a corner on.
MapWindow window_at(double x, double y) { return {x, y, x + 200, y + 200}; }

struct Outcome {
  std::string refusal, hint;
  std::vector<talus::Doubt> doubts;

  [[nodiscard]] bool says(const char* words) const {
    return refusal.find(words) != std::string::npos;
  }
};

Outcome outcome_of(const CrsExtent& place) {
  Outcome outcome;
  try {
    check_place(place, {"map.gpkg"}, outcome.doubts);
  } catch (const InputError& error) {
    outcome.refusal = error.what();
    outcome.hint = error.hint();
  }
  return outcome;
}

Outcome outcome_at(const char* crs, double x, double y, const char* work = "") {
  CrsExtent place{wkt(crs), window_at(x, y), std::string(work).empty() ? "" : wkt(work)};
  place.has_crs_option = place.has_unit_option = true;
  place.layer = "map";
  return outcome_of(place);
}

// Systems and places of five continents, read from maps of the agencies.
TEST(CrsPlace, MapsWhereTheyBelongAreTakenWithoutAWord) {
  struct Case {
    const char* crs;
    double x, y;
  };
  for (const Case& c :
       {Case{"EPSG:25832", 650000, 5200000}, Case{"EPSG:32632", 650000, 5200000},
        Case{"EPSG:31287", 248400, 351100}, Case{"EPSG:31254", 80000, 236000},
        Case{"EPSG:2056", 2600000, 1200000}, Case{"EPSG:27700", 327000, 672000},
        Case{"EPSG:2193", 1757000, 5917000}, Case{"EPSG:32718", 300000, 8500000},
        Case{"EPSG:5514", -450000, -1200000}, Case{"EPSG:4647", 32650000, 5300000},
        Case{"EPSG:31467", 3550000, 5300000}, Case{"EPSG:3035", 4321000, 3210000}}) {
    const Outcome outcome = outcome_at(c.crs, c.x, c.y);
    EXPECT_EQ(outcome.refusal, "") << c.crs;
    EXPECT_TRUE(outcome.doubts.empty()) << c.crs << ": " << sentence_on(outcome.doubts.front());
  }
}

// The scale at the place of work counts, not the name of the projection.
TEST(CrsPlace, StretchedMetresAreRefused) {
  struct Case {
    const char* crs;
    double x, y;
  };
  for (const Case& c :
       {Case{"EPSG:3857", 1.2e6, 5.9e6}, Case{"ESRI:102100", 1.2e6, 5.9e6},
        Case{"EPSG:3395", 1.2e6, 5.9e6}, Case{"EPSG:32662", 1224514, 5225000},
        Case{"EPSG:6933", 1060000, 5360000}, Case{"+proj=merc +lat_ts=30 +ellps=GRS80", 1.1e6, 5e6},
        Case{"+proj=eqc +lat_ts=0 +ellps=GRS80", 1.2e6, 5.2e6}}) {
    const Outcome outcome = outcome_at(c.crs, c.x, c.y);
    EXPECT_TRUE(outcome.says("whose metres are stretched here")) << c.crs << outcome.refusal;
    EXPECT_NE(outcome.hint.find("--t-srs EPSG:32632"), std::string::npos) << outcome.hint;
  }
  EXPECT_TRUE(outcome_at("EPSG:3857", 1.2e6, 5.9e6).says("1.4")) << "1 / cos(46.8 degrees) = 1.46";
  // Mercator with the scale of its place, and near the equator
  EXPECT_EQ(outcome_at("+proj=merc +lat_ts=47 +ellps=GRS80", 8.2e5, 4.06e6).refusal, "");
  EXPECT_EQ(outcome_at("EPSG:3395", -8.7e6, -2e5).refusal, "");
}

// A zone on another datum would need a shift that PROJ may not know.
TEST(CrsPlace, AZoneIsProposedOnTheDatumOfTheMap) {
  const auto zone = [](const char* crs, double longitude, double latitude) {
    return talus::utm_zone(wkt(crs), {longitude, latitude});
  };
  EXPECT_EQ(zone("EPSG:4326", 11, 47), "EPSG:32632");
  EXPECT_EQ(zone("EPSG:4258", 11, 47), "EPSG:25832");
  EXPECT_EQ(zone("EPSG:3035", 11, 47), "EPSG:25832");
  EXPECT_EQ(zone("EPSG:2232", -105, 39), "EPSG:26913");
  EXPECT_EQ(zone("EPSG:6428", -105, 39), "EPSG:6342");
  EXPECT_EQ(zone("EPSG:7844", 150, -33), "EPSG:7856");
  EXPECT_EQ(zone("EPSG:4258", -70, 47), "EPSG:32619") << "ETRS89 has no zone there";
  EXPECT_EQ(zone("EPSG:31287", 13, 47), "EPSG:32633");
}

TEST(CrsPlace, AxesThatDoNotRunEastAndNorthAreRefused) {
  EXPECT_TRUE(outcome_at("EPSG:2053", 20000, 2900000).says("x runs to"));   // west and south
  EXPECT_TRUE(outcome_at("EPSG:5513", 1100000, 500000).says("x runs to"));  // south and west
  EXPECT_TRUE(outcome_at("EPSG:3031", 1e6, -1.5e6).says("x runs to"));
  EXPECT_TRUE(outcome_at("+proj=utm +zone=32 +south +ellps=GRS80 +axis=wsu", -650000, -5200000)
                  .says("x runs"));
  // they are turned where the work is done in another system
  EXPECT_EQ(outcome_at("EPSG:5513", 1100000, 500000, "EPSG:32633").refusal, "");
}

TEST(CrsPlace, ExchangedCoordinatesAreNamed) {
  const Outcome outcome = outcome_at("EPSG:25832", 5200000, 650000);
  EXPECT_TRUE(outcome.says("with x and y exchanged they would lie in it")) << outcome.refusal;
  EXPECT_NE(outcome.hint.find("SwapCoords(geometry)"), std::string::npos) << outcome.hint;
  // latitude first, to be reprojected
  CrsExtent place{wkt("EPSG:4326"), {46.9, 11.0, 46.91, 11.01}, wkt("EPSG:25832")};
  EXPECT_TRUE(outcome_of(place).says("with x and y exchanged they would lie in it"));
}

TEST(CrsPlace, DegreesUnderACrsInMetresAreNamed) {
  for (const char* crs :
       {"EPSG:25832", "EPSG:27700"}) {  // 0, 0 lies inside of the area of the latter
    const bool is_british = std::string(crs) == "EPSG:27700";
    CrsExtent place{wkt(crs),
                    is_british ? MapWindow{-3.2, 55.9, -3.1, 56} : MapWindow{11, 47, 11.1, 47.1}};
    place.has_crs_option = true;
    const Outcome outcome = outcome_of(place);
    EXPECT_TRUE(outcome.says("they look like degrees")) << outcome.refusal;
    EXPECT_EQ(outcome.hint, "--crs EPSG:4326 --t-srs " + std::string(crs));
  }
  const Outcome latitude_first = outcome_of({wkt("EPSG:25832"), MapWindow{47, 11, 47.1, 11.1}});
  EXPECT_TRUE(latitude_first.says("the latitude first")) << latitude_first.refusal;
}

TEST(CrsPlace, ZoneNumbersBeforeEastingsAreNamed) {
  const Outcome with = outcome_at("EPSG:25832", 32650000, 5200000);
  EXPECT_TRUE(with.says("begin with the zone number 32")) << with.refusal;
  EXPECT_EQ(with.hint, "--crs EPSG:4647 --t-srs EPSG:25832");
  EXPECT_TRUE(outcome_at("EPSG:32633", 33400000, 5200000).says("begin with the zone number 33"));
  // also those of Gauss and Krueger, 3 and 6 degrees wide, where the CRS has none: 1954 in China
  EXPECT_TRUE(outcome_at("EPSG:2434", 37400000, 3500000).says("begin with the zone number 37"));
  EXPECT_TRUE(outcome_at("EPSG:21459", 19400000, 3500000).says("begin with the zone number 19"));
}

// Another number, or the lack of one, means another projection: the hint asks for it, and no
// command shifts anything.
TEST(CrsPlace, NumbersOfOtherZonesAreNoReasonToShift) {
  struct Case {
    const char* crs;
    double x, y;
    const char* words;
  };
  for (const Case& c :
       {Case{"EPSG:25832", 3550000, 5300000, "as eastings of zone 3 of Gauss and Krueger"},
        Case{"EPSG:32632", 2550000, 5300000, "as eastings of zone 2 of Gauss and Krueger"},
        Case{"EPSG:3765", 5560000, 5000000, "as eastings of zone 5 of Gauss and Krueger"},
        Case{"EPSG:32632", 1600000, 5000000, "lie outside the area"},     // Gauss-Boaga, west
        Case{"EPSG:32650", 39400000, 3500000, "as eastings of zone 39"},  // 3 degrees, in China
        Case{"EPSG:31467", 550000, 5300000, "the eastings lack the zone number 3"}}) {
    const Outcome outcome = outcome_at(c.crs, c.x, c.y);
    EXPECT_TRUE(outcome.says(c.words)) << c.crs << ": " << outcome.refusal;
    EXPECT_EQ(outcome.hint,
              "is it the CRS of these coordinates? name the right one with --crs EPSG:code")
        << c.crs << ": " << outcome.refusal;
  }
}

TEST(CrsPlace, FeetAndMillimetresAreNamed) {
  const Outcome feet = outcome_at("EPSG:25832", 650000 / 0.3048, 5200000 / 0.3048);
  EXPECT_TRUE(feet.says("as feet they would lie in it")) << feet.refusal;
  EXPECT_EQ(feet.hint, "--unit-m 0.3048 scales plan and heights");
  EXPECT_TRUE(outcome_at("EPSG:31254", 80000e3, 236000e3).says("as millimetres"));
  // feet of two lengths in America: its systems in feet are meant, not a scale
  const Outcome american = outcome_at("EPSG:26943", 2000000 / 0.3048, 600000 / 0.3048);
  EXPECT_TRUE(american.says("as feet they would lie in it")) << american.refusal;
  EXPECT_NE(american.hint.find("--crs EPSG:code"), std::string::npos) << american.hint;
  // metres of another system lie in a zone from equator to pole whatever they are multiplied by
  EXPECT_FALSE(outcome_at("EPSG:32632", 1600000, 5000000).says("as feet"));
}

TEST(CrsPlace, OtherSignsAreNamed) {
  EXPECT_TRUE(outcome_at("EPSG:5514", 500000, 1100000).says("with the other signs"));
  EXPECT_TRUE(
      outcome_at("EPSG:5514", 1100000, 500000).says("x and y exchanged, and the other signs"));
}

// A zone is used beyond its border; a map of another country is not.
TEST(CrsPlace, BesideTheAreaIsWarnedOfAndFarFromItRefused) {
  const Outcome beside = outcome_at("EPSG:25832", 820000, 5200000);  // 13.2 degrees east
  EXPECT_EQ(beside.refusal, "");
  ASSERT_EQ(beside.doubts.size(), 1u);
  EXPECT_NE(beside.doubts[0].found.find("lie outside the area"), std::string::npos);
  EXPECT_TRUE(outcome_at("EPSG:31287", 650000, 5200000).says("lie outside the area"));
  EXPECT_TRUE(outcome_at("EPSG:2056", 650000, 5200000).says("lie outside the area"));
  EXPECT_TRUE(outcome_at("EPSG:4326", 11, 47, "EPSG:2193").says("lie outside the area"));
}

// A country may be in one zone altogether, as Norway is: the scale is judged there.
TEST(CrsPlace, AWideExtentInOneZoneIsWarnedOf) {
  const Outcome bergen = outcome_at("EPSG:25833", -31540, 6735100);  // 6.7 degrees beside
  EXPECT_EQ(bergen.refusal, "");
  EXPECT_EQ(bergen.doubts.size(), 2u) << "beside the area, and north askew by 8 degrees";
  EXPECT_EQ(outcome_at("EPSG:32719", -250000, 6000000).refusal, "");  // 8 degrees beside, in Chile
  EXPECT_TRUE(outcome_at("EPSG:25833", -600000, 6735100).says("lie outside the area"));  // 1.5 %
  EXPECT_TRUE(outcome_at("EPSG:32633", 500000, -1500000).says("lie outside the area"));
  // a cone keeps its scale all around the Earth: the area decides
  EXPECT_TRUE(outcome_at("EPSG:26943", 3000000, 600000).says("lie outside the area"));
}

// Northings of a zone continue beyond the equator, as satellite images have them.
TEST(CrsPlace, TheOtherHemisphereOfAZoneIsReprojected) {
  for (const char* crs : {"EPSG:32619", "EPSG:31973"}) {  // WGS 84, SIRGAS 2000
    const Outcome named = outcome_at(crs, 350000, -1650000);
    EXPECT_TRUE(named.says("they lie in its zone on the other side of the equator")) << crs;
    EXPECT_EQ(named.hint, "--t-srs EPSG:32719 reprojects");
    const Outcome taken = outcome_at(crs, 350000, -1650000, "EPSG:32719");
    EXPECT_EQ(taken.refusal, "") << crs;
    EXPECT_TRUE(taken.doubts.empty()) << crs;
  }
  EXPECT_EQ(outcome_at("EPSG:32733", 400000, 11500000).hint, "--t-srs EPSG:32633 reprojects");
}

TEST(CrsPlace, LongitudesCountModulo360) {
  const std::vector<talus::Vec3> fiji = {
      {179.9996, -16.799, 0}, {180, -16.798, 0}, {-180, -16.799, 0}, {-179.9995, -16.798, 0}};
  const MapWindow window = talus::window_of(fiji, wkt("EPSG:4326"));
  EXPECT_NEAR(window.x_min, 179.9996, 1e-9);
  EXPECT_NEAR(window.x_max, 180.0005, 1e-9);
  EXPECT_EQ(outcome_of({wkt("EPSG:4326"), window, wkt("EPSG:3460")}).refusal, "");
  EXPECT_EQ(talus::window_of(fiji, wkt("EPSG:3460")).x_min, -180) << "metres do not turn";
  // in grads, 200 of which are 180 degrees
  const std::vector<talus::Vec3> grads = {{199.9, 50, 0}, {-199.9, 50, 0}};
  EXPECT_NEAR(talus::window_of(grads, wkt("EPSG:4901")).x_max, 200.1, 1e-9);
}

TEST(CrsPlace, NorthOfTheMapFarOffNorthIsWarnedOf) {
  const Outcome outcome =
      outcome_at("EPSG:3035", 5500000, 4500000);  // 21 degrees east of its middle
  EXPECT_EQ(outcome.refusal, "");
  ASSERT_EQ(outcome.doubts.size(), 1u);
  EXPECT_NE(outcome.doubts[0].found.find("degrees east of north"), std::string::npos);
  const std::size_t at = outcome.doubts[0].found.find("convergence_deg = ");
  ASSERT_NE(at, std::string::npos);
  EXPECT_GT(std::stod(outcome.doubts[0].found.substr(at + 18)), 10);
}

TEST(CrsPlace, LocalMetresHaveNoPlace) {
  EXPECT_EQ(outcome_of({"", window_at(0, 0)}).refusal, "");
  EXPECT_EQ(outcome_of({"", window_at(1e9, 1e9)}).refusal, "");
}

// A CRS that a file names is replaced only where it cannot be true.
TEST(CrsPlace, ACrsIsReplacedForAReasonOnly) {
  const MapWindow here = window_at(80000, 236000);
  const std::string bessel =
      wkt("+proj=tmerc +lat_0=0 +lon_0=10.3333333333333 +k=1 +x_0=0 +y_0=-5000000 +ellps=bessel "
          "+units=m");
  EXPECT_EQ(talus::reason_to_replace(bessel, wkt("EPSG:31254"), here), "whose datum is not known");
  EXPECT_EQ(talus::reason_to_replace(bessel, wkt("EPSG:31255"), here), "");  // another meridian
  EXPECT_EQ(talus::reason_to_replace(wkt("EPSG:31254"), wkt("EPSG:25832"), here), "");
  EXPECT_EQ(talus::reason_to_replace(wkt("EPSG:3857"), wkt("EPSG:25832"), window_at(1.2e6, 5.9e6)),
            "");  // stretched, but there
  EXPECT_EQ(
      talus::reason_to_replace(wkt("EPSG:25832"), wkt("EPSG:4647"), window_at(32650000, 5.2e6)),
      "where its coordinates cannot be");
}

TEST(CrsPlace, DegreesCountFromGreenwich) {
  const auto place =
      talus::degrees_at(wkt("EPSG:27572"), {600000, 2200000});  // from Paris, in grads
  ASSERT_TRUE(place.has_value());
  EXPECT_NEAR(place->x(), 2.3372, 1e-3);
  EXPECT_NEAR(place->y(), 46.8, 1e-6);
}

}  // namespace
