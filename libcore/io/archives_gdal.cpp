// Archives (zip, tar) as they are downloaded, with one file of data.
#include "io/archives_gdal.hpp"

#include <cpl_string.h>
#include <cpl_vsi.h>
#include <gdal.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "base/error.hpp"
#include "base/source_path.hpp"
#include "base/text.hpp"
#include "io/errors_gdal.hpp"

namespace talus {
namespace fs = std::filesystem;
namespace {

std::string extension_of(const std::string& path) {
  return lower(fs::path(path).extension().string());
}

// What accompanies a file of data.
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

// One raster of the tiles in an archive.
std::string tiles_command(const std::string& archive, const std::string& member) {
  const std::string folder = fs::path(archive).stem().string();
  const std::string unpack = archive_prefix(archive) == "/vsizip/"
                                 ? "unzip -q " + shell_word(archive) + " -d " + shell_word(folder)
                                 : "mkdir " + shell_word(folder) + " && tar -xf " +
                                       shell_word(archive) + " -C " + shell_word(folder);
  return "one raster of tiles: " + unpack + " && gdalbuildvrt all.vrt " +
         shell_word((fs::path(folder) / member).parent_path().string()) + "/*" +
         fs::path(member).extension().string();
}

std::string list_of(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

}  // namespace

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
  if (members.size() > 1)
    throw InputError({path.file},
                     "the archive holds " + std::to_string(members.size()) + " " + kind +
                         "s, expected one; they are: " + list_of(members),
                     contents == Contents::vectors
                         ? "name one: " + path.file + "/" + members.front()
                         : tiles_command(path.file, members.front()));
  remarks.push_back("read from " + members.front() + " in the archive");
  return path.source + "/" + members.front();
}

}  // namespace talus
