// Shapes of a site: points, files, imported data.
#include "import/canonical_gdal.hpp"
#include "setup/site_shapes_gdal.hpp"
#include "setups.hpp"

namespace {

using namespace talus;
using namespace talus::test;

struct SiteShapes : testing::Test {
  ScratchFolder folder;
  CollectedLog log;
  Trn trn = slope_trn();
};

TEST_F(SiteShapes, PointsOfTheSiteFileBecomeLocal) {
  const auto points = local_points(log, site_of(folder), trn, {Vec3(500012, 5000034, 7)}, "a", "b");
  EXPECT_EQ(points[0], Vec3(12, 34, 7));
  EXPECT_TRUE(log.contents.empty());
}

TEST_F(SiteShapes, PointsInAnotherCrsAreReprojectedAndCount) {
  const Site site = site_of(folder, "[site]\ncrs = 'EPSG:25832'\n");
  const auto points = local_points(log, site, trn, {Vec3(500012, 5000034, 7)}, "a", "b");
  EXPECT_NEAR((points[0] - Vec3(12, 34, 7)).norm(), 0, 2);
  EXPECT_FALSE(log.digest_of("a.b").empty());
  EXPECT_TRUE(log.has(Severity::record, "a.b: "));
}

TEST_F(SiteShapes, ExchangedCoordinatesAreRefused) {
  EXPECT_HOLDS(refusal_of([&] {
                 static_cast<void>(
                     local_points(log, site_of(folder), trn, {Vec3(5000034, 500012, 0)}, "a", "b"));
               }),
               "with x and y exchanged they would lie in it");
}

TEST_F(SiteShapes, PointsOfTheSiteFileAreLayersAsThoseOfFiles) {
  const Site site = site_of(folder,
                            "[site]\ncrs = 'EPSG:25832'\n"
                            "[source]\npolygon = [[500010, 5000010], [500030, 5000010], "
                            "[500030, 5000030]]\n[fence.low]\nline = [[500060, 5000010], "
                            "[500060, 5000090]]\n");
  InputsRequest request;
  request.layers = layers_of(site);
  request.has_frame = true;
  request.frame = trn.crs_wkt;
  ImportReading reading;
  const Imported inputs = import_inputs(request, reading);
  ASSERT_EQ(inputs.shapes.size(), 2u);
  EXPECT_EQ(inputs.shapes[0].role, "source");
  EXPECT_NEAR(inputs.shapes[0].area_m2, 200, 0.1);
  EXPECT_EQ(inputs.shapes[1].role, "fence.low");
  const auto local = local_shapes(log, site, trn, place_of(site.fences[0])).shapes[0];
  for (std::size_t i = 0; i < local.size(); ++i)
    EXPECT_EQ(local[i].head<2>(), (inputs.shapes[1].shapes[0][i] - trn.origin).head<2>());
}

// Two fences and a stand of trees of the same site, as talus-import writes them.
struct ImportedSite : SiteShapes {
  Site site;
  std::string inputs;

  void SetUp() override {
    folder.write("low.geojson", geojson_of({"LineString|[[500060,5000010],[500060,5000090]]|"}));
    folder.write("high.geojson", geojson_of({"LineString|[[500080,5000010],[500080,5000090]]|"}));
    folder.write("stems.geojson", geojson_of({"Point|[500040,5000030]|\"dbh_cm\":41.5",
                                              "Point|[500050,5000030]|\"dbh_cm\":30"}));
    site = site_of(folder,
                   "[fence.low]\nfile = 'low.geojson'\n"
                   "[fence.high]\nfile = 'high.geojson'\n"
                   "[forest.wood]\nstems_file = 'stems.geojson'\n");
    InputsRequest request;
    request.layers = layers_of(site);
    request.has_frame = true;
    request.frame = trn.crs_wkt;
    ImportReading reading;
    inputs = (std::filesystem::path(site.folder) / "inputs.gpkg").string();
    write_canonical(inputs, request, import_inputs(request, reading), reading);
  }
  std::vector<std::vector<Vec3>> fence(int index) {
    return local_shapes(log, site, trn, place_of(site.fences[index])).shapes;
  }
};

TEST_F(ImportedSite, SectionsOfOneLayerAreReadApartAndAreThoseOfTheirFiles) {
  const auto low = fence(0), high = fence(1);
  const std::string before = log.digest_of("fence.high");
  const VectorShapes stems = local_shapes(log, site, trn, stems_of(site.forests[0]));
  log.contents.clear();
  site.inputs = inputs;
  const auto plan = [](const std::vector<std::vector<Vec3>>& lines) {
    std::vector<Vec2> points;
    for (const Vec3& p : lines.at(0)) points.push_back(p.head<2>());
    return points;
  };
  EXPECT_EQ(plan(fence(0)), plan(low));
  EXPECT_EQ(plan(fence(1)), plan(high));
  EXPECT_EQ(log.digest_of("fence.high"), before);
  EXPECT_TRUE(log.has(Severity::info, "inputs.gpkg: layer fences where source = 2, 1 line"));
  EXPECT_EQ(local_shapes(log, site, trn, stems_of(site.forests[0])).attributes, stems.attributes);
}

TEST_F(ImportedSite, AFileThatChangedSinceIsRefusedAndAnotherOneIsReadItself) {
  site.inputs = inputs;
  folder.write("low.geojson", geojson_of({"LineString|[[500070,5000010],[500070,5000090]]|"}));
  EXPECT_HOLDS(refusal_of([&] { static_cast<void>(fence(0)); }), "is older than low.geojson");
  site.fences[1].file = "low.geojson";
  EXPECT_EQ(fence(1)[0][0].x(), 70);
}

TEST_F(ImportedSite, AnotherSystemThanThatOfTheTerrainLeavesTheFilesToBeRead) {
  site.inputs = inputs;
  trn.crs_wkt = crs_from_user("EPSG:25832", "--crs");
  static_cast<void>(fence(0));
  EXPECT_TRUE(log.has(Severity::info, "low.geojson: layer low, 1 line"));
}

}  // namespace
