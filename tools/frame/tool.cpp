// The frame of every executable: options, checks, outputs, exit codes, registry, the only catch.
#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <set>
#include <utility>

#include "base/file_paths.hpp"
#include "base/memory.hpp"
#include "base/network.hpp"
#include "base/printable.hpp"
#include "base/source_path.hpp"
#include "base/text.hpp"
#include "store/runs.hpp"
#include "tools/frame/command_line.hpp"
#include "tools/frame/doubts_json.hpp"
#include "tools/frame/exit_code.hpp"
#include "tools/frame/gone_options.hpp"
#include "tools/frame/output_checks.hpp"
#include "tools/frame/progress_line.hpp"
#include "tools/frame/run_record.hpp"
#include "tools/frame/staged_files.hpp"
#include "tools/frame/stop_signals.hpp"
#include "tools/frame/tool_description.hpp"
#include "tools/frame/tool_options.hpp"

namespace talus {
namespace fs = std::filesystem;
namespace {

// The value of an option on a command line that could not be parsed; "" where it is not there.
std::string word_after(const std::string& option, int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == option && i + 1 < argc) return argv[i + 1];
    if (word.starts_with(option + "=")) return word.substr(option.size() + 1);
  }
  return "";
}

// A program may be started with its standard files closed. The next file to be opened would get the
// number of one of them, and messages would go into it. To a closed output nothing can be written.
void occupy_standard_files() {
  constexpr const char* stand_ins[] = {"/dev/null", "/dev/full", "/dev/null"};
  for (int number = STDIN_FILENO; number <= STDERR_FILENO; ++number)
    if (fcntl(number, F_GETFD) == -1 && open(stand_ins[number], O_RDWR) < 0)
      static_cast<void>(open("/dev/null", O_RDWR));
}

// A process that runs out of its stack ends by a signal, without a message. Threads get as much as
// the limit says. The sample sites need less than 320 kB.
void check_stack() {
  constexpr rlim_t kilobyte = 1024, needed = 1024 * kilobyte;
  rlimit stack{};
  if (getrlimit(RLIMIT_STACK, &stack) != 0 || stack.rlim_cur >= needed) return;
  throw InputError({"stack of this process"},
                   "limited to " + std::to_string(stack.rlim_cur / kilobyte) +
                       " kB, expected at least " + std::to_string(needed / kilobyte) + " kB",
                   "ulimit -s 8192, in a new shell if this one refuses");
}

// Thrown while words are parsed, before it is asked whether all that is needed is there.
struct CallForDescription : CLI::Success {};

// The levels of messages. A hint belongs to the error before it.
constexpr const char *info_level = "info", *warning_level = "warning", *error_level = "error",
                     *hint_level = "hint";

void write_whole(const std::string& path, const std::string& content) {
  std::ofstream file(path, std::ios::binary);
  file << content;
  file.close();
  if (!file) throw InputError({path}, std::string("cannot be written: ") + std::strerror(errno));
}

// The role, in the registry, of a file that does not count by its bytes.
constexpr const char* by_content_role = "by content";

}  // namespace

std::string json_text(const Json& json, int indent) { return printable_json(json.dump(indent)); }

struct Tool::Impl {
  std::string name;
  CLI::App app;
  ToolOptions options;

  std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
  std::vector<StagedFile> staged;
  std::vector<std::string> kept_if_refused;  // paths among them
  RunRecord record;
  std::vector<std::string> check_hints;  // of record.checks
  RunIdParts id_parts;
  std::set<std::string> by_content;  // files of read_by_content()
  KeptFiles kept;
  bool are_outputs_checked = false;
  Json result;
  Json layers_read = Json::array();
  std::vector<Doubt> doubts;
  std::vector<std::pair<std::string, Json>> reports;  // staged paths
  std::vector<std::function<void()>> at_end;
  std::string summary;
  bool is_listing = false;  // the summary: its lines stay as they are
  bool registered = false;  // to be recorded; record.id is 0 while it has no row
  bool is_late = false;     // the registry was locked once: it is not waited for again
  ProgressLine progress_line;

