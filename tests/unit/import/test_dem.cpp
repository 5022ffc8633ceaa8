// Elevation rasters: reading, writing, refusals, reprojection.
#include <gdal_priv.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "base/random.hpp"
#include "base/sha256.hpp"
#include "import/dem_gdal.hpp"
#include "import/site_rasters_gdal.hpp"
#include "io/crs_gdal.hpp"
#include "io/judged_heights_gdal.hpp"
#include "io/trn_file_gdal.hpp"

namespace {

using talus::Trn;

// A folder of the test's own, gone afterwards.
class Raster : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  [[nodiscard]] std::string path(const std::string& name) const { return folder_ + "/" + name; }

 private:
  std::string folder_ = testing::TempDir() + "talus_raster_" + std::to_string(::getpid());
};

Trn random_trn(int n_rows, int n_cols) {
  talus::Random random(7, "raster");
  std::vector<double> z;
  for (int i = 0; i < n_rows * n_cols; ++i)
    z.push_back(random.uniform() < 0.1 ? std::nan("") : random.uniform(-90, 90));
  return talus::make_trn({n_rows, n_cols, 4.997678230579, {248362.7612662384, 351760.3630344}},
                         talus::crs_from_user("EPSG:31287", "--crs"), z);
}

TEST_F(Raster, ATrnReadsBackAsItWasWritten) {
  for (const auto& [rows, cols] : {std::pair(3, 4), std::pair(300, 517)}) {
    const Trn written = random_trn(rows, cols);
    talus::write_trn(path("trn.tif"), written, {{{"RUN_ID", "abc"}}});
    const Trn read = talus::read_trn(path("trn.tif"));
    EXPECT_EQ(read.n_rows, rows);
    EXPECT_EQ(read.n_cols, cols);
    EXPECT_EQ(read.cell_size, written.cell_size);
    EXPECT_EQ(read.origin, written.origin);
    EXPECT_NEAR((read.node0 - written.node0).norm(), 0, 1e-9);
    EXPECT_TRUE(talus::same_crs(read.crs_wkt, written.crs_wkt));
    ASSERT_EQ(read.elevation.size(), written.elevation.size());
    for (std::size_t i = 0; i < read.elevation.size(); ++i)
      EXPECT_TRUE(read.elevation[i] == written.elevation[i] ||
                  (std::isnan(read.elevation[i]) && std::isnan(written.elevation[i])));
  }
}

// What a dam did to the ground is read back, until other heights stand in the file.
TEST_F(Raster, ATrnKeepsItsDams) {
  Trn written = random_trn(30, 40);
  written.dams = {{"road.1", -1, {17.25, 1.0 / 3}, {41, 42, 43, 81, 1199}, "dam 5"},
                  {"two \"b\"", 1, {2}, {}, ""}};
  talus::write_trn(path("trn.tif"), written);
  const Trn read = talus::read_trn(path("trn.tif"));
  ASSERT_EQ(read.dams.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(read.dams[i].name, written.dams[i].name);
    EXPECT_EQ(read.dams[i].uphill, written.dams[i].uphill);
    EXPECT_EQ(read.dams[i].crest, written.dams[i].crest);
    EXPECT_EQ(read.dams[i].nodes, written.dams[i].nodes);
    EXPECT_EQ(read.dams[i].shape, written.dams[i].shape);
  }
  GDALDataset* const file =
      GDALDataset::Open(path("trn.tif").c_str(), GDAL_OF_RASTER | GDAL_OF_UPDATE);
  double other = 7;
  ASSERT_EQ(file->GetRasterBand(1)->RasterIO(GF_Write, 0, 0, 1, 1, &other, 1, 1, GDT_Float64, 0, 0,
                                             nullptr),
            CE_None);
  GDALClose(file);
  EXPECT_TRUE(talus::read_trn(path("trn.tif")).dams.empty());
}

TEST_F(Raster, WritingTwiceGivesTheSameBytes) {
  const Trn trn = random_trn(70, 90);
  talus::write_trn(path("a.tif"), trn);
  talus::write_trn(path("b.tif"), trn);
  EXPECT_EQ(talus::sha256_of_file(path("a.tif")), talus::sha256_of_file(path("b.tif")));
  for (const auto& file : std::filesystem::directory_iterator(path("")))
    EXPECT_EQ(file.path().extension(), ".tif");  // and nothing beside
}

