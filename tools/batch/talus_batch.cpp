// tools/batch/talus_batch.cpp
// Makes the runs of a site that are not there yet, several at a time. Page:
// docs/tools/talus-batch.md
#include <fcntl.h>
#include <poll.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <list>
#include <set>
#include <sstream>
#include <thread>

#include "base/text.hpp"
#include "tools/batch/plan.hpp"
#include "tools/batch/processes.hpp"
#include "tools/frame/command_line.hpp"
#include "tools/frame/machine.hpp"
#include "tools/frame/site_options.hpp"
#include "tools/frame/tool.hpp"

namespace {

using namespace talus;  // NOLINT: a program of its own
namespace fs = std::filesystem;
using namespace std::chrono_literals;

void declare(Tool& tool, BatchOptions& o) {
  tool.option("--results", o.results,
              "folder with bed.tif and blocks.h5 (talus-blocks), which the runs go to");
  tool.option("--into", o.into, "folder in it for the runs");
  tool.option("--runs", o.runs,
              "runs of each alternative, or auto: as many as [place.*] half_width wants; default: "
              "those of the site file");
  tool.option("--most", o.most, "runs of each alternative that auto makes at most")
      .between(1, 1000000);
  tool.option("--seed", o.seed, "of the first run; -1: that of the site file")
      .between(std::int64_t{-1}, std::int64_t{1} << 53);
  tool.option(
          "--jobs", o.jobs,
          "runs at a time; 0, the default: as make -j says, or as many as the machine has cores")
      .between(0, 4096);
  tool.option("--part", o.part,
              "K/N: every N-th run from the K-th, brought together in a file of talus-reduce; 0/N "
              "with --status: which parts lack runs");
  tool.option("--launcher", o.launcher,
              "words before the names of tools, e.g. \"srun -n1 /opt/talus/\"; default: the folder "
              "of this tool");
  tool.flag("--status", o.status, "say what is to be made, and make nothing");
  tool.list("dda_options", o.dda_options, "behind --: further options of talus-dda");
  tool.footer("Example:\n  talus-batch site.toml --results out --runs 50 --jobs 4 -- --settle");
}

std::string name_of(const EnsembleMember& member) {
  return member.file.substr(0, member.file.size() - 3);  // without ".h5"
}

// --- who works -----------------------------------------------------------------------------------

// The one that makes the runs of a folder; parts share it.
class FolderHolder {
 public:
  FolderHolder(const std::string& folder, bool is_shared) {
    fs::create_directories(folder);
    const std::string path = (fs::path(folder) / ".lock").string();
    file_ = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (file_ < 0)
      throw InputError({path}, std::string("cannot be opened: ") + std::strerror(errno));
    // one that was killed ends within seconds, once its runs have written their checkpoints
    for (int tries = 0; flock(file_, (is_shared ? LOCK_SH : LOCK_EX) | LOCK_NB) != 0; ++tries) {
      if (errno != EWOULDBLOCK) return;  // a file system without locks
      if (tries == 100)
        throw InputError({folder}, "is in use: its runs are made by " + holder(path),
                         "wait for it, or end it");
      std::this_thread::sleep_for(100ms);
    }
    std::ofstream(path) << "process " << getpid() << " on " << host_name() << "\n";
  }
  ~FolderHolder() {
    if (file_ >= 0) close(file_);
  }
  FolderHolder(const FolderHolder&) = delete;
  FolderHolder& operator=(const FolderHolder&) = delete;

 private:
  static std::string holder(const std::string& path) {
    std::string line;
    std::ifstream in(path);
    return std::getline(in, line) && !line.empty() ? line : "another process";
  }
  int file_ = -1;
};

int parent_of(int process) {
  std::ifstream in("/proc/" + std::to_string(process) + "/status");
  for (std::string word; in >> word;)
    if (word == "PPid:") return in >> process, process;
  return 0;
}

// A batch of make ends with its make, which may have started it by a shell.
class Starter {
 public:
  [[nodiscard]] bool has_gone() const {
    return std::getenv("MAKELEVEL") != nullptr &&
           (getppid() != parent_ || parent_of(parent_) != grandparent_);
  }