  Impl(std::string tool_name, std::string purpose)
      : name(std::move(tool_name)), app(std::move(purpose), name) {}

  double seconds_since_start() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }

  void say(const char* level, const std::string& text) {
    progress_line.end();
    std::cerr << (options.messages == "json" ? as_object(level, text)
                                             : as_words(level, printable(text)))
              << std::endl;
  }

  std::string as_words(const std::string& level, const std::string& text) const {
    if (level == info_level) return labelled(text);
    if (level == hint_level)
      return (options.label.empty() ? "" : options.label + ": ") + "  hint: " + text;
    return labelled(name + (level == warning_level ? ": warning: " : ": ") + text);
  }

  std::string as_object(const std::string& level, const std::string& text) const {
    Json object = {{"level", level}, {"tool", name}};
    if (!options.label.empty()) object["label"] = options.label;
    object["text"] = text;
    return json_text(object);
  }

  // In lines that a terminal holds.
  std::string labelled(const std::string& text) const {
    constexpr std::size_t columns = 120;
    std::string lines;
    for (std::size_t from = 0; from <= text.size();) {
      const std::size_t end = std::min(text.find('\n', from), text.size());
      const std::string line = text.substr(from, end - from);
      lines += (from == 0 ? "" : "\n") +
               folded(options.label.empty() ? line : options.label + ": " + line, columns);
      from = end + 1;
    }
    return lines;
  }

  void event(const std::string& level, const std::string& text) {
    record.events.push_back({seconds_since_start(), level, printable(text)});
  }

  void add_input(const std::string& role, const std::string& path) {
    const std::string file = file_of(path);
    if (role != by_content_role && by_content.contains(absolute_path(file))) return;
    if (!is_virtual(file) && !fs::exists(file_behind(file)))
      throw InputError(
          {file}, "there is no such file",
          "check the path given for " + role +
              (file.find_first_of("\\\n\t\b\r\f") != std::string::npos
                   ? "; write / between folders: a backslash begins a special sign in double "
                     "quotes, and is part of a name elsewhere"
                   : ""));
    record.inputs.push_back(artifact_of(role, file));
    for (const std::string& member : sidecars_of(file))
      if (fs::exists(member)) record.inputs.push_back(artifact_of(role, member));
    keep(file, "is both an input and an output");
  }

  // The body may name further files when outputs have been looked at.
  void keep(const std::string& path, const std::string& finding) {
    kept.add(path, finding);
    if (!are_outputs_checked) return;
    for (const OutputOption& output : options.outputs)
      if (!output.is_folder && !output.path->empty()) kept.refuse(*output.path);
  }

  void add_inputs() {
    for (const InputOption& input : options.inputs)
      for (const std::string& path : input.paths())
        if (!path.empty()) add_input(key_of(*input.option), path);
  }

  // The part of a file that an option names ("|layername=a") is a setting like any.
  void add_parts_of_inputs() {
    for (const InputOption& input : options.inputs)
      for (const std::string& path : input.paths())
        if (const std::string inside = part_named(path); !inside.empty())
          record.params.push_back({key_of(*input.option) + "-part", inside, "cli"});
  }

  void begin(int argc, char** argv) {
    if (options.db == ":memory:")
      throw UsageError({"", 0, "--db"}, "is :memory:, which SQLite takes for no file",
                       "name a file, or run with --no-db");
    begin_record(name, command_text(argc, argv), record);
    for (const ConfigValue& value : settings_of(app, options))
      record.params.push_back({value.key, value.value, value.source});
    add_parts_of_inputs();
    add_inputs();
    check_outputs(options, kept);
    are_outputs_checked = true;
    register_run();
  }

  void register_run() {
    if (options.no_db || registry_path(options).empty()) return;
    record.content_id = content_id(record, id_parts);
    record.status = "running";
    registered = true;
    try {
      record.id = start_run(registry_path(options), record);
    } catch (const RegistryBusy& error) {
      is_late = true;
      say(warning_level, std::string(error.what()) + "; the run is recorded when it has ended");
    } catch (const InputError&) {  // none, nor will it be one at the end
      registered = false;
      throw;
    }
    record.content_id.clear();  // the body may name further inputs
  }

  // The body may name further inputs until it asks for the id, or ends.
  void complete_content_id() {
    if (record.content_id.empty()) record.content_id = content_id(record, id_parts);
  }

  void finish_record(int exit_code) {
    complete_content_id();
    end_record(exit_code, seconds_since_start(), record);
    const std::string db = registry_path(options);
    const int wait_ms = is_late ? 0 : registry_wait_ms();
    try {
      record.id > 0 ? finish_run(db, record, wait_ms) : (void)add_run(db, record, wait_ms);
    } catch (const InputError& error) {
      keep_late_record(error.what());
    }
  }

  // An output is worth more than its entry, which is then kept in a registry of its own.
  void keep_late_record(const std::string& why) {
    const std::string db = registry_path(options), late = late_registry(db);
    const std::string found = why + "; whatever this run wrote is in place, its entry ";
    try {
      add_run(late, record);
      say(warning_level, found + "is in " + late);
      say(hint_level,
          "talus-runs --db " + db + " adopt enters it once the registry can be written");
    } catch (const InputError&) {
      say(warning_level, found + "is lost");
    }
  }

  // Outputs by their final names, while they still have their temporary ones. An output that exists
  // is in the registry. A hidden file is a tool's memory between its runs, not a result.
  void record_outputs(const std::vector<StagedFile>& files) {
    for (const StagedFile& file : files) {
      if (!fs::exists(file.temporary) || fs::path(file.path).filename().string()[0] == '.')
        continue;
      record.outputs.push_back(artifact_of("output", file.temporary));
      record.outputs.back().path = absolute_path(file.path);
    }
    if (!registered || files.empty()) return;
    complete_content_id();
    if (record.id == 0) return;
    try {
      record_results(registry_path(options), record);
    } catch (const InputError&) {
      is_late = true;  // said at the end, with where the entry is then
    }
  }

  void write_at_end() {
    for (const auto& work : at_end) work();
    for (auto& [path, json] : reports) {
      add_doubts(doubts, json);
      write_whole(path, json_text(json, 2) + "\n");
    }
  }

  void commit_outputs() {
    timespec now{};
    clock_gettime(CLOCK_REALTIME, &now);
    const std::vector<OutputOption>& outputs = options.outputs;
    const std::vector<StagedFile> files =
        in_order_of_commit(staged, outputs.empty() ? "" : *outputs.front().path);
    for (const StagedFile& file : files)
      for (const std::string& path : final_names(file)) kept.refuse(path);
    record_outputs(files);
    put_in_place(files, now);
    staged.clear();
  }

  void print_result() {
    if (options.json && !result.is_null()) {
      add_doubts(doubts, result);
      std::cout << json_text(result, 2) << '\n';
    } else if (!options.json && !options.quiet && !summary.empty()) {
      std::cout << (is_listing ? printable(summary) : labelled(printable(summary))) << '\n';
    }
    if (!std::cout.flush()) throw InputError({"standard output"}, "cannot be written");
  }

  bool all_checks_pass() const {
    return std::all_of(record.checks.begin(), record.checks.end(),
                       [](const RunCheck& check) { return check.pass; });
  }

  // Keeps the outputs that help to mend an input that was refused. A failure here must
  // not hide the first one.
  void keep_places() {
    timespec now{};
    clock_gettime(CLOCK_REALTIME, &now);
    try {
      write_at_end();
      std::vector<StagedFile> kept;
      for (const StagedFile& file : staged)
        if (std::count(kept_if_refused.begin(), kept_if_refused.end(), file.path) > 0)
          kept.push_back(file);
      put_in_place(kept, now);
    } catch (const InputError& error) {
      say(error_level, error.what());
    }
  }

  int fail(int code, std::string what, const std::string& hint) {
    what = printable(with_final_names(std::move(what), staged));
    if (code == input_unusable) keep_places();
    remove_staged(staged);
    staged.clear();
    event("error", what);
    say(error_level, what);
    say_hint(hint);
    return code;
  }

  void say_hint(const std::string& hint) {
    if (hint.empty()) return;
    say(hint_level, hint);
  }

  int guarded(const std::function<int()>& work) {
    try {
      return work();
    } catch (const UsageError& error) {
      return fail(usage_wrong, error.what(), error.hint());
    } catch (const InputError& error) {
      // one of several that were refused has been told
      if (refusal_of(doubts).state != DoubtState::refused) doubts.push_back(error.doubt());
      return fail(input_unusable, error.what(), error.hint());
    } catch (const NumericsError& error) {
      return fail(numbers_failed, error.what(), "");
    } catch (const Interrupted&) {
      return fail(stopped, "interrupted", "");
    } catch (const std::bad_alloc&) {
      return fail(input_unusable, "out of memory", "give it more memory, or a smaller window");
    } catch (const fs::filesystem_error& error) {  // a link to itself, a name that is too long
      return fail(input_unusable,
                  InputError({error.path1().string()}, error.code().message()).what(), "");
    } catch (const std::exception& error) {
      return fail(input_unusable, std::string("unexpected: ") + error.what(), "");
    }
  }

  int work_and_commit(const std::function<void()>& body) {
    progress_line.restart();
    body();
    progress_line.done();
    if (stop_requested()) throw Interrupted();
    write_at_end();
    commit_outputs();
    print_result();
    for (std::size_t i = 0; i < record.checks.size(); ++i) {
      const RunCheck& check = record.checks[i];
      if (check.pass) continue;
      const std::string what =
          check.name + " is " + text(check.value, 6) + ", limit " + text(check.limit, 6);
      say(error_level, "health: " + what);
      say_hint(check_hints[i]);
    }
    return all_checks_pass() ? done : numbers_failed;
  }
};

