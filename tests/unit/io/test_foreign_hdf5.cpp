// HDF5 files of others whose values stand in another file.
#include <gtest/gtest.h>
#include <hdf5.h>

#include <array>
#include <fstream>

#include "base/error.hpp"
#include "io/foreign_hdf5.hpp"
#include "io/raster_gdal.hpp"

namespace talus {
namespace {

constexpr hsize_t n_rows = 4, n_cols = 5;

void add_set(hid_t file, const char* name, hid_t list) {
  const std::array<hsize_t, 2> extent = {n_rows, n_cols};
  const hid_t space = H5Screate_simple(2, extent.data(), nullptr);
  const hid_t set = H5Dcreate2(file, name, H5T_IEEE_F32LE, space, H5P_DEFAULT, list, H5P_DEFAULT);
  ASSERT_GE(set, 0);
  const std::array<float, n_rows* n_cols> values = {};
  ASSERT_GE(H5Dwrite(set, H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0);
  H5Dclose(set);
  H5Sclose(space);
}

std::string refusal_of(const std::string& raster) {
  try {
    DemOptions options;
    options.crs_may_be_missing = true;
    const DemFile file(raster, options);
    return "";
  } catch (const InputError& error) {
    return error.what();
  }
}

struct ForeignHdf5 : testing::Test {
  // of each test its own: they run side by side
  std::string path =
      testing::TempDir() + testing::UnitTest::GetInstance()->current_test_info()->name() + ".h5";
  hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
};

TEST_F(ForeignHdf5, OwnValuesAreRead) {
  add_set(file, "heights", H5P_DEFAULT);
  H5Lcreate_soft("heights", file, "again", H5P_DEFAULT, H5P_DEFAULT);
  H5Fclose(file);
  EXPECT_EQ(kept_in_another_file(path), "");
  // GDAL's name for it holds "://", which is no network
  EXPECT_NE(refusal_of("HDF5:\"" + path + "\"://heights").find("no geotransform"),
            std::string::npos);
}

TEST_F(ForeignHdf5, RawBytesOfAnotherFileAreFound) {
  const hid_t list = H5Pcreate(H5P_DATASET_CREATE);
  const std::string raw = path + ".raw";
  H5Pset_external(list, raw.c_str(), 0, n_rows * n_cols * sizeof(float));
  const hid_t group = H5Gcreate2(file, "deep", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  add_set(group, "heights", list);
  H5Pclose(list);
  H5Gclose(group);
  H5Fclose(file);
  EXPECT_EQ(kept_in_another_file(path), "deep/heights");
  for (const std::string& name :
       {"HDF5:\"" + path + "\"://deep/heights", "NETCDF:\"" + path + "\":/deep/heights"})
    EXPECT_NE(refusal_of(name).find("deep/heights"), std::string::npos) << refusal_of(name);
}

TEST_F(ForeignHdf5, ALinkToAnotherFileIsFound) {
  H5Lcreate_external("other.h5", "/heights", file, "heights", H5P_DEFAULT, H5P_DEFAULT);
  H5Fclose(file);
  EXPECT_EQ(kept_in_another_file(path), "heights");
}

TEST_F(ForeignHdf5, OtherFilesAreNone) {
  H5Fclose(file);
  std::ofstream(path) << "ncols 4\n";
  EXPECT_EQ(kept_in_another_file(path), "");
  EXPECT_EQ(kept_in_another_file(path + ".missing"), "");
}

}  // namespace
}  // namespace talus
