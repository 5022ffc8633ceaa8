#include "tool.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "base/sha256.hpp"
#include "base/text.hpp"
#include "build_info.hpp"
#include "store/runs.hpp"

namespace talus {
namespace fs = std::filesystem;
namespace {

enum ExitCode { done = 0, input_unusable = 1, usage_wrong = 2, numbers_failed = 3, stopped = 130 };

volatile std::sig_atomic_t stop_requested = 0;

// The first signal asks the work to end where it can; a second one kills.
void request_stop(int signal) {
  stop_requested = 1;
  std::signal(signal, SIG_DFL);
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  char buffer[32];
  std::strftime(buffer, sizeof buffer, "%Y-%m-%dT%H:%M:%SZ", std::gmtime(&now));
  return buffer;
}

std::string host_name() {
  char buffer[256] = {};
  return gethostname(buffer, sizeof buffer - 1) == 0 ? buffer : "unknown";
}

std::string shell_quoted(const std::string& word) {
  const auto is_plain = [](unsigned char c) {
    return std::isalnum(c) || std::strchr("_-+=:,./@%", c);
  };
  if (!word.empty() && std::all_of(word.begin(), word.end(), is_plain)) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

bool is_virtual(const std::string& path) { return path.rfind("/vsi", 0) == 0; }

std::string absolute(const std::string& path) {
  if (is_virtual(path)) return path;
  std::error_code error;  // a pipe behind /dev/stdout has no name of its own
  const fs::path canonical = fs::weakly_canonical(fs::absolute(path), error);
  return (error ? fs::absolute(path) : canonical).string();
}

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

// GDAL spells long options with one dash and underscores (-t_srs, -overwrite): both are understood.
std::vector<std::string> arguments_of(int argc, char** argv, const CLI::App& app) {
  std::vector<std::string> words(argv + 1, argv + argc);
  for (std::string& word : words) {
    if (word.size() < 3 || word[0] != '-' || word[1] == '-') continue;
    std::string name = "-" + word.substr(0, word.find('='));
    std::replace(name.begin(), name.end(), '_', '-');
    if (app.get_option_no_throw(name) != nullptr) word = name + word.substr(name.size() - 1);
  }
  std::reverse(words.begin(), words.end());  // CLI11 takes a vector from its end
  return words;
}

void sync_and_close(int descriptor, const std::string& path) {
  const bool synced = fsync(descriptor) == 0 || errno == EINVAL;  // EINVAL: not a thing to sync
  const std::string reason = std::strerror(errno);
  close(descriptor);
  if (!synced) throw InputError({path}, "cannot be written to disk: " + reason);
}

void sync_path(const std::string& path, int flags) {
  const int descriptor = open(path.c_str(), flags);
  if (descriptor < 0)
    throw InputError({path}, std::string("cannot be opened: ") + std::strerror(errno));
  sync_and_close(descriptor, path);
}

// The line of GDAL's tools, rewritten in place, with the time left once it can be guessed:
// 0...10...20...30 (about 12 s left). Only on a terminal, only for work above a second.
class ProgressLine {
 public:
  void show(double share) {
    const double elapsed = seconds_since(start_);
    if (elapsed < 1 || (elapsed - shown_at_ < 0.2 && share < 1)) return;
    shown_at_ = elapsed;
    std::string line;
    for (int mark = 0; mark <= static_cast<int>(share * 40); ++mark)
      line += mark % 4 == 0 ? std::to_string(mark / 4 * 10) : ".";
    if (share > 0.02 && share < 1)
      line += " (about " + text(std::ceil(elapsed / share * (1 - share)), 6) + " s left)";
    std::cerr << "\r\033[K" << line << std::flush;
    is_open_ = true;
  }
  void end(const char* last_words) {
    if (is_open_) std::cerr << last_words << '\n';
    is_open_ = false;
  }
  void restart() {
    start_ = std::chrono::steady_clock::now();
    shown_at_ = 0;
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  double shown_at_ = 0;
  bool is_open_ = false;
};

}  // namespace

std::function<std::string(const std::string&)> number_between(double low, double high,
                                                              bool or_nan) {
  return [=](const std::string& word) -> std::string {
    double value = 0;
    if (or_nan && word == "nan") return {};
    if (parse_double(word, value) && value >= low && value <= high) return {};
    return word + " is out of range, expected a number from " + text(low) + " to " + text(high) +
           (or_nan ? ", or nan" : "");
  };
}

std::string check_creation_option(const std::string& word) {
  if (word.find('=') != std::string::npos) return {};
  return word + " has no value, expected NAME=VALUE, e.g. COMPRESS=ZSTD";
}

std::string processor_name() {
  std::ifstream cpuinfo("/proc/cpuinfo");
  for (std::string line; std::getline(cpuinfo, line);)
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  return "unknown";
}

std::vector<std::string> sidecars_of(const std::string& path) {
  std::vector<std::string> files;
  if (lower(fs::path(path).extension().string()) != ".shp") return files;
  for (const char* extension : {".shx", ".dbf", ".prj", ".cpg"})
    files.push_back(fs::path(path).replace_extension(extension).string());
  return files;
}

struct Tool::Impl {
  struct Output {
    CLI::Option* option;
    std::string* path;
    bool is_folder;
  };
  struct Staged {
    std::string temporary, path;
  };

  std::string name;
  CLI::App app;
  std::vector<std::pair<CLI::Option*, std::function<std::vector<std::string>()>>> inputs;
  std::vector<Output> outputs;
  std::vector<CLI::Option*> common;
  const std::string* json_path = nullptr;  // where the result is also written
  const CLI::Option* json_option = nullptr;
  std::function<std::vector<ConfigValue>()> more_config;

  bool quiet = false, verbose = false, json = false, overwrite = false, no_db = false,
       print_config = false;
  std::string db;

  std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
  std::vector<Staged> staged;
  RunRecord record;
  std::vector<std::string> check_hints;  // of record.checks
  Json result;
  std::string summary;
  bool registered = false;
  bool on_terminal = isatty(STDERR_FILENO) == 1;
  ProgressLine progress_line;

  Impl(std::string tool_name, std::string purpose)
      : name(std::move(tool_name)), app(std::move(purpose), name) {}

  void print(const std::string& text) {
    progress_line.end("");
    std::cerr << text << std::endl;
  }

  void event(const std::string& level, const std::string& text) {
    record.events.push_back({seconds_since(start), level, text});
  }

  void add_common_options() {
    app.set_version_flag("--version", name + " " + build_version + " (" + build_commit + ")");
    common = {app.add_flag("-q,--quiet", quiet, "print errors only"),
              app.add_flag("-v,--verbose", verbose, "say more of what is done"),
              app.add_flag("--json", json, "print the result as one JSON object"),
              app.add_flag("--overwrite", overwrite, "replace outputs that exist"),
              app.add_option("--db", db, "run registry [runs.sqlite beside the output]"),
              app.add_flag("--no-db", no_db, "do not record the run"),
              app.add_flag("--print-config", print_config,
                           "print the effective settings and where each came from, then end")};
    for (CLI::Option* option : common) option->group("Common options");
  }

  bool is_setting(const CLI::Option* option) const {
    const auto same = [option](const auto& declared) { return declared == option; };
    if (std::any_of(common.begin(), common.end(), same)) return false;
    if (option == app.get_help_ptr() || option == app.get_version_ptr()) return false;
    for (const auto& [declared, paths] : inputs)
      if (declared == option) return false;
    for (const Output& output : outputs)
      if (output.option == option) return false;
    return true;
  }

  std::vector<ConfigValue> settings() const {
    std::vector<ConfigValue> values;
    for (const CLI::Option* option : app.get_options()) {
      if (!is_setting(option)) continue;
      std::string value = option->count() == 0 ? option->get_default_str() : "";
      for (const std::string& word :
           option->count() == 0 ? std::vector<std::string>{} : option->results())
        value += (value.empty() ? "" : " ") + word;
      const std::string key =
          option->get_lnames().empty() ? option->get_name() : option->get_lnames()[0];
      values.push_back({key, value, option->count() == 0 ? "default" : "cli"});
    }
    if (more_config)
      for (ConfigValue& value : more_config()) values.push_back(std::move(value));
    return values;
  }

  void show_settings() const {
    for (const ConfigValue& value : settings()) {
      double number = 0;
      const bool is_bare = parse_double(value.value, number) || value.value == "true" ||
                           value.value == "false" ||
                           (!value.value.empty() && value.value[0] == '[');
      std::cout << value.key << " = " << (is_bare ? value.value : Json(value.value).dump())
                << "  # " << value.source << '\n';
    }
  }

  RunArtifact described(const std::string& role, const std::string& path) const {
    const std::string where = absolute(path);
    if (is_virtual(path) || !fs::is_regular_file(path)) return {role, where, "", 0};
    return {role, where, sha256_of_file(path), static_cast<std::int64_t>(fs::file_size(path))};
  }

  void add_input(const std::string& role, const std::string& path) {
    if (!is_virtual(path) && !fs::exists(path))
      throw InputError({path}, "there is no such file", "check the path given for " + role);
    record.inputs.push_back(described(role, path));
    for (const std::string& member : sidecars_of(path))
      if (fs::exists(member)) record.inputs.push_back(described(role, member));
  }

  void check_folder(const fs::path& folder) const {
    if (!fs::is_directory(folder))
      throw InputError({folder.string()}, "there is no such folder to write into", "make it first");
    if (access(folder.c_str(), W_OK) != 0)
      throw InputError({folder.string()},
                       std::string("the folder cannot be written: ") + std::strerror(errno),
                       "name another output, or mend the folder's permissions");
  }

  void check_output(const Output& output) const {
    const fs::path path = *output.path;
    if (path.empty()) return;
    if (output.is_folder) {
      std::error_code error;
      fs::create_directories(path, error);
      if (error) throw InputError({path.string()}, "the folder cannot be made: " + error.message());
      check_folder(path);
      return;
    }
    check_output_file(path);
    if (fs::exists(path) && !overwrite)
      throw InputError({path.string()}, "exists already", "give --overwrite to replace it");
  }

  void check_output_file(const fs::path& path) const {
    for (const RunArtifact& file : record.inputs)
      if (file.path == absolute(path.string()))
        throw UsageError({path.string()}, "is both an input and an output", "name another output");
    if (fs::is_directory(path))
      throw InputError({path.string()}, "is a folder, expected a file name to write");
    if (fs::exists(path) && !fs::is_regular_file(path))
      throw InputError({path.string()}, "is no regular file, expected a file name to write",
                       "outputs are written beside it and renamed when they are whole");
    check_folder(folder_of(path));
  }

  // An output left empty on the command line is no output left away.
  void check_names() const {
    for (const Output& output : outputs)
      if (output.option->count() > 0 && output.path->empty() && output.option != json_option)
        throw CLI::ValidationError(output.option->get_name(), "the name is empty");
  }

  void check_files() {
    for (const auto& [option, paths] : inputs)
      for (const std::string& path : paths())
        if (!path.empty())
          add_input(option->get_lnames().empty() ? option->get_name() : option->get_lnames()[0],
                    path);
    std::vector<std::string> seen;
    if (!db.empty()) seen.push_back(absolute(db));
    for (const Output& output : outputs) {
      check_output(output);
      if (output.path->empty()) continue;
      if (std::find(seen.begin(), seen.end(), absolute(*output.path)) != seen.end())
        throw UsageError({*output.path},
                         !db.empty() && absolute(*output.path) == absolute(db)
                             ? "is named for an output and for the run registry"
                             : "is named for two outputs",
                         "give each its own name");
      seen.push_back(absolute(*output.path));
    }
  }

  std::string content_id() const {
    Sha256 hash;
    const auto add = [&hash](const std::string& word) { hash.add(word.c_str(), word.size() + 1); };
    add(record.tool);
    add(record.version);
    for (const RunParam& param : record.params) add(param.key), add(param.value);
    // Results do not depend on the order in which several inputs of one option are named.
    std::vector<std::pair<std::string, std::string>> contents;
    for (const RunArtifact& file : record.inputs) contents.emplace_back(file.role, file.sha256);
    std::sort(contents.begin(), contents.end());
    for (const auto& [role, sha256] : contents) add(role), add(sha256);
    return hash.hex().substr(0, 16);
  }

  std::string registry_path() const {
    if (!db.empty()) return db;
    for (const Output& output : outputs) {
      if (output.path->empty()) continue;
      const fs::path path = *output.path;
      return ((output.is_folder ? path : folder_of(path)) / "runs.sqlite").string();
    }
    return "";
  }

  void begin_record(int argc, char** argv) {
    record.tool = name;
    record.version = build_version;
    record.git_commit = build_commit;
    for (int i = 0; i < argc; ++i)
      record.command_line += (i > 0 ? " " : "") + shell_quoted(argv[i]);
    record.folder = fs::current_path().string();
    record.host = host_name();
    record.cpu = processor_name();
    record.process_id = getpid();
    record.started = utc_now();
    for (ConfigValue& value : settings())
      record.params.push_back({value.key, value.value, value.source});
  }

  void register_run() {
    if (no_db || registry_path().empty()) return;
    record.content_id = content_id();
    record.status = "running";
    record.id = start_run(registry_path(), record);
    registered = true;
  }

  // The body may name further inputs until it asks for the id, or ends.
  void complete_content_id() {
    if (record.content_id.empty()) record.content_id = content_id();
  }

  void finish_record(int exit_code) {
    complete_content_id();
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval& t) {
      return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    record.ended = utc_now();
    record.exit_code = exit_code;
    record.status = exit_code == done ? "done" : exit_code == stopped ? "interrupted" : "failed";
    record.cpu_time_s = seconds(usage.ru_utime) + seconds(usage.ru_stime);
    record.wall_time_s = seconds_since(start);
    record.peak_memory_kb = usage.ru_maxrss;
    finish_run(registry_path(), record);
  }

  std::string temporary_name(const fs::path& path) const {
    const std::string mark = ".part-" + host_name() + "-";
    const std::string begin = "." + path.stem().string() + mark;
    remove_stale(folder_of(path), begin);
    return (folder_of(path) / (begin + std::to_string(getpid()) + path.extension().string()))
        .string();
  }

  // What a killed run of this host left under the same name.
  static void remove_stale(const fs::path& folder, const std::string& begin) {
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder, error)) {
      const std::string file = entry.path().filename().string();
      if (file.rfind(begin, 0) != 0) continue;
      const int process = std::atoi(file.c_str() + begin.size());
      if (process > 0 && process != getpid() && kill(process, 0) != 0 && errno == ESRCH)
        fs::remove_all(entry.path(), error);
    }
  }

