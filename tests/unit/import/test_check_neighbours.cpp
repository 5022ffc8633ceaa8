// Heights of a layer against those of its neighbours.
#include "sources.hpp"

namespace {

using namespace talus;
using namespace talus::test;

struct CheckNeighbours : ImportTest {
  std::string spots_at(double z) {
    request.layers.clear();
    ask(InputRole::contours, contours());
    ask(InputRole::spots,
        file("spots", 32632, {{"Point", "[650010,5200010," + std::to_string(z) + "]", ""}}));
    return error_of([&] { (void)read_inputs(request); });
  }
};

// Contours of 100 to 110 m: nine tenths of a range beyond them is a summit, more is another unit.
TEST_F(CheckNeighbours, HeightsFarFromTheContoursAreInOtherUnits) {
  EXPECT_EQ(spots_at(119), "");
  EXPECT_NE(spots_at(344).find("1 of 1 heights lie far from the contours, which go from 100 to 110 "
                               "m: as feet the heights go from 104.8512 to 104.8512 m; as they are "
                               "the heights go from 344 to 344 m"),
            std::string::npos)
      << spots_at(344);
}

TEST_F(CheckNeighbours, HeightsAboveEverySummitAreNone) {
  const std::string said = spots_at(20000);
  EXPECT_NE(said.find("expected at most 9000 m"), std::string::npos);
  EXPECT_NE(said.find("as feet the heights go from 6096 to 6096 m"), std::string::npos) << said;
}

}  // namespace
