// Digests of files by content, remembered from one start of make to the next.
#include "tools/site/file_digests.hpp"

#include <sys/stat.h>

#include <ctime>
#include <filesystem>
#include <sstream>

#include "base/sha256.hpp"

namespace talus {
namespace {

// A file system may count times in steps of two seconds.
constexpr std::time_t settled_after_s = 3;

std::string nanoseconds(const timespec& time) {
  return std::to_string(time.tv_sec) + "." + std::to_string(time.tv_nsec);
}

// The time of the last change of the inode is set by no program: an older file that is put in
// place, and one with its times set back, have another.
std::string stamp_of(const struct stat& file) {
  return std::to_string(file.st_size) + " " + nanoseconds(file.st_mtim) + " " +
         nanoseconds(file.st_ctim) + " " + std::to_string(file.st_dev) + ":" +
         std::to_string(file.st_ino);
}

}  // namespace

FileDigests::FileDigests(const std::string& memory) {
  std::istringstream lines(memory);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t first = line.find('\t'), second = line.find('\t', first + 1);
    if (second == std::string::npos) continue;
    before_[line.substr(second + 1)] = {line.substr(first + 1, second - first - 1),
                                        line.substr(0, first), true};
  }
}

std::string FileDigests::of(const std::string& path) {
  const std::string name = std::filesystem::absolute(path).lexically_normal().string();
  struct stat file {};
  if (stat(path.c_str(), &file) != 0 || !S_ISREG(file.st_mode)) return "none";
  const std::string stamp = stamp_of(file);
  if (const auto known = before_.find(name); known != before_.end() && known->second.stamp == stamp)
    return (now_[name] = known->second).sha256;
  const bool settled = std::time(nullptr) - file.st_ctim.tv_sec >= settled_after_s;
  return (now_[name] = {stamp, sha256_of_file(path), settled}).sha256;
}

std::string FileDigests::as_text() const {
  std::string out;
  for (const auto& [name, entry] : now_)
    if (entry.settled && name.find('\n') == std::string::npos)
      out += entry.sha256 + "\t" + entry.stamp + "\t" + name + "\n";
  return out;
}

}  // namespace talus
