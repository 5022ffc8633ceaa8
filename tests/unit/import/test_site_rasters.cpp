// Rasters of a site: classes under cells, systems, refusals.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "import/site_rasters_gdal.hpp"
#include "io/crs_gdal.hpp"
#include "io/trn_file_gdal.hpp"
#include "terrain/grid_frame.hpp"

namespace {

using talus::no_class;
using talus::Trn;

// A raster file of whole numbers in a folder of the test's own.
class ClassRaster : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string write(double cell_size, const talus::Vec2& first, int n_rows, int n_cols,
                    const std::vector<double>& value, const std::string& crs = "EPSG:31287") {
    const std::string path = folder_ + "/classes.tif";
    talus::write_trn(path, talus::make_trn({n_rows, n_cols, cell_size, first},
                                           talus::crs_from_user(crs, "--crs"), value));
    return path;
  }

  std::vector<talus::Doubt> doubts;

  // 4 x 6 cells of 5 m, the north-west corner at (248000, 351000).
  static Trn terrain() {
    return talus::make_trn({5, 7, 5, {248000, 351000}}, talus::crs_from_user("EPSG:31287", "--crs"),
                           std::vector<double>(35, 100));
  }

 private:
  std::string folder_ = testing::TempDir() + "talus_classes_" + std::to_string(::getpid());
};

// Pixels of 10 m whose corner lies 10 m east of the terrain's: the first two columns of cells see
// none, the rest the pixel that holds their centre; the unknown pixel and cells to the south too.
TEST_F(ClassRaster, GivesTheValueUnderEachCellsCentre) {
  const double nan = std::nan("");
  const std::string path =
      write(10, {248015, 350995}, 1, 2, {7, nan});  // pixel centres: rows 0-1, columns 2-3 and 4-5
  const std::vector<std::int32_t> classes = talus::read_cell_classes(path, terrain(), doubts);
  ASSERT_EQ(classes.size(), 24u);
  for (int row = 0; row < 4; ++row)
    for (int col = 0; col < 6; ++col)
      EXPECT_EQ(classes[static_cast<std::size_t>(6 * row + col)],
                row < 2 && (col == 2 || col == 3) ? 7 : no_class)
          << row << " " << col;
}

// Classes have no heights: a terrain that says its system of heights takes a raster in its plan.
// The hint for another plan changes no value.
TEST_F(ClassRaster, FitsATerrainInTheSamePlan) {
  Trn ground = terrain();
  ground.crs_wkt = talus::crs_from_user("EPSG:31287+5773", "--crs");
  const std::string path = write(10, {248005, 350995}, 1, 1, {1});
  EXPECT_EQ(talus::read_cell_classes(path, ground, doubts)[0], 1);
  try {
    (void)talus::read_cell_classes(write(10, {248005, 350995}, 1, 1, {1}, "EPSG:32632"), ground,
                                   doubts);
    FAIL() << "accepted";
  } catch (const talus::InputError& error) {
    EXPECT_NE(error.hint().find(
                  "gdalwarp -r near -novshift -ot Int32 -dstnodata -2147483648 -t_srs EPSG:31287 "),
              std::string::npos)
        << error.hint();
  }
}

TEST_F(ClassRaster, RefusesOtherSystemsAndFractions) {
  EXPECT_THROW((void)talus::read_cell_classes(write(10, {248005, 350995}, 1, 1, {1}, "EPSG:32632"),
                                              terrain(), doubts),
               talus::InputError);
  EXPECT_THROW(
      (void)talus::read_cell_classes(write(10, {248005, 350995}, 1, 1, {1.5}), terrain(), doubts),
      talus::InputError);
  EXPECT_THROW((void)talus::read_cell_classes("/no/such/file.tif", terrain(), doubts),
               talus::InputError);
}

}  // namespace
