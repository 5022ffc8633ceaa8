// Options that a tool has declared to CLI11, and the settings in effect.
#include "tools/frame/tool_options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>

#include "base/file_paths.hpp"
#include "base/printable.hpp"
#include "base/text.hpp"
#include "tools/frame/build_info.hpp"
#include "tools/frame/command_line.hpp"

namespace talus {
namespace {

bool is_setting(const CLI::App& app, const ToolOptions& options, const CLI::Option* option) {
  if (option == app.get_help_ptr() || option == app.get_version_ptr()) return false;
  const auto is_same = [option](const CLI::Option* declared) { return declared == option; };
  const auto declares = [option](const auto& file) { return file.option == option; };
  return std::none_of(options.common.begin(), options.common.end(), is_same) &&
         std::none_of(options.inputs.begin(), options.inputs.end(), declares) &&
         std::none_of(options.outputs.begin(), options.outputs.end(), declares);
}

ConfigValue value_of(const CLI::Option& option) {
  if (option.count() == 0) return {key_of(option), option.get_default_str(), "default"};
  std::string value;
  for (const std::string& word : option.results()) value += (value.empty() ? "" : " ") + word;
  return {key_of(option), value, "cli"};
}

}  // namespace

void add_common_options(const std::string& tool, CLI::App& app, ToolOptions& options) {
  app.set_version_flag("--version", tool + " " + build_version + " (" + build_commit + ")");
  for (CLI::Option* option :
       {app.add_flag("-q,--quiet", options.quiet, "print errors only"),
        app.add_flag("-v,--verbose", options.verbose, "say more of what is done"),
        app.add_flag("--json", options.json, "print the result as one JSON object"),
        app.add_flag("--overwrite", options.overwrite, "replace outputs that exist"),
        app.add_option("--db", options.db, "run registry [runs.sqlite beside the output]"),
        app.add_flag("--no-db", options.no_db, "do not record the run"),
        app.add_option("--label", options.label, "put this word before every message"),
        app.add_option("--progress", options.progress,
                       "how much is done: on a terminal in place, else a line a minute (auto); a "
                       "line a second (plain) or two (json), or none")
            ->check(CLI::IsMember({"auto", "plain", "json", "none"}))
            ->envname("TALUS_PROGRESS")
            ->capture_default_str(),
        app.add_option("--messages", options.messages,
                       "what is said on standard error: text, or json, an object a line")
            ->check(CLI::IsMember({"text", "json"}))
            ->capture_default_str(),
        app.add_flag("--allow-network", options.network,
                     "inputs may lead to other machines and to files that they do not name openly"),
        app.add_option("--describe", options.describe,
                       "print what the tool takes and gives, for programs that call it, then end")
            ->check(CLI::IsMember({"json"})),
        app.add_option("--memory-mb", options.memory_mb,
                       "most memory to take [MB]; more is refused before it is taken; 0: what is "
                       "free on this machine")
            ->check(number_between(0, 1e9))
            ->capture_default_str(),
        app.add_flag("--print-config", options.print_config,
                     "print the effective settings and where each came from, then end")}) {
    option->group("Common options");
    options.common.push_back(option);
  }
}

std::string key_of(const CLI::Option& option) {
  return option.get_lnames().empty() ? option.get_name() : option.get_lnames()[0];
}

std::vector<ConfigValue> settings_of(const CLI::App& app, const ToolOptions& options) {
  std::vector<ConfigValue> values;
  for (const CLI::Option* option : app.get_options())
    if (is_setting(app, options, option)) values.push_back(value_of(*option));
  if (options.more_config)
    for (ConfigValue& value : options.more_config()) values.push_back(std::move(value));
  return values;
}

void print_settings(const std::vector<ConfigValue>& settings, std::ostream& out) {
  for (const ConfigValue& value : settings) {
    double number = 0;
    const bool is_bare = parse_double(value.value, number) || value.value == "true" ||
                         value.value == "false" || (!value.value.empty() && value.value[0] == '[');
    out << printable(value.key) << " = "
        << (is_bare ? printable_json(value.value) : json_text(value.value)) << "  # "
        << printable(value.source) << '\n';
  }
}

std::string registry_path(const ToolOptions& options) {
  if (!options.db.empty()) return options.db;
  for (const OutputOption& output : options.outputs) {
    if (output.path->empty()) continue;
    const std::filesystem::path path = *output.path;
    return ((output.is_folder ? path : folder_of(path)) / "runs.sqlite").string();
  }
  return "";
}

}  // namespace talus
