// The view of a site before the runs.
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

TEST(CheckView, PartHoldsAllThatIsDrawn) {
  const MapGround part = check_ground(view(), slope(200));
  EXPECT_LT((part.view.high - part.view.low).maxCoeff(), 120);  // of 398 m
  EXPECT_LE(part.view.low.x(), 40 - 7);
  EXPECT_GE(part.view.high.y(), 80 + 7);
  EXPECT_GT(part.contours.size(), 5u);
}

TEST(CheckView, MapShowsEachThingOnce) {
  const Trn ground = slope(60);
  const std::string svg = svg_of(check_map(view(), ground, check_ground(view(), ground)));
  for (const char* part :
       {"source</title>", "fence road</title>", "section</title>", "comes out here</title>",
        "step of 2.5 m</title>", "block 3 &lt; 4</title>", ">road</text>", ">N</text>"})
    EXPECT_EQ(count(svg, part), 1u) << part;
  EXPECT_EQ(count(svg, "nan"), 0u);
}

// A road that leaves the map is drawn up to its edge; the rest is not.
TEST(CheckView, ObjectsAndSurfacesAreDrawnAndNamed) {
  CheckView made = view();
  const auto width_of = [](const MapGround& part) { return (part.view.high - part.view.low).x(); };
  const double before = width_of(check_ground(made, slope(600)));
  made.objects = {{"house <1>", "object house", {{{{50, 40}, {54, 40}, {54, 44}}}}},
                  {"road", "object road", {{{{30, 34}, {900, 34}, {900, 36}, {30, 36}}}}},
                  {"far", "object far", {{{{900, 900}, {910, 900}, {910, 910}}}}}};
  made.surfaces = {{"sliding", "plane of sliding", {{{{42, 62}, {58, 62}, {58, 78}}}}}};
  const Trn ground = slope(600);
  const MapGround part = check_ground(made, ground);
  EXPECT_LT(width_of(part), 2.5 * before);
  EXPECT_TRUE(is_drawn(made.objects[0], part.view));
  EXPECT_TRUE(is_drawn(made.objects[1], part.view));
  EXPECT_FALSE(is_drawn(made.objects[2], part.view));
  const std::string svg = svg_of(check_map(made, ground, part));
  EXPECT_EQ(count(svg, ">house &lt;1&gt;</text>"), 1u);
  EXPECT_EQ(count(svg, ">road</text>"), 2u);  // and the fence of that name
  EXPECT_EQ(count(svg, ">far</text>"), 0u);
  EXPECT_EQ(count(svg, "plane of sliding</title>"), 1u);
}

TEST(CheckView, DoubtsAndInputsAreOnTheMapOfInputs) {
  CheckView made = view();
  made.doubts = {{7, {{50, 60}}, "units"}};
  const Trn ground = slope(60);
  const std::vector<ViewedInput> inputs = {{"contours", "3 contours", {0, 0}, {100, 100}},
                                           {"far", "away", {1e5, 1e5}, {1e5 + 9, 1e5 + 9}}};
  const std::string svg = svg_of(inputs_map(made, inputs, ground));
  EXPECT_EQ(count(svg, ">contours</text>"), 1u);
  EXPECT_EQ(count(svg, ">far</text>"), 0u);
  EXPECT_EQ(count(svg, ">7</text>"), 1u);
  EXPECT_EQ(count(svg, "units</title>"), 1u);
}

// Five metres of mass below a slope of one; the fence is 4 m high where the section crosses it.
TEST(CheckView, SectionHasTheMassAndTheFences) {
  const Trn ground = slope(60);
  Trn bed = ground;
  for (int r = 0; r < 60; ++r)
    for (int c = 0; c < 60; ++c)
      if (std::abs(c * 2 - 50) < 12 && std::abs((59 - r) * 2 - 70) < 12)
        bed.elevation[node_index(bed, r, c)] -= 5;
  const Chart chart = section_chart(view(), ground, bed);
  ASSERT_EQ(chart.series.size(), 3u);
  const ChartSeries &mass = chart.series[0], &fence = chart.series[2];
  double deepest = 0;
  for (size_t i = 0; i < mass.y.size(); ++i)
    deepest = std::max(deepest, mass.y_high[i] - mass.y[i]);
  EXPECT_NEAR(deepest, 5, 1e-9);
  EXPECT_EQ(fence.name, "fence road");
  EXPECT_NEAR(fence.x[0], 55, 1e-9);
  EXPECT_NEAR(fence.y[0], 130, 1e-9);
  EXPECT_NEAR(fence.y[1], 134, 1e-9);
  EXPECT_EQ(count(chart_svg(chart), "nan"), 0u);
  EXPECT_TRUE(section_chart(CheckView{}, ground, bed).series.empty());
}
