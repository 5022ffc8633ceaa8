// Layers in place of sections of a site file.
#include "io/geopackage_gdal.hpp"
#include "setup/section_state_gdal.hpp"
#include "setup/site_files.hpp"
#include "setup/site_layers_gdal.hpp"
#include "setups.hpp"

namespace {

using namespace talus;
using namespace talus::test;

TEST(SiteLayers, ASiteWithoutThemIsLeftAsItIs) {
  const ScratchFolder folder;
  CollectedLog log;
  Site site = site_of(folder);
  read_site_layers(log, site);
  EXPECT_TRUE(site.layers_file.empty());
  EXPECT_TRUE(log.notes.empty());
}

TEST(SiteLayers, AFileThatIsNotThereIsRefused) {
  const ScratchFolder folder;
  CollectedLog log;
  Site site = site_of(folder, "[site]\nlayers = 'no.gpkg'\n");
  EXPECT_HOLDS(refusal_of([&] { read_site_layers(log, site); }), "there is no file");
}

// A layer `fences` of lines at these x, with a field.
void write_fences(const std::string& path, const std::string& field,
                  const std::vector<std::pair<std::string, double>>& named_values,
                  const std::string& layer = "fences") {
  VectorLayer fences{layer, "", GeometryType::line, {{"name", FieldType::text}, {field}}, {}, ""};
  double x = 500060;
  for (const auto& [name, value] : named_values) {
    fences.features.push_back({{Vec3(x, 5000010, 0), Vec3(x, 5000090, 0)}, {}, {}, {name, value}});
    x += 5;
  }
  write_geopackage(path, slope_trn().crs_wkt, {fences});
}

struct LayersOfSite : testing::Test {
  ScratchFolder folder;
  CollectedLog log;
  Site site = site_of(folder, "[site]\nlayers = 'site.gpkg'\n");
  std::string refusal() {
    return refusal_of([&] { read_site_layers(log, site); });
  }
};

TEST_F(LayersOfSite, EachNameIsASection) {
  write_fences(folder.file("site.gpkg"), "height_m", {{"low", 3}, {"high", 5}});
  read_site_layers(log, site);
  ASSERT_EQ(site.fences.size(), 2u);
  EXPECT_EQ(site.fences[0].name, "low");
  EXPECT_EQ(site.fences[1].height_m, 5);
  EXPECT_EQ(site.layers_file, "site.gpkg");
  EXPECT_EQ(files_named(site).back(), folder.file("site.gpkg"));
}

TEST_F(LayersOfSite, MisspeltFieldsNamesAndLayersAreRefused) {
  write_fences(folder.file("site.gpkg"), "heigth_m", {{"low", 3}});
  EXPECT_HOLDS(refusal(), "has a field heigth_m that is not a key");
  write_fences(folder.file("site.gpkg"), "height_m", {{"low one", 3}});
  EXPECT_HOLDS(refusal(), "has the name \"low one\"");
  write_fences(folder.file("site.gpkg"), "height_m", {{"low", 3}}, "fencs");
  EXPECT_HOLDS(refusal(), "did you mean fences?");
  write_fences(folder.file("site.gpkg"), "height_m", {{"low", 3}}, "heights");
  EXPECT_HOLDS(refusal(), "has none of the layers that stand for sections");
  EXPECT_TRUE(log.has(Severity::info, "layers that stand for no section: heights"));
}

TEST_F(LayersOfSite, FeaturesOfOneSectionDoNotContradictEachOther) {
  write_fences(folder.file("site.gpkg"), "height_m", {{"low", 3}, {"low", 5}});
  EXPECT_HOLDS(refusal(), "height_m is 5");
}

TEST(SiteFiles, AreThoseThatKeysName) {
  const ScratchFolder folder;
  const Site site = site_of(folder,
                            "[terrain]\nground_raster = 'classes.asc'\n[ground.b]\npolygon_file = "
                            "'areas.gpkg|layername=b'\nraster_values = [1]\n[forest.c]\n"
                            "nrtrees_raster = '/vsizip/trees.zip/n.asc'\n");
  const std::vector<std::string> files = files_named(site);
  EXPECT_EQ(std::count(files.begin(), files.end(), folder.file("classes.asc")), 1);
  EXPECT_EQ(std::count(files.begin(), files.end(), folder.file("areas.gpkg")), 1);
  EXPECT_EQ(unquoted("'a'"), "a");
  EXPECT_EQ(unquoted("a"), "a");
}

TEST(SectionState, ChangesWithTheValuesAndTheFilesOfItsSectionsAlone) {
  const ScratchFolder folder;
  folder.write("a.geojson", geojson_of({"Point|[500060,5000050]|"}));
  const std::string object = "[object.a]\nfile = 'a.geojson'\nradius_m = 3\n";
  const auto state = [&](const std::string& sections) {
    return section_state(site_of(folder, sections), {"object"});
  };
  const std::string first = state(object);
  EXPECT_EQ(state(object + "[fence.low]\nactive = false\n"), first);
  EXPECT_NE(state("[object.a]\nfile = 'a.geojson'\nradius_m = 4\n"), first);
  folder.write("a.geojson", geojson_of({"Point|[500061,5000050]|"}));
  EXPECT_NE(state(object), first);
}

}  // namespace
