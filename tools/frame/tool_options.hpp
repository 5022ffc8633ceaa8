// tools/frame/tool_options.hpp
// Options that a tool has declared to CLI11: files read and written, the options of every tool, and
// the settings that are in effect.
#pragma once

#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "tools/frame/tool.hpp"

namespace talus {

struct InputOption {
  const CLI::Option* option;
  std::function<std::vector<std::string>()> paths;  ///< once the command line is known
};

struct OutputOption {
  const CLI::Option* option;
  const std::string* path;  ///< of the tool; empty: not wanted
  bool is_folder;
};

struct ToolOptions {
  std::vector<InputOption> inputs;
  std::vector<OutputOption> outputs;                      ///< the first one is the main one
  std::vector<const CLI::Option*> common;                 ///< of every tool
  const CLI::Option* json_option = nullptr;               ///< where --json may name a file
  const std::string* json_path = nullptr;                 ///< that file
  std::function<std::vector<ConfigValue>()> more_config;  ///< may be empty

  bool quiet = false, verbose = false, json = false, overwrite = false, no_db = false,
       print_config = false;
  std::string db;                 ///< as given; empty: beside the first output
  std::string label;              ///< before every message, to tell runs apart
  std::string progress = "auto";  ///< auto, plain, json or none
  std::string messages = "text";  ///< text or json
  std::string describe;           ///< json, or empty: the tool does its work
  bool network = false;           ///< may be used
  double memory_mb = 0;           ///< most to take [MB]; 0: the free memory
};

/// Adds the options of every tool to `app`, whose values go to `options`.
void add_common_options(const std::string& tool, CLI::App& app, ToolOptions& options);

/// The name that an option goes by in the registry: without dashes.
[[nodiscard]] std::string key_of(const CLI::Option& option);

/// All settings in effect: neither files nor options of every tool, then those of more_config.
[[nodiscard]] std::vector<ConfigValue> settings_of(const CLI::App& app, const ToolOptions& options);

/// Prints settings as TOML, each with a comment that says where it came from.
void print_settings(const std::vector<ConfigValue>& settings, std::ostream& out);

/// The registry that runs are recorded in; empty without an output to be beside.
[[nodiscard]] std::string registry_path(const ToolOptions& options);

}  // namespace talus
