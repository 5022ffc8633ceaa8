#include "report/provenance.hpp"

#include <algorithm>
#include <filesystem>

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

std::string file_list(const std::vector<RunArtifact>& files, const std::string& site_file) {
  std::vector<std::string> lines;
  for (const RunArtifact& file : files)
    lines.push_back("<code>" + xml_escaped(shown_path(file.path, site_file)) + "</code> <code>" +
                    (file.sha256.empty() ? "not hashed" : file.sha256.substr(0, 12)) + "</code>");
  std::sort(lines.begin(), lines.end());
  std::string out;
  for (const std::string& line : lines) out += (out.empty() ? "" : "<br>") + line;
  return out;
}

// The command, and what it said of its inputs: operations by which they were reprojected.
std::string command_cell(const RunRecord& step) {
  std::string cell = "<code>" + xml_escaped(bare_command(step.command_line)) + "</code>";
  for (const RunEvent& event : step.events)
    if (event.level == "info") cell += "<br>" + xml_escaped(event.text);
  return cell;
}

}  // namespace

std::string provenance_table(const std::vector<RunRecord>& steps, const std::string& site_file) {
  std::vector<std::vector<std::string>> rows;
  for (const RunRecord& step : steps)
    rows.push_back({command_cell(step), xml_escaped(step.version + " (" + step.git_commit + ")"),
                    "<code>" + xml_escaped(step.content_id) + "</code>",
                    file_list(step.inputs, site_file), file_list(step.outputs, site_file)});
  return html_table({"command", "version", "run id", "read", "wrote"}, rows);
}

}  // namespace talus
