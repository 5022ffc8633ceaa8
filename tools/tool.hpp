// tools/tool.hpp
// The frame of every executable: common options, inputs checked before long work, outputs written
// to a temporary name and renamed only when whole, progress, exit codes, the run registry, and the
// only catch. A tool is a list of options and one function.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "base/progress.hpp"

namespace talus {

using Json = nlohmann::ordered_json;

class Tool {
 public:
  /// `name` as typed ("talus-tin"); `purpose` one sentence for --help.
  Tool(std::string name, std::string purpose);
  ~Tool();
  Tool(const Tool&) = delete;
  Tool& operator=(const Tool&) = delete;

  /// For options that the functions below do not cover. Long names carry the unit (--cell-size-m).
  CLI::App& app();

  // --- declare, before run() ---------------------------------------------------------------------
  /// A file read: must exist; hashed into the registry with `role`, the option's name.
  /// A name without dashes is positional and required.
  CLI::Option* input(const std::string& name, std::string& path, const std::string& help);
  CLI::Option* inputs(const std::string& name, std::vector<std::string>& paths, const std::string& help);
  /// A file written: refused when it exists and --overwrite is not given, or when its folder cannot
  /// be written. The first declared one decides where runs.sqlite stands by default.
  CLI::Option* output(const std::string& name, std::string& path, const std::string& help);
  /// A folder written into (made when missing).
  CLI::Option* output_folder(const std::string& name, std::string& path, const std::string& help);
  /// A value with its default shown in --help and recorded in the registry with its source.
  template <class T>
  CLI::Option* option(const std::string& name, T& value, const std::string& help) {
    return app().add_option(name, value, help)->capture_default_str();
  }
  /// Remarks below the options in --help, e.g. an example.
  void footer(const std::string& text);

  // --- use, inside the body ----------------------------------------------------------------------
  /// Where to write `path` for now: a hidden name in the same folder with the same extension. All
  /// staged files are synced and renamed when the body has returned, removed when it has thrown.
  /// A sidecar (a style, statistics) is staged like any other file.
  std::string stage(const std::string& path);
  /// Further paths that were read but are not options (members of a folder, files named in a site file).
  void read_also(const std::string& role, const std::string& path);
  /// To hand to long work; throws Interrupted after SIGINT or SIGTERM.
  ProgressFunction progress();
  [[nodiscard]] bool interrupted() const;
  void info(const std::string& text);      ///< to stderr, not with -q
  void detail(const std::string& text);    ///< to stderr, with -v
  void warn(const std::string& text);      ///< to stderr, kept in the registry
  void metric(const std::string& name, double value, const std::string& unit);
  void check(const std::string& name, double value, double limit, bool pass);
  /// What --json prints; without --json, `summary` is printed to stdout, not with -q.
  void result(Json result, const std::string& summary);
  [[nodiscard]] bool overwrite() const;
  [[nodiscard]] std::string run_id() const;  ///< of this run in the registry; stands in the outputs' tags

  /// Parse, check, run `body`, commit the outputs, record, return the exit code.
  int run(int argc, char** argv, const std::function<void()>& body);

 private:
  struct Impl;
  Impl* impl_;
};

}  // namespace talus
