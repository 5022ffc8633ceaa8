// Arrivals and verdicts of each run at the fences of a site; checks that both belong together.
#include "post/fence/fence_runs.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.hpp"
#include "base/text.hpp"
#include "record/pieces.hpp"

namespace talus {
namespace {

constexpr double contact_m = 0.25;  // a block so near a built fence touches it

RunAtFence run_at_fence(const RunFile& run, int index, const Fence& fence, int line, double f_min,
                        double rest_speed) {
  RunAtFence at;
  at.standing = run.lines[line].standing;
  at.arrivals = arrivals(run, line, fence, index);
  at.crossings = line_crossings(run, line, fence, index);
  at.verdicts = verdicts_of(run, index, line, at.arrivals, fence, f_min, at.standing, contact_m);
  for (const BlockVerdict& v : at.verdicts)
    at.n_unsettled += at.standing && v.verdict == Verdict::stopped &&
                      fate_of(run, v.block, rest_speed) == Fate::moving;
  for (const PanelRow& panel : run.panels)
    if (panel.line == line && std::isfinite(panel.broken_at)) at.broken.push_back(panel);
  for (const RoofHit& hit : run.roof_hits)
    if (hit.line == line)
      at.loads.push_back({index, hit.block, weight_of(run, hit.block), hit.n_hits, hit.mass,
                          hit.volume, hit.velocity.norm(), hit.normal_speed});
  std::stable_sort(at.broken.begin(), at.broken.end(),
                   [](const PanelRow& a, const PanelRow& b) { return a.broken_at < b.broken_at; });
  return at;
}

}  // namespace

int find_line(const RunFile& run, const FenceCase& fence, const std::string& file,
              const std::string& site_file) {
  const std::string what = (is_dam(fence.line) ? "" : "fence ") + fence.line.name;
  for (std::size_t l = 0; l < run.lines.size(); ++l) {
    if (run.lines[l].name != fence.line.name) continue;
    const std::vector<Vec3>&a = run.lines[l].points, &b = fence.line.points;
    // heights are those of the run's own ground, which may be another one in each run
    const auto same = [](const Vec3& p, const Vec3& q) { return (p - q).head<2>().norm() < 1e-3; };
    if (a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), same))
      return static_cast<int>(l);
    throw InputError({file}, "recorded another line for " + what + " than " + site_file,
                     "run talus-dda again with it where it is now");
  }
  throw InputError({file}, "recorded no line for " + what,
                   "it was added later: run talus-dda again");
}

void check_same_fence(const FenceSettings& stood, const FenceSettings& expected,
                      const std::string& file, const std::string& site_file) {
  using Key = std::pair<const char*, double FenceSettings::*>;
  static constexpr std::array<Key, 5> keys = {
      {{"height_m", &FenceSettings::height_m},
       {"capacity_kj", &FenceSettings::capacity_kj},
       {"max_deflection_m", &FenceSettings::max_deflection_m},
       {"friction_deg", &FenceSettings::friction_deg},
       {"cor", &FenceSettings::cor}}};
  for (const auto& [key, value] : keys) {
    const auto words = [](double x) { return std::isnan(x) ? "not given" : text(x); };
    const std::string found = words(stood.*value), wanted = words(expected.*value);
    if (found == wanted) continue;
    const std::string name = "fence." + expected.name + "." + key;
    throw InputError({file},
                     "was computed with a fence whose " + name + " is " + found + ", expected " +
                         wanted + " as in " + site_file,
                     std::isnan(stood.*value)
                         ? "run talus-dda again with the fence as it is now"
                         : "run talus-dda again with the fence as it is now, or give --set " +
                               name + "=" + found + " to judge the one that stood");
  }
}

std::vector<FenceArrival> passed_for_good(const RunAtFence& at) {
  std::vector<FenceArrival> out;
  for (const FenceArrival& crossing : at.crossings)
    if (crossing.passed_for_good &&
        !(at.standing && at.verdicts[crossing.block].verdict == Verdict::stopped))
      out.push_back(crossing);
  return out;
}

namespace {

// The fence on the ground of this run.
Fence fence_of_run(const RecordLine& line, Fence fence) {
  fence.post = line.points;
  fence.chainage = line.chainage;
  return fence;
}

}  // namespace

FenceRun run_at_fences(const RunFile& run, int index, const std::vector<FenceCase>& fences,
                       const std::vector<int>& line, const DesignCode& code,
                       const FenceRunSettings& settings, const Trn& trn) {
  FenceRun out;
  ReachSettings reach;
  reach.rest_speed = settings.rest_speed;
  const EventReach event = event_reach(run, trn, reach);
  out.event = event.event;
  out.centre = event.centre_of_mass;
  out.volume = run.blocks.volume;
  out.run_weight = run.run_weight;
  out.independent = run.info.independent;
  out.world = worlds_of(run);
  double mass = 0, volume = 0;
  for (int b = 0; b < n_blocks(run); ++b) {
    out.weight.push_back(weight_of(run, b));
    out.end.emplace_back(last_pose(run, b).position);
    out.moves.push_back(fate_of(run, b, settings.rest_speed) == Fate::moving);
    mass += run.blocks.mass[b];
    volume += run.blocks.volume[b];
  }
  out.density = mass / volume;
  for (const double v : run.blocks.volume) out.block_size += std::cbrt(v) / n_blocks(run);
  const double f_min =
      std::isnan(settings.free_border) ? free_border(code, out.block_size) : settings.free_border;
  for (std::size_t i = 0; i < fences.size(); ++i)
    out.at_fence.push_back(run_at_fence(run, index,
                                        fence_of_run(run.lines[line[i]], fences[i].fence), line[i],
                                        f_min, settings.rest_speed));
  return out;
}

double weight_of_runs(const FenceRunGroup& group) {
  double sum = 0;
  for (const FenceRun& run : group.runs) sum += run.run_weight;
  return sum;
}

std::vector<FenceArrival> arrivals_at(const FenceRunGroup& group, std::size_t fence) {
  std::vector<FenceArrival> out;
  for (int r = 0; r < n_runs(group); ++r)
    for (FenceArrival a : group.runs[r].at_fence[fence].arrivals) {
      a.run = r;  // runs were numbered as they were read, over both groups
      out.push_back(a);
    }
  return out;
}

int n_unsettled(const FenceRunGroup& group, std::size_t fence) {
  int sum = 0;
  for (const FenceRun& run : group.runs) sum += run.at_fence[fence].n_unsettled;
  return sum;
}

bool fell_one_by_one(const FenceRunGroup& group) {
  return std::all_of(group.runs.begin(), group.runs.end(),
                     [](const FenceRun& run) { return run.independent; });
}

void check_one_kind(const FenceRunGroup& group, const std::vector<FenceCase>& fences) {
  for (std::size_t i = 0; i < fences.size(); ++i)
    for (int r = 1; r < n_runs(group); ++r) {
      const bool here = group.runs[r].at_fence[i].standing;
      if (here == stood(group, i)) continue;
      const std::string name = fences[i].line.name;
      throw InputError({group.members[r].file},
                       "fence " + name + (here ? " stood" : " did not stand") +
                           " in this run, expected " + (here ? "none" : "it standing") + " as in " +
                           group.members[0].file,
                       "evaluate runs with the fence and runs without it apart, or name those "
                       "without it after --without");
    }
}

}  // namespace talus
