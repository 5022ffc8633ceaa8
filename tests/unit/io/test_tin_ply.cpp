// TINs as PLY: comments, systems, damage.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/error.hpp"
#include "base/random.hpp"
#include "io/tin_ply.hpp"

namespace {

using talus::parse_tin;
using talus::Tin;
using talus::Vec3;

Tin example() {
  Tin tin;
  tin.origin = Vec3(326500, 672900, 0);
  tin.crs_wkt = "PROJCRS[\"OSGB36\",\n    CS[Cartesian,2]]";
  tin.points = {
      {85.691737, 59.68213, 120.25}, {400.1, 60, 130}, {90, 659.7, 1.0 / 3}, {399, 660, 140}};
  tin.triangles = {{0, 1, 2}, {1, 3, 2}};
  return tin;
}

std::string bytes_of(const Tin& tin) {
  const auto path =
      std::filesystem::temp_directory_path() / ("talus_tin_" + std::to_string(::getpid()) + ".ply");
  talus::write_tin(path.string(), tin);
  std::stringstream bytes;
  bytes << std::ifstream(path, std::ios::binary).rdbuf();
  std::filesystem::remove(path);
  return bytes.str();
}

std::string refusal(const std::string& bytes) {
  try {
    static_cast<void>(parse_tin(bytes, "x.ply"));
  } catch (const talus::InputError& error) {
    return error.what();
  }
  return "accepted";
}

std::string with(const std::string& from, const std::string& to) {
  std::string bytes = bytes_of(example());
  return bytes.replace(bytes.find(from), from.size(), to);
}

// MeshLab does not open a file with longer lines; the code is for viewers that look for one.
TEST(TinPly, LongCrsStandsInShortLinesAndReadsBackWhole) {
  Tin tin = example();
  tin.crs_wkt = "PROJCRS[\"" + std::string(1500, 'x') + " y\",ID[\"EPSG\",2193]]";
  const std::string bytes = bytes_of(tin);
  EXPECT_EQ(parse_tin(bytes, "x.ply").crs_wkt, tin.crs_wkt);
  std::stringstream header(bytes.substr(0, bytes.find("end_header")));
  for (std::string line; std::getline(header, line);) EXPECT_LE(line.size(), 450u);
  EXPECT_NE(bytes.find("\ncomment crs EPSG:2193\n"), std::string::npos);
  tin.crs_wkt = "COMPOUNDCRS[\"a\",VERTCRS[\"b\",ID[\"EPSG\",5703]]]";  // the code of a part only
  EXPECT_EQ(bytes_of(tin).find("comment crs "), std::string::npos);
}

// One line with the whole CRS is read too.
TEST(TinPly, CrsInOneLineIsRead) {
  const std::string bytes = with("comment crs_wkt ", "comment crs ");
  EXPECT_EQ(parse_tin(bytes, "x.ply").crs_wkt, parse_tin(bytes_of(example()), "x.ply").crs_wkt);
}

TEST(TinPly, ReadsBackWhatItWrote) {
  const Tin tin = example(), back = parse_tin(bytes_of(tin), "x.ply");
  EXPECT_EQ(back.origin, tin.origin);
  EXPECT_EQ(back.crs_wkt, "PROJCRS[\"OSGB36\",     CS[Cartesian,2]]");  // in one line
  EXPECT_EQ(back.triangles, tin.triangles);
  ASSERT_EQ(back.points.size(), tin.points.size());
  for (std::size_t i = 0; i < tin.points.size(); ++i)
    EXPECT_NEAR((back.points[i] - tin.points[i]).norm(), 0, 1e-9);
  EXPECT_EQ(bytes_of(back), bytes_of(parse_tin(bytes_of(back), "x.ply")));
}

TEST(TinPly, SaysThatItsHeightsWereJudgedUntilTheyAreChanged) {
  Tin tin = example();
  tin.accepted_doubts = "contour at 0 m, x 1, y 2; " + std::string(700, 'z') + " end";
  std::string bytes = bytes_of(tin);
  const Tin back = parse_tin(bytes, "x.ply");
  EXPECT_TRUE(back.is_judged);
  EXPECT_EQ(back.accepted_doubts, tin.accepted_doubts);
  bytes[bytes.find("end_header") + 11] ^= 1;  // the lowest bit of the first coordinate
  const Tin changed = parse_tin(bytes, "x.ply");
  EXPECT_FALSE(changed.is_judged);
  EXPECT_EQ(changed.accepted_doubts, "");
  EXPECT_FALSE(parse_tin(with("heights_judged", "heights_refused"), "x.ply").is_judged);
}

// Map coordinates survive to the last bit: that is why the origin is a multiple of 100 m.
TEST(TinPly, KeepsMapCoordinatesExactly) {
  talus::Random random(9, "ply");
  Tin tin = example();
  std::vector<double> on_map;
  for (Vec3& p : tin.points) {
    on_map.push_back(random.uniform(326500, 327500));
    p.x() = on_map.back() - tin.origin.x();
  }
  const Tin back = parse_tin(bytes_of(tin), "x.ply");
  for (std::size_t i = 0; i < on_map.size(); ++i)
    EXPECT_EQ(back.points[i].x() + back.origin.x(), on_map[i]);
}

TEST(TinPly, RefusesEveryTruncation) {
  const std::string bytes = bytes_of(example());
  for (std::size_t n = 0; n < bytes.size(); ++n)
    ASSERT_NE(refusal(bytes.substr(0, n)), "accepted") << n << " bytes";
}

TEST(TinPly, RefusesCountsThatTheFileCannotHoldBeforeMakingRoom) {
  EXPECT_NE(refusal(with("vertex 4", "vertex 2000000000")).find("promises 2000000000"),
            std::string::npos);
  EXPECT_NE(refusal(with("face 2", "face 2000000000")).find("promises"), std::string::npos);
  EXPECT_NE(refusal(with("vertex 4", "vertex 9e99")), "accepted");
  EXPECT_NE(refusal(with("vertex 4", "vertex -4")), "accepted");
  EXPECT_NE(refusal(with("vertex 4", "vertex 4.5")), "accepted");
}

TEST(TinPly, RefusesWhatIsNoTriangle) {
  std::string bytes = bytes_of(example());
  const std::size_t faces = bytes.size() - 26;
  const auto set_corner = [&](int corner) {
    std::string changed = bytes;
    std::memcpy(changed.data() + faces + 1, &corner, sizeof corner);
    return changed;
  };
  EXPECT_NE(refusal(set_corner(4)).find("face 0 has the corner 4, expected 0 to 3"),
            std::string::npos);
  EXPECT_NE(refusal(set_corner(-1)).find("corner -1"), std::string::npos);
  EXPECT_NE(refusal(set_corner(1)).find("one corner twice"), std::string::npos);
  bytes[faces] = 4;
  EXPECT_NE(refusal(bytes).find("4 corners"), std::string::npos);
}

TEST(TinPly, RefusesCoordinatesThatAreNotFinite) {
  Tin tin = example();
  tin.points[1].z() = std::nan("");
  EXPECT_NE(refusal(bytes_of(tin)).find("vertex 1"), std::string::npos);
}

TEST(TinPly, RefusesOtherFormatsWithWhatItFound) {
  EXPECT_NE(refusal(with("binary_little_endian", "binary_middle_endian")).find("_middle_endian\""),
            std::string::npos);
  EXPECT_NE(refusal(with("binary_little_endian", "ascii")).find("is not a number"),
            std::string::npos);
  EXPECT_NE(refusal("solid stl\n").find("not a PLY file"), std::string::npos);
  EXPECT_NE(refusal(with("end_header", "end_heather")).find("header"), std::string::npos);
  EXPECT_NE(refusal(with("double z", "double w")).find("lacks x, y or z"), std::string::npos);
  EXPECT_NE(refusal(with("double z", "triple z")).find("property"), std::string::npos);
  EXPECT_NE(refusal(with("vertex_indices", "colours_of_it")).find("vertex_indices"),
            std::string::npos);
}

TEST(TinPly, ReadsFloatsFurtherPropertiesAndClockwiseTriangles) {
  std::string bytes =
      "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property uchar red\nproperty float z\nelement face 1\n"
      "property list uchar uint vertex_index\nproperty short quality\nend_header\n";
  const auto append = [&bytes](const auto& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  for (const auto& [x, y, z] :
       {std::array{250.0F, 150.0F, 1.0F}, {350.0F, 150.0F, 2.0F}, {250.0F, 250.0F, 3.0F}}) {
    append(x), append(y), append(std::uint8_t{7}), append(z);
  }
  append(std::uint8_t{3}), append(0U), append(2U), append(1U), append(std::int16_t{-5});
  const Tin tin = parse_tin(bytes, "other.ply");
  EXPECT_EQ(tin.origin, Vec3(200, 100, 0));
  EXPECT_EQ(tin.points[1], Vec3(150, 50, 2));
  EXPECT_EQ(tin.triangles[0], (std::array{0, 1, 2}));
  EXPECT_EQ(tin.crs_wkt, "");
}

// Whatever bytes are changed: a TIN that keeps its promises, or an InputError.
TEST(TinPly, SurvivesRandomDamage) {
  talus::Random random(10, "damage");
  const std::string whole = bytes_of(example());
  for (int i = 0; i < 20000; ++i) {
    std::string bytes = whole;
    for (std::uint64_t n = 1 + random.below(4); n > 0; --n)
      bytes[random.below(bytes.size())] = static_cast<char>(random.below(256));
    try {
      const Tin tin = parse_tin(bytes, "damaged.ply");
      for (const auto& corners : tin.triangles)
        for (const int corner : corners) {
          ASSERT_GE(corner, 0);
          ASSERT_LT(corner, static_cast<int>(tin.points.size()));
        }
    } catch (const talus::InputError&) {
    }
  }
}

const std::string text_header =
    "ply\r\nformat ascii 1.0\r\ncomment from CAD\r\nelement vertex 4\r\nproperty float x\r\n"
    "property float y\r\nproperty uchar red\r\nproperty float z\r\nelement face 2\r\n"
    "property list uchar int vertex_indices\r\nend_header\r\n";

TEST(TinPly, TextIsReadLikeBytes) {
  const Tin tin = parse_tin(text_header +
                                "650000 5200000 255 10\r\n650100 5200000 0 10\r\n"
                                "650100 5200100.25 0 3e1\r\n650000 5200100 9 30\r\n"
                                "3 0 1 2\r\n3 0 3 2\r\n",
                            "x.ply");
  EXPECT_EQ(tin.origin, Vec3(650000, 5200000, 0));
  ASSERT_EQ(tin.points.size(), 4U);
  EXPECT_EQ(tin.points[2], Vec3(100, 100.25, 30));
  EXPECT_EQ(tin.triangles[0], (std::array<int, 3>{0, 1, 2}));
  EXPECT_EQ(tin.triangles[1], (std::array<int, 3>{0, 2, 3}));  // turned
}

TEST(TinPly, TextThatLiesIsRefused) {
  const std::string points = "0 0 0 0\n1 0 0 0\n1 1 0 0\n0 1 0 0\n";
  EXPECT_EQ(refusal(text_header + points + "3 0 1 2\n3 0 2\n"), "x.ply:18: the file ends early");
  EXPECT_EQ(refusal(text_header + points + "3 0 1 2\n3 0 2 4\n"),
            "x.ply: face 1 has the corner 4, expected 0 to 3");
  EXPECT_EQ(refusal(text_header + points + "3 0 1 2\n3 0 2 1.5\n"),
            "x.ply: face 1 has the corner 1.5, expected 0 to 3");
  EXPECT_EQ(refusal(text_header + points + "4 0 1 2 3\n"),
            "x.ply: face 0 has 4 corners, expected triangles");
  EXPECT_EQ(refusal(text_header + "0 0 0 zero\n" + points), "x.ply:12: \"zero\" is not a number");
  EXPECT_NE(refusal(with("binary_little_endian 1.0\n", "ascii 1.0\n")).find("is not a number"),
            std::string::npos);
}

}  // namespace
