// Block sets as HDF5: reading back, equal bytes, damage.
#include <gtest/gtest.h>
#include <hdf5.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>

#include "base/error.hpp"
#include "base/random.hpp"
#include "base/sha256.hpp"
#include "io/blocks_hdf5.hpp"
#include "io/seal.hpp"

namespace {

using namespace talus;

BlockSet some_blocks() {
  BlockSet set;
  set.origin = Vec3(248400, 351600, 1600);
  set.crs_wkt = "LOCAL_CS[\"x\"]";
  set.content_hash = "abc";
  set.material_names = {"gneiss", "a longer name"};
  set.joint_set_names = {"J1"};
  for (int k = 0; k < 60; ++k)
    add_body(set, {{box({2.0 * k, 0, 0}, {2.0 * k + 1, 1, 1 + 0.01 * k}, k % 2 ? 0 : face_terrain)},
                   {},
                   k % 2,
                   Vec3(k, 0, 1),
                   Vec3(0, 0.5, 0)});
  add_body(set, {{box({0, 5, 0}, {1, 6, 1}, -1), box({1, 5, 0}, {2, 6, 1}, -1)},
                 {},
                 0,
                 {0, 0, 0},
                 {0, 0, 0}});
  set.pair_blocks = {{0, 1}, {3, 60}};
  set.pair_joint_set = {0, -3};
  set.pair_area = {1.5, 2};
  set.pair_normal = {Vec3::UnitX(), Vec3::UnitZ()};
  set.pair_point = {Vec3(1, 2, 3), Vec3(4, 5, 6)};
  return set;
}

std::string scratch(const std::string& name) {
  return (std::filesystem::temp_directory_path() / ("talus_blocks_" + name)).string();
}

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream out;
  out << file.rdbuf();
  return out.str();
}

}  // namespace

TEST(BlocksHdf5, ReadsBackWhatWasWritten) {
  const std::string path = scratch("same.h5");
  const BlockSet set = some_blocks();
  write_blocks(path, set, {{"RUN_ID", "7"}});
  const BlockSet read = read_blocks(path);
  EXPECT_EQ(read.vertices, set.vertices);
  EXPECT_EQ(read.part_face_vertices, set.part_face_vertices);
  EXPECT_EQ(read.convex_part_begin, set.convex_part_begin);
  EXPECT_EQ(read.second_moment[7], set.second_moment[7]);
  EXPECT_EQ(read.spin, set.spin);
  EXPECT_EQ(read.material_names, set.material_names);
  EXPECT_EQ(read.joint_set_names, set.joint_set_names);
  EXPECT_EQ(read.pair_blocks, set.pair_blocks);
  EXPECT_EQ(read.origin, set.origin);
  EXPECT_EQ(read.crs_wkt, set.crs_wkt);
}

TEST(BlocksHdf5, TheSameBlocksGiveTheSameBytes) {
  const std::string a = scratch("a.h5"), b = scratch("b.h5");
  write_blocks(a, some_blocks());
  write_blocks(b, some_blocks());
  EXPECT_EQ(sha256_of_file(a), sha256_of_file(b));
}

