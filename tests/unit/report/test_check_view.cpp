#include <gtest/gtest.h>

#include <cmath>

#include "report/check_view.hpp"

namespace {

using namespace talus;

Trn slope(int n) {
  Trn trn;
  trn.n_rows = trn.n_cols = n;
  trn.cell_size = 2;
  trn.node0 = {0, (n - 1) * 2.0};
  trn.origin = {1000, 2000, 100};
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) trn.elevation.push_back((n - 1 - r) * 2.0);
  return trn;
}

CheckView view() {
  CheckView made;
  made.source = {{{40, 60}, {60, 60}, {60, 80}, {40, 80}}};
  made.fall_lines = {{{50, 70}, {50, 30}}};
  made.section = {{50, 85}, {50, 20}};
  ViewedFence fence;
  fence.line.name = "road";
  fence.line.points = {{40, 30, 30}, {60, 30, 30}};
  fence.height = 4;
  made.fences = {fence};
  made.foot = {{{50, 60}, 0, false}, {{55, 60}, 2.5, true}};
  made.blocks = {{{{45, 65}, {50, 65}, {50, 70}}, BlockOutlook::holds_others, "block 3 < 4"}};
  return made;
}

size_t count(const std::string& text, const std::string& words) {
  size_t n = 0;
  for (size_t at = text.find(words); at != std::string::npos; at = text.find(words, at + 1)) ++n;
  return n;
}

}  // namespace

TEST(CheckView, ContoursLieAtRoundHeights) {
  EXPECT_EQ(contour_interval(0, 100), 5);
  EXPECT_EQ(contour_interval(200, 201), 0.05);
  EXPECT_EQ(contour_interval(0, 1367), 100);
}

TEST(CheckView, PartHoldsAllThatIsDrawn) {
  const Trn whole = slope(200), part = part_for(view(), whole);
  EXPECT_LT(part.n_rows, 60);
  EXPECT_LE(part.node0.x(), 40 - 7);
  EXPECT_GE(part.node0.y(), 80 + 7);
  EXPECT_EQ(part.elevation.size(), static_cast<size_t>(part.n_rows) * part.n_cols);
  EXPECT_EQ(elevation_at(part, 50, 60), elevation_at(whole, 50, 60));
}

TEST(CheckView, MapShowsEachThingOnce) {
  const Trn ground = slope(60);
  const std::string svg = check_map_svg(view(), ground, "png");
  for (const char* part : {"class=\"source\"", "class=\"fence\"", "class=\"fall\"",
                           "class=\"section\"", "class=\"holds\"", "class=\"clear\"",
                           "class=\"step\"", "step of 2.5 m", "block 3 &lt; 4", "contours every"})
    EXPECT_GE(count(svg, part), 1u) << part;
  EXPECT_EQ(count(svg, "class=\"fence\""), 1u);
  EXPECT_EQ(count(svg, "nan"), 0u);
}

// A road that leaves the map is drawn as far as the map goes; what lies beyond it is not.
TEST(CheckView, ObjectsAndSurfacesAreDrawnAndNamed) {
  CheckView made = view();
  const double before = part_for(made, slope(600)).n_rows;
  made.objects = {{"house <1>", "object house", {{{{50, 40}, {54, 40}, {54, 44}}}}},
                  {"road", "object road", {{{{30, 34}, {900, 34}, {900, 36}, {30, 36}}}}},
                  {"far", "object far", {{{{900, 900}, {910, 900}, {910, 910}}}}}};
  made.surfaces = {{"sliding", "plane of sliding", {{{{42, 62}, {58, 62}, {58, 78}}}}}};
  const Trn ground = slope(600), part = part_for(made, ground);
  EXPECT_LT(part.n_rows, 2 * before);
  EXPECT_TRUE(is_drawn(made.objects[0], part));
  EXPECT_TRUE(is_drawn(made.objects[1], part));
  EXPECT_FALSE(is_drawn(made.objects[2], part));
  const std::string svg = check_map_svg(made, ground, "png");
  EXPECT_EQ(count(svg, "class=\"object\""), 3u);
  EXPECT_EQ(count(svg, ">house &lt;1&gt;</text>"), 1u);
  EXPECT_EQ(count(svg, ">road</text>"), 2u);  // and the fence of that name
  EXPECT_EQ(count(svg, ">far</text>"), 0u);
  EXPECT_EQ(count(svg, "class=\"proposed\""), 1u);
  EXPECT_EQ(count(svg, "plane of sliding"), 1u);
}

TEST(CheckView, SectionHasTheMassAndTheFences) {
  const Trn ground = slope(60);
  Trn bed = ground;
  for (int r = 0; r < 60; ++r)
    for (int c = 0; c < 60; ++c)
      if (std::abs(c * 2 - 50) < 12 && std::abs((59 - r) * 2 - 70) < 12)
        bed.elevation[node_index(bed, r, c)] -= 5;
  const std::string svg = section_svg(view(), ground, bed);
  EXPECT_EQ(count(svg, "class=\"mass\""), 1u);
  EXPECT_EQ(count(svg, "class=\"fence\""), 1u);
  EXPECT_EQ(count(svg, "nan"), 0u);
  EXPECT_EQ(section_svg(CheckView{}, ground, bed), "");
}
