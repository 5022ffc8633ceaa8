// Reads whole files, with a limit of memory for endless ones.
#include "base/read_file.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>

#include "base/error.hpp"
#include "base/memory.hpp"

namespace talus {

std::string read_file(const std::string& path, const std::string& hint) {
  std::ifstream file(path, std::ios::binary);
  std::string content;
  std::array<char, 1 << 16> buffer;
  std::error_code unknown;
  const std::uintmax_t size = std::filesystem::file_size(path, unknown);
  if (!unknown) {
    require_memory(static_cast<double>(size), {path}, "its bytes",
                   "check that it is the file that you mean");
    content.reserve(size + buffer.size());
  }
  do {
    file.read(buffer.data(), buffer.size());
    if (content.size() + buffer.size() > content.capacity())  // it will take twice as much
      require_memory(2 * static_cast<double>(content.capacity()), {path}, "more of its bytes",
                     "check that it is the file that you mean");
    content.append(buffer.data(), static_cast<std::size_t>(file.gcount()));
  } while (file);
  if (!file.eof()) throw InputError({path}, "cannot be read", hint);
  return content;
}

std::string first_bytes(const std::string& path, std::size_t n) {
  std::string head(n, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(head.data(), static_cast<std::streamsize>(n));
  head.resize(static_cast<std::size_t>(std::max<std::streamsize>(file.gcount(), 0)));
  return head;
}

}  // namespace talus
