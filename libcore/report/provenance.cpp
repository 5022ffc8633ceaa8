#include "report/provenance.hpp"

#include <algorithm>
#include <filesystem>
#include <set>

#include "base/text.hpp"
#include "report/html.hpp"

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

std::string file_list(const Texts& texts, const std::vector<RunArtifact>& files,
                      const std::string& site_file) {
  std::vector<std::string> lines;
  for (const RunArtifact& file : files)
    lines.push_back(
        "<code>" + xml_escaped(shown_path(file.path, site_file)) + "</code> <code>" +
        (file.sha256.empty() ? texts.of("provenance.not_hashed") : file.sha256.substr(0, 12)) +
        "</code>");
  std::sort(lines.begin(), lines.end());
  std::string out;
  for (const std::string& line : lines) out += (out.empty() ? "" : "<br>") + line;
  return out;
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

// Without what results do not depend on: the registry, which is another one for runs that were
// computed in shards, and how talus-batch started a run. With one name for all runs of an option,
// which may be named by parts of them: they stand beside it.
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

// The command, and what it said of its inputs: operations by which they were reprojected.
std::string command_cell(const RunRecord& step) {
  std::string cell = "<code>" + xml_escaped(short_command(step)) + "</code>";
  for (const RunEvent& event : step.events)
    if (event.level == "info") cell += "<br>" + xml_escaped(event.text);
  return cell;
}

// Parts of runs are left out: the runs are there themselves.
std::vector<RunArtifact> shown_inputs(const RunRecord& step) {
  std::vector<RunArtifact> shown;
  for (const RunArtifact& file : step.inputs)
    if (file.role != "part") shown.push_back(file);
  return shown;
}

}  // namespace

std::string provenance_table(const Texts& texts, const std::vector<RunRecord>& steps,
                             const std::string& site_file) {
  std::vector<std::vector<std::string>> rows;
  for (const RunRecord& step : steps)
    rows.push_back({command_cell(step), xml_escaped(step.version + " (" + step.git_commit + ")"),
                    "<code>" + xml_escaped(step.content_id) + "</code>",
                    file_list(texts, shown_inputs(step), site_file),
                    file_list(texts, step.outputs, site_file)});
  return html_table(texts.list("provenance.heads"), rows);
}

}  // namespace talus
