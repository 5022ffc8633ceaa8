// A run of talus-dda from its scene to its outputs: checkpoints, signals, the report.
#include "tools/dda/run.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>

#include "base/memory.hpp"
#include "base/processor_time.hpp"
#include "base/text.hpp"
#include "base/workers.hpp"
#include "post/reduce.hpp"
#include "record/pieces.hpp"
#include "run/runner.hpp"
#include "setup/run_settings.hpp"
#include "tools/dda/report.hpp"
#include "tools/frame/build_info.hpp"
#include "tools/frame/command_line.hpp"
#include "tools/frame/whole_runs.hpp"

namespace talus {
namespace {

namespace fs = std::filesystem;

RunOptions run_options(const Site& site, const ScenePlan& plan, const DdaOptions& o) {
  RunOptions options;
  options.duration = site.solver.duration_s;
  options.frame_interval = site.output.frame_interval_s;
  options.passages = plan.passages;
  options.passages_by_centroid = o.passages_by == "centroid";
  options.passage_cell_size = site.output.cell_size_m;
  options.strain = plan.strains_in_frames;
  if (site.solver.law == "paper") options.paper.emplace();
  options.limits = {site.solver.max_penetration_m, site.solver.max_energy_gain,
                    site.solver.max_lost_share, site.solver.max_unconverged_share};
  return options;
}

RunFile new_file(Tool& tool, const Site& site, const SetUp& setup) {
  const DdaInputs& inputs = setup.inputs;
  RunFile file;
  RunInfo& info = file.info;
  info.run_id = tool.run_id();
  info.version = build_version;
  info.site = site.info.name;
  info.crs_wkt = inputs.crs_wkt;
  info.origin = inputs.origin;
  info.trn_sha256 = inputs.trn_sha256;
  if (site.uncertainty.rock_masses > 0 && !setup.blocks.ground_digests.empty())
    info.terrain_digest = setup.blocks.ground_digests.back();
  info.blocks_hash = setup.blocks.content_hash;
  info.law = site.solver.law;
  info.seed = site.solver.seed;
  info.seed_draws = seed_draws(site);
  info.case_name = site.alternative;
  info.independent = moves_alone(site);
  info.weights_are_frequencies = !setup.blocks.weight.empty();
  info.config = print_config(site);
  info.made_with = tool.made_with({"trn", "blocks"});  // which have digests of their own
  info.plan = json_text(plan_json(setup.plan), 1);
  file.forests = inputs.forests;
  file.objects = inputs.objects;
  for (const std::string& line : inputs.warnings)
    info.warnings += (info.warnings.empty() ? "" : "\n") + line;
  file.blocks = run_blocks(setup.scene, setup.blocks);
  return file;
}

std::string part_of(const DdaOptions& o) { return o.out + ".part"; }

// The checkpoint takes the place of the files that a stopped run left, and is removed at the end.
void declare_outputs_beside(Tool& tool, const DdaOptions& o) {
  for (const char* end : {"", ".new"}) tool.write_also(part_of(o) + end, true);
}

void check_leftover(Tool& tool, const DdaOptions& o) {
  if (!fs::exists(part_of(o)) || o.resume || tool.overwrite()) return;
  throw InputError({part_of(o)}, "is what a run that was stopped left behind",
                   "--resume goes on with it, --overwrite starts again");
}

// Frames and records of health stay in memory until the run ends.
void ask_for_frames(const Scene& scene, const RunOptions& options, const Site& site) {
  constexpr double bytes_per_block = 128, bytes_per_interval = 512;
  const double n = options.duration / options.frame_interval;
  require_memory(n * (bytes_per_block * n_blocks(scene) + bytes_per_interval),
                 where_of(site, "output.frame_interval_s"),
                 text(n, 3) + " frames of " + counted(n_blocks(scene), "block"),
                 "set a longer frame_interval_s or a shorter duration_s");
}

// How far a run has come.
std::string reached(const Runner& runner) {
  const int n = n_blocks(runner.scene);
  if (runner.n_done < n)
    return "rock " + std::to_string(runner.n_done) + " of " + std::to_string(n);
  return text(runner.state.time, 6) + " s";
}

// From the checkpoint when there is one and it is asked for, else from the beginning.
Runner runner_of(Tool& tool, const Scene& scene, const RunOptions& options,
                 const std::vector<RecordLine>& lines, RunFile file, const DdaOptions& o) {
  const auto from_start = [&] { return begin_run(scene, options, lines, std::move(file)); };
  if (!o.resume || !fs::exists(part_of(o))) {
    if (o.resume) tool.detail(part_of(o) + " does not exist: the run starts at its beginning");
    return from_start();
  }
  RunFile part;
  try {
    RunParts parts;
    parts.merge_pieces = false;  // all bodies that may still come off
    part = read_run_file(part_of(o), parts);
  } catch (const InputError& error) {
    if (!tool.overwrite())
      throw InputError({}, error.what(), "--overwrite starts again from the beginning");
    tool.warn(std::string(error.what()) + ": the run starts at its beginning");
    return from_start();
  }
  if (part.info.run_id != file.info.run_id && tool.overwrite()) {
    tool.info(part_of(o) + " is of other inputs or settings: the run starts at its beginning");
    return from_start();
  }
  if (part.info.run_id != file.info.run_id)
    throw InputError(
        {part_of(o)},
        "belongs to a run of other inputs or settings (" + part.info.run_id + ", this one is " +
            file.info.run_id + ")",
        "give the same site file, options and inputs, or start again with --overwrite");
  part.info = file.info;
  Runner runner = resume_run(scene, options, lines, std::move(part), part_of(o));
  tool.info("goes on at " + reached(runner));
  return runner;
}

// Writes checkpoints at intervals, more rarely where writing one takes long.
class Checkpoints {
 public:
  Checkpoints(Tool& tool, std::string path, double interval_s)
      : tool_(tool), path_(std::move(path)), interval_s_(interval_s) {}

