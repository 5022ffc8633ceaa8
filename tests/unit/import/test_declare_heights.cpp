// Where the heights of a layer are: Z, fields, contradictions.
#include "sources.hpp"

namespace {

using namespace talus;
using namespace talus::test;

struct DeclareHeights : ImportTest {
  std::string declare() {
    return error_of([&] {
      RawInputs raw = open_all(request);
      declare_heights(raw);
      from = raw.layers.back().taken.elevation_from;
      z = raw.layers.back().lines.points.front().z();
    });
  }
  std::string from;
  double z = 0;
};

// One rule for whatever keeps to one height: a second opinion is not passed over.
TEST_F(DeclareHeights, ZAndAFieldThatDifferAreRefusedInEveryLayer) {
  const std::string line = "[[650000,5200000,100],[650100,5200000,100]]";
  const std::string upper = "[[650000,5200050,110],[650100,5200050,110]]";
  for (const InputRole role : {InputRole::contours, InputRole::breaklines}) {
    request.layers.clear();
    ask(role, file("lines", 32632,
                   {{"LineString", line, "\"elev\":328"}, {"LineString", upper, "\"elev\":361"}}));
    EXPECT_NE(declare().find("has Z 100 and elev 328, expected the same height"),
              std::string::npos);
  }
  request.layers.clear();
  ask(InputRole::spots, file("spots", 32632, {{"Point", "[650000,5200000,100]", "\"elev\":328"}}));
  EXPECT_NE(declare().find("has Z 100 and elev 328"), std::string::npos);
  request.layers.back().ref.elevation_field = "Z";
  EXPECT_EQ(declare(), "");
  EXPECT_EQ(z, 100);
}

TEST_F(DeclareHeights, AFieldCannotContradictALineThatSlopes) {
  ask(InputRole::breaklines,
      file("breaks", 32632,
           {{"LineString", "[[650000,5200000,100],[650100,5200000,140]]", "\"height\":3"}}));
  EXPECT_EQ(declare(), "");
  EXPECT_EQ(from, "Z");
}

TEST_F(DeclareHeights, WhatStandsInAFieldThatIsNotTakenIsNoMistake) {
  ask(InputRole::contours,
      file("lines", 32632,
           {{"LineString", "[[650000,5200000,100],[650100,5200000,100]]", "\"elev\":null"},
            {"LineString", "[[650000,5200050,110],[650100,5200050,110]]", "\"elev\":110"}}));
  EXPECT_EQ(declare(), "");
  request.layers.back().ref.elevation_field = "elev";
  EXPECT_NE(declare().find("the field elev is empty"), std::string::npos);
}

TEST_F(DeclareHeights, TheFieldIsTakenWhereZTellsNothing) {
  ask(InputRole::spots, file("spots", 32632, {{"Point", "[650000,5200000,0]", "\"elev\":328"}}));
  EXPECT_EQ(declare(), "");
  EXPECT_EQ(from, "field elev");
  EXPECT_EQ(z, 328);
}

TEST_F(DeclareHeights, ContoursThatSlopeAreRefused) {
  ask(InputRole::contours,
      file("lines", 32632, {{"LineString", "[[650000,5200000,1],[650100,5200000,9]]", ""}}));
  EXPECT_NE(declare().find("changes its height along the line"), std::string::npos);
}

}  // namespace
