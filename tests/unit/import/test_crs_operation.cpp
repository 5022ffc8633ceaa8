// Coordinate operations: the best one, grids, datums, heights.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "import/crs_operation_gdal.hpp"
#include "io/crs_gdal.hpp"

namespace {

using talus::crs_from_user;
using talus::CrsOperation;
using talus::find_operation;
using talus::InputError;
using talus::MapWindow;
using talus::Vec3;

std::string wkt(const std::string& crs) { return crs_from_user(crs, "--crs"); }

constexpr MapWindow tyrol{80000, 236000, 80200, 236200};  // EPSG:31254

const char* const bessel_alone =
    "+proj=tmerc +lat_0=0 +lon_0=10.3333333333333 +k=1 +x_0=0 +y_0=-5000000 +ellps=bessel +units=m";

struct Refusal {
  std::string finding, hint;
};

Refusal refusal_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const InputError& error) {
    return {error.what(), error.hint()};
  }
  return {};
}

// The same bits each time, and the coordinates that other programs of PROJ give for "MGI to ETRS89
// (1)": the grid of the agency would give 0.14 m.
TEST(CrsOperation, TheBestOperationThatIsHereIsTakenAndABetterOneNamed) {
  const CrsOperation operation = find_operation(wkt("EPSG:31254"), wkt("EPSG:25832"), tyrol, {});
  EXPECT_FALSE(operation.is_ballpark);
  if (operation.better_grid.empty()) {
    EXPECT_LT(operation.accuracy_m, 1);  // the grid is installed
  } else {
    EXPECT_NE(operation.name.find("MGI to ETRS89 (1)"), std::string::npos) << operation.name;
    EXPECT_EQ(operation.accuracy_m, 1.5);
    EXPECT_NE(talus::doubt_on(operation).find("projsync --file " + operation.better_grid),
              std::string::npos);
  }
  EXPECT_NE(talus::sentence_on(operation).find(operation.name), std::string::npos);
  std::vector<Vec3> points = {{80000, 236000, 1234}}, again = points;
  ASSERT_TRUE(talus::carry_out(operation, points));
  ASSERT_TRUE(talus::carry_out(operation, again));
  EXPECT_EQ(points[0], again[0]);
  EXPECT_EQ(points[0].z(), 1234);
  EXPECT_NEAR(points[0].x(), 680818.59, 2);
  EXPECT_NEAR(points[0].y(), 5236606.24, 2);
}

TEST(CrsOperation, WithinOneDatumNothingIsLost) {
  const CrsOperation operation =
      find_operation(wkt("EPSG:25833"), wkt("EPSG:25832"), {200000, 5200000, 200200, 5200200}, {});
  EXPECT_EQ(operation.accuracy_m, 0);
  EXPECT_EQ(talus::doubt_on(operation), "");
  std::vector<Vec3> there = {{200000, 5200000, 5}};
  ASSERT_TRUE(talus::carry_out(operation, there));
  const CrsOperation back =
      find_operation(wkt("EPSG:25832"), wkt("EPSG:25833"), {6e5, 5.19e6, 7e5, 5.21e6}, {});
  ASSERT_TRUE(talus::carry_out(back, there));
  EXPECT_NEAR(there[0].x(), 200000, 1e-6);
  EXPECT_NEAR(there[0].y(), 5200000, 1e-6);
}

TEST(CrsOperation, ADatumThatIsNotKnownIsNeverGuessed) {
  const std::string from = wkt(bessel_alone), to = wkt("EPSG:25832");
  const Refusal refusal =
      refusal_of([&] { static_cast<void>(find_operation(from, to, tyrol, {"map.gpkg"})); });
  EXPECT_NE(refusal.finding.find("PROJ knows no shift of the datum"), std::string::npos);
  EXPECT_NE(refusal.hint.find("--crs EPSG:code"), std::string::npos);
  const CrsOperation accepted = find_operation(from, to, tyrol, {}, true);
  EXPECT_TRUE(accepted.is_ballpark);
  EXPECT_NE(talus::doubt_on(accepted).find("off by a hundred metres"), std::string::npos);
  EXPECT_TRUE(talus::has_unknown_datum(from));
  EXPECT_FALSE(talus::has_unknown_datum(to));
  EXPECT_FALSE(talus::has_unknown_datum(wkt(std::string(bessel_alone) + " +towgs84=577,90,463")));
}

