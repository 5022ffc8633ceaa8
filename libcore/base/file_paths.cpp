// Takes apart file names of a command line: virtual files of GDAL, sidecar files, one spelling.
#include "base/file_paths.hpp"

#include <cctype>

#include "base/source_path.hpp"
#include "base/text.hpp"

namespace talus {
namespace fs = std::filesystem;

bool is_virtual(const std::string& path) { return path.rfind("/vsi", 0) == 0; }

std::string file_behind(const std::string& path) {
  std::error_code error;
  if (path.find(':') == std::string::npos || fs::exists(path, error)) return path;
  const std::size_t begin = path.find(':') + 1;
  for (std::size_t from = begin; from != 0; from = path.find(':', from) + 1)
    for (std::size_t to = path.size(); to != std::string::npos && to > from;
         to = path.rfind(':', to - 1)) {
      std::string part = path.substr(from, to - from);
      if (part.size() > 2 && part.front() == '"' && part.back() == '"')
        part = part.substr(1, part.size() - 2);
      if (fs::is_regular_file(part, error)) return part;
    }
  return path;
}

std::string file_of(const std::string& source) { return parse_source_path(source).file; }

std::string part_named(const std::string& source) { return parse_source_path(source).inside; }

std::string absolute_path(const std::string& path) {
  if (is_virtual(path) || file_behind(path) != path) return path;
  std::error_code error;  // a pipe behind /dev/stdout has no name of its own
  const fs::path canonical = fs::weakly_canonical(fs::absolute(path), error);
  return (error ? fs::absolute(path) : canonical).string();
}

std::string extension_of(const std::string& path) {
  return lower(fs::path(path).extension().string());
}

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

std::vector<std::string> sidecars_of(const std::string& path) {
  std::vector<std::string> files;
  if (extension_of(path) != ".shp") return files;
  for (const char* extension : {".shx", ".dbf", ".prj", ".cpg"})
    files.push_back(fs::path(path).replace_extension(extension).string());
  return files;
}

std::string file_word(const std::string& name) {
  std::string out;
  for (const char c : name)
    out += std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_' ? c : '_';
  return out;
}

}  // namespace talus
