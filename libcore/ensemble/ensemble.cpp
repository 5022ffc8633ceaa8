// Members of a set of runs: outcomes, keys and files.
#include "ensemble/ensemble.hpp"

#include <algorithm>
#include <filesystem>
#include <map>

#include "base/error.hpp"
#include "ensemble/made_with.hpp"
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

std::string key_of(const EnsembleMember& member) { return member.run_id + " " + member.settings; }

std::vector<std::string> keys_in_part(const std::string& path) {
  std::vector<std::string> keys;
  if (!fs::exists(path)) return keys;
  try {
    for (const RunFile& run : PartFile(path).part.runs)
      keys.push_back(run.info.run_id + " " + settings_digest(run.info));
  } catch (const InputError&) {
    keys.clear();
  }
  return keys;
}

std::vector<std::string> files_of(const Ensemble& ensemble, bool with_parts) {
  std::map<std::string, std::string> file_of;  // by key_of()
  for (const EnsembleMember& member : ensemble.members)
    if (has_result(member))
      file_of[key_of(member)] = (fs::path(ensemble.folder) / member.file).string();
  std::vector<std::string> files;
  for (const std::string& name : with_parts ? ensemble.parts : std::vector<std::string>{}) {
    const std::string path = (fs::path(ensemble.folder) / name).lexically_normal().string();
    const std::vector<std::string> keys = keys_in_part(path);
    if (keys.empty() || !std::all_of(keys.begin(), keys.end(),
                                     [&](const std::string& key) { return file_of.contains(key); }))
      continue;
    for (const std::string& key : keys) file_of.erase(key);
    files.push_back(path);
  }
  for (const EnsembleMember& member : ensemble.members)
    if (const auto at = file_of.find(key_of(member)); has_result(member) && at != file_of.end())
      files.push_back(at->second);
  return files;
}

}  // namespace talus
