#include "tools/frame/output_checks.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "tools/frame/command_line.hpp"
#include "tools/frame/file_paths.hpp"
#include "tools/frame/options.hpp"

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

void check_output(const OutputOption& output, bool overwrite,
                  const std::vector<RunArtifact>& inputs) {
  const fs::path path = *output.path;
  if (output.is_folder) {
    std::error_code error;
    fs::create_directories(path, error);
    if (error) throw InputError({path.string()}, "the folder cannot be made: " + error.message());
    check_folder(path);
    return;
  }
  check_output_file(path, inputs);
  refuse_existing(path, overwrite);
}

}  // namespace

void check_output_names(const ToolOptions& options) {
  for (const OutputOption& output : options.outputs)
    if (output.option->count() > 0 && output.path->empty() && output.option != options.json_option)
      throw CLI::ValidationError(output.option->get_name(), "the name is empty");
}

void check_output_file(const fs::path& path, const std::vector<RunArtifact>& inputs) {
  for (const RunArtifact& file : inputs)
    if (file.path == absolute_path(path.string()))
      throw UsageError({path.string()}, "is both an input and an output", "name another output");
  if (fs::is_directory(path))
    throw InputError({path.string()}, "is a folder, expected a file name to write");
  if (fs::exists(path) && !fs::is_regular_file(path))
    throw InputError({path.string()}, "is no regular file, expected a file name to write",
                     "outputs are written beside it and renamed when they are whole");
  // Work in progress has a longer name: .NAME.part-HOST-PROCESS.EXT
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

void check_outputs(const ToolOptions& options, const std::vector<RunArtifact>& inputs) {
  std::vector<std::string> seen;
  const std::string registry = options.db.empty() ? "" : absolute_path(options.db);
  if (!registry.empty()) seen.push_back(registry);
  for (const OutputOption& output : options.outputs) {
    if (output.path->empty()) continue;
    check_output(output, options.overwrite, inputs);
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
