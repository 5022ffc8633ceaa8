// Cells and ground of maps as SVG.
#include <gtest/gtest.h>

#include "base/text.hpp"
#include "report/map_sheet.hpp"
#include "unit/post/run_maker.hpp"
#include "unit/report/shipped_texts.hpp"

using namespace talus;

namespace {

// A frame of the page around 100 m x 78 m, on ground that rises by half a metre a metre.
MapSheet sheet_of_a_plane() {
  const Trn trn = talus::testing::plane_trn(0.5, 2, 101, 101);
  const PageLayout layout = layout_of(PageSize::a4);
  MapSheet sheet;
  sheet.ground = map_ground(trn, layout, view_of(layout, {40, 80}, {90, 120}));
  sheet.origin = {1000, 2000};
  return sheet;
}

}  // namespace

TEST(MapSheet, GroundAndPlacesAreDrawnOnceForAllMaps) {
  MapSheet sheet = sheet_of_a_plane();
  sheet.places.source = {{{60, 90}, {64, 90}, {64, 94}}};
  sheet.places.objects = {{"house <1>", "house", {{{{60, 90}, {64, 90}, {64, 94}}, true}}, 0},
                          {"road", "road", {{{{42, 80}, {88, 80}}, false}}, 3},
                          {"mast", "mast", {{{{70, 95}}, false}}, 2}};
  sheet.places.lines = {record_line("lower", {{60, 85, 0}, {80, 85, 0}})};
  const std::string once = sheet_definitions(talus::testing::shipped_texts(), sheet);
  for (const char* part : {"id=\"map-ground\"", "<image ", "id=\"map-places\"",
                           "house &lt;1&gt;</title>", ">house &lt;1&gt;</text>", ">road</text>",
                           ">mast</text>", "line lower without a fence</title>", ">N</text>"})
    EXPECT_NE(once.find(part), std::string::npos) << part;
  EXPECT_EQ(once.find("nan"), std::string::npos);
  const std::string map = sheet_svg(sheet, "", "speed");
  EXPECT_EQ(map.find("<path"), std::string::npos);
  EXPECT_NE(map.find("href=\"#map-places\""), std::string::npos);
}

// 4 m to the east and 6 m to the south of the corner, on a map of 1 : scale in pixels of 1/96 inch.
TEST(CellsSvg, LiesWhereItsCellsAre) {
  const MapSheet sheet = sheet_of_a_plane();
  const MapView& view = sheet.ground.view;
  CellPicture picture;
  MapCells& cells = picture.cells;
  cells.grid = {Vec2(view.low.x(), view.high.y()) + Vec2(4, -6), 2, 3, 5};
  cells.value.assign(15, 1);
  cells.style.classes = {{2, {200, 0, 0, 255}, "one"}};
  const std::string without = cells_svg(sheet, picture, "speed", "m/s");
  const double metre = 1000 / view.scale * 96 / 25.4;
  const std::string place = "matrix(" + text(2 * metre, 8) + ",0,0," + text(2 * metre, 8) + "," +
                            text(4 * metre, 8) + "," + text(6 * metre, 8) + ")";
  std::string dense = without;  // Cairo sets blanks or not
  std::erase(dense, ' ');
  EXPECT_NE(dense.find(place), std::string::npos) << place << without;
  EXPECT_EQ(without.find("<script"), std::string::npos);
  picture.values = "values";
  picture.labels = {{2, "a </script>"}};
  const std::string with = cells_svg(sheet, picture, "speed", "m/s");
  EXPECT_NE(
      with.find("{\"x\":" + text(4 * metre, 9) + ",\"y\":" + text(6 * metre, 9) +
                ",\"cell\":" + text(2 * metre, 9) + ",\"n_cols\":5,\"n_rows\":3,\"unit\":\"m/s\""),
      std::string::npos);
  EXPECT_EQ(with.find("</script>"), with.rfind("</script>")) << "a label ends the script";
}
