// Vectors: areas, rings, systems, unions, footprints.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "base/error.hpp"
#include "base/sha256.hpp"
#include "import/vectors_gdal.hpp"
#include "io/crs_gdal.hpp"
#include "io/footprints_gdal.hpp"
#include "io/polygons_gdal.hpp"

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

std::string rectangle(int x0, int y0, int x1, int y1) {
  const auto point = [](int x, int y) {
    return "[" + std::to_string(x) + "," + std::to_string(y) + "]";
  };
  return R"({"type":"Polygon","coordinates":[[)" + point(x0, y0) + "," + point(x1, y0) + "," +
         point(x1, y1) + "," + point(x0, y1) + "," + point(x0, y0) + "]]}";
}

std::string square(int x0, int y0, int side) { return rectangle(x0, y0, x0 + side, y0 + side); }

// A file of several features in local metres.
std::string features(const std::string& name, const std::vector<std::string>& geometries) {
  std::string text = R"({"type":"FeatureCollection","crs":{"type":"name","properties":{"name":)"
                     R"("urn:ogc:def:crs:EPSG::32633"}},"features":[)";
  for (const std::string& geometry : geometries)
    text += (text.back() == '[' ? "" : ",") +
            (R"({"type":"Feature","properties":{},"geometry":)" + geometry + "}");
  return scratch(name, text + "]}");
}

// A source with the layers "first" and "second", which may hold any geometry.
std::string two_layers(const std::string& name, const std::string& first,
                       const std::string& second) {
  std::string text = "<OGRVRTDataSource>";
  for (const auto& [layer, geometry] : {std::pair("first", first), std::pair("second", second)})
    text += "<OGRVRTLayer name=\"" + std::string(layer) + "\"><SrcDataSource>" +
            features(name + "_" + layer + ".geojson", {geometry}) +
            "</SrcDataSource><SrcSQL>SELECT * FROM \"talus_vectors_" + name + "_" + layer +
            "\"</SrcSQL><GeometryType>wkbUnknown</GeometryType></OGRVRTLayer>";
  return scratch(name, text + "</OGRVRTDataSource>");
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

// GeoJSON cuts areas at 180 degrees (RFC 7946, 3.1.9).
TEST(ReadVectors, AreasThatAreCutAt180DegreesAreOne) {
  const std::string path =
      scratch("fiji.geojson",
              geojson(R"({"type":"MultiPolygon","coordinates":[[[[179.9996,-16.8],[180,-16.8],)"
                      R"([180,-16.799],[179.9996,-16.799],[179.9996,-16.8]]],[[[-180,-16.8],)"
                      R"([-179.9995,-16.8],[-179.9995,-16.799],[-180,-16.799],[-180,-16.8]]]]})",
                      "EPSG::4326"));
  VectorQuery query;
  query.path = path;
  const VectorShapes found = read_vectors(query, crs_from_user("EPSG:3460", "--crs"));
  ASSERT_EQ(found.shapes.size(), 1U);
  EXPECT_NEAR(found.area_m2, 96.0 * 110.6, 0.01 * 96 * 110.6);  // 0.0009 by 0.001 degrees
  EXPECT_TRUE(found.doubts.empty()) << found.doubts.front().found;
}

TEST(ReadVectors, RingsComeWithoutTheirLastPoint) {
  const std::string path = scratch(
      "area.geojson",
      geojson(
          R"({"type":"Polygon","coordinates":[[[0,0],[9,0],[9,9],[0,0]],[[5,1],[6,1],[6,2],[5,1]]]})"));
  const VectorShapes found = read_vectors({path, VectorKind::areas}, "");
  ASSERT_EQ(found.shapes.size(), 2u);
  EXPECT_EQ(found.shapes[0].size(), 3u);
  EXPECT_TRUE(found.operation.empty());
}

TEST(ReadVectors, OtherCoordinateSystemsAreReprojected) {
  const std::string path =
      scratch("line.geojson",
              geojson(R"({"type":"LineString","coordinates":[[15,47],[15,48]]})", "OGC:1.3:CRS84"));
  const VectorShapes found =
      read_vectors({path, VectorKind::lines}, crs_from_user("EPSG:32633", "test"));
  EXPECT_FALSE(found.operation.empty());
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
        read_vectors({path, VectorKind::points}, crs_from_user("EPSG:32633", "test")));
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("the coordinates are not degrees"), std::string::npos);
    EXPECT_NE(error.hint().find("ogr2ogr -a_srs EPSG:code"), std::string::npos);
  }
}

