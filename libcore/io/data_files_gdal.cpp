#include "io/data_files_gdal.hpp"

#include <filesystem>
#include <set>

#include "base/file_paths.hpp"
#include "base/sha256.hpp"
#include "io/dataset_files_gdal.hpp"

namespace talus {
namespace {

// A GeoTIFF names no further file whose values count where another data set reads it.
bool may_name_others(const std::string& file) {
  const std::string ending = extension_of(file);
  return ending != ".tif" && ending != ".tiff";
}

}  // namespace

std::vector<std::string> data_files(const std::string& path) {
  if (std::filesystem::is_directory(path)) return dataset_files(path);
  std::set<std::string> files{path};
  std::vector<std::string> to_look_at{path};
  while (!to_look_at.empty()) {
    const std::string next = to_look_at.back();
    to_look_at.pop_back();
    for (const std::string& file : dataset_files(next))
      if (files.insert(file).second && may_name_others(file)) to_look_at.push_back(file);
  }
  for (const std::string& file : sidecars_of(path))
    if (std::filesystem::is_regular_file(file)) files.insert(file);
  return {files.begin(), files.end()};
}

std::string digest_of_data(const std::string& source) {
  const std::string file = file_of(source);
  if (file.empty() || is_virtual(file)) return "";
  Sha256 hash;
  for (const std::string& member : data_files(file)) {
    if (!std::filesystem::is_regular_file(member)) continue;
    const std::string sha256 = sha256_of_file(member);
    hash.add(sha256.data(), sha256.size());
  }
  return hash.hex();
}

}  // namespace talus