 private:
  int parent_ = getppid(), grandparent_ = parent_of(getppid());
};

int jobs_by_default() {
  const char* const flags = std::getenv("MAKEFLAGS");
  if (flags == nullptr) return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  std::istringstream words(flags);
  int jobs = 1;
  for (std::string word; words >> word && word != "--";)
    if (word.starts_with("-j")) jobs = std::max(1, std::atoi(word.c_str() + 2));
  return jobs;
}

// Runs are recorded where their batch is, or beside the other results.
void add_registry(std::vector<std::string>& words, const Tool& tool, const BatchPlan& plan) {
  if (!tool.is_recorded()) return words.emplace_back("--no-db"), void();
  const std::string db = tool.registry();
  words.insert(words.end(),
               {"--db", db.empty() ? (fs::path(plan.results) / "runs.sqlite").string() : db});
}

// --- the work ------------------------------------------------------------------------------------

struct Job {
  std::size_t run;
  Process process;
};

class Batch {
 public:
  Batch(Tool& tool, BatchPlan& plan, int n_jobs) : tool_(tool), plan_(plan), n_jobs_(n_jobs) {}

  /// Makes the runs that lack, of the part; `is_cut_off` once one was killed or interrupted.
  void make_runs() {
    std::vector<std::size_t> left = to_make_here(plan_);
    std::reverse(left.begin(), left.end());
    n_ = left.size();
    const ProgressFunction progress = tool_.progress();
    while (!left.empty() || !jobs_.empty()) {
      while (!left.empty() && static_cast<int>(jobs_.size()) < n_jobs_) {
        begin(left.back());
        left.pop_back();
      }
      watch();
      if (tool_.interrupted() || starter_.has_gone()) return end_early();
      progress(share_done());
    }
  }
  bool is_cut_off = false;

 private:
  void begin(std::size_t run) {
    EnsembleMember& member = plan_.ensemble.members[run];
    const std::string file = (fs::path(plan_.folder) / member.file).string();
    fs::create_directories(fs::path(file).parent_path());
    std::vector<std::string> words = run_words(plan_, member);
    for (const std::string& word :
         {std::string("-o"), file, std::string("--label"), name_of(member), std::string("--resume"),
          std::string("--overwrite")})
      words.push_back(word);
    const std::string inputs = (fs::path(plan_.results) / "inputs.gpkg").string();
    if (fs::exists(inputs)) words.insert(words.end(), {"--inputs", inputs});
    add_registry(words, tool_, plan_);
    if (n_jobs_ > 1) words.insert(words.end(), {"--threads", "1"});
    jobs_.push_back({run, Process(std::move(words))});
  }

  void watch() {
    std::vector<pollfd> files;
    for (const Job& job : jobs_) files.push_back({job.process.messages(), POLLIN, 0});
    poll(files.data(), files.size(), 200);
    for (auto job = jobs_.begin(); job != jobs_.end();) {
      const std::string name = name_of(plan_.ensemble.members[job->run]);
      const auto take = [&](const std::string& level, const std::string& text) {
        say(name, level, text);
      };
      if (job->process.read(take)) {
        ++job;
        continue;
      }
      take_end(*job);
      job = jobs_.erase(job);
    }
  }

  // Warnings of many runs are alike: each is said once.
  void say(const std::string& name, const std::string& level, const std::string& text) {
    if (level == "warning" && !said_.insert(text).second) return;
    if (level == "warning")
      tool_.warn(name + ": " + text);
    else
      tool_.info(name + ": " +
                 (level == "hint"    ? "  hint: "
                  : level == "error" ? "error: "
                                     : "") +
                 text);
  }

  void take_end(const Job& job) {
    EnsembleMember& member = plan_.ensemble.members[job.run];
    Ensemble one;
    one.folder = plan_.folder;
    one.members = {member};
    bring_up_to_date(one);
    if (!has_result(one.members[0])) {
      member.outcome = Outcome::no_result;
      member.why = job.process.why();
      is_cut_off = is_cut_off || job.process.was_cut_off() || job.process.exit_code() == 0;
      if (job.process.was_cut_off() || job.process.exit_code() == 0)
        tool_.info(name_of(member) + ": " + member.why);
    }
    ++n_ended_;
    n_failed_ += one.members[0].outcome == Outcome::done ? 0 : 1;
    const std::size_t step = 100 * n_ended_ / n_;
    if (step > 100 * (n_ended_ - 1) / n_)
      tool_.info("runs: " + std::to_string(n_ended_ - n_failed_) + " done, " +
                 std::to_string(n_failed_) + " failed, " + std::to_string(n_ - n_ended_) +
                 " to go" + time_left());
  }