  // The order in which outputs come in place: the one staged first is last, or the main output when
  // the tool has one. Who finds it, finds the others of the same run beside it.
  std::vector<Staged> in_order_of_commit() const {
    std::vector<Staged> files(staged.rbegin(), staged.rend());
    const std::string main = outputs.empty() ? "" : *outputs.front().path;
    std::stable_partition(files.begin(), files.end(),
                          [&main](const Staged& file) { return file.path != main; });
    return files;
  }

  // A path without its last extension, be it the final or the temporary one.
  static std::string without_extension(const Staged& file, const std::string& path) {
    return path.substr(0, path.size() - fs::path(file.path).extension().string().size());
  }

  // What GDAL puts beside a temporary file (NAME.tif.aux.xml, NAME.tfw, NAME.gpkg-journal): the
  // endings that follow the name that they share.
  std::vector<std::string> endings_beside(const Staged& file) const {
    const std::string begin = without_extension(file, file.temporary);
    std::vector<std::string> endings;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder_of(begin), error)) {
      const std::string path = (folder_of(begin) / entry.path().filename()).string();
      if (!path.starts_with(begin) || path.size() == begin.size()) continue;
      const bool is_output = std::any_of(staged.begin(), staged.end(),
                                         [&](const Staged& s) { return s.temporary == path; });
      if (is_output) continue;
      if (path[begin.size()] == '.' || path[begin.size()] == '-')
        endings.push_back(path.substr(begin.size()));
    }
    return endings;
  }

  // All outputs of a run bear the same time, so that make sees none as older than another.
  void commit_outputs() {
    timespec now{};
    clock_gettime(CLOCK_REALTIME, &now);
    const timespec times[2] = {now, now};
    const std::vector<Staged> files = in_order_of_commit();
    for (const Staged& file : files)
      if (fs::exists(file.temporary)) record.outputs.push_back(described_output(file));
    if (registered && !files.empty()) {
      complete_content_id();
      record_results(registry_path(), record);
    }
    for (const Staged& file : files) {
      if (!fs::exists(file.temporary)) continue;
      utimensat(AT_FDCWD, file.temporary.c_str(), times, 0);
      sync_path(file.temporary, O_RDONLY);
      for (const std::string& ending : endings_beside(file))
        rename_over(without_extension(file, file.temporary) + ending,
                    without_extension(file, file.path) + ending);
      rename_over(file.temporary, file.path);
      sync_path(folder_of(file.path).string(), O_RDONLY | O_DIRECTORY);
    }
    staged.clear();
  }

  static void rename_over(const std::string& from, const std::string& to) {
    std::error_code error;
    fs::rename(from, to, error);
    if (error) throw InputError({to}, "cannot be put in place: " + error.message());
  }

  // An output by its final name, while it still has its temporary one.
  RunArtifact described_output(const Staged& file) const {
    RunArtifact artifact = described("output", file.temporary);
    artifact.path = absolute(file.path);
    return artifact;
  }

  void remove_staged() {
    std::error_code error;
    for (const Staged& file : staged) {
      fs::remove_all(file.temporary, error);
      for (const std::string& ending : endings_beside(file))
        fs::remove_all(without_extension(file, file.temporary) + ending, error);
    }
    staged.clear();
  }

  void print_result() {
    if (json && !result.is_null()) {
      Json warnings = Json::array();
      for (const RunEvent& e : record.events)
        if (e.level == "warning") warnings.push_back(e.text);
      if (!warnings.empty()) result["warnings"] = warnings;
      std::cout << result.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
    } else if (!json && !quiet && !summary.empty()) {
      std::cout << summary << '\n';
    }
    if (!std::cout.flush()) throw InputError({"standard output"}, "cannot be written");
  }

  bool all_checks_pass() const {
    return std::all_of(record.checks.begin(), record.checks.end(),
                       [](const RunCheck& check) { return check.pass; });
  }

  // Names outputs as the user did, not by where they were written for now.
  std::string with_final_names(std::string words) const {
    for (const Staged& file : staged)
      for (std::size_t at; (at = words.find(file.temporary)) != std::string::npos;)
        words.replace(at, file.temporary.size(), file.path);
    return words;
  }

  int fail(int code, std::string what, const std::string& hint) {
    what = with_final_names(std::move(what));
    remove_staged();
    event("error", what);
    print(name + ": " + what);
    if (!hint.empty()) print("  hint: " + hint);
    return code;
  }

  int guarded(const std::function<int()>& work) {
    try {
      return work();
    } catch (const UsageError& error) {
      return fail(usage_wrong, error.what(), error.hint());
    } catch (const InputError& error) {
      return fail(input_unusable, error.what(), error.hint());
    } catch (const NumericsError& error) {
      return fail(numbers_failed, error.what(), "");
    } catch (const Interrupted&) {
      return fail(stopped, "interrupted", "");
    } catch (const std::bad_alloc&) {
      return fail(input_unusable, "out of memory", "give it more memory, or a smaller window");
    } catch (const std::exception& error) {
      return fail(input_unusable, std::string("unexpected: ") + error.what(), "");
    }
  }

  int work_and_commit(const std::function<void()>& body) {
    progress_line.restart();
    body();
    progress_line.end(" - done.");
    if (stop_requested) throw Interrupted();
    commit_outputs();
    print_result();
    for (std::size_t i = 0; i < record.checks.size(); ++i) {
      const RunCheck& check = record.checks[i];
      if (check.pass) continue;
      print(name + ": health: " + check.name + " is " + text(check.value, 6) + ", limit " +
            text(check.limit, 6));
      if (!check_hints[i].empty()) print("  hint: " + check_hints[i]);
    }
    return all_checks_pass() ? done : numbers_failed;
  }
};

