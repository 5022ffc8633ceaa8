// TINs of other programs: drawings, OBJ, LandXML.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "base/error.hpp"
#include "import/tin_files_gdal.hpp"

namespace {

using namespace talus;

std::string write(const std::string& name, const std::string& text) {
  const std::string path = testing::TempDir() + "talus_" + name;
  std::ofstream(path, std::ios::binary) << text;
  return path;
}

LayerRef choice_of(const std::string& path) {
  LayerRef choice;
  choice.path = path;
  return choice;
}

std::string refusal(const std::string& path) {
  try {
    static_cast<void>(read_tin_file(choice_of(path)));
  } catch (const InputError& error) {
    return std::string(error.what()).substr(path.size());
  }
  return "accepted";
}

double volume_above(const Tin& tin, double level) {
  double volume = 0;
  for (const auto& [a, b, c] : tin.triangles) {
    const Vec3 &p = tin.points[a], u = tin.points[b] - p, v = tin.points[c] - p;
    volume += (u.x() * v.y() - u.y() * v.x()) / 2 * (p.z() + (u.z() + v.z()) / 3 - level);
  }
  return volume;
}

std::string face(const std::vector<Vec3>& corners) {
  std::string text = "0\n3DFACE\n8\nground\n";
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3& p = corners[std::min(i, corners.size() - 1)];
    const std::string n = std::to_string(i);
    text += "1" + n + "\n" + std::to_string(p.x()) + "\n2" + n + "\n" + std::to_string(p.y()) +
            "\n3" + n + "\n" + std::to_string(p.z()) + "\n";
  }
  return text;
}

std::string drawing(const std::string& entities, const std::string& header = "") {
  return "0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1015\n" + header +
         "0\nENDSEC\n0\nSECTION\n2\nENTITIES\n" + entities + "0\nENDSEC\n0\nEOF\n";
}

// A square of 100 m: two triangles and a face of four corners, at 10, 20 and 30 m.
const std::string faces = face({{0, 0, 10}, {50, 0, 10}, {50, 100, 30}}) +
                          face({{0, 0, 10}, {0, 100, 30}, {50, 100, 30}}) +  // clockwise
                          face({{50, 0, 10}, {100, 0, 10}, {100, 100, 30}, {50, 100, 30}});

TEST(TinFiles, FacesOfADrawingAreATin) {
  const std::string path =
      write("faces.dxf", drawing(faces + face({{0, 0, 0}, {0, 0, 5}, {0, 9, 0}})));
  ASSERT_TRUE(is_tin_file(path));
  const TinFile file = read_tin_file(choice_of(path));
  EXPECT_EQ(file.tin.triangles.size(), 4U);
  EXPECT_NEAR(volume_above(file.tin, 10), 100 * 100 * 10, 1e-6);
  ASSERT_EQ(file.notes.size(), 2U);
  EXPECT_EQ(file.notes[0], path + ": layer ground, 4 faces, 1 of them of four corners, cut in two");
  EXPECT_EQ(file.notes[1], path + ": 1 triangle without an area in plan left out");
  EXPECT_EQ(find_folded_edges(file.tin).n, 0);
}

TEST(TinFiles, DrawingsInOtherUnitsOrWithoutFacesAreRefused) {
  EXPECT_EQ(refusal(write("mm.dxf", drawing(faces, "9\n$INSUNITS\n70\n4\n"))),
            ": the drawing is in millimetres ($INSUNITS 4 in its header), expected metres: as "
            "millimetres it is 0.1 m wide; as metres it is 100 m wide");
  EXPECT_EQ(refusal(write("m.dxf", drawing(faces, "9\n$INSUNITS\n70\n6\n"))), "accepted");
  EXPECT_EQ(refusal(write("none.dxf", drawing("0\nPOINT\n8\n0\n10\n1\n20\n2\n30\n3\n"))),
            ": layer entities: holds no faces, but 1 point; expected faces");
}

