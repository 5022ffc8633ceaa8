#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "base/error.hpp"
#include "base/sha256.hpp"
#include "io/block_pictures.hpp"
#include "io/crs_gdal.hpp"
#include "io/footprints_gdal.hpp"
#include "io/vectors_gdal.hpp"

namespace {

using namespace talus;

std::string scratch(const std::string& name, const std::string& text) {
  const std::string path =
      (std::filesystem::temp_directory_path() / ("talus_vectors_" + name)).string();
  std::filesystem::remove(path);
  if (!text.empty()) std::ofstream(path) << text;
  return path;
}

std::string geojson(const std::string& geometry, const std::string& crs = "EPSG::32633") {
  return R"({"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:)" +
         crs + R"("}},"features":[{"type":"Feature","properties":{"kind":"a"},"geometry":)" +
         geometry + "}]}";
}

std::string refusal(const VectorQuery& query) {
  try {
    static_cast<void>(read_vectors(query, ""));
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace

TEST(ReadVectors, RingsComeWithoutTheirLastPoint) {
  const std::string path = scratch(
      "area.geojson",
      geojson(
          R"({"type":"Polygon","coordinates":[[[0,0],[9,0],[9,9],[0,0]],[[5,1],[6,1],[6,2],[5,1]]]})"));
  const VectorShapes found = read_vectors({path, "", "", VectorKind::areas}, "");
  ASSERT_EQ(found.shapes.size(), 2u);
  EXPECT_EQ(found.shapes[0].size(), 3u);
  EXPECT_TRUE(found.source_crs.empty());
}

TEST(ReadVectors, OtherCoordinateSystemsAreReprojected) {
  const std::string path =
      scratch("line.geojson",
              geojson(R"({"type":"LineString","coordinates":[[15,47],[15,48]]})", "OGC:1.3:CRS84"));
  const VectorShapes found =
      read_vectors({path, "", "", VectorKind::lines}, crs_from_user("EPSG:32633", "test"));
  EXPECT_FALSE(found.source_crs.empty());
  EXPECT_NEAR(found.shapes[0][0].x(), 500000, 1e-6);         // 15 E is the middle of zone 33
  EXPECT_NEAR(found.shapes[0][0].y(), 0.9996 * 5207247, 1);  // meridian arc to 47 N
}

// A GeoJSON without `crs` says degrees, whatever it holds.
TEST(ReadVectors, MetresThatAreCalledDegreesAreRefused) {
  const std::string path =
      scratch("metres.geojson",
              R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":{},)"
              R"("geometry":{"type":"Point","coordinates":[500000,5200000]}}]})");
  try {
    static_cast<void>(
        read_vectors({path, "", "", VectorKind::points}, crs_from_user("EPSG:32633", "test")));
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("the coordinates are no degrees"), std::string::npos);
    EXPECT_NE(error.hint().find("ogr2ogr -a_srs EPSG:code"), std::string::npos);
  }
}

TEST(ReadVectors, WhatIsNotThereIsNamed) {
  const std::string path = scratch("p.geojson", geojson(R"({"type":"Point","coordinates":[1,2]})"));
  EXPECT_NE(refusal({path, "roads", "", VectorKind::points}).find("there is no layer roads"),
            std::string::npos);
  EXPECT_NE(refusal({path, "", "", VectorKind::areas}).find("no layer of polygons"),
            std::string::npos);
  EXPECT_NE(refusal({path, "", "nonsense = ", VectorKind::points}).find("cannot be used"),
            std::string::npos);
  EXPECT_NE(refusal({path, "", "kind = 'b'", VectorKind::points}).find("holds no points"),
            std::string::npos);
  EXPECT_NE(
      refusal({scratch("broken.geojson", "{"), "", "", VectorKind::points}).find("cannot be read"),
      std::string::npos);
}

TEST(WriteFootprints, ReadBackAndTheSameBytesEveryTime) {
  BlockSet set;
  set.origin = Vec3(500000, 5200000, 100);
  set.crs_wkt = crs_from_user("EPSG:32633", "test");
  set.material_names = {"rock"};
  add_body(set, {{box({0, 0, 0}, {2, 3, 1}, -1)}, {}, 0, Vec3::Zero(), Vec3::Zero()});
  add_body(set, {{box({5, 0, 0}, {6, 1, 1}, -1)}, {}, 0, Vec3::Zero(), Vec3::Zero()});
  const std::string a = scratch("a.gpkg", ""), b = scratch("b.gpkg", "");
  write_footprints(a, set, {{{0, 0}, {1, 0}, {1, 1}}});
  write_footprints(b, set, {{{0, 0}, {1, 0}, {1, 1}}});
  EXPECT_EQ(sha256_of_file(a), sha256_of_file(b));
  const VectorShapes found =
      read_vectors({a, "blocks", "volume_m3 > 5", VectorKind::areas}, set.crs_wkt);
  ASSERT_EQ(found.shapes.size(), 1u);
  EXPECT_EQ(found.shapes[0].size(), 4u);
  EXPECT_TRUE(found.source_crs.empty());
}

TEST(VolumeQuantile, IsByVolumeNotByNumber) {
  EXPECT_EQ(volume_quantile({1, 1, 1, 1, 96}, 0.5), 96);
  EXPECT_EQ(volume_quantile({1, 1, 1, 1, 96}, 0.03), 1);
}

TEST(Pictures, NamesOfUsersAreEscaped) {
  const std::string svg = stereonet_svg({{"<J&1>", Vec3::UnitZ(), {Vec3::UnitZ()}}}, Vec3::Zero());
  EXPECT_EQ(svg.find("<J"), std::string::npos);
  EXPECT_NE(svg.find("&lt;J&amp;1&gt;"), std::string::npos);
  EXPECT_NE(size_curve_svg({1, 2, 50}).find("V50 = 50"), std::string::npos);
}
