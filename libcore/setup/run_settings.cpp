// Odd settings of a run: refused, or reported to the user.
#include "setup/run_settings.hpp"

#include <algorithm>
#include <cmath>

#include "base/text.hpp"
#include "setup/site_scene.hpp"

namespace talus {
namespace {

// Steps are all of one length, so a run ends with the one nearest to the duration.
double duration_reached(const SolverSettings& solver) {
  const double dt = time_step(solver);
  return std::ceil(solver.duration_s / dt - 0.5) * dt;
}

}  // namespace

void check_times(const Site& site) {
  const SolverSettings& solver = site.solver;
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

bool seed_draws(const Site& site) {
  const SolverSettings& solver = site.solver;
  return site.uncertainty.sample != 0 || solver.start_jitter_m_s != 0 ||
         solver.friction_scatter_deg != 0 || solver.cor_scatter != 0 ||
         std::any_of(site.forests.begin(), site.forests.end(), [](const ForestSettings& forest) {
           return forest.active && forest.new_stand_per_run;
         });
}

std::vector<std::string> warn_of_settings(InputLog& log, const Site& site) {
  std::vector<std::string> warnings;
  const auto warn = [&](const std::string& words) {
    warnings.push_back(words);
    log.warn(words);
  };
  const SolverSettings& solver = site.solver;
  const bool is_paper = solver.law == "paper";
  const double reached = duration_reached(solver);
  if (std::abs(reached - solver.duration_s) > 1e-6 * time_step(solver))
    warn("the run lasts " + text(reached, 6) + " s, not " + text(solver.duration_s, 6) +
         " s: it is whole steps of " + text(time_step(solver), 6) + " s");
  const auto is_active = [](const auto& section) { return section.active; };
  if (is_paper && std::any_of(site.fences.begin(), site.fences.end(), is_active))
    warn("fences stop nothing with law paper: what crosses their lines is recorded");
  if (is_paper && std::any_of(site.forests.begin(), site.forests.end(), is_active))
    warn("forests stop nothing with law paper");
  for (const FenceSettings& fence : site.fences)
    if (!std::isnan(fence.max_deflection_m) && std::isnan(fence.capacity_kj))
      warn("fence." + fence.name +
           ".max_deflection_m does nothing without capacity_kj: the fence is rigid");
  if (is_paper && solver.friction == "weakening")
    warn("friction weakens with law talus alone: law paper takes that of the sections");
  for (const GroundSettings& ground : site.grounds) {
    const GroundClass made = ground_class(ground);
    if (is_paper && (yields(made) || is_rough(made)))
      warn("ground." + ground.name + (is_rough(made) ? " is rough" : " gives way") +
           " with law talus alone: law paper knows its friction and COR");
  }
  if (solver.seed != SolverSettings{}.seed && !seed_draws(site))
    warn(
        "the seed draws nothing: start_jitter_m_s, friction_scatter_deg and cor_scatter are 0, so "
        "other seeds give the same run");
  for (const UnusualValue& value : unusual_values(site)) {
    warnings.push_back(value.key + " " + value.finding);
    log.warn(where_of(site, value.key).text() + ": " + warnings.back());
  }
  return warnings;
}

void cut_fragments(InputLog& log, const Site& site, DdaInputs& inputs) {
  if (!site.fragmentation.enabled) return;
  const auto warn = [&](const std::string& words) {
    inputs.warnings.push_back(words);
    log.warn(words);
  };
  if (site.solver.law != "talus") return warn("[fragmentation] does nothing with law paper");
  BlockSet& blocks = inputs.parts.blocks;
  const int n = n_blocks(blocks);
  inputs.parts.fragments = add_fragments(blocks, split_settings(site, blocks));
  int n_of_parts = 0, n_small = 0;
  for (int b = 0; b < n; ++b) {
    if (inputs.parts.fragments[static_cast<std::size_t>(b)].first_piece >= 0) continue;
    const bool is_of_parts = blocks.convex_part_begin[b + 1] - blocks.convex_part_begin[b] > 1;
    ++(is_of_parts ? n_of_parts : n_small);
  }
  log.detail(counted(n, "block") + " may break into " + std::to_string(n_blocks(blocks) - n) +
             " pieces of all sizes");
  if (n_of_parts > 0) warn(counted(n_of_parts, "block") + " of several convex parts cannot break");
  if (n_small > 0)
    warn(counted(n_small, "block") + " cannot break into pieces of [fragmentation] min_volume_m3");
}

void warn_of_plan(InputLog& log, const Site& site, const ScenePlan& plan, DdaInputs& inputs) {
  const int n = n_blocks(inputs.parts.blocks);
  if (n < 2) return;
  const auto warn = [&](const std::string& words) {
    inputs.warnings.push_back(words);
    log.warn(words);
  };
  // A slide whose blocks pass through each other must not look like a result.
  if (!plan.block_contacts && !site.rockfalls.empty()) return;
  if (!plan.block_contacts)
    warn(std::to_string(n) +
         " blocks move as if each were alone: contacts between them are not computed");
  // A user who asks for stress must not read it off blocks without stress.
  else if (site.solver.strain == "on" && site.solver.law == "talus")
    warn(
        "strains are asked for: law talus computes blocks that touch each other rigid, their "
        "strains stay as they were");
}

}  // namespace talus
