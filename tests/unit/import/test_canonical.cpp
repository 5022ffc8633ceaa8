// The sealed file of imported data: reading back, changes, refusals.
#include <gdal_priv.h>

#include "import/canonical_gdal.hpp"
#include "import/import_inputs_gdal.hpp"
#include "sources.hpp"

namespace {

using namespace talus;
using namespace talus::test;

struct Canonical : ImportTest {
  std::string written() {
    ask(InputRole::contours,
        file("contours", 32632,
             {{"LineString", "[[650000,5200000,100],[650100,5200000,100]]", ""},
              {"LineString", "[[650000,5200050,110],[650100,5200050,110]]", ""},
              {"LineString", "[[650000,5200090,120],[650100,5200090,120]]", ""}}));
    ask(InputRole::spots, file("spots", 0, {{"Point", "[650010.1,5200020.3,104.7]", ""}}));
    ask(InputRole::boundary,
        file("ring", 32632,
             {{"Polygon", "[[[649990,5199990],[650110,5199990],[650110,5200060],[649990,5199990]]]",
               ""}}));
    const std::string path = (folder / "inputs.gpkg").string();
    request.is_measured = true;
    inputs = import_inputs(request, reading);
    write_canonical(path, request, inputs, reading);
    return path;
  }
  Imported inputs;
  const ContourMap& map = inputs.map;
  ImportReading reading;
};

TEST_F(Canonical, WhatIsWrittenIsReadBackToTheBit) {
  const std::optional<InputsRequest> again = canonical_request(written());
  ASSERT_TRUE(again.has_value());
  ImportReading read;
  const ContourMap back = import_map(*again, read);
  EXPECT_EQ(back.crs_wkt, map.crs_wkt);
  EXPECT_EQ(back.contours.points, map.contours.points);
  EXPECT_EQ(back.contours.feature, map.contours.feature);
  EXPECT_EQ(back.spots, map.spots);
  ASSERT_EQ(back.boundary.size(), 1U);
  EXPECT_EQ(back.boundary[0].points, map.boundary[0].points);
  EXPECT_TRUE(read.operations.empty());
  EXPECT_TRUE(read.doubts.empty());
}

// A program that only looks at a GeoPackage may change its bytes.
TEST_F(Canonical, ChangedCoordinatesAreRefusedAndOtherBytesAreNot) {
  const std::string path = written();
  const auto execute = [&path](const char* sql) {
    const GDALDatasetUniquePtr file(
        GDALDataset::Open(path.c_str(), GDAL_OF_VECTOR | GDAL_OF_UPDATE));
    file->ReleaseResultSet(file->ExecuteSQL(sql, nullptr, nullptr));
  };
  execute("CREATE TABLE looked_at (id INTEGER)");
  ImportReading read;
  EXPECT_EQ(map_digest(import_map(*canonical_request(path), read)), map_digest(map));
  execute("DELETE FROM contours WHERE fid = 3");
  EXPECT_NE(error_of([&] {
              static_cast<void>(import_map(*canonical_request(path), read));
            }).find("was changed since talus-import wrote it"),
            std::string::npos);
  EXPECT_FALSE(canonical_request(path + "|layername=contours").has_value());
  EXPECT_FALSE(canonical_request(request.layers[0].ref.path).has_value());
}

TEST_F(Canonical, EachLayerSaysWhatWasDecidedAndHowLargeItIs) {
  static_cast<void>(written());
  ASSERT_EQ(reading.layers.size(), 3U);
  const LayerReading& spots = reading.layers[1];
  const auto answer = [&spots](const std::string& question) {
    for (const Decision& decision : spots.decisions)
      if (decision.question == question) return decision.answer + ": " + decision.why;
    return std::string();
  };
  EXPECT_EQ(answer("heights"), "Z: Z tells heights apart");
  EXPECT_EQ(answer("system"),
            "EPSG:32632 (WGS 84 / UTM zone 32N): the coordinates are not in that of the file");
  EXPECT_EQ(answer("unit of heights"), "1 m: nothing says another one");
  EXPECT_EQ(answer("system of heights"), "not known: nothing says it");
  ASSERT_EQ(spots.magnitudes.size(), 3U);
  EXPECT_EQ(spots.magnitudes[2].quantity, "z_m");
  EXPECT_NEAR(spots.magnitudes[2].median, 104.7, 1e-9);
}

}  // namespace