Tool::Tool(std::string name, std::string purpose)
    : impl_(std::make_unique<Impl>(std::move(name), std::move(purpose))) {
  impl_->add_common_options();
}

Tool::~Tool() = default;

CLI::App& Tool::app() { return impl_->app; }

CLI::Option* Tool::input(const std::string& name, std::string& path, const std::string& help) {
  CLI::Option* option = app().add_option(name, path, help);
  if (name[0] != '-') option->required();
  impl_->inputs.emplace_back(option, [&path] { return std::vector<std::string>{path}; });
  return option;
}

CLI::Option* Tool::inputs(const std::string& name, std::vector<std::string>& paths,
                          const std::string& help) {
  CLI::Option* option = app().add_option(name, paths, help);
  if (name[0] != '-') option->required();
  impl_->inputs.emplace_back(option, [&paths] { return paths; });
  return option;
}

CLI::Option* Tool::output(const std::string& name, std::string& path, const std::string& help) {
  CLI::Option* option = app().add_option(name, path, help);
  impl_->outputs.push_back({option, &path, false});
  return option;
}

CLI::Option* Tool::output_folder(const std::string& name, std::string& path,
                                 const std::string& help) {
  CLI::Option* option = app().add_option(name, path, help);
  impl_->outputs.push_back({option, &path, true});
  return option;
}

