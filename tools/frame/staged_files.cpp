// Outputs are written in hidden folders and renamed into place when all of a run are whole.
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
#include "base/file_paths.hpp"
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

// Removes files that a killed run of this host left under a name that begins so.
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

// Files in the hidden folder of a file: the file itself, and those that GDAL put beside it
// (NAME.tif.aux.xml, NAME.tfw, NAME.gpkg-journal). All have their final names already.
std::vector<std::string> names_in_folder(const StagedFile& file) {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder_of(file.temporary), error))
    names.push_back(entry.path().filename().string());
  return names;
}

}  // namespace

std::string temporary_name(const fs::path& path) {
  const std::string begin = "." + path.stem().string() + ".part-" + host_name() + "-";
  remove_leftovers(folder_of(path), begin);
  std::string folder = (folder_of(path) / (begin + std::to_string(getpid()) + "-XXXXXX")).string();
  if (mkdtemp(folder.data()) == nullptr)
    throw InputError(
        {path.string()},
        std::string("cannot be written: no folder can be made beside it: ") + std::strerror(errno),
        errno == ENOSPC || errno == EDQUOT ? "make room, or name an output elsewhere"
                                           : "the folder takes no new files: name another output");
  return (fs::path(folder) / path.filename()).string();
}

std::vector<std::string> final_names(const StagedFile& file) {
  std::vector<std::string> names = names_in_folder(file);
  for (std::string& name : names) name = (folder_of(file.path) / name).string();
  return names;
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
    const fs::path hidden = folder_of(file.temporary);
    if (!fs::exists(file.temporary)) {
      remove_staged({file});
      continue;
    }
    utimensat(AT_FDCWD, file.temporary.c_str(), times, 0);
    sync_path(file.temporary, O_RDONLY);
    for (const std::string& name : names_in_folder(file))
      if (name != fs::path(file.temporary).filename())
        rename_over((hidden / name).string(), (folder_of(file.path) / name).string());
    rename_over(file.temporary, file.path);
    rmdir(hidden.c_str());
    sync_path(folder_of(file.path).string(), O_RDONLY | O_DIRECTORY);
  }
}

void remove_staged(const std::vector<StagedFile>& files) {
  std::error_code error;
  for (const StagedFile& file : files) fs::remove_all(folder_of(file.temporary), error);
}

std::string with_final_names(std::string words, const std::vector<StagedFile>& files) {
  for (const StagedFile& file : files)
    for (std::size_t at; (at = words.find(file.temporary)) != std::string::npos;)
      words.replace(at, file.temporary.size(), file.path);
  return words;
}

}  // namespace talus
