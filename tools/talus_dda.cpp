// tools/talus_dda.cpp
// Moves blocks by three-dimensional discontinuous deformation analysis. Page:
// docs/tools/talus-dda.md
#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>

#include "base/processor_time.hpp"
#include "base/sha256.hpp"
#include "base/text.hpp"
#include "build_info.hpp"
#include "dda/site_scene.hpp"
#include "dda_inputs.hpp"
#include "site_crs.hpp"
#include "site_options.hpp"
#include "store/runner.hpp"
#include "store/xdmf_hdf5.hpp"
#include "terrain/trn_flags.hpp"
#include "tool.hpp"

namespace {

using namespace talus;  // NOLINT: a program of its own
namespace fs = std::filesystem;

struct Options {
  DdaFiles files;
  std::string out, xdmf, plan, passages_by = "footprint";
  bool resume = false, independent = false;
};

void declare(Tool& tool, SiteOptions& site, Options& o) {
  tool.input("--trn", o.files.trn, "terrain that the blocks slide on (talus-trn, talus-blocks)")
      ->required();
  tool.input("--blocks", o.files.blocks, "block set (talus-blocks)")->required();
  tool.output("-o,--out", o.out, "run to write (HDF5); not needed for --plan");
  tool.output("--xdmf", o.xdmf, "scene for ParaView (XDMF), with its own HDF5 file beside it");
  tool.app().add_flag("--plan{show}", o.plan,
                      "print what the scene needs and what is left out, then end; --plan=full "
                      "computes everything");
  tool.flag("--resume", o.resume, "go on from the checkpoint of a run that was stopped, if any");
  tool.flag("--independent", o.independent,
            "move each block as if it were alone: rocks that fall one by one");
  tool.flag(
      "--settle", o.files.settle,
      "lift blocks that start below the ground onto it with what lies on them, and move blocks "
      "apart that overlap a little");
  tool.option("--passages-by", o.passages_by,
              "a cell is passed while the footprint or only the centroid is over it")
      ->check(CLI::IsMember({"footprint", "centroid"}));
  site.option(tool, "--law", "solver.law", "contact law, talus or paper");
  site.option(tool, "--duration-s", "solver.duration_s", "time simulated");
  site.option(tool, "--time-step-s", "solver.time_step_s", "time step");
  site.option(tool, "--seed", "solver.seed", "seed of scatter and jitter");
  site.option(tool, "--frame-interval-s", "output.frame_interval_s", "time between frames");
  site.option(tool, "--checkpoint-interval-s", "output.checkpoint_interval_s",
              "wall time between checkpoints");
  tool.footer(
      "Example:\n  talus-dda site.toml --trn bed.tif --blocks blocks.h5 -o run.h5\n"
      "A run that was stopped leaves run.h5.part: a readable run, and where --resume goes on.");
}

// --- the plan ----------------------------------------------------------------------------------

Json as_json(const ScenePlan& plan) {
  Json list = Json::array();
  for (const PlanItem& item : plan.items)
    list.push_back(
        {{"item", item.item}, {"on", item.on}, {"rule", item.rule}, {"reason", item.reason}});
  return list;
}

ScenePlan plan_of(const Site& site, const DdaInputs& inputs, const Options& o) {
  if (!o.plan.empty() && o.plan != "show" && o.plan != "full")
    throw InputError({"", 0, "--plan"}, "is " + o.plan + ", expected full or nothing");
  const Trn& trn = inputs.parts.trn;
  PlanFacts facts = plan_facts(site, inputs.parts.blocks, trn, ground_flags(trn));
  facts.independent = o.independent;
  return make_plan(facts, o.plan == "full");
}

// --- the run -----------------------------------------------------------------------------------

// Equal for runs that must give equal bytes, whatever was interrupted and resumed on the way.
std::string run_id_of(const Site& site, const DdaInputs& inputs, const Options& o) {
  Sha256 hash;
  const auto add = [&hash](const std::string& words) { hash.add(words.c_str(), words.size() + 1); };
  add(build_version);
  for (const EffectiveValue& entry : effective_values(site))
    if (entry.key != "checkpoint_interval_s")
      add(entry.section + "." + entry.key + "=" + entry.value);
  add(inputs.trn_digest);
  add(inputs.parts.blocks.content_hash);
  for (const Vec3& vertex : inputs.parts.blocks.vertices) hash.add(vertex.data(), sizeof vertex);
  for (const std::uint8_t c : inputs.parts.cell_class) hash.add(&c, 1);
  for (const double time : inputs.parts.base.time) hash.add(&time, sizeof time);
  for (const Vec3& a : inputs.parts.base.acceleration) hash.add(a.data(), sizeof a);
  for (const RecordLine& line : inputs.lines)
    for (const Vec3& point : line.points) hash.add(point.data(), sizeof point);
  add(o.passages_by);
  add(o.plan);
  add(o.independent ? "independent" : "together");
  return hash.hex().substr(0, 16);
}

RunOptions run_options(const Site& site, const ScenePlan& plan, const Options& o) {
  RunOptions options;
  options.duration = site.solver.duration_s;
  options.frame_interval = site.output.frame_interval_s;
  options.passages = plan.passages;
  options.passages_by_centroid = o.passages_by == "centroid";
  options.passage_cell_size = site.output.cell_size_m;
  options.strain = site.output.strain && plan.strains;
  options.limits = {site.solver.max_penetration_m, site.solver.max_energy_gain,
                    site.solver.max_lost_share, site.solver.max_unconverged_share};
  return options;
}

RunFile new_file(const Site& site, const DdaInputs& inputs, const ScenePlan& plan,
                 const Options& o) {
  RunFile file;
  RunInfo& info = file.info;
  info.run_id = run_id_of(site, inputs, o);
  info.version = build_version;
  info.site = site.info.name;
  info.crs_wkt = inputs.crs_wkt;
  info.origin = inputs.origin;
  info.trn_sha256 = inputs.trn_sha256;
  info.blocks_hash = inputs.parts.blocks.content_hash;
  info.law = site.solver.law;
  info.seed = site.solver.seed;
  info.config = print_config(site);
  info.plan = as_json(plan).dump(1);
  for (const std::string& line : inputs.warnings)
    info.warnings += (info.warnings.empty() ? "" : "\n") + line;
  return file;
}

std::string part_of(const Options& o) { return o.out + ".part"; }

// Where the numbers of the XDMF file go.
fs::path xdmf_data_of(const Options& o) { return fs::path(o.xdmf).replace_extension(".xdmf.h5"); }

// The checkpoint takes the place of what a stopped run left, and is removed at the end.
void check_outputs_beside(Tool& tool, const Options& o) {
  for (const char* end : {"", ".new"}) tool.write_also(part_of(o) + end, true);
  if (!o.xdmf.empty()) tool.write_also(xdmf_data_of(o).string());
}

void check_leftover(Tool& tool, const Options& o) {
  if (!fs::exists(part_of(o)) || o.resume || tool.overwrite()) return;
  throw InputError({part_of(o)}, "is what a run that was stopped left behind",
                   "--resume goes on with it, --overwrite starts again");
}

// From the checkpoint when there is one and it is asked for, else from the beginning.
Runner runner_of(Tool& tool, const Scene& scene, const RunOptions& options,
                 const std::vector<RecordLine>& lines, RunFile file, const Options& o) {
  const auto from_start = [&] { return begin_run(scene, options, lines, std::move(file)); };
  if (!o.resume || !fs::exists(part_of(o))) {
    if (o.resume) tool.detail(part_of(o) + " does not exist: the run starts at its beginning");
    return from_start();
  }
  RunFile part = read_run_file(part_of(o));
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
  tool.info("goes on at " + text(runner.state.time, 6) + " s");
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
    replace_run_file(path_, runner.file);
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

// To the end, to a broken limit, or to a signal.
void compute(Tool& tool, Runner& runner, const std::string& part, double interval_s) {
  Checkpoints checkpoints(tool, part, interval_s);
  const ProgressFunction progress = tool.progress();
  std::size_t n_rows = runner.file.health.size();
  while (!is_over(runner)) {
    if (tool.interrupted()) {
      checkpoints.write(runner);
      tool.info("stopped at " + text(runner.state.time, 6) + " s; --resume goes on from " + part);
      throw Interrupted();
    }
    advance(runner);
    if (runner.file.health.size() > n_rows) {  // once an interval: clocks and limits
      n_rows = runner.file.health.size();
      if (has_failed(runner)) break;
      progress(std::min(1.0, runner.state.time / runner.options.duration));
      checkpoints.write_if_due(runner);
    }
  }
  finish(runner);
}

// --- the result --------------------------------------------------------------------------------

// Of all moments where passages are recorded, else of those of the frames.
double largest_speed(const RunFile& file) {
  float largest = 0;
  for (const Passage& row : file.passages) largest = std::max(largest, row.largest.speed);
  if (!file.passages.empty()) return largest;
  const std::vector<float>& v = file.frames.velocity;
  for (std::size_t i = 0; i + 2 < v.size(); i += 3)
    largest = std::max(largest, std::hypot(v[i], v[i + 1], v[i + 2]));
  return largest;
}

// Mean displacement of the blocks by mass, from the first frame to the last.
Vec3 mean_displacement(const RunFile& file) {
  Vec3 sum = Vec3::Zero();
  double mass = 0;
  for (int b = 0; b < n_blocks(file); ++b) {
    const double m = file.blocks.mass[static_cast<std::size_t>(b)];
    sum += m * (frame_block(file, n_frames(file.frames) - 1, b).position -
                frame_block(file, 0, b).position);
    mass += m;
  }
  return sum / mass;
}

// Panels that stood, and those that broke, when and by which block.
Json fences_on(const Runner& runner) {
  Json list = Json::array();
  for (const PanelRow& row : runner.file.panels) {
    Json panel = {{"fence", runner.file.lines[static_cast<std::size_t>(row.line)].name},
                  {"panel", row.panel},
                  {"work_kj", row.work / 1e3},
                  {"deflection_m", row.deflection},
                  {"broken", row.broken_by >= 0}};
    if (row.broken_by >= 0) {
      panel["broken_at_s"] = row.broken_at;
      panel["broken_by_block"] = row.broken_by;
    }
    list.push_back(std::move(panel));
  }
  return list;
}

Json report_on(const Runner& runner, const ScenePlan& plan, double cpu_s) {
  const RunFile& file = runner.file;
  const RunCounters& counters = runner.state.counters;
  const Vec3 moved = mean_displacement(file);
  Json json = {{"run_id", file.info.run_id},
               {"status", file.info.status},
               {"time_s", file.info.time},
               {"n_blocks", n_blocks(file)},
               {"steps", counters.steps},
               {"block_steps", counters.substeps},
               {"flight_skips", counters.flight_skips},
               {"passes", counters.passes},
               {"impacts", counters.impacts},
               {"unconverged", counters.unconverged},
               {"left_domain", counters.left_domain},
               {"n_passages", file.passages.size()},
               {"n_crossings", file.crossings.size()},
               {"n_fence_hits", file.fence_hits.size()},
               {"fences", fences_on(runner)},
               {"n_frames", n_frames(file.frames)},
               {"largest_speed_m_s", largest_speed(file)},
               {"mean_displacement_m", {moved.x(), moved.y(), moved.z()}},
               {"cpu_time_s", cpu_s}};
  json["health"] = Json::array();
  for (const HealthCheck& check : health_checks(runner))
    json["health"].push_back({{"check", check.name},
                              {"value", check.value},
                              {"limit", check.limit},
                              {"pass", check.pass}});
  json["plan"] = as_json(plan);
  return json;
}

std::string fence_summary(const Json& report) {
  const Json& panels = report["fences"];
  if (panels.empty()) return "";
  const auto n_broken = std::count_if(panels.begin(), panels.end(),
                                      [](const Json& p) { return p["broken"].get<bool>(); });
  return ", " + report["n_fence_hits"].dump() + " hits on fences, " + std::to_string(n_broken) +
         " of " + std::to_string(panels.size()) + " panels broken";
}

// What a user must not miss, where there is any.
std::string trouble_summary(const Json& report) {
  const auto said = [&report](const char* key, const std::string& what) {
    return report[key].get<std::int64_t>() == 0 ? "" : ", " + report[key].dump() + what;
  };
  return said("left_domain", " left the terrain") +
         said("unconverged", " steps of a block accepted unconverged");
}

std::string summary_of(const Json& report) {
  const auto number = [&report](const char* key) { return text(report[key].get<double>(), 4); };
  const Json& moved = report["mean_displacement_m"];
  const double horizontal = std::hypot(moved[0].get<double>(), moved[1].get<double>());
  return report["n_blocks"].dump() + " blocks, " + number("time_s") + " s in " +
         report["steps"].dump() + " steps: centre of mass moved " + text(horizontal, 4) +
         " m and fell " + text(-moved[2].get<double>(), 4) + " m, largest speed " +
         number("largest_speed_m_s") + " m/s, " + report["n_passages"].dump() + " passages, " +
         report["n_crossings"].dump() + " crossings" + fence_summary(report) +
         trouble_summary(report);
}

// The way out of a broken limit, by what its name says.
std::string health_hint(const std::string& check) {
  const auto is_of = [&check](const char* word) { return check.find(word) != std::string::npos; };
  if (is_of("penetration"))
    return "take a smaller time_step_s, or give max_penetration_m if that depth will do";
  if (is_of("left the terrain"))
    return "take a larger terrain, or give max_lost_share if blocks may leave it";
  if (is_of("energy gained") || is_of("not finite") || is_of("below the ground"))
    return "take a smaller time_step_s";
  return "";
}

void record_health(Tool& tool, Runner& runner) {
  for (const HealthCheck& check : health_checks(runner)) {
    tool.check(check.name, check.value, check.limit, check.pass, health_hint(check.name));
    if (check.pass) continue;
    runner.file.info.status = "failed";
    runner.file.info.reason += (runner.file.info.reason.empty() ? "" : "; ") + check.name + " is " +
                               text(check.value, 6) + ", limit " + text(check.limit, 6);
  }
}

void write_outputs(Tool& tool, Runner& runner, const Options& o) {
  runner.file.info.status = "done";
  record_health(tool, runner);
  update_file(runner, false);
  write_run_file(tool.stage(o.out), runner.file);
  if (o.xdmf.empty()) return;
  const fs::path data = xdmf_data_of(o);
  write_xdmf(tool.stage(o.xdmf), tool.stage(data.string()), data.filename().string(), runner.file);
}

// A slide whose blocks pass through each other must not look like a result.
void warn_of_blocks_apart(Tool& tool, const ScenePlan& plan, DdaInputs& inputs) {
  const int n = n_blocks(inputs.parts.blocks);
  if (n < 2 || plan.block_contacts) return;
  inputs.warnings.push_back(std::to_string(n) +
                            " blocks move as if each were alone: contacts "
                            "between them are not computed");
  tool.warn(inputs.warnings.back());
}

// Whoever asks for stress must not read it off blocks that have none.
void warn_of_rigid_blocks(Tool& tool, const Site& site, const ScenePlan& plan, DdaInputs& inputs) {
  const bool asked_for = site.output.strain || site.solver.strain == "on";
  if (!asked_for || site.solver.law != "talus" || !plan.block_contacts) return;
  inputs.warnings.push_back(
      "strains are asked for: law talus computes blocks that touch each other rigid, their strains "
      "stay as they were");
  tool.warn(inputs.warnings.back());
}

// Also the half of one that a killed run left. One that cannot be removed does no harm.
void remove_checkpoints(const Options& o) {
  std::error_code error;
  fs::remove(part_of(o), error);
  fs::remove(part_of(o) + ".new", error);
}

// Steps are all of one length, so a run ends with the one nearest to the duration.
double duration_reached(const SolverSettings& solver) {
  const double dt = time_step(solver);
  return std::ceil(solver.duration_s / dt - 0.5) * dt;
}

void check_times(const Site& site) {
  const SolverSettings& solver = site.solver;
  if (solver.min_time_step_s > solver.max_time_step_s)  // false where one is not given
    throw InputError(where_of(site, "solver.min_time_step_s"),
                     "min_time_step_s is " + text(solver.min_time_step_s) +
                         ", above max_time_step_s, " + text(solver.max_time_step_s));
  if (solver.duration_s < time_step(solver))
    throw InputError(where_of(site, "solver.duration_s"),
                     "duration_s is " + text(solver.duration_s) + ", less than a time step of " +
                         text(time_step(solver)) + " s",
                     "give a longer duration or a shorter time_step_s");
  constexpr double most_frames = 1e7;
  const double n_frames = solver.duration_s / site.output.frame_interval_s;
  if (n_frames > most_frames)
    throw InputError(where_of(site, "output.frame_interval_s"),
                     "gives " + text(n_frames, 3) + " frames, expected up to " + text(most_frames),
                     "give a longer frame_interval_s");
}

// What is odd about the settings, for the user now and for the run file.
std::vector<std::string> warn_of_settings(Tool& tool, const Site& site) {
  std::vector<std::string> warnings;
  const double reached = duration_reached(site.solver);
  if (std::abs(reached - site.solver.duration_s) > 1e-6 * time_step(site.solver)) {
    warnings.push_back("the run lasts " + text(reached, 6) + " s, not " +
                       text(site.solver.duration_s, 6) + " s: it is whole steps of " +
                       text(time_step(site.solver), 6) + " s");
    tool.warn(warnings.back());
  }
  const bool any_stands = std::any_of(site.fences.begin(), site.fences.end(),
                                      [](const FenceSettings& fence) { return fence.active; });
  if (any_stands && site.solver.law == "paper") {
    warnings.push_back("fences stop nothing with law paper: what crosses their lines is recorded");
    tool.warn(warnings.back());
  }
  const SolverSettings& solver = site.solver;
  if (solver.seed != SolverSettings{}.seed && solver.start_jitter_m_s == 0 &&
      solver.friction_scatter_deg == 0 && solver.cor_scatter == 0) {
    warnings.push_back(
        "the seed draws nothing: start_jitter_m_s, friction_scatter_deg and cor_scatter are 0, so "
        "other seeds give the same run");
    tool.warn(warnings.back());
  }
  for (const UnusualValue& value : unusual_values(site)) {
    warnings.push_back(value.key + " " + value.finding);
    tool.warn(where_of(site, value.key).text() + ": " + warnings.back());
  }
  return warnings;
}

}  // namespace

int main(int argc, char** argv) {
  Options o;
  Tool tool("talus-dda", "Moves blocks by three-dimensional discontinuous deformation analysis.");
  SiteOptions site_options(tool);
  declare(tool, site_options, o);
  bool is_written = false;
  const int code = tool.run(argc, argv, [&] {
    const double cpu_start = processor_seconds();
    const Site& site = site_options.load();
    check_site_crs(site);
    if (o.out.empty() && o.plan != "show")
      throw InputError({"", 0, "--out"}, "no output is named", "give -o RUN.h5");
    if (!o.out.empty()) {
      check_outputs_beside(tool, o);
      check_leftover(tool, o);
    }
    check_times(site);
    const std::vector<std::string> odd = warn_of_settings(tool, site);
    DdaInputs inputs = read_dda_inputs(tool, site, o.files);
    inputs.warnings.insert(inputs.warnings.begin(), odd.begin(), odd.end());
    const ScenePlan plan = plan_of(site, inputs, o);
    if (o.plan == "show") {
      tool.result({{"plan", as_json(plan)}}, as_text(plan));
      return;
    }
    warn_of_blocks_apart(tool, plan, inputs);
    warn_of_rigid_blocks(tool, site, plan, inputs);
    check_start(tool, site, inputs, o.files, plan.block_contacts);
    tool.detail(as_text(plan));
    RunFile file = new_file(site, inputs, plan, o);
    tool.set_run_id(file.info.run_id);
    const BlockSet blocks = inputs.parts.blocks;
    const Scene scene = make_site_scene(site, plan, std::move(inputs.parts));
    file.blocks = run_blocks(scene, blocks);
    Runner runner =
        runner_of(tool, scene, run_options(site, plan, o), inputs.lines, std::move(file), o);
    compute(tool, runner, part_of(o), site.output.checkpoint_interval_s);
    write_outputs(tool, runner, o);
    const Json report = report_on(runner, plan, processor_seconds() - cpu_start);
    for (const char* key : {"steps", "impacts", "unconverged", "left_domain", "largest_speed_m_s"})
      tool.metric(key, report[key].get<double>(),
                  std::string(key) == "largest_speed_m_s" ? "m/s" : "1");
    tool.result(report, summary_of(report));
    is_written = true;
  });
  // the run is in place: what it could have been resumed from is of no more use
  if (is_written && (code == 0 || code == 3)) remove_checkpoints(o);
  return code;
}
