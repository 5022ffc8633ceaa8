// tools/frame/tool.hpp
// The frame of every executable: common options, inputs checked before long work, outputs written
// to a temporary name and renamed only when whole, progress, exit codes, the run registry, and the
// only catch. A tool is a list of options and one function. docs/tools/common.md
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/input_log.hpp"
#include "base/json.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace talus {

/// JSON as text that may reach a file or a terminal, with any bytes in its texts.
[[nodiscard]] std::string json_text(const Json& json, int indent = -1);

/// One effective setting and where it came from: "default", "cli", or a place in the site file.
struct ConfigValue {
  std::string key;
  std::string value;
  std::string source;
};

/// An option that was declared. Each function says more of it and returns it.
class ToolOption {
 public:
  explicit ToolOption(CLI::Option* option) : option_(option) {}
  const ToolOption& required(bool is = true) const;
  const ToolOption& needs(const ToolOption& other) const;  ///< is refused without it
  const ToolOption& one_of(const std::vector<std::string>& words) const;
  const ToolOption& between(int low, int high) const;
  const ToolOption& between(std::int64_t low, std::int64_t high) const;
  const ToolOption& between(double low, double high) const;
  const ToolOption& positive() const;
  const ToolOption& not_negative() const;
  const ToolOption& existing_file() const;
  /// `fault_of` a word: its fault; empty: none.
  const ToolOption& check(const std::function<std::string(const std::string&)>& fault_of) const;
  const ToolOption& without_default() const;  ///< its help describes the default in words
  [[nodiscard]] bool is_given() const;

 private:
  CLI::Option* option_;
};

class Tool : public InputLog {
 public:
  /// `name` as typed ("talus-tin"); `purpose` one sentence for --help.
  Tool(std::string name, std::string purpose);
  ~Tool() override;

  /// For uses that the functions below do not cover (sub-commands).
  CLI::App& app();

  // --- declare, before run() ---------------------------------------------------------------------
  /// A file read: must exist; hashed into the registry under the option's name. A name without
  /// dashes is positional and required. GDAL's virtual paths (/vsi...) are passed on unchecked;
  /// the text behind the file's name ("|layername=a", a member of an archive) is recorded.
  ToolOption input(const std::string& name, std::string& path, const std::string& help);
  ToolOption inputs(const std::string& name, std::vector<std::string>& paths,
                    const std::string& help);
  /// A file written: refused when it exists and --overwrite is not given, when it is also an input,
  /// or when its folder cannot be written. runs.sqlite is beside the first one given.
  ToolOption output(const std::string& name, std::string& path, const std::string& help);
  /// A folder written into, made when missing; refused when not empty without --overwrite.
  ToolOption output_folder(const std::string& name, std::string& path, const std::string& help);
  /// Lets --json name a file that the result is written to; without a name it prints, as always.
  void json_output(std::string& path);
  /// A value; its default is shown by --help, and its effective value is recorded with its source.
  /// tool_option.cpp lists the types.
  template <class T>
  ToolOption option(const std::string& name, T& value, const std::string& help);
  /// A value that is taken as it is read.
  ToolOption option(const std::string& name, const std::function<void(const std::string&)>& take,
                    const std::string& help);
  /// Words: one each time the option is given, or all words at this place.
  ToolOption list(const std::string& name, std::vector<std::string>& words,
                  const std::string& help);
  ToolOption flag(const std::string& name, bool& value, const std::string& help);
  /// A flag that may be given a word, as --plan=full.
  ToolOption flag(const std::string& name, std::string& word, const std::string& help);
  /// Remarks below the options in --help, e.g. an example.
  void footer(const std::string& text);
  /// Settings beyond the command line (a site file's), asked for once the command line is known;
  /// shown by --print-config and recorded. May throw InputError.
  void more_config(std::function<std::vector<ConfigValue>()> settings);

  // --- use, inside the body ----------------------------------------------------------------------
  /// A file that will be written and has no option of its own, as one beside an output: checked
  /// like an output, before long work. `may_exist`: it is replaced without --overwrite.
  void write_also(const std::string& path, bool may_exist = false);
  /// Where to write `path` for now: a hidden name in the same folder with the same extension. All
  /// staged files are synced and renamed when the body has returned, removed when it has thrown.
  /// Sidecars (styles, statistics) are staged like any other file.
  [[nodiscard]] std::string stage(const std::string& path);
  /// The same, but put in place also where the body refuses its input (InputError): places to look
  /// at.
  [[nodiscard]] std::string stage_also_if_refused(const std::string& path);
  /// Stages `path`, which is written at the end with all doubts that there are by then.
  void report(const std::string& path, Json content, bool also_if_refused = false);
  /// Before the outputs are put in place, also where the body refuses its input.
  void at_end(std::function<void()> work);
  /// Stages `path` and writes `content` into it. Throws InputError when it cannot be written.
  void write_text(const std::string& path, const std::string& content);
  // As InputLog: files beside the options' values (named in a site file, member of a set), layers,
  // which become entries of `layers_read` in what --json prints, doubts, which are kept in the
  // registry, in reports and in result(), and notes: both to stderr, not with -q, details with -v
  // alone. An error that ends the work is a doubt too.
  void read_also(const std::string& role, const std::string& path) override;
  void read_by_content(const std::string& path) override;
  void content_read(const std::string& role, const std::string& digest) override;
  void layer_read(const LayerRead& layer) override;
  void doubts(const std::vector<Doubt>& found) override;
  void note(Severity severity, const std::string& text) override;
  /// A file that the site file names, whether or not it is read: no output may be it.
  void keep(const std::string& path);
  /// To hand to long work; throws Interrupted after SIGINT, SIGTERM or SIGHUP.
  [[nodiscard]] ProgressFunction progress() override;
  [[nodiscard]] bool interrupted() const;                        ///< one of these has come
  [[nodiscard]] const Json& layers_read() const;                 ///< of layer_read(), in order
  [[nodiscard]] const std::vector<Doubt>& doubts_found() const;  ///< of doubts(), in order
  void metric(const std::string& name, double value, const std::string& unit);
  /// A limit of the run's health; a failed one makes the exit code 3 once the outputs are in place,
  /// and is said with `hint`, the remedy.
  void check(const std::string& name, double value, double limit, bool pass,
             const std::string& hint = "");
  /// Output of --json; without --json `summary` goes to stdout, not with -q.
  void result(Json result, const std::string& summary);
  /// The same of lines that stay as they are, however long.
  void listing(Json result, const std::string& lines);
  [[nodiscard]] bool prints_json() const;  ///< --json: `lines` of a listing are not printed
  [[nodiscard]] bool overwrite() const;
  [[nodiscard]] double memory_mb() const;      ///< as given; 0: the free memory
  [[nodiscard]] bool is_recorded() const;      ///< not with --no-db
  [[nodiscard]] std::string registry() const;  ///< that runs are recorded in, whether or not there
  /// Leaves these out of run_id(): settings by their keys and inputs by their roles that equal
  /// results may differ in, or that other settings imply. All the rest count, and so does every
  /// input that was named by read_also() or content_read() before the first call of run_id().
  void leave_out_of_run_id(const std::vector<std::string>& names);
  /// Digest of tool, version, options and input contents (16 digits); it is in outputs' tags.
  [[nodiscard]] std::string run_id();
  /// Contents that run_id() counts beside the site file's values, a line each (made_with_text),
  /// without inputs of these roles.
  [[nodiscard]] std::string made_with(const std::set<std::string>& left_out) const;

  /// Parse, check, run `body`, put the outputs in place, record; returns the exit code.
  int run(int argc, char** argv, const std::function<void()>& body);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace talus
