// Archives (zip, tar) as they are downloaded, with one file of data.
#include "io/archives_gdal.hpp"

#include <cpl_string.h>
#include <cpl_vsi.h>
#include <gdal_priv.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <set>

#include "base/error.hpp"
#include "base/file_paths.hpp"
#include "base/source_path.hpp"
#include "base/text.hpp"
#include "base/words.hpp"
#include "io/errors_gdal.hpp"

namespace talus {
namespace fs = std::filesystem;
namespace {

// Files that accompany a file of data.
bool is_companion(const std::string& path, Contents contents, const std::set<std::string>& all) {
  static const std::set<std::string> extensions = {
      ".shx", ".dbf", ".prj",  ".cpg", ".sbn", ".sbx", ".qix", ".qpj",  ".qml", ".sld", ".qmd",
      ".xml", ".pdf", ".html", ".htm", ".md",  ".xsd", ".gfs", ".csvt", ".lyr", ".tfw", ".ovr"};
  static const std::set<std::string> beside_vectors = {".jpg", ".png", ".tif", ".txt"};
  const std::string extension = extension_of(path);
  return all.size() > 1 && (extensions.contains(extension) ||
                            (contents == Contents::vectors && beside_vectors.contains(extension)));
}

bool holds(const std::string& source, Contents contents) {
  const bool is_vectors = contents == Contents::vectors;
  if (is_vectors && is_table_name(source)) return true;
  const GdalErrors quiet;
  return GDALIdentifyDriverEx(source.c_str(), is_vectors ? GDAL_OF_VECTOR : GDAL_OF_RASTER, nullptr,
                              nullptr) != nullptr;
}

// Files of an archive, and folders that are one source (.gdb), by their names in it.
std::set<std::string> names_in(const std::string& archive) {
  const GdalErrors quiet;
  std::set<std::string> names;
  const CPLStringList found(VSIReadDirRecursive(archive.c_str()));
  for (int i = 0; i < found.size(); ++i) {
    std::string name = found[i];
    if (name.empty() || name.rfind("__MACOSX", 0) == 0) continue;
    if (const std::size_t gdb = lower(name).find(".gdb/"); gdb != std::string::npos)
      name = name.substr(0, gdb + 4);
    if (name.back() != '/') names.insert(name);
  }
  return names;
}

std::vector<std::string> members_with(const std::string& archive, Contents contents) {
  const std::set<std::string> names = names_in(archive);
  std::vector<std::string> members;
  for (const std::string& name : names)
    if (!is_companion(name, contents, names) && holds(archive + "/" + name, contents))
      members.push_back(name);
  return members;
}

// Shapefiles in one folder are the layers of one source.
bool are_shapefiles_of_one_folder(const std::vector<std::string>& members) {
  return std::all_of(members.begin(), members.end(), [&members](const std::string& member) {
    return extension_of(member) == ".shp" &&
           fs::path(member).parent_path() == fs::path(members.front()).parent_path();
  });
}

// The command that unpacks an archive and makes one raster of its tiles.
std::string tiles_command(const std::string& archive, const std::vector<std::string>& members) {
  const std::string folder = fs::path(archive).stem().string();
  std::string command = archive_prefix(archive) == "/vsizip/"
                            ? "unzip -q " + shell_word(archive) + " -d " + shell_word(folder)
                            : "mkdir " + shell_word(folder) + " && tar -xf " + shell_word(archive) +
                                  " -C " + shell_word(folder);
  command += " && gdalbuildvrt all.vrt";
  const fs::path first(members.front());
  const bool are_alike = std::all_of(members.begin(), members.end(), [&first](const fs::path& one) {
    return one.parent_path() == first.parent_path() && one.extension() == first.extension();
  });
  if (are_alike)
    return command + " " + shell_word((fs::path(folder) / first).parent_path().string()) + "/*" +
           first.extension().string();
  for (const std::string& member : members)
    command += " " + shell_word((fs::path(folder) / member).string());
  return command;
}

// Outer edges of a raster; nothing where it has no place, or names other files.
std::optional<std::array<double, 4>> edges_of(const std::string& raster) {
  const GdalErrors quiet;
  if (lower(raster).ends_with(".vrt")) return std::nullopt;
  const GDALDatasetUniquePtr dataset(GDALDataset::Open(raster.c_str(), GDAL_OF_RASTER));
  std::array<double, 6> g{};
  if (!dataset || dataset->GetGeoTransform(g.data()) != CE_None) return std::nullopt;
  const double x = g[0] + g[1] * dataset->GetRasterXSize();
  const double y = g[3] + g[5] * dataset->GetRasterYSize();
  return std::array<double, 4>{std::min(g[0], x), std::min(g[3], y), std::max(g[0], x),
                               std::max(g[3], y)};
}

// Whether one of two has half of its area or more on the other, among the first of many.
bool lie_over_one_another(const std::vector<std::string>& rasters) {
  constexpr std::size_t most = 20;
  std::vector<std::array<double, 4>> seen;
  for (std::size_t i = 0; i < std::min(most, rasters.size()); ++i) {
    const auto edges = edges_of(rasters[i]);
    if (!edges) continue;
    const auto& [west, south, east, north] = *edges;
    for (const auto& other : seen) {
      const double width = std::min(east, other[2]) - std::max(west, other[0]);
      const double height = std::min(north, other[3]) - std::max(south, other[1]);
      const double smaller =
          std::min((east - west) * (north - south), (other[2] - other[0]) * (other[3] - other[1]));
      if (width > 0 && height > 0 && 2 * width * height >= smaller) return true;
    }
    seen.push_back(*edges);
  }
  return false;
}

// The one that is called like an elevation model, else the first.
std::string elevation_model_among(const std::vector<std::string>& names) {
  for (const char* word : {"dem", "dtm", "dgm", "dhm", "mnt", "mdt", "elev", "alti"})
    for (const std::string& name : names)
      if (lower(fs::path(name).filename().string()).find(word) != std::string::npos) return name;
  return names.front();
}

}  // namespace

std::string way_to_one_raster(const std::vector<std::string>& rasters,
                              const std::vector<std::string>& names, const std::string& command) {
  return lie_over_one_another(rasters)
             ? "they lie over one another; name one: " + shell_word(elevation_model_among(names))
             : "one raster of tiles: " + command;
}

std::string source_in(const SourcePath& path, Contents contents,
                      std::vector<std::string>& remarks) {
  const std::string prefix = archive_prefix(path.file);
  const bool is_whole = !prefix.empty() && path.source == prefix + path.file;
  if (!is_whole || prefix == "/vsigzip/") return path.source;
  const std::string kind = contents == Contents::vectors ? "vector file" : "raster";
  const std::vector<std::string> members = members_with(path.source, contents);
  if (members.empty())
    throw InputError({path.file}, "the archive holds no " + kind + " that GDAL reads",
                     "unpack it, and look what it holds");
  if (members.size() > 1 && are_shapefiles_of_one_folder(members)) {
    const std::string folder = fs::path(members.front()).parent_path().string();
    return folder.empty() ? path.source : path.source + "/" + folder;
  }
  if (members.size() > 1) {
    std::vector<std::string> rasters, names;
    for (const std::string& member : members) {
      rasters.push_back(path.source + "/" + member);
      names.push_back(path.file + "/" + member);
    }
    throw InputError({path.file},
                     "the archive holds " + std::to_string(members.size()) + " " + kind +
                         "s, expected one; they are: " + list_of(members),
                     contents == Contents::vectors
                         ? "name one: " + shell_word(names.front())
                         : way_to_one_raster(rasters, names, tiles_command(path.file, members)));
  }
  remarks.push_back("read from " + members.front() + " in the archive");
  return path.source + "/" + members.front();
}

}  // namespace talus
