// Pages of maps: view, scale, places, equal bytes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "base/error.hpp"
#include "post/maps/map_drawing.hpp"
#include "run_maker.hpp"

using namespace talus;
using namespace talus::testing;

namespace {

// A plane that falls to the east, cells of 10 m with values from 0 to 15.
struct Sheet {
  explicit Sheet(PageSize size) {
    page.size = size;
    page.title = "Speed of the blocks";
    page.subtitle = "Site slope, 2 runs";
    page.words = {"Runs: 2 runs", "Model: blocks"};
    page.cells.style.legend = "largest value of all blocks over the cell [m/s]";
    page.cells.style.classes = {{0, {255, 255, 255, 0}, "0 m/s"},
                                {8, {1, 2, 3, 255}, "0 - 8 m/s"},
                                {INFINITY, {9, 9, 9, 255}, "above 8 m/s", true}};
    page.cells.grid = {Vec2(0, 40), 10, 4, 4};
    for (int i = 0; i < 16; ++i) page.cells.value.push_back(static_cast<float>(i));
    page.cells.nodata = -9999;
    page.cells.uncertain.assign(16, false);
    page.cells.uncertain[3] = true;
    page.origin = {500000, 4000000};
    places.source = {{{5, 5}, {15, 5}, {15, 15}, {5, 15}}};
    places.lines = {{"low", {{30, 0, 0}, {30, 40, 0}}, {0, 40}, true}};
    places.objects = {{"house", "building", {{{{25, 25}}, false}}, 3}};
    const PageLayout layout = layout_of(size);
    ground = map_ground(plane_trn(0.5, 10, 5, 5), layout, view_of(layout, {0, 0}, {40, 40}));
  }
  [[nodiscard]] std::string png() const { return png_of(page_drawing(page, ground, places)); }
  [[nodiscard]] std::string pdf() const { return pdf_of(page_drawing(page, ground, places)); }

  MapPage page;
  MapPlaces places;
  MapGround ground;
};

// Width and height of a PNG file, from its header.
std::pair<unsigned, unsigned> size_of_png(const std::string& bytes) {
  const auto number = [&bytes](std::size_t at) {
    unsigned value = 0;
    for (std::size_t i = at; i < at + 4; ++i)
      value = value << 8 | static_cast<unsigned char>(bytes[i]);
    return value;
  };
  return {number(16), number(20)};
}

}  // namespace

TEST(MapPage, IsDrawnWithTheSameBytesTwice) {
  const Sheet a(PageSize::a4), b(PageSize::a4);
  EXPECT_EQ(a.png(), b.png());
  EXPECT_EQ(a.pdf(), b.pdf());
  EXPECT_EQ(a.pdf().find("/CreationDate"), std::string::npos);
}

TEST(MapPage, HasTheSizeOfItsPaper) {
  // 297 x 210 mm and 420 x 297 mm at 150 dots an inch, and in points
  EXPECT_EQ(size_of_png(Sheet(PageSize::a4).png()), std::pair(1754U, 1240U));
  EXPECT_EQ(size_of_png(Sheet(PageSize::a3).png()), std::pair(2480U, 1754U));
  const std::string box = "/MediaBox [ 0 0 ";
  if (Sheet(PageSize::a4).pdf().find(box) == std::string::npos)
    GTEST_SKIP() << "this Cairo compresses the objects of a PDF";
  const auto points_of = [&box](const std::string& pdf) {
    std::istringstream numbers(pdf.substr(pdf.find(box) + box.size(), 40));
    double width = 0, height = 0;
    numbers >> width >> height;
    return Vec2(width, height);
  };
  EXPECT_LT((points_of(Sheet(PageSize::a4).pdf()) - Vec2(297, 210) / 25.4 * 72).norm(), 1e-3);
  EXPECT_LT((points_of(Sheet(PageSize::a3).pdf()) - Vec2(420, 297) / 25.4 * 72).norm(), 1e-3);
}