Tool::Tool(std::string name, std::string purpose)
    : impl_(std::make_unique<Impl>(std::move(name), std::move(purpose))) {
  add_common_options(impl_->name, impl_->app, impl_->options);
  impl_->app.get_option("--describe")->each([](const std::string& form) {
    if (form == "json") throw CallForDescription();
  });
}

Tool::~Tool() = default;

CLI::App& Tool::app() { return impl_->app; }

ToolOption Tool::input(const std::string& name, std::string& path, const std::string& help) {
  CLI::Option* option = app().add_option(name, path, help);
  if (name[0] != '-') option->required();
  impl_->options.inputs.push_back({option, [&path] { return std::vector<std::string>{path}; }});
  return ToolOption(option);
}

ToolOption Tool::inputs(const std::string& name, std::vector<std::string>& paths,
                        const std::string& help) {
  CLI::Option* option = app().add_option(name, paths, help);
  if (name[0] != '-') option->required();
  impl_->options.inputs.push_back({option, [&paths] { return paths; }});
  return ToolOption(option);
}

ToolOption Tool::output(const std::string& name, std::string& path, const std::string& help) {
  CLI::Option* option = app().add_option(name, path, help);
  impl_->options.outputs.push_back({option, &path, false});
  return ToolOption(option);
}

