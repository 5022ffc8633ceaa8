// Finds the time step, stiffness and strain setting that a user's scene needs.
#include "tools/verify/site.hpp"

#include <algorithm>
#include <cmath>

#include "base/text.hpp"
#include "run/runner.hpp"
#include "setup/scene_inputs_gdal.hpp"
#include "setup/set_up_gdal.hpp"
#include "setup/site_layers_gdal.hpp"
#include "tools/frame/build_info.hpp"
#include "tools/frame/command_line.hpp"
#include "tools/frame/machine.hpp"
#include "verify/study/ensemble.hpp"

namespace talus {
namespace {

double tolerance_of(const std::string& words) {
  const bool is_percent = !words.empty() && words.back() == '%';
  double value = 0;
  const bool is_number = parse_double(words.substr(0, words.size() - (is_percent ? 1 : 0)), value);
  if (!is_number || !(value > 0))
    throw UsageError({"", 0, "--tolerance"}, "is " + words + ", expected a share above 0",
                     "e.g. 1% or 0.01");
  return is_percent ? value / 100 : value;
}

Quantity quantity_of(const std::string& name) {
  const auto at = std::find(quantity_names.begin(), quantity_names.end(), name);
  return static_cast<Quantity>(at - quantity_names.begin());
}

// One setting to try. A stiffness of NaN is left to the law.
struct Candidate {
  std::string method;
  double dt = 0, normal_stiffness = not_given;
  bool strains = false, is_paper = false;
};

constexpr const char* default_method = "defaults";

// All but the time step.
bool is_default(const Candidate& c) { return c.method == default_method; }

// The defaults last, from the longest step: their shortest ones give the reference.
// `strains`: as the scene's plan keeps them.
std::vector<Candidate> candidates(bool strains, bool with_paper) {
  std::vector<Candidate> list;
  if (with_paper)
    for (const double dt : {1e-3, 2e-4, 1e-4})
      list.push_back({"law paper, k_n 5e10", dt, 5e10, strains, true});
  for (const double stiffness : {1e8, 5e10})
    for (const double dt : {2e-2, 1e-2})
      list.push_back({"k_n " + text(stiffness, 2), dt, stiffness, strains});
  for (const double dt : {2e-2, 1e-2})
    list.push_back({strains ? "without strains" : "strains", dt, not_given, !strains});
  for (const double dt : {5e-2, 2e-2, 1e-2, 5e-3, 2e-3, 1e-3})
    list.push_back({default_method, dt, not_given, strains});
  return list;
}

// As the health of a run of talus-dda, but for its energy.
bool breaks_health(const cases::Run& run, const SolverSettings& limits) {
  const StepFlag flags = run.result.flags;
  if (has(flags, StepFlag::not_finite) || has(flags, StepFlag::fell_through)) return true;
  if (lost_share(run.scene, run.state) > limits.max_lost_share) return true;
  return std::isnan(limits.max_penetration_m)
             ? has(flags, StepFlag::deep)
             : run.result.largest_penetration > limits.max_penetration_m;
}

EnsembleResult run_candidate(const Site& site, const DdaInputs& inputs, const Candidate& c,
                             int n_runs) {
  Site changed = site;
  changed.solver.law = c.is_paper ? "paper" : "talus";
  changed.solver.time_step_s = c.dt;
  changed.solver.normal_stiffness_n_m = c.normal_stiffness;
  changed.solver.strain = c.strains ? "on" : "off";
  if (changed.solver.start_jitter_m_s == 0) changed.solver.start_jitter_m_s = 1e-3;
  const ScenePlan plan = plan_of(changed, inputs.parts, false);
  const auto scene = [&](std::uint64_t seed) {
    changed.solver.seed = static_cast<std::int64_t>(seed);
    return make_site_scene(changed, plan, inputs.parts);
  };
  EnsembleResult result = run_ensemble(
      scene, n_runs, site.solver.duration_s,
      [](const Vec3& from, const Vec3& now) { return (now - from).head<2>().norm(); },
      c.is_paper ? std::optional(PaperSettings{}) : std::nullopt,
      [&](const cases::Run& run) { return breaks_health(run, site.solver); });
  result.method = c.method;
  return result;
}

// Keys that replace those of the site file.
std::string fragment_of(const Candidate& c, const SiteStudyOptions& o) {
  std::string toml = "# Cheapest settings whose " + o.quantity + " stays within " + o.tolerance +
                     " of the refined answer (talus-verify, commit " + build_commit + ").\n";
  toml +=
      "# In place of these keys of the site file's [solver]:\n[solver]\nlaw = \"talus\"\n"
      "time_step_s = " +
      text(c.dt) + "\nstrain = \"" + (c.strains ? "on" : "off") + "\"\n";
  return toml + (std::isnan(c.normal_stiffness)
                     ? "# normal_stiffness_n_m is left to law talus: do not give it\n"
                     : "normal_stiffness_n_m = " + text(c.normal_stiffness) + "\n");
}

std::string table_of(const std::vector<Candidate>& list, const std::vector<EnsembleResult>& results,
                     std::size_t q, double reference) {
  std::string table = "| Settings | dt [s] | " + std::string(quantity_names[q]) +
                      " [m] | off the reference | CPU s a run | unconverged | health broken |\n"
                      "|---|---|---|---|---|---|---|\n";
  for (std::size_t i = 0; i < list.size(); ++i)
    table += "| " + list[i].method + " | " + text(list[i].dt) + " | " +
             text(results[i].mean[q], 5) + " ± " + text(results[i].standard_error[q], 2) + " | " +
             text(100 * (results[i].mean[q] / reference - 1), 2) + " % | " +
             text(results[i].cpu, 3) + " | " + std::to_string(results[i].sums.unconverged) + " | " +
             std::to_string(results[i].n_broken) + " of " + std::to_string(results[i].n_runs) +
             " |\n";
  return table;
}

}  // namespace

std::string study_site(Tool& tool, const SiteStudyOptions& o, const std::string& out) {
  const double tolerance = tolerance_of(o.tolerance);
  const auto q = static_cast<std::size_t>(quantity_of(o.quantity));
  Site site = read_site(o.site);
  read_site_layers(tool, site);
  DdaInputs inputs = read_dda_inputs(tool, site, o.files);
  check_start(tool, site, inputs, o.files, plan_of(site, inputs.parts, false).block_contacts);
  const std::vector<Candidate> list =
      candidates(plan_of(site, inputs.parts, false).strains, o.with_paper);
  std::vector<EnsembleResult> results;
  const ProgressFunction progress = tool.progress();
  for (const Candidate& c : list) {
    results.push_back(run_candidate(site, inputs, c, o.n_runs));
    progress(static_cast<double>(results.size()) / static_cast<double>(list.size()));
  }
  const EnsembleReference reference = reference_of(results);
  const auto cost = [&](std::size_t i) {
    constexpr double worth_a_key = 1.25;  // times scatter, most beside other jobs
    return results[i].cpu * (is_default(list[i]) ? 1 : worth_a_key);
  };
  std::size_t best = list.size() - 1;
  for (std::size_t i = 0; i < list.size(); ++i)
    if (!list[i].is_paper && results[i].n_broken == 0 &&
        std::abs(results[i].mean[q] - reference.mean[q]) <= tolerance * reference.mean[q] &&
        cost(i) < cost(best))
      best = i;
  const std::vector<VerifyRow> rows =
      rows_of("site_" + o.quantity, static_cast<Quantity>(q), results, reference);
  tool.write_text(out + "/site.csv", csv_of(rows, processor_name(), build_commit));
  Chart chart = work_precision_chart("error of " + o.quantity + " [m]", rows, {});
  add_band(chart, reference.band[q]);
  tool.write_text(out + "/site.svg", chart_file(chart));
  tool.write_text(out + "/solver.toml", fragment_of(list[best], o));
  if (results[best].n_broken > 0)
    tool.warn(
        "no setting within the tolerance has runs that all keep their limits of health: look at "
        "max_penetration_m and max_lost_share, or at the scene");
  if (reference.band[q] > tolerance * reference.mean[q])
    tool.warn("the refined answer itself is known to " + text(reference.band[q], 2) +
              " m only, more than " + o.tolerance +
              " of it: give more --runs or a wider tolerance");
  return table_of(list, results, q, reference.mean[q]) + "\nReference " +
         text(reference.mean[q], 5) + " ± " + text(reference.band[q], 2) + " m; cheapest within " +
         o.tolerance + ": " + list[best].method + ", dt " + text(list[best].dt) + " s, " +
         text(results[best].cpu, 3) + " CPU s a run.\n";
}

}  // namespace talus