void Tool::json_output(std::string& path, const std::string& help) {
  std::erase(impl_->common, app().get_option("--json"));
  app().remove_option(app().get_option("--json"));
  CLI::Option* const option = output("--json", path, help)->expected(0, 1);
  option->default_str("");
  impl_->json_path = &path;
  impl_->json_option = option;
}

void Tool::footer(const std::string& text) { app().footer(text); }

void Tool::more_config(std::function<std::vector<ConfigValue>()> settings) {
  impl_->more_config = std::move(settings);
}

void Tool::write_also(const std::string& path, bool may_exist) {
  impl_->check_output_file(path);
  for (const Impl::Output& output : impl_->outputs)
    if (!output.path->empty() && absolute(*output.path) == absolute(path))
      throw InputError({path}, "is named for two outputs", "give each its own name");
  if (fs::exists(path) && !may_exist && !impl_->overwrite)
    throw InputError({path}, "exists already", "give --overwrite to replace it");
}

std::string Tool::stage(const std::string& path) {
  if (fs::exists(path) && !impl_->overwrite)
    throw InputError({path}, "exists already", "give --overwrite to replace it");
  impl_->staged.push_back({impl_->temporary_name(path), path});
  return impl_->staged.back().temporary;
}

void Tool::write_text(const std::string& path, const std::string& content) {
  std::ofstream file(stage(path), std::ios::binary);
  file << content;
  file.close();
  if (!file) throw InputError({path}, std::string("cannot be written: ") + std::strerror(errno));
}

