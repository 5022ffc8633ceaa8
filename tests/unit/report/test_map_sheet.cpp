#include <gtest/gtest.h>

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

TEST(MapSheet, ZeroIsTheNorthWestCorner) {
  const MapSheet sheet = sheet_of_a_plane();
  const Vec2 corner(sheet.ground.view.low.x(), sheet.ground.view.high.y());
  EXPECT_EQ(on_sheet(sheet, corner), Vec2(0, 0));
  EXPECT_EQ(sheet_path(sheet, {corner, corner + Vec2(2.5, -1)}, false), "M0 0L2.5 1");
}

TEST(MapSheet, GroundAndPlacesAreDrawnOnceForAllMaps) {
  MapSheet sheet = sheet_of_a_plane();
  sheet.source = {{{60, 90}, {64, 90}, {64, 94}}};
  sheet.objects = {{"house <1>", "house", {{{{60, 90}, {64, 90}, {64, 94}}, true}}, 0},
                   {"road", "road", {{{{42, 80}, {88, 80}}, false}}, 3},
                   {"mast", "mast", {{{{70, 95}}, false}}, 2}};
  sheet.lines = {record_line("lower", {{60, 85, 0}, {80, 85, 0}})};
  const std::string once = sheet_definitions(talus::testing::shipped_texts(), sheet);
  for (const char* part :
       {"id=\"map-ground\"", "id=\"map-places\"", "class=\"contour five\"", "class=\"level\"",
        "class=\"grid\"", "class=\"source\"", "class=\"object\" d=\"", "house &lt;1&gt;</title>",
        "class=\"object line\" d=\"", "<circle class=\"object\"", "r=\"2\"",
        "line lower without a fence</title>"})
    EXPECT_NE(once.find(part), std::string::npos) << part;
  EXPECT_EQ(once.find("nan"), std::string::npos);
  const std::string map = sheet_svg(sheet, "", "speed");
  EXPECT_EQ(map.find("contour"), std::string::npos);
  EXPECT_NE(map.find("href=\"#map-places\""), std::string::npos);
}

TEST(CellsSvg, LiesWhereItsCellsAre) {
  const MapSheet sheet = sheet_of_a_plane();
  CellPicture cells;
  cells.png = "png";
  cells.corner = Vec2(sheet.ground.view.low.x(), sheet.ground.view.high.y()) + Vec2(4, -6);
  cells.cell_size = 2;
  cells.n_cols = 5;
  cells.n_rows = 3;
  const std::string without = cells_svg(sheet, cells, "speed", "m/s");
  EXPECT_NE(without.find("x=\"4\" y=\"6\" width=\"10\" height=\"6\""), std::string::npos);
  EXPECT_EQ(without.find("<script"), std::string::npos);
  cells.values = "values";
  cells.labels = {{2, "a </script>"}};
  const std::string with = cells_svg(sheet, cells, "speed", "m/s");
  EXPECT_NE(with.find("\"x\":4,\"y\":6,\"cell\":2,\"n_cols\":5,\"n_rows\":3,\"unit\":\"m/s\""),
            std::string::npos);
  EXPECT_EQ(with.find("</script>"), with.rfind("</script>")) << "a label ends the script";
}
