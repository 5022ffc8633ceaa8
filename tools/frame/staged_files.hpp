// tools/frame/staged_files.hpp
// Outputs are written in a hidden folder of their own beside the output, and put in place
// when all of a run are whole.
// in:    paths of outputs
// out:   files in their places with equal times, or none of them
#pragma once

#include <ctime>
#include <filesystem>
#include <string>
#include <vector>

namespace talus {

struct StagedFile {
  std::string temporary;  ///< where it is written for now
  std::string path;       ///< where it will be
};

/// The name of `path` in a new hidden folder beside it, .NAME.part-HOST-PROCESS-..., that nobody
/// else can write into: a file opened there by its name is never a link of another user.
/// Removes the folders that killed runs of this host left for the same name. Throws InputError.
[[nodiscard]] std::string temporary_name(const std::filesystem::path& path);

/// The order in which outputs come in place: the one staged first is last, or `main` where it is
/// one of them. Where it exists, the rest of the same run is beside it.
[[nodiscard]] std::vector<StagedFile> in_order_of_commit(const std::vector<StagedFile>& staged,
                                                         const std::string& main);

/// Final names of `file` and of the files that GDAL put beside it.
[[nodiscard]] std::vector<std::string> final_names(const StagedFile& file);

/// Syncs and renames `files` in their order, with the files that GDAL put beside them; `time`
/// becomes the last change of each, so that make sees none as older than another. Files that were
/// not written are passed over. Throws InputError when one cannot be put in place.
void put_in_place(const std::vector<StagedFile>& files, const timespec& time);

/// Removes the temporary files with their folders.
void remove_staged(const std::vector<StagedFile>& files);

/// Names outputs as the user did, not by where they were written for now.
[[nodiscard]] std::string with_final_names(std::string words, const std::vector<StagedFile>& files);

}  // namespace talus
