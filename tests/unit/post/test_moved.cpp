// The share of the mass that moved.
#include <gtest/gtest.h>

#include <cmath>

#include "post/moved.hpp"
#include "run_maker.hpp"

using namespace talus;
using namespace talus::testing;

// 30 % of the mass goes 40 m down and 30 m out (50 m straight), 70 % settles by 0.9 m.
TEST(Moved, CountsTheMassThatWentMoreThanAMetre) {
  RunFile run;
  add_box(run, {1, 1, 7}, {0, 0, 0});
  add_box(run, {1, 1, 3}, {0, 0, 0});
  add_frame(run, 0, {standing({0, 0, 0}), standing({0, 0, 0})});
  add_frame(run, 1, {standing({0, 0, -0.9}), standing({99, 0, -10})});
  add_frame(run, 2, {standing({0, 0, -0.9}), standing({30, 0, -40})});
  const Moved moved = moved_of(displacements(run));
  EXPECT_DOUBLE_EQ(moved.mass, 2000 * 10);
  EXPECT_NEAR(moved.share, 0.3, 1e-12);
  EXPECT_NEAR(moved.share_far, 0.3, 1e-12);
  EXPECT_DOUBLE_EQ(moved.p50, 0.9);
  EXPECT_DOUBLE_EQ(moved.p90, 50);
  EXPECT_DOUBLE_EQ(moved.largest, 50);
  EXPECT_TRUE(moved.any());
  EXPECT_EQ(text(moved),
            "30 % of the mass moved more than 1 m, 30 % more than 20 m; displacement by mass: p50 "
            "0.9 m, p90 50 m, p95 50 m");
  EXPECT_NE(text(moved_of({{1354, 1}})).find("p50 1,350 m"), std::string::npos);
  EXPECT_NE(standing_mass_warning(moved).find("only 30 % of the mass moved"), std::string::npos);
}

// The same by masses and displacements: percentiles weigh by mass, not by count.
TEST(Moved, WeighsByMassAndNotByCount) {
  const Moved moved = moved_of({{100, 1}, {100, 1}, {100, 1}, {5, 93}, {0, 4}});
  EXPECT_DOUBLE_EQ(moved.share, 0.96);
  EXPECT_DOUBLE_EQ(moved.share_far, 0.03);
  EXPECT_DOUBLE_EQ(moved.p50, 5);
  EXPECT_DOUBLE_EQ(moved.p95, 5);
  EXPECT_EQ(standing_mass_warning(moved), "");
}

TEST(Moved, OfAMassThatStaysIsNone) {
  const Moved moved = moved_of({{1, 10}, {0.3, 10}});  // a metre is not more than a metre
  EXPECT_EQ(moved.share, 0);
  EXPECT_FALSE(moved.any());
  EXPECT_EQ(standing_mass_warning(moved), "no block moved more than 1 m: there is no run-out");
  EXPECT_TRUE(std::isnan(moved_of({}).share));
  EXPECT_EQ(standing_mass_warning(moved_of({})), "");
}