TEST(BlocksHdf5, WhatWouldBeCalledDamagedIsNotWritten) {
  const std::string path = scratch("unwritten.h5");
  BlockSet set = some_blocks();
  set.volume[0] = std::nan("");
  EXPECT_THROW(write_blocks(path, set), InputError);
  EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(BlocksHdf5, AnEmptySetIsASetToo) {
  const std::string path = scratch("empty.h5");
  write_blocks(path, {});
  EXPECT_EQ(n_blocks(read_blocks(path)), 0);
}

// Whatever happens to the bytes: refused, or read as a set that keeps its promises.
TEST(BlocksHdf5, DamagedFilesAreRefused) {
  const std::string path = scratch("damaged.h5");
  write_blocks(path, some_blocks());
  const std::string whole = bytes_of(path);
  Random random(8);
  for (int trial = 0; trial < 60; ++trial) {
    std::string bytes = whole;
    if (trial % 3 == 0)
      bytes.resize(random.below(bytes.size()));
    else
      for (int k = 0; k < 5; ++k)
        bytes[random.below(bytes.size())] = static_cast<char>(random.below(256));
    std::ofstream(path, std::ios::binary) << bytes;
    try {
      EXPECT_EQ(broken_promise(read_blocks(path)), "");
    } catch (const InputError& error) {
      EXPECT_EQ(std::string(error.what()).rfind(path, 0), 0u);
    }
  }
  EXPECT_THROW(static_cast<void>(read_blocks(scratch("not there.h5"))), InputError);
}

namespace {

// A stranger seals his files as Talus does.
void resealed(const std::string& path, const std::function<void(hid_t)>& change) {
  constexpr std::uintmax_t seal_size = 77;
  std::filesystem::resize_file(path, std::filesystem::file_size(path) - seal_size);
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  ASSERT_GE(file, 0);
  change(file);
  ASSERT_GE(H5Fclose(file), 0);
  const std::string bytes = bytes_of(path);
  std::ofstream(path, std::ios::binary | std::ios::app) << seal_of(bytes.data(), bytes.size());
}

}  // namespace

TEST(BlocksHdf5, LeadToNoOtherFile) {
  const std::string path = scratch("links.h5"), other = scratch("other.h5");
  write_blocks(other, some_blocks());
  const auto refuses = [&](const std::function<void(hid_t)>& change) {
    write_blocks(path, some_blocks());
    resealed(path, change);
    try {
      static_cast<void>(read_blocks(path));
      ADD_FAILURE() << "it was read";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("another"), std::string::npos) << error.what();
    }
  };
  std::string name;
  const auto first_array = [&](hid_t file) {
    name.clear();
    H5Lvisit(
        file, H5_INDEX_NAME, H5_ITER_NATIVE,
        [](hid_t at, const char* link, const H5L_info_t*, void* to) -> herr_t {
          const hid_t object = H5Oopen(at, link, H5P_DEFAULT);
          const bool is_array = H5Iget_type(object) == H5I_DATASET &&
                                H5Aexists(object, "CLASS") == 0;  // no dimension
          H5Oclose(object);
          if (is_array) *static_cast<std::string*>(to) = link;
          return is_array ? 1 : 0;
        },
        &name);
    ASSERT_NE(name, "");
  };
  EXPECT_NO_THROW({  // the seal alone does not refuse it
    write_blocks(path, some_blocks());
    resealed(path, first_array);
    static_cast<void>(read_blocks(path));
  });
  refuses([&](hid_t file) {
    H5Ldelete(file, name.c_str(), H5P_DEFAULT);
    EXPECT_GE(H5Lcreate_external(other.c_str(), name.c_str(), file, name.c_str(), H5P_DEFAULT,
                                 H5P_DEFAULT),
              0);
  });
  refuses([&](hid_t file) {
    H5Lmove(file, name.c_str(), file, "elsewhere", H5P_DEFAULT, H5P_DEFAULT);
    EXPECT_GE(H5Lcreate_soft("/elsewhere", file, name.c_str(), H5P_DEFAULT, H5P_DEFAULT), 0);
  });
  refuses([&](hid_t file) {  // values in another file, without a link
    const hid_t before = H5Dopen2(file, name.c_str(), H5P_DEFAULT);
    const hid_t type = H5Dget_type(before), space = H5Dget_space(before);
    H5Dclose(before);
    H5Ldelete(file, name.c_str(), H5P_DEFAULT);
    const hid_t list = H5Pcreate(H5P_DATASET_CREATE);
    EXPECT_GE(H5Pset_external(list, "/etc/passwd", 0, H5F_UNLIMITED), 0);
    const hid_t after = H5Dcreate2(file, name.c_str(), type, space, H5P_DEFAULT, list, H5P_DEFAULT);
    EXPECT_GE(after, 0);
    // a file is whole when nothing of it is open any more
    EXPECT_GE(H5Dclose(after), 0);
    EXPECT_GE(H5Tclose(type), 0);
    EXPECT_GE(H5Sclose(space), 0);
    EXPECT_GE(H5Pclose(list), 0);
  });
}