// A quad is cut in two; z is the height, and y is asked for where more is seen along it.
TEST(TinFiles, AnObjIsATin) {
  const std::string vertices = "v 0 0 10\nv 50 0 10\nv 50 100 30\nv 0 100 30\n";
  const std::string path = write("ground.obj", vertices + "f 1/1 2/2 3/3 4/4\n");
  ASSERT_TRUE(is_tin_file(path));
  const TinFile file = read_tin_file(choice_of(path));
  EXPECT_EQ(file.tin.triangles.size(), 2U);
  EXPECT_NEAR(volume_above(file.tin, 10), 50 * 100 * 10, 1e-6);
  EXPECT_EQ(file.notes[0], path + ": 2 triangles, z up");
  EXPECT_TRUE(file.doubts.empty());
  LayerRef choice = choice_of(path);
  choice.unit_m = 0.1;
  EXPECT_NEAR(volume_above(read_tin_file(choice).tin, 1), 50 * 100 * 10 * 1e-3, 1e-9);
  const TinFile upright =
      read_tin_file(choice_of(write("y_up.obj", "v 0 10 0\nv 50 10 0\nv 50 30 -100\nf 1 2 3\n")));
  ASSERT_EQ(upright.doubts.size(), 1U);
  EXPECT_NE(upright.doubts[0].found.find("is y the height"), std::string::npos);
}

TEST(TinFiles, TwoLayersOfASurfaceAreFound) {
  const std::string path = write("folded.dxf", drawing(face({{0, 0, 1}, {10, 0, 1}, {5, 9, 1}}) +
                                                       face({{0, 0, 1}, {10, 0, 1}, {4, 8, 6}})));
  const FoldedEdges folded = find_folded_edges(read_tin_file(choice_of(path)).tin);
  EXPECT_EQ(folded.n, 1);
  EXPECT_EQ(folded.first.head<2>(), Vec2(5, 0));
}

std::string landxml(const std::string& units, const std::string& points,
                    const std::string& faces_) {
  return "<?xml version=\"1.0\"?>\n<LandXML xmlns=\"http://www.landxml.org/schema/LandXML-1.2\">"
         "<Units>" +
         units +
         "</Units><CoordinateSystem epsgCode=\"25832\"/>"
         "<Surfaces><Surface name=\"ground\"><Definition surfType=\"TIN\"><Pnts>" +
         points + "</Pnts><Faces>" + faces_ +
         "</Faces></Definition></Surface></Surfaces></LandXML>";
}
const std::string metric = "<Metric linearUnit=\"meter\"/>";
const std::string corners =
    "<P id=\"7\">5200000 650000 10</P><P id=\"8\">5200000 650100 10</P>"
    "<P id=\"11\">5200100 650100.5 30</P><P id=\"12\">5200100 650000 30</P>";

TEST(TinFiles, LandXmlIsNorthingEastingElevation) {
  const std::string path = write(
      "ground.xml",
      landxml(metric, corners, "<F>7 8 11</F><F n=\"1 2 3\">12 11 7</F><F i=\"1\">7 8 12</F>"));
  const TinFile file = read_tin_file(choice_of(path));
  EXPECT_EQ(file.tin.crs_wkt, "EPSG:25832");
  EXPECT_EQ(file.tin.origin, Vec3(650000, 5200000, 0));
  ASSERT_EQ(file.tin.triangles.size(), 2U);
  EXPECT_EQ(file.tin.points[2], Vec3(100.5, 100, 30));
  EXPECT_EQ(file.notes[0], path + ": surface ground, 2 triangles; 1 invisible ones left out");
}

TEST(TinFiles, LandXmlThatCannotBeTakenIsRefused) {
  EXPECT_EQ(
      refusal(write("high.xml",
                    landxml("<Metric linearUnit=\"meter\" elevationUnit=\"feet\"/>", corners, ""))),
      ": elevationUnit is feet, expected meter");
  EXPECT_EQ(refusal(write("feet.xml", landxml("<Imperial linearUnit=\"foot\"/>", corners, ""))),
            ": linearUnit is foot, expected meter");
  EXPECT_EQ(refusal(write("bare.xml", landxml(metric, corners, ""))),
            ": the surface has no faces, expected a TIN");
  EXPECT_EQ(refusal(write("lost.xml", landxml(metric, corners, "<F>7 8 99</F>"))),
            ": a face has the point 99, which is not there");
  EXPECT_FALSE(is_tin_file(write("other.xml", "<kml/>")));
}

}  // namespace
