// Files of source names, their sidecar files, and one spelling of a path.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <string>

#include "base/file_paths.hpp"

namespace {

using namespace talus;

// A file that is not there is behind no name.
TEST(FilePaths, AFileIsFoundBehindTheNameOfASource) {
  const std::string map = testing::TempDir() + "talus_paths_map.gpkg",
                    archive = testing::TempDir() + "talus_paths_map.zip";
  std::ofstream(map) << "a";
  std::ofstream(archive) << "a";
  EXPECT_EQ(file_of(map + "|layername=a"), map);
  EXPECT_EQ(file_of("/vsizip/" + archive + "/a.shp"), archive);
  EXPECT_EQ(file_behind("GPKG:" + map + ":dgm"), map);
  EXPECT_EQ(file_behind("NETCDF:\"" + map + "\":z"), map);
  EXPECT_EQ(file_behind("GPKG:nowhere.gpkg:dgm"), "GPKG:nowhere.gpkg:dgm");
  EXPECT_EQ(file_behind(map), map);
  EXPECT_TRUE(is_virtual("/vsimem/a.tif"));
  EXPECT_FALSE(is_virtual("a.tif"));
}

TEST(FilePaths, NamesBecomeWordsOfFiles) {
  EXPECT_EQ(file_word("a b/c-1_2"), "a_b_c-1_2");
  EXPECT_EQ(folder_of("a.tif"), ".");
  EXPECT_EQ(folder_of("there/a.tif"), "there");
}

TEST(FilePaths, AShapefileHasFilesBesideIt) {
  const auto beside = sidecars_of("there/a.shp");
  EXPECT_NE(std::find(beside.begin(), beside.end(), "there/a.dbf"), beside.end());
  EXPECT_TRUE(sidecars_of("a.gpkg").empty());
}

}  // namespace