TEST(ReadVectors, WhatIsNotThereIsNamed) {
  const std::string path = scratch("p.geojson", geojson(R"({"type":"Point","coordinates":[1,2]})"));
  EXPECT_NE(
      refusal({path + "|layername=roads", VectorKind::points}).find("there is no layer \"roads\""),
      std::string::npos);
  EXPECT_NE(refusal({path, VectorKind::areas}).find("holds no polygons"), std::string::npos);
  EXPECT_NE(refusal({path + "|subset=nonsense = ", VectorKind::points}).find("cannot be used"),
            std::string::npos);
  EXPECT_NE(refusal({path + "|subset=kind = 'b'", VectorKind::points})
                .find("holds no points: the filter \"kind = 'b'\" leaves no feature"),
            std::string::npos);
  EXPECT_NE(refusal({scratch("broken.geojson", "{"), VectorKind::points}).find("cannot be opened"),
            std::string::npos);
}

// --- which layer -------------------------------------------------------------------------------

TEST(ReadVectors, LayersThatMayBeMeantAreListed) {
  const std::string path = two_layers("several.vrt", square(0, 0, 9), square(20, 0, 3));
  try {
    static_cast<void>(read_vectors({path, VectorKind::areas}, ""));
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("the layers are: first, second"), std::string::npos);
    EXPECT_EQ(
        error.hint(),
        "put \"|layername=first\" behind the file; several: \"|layername=first,second\"; all: "
        "\"|layername=*\"");
  }
  const VectorShapes found = read_vectors({path + "|layername=second", VectorKind::areas}, "");
  EXPECT_EQ(found.layer, "second");
  EXPECT_EQ(found.area_m2, 9);
}

TEST(ReadVectors, ALayerOfAnyGeometryHidesNoneBehindIt) {
  const std::string line = R"({"type":"LineString","coordinates":[[0,0],[9,9]]})";
  const VectorShapes behind =
      read_vectors({two_layers("a.vrt", line, square(0, 0, 3)), VectorKind::areas}, "");
  EXPECT_EQ(behind.layer, "second");
  const std::string mixed =
      R"({"type":"GeometryCollection","geometries":[)" + line + "," + square(0, 0, 2) + "]}";
  const std::string path = two_layers("b.vrt", mixed, line);
  const VectorShapes inside = read_vectors({path, VectorKind::areas}, "");
  EXPECT_EQ(inside.layer, "first");
  EXPECT_EQ(inside.area_m2, 4);
  EXPECT_EQ(inside.n_passed_over, 1);
  EXPECT_NE(refusal({path, VectorKind::lines}).find("2 layers hold lines"), std::string::npos);
}

TEST(ReadVectors, SeveralLayersAreReadAsOne) {
  const std::string path = two_layers("both.vrt", square(0, 0, 3), square(20, 0, 2));
  for (const char* layers : {"first, second", "second,first", "*", "fi*,sec?nd"}) {
    const VectorShapes found = read_vectors({path + "|layername=" + layers, VectorKind::areas}, "");
    EXPECT_EQ(found.area_m2, 13) << layers;
    EXPECT_EQ(found.n_parts, 2) << layers;
  }
  EXPECT_NE(
      refusal({path + "|layername=first, third", VectorKind::areas}).find("there is no layer"),
      std::string::npos);
}