// A scene of a solver test may be a plain grid without a CRS; nodes are the cell centres.
TEST_F(Raster, AGridWithoutCrsIsLocalGround) {
  std::ofstream(path("grid.asc")) << "ncols 3\nnrows 2\nxllcenter 0\nyllcenter 0\ncellsize 8\n"
                                     "NODATA_value -9999\n1 2 3\n4 5 -9999\n";
  const Trn trn = talus::read_trn(path("grid.asc"));
  EXPECT_EQ(trn.crs_wkt, "");
  EXPECT_EQ(trn.cell_size, 8);
  EXPECT_EQ(talus::frame_of(trn).north_west, talus::Vec2(0, 8));
  EXPECT_EQ(talus::node_point(trn, 1, 1).z(), 5);
  EXPECT_TRUE(std::isnan(talus::node_point(trn, 1, 2).z()));
}

// Only the window's rows and columns are touched: the raster has 10^11 cells and no data for most.
TEST_F(Raster, AWindowOfAnEnormousRasterIsRead) {
  std::ofstream(path("small.asc")) << "ncols 3\nnrows 3\nxllcorner 0\nyllcorner 0\ncellsize 1\n"
                                      "1 2 3\n4 5 6\n7 8 9\n";
  std::ofstream(path("large.vrt"))
      << R"(<VRTDataset rasterXSize="400000" rasterYSize="300000"><GeoTransform>0,1,0,300000,0,-1)"
      << R"(</GeoTransform><VRTRasterBand dataType="Float32" band="1"><NoDataValue>-9999</NoDataValue>)"
      << R"(<SimpleSource><SourceFilename relativeToVRT="1">small.asc</SourceFilename><SourceBand>1)"
      << R"(</SourceBand><SrcRect xOff="0" yOff="0" xSize="3" ySize="3"/><DstRect xOff="200000" )"
      << R"(yOff="100000" xSize="3" ySize="3"/></SimpleSource></VRTRasterBand></VRTDataset>)";
  talus::DemOptions options;
  options.crs_may_be_missing = true;
  const talus::DemFile dem(path("large.vrt"), options);
  const talus::MapWindow window{199'999.5, 199'996.5, 200'003.5, 200'000.5};
  const talus::GridFrame frame = talus::frame_on_dem(dem.frame(), 0, window);
  EXPECT_EQ(frame.n_cols, 5);
  const std::vector<double> z = talus::read_dem(dem, frame);
  EXPECT_TRUE(std::isnan(z[0]));
  EXPECT_EQ(z[6], 1);
  EXPECT_EQ(z[18], 9);
}

TEST_F(Raster, ScaleAndOffsetAreApplied) {
  std::ofstream(path("raw.asc")) << "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n"
                                    "NODATA_value -9999\n1000 -9999\n3000 2000\n";
  std::ofstream(path("scaled.vrt"))
      << R"(<VRTDataset rasterXSize="2" rasterYSize="2"><GeoTransform>0,1,0,2,0,-1</GeoTransform>)"
      << R"(<VRTRasterBand dataType="Float32" band="1"><NoDataValue>-9999</NoDataValue>)"
      << R"(<Offset>100</Offset><Scale>0.1</Scale><SimpleSource><SourceFilename relativeToVRT="1">)"
      << R"(raw.asc</SourceFilename><SourceBand>1</SourceBand></SimpleSource></VRTRasterBand>)"
      << R"(</VRTDataset>)";
  const Trn trn = talus::read_trn(path("scaled.vrt"));
  EXPECT_EQ(trn.elevation[0], 200);
  EXPECT_EQ(trn.elevation[2], 400);
  EXPECT_EQ(trn.elevation[3], 300);
  EXPECT_TRUE(std::isnan(trn.elevation[1]));
  const auto magnitudes = talus::look_at_raster("dem", path("scaled.vrt")).magnitudes;
  ASSERT_EQ(magnitudes.size(), 1U);
  EXPECT_EQ(magnitudes[0].lowest, 200);
  EXPECT_EQ(magnitudes[0].highest, 400);
}

