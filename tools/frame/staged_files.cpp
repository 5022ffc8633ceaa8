#include "tools/frame/staged_files.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "base/error.hpp"
#include "tools/frame/file_paths.hpp"
#include "tools/frame/machine.hpp"

namespace talus {
namespace fs = std::filesystem;
namespace {

void sync_and_close(int descriptor, const std::string& path) {
  const bool synced = fsync(descriptor) == 0 || errno == EINVAL;  // EINVAL: not a thing to sync
  const std::string reason = std::strerror(errno);
  close(descriptor);
  if (!synced) throw InputError({path}, "cannot be written to disk: " + reason);
}

void sync_path(const std::string& path, int flags) {
  const int descriptor = open(path.c_str(), flags);
  if (descriptor < 0)
    throw InputError({path}, std::string("cannot be opened: ") + std::strerror(errno));
  sync_and_close(descriptor, path);
}

void rename_over(const std::string& from, const std::string& to) {
  std::error_code error;
  fs::rename(from, to, error);
  if (error) throw InputError({to}, "cannot be put in place: " + error.message());
}

// What a killed run of this host left under the name that begins so.
void remove_leftovers(const fs::path& folder, const std::string& begin) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const std::string file = entry.path().filename().string();
    if (file.rfind(begin, 0) != 0) continue;
    const int process = std::atoi(file.c_str() + begin.size());
    if (process > 0 && process != getpid() && kill(process, 0) != 0 && errno == ESRCH)
      fs::remove_all(entry.path(), error);
  }
}

// A path without its last extension, be it the final or the temporary one.
std::string without_extension(const StagedFile& file, const std::string& path) {
  return path.substr(0, path.size() - fs::path(file.path).extension().string().size());
}

// What GDAL puts beside a temporary file (NAME.tif.aux.xml, NAME.tfw, NAME.gpkg-journal): the
// endings that follow the name that they share.
std::vector<std::string> endings_beside(const StagedFile& file,
                                        const std::vector<StagedFile>& all) {
  const std::string begin = without_extension(file, file.temporary);
  std::vector<std::string> endings;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder_of(begin), error)) {
    const std::string path = (folder_of(begin) / entry.path().filename()).string();
    if (!path.starts_with(begin) || path.size() == begin.size()) continue;
    const bool is_output = std::any_of(all.begin(), all.end(),
                                       [&](const StagedFile& s) { return s.temporary == path; });
    if (is_output) continue;
    if (path[begin.size()] == '.' || path[begin.size()] == '-')
      endings.push_back(path.substr(begin.size()));
  }
  return endings;
}

}  // namespace

std::string temporary_name(const fs::path& path) {
  std::string begin = ".";
  begin.append(path.stem().string()).append(".part-").append(host_name()).append("-");
  remove_leftovers(folder_of(path), begin);
  return (folder_of(path) / (begin + std::to_string(getpid()) + path.extension().string()))
      .string();
}

std::vector<StagedFile> in_order_of_commit(const std::vector<StagedFile>& staged,
                                           const std::string& main) {
  std::vector<StagedFile> files(staged.rbegin(), staged.rend());
  std::stable_partition(files.begin(), files.end(),
                        [&main](const StagedFile& file) { return file.path != main; });
  return files;
}

void put_in_place(const std::vector<StagedFile>& files, const timespec& time) {
  const timespec times[2] = {time, time};
  for (const StagedFile& file : files) {
    if (!fs::exists(file.temporary)) continue;
    utimensat(AT_FDCWD, file.temporary.c_str(), times, 0);
    sync_path(file.temporary, O_RDONLY);
    for (const std::string& ending : endings_beside(file, files))
      rename_over(without_extension(file, file.temporary) + ending,
                  without_extension(file, file.path) + ending);
    rename_over(file.temporary, file.path);
    sync_path(folder_of(file.path).string(), O_RDONLY | O_DIRECTORY);
  }
}

void remove_staged(const std::vector<StagedFile>& files) {
  std::error_code error;
  for (const StagedFile& file : files) {
    fs::remove_all(file.temporary, error);
    for (const std::string& ending : endings_beside(file, files))
      fs::remove_all(without_extension(file, file.temporary) + ending, error);
  }
}

std::string with_final_names(std::string words, const std::vector<StagedFile>& files) {
  for (const StagedFile& file : files)
    for (std::size_t at; (at = words.find(file.temporary)) != std::string::npos;)
      words.replace(at, file.temporary.size(), file.path);
  return words;
}

}  // namespace talus
