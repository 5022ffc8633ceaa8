// Refuses outputs that cannot or must not be written, before long work.
#include "tools/frame/output_checks.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <set>

#include "base/file_paths.hpp"
#include "base/text.hpp"
#include "tools/frame/command_line.hpp"

namespace talus {
namespace fs = std::filesystem;
namespace {

void check_folder(const fs::path& folder) {
  if (!fs::is_directory(folder))
    throw InputError({folder.string()}, "there is no such folder to write into", "make it first");
  if (access(folder.c_str(), W_OK) != 0)
    throw InputError({folder.string()},
                     std::string("the folder cannot be written: ") + std::strerror(errno),
                     "name another output, or mend the folder's permissions");
}

// File that a path would belong to if it were kept beside another file, as formats do: under its
// whole name (map.tif of map.tif.aux.xml), or with another extension, which is left out then.
struct Owner {
  std::string file, without_extension;
};

Owner owner_of(const std::string& path) {
  for (const char* ending : {".aux.xml", ".ovr", ".msk", "-wal", "-shm", "-journal"})
    if (path.ends_with(ending)) return {path.substr(0, path.size() - std::strlen(ending)), ""};
  static const std::set<std::string> extensions = {".prj", ".shx", ".dbf", ".cpg", ".qpj",
                                                   ".qix", ".sbn", ".sbx", ".aux", ".wld",
                                                   ".tfw", ".jgw", ".pgw", ".hdr"};
  const fs::path whole = path;
  if (!extensions.contains(extension_of(path))) return {};
  return {"", (whole.parent_path() / whole.stem()).string()};
}

void check_output(const OutputOption& output, bool overwrite, const KeptFiles& kept) {
  const fs::path path = *output.path;
  if (output.is_folder) {
    std::error_code error;
    fs::create_directories(path, error);
    if (error) throw InputError({path.string()}, "the folder cannot be made: " + error.message());
    check_folder(path);
    return;
  }
  check_output_file(path, kept);
  refuse_existing(path, overwrite);
}

}  // namespace

void KeptFiles::add(const std::string& source, const std::string& finding) {
  const std::string file = file_behind(file_of(source));
  if (is_virtual(file)) return;
  by_path_.emplace(absolute_path(file), finding);
  struct stat there {};
  if (stat(file.c_str(), &there) == 0)
    by_file_.emplace(std::pair(there.st_dev, there.st_ino), finding);
}

const std::string* KeptFiles::finding_on(const fs::path& output) const {
  const std::string path = absolute_path(output.string());
  if (const auto at = by_path_.find(path); at != by_path_.end()) return &at->second;
  struct stat there {};
  if (stat(output.c_str(), &there) == 0 && S_ISREG(there.st_mode))
    if (const auto at = by_file_.find({there.st_dev, there.st_ino}); at != by_file_.end())
      return &at->second;
  const Owner owner = owner_of(path);
  if (const auto at = by_path_.find(owner.file); at != by_path_.end()) return &at->second;
  if (owner.without_extension.empty()) return nullptr;
  const auto at = by_path_.lower_bound(owner.without_extension + ".");
  const bool is_same =
      at != by_path_.end() && fs::path(at->first).replace_extension() == owner.without_extension;
  return is_same ? &at->second : nullptr;
}

void KeptFiles::refuse(const fs::path& output) const {
  if (const std::string* finding = finding_on(output))
    throw UsageError({output.string()}, *finding, "name another output");
}

void check_output_names(const ToolOptions& options) {
  for (const OutputOption& output : options.outputs)
    if (output.option->count() > 0 && output.path->empty() && output.option != options.json_option)
      throw CLI::ValidationError(output.option->get_name(), "the name is empty");
}

void check_output_file(const fs::path& path, const KeptFiles& kept) {
  kept.refuse(path);
  if (fs::is_directory(path))
    throw InputError({path.string()}, "is a folder, expected a file name to write");
  if (fs::exists(path) && !fs::is_regular_file(path))
    throw InputError({path.string()}, "is not a regular file, expected a file name to write",
                     "outputs are written beside it and renamed when they are whole");
  // Work in progress is in a folder of a longer name: .NAME.part-HOST-PROCESS-XXXXXX
  constexpr std::size_t longest = 160;
  if (path.filename().string().size() > longest)
    throw InputError({path.string()},
                     "the name has " + std::to_string(path.filename().string().size()) +
                         " bytes, expected at most " + std::to_string(longest),
                     "give the output a shorter name");
  check_folder(folder_of(path));
}

void refuse_existing(const fs::path& path, bool overwrite) {
  if (fs::exists(path) && !overwrite)
    throw InputError({path.string()}, "exists already", "give --overwrite to replace it");
}

void check_outputs(const ToolOptions& options, const KeptFiles& kept) {
  std::vector<std::string> seen;
  const std::string registry = options.db.empty() ? "" : absolute_path(options.db);
  if (!registry.empty()) seen.push_back(registry);
  if (const std::string path = registry_path(options); !path.empty() && !options.no_db)
    kept.refuse(path);
  for (const OutputOption& output : options.outputs) {
    if (output.path->empty()) continue;
    check_output(output, options.overwrite, kept);
    const std::string path = absolute_path(*output.path);
    if (std::find(seen.begin(), seen.end(), path) != seen.end())
      throw UsageError({*output.path},
                       path == registry ? "is named for an output and for the run registry"
                                        : "is named for two outputs",
                       "give each its own name");
    seen.push_back(path);
  }
}

}  // namespace talus