ToolOption Tool::output_folder(const std::string& name, std::string& path,
                               const std::string& help) {
  CLI::Option* option = app().add_option(name, path, help);
  impl_->options.outputs.push_back({option, &path, true});
  return ToolOption(option);
}

void Tool::json_output(std::string& path) {
  std::erase(impl_->options.common, app().get_option("--json"));
  app().remove_option(app().get_option("--json"));
  output("--json", path, "the result (JSON)").without_default();
  CLI::Option* const option = app().get_option("--json")->expected(0, 1);
  impl_->options.json_path = &path;
  impl_->options.json_option = option;
}

void Tool::footer(const std::string& text) { app().footer(text); }

void Tool::more_config(std::function<std::vector<ConfigValue>()> settings) {
  impl_->options.more_config = std::move(settings);
}

void Tool::write_also(const std::string& path, bool may_exist) {
  check_output_file(path, impl_->kept);
  for (const OutputOption& output : impl_->options.outputs)
    if (!output.path->empty() && absolute_path(*output.path) == absolute_path(path))
      throw InputError({path}, "is named for two outputs", "give each its own name");
  refuse_existing(path, may_exist || impl_->options.overwrite);
}

std::string Tool::stage(const std::string& path) {
  impl_->kept.refuse(path);
  refuse_existing(path, impl_->options.overwrite);
  impl_->staged.push_back({temporary_name(path), path});
  return impl_->staged.back().temporary;
}

