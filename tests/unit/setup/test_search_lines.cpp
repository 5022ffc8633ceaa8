// Lines of a fence search: place, names, step.
#include "setup/search_lines.hpp"
#include "setups.hpp"

namespace {

using namespace talus;
using namespace talus::test;

const RecordObject house{"house", "", {{{{85, 25}, {95, 25}, {95, 75}, {85, 75}}, true}}, 0};
const std::string object =
    "[object.house]\npolygon = [[500085, 5000025], [500095, 5000025], [500095, 5000075], "
    "[500085, 5000075]]\n";

struct SearchLines : testing::Test {
  ScratchFolder folder;
  CollectedLog log;

  // Keys of the search: `more` wins over the usual ones.
  SearchCandidates found(const std::string& keys, const std::string& before = object) {
    const Site site = site_of(folder, before + "[fence_search.house]\nprotect = 'house'\n" + keys);
    return search_candidates(log, site, slope_trn(), site.fence_searches[0], {house});
  }
  std::string refusal(const std::string& keys) {
    return refusal_of([&] { static_cast<void>(found(keys)); });
  }
};

const std::string usual = "style = 'offset'\nstep_m = 10\n";
const std::string room = "between_m = [10, 40]\n", steep = "max_ground_slope_deg = 40\n";

TEST_F(SearchLines, StandOnTheGroundAndAreNumbered) {
  const SearchCandidates lines = found(usual + room + steep);
  ASSERT_EQ(lines.lines.size(), 4u);
  EXPECT_EQ(lines.step, 10);
  EXPECT_EQ(lines.lines[0].name, "fence_search.house.1");
  for (const RecordLine& line : lines.lines)
    for (const Vec3& p : line.points) EXPECT_NEAR(p.z(), ground_height(p.x()), 1e-6);
}

TEST_F(SearchLines, TheStepGrowsWhereThereWouldBeTooMany) {
  const SearchCandidates lines =
      found("style = 'offset'\nstep_m = 1\nmax_candidates = 5\n" + room + steep);
  EXPECT_LE(lines.lines.size(), 5u);
  EXPECT_TRUE(log.has_warning("no more than max_candidates, 5, are watched"));
}

TEST_F(SearchLines, SettingsThatContradictOneAnotherAreRefused) {
  EXPECT_HOLDS(refusal(usual + "between_m = [60, 20]\n"), "there is no room between these");
  EXPECT_HOLDS(refusal(usual + room + steep + "heights_m = [4, 3]\n"), "heights_m does not ascend");
  EXPECT_HOLDS(refusal(usual + room + "classes_kj = [100, 500]\nprices_per_m = [1]\n"),
               "has 1 price for 2 classes");
}

TEST_F(SearchLines, ASearchWithoutRoomSaysWhatToChange) {
  EXPECT_HOLDS(refusal(usual + "between_m = [300, 400]\n"), "no known ground 300 to 400 m");
  EXPECT_HOLDS(refusal(usual + room + "max_ground_slope_deg = 20\n"), "has no room: no line");
  EXPECT_HOLDS(refusal(usual + room + steep + "min_fields = 40\n"), "is 400 m long");
}

TEST_F(SearchLines, WhatIsProtectedIsAnObjectOfTheSite) {
  const auto index = [&](const std::string& sections) {
    return refusal_of([&] {
      const Site site = site_of(folder, sections);
      static_cast<void>(protected_object(site, site.fence_searches[0]));
    });
  };
  EXPECT_EQ(index(object + "[fence_search.a]\nprotect = 'house'\n"), "accepted");
  EXPECT_HOLDS(index(object + "[fence_search.a]\nprotect = 'hause'\n"), "did you mean house?");
  EXPECT_HOLDS(index(object + "[fence_search.a]\n"), "does not say what it protects");
  EXPECT_HOLDS(index("[fence_search.a]\nprotect = 'house'\n"), "has no object to protect");
}

}  // namespace