TEST(ReadVectors, ANamedLayerWithoutTheShapeIsRefused) {
  const std::string point = R"({"type":"Point","coordinates":[1,2]})";
  const std::string path = two_layers("half.vrt", square(0, 0, 3), point);
  EXPECT_NE(refusal({path + "|layername=first, second", VectorKind::areas})
                .find("layer second: holds no polygons"),
            std::string::npos);
}

TEST(ReadVectors, NamesAsQgisWritesThemChooseLayerAndFeatures) {
  const std::string path = two_layers("qgis.vrt", square(0, 0, 3), square(20, 0, 2));
  EXPECT_EQ(read_vectors({path + "|layername=second", VectorKind::areas}, "").area_m2, 4);
  EXPECT_EQ(read_vectors({path + "|layerid=0", VectorKind::areas}, "").area_m2, 9);
  EXPECT_NE(refusal({path + "|layerid=2", VectorKind::areas}).find("the number 2"),
            std::string::npos);
  const std::string two = scratch(
      "subset.geojson",
      R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":{"k":1},"geometry":)" +
          square(0, 0, 3) + R"(},{"type":"Feature","properties":{"k":2},"geometry":)" +
          square(9, 0, 1) + "}]}");
  EXPECT_EQ(read_vectors({two + "|subset=k = 2", VectorKind::areas}, "").area_m2, 1);
}

TEST(ReadVectors, PointsComeFromTables) {
  const std::string path = scratch("points.csv", "name;northing;easting\na;5200000,5;500000\n");
  const VectorShapes found = read_vectors({path, VectorKind::points}, "");
  ASSERT_EQ(found.shapes.size(), 1u);
  EXPECT_EQ(found.shapes[0][0].head<2>(), Vec2(500000, 5200000.5));
  ASSERT_EQ(found.remarks.size(), 1u);
  EXPECT_EQ(found.remarks[0], "x from easting, y from northing");
  const std::string geometries = scratch("wkt.csv", "id,WKT\n1,POINT (3 4)\n");
  EXPECT_EQ(read_vectors({geometries, VectorKind::points}, "").shapes[0][0].x(), 3);
}

// --- closed lines, drawings ----------------------------------------------------------------------

// A drawing (DXF) of closed and open lines: "LAYER 1" closed, "LAYER 0" open, each a square of 10 m
// that begins at (100 i, 0).
std::string drawing(const std::string& name,
                    const std::vector<std::pair<std::string, int>>& lines) {
  std::string text = "0\nSECTION\n2\nENTITIES\n";
  int x = 0;
  for (const auto& [layer, is_closed] : lines) {
    text += "0\nLWPOLYLINE\n100\nAcDbEntity\n8\n" + layer + "\n100\nAcDbPolyline\n90\n4\n70\n" +
            std::to_string(is_closed) + "\n";
    for (const auto& [dx, dy] :
         {std::pair(0, 0), std::pair(10, 0), std::pair(10, 10), std::pair(0, 10)})
      text += "10\n" + std::to_string(x + dx) + "\n20\n" + std::to_string(dy) + "\n";
    x += 100;
  }
  return scratch(name, text + "0\nENDSEC\n0\nEOF\n");
}

TEST(ReadVectors, ClosedLinesOfADrawingAreAreas) {
  const std::string path = drawing("limit.dxf", {{"LIMIT", 1}, {"LIMIT", 0}});
  const VectorShapes found = read_vectors({path, VectorKind::areas}, "");
  EXPECT_EQ(found.layer, "LIMIT");
  EXPECT_EQ(found.area_m2, 100);
  EXPECT_EQ(found.passed_over, "1 open line");
  EXPECT_EQ(found.remarks, std::vector<std::string>{"1 closed line taken as areas"});
  EXPECT_NE(refusal({drawing("open.dxf", {{"A", 0}}), VectorKind::areas})
                .find("holds no polygons, but 1 open line; expected polygons or closed lines"),
            std::string::npos);
}