std::string Tool::stage_also_if_refused(const std::string& path) {
  impl_->kept_if_refused.push_back(path);
  return stage(path);
}

void Tool::write_text(const std::string& path, const std::string& content) {
  write_whole(stage(path), content);
}

void Tool::report(const std::string& path, Json content, bool also_if_refused) {
  if (path.empty()) return;
  impl_->reports.emplace_back(also_if_refused ? stage_also_if_refused(path) : stage(path),
                              std::move(content));
}

void Tool::at_end(std::function<void()> work) { impl_->at_end.push_back(std::move(work)); }

void Tool::read_also(const std::string& role, const std::string& path) {
  impl_->add_input(role, path);
}

void Tool::keep(const std::string& path) {
  impl_->keep(path, "is both an output and a file that the site file names");
}

ProgressFunction Tool::progress() {
  impl_->progress_line.restart();
  return [this](double share) {
    if (stop_requested()) throw Interrupted();
    impl_->progress_line.show(share);
  };
}

void Tool::read_by_content(const std::string& path) {
  if (!impl_->by_content.insert(absolute_path(file_of(path))).second) return;
  impl_->add_input(by_content_role, path);
  impl_->id_parts.left_out.insert(by_content_role);
}

bool Tool::interrupted() const { return stop_requested(); }

// A sentence a group. A refused one is the error that follows.
void Tool::doubts(const std::vector<Doubt>& found) {
  impl_->doubts.insert(impl_->doubts.end(), found.begin(), found.end());
  const CLI::Option* const layer = app().get_option_no_throw("--doubts");
  for (const DoubtGroup& group : groups_of(found)) {
    if (group.first->state == DoubtState::refused) continue;
    impl_->event(warning_level, sentence_on(group));
    if (impl_->options.quiet) continue;
    impl_->say(warning_level, sentence_on(group));
    std::string hint = group.first->hint;
    if (group.n > 1 && layer != nullptr && layer->count() == 0)
      hint += (hint.empty() ? "" : "; ") + std::string("--doubts places.gpkg writes all");
    impl_->say_hint(hint);
  }
}

void Tool::note(Severity severity, const std::string& text) {
  if (severity == Severity::record) return impl_->event("info", text);
  if (impl_->options.quiet || (severity == Severity::detail && !impl_->options.verbose)) return;
  impl_->say(info_level, text);
}

void Tool::layer_read(const LayerRead& layer) {
  Json entry = {{"input", layer.role}, {"file", layer.file}};
  for (const auto& [name, value] : layer.facts)
    std::visit([&, &key = name](const auto& fact) { entry[key] = fact; }, value);
  impl_->event("info", "read " + json_text(entry));
  impl_->layers_read.push_back(std::move(entry));
}

const Json& Tool::layers_read() const { return impl_->layers_read; }

const std::vector<Doubt>& Tool::doubts_found() const { return impl_->doubts; }

void Tool::metric(const std::string& name, double value, const std::string& unit) {
  impl_->record.metrics.push_back({name, value, unit});
}

void Tool::check(const std::string& name, double value, double limit, bool pass,
                 const std::string& hint) {
  impl_->record.checks.push_back({name, value, limit, pass});
  impl_->check_hints.push_back(hint);
}

void Tool::listing(Json result, const std::string& lines) {
  this->result(std::move(result), lines);
  impl_->is_listing = true;
}

bool Tool::prints_json() const { return impl_->options.json; }

void Tool::result(Json result, const std::string& summary) {
  impl_->result = std::move(result);
  if (!impl_->layers_read.empty()) impl_->result["layers_read"] = impl_->layers_read;
  impl_->summary = summary;
  ToolOptions& options = impl_->options;
  if (options.json_option == nullptr) return;
  if (!options.json_path->empty())
    write_text(*options.json_path, json_text(impl_->result, 2) + "\n");
  else if (options.json_option->count() > 0)
    options.json = true;
}

