// Forests of a site: lists, rasters, drawn stands.
#include "setup/forest_inputs_gdal.hpp"
#include "setup/forest_section.hpp"
#include "setups.hpp"

namespace {

using namespace talus;
using namespace talus::test;

const std::string polygon =
    "polygon = [[500050, 5000010], [500095, 5000010], [500095, 5000090], [500050, 5000090]]\n";
const std::string far_away =
    "polygon = [[600050, 5000010], [600095, 5000010], [600095, 5000090]]\n";
const std::string rasters =
    "nrtrees_raster = 'nrtrees.asc'\ndbhmean_raster = 'dbhmean.asc'\ndbhstd_raster = "
    "'dbhstd.asc'\n";

struct Forests : testing::Test {
  ScratchFolder folder;
  CollectedLog log;
  Trn trn = slope_trn();

  StandingForests forests(const std::string& sections) {
    return read_forests(log, site_of(folder, sections), trn, three_boxes());
  }
  StandingForests wood(const std::string& keys) { return forests("[forest.wood]\n" + keys); }
  std::string refusal(const std::string& keys) {
    return refusal_of([&] { static_cast<void>(wood(keys)); });
  }
  // Cells of 20 m as Rockyfor3D has them: two in the west and two in the east.
  void raster(const std::string& name, double in_west, double in_east, double x = 500040,
              int cell = 20) const {
    std::string rows = "ncols 4\nnrows 5\nxllcorner " + std::to_string(x) +
                       "\nyllcorner 5000000\ncellsize " + std::to_string(cell) +
                       "\nNODATA_value -9999\n";
    const std::string west = std::to_string(in_west), east = std::to_string(in_east);
    for (int r = 0; r < 5; ++r) rows += west + " " + west + " " + east + " " + east + "\n";
    folder.write(name, rows);
  }
  void usual_rasters() const {
    raster("nrtrees.asc", 2000, 0);
    raster("dbhmean.asc", 18, 18);
    raster("dbhstd.asc", 5, 5);
  }
  void list(const std::string& name, const std::string& first = R"("dbh_cm":60,"species":"oak")",
            const std::string& second_place = "[500050,5000030]") const {
    folder.write(name, geojson_of({"Point|[500060,5000050]|" + first,
                                   "Point|" + second_place + R"(|"dbh_cm":12.5,"conifer":0)",
                                   R"(Point|[400000,5000030]|"dbh_cm":20)"}));
  }
};

TEST_F(Forests, AreDrawnClearOfTheBlocksAndAlikeEachTime) {
  const std::string keys = polygon + "stems_per_ha = 1500\ndbh_mean_cm = 25\nconifer_share = 0.5\n";
  const StandingForests one = wood(keys), again = wood(keys);
  EXPECT_GT(one.stems.size(), 350u);  // 0.36 ha
  EXPECT_LT(one.stems.size(), 750u);
  ASSERT_EQ(one.stems.size(), again.stems.size());
  for (std::size_t i = 0; i < one.stems.size(); ++i)
    EXPECT_EQ(one.stems[i].foot, again.stems[i].foot);
  EXPECT_EQ(one.forests.size(), 1u);
  EXPECT_TRUE(log.has(Severity::info, "forest.wood: 1500 stems a hectare, conifers 50 %"));
  const StandingForests other = wood(keys + "new_stand_per_run = true\n");
  EXPECT_NE(other.stems[0].foot, one.stems[0].foot);
}

// A dam that moved the nodes from 60 to 70 m takes what stands from 55 to 75 m, and nothing else.
TEST_F(Forests, HaveNoStemOnADam) {
  const std::string keys = polygon + "stems_per_ha = 1500\ndbh_mean_cm = 25\n";
  const StandingForests all = wood(keys);
  ASSERT_EQ(trn.cell_size, 5);
  BurntDam dam;
  for (int row = 0; row < trn.n_rows; ++row)
    for (int col = 0; col < trn.n_cols; ++col)
      if (const double x = node_point(trn, row, col).x(); x >= 60 && x <= 70)
        dam.nodes.push_back(static_cast<int>(node_index(trn, row, col)));
  trn.dams = {dam};
  const StandingForests left = wood(keys);
  std::size_t n = 0;
  for (const Stem& stem : all.stems) {
    if (stem.foot.x() > 55 && stem.foot.x() < 75) continue;
    ASSERT_LT(n, left.stems.size());
    EXPECT_EQ(left.stems[n].id, stem.id);
    EXPECT_EQ(left.stems[n++].foot, stem.foot);
  }
  EXPECT_EQ(n, left.stems.size());
  EXPECT_LT(n, all.stems.size());
  ASSERT_FALSE(left.warnings.empty());
  EXPECT_NE(left.warnings[0].find("stand on a dam, in its ditch or on a gallery, left out"),
            std::string::npos);
}

TEST_F(Forests, OfAListStandWhereItSays) {
  list("stems.geojson");
  const StandingForests found = wood("stems_file = 'stems.geojson'\n");
  ASSERT_EQ(found.stems.size(), 2u);
  EXPECT_EQ(found.stems[0].foot.head<2>(), Vec2(60, 50));
  EXPECT_NEAR(found.stems[0].foot.z(), ground_height(60), 1e-9);
  EXPECT_DOUBLE_EQ(found.stems[0].radius, 0.3);
  EXPECT_DOUBLE_EQ(found.stems[1].radius, 0.0625);
  EXPECT_EQ(found.warnings.front(), "forest.wood: 1 of 3 stems lie off the known ground, left out");
  EXPECT_TRUE(
      log.has(Severity::info, "forest.wood: 2 stems, diameter 12.5 (12.5 to 60) cm, height 20 m"));
}

TEST_F(Forests, OfRastersStandWhereTheyHaveTrees) {
  usual_rasters();
  raster("conif.asc", 100, 0);
  const StandingForests found = wood(rasters + "conif_percent_raster = 'conif.asc'\n");
  EXPECT_NEAR(static_cast<double>(found.stems.size()), 800, 4 * std::sqrt(800.0));  // 0.4 ha
  for (const Stem& stem : found.stems) EXPECT_LT(stem.foot.x(), 80);
  EXPECT_FALSE(log.digest_of("forest.wood.nrtrees_raster").empty());
}

TEST_F(Forests, DragWithoutStems) {
  const StandingForests found = wood(polygon + "drag_kg_s = 20000\n");
  EXPECT_TRUE(found.stems.empty());
  EXPECT_EQ(found.canopies.size(), 1u);
  EXPECT_TRUE(log.has(Severity::info, "forest.wood: drag of 20000 kg/s on 0.36 ha"));
}

TEST_F(Forests, ThatAreNotActiveOrOfLawPaperDoNotStand) {
  const std::string keys = "[forest.wood]\n" + polygon + "stems_per_ha = 400\n";
  EXPECT_TRUE(forests(keys + "active = false\n").stems.empty());
  EXPECT_TRUE(forests("law = 'paper'\n" + keys).stems.empty());
}

TEST_F(Forests, KeysThatDoNotGoTogetherAreRefused) {
  usual_rasters();
  list("stems.geojson");
  EXPECT_HOLDS(refusal("stems_per_ha = 400\n"), "forest.wood: does not say where it stands");
  EXPECT_HOLDS(refusal(polygon), "does not say how many stems there are");
  EXPECT_HOLDS(refusal(polygon + "stems_per_ha = 400\nstems_file = 'stems.geojson'\n"),
               "has both stems_file and polygon");
  EXPECT_HOLDS(refusal(polygon + "stems_per_ha = 400\nnrtrees_raster = 'nrtrees.asc'\n"),
               "has both stems_per_ha and nrtrees_raster");
  EXPECT_HOLDS(refusal(rasters + "dbh_mean_cm = 30\n"), "has both dbh_mean_cm and dbhmean_raster");
  EXPECT_HOLDS(refusal(polygon + "stems_per_ha = 400\ndbhstd_raster = 'dbhstd.asc'\n"),
               "has dbhstd_raster without nrtrees_raster");
  EXPECT_HOLDS(refusal("drag_kg_s = 500\n"), "forest.wood: does not say where it drags");
  for (const char* stems :
       {"stems_per_ha = 400", "stems_file = 'stems.geojson'", "nrtrees_raster = 'nrtrees.asc'"}) {
    const std::string key = std::string(stems).substr(0, std::string(stems).find(' '));
    EXPECT_HOLDS(refusal(polygon + "drag_kg_s = 500\n" + stems + "\n"),
                 "forest.wood: has both drag_kg_s and " + key);
  }
}

TEST_F(Forests, OffTheTerrainOrWithoutAStemAreRefused) {
  EXPECT_HOLDS(refusal(far_away + "stems_per_ha = 400\n"), "forest.wood: lies outside the terrain");
  EXPECT_HOLDS(refusal(far_away + "drag_kg_s = 500\n"), "forest.wood: lies outside the terrain");
  EXPECT_HOLDS(refusal(polygon + "stems_per_ha = 0.01\n"),
               "forest.wood: has no stem on the terrain");
  raster("away.asc", 2000, 0, 700040);
  EXPECT_HOLDS(refusal("nrtrees_raster = 'away.asc'\n"), "nrtrees_raster lies outside the terrain");
}

TEST_F(Forests, RastersThatCannotBeMeantAreRefused) {
  usual_rasters();
  raster("nothing.asc", 0, 0);
  EXPECT_HOLDS(refusal("nrtrees_raster = 'nrtrees.asc'\ndbhmean_raster = 'nothing.asc'\n"),
               "dbhmean_raster is 0 where nrtrees_raster has trees");
  raster("percent.asc", 150, 150);
  EXPECT_HOLDS(refusal("nrtrees_raster = 'nrtrees.asc'\nconif_percent_raster = 'percent.asc'\n"),
               "conif_percent_raster is 150");
  raster("other.asc", 18, 18, 500040, 10);
  EXPECT_HOLDS(refusal("nrtrees_raster = 'nrtrees.asc'\ndbhmean_raster = 'other.asc'\n"),
               "has other cells than nrtrees_raster");
}

TEST_F(Forests, ListsThatCannotBeMeantAreRefused) {
  const auto refused = [&](const std::string& name) {
    return refusal("stems_file = '" + name + "'\n");
  };
  list("thin.geojson", R"("dbh_cm":0)");
  EXPECT_HOLDS(refused("thin.geojson"), "dbh_cm is 0, expected above 0");
  list("oka.geojson", R"("dbh_cm":60,"species":"oka")");
  EXPECT_HOLDS(refused("oka.geojson"), "species is oka");
  list("inside.geojson", R"("dbh_cm":60)", "[500020.5,5000030.5]");
  EXPECT_HOLDS(refused("inside.geojson"), "stands in block 0 at the start");
}

TEST_F(Forests, OnTheSameGroundAreSaidOrRefused) {
  const std::string drawn = "[forest.wood]\n" + polygon + "stems_per_ha = 1500\n";
  static_cast<void>(forests(drawn + "[forest.again]\n" + polygon + "stems_per_ha = 1500\n"));
  EXPECT_TRUE(log.has_warning(
      "forest.again: 100 % of its area lies in forest.wood: there the stems of both stand"));
  const std::string half =
      "polygon = [[500070, 5000010], [500110, 5000010], [500110, 5000090], [500070, 5000090]]\n";
  CollectedLog undergrowth;
  static_cast<void>(read_forests(
      undergrowth, site_of(folder, drawn + "[forest.fog]\n" + half + "drag_kg_s = 250\n"), trn,
      three_boxes()));
  EXPECT_FALSE(undergrowth.has_warning("lies in")) << "undergrowth below stems is no second stand";
  list("stems.geojson");
  EXPECT_HOLDS(refusal_of([&] {
                 static_cast<void>(
                     forests("[forest.a]\nstems_file = 'stems.geojson'\n[forest.b]\n"
                             "stems_file = 'stems.geojson'\n"));
               }),
               "forest.b: has a stem where forest.a has one, at 500060, 5000050");
}

struct Magnitudes : Forests {
  // Eight stems of `diameter` and one of 30 cm.
  std::string of(double diameter) {
    std::vector<std::string> stems = {R"(Point|[500060,5000030]|"dbh_cm":30)"};
    for (int row = 1; row <= 8; ++row)
      stems.push_back("Point|[500060," + std::to_string(5000030 + 5 * row) + R"(]|"dbh_cm":)" +
                      std::to_string(diameter));
    folder.write("list.geojson", geojson_of(stems));
    return refusal("stems_file = 'list.geojson'\n");
  }
};

TEST_F(Magnitudes, ShowAUnitThatWasNotMeant) {
  EXPECT_HOLDS(of(0.35),
               "half of the stems are thinner than 0.35 cm (0.35 to 30); read as metres "
               "it would be 35 cm");
  EXPECT_HOLDS(of(350),
               "half of the stems are thicker than 350 cm (30 to 350); read as "
               "millimetres it would be 35 cm");
  EXPECT_EQ(of(1.2), "accepted");
  EXPECT_TRUE(log.has_warning("forest.wood: half of the stems are thinner than 1.2 cm"));
  const std::string stand = polygon + "stems_per_ha = 400\n";
  EXPECT_HOLDS(refusal(stand + "dbh_mean_cm = 0.3\ndbh_std_cm = 0.05\n"), "that is not a forest");
  EXPECT_HOLDS(refusal(stand + "height_m = 250\n"), "has trees of 250 m, expected up to 130");
}

TEST_F(Magnitudes, OfRastersToo) {
  usual_rasters();
  raster("metres.asc", 0.18, 0.18);
  EXPECT_HOLDS(refusal("nrtrees_raster = 'nrtrees.asc'\ndbhmean_raster = 'metres.asc'\n"),
               "holds diameters at breast height in centimetres");
  raster("shares.asc", 0.8, 0);
  EXPECT_HOLDS(refusal(rasters + "conif_percent_raster = 'shares.asc'\n"),
               "has a conif_percent_raster of 0.8 %, in no cell more than 1 %");
  raster("cells.asc", 16, 0);
  EXPECT_EQ(refusal("nrtrees_raster = 'cells.asc'\n"), "accepted");
  EXPECT_TRUE(log.has_warning(
      "nrtrees_raster has 16 stems a hectare: are they stems a cell? Then there are 400"));
}

TEST(MapBox, IsEmptyUntilItHoldsAnArea) {
  MapBox box;
  EXPECT_TRUE(box.is_empty());
  box.add({1, 2});
  EXPECT_TRUE(box.is_empty());
  box.add({3, 4});
  EXPECT_FALSE(box.is_empty());
}

}  // namespace