void Tool::read_also(const std::string& role, const std::string& path) {
  impl_->add_input(role, path);
}

ProgressFunction Tool::progress() {
  impl_->progress_line.restart();
  return [this](double share) {
    if (stop_requested) throw Interrupted();
    if (impl_->on_terminal && !impl_->quiet) impl_->progress_line.show(share);
  };
}

bool Tool::interrupted() const { return stop_requested != 0; }

void Tool::info(const std::string& text) {
  if (!impl_->quiet) impl_->print(text);
}

void Tool::detail(const std::string& text) {
  if (impl_->verbose && !impl_->quiet) impl_->print(text);
}

void Tool::warn(const std::string& text) {
  impl_->event("warning", text);
  if (!impl_->quiet) impl_->print(impl_->name + ": warning: " + text);
}

void Tool::metric(const std::string& name, double value, const std::string& unit) {
  impl_->record.metrics.push_back({name, value, unit});
}

void Tool::check(const std::string& name, double value, double limit, bool pass,
                 const std::string& hint) {
  impl_->record.checks.push_back({name, value, limit, pass});
  impl_->check_hints.push_back(hint);
}

void Tool::result(Json result, const std::string& summary) {
  impl_->result = std::move(result);
  impl_->summary = summary;
  if (impl_->json_option != nullptr && impl_->json_option->count() > 0 && impl_->json_path->empty())
    impl_->json = true;
  if (impl_->json_path != nullptr && !impl_->json_path->empty())
    write_text(*impl_->json_path,
               impl_->result.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

bool Tool::overwrite() const { return impl_->overwrite; }

std::string Tool::registry() const { return impl_->registry_path(); }

std::string Tool::run_id() {
  impl_->complete_content_id();
  return impl_->record.content_id;
}

void Tool::set_run_id(const std::string& id) { impl_->record.content_id = id; }

int Tool::run(int argc, char** argv, const std::function<void()>& body) {
  Impl& impl = *impl_;
  try {
    impl.app.parse(arguments_of(argc, argv, impl.app));
    impl.check_names();
  } catch (const CLI::Success& wanted) {  // --help, --version
    return impl.app.exit(wanted);
  } catch (const CLI::ParseError& error) {
    std::cerr << impl.name << ": " << error.what() << "\n  hint: " << impl.name << " --help\n";
    return usage_wrong;
  }
  std::signal(SIGINT, request_stop);
  std::signal(SIGTERM, request_stop);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);  // a limit on file sizes is an error of the write, as a full disk

  int code = impl.guarded([&] {
    if (impl.print_config) {
      impl.show_settings();
      return static_cast<int>(done);
    }
    impl.begin_record(argc, argv);
    impl.check_files();
    impl.register_run();
    impl.record.content_id.clear();  // the body may name further inputs
    return impl.work_and_commit(body);
  });
  if (impl.registered) {
    const int recorded =
        impl.guarded([&] { return impl.finish_record(code), static_cast<int>(done); });
    if (recorded != done && code == done) {
      impl.print("  the outputs are whole and in place; only the record of this run is missing");
      code = recorded;
    }
  }
  return code;
}

}  // namespace talus
