// Lists of measured orientations.
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/units.hpp"
#include "blocks/joint_sets.hpp"
#include "site/joint_list.hpp"

namespace {

using namespace talus;

// Dip direction and dip of the poles of a list, in degrees.
std::vector<std::array<double, 2>> read(const std::string& text) {
  std::vector<std::array<double, 2>> found;
  for (const Vec3& axis : read_orientations(text, "f").poles) {
    const Attitude plane = attitude(axis);
    found.push_back({plane.dip_direction / degree, plane.dip / degree});
  }
  return found;
}

void expect_planes(const std::string& text, const std::vector<std::array<double, 2>>& planes) {
  const auto found = read(text);
  ASSERT_EQ(found.size(), planes.size()) << text;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    EXPECT_NEAR(found[i][0], planes[i][0], 1e-9) << text;
    EXPECT_NEAR(found[i][1], planes[i][1], 1e-9) << text;
  }
}

std::string refused(const std::string& text) {
  try {
    static_cast<void>(read_orientations(text, "f.txt"));
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(ReadOrientations, PairsWithoutNamesAreDipDirectionAndDip) {
  expect_planes("# c\n10 80\n\n 20,70 # x\r\n30;60\n", {{10, 80}, {20, 70}, {30, 60}});
  expect_planes(
      "\xef\xbb\xbf"
      "180.7;21.6\r\n90;45\r\n",
      {{180.7, 21.6}, {90, 45}});
  expect_planes("180,7\t21,6\n90,5\t45\n", {{180.7, 21.6}, {90.5, 45}});
  expect_planes("180,7 21,6\n90,5 45\n", {{180.7, 21.6}, {90.5, 45}});
  expect_planes("045/60\n350/5\n", {{45, 60}, {350, 5}});
  expect_planes("\"10\",\"80\"\r90,20\r", {{10, 80}, {90, 20}});
}

TEST(ReadOrientations, PairsThatLookSwappedAreRefused) {
  EXPECT_EQ(refused("60/045\n35/120\n"),
            "f.txt:1: \"60\", \"045\" look like dip, dip direction; expected dip direction, dip");
  EXPECT_EQ(refused("5/120\n"), "f.txt:1: dip is 120, expected 0 to 90");
  expect_planes("Dip,Dip direction\n60,045\n35,120\n", {{45, 60}, {120, 35}});
  expect_planes("60/45\n35/12\n", {{60, 45}, {35, 12}});
}

TEST(ReadOrientations, CloudCompareFacetsAreFoundByTheirNames) {
  const OrientationList list = read_orientations(
      "Index;CenterX;CenterY;CenterZ;NormalX;NormalY;NormalZ;RMS;Dip dir.;Dip;Family ID\n"
      "0;650000.5;5200000;1000;0;-0.34;0.94;0.02;180;20;1;\n1;6;5;1;0;0;1;0.02;90;70;2\n",
      "f");
  ASSERT_EQ(list.poles.size(), 2u);
  EXPECT_LT((list.poles[0] - pole(20 * degree, 180 * degree)).norm(), 1e-12);
  EXPECT_TRUE(list.is_computed);
  EXPECT_EQ(list.taken_from,
            "columns Dip dir., Dip (dip direction, dip); 9 other columns passed over");
  expect_planes("Name,Strike,Dip,Dip_Dir,Cx,Cy,Cz\nP1,10,60,100,1,2,3\n", {{100, 60}});  // Compass
}

TEST(ReadOrientations, DiscontinuitySetsMayBeNormalsAlone) {  // DSE
  const OrientationList list =
      read_orientations("x\ty\tz\tds\tcluster\tA\tB\tC\tD\n1\t2\t3\t1\t1\t0\t-0.6\t0.8\t9\n", "f");
  ASSERT_EQ(list.poles.size(), 1u);
  EXPECT_LT((list.poles[0] - Vec3(0, -0.6, 0.8)).norm(), 1e-12);
  expect_planes("% DSE\n% DS Dip_dir(\xc2\xba) Dip(\xc2\xba) density\n1 120.5 60.25 0.7\n",
                {{120.5, 60.25}});
}

TEST(ReadOrientations, DipsWritesStrikesAndQuantities) {
  expect_planes("* Dips\nID,Dip,Dip Direction,Quantity\n1,60,45,2\n2,20,300,1\n",
                {{45, 60}, {45, 60}, {300, 20}});
  expect_planes("Strike (Right),Dip\n45,60\n", {{135, 60}});
  expect_planes("Strike (Left)\tDip\n45\t60\n", {{315, 60}});
  expect_planes("StrikeL;Dip\n45;60\n", {{315, 60}});
  expect_planes("Trend,Plunge\n225,30\n", {{45, 60}});
}

TEST(ReadOrientations, GonIsReadWhereTheNamesSayIt) {
  expect_planes("Dip direction [gon];Dip [gon]\n200;50\n400;10,5\n", {{180, 45}, {0, 9.45}});
  expect_planes("Streichen;Fallen\n110;41\n", {{200, 41}});
}

TEST(ReadOrientations, GradIsAskedFor) {  // a degree in German, a gon in English
  EXPECT_EQ(
      refused("Fallrichtung [Grad];Fallwinkel\n200;50\n"),
      "f.txt: column Fallrichtung [Grad] has a unit of two meanings, 360 or 400 to the circle");
}

TEST(ReadOrientations, AnglesThatAreAllSmallMayBeRadians) {
  const auto may_be = [](const std::string& text) {
    return may_be_radians(read_orientations("Dip direction,Dip\n" + text, "f"));
  };
  EXPECT_TRUE(may_be("3.5,0.7\n6.2831,1.57\n0.2,0.1\n"));
  EXPECT_FALSE(may_be("3.5,0.7\n6.3,1.57\n0.2,0.1\n"));
  EXPECT_FALSE(may_be("3.5,0.7\n6.1,1.58\n0.2,0.1\n"));
  EXPECT_FALSE(may_be("0,0\n0,0\n0,0\n"));  // level beds
  EXPECT_FALSE(may_be("3.5,0.7\n"));
}

TEST(ReadOrientations, LettersOfACompassAreRefused) {
  expect_planes("No.\tStrike\tDip\n1\t045\t60\n", {{135, 60}});
  EXPECT_EQ(refused("Strike,Dip\nN45E,60\n"), "f.txt:2: \"N45E\" is not a number");
  EXPECT_EQ(refused("Dip dir,Dip\n315,60NW\n"), "f.txt:2: \"60NW\" is not a number");
  EXPECT_EQ(refused("Strike;Dip;Quadrant\n45;60;NW\n"),
            "f.txt: column Quadrant says where strikes dip, which is not read");
}

TEST(ReadOrientations, WhatCannotBeMeantIsRefusedWithItsLine) {
  EXPECT_EQ(refused("10 80\n10 steep\n"), "f.txt:2: \"steep\" is not a number");
  EXPECT_EQ(refused("10 80 3\n"), "f.txt:1: 3 numbers, expected 2");
  EXPECT_EQ(refused("\n400 80\n"), "f.txt:2: dip direction is 400, expected 0 to 360");
  EXPECT_EQ(refused("# nothing\n"), "f.txt: holds no line with a number");
  EXPECT_EQ(refused("Dip,Dip Direction\n10\t80\n").substr(0, 7), "accepte");  // own delimiter
  EXPECT_EQ(refused("my rocks\n10,80,1\n"),
            "f.txt:1: \"my rocks\" does not name the 3 columns of the lines below it");
  EXPECT_EQ(refused("a,b\n10,80\n"), "f.txt: no columns of orientations are among: a, b");
  EXPECT_EQ(refused("Dip,Dip dir\n10,80\n20,\n"), "f.txt:3: there is nothing in column Dip dir");
  EXPECT_EQ(refused("\xff\xfe"
                    "1"),
            "f.txt: is written in UTF-16, expected UTF-8");
  EXPECT_EQ(refused(std::string("1\0", 2)),
            "f.txt: is not plain text (UTF-16, or binary), expected columns of numbers");
}

}  // namespace