TEST(ReadVectors, ClosedLinesAreAreasWhereNoPolygonIs) {
  const std::string ring = R"({"type":"LineString","coordinates":[[0,0],[4,0],[4,4],[0,4],[0,0]]})";
  EXPECT_EQ(read_vectors({features("ring.geojson", {ring}), VectorKind::areas}, "").area_m2, 16);
  const VectorShapes both =
      read_vectors({features("ring_and.geojson", {ring, square(50, 0, 3)}), VectorKind::areas}, "");
  EXPECT_EQ(both.area_m2, 9);
  EXPECT_EQ(both.passed_over, "1 closed line");
  const std::string line = R"({"type":"LineString","coordinates":[[0,0],[9,9]]})";
  const VectorShapes behind =
      read_vectors({two_layers("c.vrt", line, ring), VectorKind::areas}, "");
  EXPECT_EQ(behind.layer, "second");
}

TEST(ReadVectors, LayersOfADrawingAreChosenLikeOthers) {
  const std::string path = drawing("layers.dxf", {{"A", 1}, {"B", 1}, {"ROAD", 0}});
  const std::string said = refusal({path, VectorKind::areas});
  EXPECT_NE(
      said.find("2 layers of the drawing hold polygons, expected one; they are: A (1), B (1)"),
      std::string::npos)
      << said;
  EXPECT_EQ(read_vectors({path + "|layername=A", VectorKind::areas}, "").n_parts, 1);
  for (const char* layers : {"A, B", "A,B", "?", "*", "entities"})
    EXPECT_EQ(read_vectors({path + "|layername=" + layers, VectorKind::areas}, "").n_parts, 2)
        << layers;
  EXPECT_EQ(read_vectors({path + "|subset=Layer IN ('A', 'B')", VectorKind::areas}, "").n_parts, 2);
  EXPECT_NE(refusal({path + "|layername=C", VectorKind::areas}).find("its layers are: A, B, ROAD"),
            std::string::npos);
  EXPECT_NE(refusal({path + "|layername=A,ROAD", VectorKind::areas})
                .find("layer ROAD: holds no polygons"),
            std::string::npos);
}

TEST(ReadVectors, CurvesAreStrokedAndSaid) {
  const std::string path =
      scratch("arc.csv", "WKT,k\n\"CURVEPOLYGON (CIRCULARSTRING (0 0,2 0,0 0))\",1\n");
  const VectorShapes found = read_vectors({path, VectorKind::areas}, "");
  EXPECT_NEAR(found.area_m2, 3.14159, 0.01);
  EXPECT_EQ(found.remarks, std::vector<std::string>{"1 curve stroked to lines"});
}

// --- polygons ----------------------------------------------------------------------------------

TEST(ReadVectors, PolygonsThatOverlapAreOneArea) {
  // a polygon twice, one in it, one that shares a side, one far away
  const std::string path =
      features("union.geojson", {square(0, 0, 10), square(0, 0, 10), square(2, 2, 3),
                                 square(10, 0, 10), square(100, 100, 1)});
  const VectorShapes found = read_vectors({path, VectorKind::areas}, "");
  EXPECT_EQ(found.n_parts, 5);
  EXPECT_EQ(found.n_united, 4);
  EXPECT_EQ(found.n_made, 1);
  EXPECT_EQ(found.shapes.size(), 2u);  // no ring within another one
  EXPECT_DOUBLE_EQ(found.area_m2, 201);
}

TEST(ReadVectors, PolygonsThatCrossAreOneArea) {
  const std::string path =
      features("cross.geojson", {rectangle(0, 4, 10, 6), rectangle(4, 0, 6, 10)});
  const VectorShapes found = read_vectors({path, VectorKind::areas}, "");
  EXPECT_EQ(found.shapes.size(), 1u);
  EXPECT_DOUBLE_EQ(found.area_m2, 36);
}

