// Writing files: links, older files, devices, full disks.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "base/error.hpp"
#include "base/read_file.hpp"
#include "base/write_bytes.hpp"

namespace {

using namespace talus;
namespace fs = std::filesystem;

void write(const std::string& path, const std::string& text) {
  write_bytes(path, {reinterpret_cast<const unsigned char*>(text.data()), text.size()});
}

struct WriteBytes : testing::Test {
  fs::path folder = fs::temp_directory_path() / ("talus_write_bytes_" + std::to_string(getpid()));
  WriteBytes() { fs::create_directory(folder); }
  ~WriteBytes() override { fs::remove_all(folder); }
};

TEST_F(WriteBytes, ALinkUnderTheNameIsReplacedAndNotFollowed) {
  const fs::path mine = folder / "mine", name = folder / "run.h5.part.new";
  std::ofstream(mine) << "precious";
  fs::create_symlink("mine", name);
  write(name.string(), "new");
  EXPECT_EQ(read_file(mine.string()), "precious");
  EXPECT_EQ(read_file(name.string()), "new");
  EXPECT_FALSE(fs::is_symlink(name));
  fs::remove(name);
  fs::create_symlink("nowhere", name);
  write(name.string(), "new");
  EXPECT_FALSE(fs::exists(folder / "nowhere"));
  fs::remove(name);
  fs::create_hard_link(mine, name);
  write(name.string(), "new");
  EXPECT_EQ(read_file(mine.string()), "precious");
}

TEST_F(WriteBytes, AnOlderFileIsReplacedAndADeviceIsWrittenTo) {
  const std::string name = (folder / "a").string();
  write(name, "a longer text");
  write(name, "short");
  EXPECT_EQ(read_file(name), "short");
  EXPECT_THROW(write("/dev/full", "text"), InputError);
  EXPECT_TRUE(fs::exists("/dev/full"));
  write("/dev/null", "text");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

}  // namespace
