// Sentences, groups, acceptance and refusal of doubts about an input.
#include <gtest/gtest.h>

#include <cmath>

#include "base/doubt.hpp"
#include "base/error.hpp"

using namespace talus;

namespace {

Doubt spot(double z, DoubtState state = DoubtState::in_doubt) {
  Doubt doubt;
  doubt.where.file = "map.gpkg";
  doubt.what = "spot height";
  doubt.at = {{650000, 5200100, z}};
  doubt.expected = "1040 m";
  doubt.hint = "mend it";
  doubt.state = state;
  return doubt;
}

}  // namespace

TEST(Doubt, SentenceSaysPlaceFindingAndExpectation) {
  Doubt doubt = spot(0);
  EXPECT_EQ(sentence_on(doubt),
            "map.gpkg: spot height at 0 m, x 650000, y 5200100: expected 1040 m");
  doubt.feature = 5;
  doubt.found = "off those beside it";
  EXPECT_EQ(sentence_on(doubt),
            "map.gpkg: spot height at 0 m, feature 5, x 650000, y 5200100: off those beside it; "
            "expected 1040 m");
  doubt.at = {{1, 2, std::nan("")}, {3, 2, std::nan("")}};
  EXPECT_EQ(subject_of(doubt), "spot height, feature 5, x 1 to 3, y 2");
  EXPECT_EQ(sentence_on(doubt_on({"a.dxf"}, "is odd")), "a.dxf: is odd");
}

// Of a kind and state the first is said; a doubt without a kind is a group of its own.
TEST(Doubt, GroupsCountAll) {
  Doubt many = spot(3);
  many.n = 40;
  const std::vector<Doubt> doubts = {
      spot(1), doubt_on({"a"}, "x"), spot(2), doubt_on({"b"}, "x"), spot(9, DoubtState::mended),
      many};
  const std::vector<DoubtGroup> groups = groups_of(doubts);
  ASSERT_EQ(groups.size(), 4U);
  EXPECT_EQ(groups[0].n, 42);
  EXPECT_EQ(sentence_on(groups[0]),
            "map.gpkg: 42 spot heights, the first at 1 m, x 650000, y 5200100: expected 1040 m");
  EXPECT_EQ(groups[3].first->state, DoubtState::mended);
}

TEST(Doubt, WhatIsRefusedIsTheErrorUnlessItIsAccepted) {
  EXPECT_EQ(refusal_of({spot(1)}).state, DoubtState::in_doubt);
  std::vector<Doubt> doubts = {spot(1), spot(0, DoubtState::refused)};
  const InputError alone(refusal_of(doubts));
  EXPECT_EQ(alone.what(), sentence_on(doubts[1]));
  EXPECT_EQ(alone.hint(), "mend it");
  doubts.push_back(spot(0, DoubtState::refused));
  doubts.back().what = "contour";
  EXPECT_STREQ(InputError(refusal_of(doubts)).what(),
               "map.gpkg: spot height at 0 m, x 650000, y 5200100: expected 1040 m; contour at 0 "
               "m, x 650000, y 5200100: expected 1040 m");
  EXPECT_EQ(accepted_places(doubts), "");
  accept(doubts);
  EXPECT_EQ(refusal_of(doubts).state, DoubtState::in_doubt);
  EXPECT_EQ(accepted_places(doubts),
            "spot height at 0 m, x 650000, y 5200100; contour at 0 m, x 650000, y 5200100");
}

TEST(Doubt, AnErrorIsARefusedDoubt) {
  const InputError error({"site.toml", 14}, "is odd", "mend it");
  EXPECT_EQ(error.doubt().state, DoubtState::refused);
  EXPECT_EQ(error.doubt().where.line, 14);
  EXPECT_EQ(error.doubt().found, "is odd");
}