// A ring in one polygon is a hole, and four bars around a court leave one, too.
TEST(ReadVectors, HolesOfPolygonsStay) {
  const std::string holed = R"({"type":"Polygon","coordinates":[[[0,0],[9,0],[9,9],[0,9],[0,0]],)"
                            R"([[3,3],[6,3],[6,6],[3,6],[3,3]]]})";
  const VectorShapes one = read_vectors({features("h.geojson", {holed}), VectorKind::areas}, "");
  EXPECT_EQ(one.shapes.size(), 2u);
  EXPECT_EQ(one.area_m2, 72);
  EXPECT_EQ(one.n_united, 0);
  const VectorShapes bars =
      read_vectors({features("bars.geojson", {rectangle(0, 0, 9, 3), rectangle(0, 6, 9, 9),
                                              rectangle(0, 0, 3, 9), rectangle(6, 0, 9, 9)}),
                    VectorKind::areas},
                   "");
  EXPECT_EQ(bars.shapes.size(), 2u);
  EXPECT_DOUBLE_EQ(bars.area_m2, 72);
}

TEST(ReadVectors, PolygonsThatCrossThemselvesAreRefusedWithThePlace) {
  const std::string bow_tie =
      R"({"type":"Polygon","coordinates":[[[0,0],[10,10],[10,0],[0,10],[0,0]]]})";
  const std::string said =
      refusal({features("bow.geojson", {square(20, 0, 1), bow_tie}), VectorKind::areas});
  EXPECT_NE(said.find("feature 1: the polygon is not sound: Self-intersection"), std::string::npos)
      << said;
  EXPECT_NE(said.find("5 5"), std::string::npos) << said;
  const std::string hole_outside =
      R"({"type":"Polygon","coordinates":[[[0,0],[9,0],[9,9],[0,9],[0,0]],)"
      R"([[30,3],[36,3],[36,6],[30,3]]]})";
  EXPECT_NE(refusal({features("out.geojson", {hole_outside}), VectorKind::areas})
                .find("Hole lies outside shell"),
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
  for (const std::string& path : {a, b})
    write_geopackage(path, set.crs_wkt, footprint_layers(set, {{{0, 0}, {1, 0}, {1, 1}}}));
  EXPECT_EQ(sha256_of_file(a), sha256_of_file(b));
  const VectorShapes found =
      read_vectors({a + "|layername=blocks|subset=volume_m3 > 5", VectorKind::areas}, set.crs_wkt);
  ASSERT_EQ(found.shapes.size(), 1u);
  EXPECT_EQ(found.shapes[0].size(), 4u);
  EXPECT_TRUE(found.operation.empty());
}

// Nine squares without the middle one, one of them in halves: corners of the halves lie on sides of
// whole squares, and all are off by rounding.
TEST(UnionOf, PiecesThatMeetMakeOneAreaWithItsHole) {
  const auto box = [](double x0, double y0, double x1, double y1) {
    const double off = 1e-9 * std::sin(100 * x0 + y1);
    return std::vector<Vec2>{{x0 + off, y0}, {x1, y0 - off}, {x1 + off, y1}, {x0, y1 + off}};
  };
  std::vector<std::vector<Vec2>> pieces;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      if (i == 1 && j == 1) continue;
      if (i == 1 && j == 0) {
        pieces.push_back(box(1, 0, 1 + 1 / 3.0, 1));
        pieces.push_back(box(1 + 1 / 3.0, 0, 2, 1));
        continue;
      }
      pieces.push_back(box(i, j, i + 1, j + 1));
    }
  pieces.push_back(box(7, 7, 8, 8));
  const auto joined = union_of(pieces, 1e-4);
  ASSERT_EQ(joined.size(), 2u);
  std::size_t n_rings = 0, n_corners = 0;
  for (const auto& polygon : joined)
    for (const auto& ring : polygon) {
      ++n_rings;
      n_corners += ring.size();
    }
  EXPECT_EQ(n_rings, 3u);
  EXPECT_EQ(n_corners, 12u);
}

TEST(UnionOf, NothingAndSliversAreNothing) {
  EXPECT_TRUE(union_of({}, 1e-4).empty());
  EXPECT_TRUE(union_of({{{0, 0}, {50, 0}, {50, 1e-5}}}, 1e-4).empty());
}