  std::string time_left() const {
    if (n_ended_ == n_) return "";
    const double s = std::chrono::duration<double>(Clock::now() - start_).count() *
                     static_cast<double>(n_ - n_ended_) / static_cast<double>(n_ended_);
    const auto about = [](double n, const char* unit) {
      return ", about " + text(std::floor(n), 6) + unit + " left";
    };
    return s < 120 ? about(s, " s") : s < 7200 ? about(s / 60, " min") : about(s / 3600, " h");
  }

  double share_done() const {
    double done = static_cast<double>(n_ended_);
    for (const Job& job : jobs_) done += job.process.progress();
    return n_ == 0 ? 1 : std::min(1.0, done / static_cast<double>(n_));
  }

  // Runs write their checkpoints.
  void end_early() {
    for (const Job& job : jobs_) job.process.stop();
    while (!jobs_.empty()) watch();
    throw Interrupted();
  }

  using Clock = std::chrono::steady_clock;
  Tool& tool_;
  BatchPlan& plan_;
  int n_jobs_;
  std::list<Job> jobs_;
  std::set<std::string> said_;
  std::size_t n_ = 0, n_ended_ = 0, n_failed_ = 0;
  Clock::time_point start_ = Clock::now();
  Starter starter_;
};

// A tool that is waited for, with its own words.
void run_through(Tool& tool, const std::vector<std::string>& words) {
  Process process(words);
  pollfd file{process.messages(), POLLIN, 0};
  while (process.read([&](const std::string& level, const std::string& text) {
    if (level != "info") tool.info(words[0] + ": " + text);
  }))
    poll(&file, 1, 200);
  if (process.exit_code() != 0) throw InputError({words[0]}, process.why());
}

// The runs of the part that have a result, as one file.
void reduce(Tool& tool, const BatchPlan& plan) {
  std::vector<std::string> words = tool_words(plan, "talus-reduce");
  std::set<std::string> keys;
  for (std::size_t i = 0; i < plan.ensemble.members.size(); ++i) {
    const EnsembleMember& member = plan.ensemble.members[i];
    if (!plan.part.has(i) || !has_result(member)) continue;
    words.push_back((fs::path(plan.folder) / member.file).string());
    keys.insert(key_of(member));
  }
  if (keys.empty()) return;
  const std::string part =
      (fs::path(parts_folder(plan)) /
       (std::to_string(plan.part.number) + "-of-" + std::to_string(plan.part.n_parts) + ".h5"))
          .string();
  const std::vector<std::string> there = keys_in_part(part);
  if (there == std::vector<std::string>(keys.begin(), keys.end())) return;
  fs::create_directories(parts_folder(plan));
  for (const std::string& word :
       {std::string("--trn"), ground_of(plan), std::string("-o"), part, std::string("--overwrite")})
    words.push_back(word);
  add_registry(words, tool, plan);
  run_through(tool, words);
}

// Runs that [place.*] need, from the runs that exist.
struct RunsThatLack {
  int n = 0;
  bool help = true;  // else more runs do not make the intervals narrow enough
  std::string over;  // unit of the intervals
};
RunsThatLack runs_that_lack(const BatchPlan& plan) {
  Ensemble now = plan.ensemble;
  now.folder = (fs::path(plan.folder) / ".auto").string();
  now.parts.clear();
  for (EnsembleMember& member : now.members) member.file = "../" + member.file;
  fs::create_directories(now.folder);
  write_ensemble(now);
  std::vector<std::string> words = tool_words(plan, "talus-places");
  words.insert(words.end(), plan.site_words.begin(), plan.site_words.end());
  words.insert(words.end(), {now.folder, "--trn", ground_of(plan), "--json", "--no-db", "-q"});
  const Json places = output_of(words);
  fs::remove_all(now.folder);
  for (const Json& place : places.at("places"))
    if (place.at("half_width").is_null() && !place.at("more_runs_help").get<bool>())
      throw InputError({plan.site_words[0]}, "--runs auto: more runs give no interval",
                       "raise rock_masses to 10 or more");
  return {places.at("runs_to_add").get<int>(), places.at("more_runs_help").get<bool>(),
          places.at("intervals_over").get<std::string>()};
}

// Members of the part.
std::vector<const EnsembleMember*> members_of(const BatchPlan& plan) {
  std::vector<const EnsembleMember*> list;
  for (std::size_t i = 0; i < plan.ensemble.members.size(); ++i)
    if (plan.part.has(i)) list.push_back(&plan.ensemble.members[i]);
  return list;
}

int n_done(const BatchPlan& plan) {
  const auto list = members_of(plan);
  return static_cast<int>(std::count_if(list.begin(), list.end(), [](const EnsembleMember* member) {
    return member->outcome == Outcome::done;
  }));
}

// "2 of 12 runs failed:" with a line each; "" where none did.
std::string failed_text(const BatchPlan& plan) {
  std::string lines;
  const std::vector<const EnsembleMember*> list = members_of(plan);
  for (const EnsembleMember* member : list)
    if (member->outcome != Outcome::done)
      lines += "\n  " + name_of(*member) + ": " +
               (member->why.empty() ? "was not computed" : member->why) +
               (has_result(*member) ? "" : " (no result)");
  const auto n = static_cast<int>(list.size()), n_failed = n - n_done(plan);
  if (n_failed == 0) return "";
  const bool few = n_failed <= plan.ensemble.max_failed_share * n && n_failed < n;
  return std::to_string(n_failed) + " of " + counted(n, "run") + " failed" +
         (few ? ", few enough to be left out and counted into the intervals:" : ":") + lines;
}

// As sbatch takes them: "1,3-5".
std::string parts_text(const BatchPlan& plan) {
  std::set<int> parts;
  for (const std::size_t run : to_make(plan))
    parts.insert(static_cast<int>(run) % plan.part.n_parts + 1);
  std::string out;
  for (auto first = parts.begin(); first != parts.end();) {
    auto last = first;
    while (std::next(last) != parts.end() && *std::next(last) == *last + 1) ++last;
    out += (out.empty() ? "" : ",") + std::to_string(*first) +
           (last == first ? "" : "-" + std::to_string(*last));
    first = std::next(last);
  }
  return out.empty() ? "-" : out;
}

// A line for make: whether ensemble.json is as it would be, how many runs are to be made, which
// parts lack some, the seed after the last, how many runs are wanted, and the rock masses of all.
std::string line_for_make(BatchPlan& plan, bool is_auto) {
  const std::vector<EnsembleMember>& members = plan.ensemble.members;
  const std::size_t n_to_make = to_make_here(plan).size();
  const bool is_current = !is_auto && n_to_make == 0 && are_written(plan);
  std::set<std::int64_t> masses;
  for (const EnsembleMember& member : members) masses.insert(mass_of(plan, member));
  masses.erase(0);
  std::string words = (is_current ? "current " : "stale ") + std::to_string(n_to_make) + " " +
                      parts_text(plan) + " " + std::to_string(members.back().seed + 1) + " " +
                      std::to_string(members.size());
  for (const std::int64_t mass : masses) words += " " + std::to_string(mass);
  return words;
}

void make_part_or_all(Tool& tool, BatchPlan& plan, int n_jobs) {
  compare_with_now(plan, tool, true);
  Batch batch(tool, plan, n_jobs);
  try {
    batch.make_runs();
  } catch (const Interrupted&) {
    if (plan.part.number == 0) write_ensembles(plan);
    throw;
  }
  if (plan.part.number == 0) return write_ensembles(plan);
  bring_up_to_date(plan.ensemble);
  if (batch.is_cut_off) throw InputError({plan.folder}, failed_text(plan));
  reduce(tool, plan);
}

// Blocks of further runs that draw their own, which make did not know of. Blocks older than those
// of the first run, which make has just checked, are made again: the same bytes where they are
// right.
void make_blocks(Tool& tool, const BatchPlan& plan) {
  const std::int64_t first = mass_of(plan, plan.ensemble.members.front());
  const std::string of_first = rock_file(plan, "blocks", ".h5", first);
  if (first == 0 || !fs::exists(of_first)) return;
  for (const EnsembleMember& member : plan.ensemble.members) {
    const std::int64_t mass = mass_of(plan, member);
    const std::string blocks = rock_file(plan, "blocks", ".h5", mass),
                      bed = rock_file(plan, "bed", ".tif", mass),
                      inputs = (fs::path(plan.results) / "inputs.gpkg").string();
    if (fs::exists(blocks) && fs::exists(bed) &&
        fs::last_write_time(blocks) >= fs::last_write_time(of_first))
      continue;
    std::vector<std::string> words = tool_words(plan, "talus-blocks");
    words.insert(words.end(), plan.site_words.begin(), plan.site_words.end());
    words.insert(words.end(), {"--trn", ground_of(plan), "-o", blocks, "--trn-out", bed, "--sample",
                               std::to_string(mass), "--overwrite", "-q"});
    if (fs::exists(inputs)) words.insert(words.end(), {"--inputs", inputs});
    add_registry(words, tool, plan);
    run_through(tool, words);
  }
}

// 50, 100, 200 ... runs; of rocks one by one, whose intervals do not need several runs, from
// n_runs on. The width of the intervals alone decides, never the result.
int first_runs(const Site& site, int most) {
  return std::min(site.rockfalls.empty() ? 50 : static_cast<int>(site.solver.n_runs), most);
}

void make_as_many_as_needed(Tool& tool, BatchPlan& plan, int n_jobs, int first, int most) {
  for (int n = first;; n = std::min(2 * n, most)) {
    set_runs(plan, n);
    make_blocks(tool, plan);
    make_part_or_all(tool, plan, n_jobs);
    const RunsThatLack lacking = runs_that_lack(plan);
    const std::string words = "--runs auto: " + counted(n, "run") + " are",
                      over = ", intervals over " + lacking.over;
    if (lacking.n == 0 && lacking.help) return tool.info(words + " enough" + over);
    if (lacking.n == 0)
      return tool.warn(words + " not enough" + over + ", and more runs do not help");
    if (n < most) continue;
    return tool.info(words + " not enough" + over + ", " + std::to_string(lacking.n) +
                     " more would be needed: --most " + std::to_string(n + lacking.n) +
                     " allows them");
  }
}

int n_runs_of(const Site& site, const BatchOptions& o) {
  double n = 0;
  if (o.runs.empty()) return site.solver.n_runs;
  if (o.runs == "auto") return first_runs(site, o.most);
  if (!parse_double(o.runs, n) || !(n >= 1 && n <= 1e6) || n != std::floor(n))
    throw UsageError({"", 0, "--runs"},
                     "is " + o.runs + ", expected a whole number, 1 or more, or auto");
  return static_cast<int>(n);
}

void run_tool(Tool& tool, const Site& site, const std::vector<std::string>& site_words,
              BatchOptions& o) {
  if (o.launcher.empty())
    o.launcher = (fs::read_symlink("/proc/self/exe").parent_path() / "").string();
  BatchPlan plan = plan_of(site, site_words, o);
  const bool is_auto = o.runs == "auto";
  if (is_auto && (plan.part.n_parts > 1 || site.places.empty()))
    throw UsageError({"", 0, "--runs"}, plan.part.n_parts > 1
                                            ? "is auto, and a part knows too few runs to decide"
                                            : "is auto, and the site has no [place.NAME]");
  set_runs(plan, n_runs_of(site, o));
  if (o.status) {
    compare_with_now(plan, tool, false);
    if (!o.part.empty()) return tool.result({}, line_for_make(plan, is_auto));
  } else {
    const FolderHolder holder(plan.folder, plan.part.number > 0);
    const int n_jobs = o.jobs > 0 ? o.jobs : jobs_by_default();
    if (is_auto)
      make_as_many_as_needed(tool, plan, n_jobs, first_runs(site, o.most), o.most);
    else
      make_part_or_all(tool, plan, n_jobs);
  }
  const std::vector<const EnsembleMember*> list = members_of(plan);
  const std::string failed = failed_text(plan);
  tool.result({{"folder", plan.folder}, {"n_runs", list.size()}, {"n_done", n_done(plan)}},
              std::to_string(n_done(plan)) + " of " +
                  counted(static_cast<std::int64_t>(list.size()), "run") + " done, in " +
                  plan.folder);
  if (failed.empty()) return;
  if (!o.status && std::none_of(list.begin(), list.end(),
                                [](const EnsembleMember* member) { return has_result(*member); }))
    throw InputError({plan.folder}, failed, "no run has a result");
  throw NumericsError(failed);
}

}  // namespace

int main(int argc, char** argv) {
  BatchOptions options;
  Tool tool("talus-batch", "Makes the runs of a site that are not there yet, several at a time.");
  SiteOptions site(tool);
  declare(tool, options);
  return tool.run(argc, argv, [&] { run_tool(tool, site.load(), site.words(), options); });
}