// NAD27 to NAD83 has operations with grids alone; Debian installs none of them.
TEST(CrsOperation, AMissingGridIsNamed) {
  const MapWindow nevada{-119.6, 40.2, -119.5, 40.3};
  const Refusal refusal = refusal_of([&] {
    static_cast<void>(find_operation(wkt("EPSG:4267"), wkt("EPSG:26911"), nevada, {"old.shp"}));
  });
  if (refusal.finding.empty()) GTEST_SKIP() << "the grids of NOAA are installed";
  EXPECT_NE(refusal.finding.find("needs the grid us_noaa_"), std::string::npos) << refusal.finding;
  EXPECT_NE(refusal.hint.find("projsync --file us_noaa_"), std::string::npos);
  EXPECT_NE(refusal.hint.find("--accept-ballpark"), std::string::npos);
}

constexpr MapWindow utm{650000, 5200000, 650200, 5200200};

// The undulation of EGM96 is 49.7 m there.
TEST(CrsOperation, HeightsAboveTheEllipsoidBecomeHeightsAboveTheGeoid) {
  const talus::HeightOperation operation(wkt("EPSG:25832"), talus::ellipsoidal_heights,
                                         wkt("EPSG:5773"), utm, {});
  std::vector<Vec3> points = {{650000, 5200000, 1000}};
  operation.apply(points);
  EXPECT_NEAR(points[0].z(), 1000 - 49.69, 0.02);
  EXPECT_EQ(points[0].x(), 650000);
  EXPECT_NE(operation.sentence().find("EGM96"), std::string::npos);
  double unknown = NAN;
  operation.apply(1, &points[0].x(), &points[0].y(), &unknown);
  EXPECT_TRUE(std::isnan(unknown));
}

TEST(CrsOperation, HeightsAreNotTakenOverWithoutTheirModel) {
  const auto take = [](const char* from, const char* to) {
    return refusal_of([&] {
      const talus::HeightOperation operation(wkt("EPSG:25832"), wkt(from), wkt(to), utm,
                                             {"dem.tif"});
    });
  };
  const Refusal egm2008 = take("EPSG:5773", "EPSG:3855");
  if (!egm2008.finding.empty()) {
    EXPECT_NE(egm2008.finding.find("needs the grid"), std::string::npos) << egm2008.finding;
    EXPECT_NE(egm2008.hint.find("projsync --file"), std::string::npos);
  }
  // heights of America are not known in the Alps
  EXPECT_NE(take("EPSG:5773", "EPSG:5703").finding, "");
}

TEST(CrsOperation, OnlySystemsOfHeightsAreTakenForSuch) {
  EXPECT_EQ(talus::vertical_crs_from_user("ellipsoidal", "--vertical-crs"),
            talus::ellipsoidal_heights);
  EXPECT_NE(talus::vertical_crs_from_user("EPSG:5773", "--vertical-crs"), "");
  for (const char* words : {"EPSG:25832", "EPSG:25832+5773", "none", "EPSG:6360", "heights"})
    EXPECT_THROW(static_cast<void>(talus::vertical_crs_from_user(words, "--vertical-crs")),
                 InputError)
        << words;
  EXPECT_THROW(static_cast<void>(talus::target_heights_from_user("ellipsoidal", "--t-vertical")),
               InputError);
}

TEST(CrsOperation, StatedHeightsMustNotContradictTheFile) {
  const std::string egm96 = wkt("EPSG:5773"), utm_alone = wkt("EPSG:25832");
  const std::string both = talus::with_stated_heights(utm_alone, egm96, {});
  EXPECT_TRUE(talus::same_system(talus::stated_heights(both, {}), egm96));
  EXPECT_EQ(talus::with_stated_heights(both, egm96, {}), both);
  EXPECT_THROW(static_cast<void>(talus::with_stated_heights(both, wkt("EPSG:7837"), {})),
               InputError);
  EXPECT_THROW(static_cast<void>(talus::with_stated_heights("", egm96, {})), InputError);
  EXPECT_THROW(static_cast<void>(talus::stated_heights(utm_alone, {})), InputError);
  EXPECT_EQ(talus::stated_heights(wkt("EPSG:4979"), {}), talus::ellipsoidal_heights);
}

}  // namespace
