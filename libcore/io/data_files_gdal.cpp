// Lists the files of a data set and computes their common digest.
#include "io/data_files_gdal.hpp"

#include <cpl_string.h>
#include <gdal.h>

#include <filesystem>
#include <set>

#include "base/file_paths.hpp"
#include "base/read_file.hpp"
#include "base/sha256.hpp"
#include "base/text.hpp"
#include "io/errors_gdal.hpp"

namespace talus {
namespace fs = std::filesystem;
namespace {

// Vector drivers that name further files and open without reading all features.
bool names_further_files(const std::string& path) {
  const GDALDriverH driver =
      GDALIdentifyDriverEx(path.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY, nullptr, nullptr);
  if (driver == nullptr) return false;
  const std::string name = GDALGetDriverShortName(driver);
  return name == "ESRI Shapefile" || name == "OGR_VRT" || name == "MapInfo File";
}

std::vector<std::string> files_of(const std::string& path, unsigned kind) {
  std::vector<std::string> files;
  const GDALDatasetH dataset =
      GDALOpenEx(path.c_str(), kind | GDAL_OF_READONLY, nullptr, nullptr, nullptr);
  if (dataset == nullptr) return files;
  char** const list = GDALGetFileList(dataset);
  for (int i = 0; i < CSLCount(list); ++i) files.emplace_back(list[i]);
  CSLDestroy(list);
  GDALClose(dataset);
  return files;
}

// Whether it says where the values are or what they mean, beside statistics.
bool affects_values(const std::string& aux_file) {
  const std::string content = read_file(aux_file);
  for (const char* mark : {"<SRS", "<GeoTransform", "<NoDataValue", "<GCPList", "<Scale", "<Offset",
                           "<UnitType", "\"GEOLOCATION\"", "\"RPC\""})
    if (content.find(mark) != std::string::npos) return true;
  return false;
}

bool affects_data(const std::string& file) {
  const std::string name = lower(file);
  for (const char* ending : {".ovr", ".qix", ".sbn", ".sbx", ".qmd", ".qml"})
    if (name.ends_with(ending)) return false;
  return !name.ends_with(".aux.xml") || affects_values(file);
}

void add_folder(const std::string& path, std::set<std::string>& files) {
  for (const auto& entry : fs::recursive_directory_iterator(path))
    if (entry.is_regular_file()) files.insert(entry.path().string());
}

void add_dataset(const std::string& path, std::set<std::string>& files) {
  register_gdal_drivers();
  const GdalErrors quiet;
  std::vector<std::string> found = files_of(path, GDAL_OF_RASTER);
  if (found.empty() && names_further_files(path)) found = files_of(path, GDAL_OF_VECTOR);
  for (const std::string& file : found)
    if (fs::is_regular_file(file) && affects_data(file)) files.insert(file);
  if (fs::is_regular_file(path + "-wal") && fs::file_size(path + "-wal") > 0)
    files.insert(path + "-wal");
}

// The files of one data set, by name. Of a file that GDAL cannot read, or that is missing: itself.
std::vector<std::string> dataset_files(const std::string& path) {
  std::set<std::string> files;
  if (fs::is_directory(path))
    add_folder(path, files);
  else if (fs::is_regular_file(path))
    add_dataset(path, files);
  if (!fs::is_directory(path)) files.insert(path);
  return {files.begin(), files.end()};
}

// A GeoTIFF names no further file whose values count where another data set reads it.
bool may_name_others(const std::string& file) {
  const std::string ending = extension_of(file);
  return ending != ".tif" && ending != ".tiff";
}

}  // namespace

std::vector<std::string> data_files(const std::string& path) {
  if (fs::is_directory(path)) return dataset_files(path);
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