TEST_F(Raster, WhatCannotBeWrittenIsAnError) {
  EXPECT_THROW(talus::write_trn(path("no/such/folder.tif"), random_trn(3, 3)), talus::InputError);
  EXPECT_THROW(static_cast<void>(talus::read_trn(path("missing.tif"))), talus::InputError);
}

// A slope with a tower that no ground has, 400 m above its neighbours.
Trn tower() {
  std::vector<double> z;
  for (int i = 0; i < 20 * 30; ++i) z.push_back(i == 315 ? 1400 : 1000 + i / 30);
  z[7] = std::nan("");
  return talus::make_trn({20, 30, 5, {650'000, 5'200'000}}, "", z);
}

void copy(const std::string& from, const std::string& to, const char* driver_name) {
  GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName(driver_name);
  const GDALDatasetUniquePtr source(GDALDataset::Open(from.c_str()));
  GDALClose(driver->CreateCopy(to.c_str(), source.get(), 0, nullptr, nullptr, nullptr));
}

bool is_refused(const std::string& path) {
  try {
    static_cast<void>(talus::read_trn(path));
  } catch (const talus::InputError&) {
    return true;
  }
  return false;
}

// The writer of a TRN has judged it; the copy of another program keeps that, a change does not.
TEST_F(Raster, JudgedHeightsAreNotJudgedAgain) {
  talus::write_trn(path("judged.tif"), tower(), {{}, "level area at 1400 m"});
  EXPECT_FALSE(is_refused(path("judged.tif")));
  EXPECT_TRUE(talus::were_heights_judged(path("judged.tif")));
  EXPECT_EQ(talus::accepted_doubts(path("judged.tif")), "level area at 1400 m");
  copy(path("judged.tif"), path("copy.tif"), "GTiff");
  EXPECT_FALSE(is_refused(path("copy.tif")));
  EXPECT_EQ(talus::accepted_doubts(path("copy.tif")), "level area at 1400 m");
  double height = 1500;
  {
    const GDALDatasetUniquePtr edited(GDALDataset::Open(path("copy.tif").c_str(), GDAL_OF_UPDATE));
    ASSERT_EQ(edited->GetRasterBand(1)->RasterIO(GF_Write, 3, 3, 1, 1, &height, 1, 1, GDT_Float64,
                                                 0, 0, nullptr),
              CE_None);
  }
  EXPECT_TRUE(is_refused(path("copy.tif")));
  EXPECT_EQ(talus::accepted_doubts(path("copy.tif")), "");
}

// A scale turns the same numbers into other heights; other cells turn them into other slopes.
TEST_F(Raster, TagsOfOtherHeightsCountForNothing) {
  const auto edited = [this](const std::string& name, const auto& edit) {
    talus::write_trn(path(name), tower(), {{}, "level area at 1400 m"});
    {
      const GDALDatasetUniquePtr file(GDALDataset::Open(path(name).c_str(), GDAL_OF_UPDATE));
      edit(*file);
    }
    return is_refused(path(name)) && talus::accepted_doubts(path(name)).empty();
  };
  EXPECT_FALSE(edited("same.tif", [](GDALDataset&) {}));
  EXPECT_TRUE(edited("scaled.tif", [](GDALDataset& f) { f.GetRasterBand(1)->SetScale(1.1); }));
  EXPECT_TRUE(edited("offset.tif", [](GDALDataset& f) { f.GetRasterBand(1)->SetOffset(1); }));
  EXPECT_TRUE(
      edited("known.tif", [](GDALDataset& f) { f.GetRasterBand(1)->SetNoDataValue(1001); }));
  EXPECT_TRUE(edited("finer.tif", [](GDALDataset& f) {
    std::array<double, 6> transform = {650'000, 2, 0, 5'200'000, 0, -2};
    f.SetGeoTransform(transform.data());
  }));
  EXPECT_TRUE(edited("old.tif", [](GDALDataset& f) {
    f.SetMetadataItem("HEIGHTS_JUDGED", nullptr);
    f.SetMetadataItem("DOUBTS_ACCEPTED", "YES");
  }));
}

}  // namespace
