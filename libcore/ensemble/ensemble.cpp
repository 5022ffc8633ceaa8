#include "ensemble/ensemble.hpp"

#include <algorithm>
#include <filesystem>
#include <map>

#include "record/part_file.hpp"

namespace talus {

namespace fs = std::filesystem;

const char* const ensemble_name = "ensemble.json";

const char* text(Outcome outcome) {
  switch (outcome) {
    case Outcome::done:
      return "done";
    case Outcome::failed_checks:
      return "failed its checks";
    case Outcome::no_result:
      return "no result";
    case Outcome::not_started:
      break;
  }
  return "not started";
}

int count_of(const Ensemble& ensemble, Outcome outcome) {
  return static_cast<int>(
      std::count_if(ensemble.members.begin(), ensemble.members.end(),
                    [outcome](const EnsembleMember& m) { return m.outcome == outcome; }));
}

int n_missing(const Ensemble& ensemble) {
  return count_of(ensemble, Outcome::no_result) + count_of(ensemble, Outcome::not_started);
}

bool is_ensemble(const std::string& path) {
  return fs::is_directory(path) || fs::path(path).filename() == ensemble_name;
}

std::vector<std::string> files_of(const Ensemble& ensemble, bool with_parts) {
  std::map<std::string, std::string> file_of;  // by run id
  for (const EnsembleMember& member : ensemble.members)
    if (has_result(member))
      file_of[member.run_id] = (fs::path(ensemble.folder) / member.file).string();
  std::vector<std::string> files;
  for (const std::string& name : with_parts ? ensemble.parts : std::vector<std::string>{}) {
    const std::string path = (fs::path(ensemble.folder) / name).lexically_normal().string();
    if (!fs::exists(path)) continue;
    const std::vector<RunFile> runs = PartFile(path).part.runs;
    const bool all_wanted = std::all_of(runs.begin(), runs.end(), [&](const RunFile& run) {
      return file_of.contains(run.info.run_id);
    });
    if (!all_wanted) continue;
    for (const RunFile& run : runs) file_of.erase(run.info.run_id);
    files.push_back(path);
  }
  for (const EnsembleMember& member : ensemble.members)
    if (const auto at = file_of.find(member.run_id); has_result(member) && at != file_of.end())
      files.push_back(at->second);
  return files;
}

}  // namespace talus
