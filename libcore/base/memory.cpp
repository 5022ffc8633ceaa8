// Finds how much memory is free on the machine and in its control groups, and refuses larger work.
#include "base/memory.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <string_view>

#include "base/text.hpp"

namespace talus {
namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();
constexpr double megabyte = 1e6;

// Of limit_memory().
struct Given {
  bool is_given = false;
  double most_resident = unlimited;
} given;

// The number behind `key` in lines such as "MemAvailable:  123 kB"; NaN where there is none.
double number_behind(const std::string& path, const std::string& key) {
  std::ifstream file(path);
  std::string word;
  double number = 0;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    if (words >> word >> number && word == key) return number;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

// The only number of a file; infinite for "max" and where the file is missing.
double lone_number(const std::string& path) {
  std::ifstream file(path);
  double number = 0;
  return file >> number ? number : unlimited;
}

double resident_bytes() {
  std::ifstream file("/proc/self/statm");
  double size = 0, resident = 0;
  return file >> size >> resident ? resident * static_cast<double>(sysconf(_SC_PAGESIZE)) : 0;
}

double address_space_bytes() {
  std::ifstream file("/proc/self/statm");
  double size = 0;
  return file >> size ? size * static_cast<double>(sysconf(_SC_PAGESIZE)) : 0;
}

double free_on_machine(const std::string& root) {
  const double available = number_behind(root + "/proc/meminfo", "MemAvailable:");
  const double swap = number_behind(root + "/proc/meminfo", "SwapFree:");
  if (std::isnan(available)) return unlimited;
  return 1024 * (available + (std::isnan(swap) ? 0 : swap));
}

// Memory that a control group leaves: pages of files that are not in use count as free.
double left_in_group(const std::string& folder, const char* limit, const char* used) {
  const double most = lone_number(folder + limit);
  if (!(most < 1e18)) return unlimited;  // version 1 says nearly 2^63 for none
  const double taken = lone_number(folder + used);
  if (!std::isfinite(taken)) return unlimited;
  const double files = number_behind(folder + "/memory.stat", "inactive_file");
  return std::max(0.0, most - taken + (std::isnan(files) ? 0 : files));
}

// The folder of a group and those above it bind alike.
double left_in_groups(const std::string& top, std::string group, const char* limit,
                      const char* used) {
  double left = left_in_group(top, limit, used);
  while (group.size() > 1) {
    left = std::min(left, left_in_group(top + group, limit, used));
    group.resize(group.rfind('/'));
  }
  return left;
}

double left_by_groups(const std::string& root) {
  double left = unlimited;
  std::ifstream file(root + "/proc/self/cgroup");
  for (std::string line; std::getline(file, line);) {  // number:controllers:/path
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (second == std::string::npos || second + 1 == line.size() || line[second + 1] != '/')
      continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    const std::string group = line.substr(second + 1);
    if (controllers.empty())
      left = std::min(
          left, left_in_groups(root + "/sys/fs/cgroup", group, "/memory.max", "/memory.current"));
    else if (controllers == "memory")
      left = std::min(left, left_in_groups(root + "/sys/fs/cgroup/memory", group,
                                           "/memory.limit_in_bytes", "/memory.usage_in_bytes"));
  }
  return left;
}

// `ulimit -v`
double left_in_address_space() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return unlimited;
  return std::max(0.0, static_cast<double>(limit.rlim_cur) - address_space_bytes());
}

std::string megabytes(double bytes, bool up) {
  const double n = bytes / megabyte;
  return text(up ? std::ceil(n) : std::floor(n), 15) + " MB";
}

}  // namespace

void limit_memory(double bytes) {
  given = {bytes > 0, bytes > 0 ? resident_bytes() + bytes : unlimited};
}

double free_memory(const std::string& root) {
  return std::min({free_on_machine(root), left_by_groups(root),
                   root.empty() ? left_in_address_space() : unlimited});
}

void require_memory(double bytes, const Where& where, const std::string& what,
                    const std::string& way_out) {
  if (bytes < megabyte) return;
  const double most =
      given.is_given ? std::max(0.0, given.most_resident - resident_bytes()) : free_memory();
  if (bytes <= most) return;
  throw InputError(
      where,
      what + " need about " + megabytes(bytes, true) + " of memory, expected at most " +
          megabytes(most, false) +
          (given.is_given ? ", what --memory-mb leaves" : ", what is free on this machine"),
      way_out + ", or give more with --memory-mb");
}

void require_memory_for_words(const std::string& content, const std::string& file) {
  double n_words = 0, n_lines = 0;
  char before = '\n';
  for (const char c : content) {
    const bool ends = std::string_view(" \t,;\n").find(c) != std::string_view::npos;
    const bool ended = std::string_view(" \t,;\n").find(before) != std::string_view::npos;
    n_words += ends && !ended ? 1 : 0;
    n_lines += c == '\n' ? 1 : 0;
    before = c;
  }
  constexpr double bytes_per_line = 48;  // its list of words, its number
  const double bytes = 2 * static_cast<double>(content.size()) +
                       static_cast<double>(sizeof(std::string)) * n_words +
                       bytes_per_line * n_lines;
  require_memory(bytes, {file}, "the words of the table", "leave out lines that are not needed");
}

}  // namespace talus
