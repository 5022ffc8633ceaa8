// Steps from the first files to the results, as rows of a page.
#include "report/provenance.hpp"

#include <algorithm>
#include <filesystem>
#include <set>

namespace talus {
namespace fs = std::filesystem;
namespace {

// With the tool's folder left out, so that the place of the programs does not matter.
std::string bare_command(const std::string& command) {
  const std::size_t space = command.find(' ');
  const std::size_t slash = command.rfind('/', space);
  return slash == std::string::npos || slash > space ? command : command.substr(slash + 1);
}

// Below the site's folder as a relative path, else as it is.
std::string shown_path(const std::string& path, const std::string& site_file) {
  const fs::path folder = fs::weakly_canonical(fs::absolute(fs::path(site_file)).parent_path());
  const fs::path relative = fs::path(path).lexically_relative(folder);
  return relative.empty() ? path : relative.string();
}

std::vector<StepFile> files_of(const std::vector<RunArtifact>& files,
                               const std::string& site_file) {
  std::vector<StepFile> shown;
  for (const RunArtifact& file : files)
    if (file.role != "part")  // the runs of a part are there themselves
      shown.push_back({shown_path(file.path, site_file), file.sha256.substr(0, 12)});
  std::sort(shown.begin(), shown.end());
  return shown;
}

// The words of a command for the shell, as they are quoted.
std::vector<std::string> words_of(const std::string& command) {
  std::vector<std::string> words;
  std::string word;
  bool is_quoted = false;
  for (std::size_t i = 0; i < command.size(); ++i) {
    if (command[i] == '\\' && !is_quoted && i + 1 < command.size())
      word += command[i++];
    else if (command[i] == '\'')
      is_quoted = !is_quoted;
    if (command[i] != ' ' || is_quoted) {
      word += command[i];
      continue;
    }
    if (!word.empty()) words.push_back(word);
    word.clear();
  }
  if (!word.empty()) words.push_back(word);
  return words;
}

bool holds_runs(const RunArtifact& file) {
  return file.role == "run" || file.role == "without" || file.role == "part";
}

// Without the options that results do not depend on: the registry, which differs for runs that were
// computed in shards, and how talus-batch started a run. With one name for all runs of an option,
// which may be named by parts of them: they are listed beside it.
std::string short_command(const RunRecord& step) {
  std::set<fs::path> runs;
  for (const RunArtifact& file : step.inputs)
    if (holds_runs(file)) runs.insert(fs::path(file.path).lexically_normal());
  const std::vector<std::string> words = words_of(bare_command(step.command_line));
  std::set<std::string> named;
  std::string out;
  const auto add = [&out](const std::string& word) { out += (out.empty() ? "" : " ") + word; };
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == "--db" || words[i] == "--threads") {
      ++i;
      continue;
    }
    if (words[i].starts_with("--messages=") || words[i].starts_with("--progress=")) continue;
    const bool is_without = words[i] == "--without" && i + 1 < words.size();
    const std::string& file = words[is_without ? i + 1 : i];
    if (runs.count((fs::path(step.folder) / file).lexically_normal()) == 0) {
      add(words[i]);
      continue;
    }
    i += is_without ? 1 : 0;
    const std::string name = is_without ? "--without RUN.h5..." : "RUN.h5...";
    if (named.insert(name).second) add(name);
  }
  return out;
}

}  // namespace

std::vector<ProvenanceStep> provenance_steps(const std::vector<RunRecord>& steps,
                                             const std::string& site_file) {
  std::vector<ProvenanceStep> shown;
  for (const RunRecord& step : steps) {
    shown.push_back({short_command(step),
                     step.version + " (" + step.git_commit + ")",
                     step.content_id,
                     {},
                     files_of(step.inputs, site_file),
                     files_of(step.outputs, site_file)});
    for (const RunEvent& event : step.events)
      if (event.level == "info") shown.back().notes.push_back(event.text);
  }
  return shown;
}

}  // namespace talus