  void write(Runner& runner) {
    const auto begin = Clock::now();
    update_file(runner, true);
    replace_run_file(path_, runner.file, runner.earlier.get());
    const double cost = std::chrono::duration<double>(Clock::now() - begin).count();
    next_ = Clock::now() + to_duration(std::max(interval_s_, 20 * cost));
  }
  // A full disk does not end a run that still can end well.
  void write_if_due(Runner& runner) {
    if (Clock::now() < next_) return;
    try {
      write(runner);
    } catch (const InputError& error) {
      tool_.warn(std::string("no checkpoint: ") + error.what());
      next_ = Clock::now() + to_duration(10 * interval_s_);
    }
  }

 private:
  using Clock = std::chrono::steady_clock;
  static Clock::duration to_duration(double seconds) {
    return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  }
  Tool& tool_;
  std::string path_;
  double interval_s_;
  Clock::time_point next_ = Clock::now() + to_duration(interval_s_);
};

// Blocks below which no loop is long enough to be shared.
constexpr int least_shared_blocks = 64;

// How many threads share a step, or the rocks that fall one by one.
int n_threads(const Scene& scene, const DdaOptions& o) {
  if (n_blocks(scene) < least_shared_blocks) return 1;
  return o.threads > 0 ? o.threads : threads_by_default();
}

// To the end, to a broken limit, to a stable mass, or to a signal.
void compute(Tool& tool, Runner& runner, const std::string& part, double interval_s,
             bool may_end_standing) {
  Checkpoints checkpoints(tool, part, interval_s);
  const ProgressFunction progress = tool.progress();
  while (!is_over(runner)) {
    if (tool.interrupted()) {
      checkpoints.write(runner);
      tool.info("stopped at " + reached(runner) + "; --resume goes on from " + part);
      throw Interrupted();
    }
    if (!advance(runner)) continue;
    if (has_failed(runner)) break;
    if (may_end_standing && stands(runner)) break;
    try {
      progress(done_share(runner));
    } catch (const Interrupted&) {
      continue;  // the checkpoint comes first
    }
    checkpoints.write_if_due(runner);
  }
  finish(runner);
  if (!may_end_standing || is_over(runner) || has_failed(runner)) return;
  const std::string words = "the mass stands: no block moved more than " + text(standing_within_m) +
                            " m in " + text(runner.state.time, 3) + " s; the other " +
                            text(runner.options.duration - runner.state.time, 3) +
                            " s were left out";
  tool.warn(words);
  runner.file.info.warnings += (runner.file.info.warnings.empty() ? "" : "\n") + words;
}

void write_outputs(Tool& tool, Runner& runner, const Site& site, const Trn& trn,
                   const DdaOptions& o) {
  runner.file.info.status = "done";
  record_health(tool, runner);
  update_file(runner, false);
  const std::string path = tool.stage(o.out);
  if (keeps_frames(site.output, site.solver.seed)) {
    write_run_file(path, runner.file, runner.earlier.get());
    merge_pieces(runner.file);
  } else {
    merge_pieces(runner.file);  // the reach is that of the pieces
    RunFrames frames = runner.file.frames;
    runner.file = without_frames(std::move(runner.file), trn, {});
    write_run_file(path, runner.file, runner.earlier.get());
    runner.file.reach.reset();
    runner.file.frames = std::move(frames);
  }
}

}  // namespace

void check_options(Tool& tool, const DdaOptions& o) {
  if (!o.plan.empty() && o.plan != "show" && o.plan != "full")
    throw InputError({"", 0, "--plan"}, "is " + o.plan + ", expected full or nothing");
  if (o.out.empty() && o.plan != "show")
    throw UsageError({"", 0, "--out"}, "no output is named", "give -o RUN.h5");
  if (o.out.empty()) return;
  declare_outputs_beside(tool, o);
  check_leftover(tool, o);
}

void compute_run(Tool& tool, const Site& site, const SetUp& setup, const DdaOptions& o,
                 double cpu_start_s) {
  RunFile file = new_file(tool, site, setup);
  RunOptions options = run_options(site, setup.plan, o);
  Workers workers(n_threads(setup.scene, o));
  if (workers.n_threads() > 1) options.workers = &workers;
  options.surfaces = &setup.blocks;
  options.folder = fs::absolute(o.out).parent_path();
  options.is_stopped = [&tool] { return tool.interrupted(); };
  tool.detail(counted(workers.n_threads(), "thread"));
  ask_for_frames(setup.scene, options, site);
  Runner runner = runner_of(tool, setup.scene, options, setup.inputs.lines, std::move(file), o);
  const double from_s = runner.state.time;
  compute(tool, runner, part_of(o), site.output.checkpoint_interval_s,
          site.solver.end_when_standing);
  write_outputs(tool, runner, site, setup.scene.ground.trn, o);
  const Json report = run_report(runner, setup.plan, from_s, processor_seconds() - cpu_start_s);
  for (const char* key : {"steps", "impacts", "unconverged", "left_domain", "largest_speed_m_s"})
    tool.metric(key, report[key].get<double>(),
                std::string(key) == "largest_speed_m_s" ? "m/s" : "1");
  warn_of_standing_mass(tool, runner.file);
  tool.result(report, run_summary(report, runner.file));
}

// Also the half of one that a killed run left. One that cannot be removed does no harm.
void remove_checkpoints(const DdaOptions& o) {
  std::error_code error;
  fs::remove(part_of(o), error);
  fs::remove(part_of(o) + ".new", error);
}

}  // namespace talus
