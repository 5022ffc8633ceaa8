// The JSON of --describe: options and outputs of a tool, for dialogs and completions.
#include "tools/frame/tool_description.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "base/text.hpp"
#include "tools/frame/build_info.hpp"

namespace talus {
namespace {

bool is_common(const ToolOptions& options, const CLI::Option* option) {
  return std::find(options.common.begin(), options.common.end(), option) != options.common.end();
}

// Role of the option: a file read or written, a folder, a value or a switch.
std::string role_of(const CLI::Option& option, const ToolOptions& options) {
  for (const InputOption& input : options.inputs)
    if (input.option == &option) return "input";
  for (const OutputOption& output : options.outputs)
    if (output.option == &option) return output.is_folder ? "output_folder" : "output";
  return option.get_items_expected_max() == 0 ? "flag" : "value";
}

// CLI11 names types by their C++ type, with the choices behind a colon.
std::string type_of(const CLI::Option& option) {
  const std::string name = option.get_type_name();
  if (name.starts_with("FLOAT")) return "number";
  if (name.starts_with("INT") || name.starts_with("UINT")) return "integer";
  return "text";
}

// Of "TEXT:{a,b}".
Json choices_of(const CLI::Option& option) {
  const std::string name = option.get_type_name();
  const std::size_t open = name.find(":{"), close = name.rfind('}');
  Json choices = Json::array();
  if (open == std::string::npos || close == std::string::npos) return choices;
  std::string word;
  for (const char c : name.substr(open + 2, close - open - 2) + ",") {
    if (c != ',') {
      word += c;
      continue;
    }
    choices.push_back(word);
    word.clear();
  }
  return choices;
}

// How it is written on a command line: the long name; of a positional one, its name.
std::string spelling_of(const CLI::Option& option) {
  if (option.get_positional()) return key_of(option);
  return option.get_lnames().empty() ? "-" + option.get_snames()[0] : "--" + option.get_lnames()[0];
}

Json as_json(const CLI::Option& option, const ToolOptions& options) {
  const std::string role = role_of(option, options);
  Json entry = {{"key", key_of(option)},
                {"spelling", spelling_of(option)},
                {"positional", option.get_positional()},
                {"role", role}};
  if (role == "value") entry["type"] = type_of(option);
  if (const Json choices = choices_of(option); !choices.empty()) entry["choices"] = choices;
  if (!option.get_default_str().empty()) entry["default"] = option.get_default_str();
  entry["required"] = option.get_required();
  entry["several"] = option.get_items_expected_max() > 1;
  entry["help"] = option.get_description();
  return entry;
}

Json options_of(const CLI::App& app, const ToolOptions& options, bool common) {
  Json list = Json::array();
  for (const CLI::Option* option : app.get_options())
    if (option != app.get_help_ptr() && option != app.get_version_ptr() &&
        is_common(options, option) == common)
      list.push_back(as_json(*option, options));
  return list;
}

}  // namespace

Json description_of(const std::string& tool, const CLI::App& app, const ToolOptions& options) {
  Json out = {{"tool", tool},
              {"version", build_version},
              {"purpose", app.get_description()},
              {"options", options_of(app, options, false)},
              {"common_options", options_of(app, options, true)}};
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    out["commands"].push_back({{"name", command->get_name()},
                               {"purpose", command->get_description()},
                               {"options", options_of(*command, options, false)}});
  return out;
}

}  // namespace talus