bool Tool::overwrite() const { return impl_->options.overwrite; }
double Tool::memory_mb() const { return impl_->options.memory_mb; }

bool Tool::is_recorded() const { return !impl_->options.no_db; }

std::string Tool::registry() const { return registry_path(impl_->options); }

std::string Tool::run_id() {
  impl_->complete_content_id();
  return impl_->record.content_id;
}

std::string Tool::made_with(const std::set<std::string>& left_out) const {
  return made_with_text(impl_->record, impl_->id_parts, left_out);
}

void Tool::content_read(const std::string& role, const std::string& digest) {
  impl_->id_parts.contents.emplace_back(role, digest);
}

void Tool::leave_out_of_run_id(const std::vector<std::string>& names) {
  impl_->id_parts.left_out.insert(names.begin(), names.end());
}

namespace {

// One file of those that are named where one is read; empty where it is not so.
std::string way_to_one_file(const std::string& tool, const CLI::ParseError& error, int argc,
                            char** argv) {
  if (dynamic_cast<const CLI::ExtrasError*>(&error) == nullptr &&
      dynamic_cast<const CLI::ValidationError*>(&error) == nullptr)
    return {};
  const std::string finding = error.what();
  std::string files;
  int n_files = 0;
  for (int i = 1; i < argc; ++i) {
    std::error_code failed;
    const bool is_extra = finding.find(argv[i]) != std::string::npos;
    const bool is_value = i > 1 && argv[i - 1][0] == '-';
    if ((is_value && !is_extra) || argv[i][0] == '-' || !std::filesystem::exists(argv[i], failed))
      continue;
    files += " " + command_words(argv[i]);
    ++n_files;
  }
  std::error_code failed;
  if (n_files < 2 || !std::filesystem::exists(argv[1], failed)) return {};
  if (tool == "talus-trn") return "one raster of all tiles: gdalbuildvrt all.vrt" + files;
  if (tool == "talus-tin") return "one layer of all maps: ogrmerge.py -single -o all.gpkg" + files;
  return {};
}

}  // namespace

int Tool::run(int argc, char** argv, const std::function<void()>& body) {
  occupy_standard_files();
  Impl& impl = *impl_;
  try {
    impl.app.parse(arguments_of(argc, argv, impl.app));
    check_output_names(impl.options);
  } catch (const CallForDescription&) {
    std::cout << description_of(impl.name, impl.app, impl.options).dump(2) << std::endl;
    return std::cout ? done : input_unusable;
  } catch (const CLI::Success& wanted) {  // --help, --version
    const int code = impl.app.exit(wanted);
    return std::cout.flush() ? code : input_unusable;
  } catch (const CLI::ParseError& error) {
    // Options before or behind the fault have not been read.
    impl.options.messages = word_after("--messages", argc, argv);
    impl.options.label.clear();
    impl.say(error_level, error.what());
    const std::string instead = written_instead(impl.name, argc, argv);
    const std::string one = way_to_one_file(impl.name, error, argc, argv);
    impl.say(hint_level, !instead.empty() ? instead : !one.empty() ? one : impl.name + " --help");
    return usage_wrong;
  }
  impl.options.label = printable(impl.options.label);
  if (impl.options.network) allow_network();
  constexpr double megabyte = 1e6;
  limit_memory(impl.options.memory_mb * megabyte);
  listen_for_signals();
  impl.progress_line.label(impl.options.label);
  impl.progress_line.form(progress_form(impl.options.progress, isatty(STDERR_FILENO) == 1,
                                        impl.options.quiet, impl.options.messages == "json"));

  int code = impl.guarded([&] {
    if (impl.options.print_config) {
      print_settings(settings_of(impl.app, impl.options), std::cout);
      if (!std::cout.flush()) throw InputError({"standard output"}, "cannot be written");
      return static_cast<int>(done);
    }
    check_stack();
    impl.begin(argc, argv);
    return impl.work_and_commit(body);
  });
  if (impl.registered) {
    const int recorded =
        impl.guarded([&] { return impl.finish_record(code), static_cast<int>(done); });
    if (code == done) code = recorded;
  }
  return code;
}

}  // namespace talus