// Leaving out any one item changes the drawing: all of it is there.
TEST(MapPage, ShowsAllThatItIsGiven) {
  const std::string whole = Sheet(PageSize::a4).png();
  const auto without = [&whole](auto change) {
    Sheet sheet(PageSize::a4);
    change(sheet);
    return sheet.png() != whole;
  };
  EXPECT_TRUE(without([](Sheet& s) { s.page.title.clear(); }));
  EXPECT_TRUE(without([](Sheet& s) { s.page.subtitle.clear(); }));
  EXPECT_TRUE(without([](Sheet& s) { s.page.words.pop_back(); }));
  EXPECT_TRUE(without([](Sheet& s) { s.page.cells.style.legend.clear(); }));
  EXPECT_TRUE(without([](Sheet& s) { s.page.cells.style.remark = "1 of 2 runs failed"; }));
  EXPECT_TRUE(without([](Sheet& s) { s.page.cells.style.notes = {"frequencies: none"}; }));
  EXPECT_TRUE(without([](Sheet& s) { s.page.cells.uncertain[3] = false; }));
  EXPECT_TRUE(without([](Sheet& s) { s.page.cells.style.classes[2].is_hatched = false; }));
  EXPECT_TRUE(without([](Sheet& s) { s.page.origin.x() += 1; }));
  EXPECT_TRUE(without([](Sheet& s) { s.places.source.clear(); }));
  EXPECT_TRUE(without([](Sheet& s) { s.places.lines[0].standing = false; }));
  EXPECT_TRUE(without([](Sheet& s) { s.places.objects.clear(); }));
  EXPECT_TRUE(without([](Sheet& s) { s.ground.contours.clear(); }));
}

// A legend that is longer than the page is drawn smaller, on the page all the same.
TEST(MapPage, TakesALegendThatIsLongerThanThePage) {
  Sheet sheet(PageSize::a4);
  const std::string few = sheet.png();
  for (int i = 0; i < 100; ++i)
    sheet.page.cells.style.classes.insert(sheet.page.cells.style.classes.begin() + 1,
                                          {1e-6 * (100 - i), {1, 2, 3, 255}, "a class"});
  EXPECT_NE(sheet.png(), few);
  EXPECT_EQ(size_of_png(sheet.png()), size_of_png(few));
}

TEST(MapPage, NamesAFontThatIsMissingAndTheWayOut) {
  EXPECT_NO_THROW(require_font());
  try {
    require_font("No Such Letters");
    FAIL() << "a font that is nowhere";
  } catch (const InputError& error) {
    const std::string words = error.what() + (" " + error.hint());
    EXPECT_NE(words.find("No Such Letters"), std::string::npos) << words;
    EXPECT_NE(words.find("fonts-dejavu-core"), std::string::npos) << words;
  }
}

TEST(MapView, HasARoundScaleThatShowsAllThatIsAskedFor) {
  for (const PageSize size : {PageSize::a4, PageSize::a3}) {
    const PageLayout layout = layout_of(size);
    for (const double width : {3.0, 40.0, 777.0, 12345.0}) {
      const Vec2 low(-width, 7), high(0, 7 + width / 3);
      const MapView view = view_of(layout, low, high);
      EXPECT_TRUE((view.low.array() <= low.array() + 1e-9).all());
      EXPECT_TRUE((view.high.array() >= high.array() - 1e-9).all());
      EXPECT_NEAR((view.high - view.low).x() * 1000 / view.scale, layout.map.width, 1e-6);
      EXPECT_NEAR((view.high - view.low).y() * 1000 / view.scale, layout.map.height, 1e-6);
      EXPECT_EQ(round_scale(view.scale), view.scale);
    }
  }
  EXPECT_EQ(round_scale(1900), 2000);
  EXPECT_EQ(round_scale(2000), 2000);
  EXPECT_EQ(round_scale(8001), 10000);
  EXPECT_EQ(round_up(21), 50);
  EXPECT_EQ(round_down(49), 20);
}

// Both are known lengths of the ground: the bar of paper is that of the cells below it.
TEST(MapView, GridAndBarFitTheScale) {
  const MapView view{{0, 0}, {400, 300}, 2000};
  EXPECT_EQ(bar_length(view), 100);   // 50 mm
  EXPECT_EQ(grid_spacing(view), 50);  // 25 mm
  const MapView small{{0, 0}, {40, 30}, 250};
  EXPECT_EQ(bar_length(small), 10);    // 40 mm, at most 50
  EXPECT_EQ(grid_spacing(small), 10);  // 40 mm
  EXPECT_EQ(spaced(1757200), "1\u202f757\u202f200");
  EXPECT_EQ(spaced(-1250.5), "-1\u202f250.5");
  EXPECT_EQ(spaced(999), "999");
  EXPECT_EQ(spaced(500000), "500\u202f000");
}

TEST(MapPlaces, KeepOneOfEachNameAndTheFenceThatStood) {
  RunFile run;
  add_box(run, {2, 2, 2}, {1, 1, 1});
  run.lines = {{"a", {{0, 0, 0}, {1, 0, 0}}, {0, 1}, false}};
  run.objects = {{"house", "building", {}, 0}};
  MapPlaces places;
  add_places(places, run);
  run.lines[0].standing = true;
  add_places(places, run);
  run.lines[0].standing = false;
  add_places(places, run);
  ASSERT_EQ(places.lines.size(), 1U);
  EXPECT_TRUE(places.lines[0].standing);
  EXPECT_EQ(places.objects.size(), 1U);
  EXPECT_EQ(places.source.size(), 3U);
}
