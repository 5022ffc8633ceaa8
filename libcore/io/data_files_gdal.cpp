#include "io/data_files_gdal.hpp"

#include <filesystem>
#include <set>

#include "base/text.hpp"
#include "io/dataset_files_gdal.hpp"

namespace talus {
namespace {

// A GeoTIFF names no further file whose values count where another data set reads it.
bool may_name_others(const std::string& file) {
  const std::string ending = lower(std::filesystem::path(file).extension().string());
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
  return {files.begin(), files.end()};
}

}  // namespace talus
