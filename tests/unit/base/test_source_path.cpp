// Names of sources: files, archives, layers, filters, quoting.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "base/error.hpp"
#include "base/source_path.hpp"

namespace {

using namespace talus;
namespace fs = std::filesystem;

std::string touched(const std::string& name) {
  const fs::path folder = fs::temp_directory_path() / "talus_source_path";
  fs::create_directories(folder);
  std::ofstream(folder / name) << "x";
  return (folder / name).string();
}

}  // namespace

TEST(SourcePath, APlainNameIsTheFile) {
  const SourcePath path = parse_source_path("maps/a.gpkg");
  EXPECT_EQ(path.file, "maps/a.gpkg");
  EXPECT_EQ(path.source, "maps/a.gpkg");
  EXPECT_EQ(path.inside, "");
}

TEST(SourcePath, PartsThatQgisWritesAreLayerAndFilter) {
  const SourcePath path = parse_source_path(
      "a.gpkg|layername=index|geometrytype=LineString|subset=\"E\" = '|layerid=3'");
  EXPECT_EQ(path.file, "a.gpkg");
  EXPECT_EQ(path.layer, "index");
  EXPECT_EQ(path.layer_id, "");
  EXPECT_EQ(path.subset, "\"E\" = '|layerid=3'");
  EXPECT_EQ(path.inside.rfind("|layername=index|", 0), 0u);
  EXPECT_EQ(parse_source_path("a.dxf|LAYERID=0").layer_id, "0");
}

TEST(SourcePath, AnOptionOfADriverIsRefused) {
  EXPECT_THROW(static_cast<void>(parse_source_path("a.gpkg|option:LIST_ALL_TABLES=YES")),
               InputError);
}

TEST(SourcePath, AFileWithABarInItsNameIsThatFile) {
  const std::string name = touched("odd|layername=a.gpkg");
  EXPECT_EQ(parse_source_path(name).file, name);
  EXPECT_EQ(parse_source_path(name).layer, "");
}

TEST(SourcePath, ArchivesAreLookedInto) {
  const std::string zip = touched("map.ZIP");
  EXPECT_EQ(parse_source_path(zip).file, zip);
  EXPECT_EQ(parse_source_path(zip).source, "/vsizip/" + zip);
  for (const std::string& name : {zip + "/sub/a.shp", "/vsizip/" + zip + "/sub/a.shp"}) {
    const SourcePath path = parse_source_path(name + "|layername=a");
    EXPECT_EQ(without_layer(name + "|layername=a"), name);
    EXPECT_EQ(path.file, zip);
    EXPECT_EQ(path.source, "/vsizip/" + zip + "/sub/a.shp");
    EXPECT_EQ(path.inside, "/sub/a.shp|layername=a");
    EXPECT_EQ(path.layer, "a");
  }
  const std::string tar = touched("map.tar.gz"), packed = touched("points.csv.gz");
  EXPECT_EQ(parse_source_path(tar).source, "/vsitar/" + tar);
  EXPECT_EQ(parse_source_path(packed).source, "/vsigzip/" + packed);
}

TEST(SourcePath, HintsNameTheSourceAsWordsOfACommand) {
  EXPECT_EQ(command_words("a.gpkg"), "a.gpkg");
  EXPECT_EQ(command_words("my map.gpkg|layername=in dex|subset=k = 'a'"),
            "'my map.gpkg' 'in dex' -where 'k = '\\''a'\\'''");
}

TEST(SourcePath, AVirtualPathWithoutAFileStaysOne) {
  const SourcePath path = parse_source_path("/vsizip//vsicurl/https://example.org/a.zip/a.shp");
  EXPECT_EQ(path.file, "/vsizip//vsicurl/https://example.org/a.zip/a.shp");
  EXPECT_EQ(path.source, path.file);
}
