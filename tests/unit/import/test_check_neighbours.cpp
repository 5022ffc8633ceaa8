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
  EXPECT_NE(spots_at(344).find("1 of 1 heights lie far from the contours"), std::string::npos);
}

TEST_F(CheckNeighbours, HeightsAboveEverySummitAreNone) {
  EXPECT_NE(spots_at(20000).find("expected at most 9000 m"), std::string::npos);
}

}  // namespace
