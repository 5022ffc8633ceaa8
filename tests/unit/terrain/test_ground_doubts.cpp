// Doubtful nodes of a terrain.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "terrain/ground_doubts.hpp"

namespace {

using namespace talus;

// 21 x 21 nodes, 5 m apart, that rise 1 : 2 to the north from 1000 m on.
Trn slope() {
  Trn trn;
  trn.n_rows = trn.n_cols = 21;
  trn.cell_size = 5;
  for (int r = 0; r < 21; ++r)
    for (int c = 0; c < 21; ++c) trn.elevation.push_back(1000 + 2.5 * (20 - r));
  return trn;
}

double& node(Trn& trn, int row, int col) { return trn.elevation[node_index(trn, row, col)]; }

std::vector<Doubt> doubts_of(const Trn& trn) { return find_ground_doubts(trn, "g.tif"); }

int count(const std::vector<Doubt>& doubts, const std::string& what) {
  return static_cast<int>(std::count_if(doubts.begin(), doubts.end(),
                                        [&what](const Doubt& d) { return d.what == what; }));
}

TEST(GroundDoubts, SlopesCliffsAndPondsAreNone) {
  EXPECT_TRUE(doubts_of(slope()).empty());
  Trn cliff = slope();
  for (int r = 0; r < 10; ++r)
    for (int c = 0; c < 12; ++c) node(cliff, r, c) += 24;
  EXPECT_TRUE(doubts_of(cliff).empty());
  Trn pond = slope();
  for (int r = 8; r < 12; ++r)
    for (int c = 8; c < 12; ++c) node(pond, r, c) = 1020;
  EXPECT_TRUE(doubts_of(pond).empty());
}

TEST(GroundDoubts, ARimBlendedWithNodataIsNamed) {
  Trn trn = slope();
  for (int r = 0; r < 21; ++r) node(trn, r, 0) = 0.4 * node(trn, r, 1) + 3 * r;
  const auto doubts = doubts_of(trn);
  EXPECT_EQ(count(doubts, "rim node"), 21);
  EXPECT_EQ(doubts[3].at.at(0), node_point(trn, 3, 0));
  EXPECT_EQ(doubts[3].low, node(trn, 3, 1));
  // also beside a gap inside, and 30 m off
  trn = slope();
  node(trn, 10, 10) = std::nan("");
  node(trn, 10, 11) -= 30;
  EXPECT_EQ(count(doubts_of(trn), "rim node"), 1);
}

TEST(GroundDoubts, LevelAreasAreNamedBelowWhatIsRefused) {
  for (const double value : {999.0, 970.0, 1100.0}) {
    Trn trn = slope();
    for (double& z : trn.elevation) z -= value == 999 ? 100 : 0;
    for (int r = 8; r < 11; ++r)
      for (int c = 8; c < 11; ++c) node(trn, r, c) = value;
    const auto doubts = doubts_of(trn);
    ASSERT_EQ(count(doubts, level_area), 1) << value;
    EXPECT_EQ(doubts[0].found.rfind("9 nodes of one height", 0), 0U) << doubts[0].found;
    EXPECT_EQ(doubts[0].at.at(0), node_point(trn, 8, 8));
  }
}

TEST(GroundDoubts, StepsAndDepthsBelowAllLandAreNamed) {
  Trn trn = slope();
  node(trn, 10, 10) += 260;
  EXPECT_EQ(count(doubts_of(trn), "step"), 3);  // by their first nodes
  trn = slope();
  trn.origin.z() = -1510;
  EXPECT_EQ(count(doubts_of(trn), "sunken node"), 4 * 21);  // -510 m
  trn.origin.z() = -1500;
  EXPECT_TRUE(doubts_of(trn).empty());
}

TEST(GroundDoubts, AStepAlongALineOfNodesIsASeam) {
  Trn trn = slope();
  for (int r = 0; r < 10; ++r)
    for (int c = 0; c < 21; ++c) node(trn, r, c) += 7;
  const std::vector<Doubt> doubts = doubts_of(trn);
  ASSERT_EQ(doubts.size(), 1u);
  EXPECT_EQ(doubts[0].what, "seam");
  EXPECT_EQ(doubts[0].at.at(0).y(), node_point(trn, 9, 0).y());
  EXPECT_NEAR(doubts[0].low - doubts[0].value, -7, 1e-9);
}

}  // namespace
