// Reads the fences of the site file and the runs at them.
#include "tools/fence/inputs.hpp"

#include <algorithm>
#include <optional>

#include "post/reduce.hpp"
#include "setup/site_dams_gdal.hpp"
#include "setup/site_places_gdal.hpp"

namespace talus {
namespace {

// Throws InputError unless a fence is built as it is now in the site that a run was computed with.
void check_built_alike(const Site& of_run, const FenceSettings& expected, const std::string& file,
                       const std::string& site_file) {
  const auto stood =
      std::find_if(of_run.fences.begin(), of_run.fences.end(),
                   [&](const FenceSettings& fence) { return fence.name == expected.name; });
  if (stood == of_run.fences.end()) return;  // the run does not say how it was built
  check_same_fence(*stood, expected, file, site_file);
}

// Blocks that touched a built fence are known from its panels, or else from the frames alone.
void check_frames(const RunFile& run, int line, const std::string& file) {
  const bool has_panels = std::any_of(run.panels.begin(), run.panels.end(),
                                      [line](const PanelRow& panel) { return panel.line == line; });
  if (has_panels || !run.reach) return;
  throw InputError({file}, "has no frames, and did not record what its fences met",
                   "give the run with its frames");
}

// The line of each fence in a run.
std::vector<int> lines_of(const RunFile& run, const std::vector<FenceCase>& fences,
                          const std::string& file, const std::string& site_file) {
  std::vector<int> lines;
  std::optional<Site> of_run;  // read once, where a fence stood
  for (const FenceCase& fence : fences) {
    lines.push_back(find_line(run, fence, file, site_file));
    if (!run.lines[lines.back()].standing) continue;
    if (!of_run) of_run = parse_site(run.info.config, file);
    check_built_alike(*of_run, fence.settings, file, site_file);
    check_frames(run, lines.back(), file);
  }
  return lines;
}

// Largest speeds of the runs of a part that were not left out, by cell.
void add_part_speeds(GroundSums& sums, const PartInput& part) {
  constexpr std::uint64_t most_rows = 1'000'000;
  for_each_strip(part.file, 1, {}, most_rows, [&](const auto& by_run) {
    for (std::size_t r = 0; r < by_run.size(); ++r)
      if (part.member[r] >= 0) add_speeds(sums, by_run[r]);
  });
}

}  // namespace

std::vector<FenceCase> fence_cases(Tool& tool, const Site& site, const Trn& trn) {
  std::vector<FenceCase> cases;
  std::vector<FenceLine> lines;
  for (const FenceSettings& settings : site.fences)
    for (const RecordLine& line : fence_lines(tool, site, trn, settings)) {
      lines.push_back({&settings, line});
      cases.push_back({settings, line, make_fence(line, settings)});
    }
  check_fences_apart(tool, site, trn, lines);
  if (cases.empty() && site.dams.empty())
    throw InputError({site.file}, "has no section [fence.*]", "add one with its line and height");
  return cases;
}

std::vector<DamCase> dam_cases(Tool& tool, const Site& site, const Trn& trn,
                               std::vector<FenceCase>& lines) {
  std::vector<DamCase> cases;
  const WatchedDams watched = watched_dams(tool, site, trn);
  if (watched.other_ground) throw *watched.other_ground;
  const std::vector<DamLines>& dams = watched.dams;
  const std::size_t first = lines.size();
  for (const RecordLine DamLines::*of : {&DamLines::before, &DamLines::crest})
    for (const DamLines& dam : dams) {
      FenceSettings settings;
      settings.name = (dam.*of).name;
      settings.height_m = dam.settings->height_m;
      settings.capacity_kj = dam.settings->capacity_kj;
      lines.push_back({settings, dam.*of, make_fence(dam.*of, settings)});
    }
  for (std::size_t i = 0; i < dams.size(); ++i) {
    const bool roofed = is_gallery(dams[i].crest);
    cases.push_back({dams[i].crest.name.substr((roofed ? gallery_prefix : dam_prefix).size()),
                     roofed, dams[i].settings->height_m, 1e3 * dams[i].settings->capacity_kj,
                     first + i, first + dams.size() + i, dams[i].crest, dams[i].uphill});
  }
  return cases;
}

FenceRuns read_fence_runs(RunInputs& inputs, const std::vector<std::string>& without_files,
                          const std::vector<FenceCase>& fences, const DesignCode& code,
                          double free_border, const std::string& site_file) {
  const Trn& trn = inputs.trn();
  const FenceRunSettings settings{free_border, inputs.rest_speed_m_s};
  FenceRuns out;
  out.grid = passage_grid(trn, 0);
  std::vector<FenceRun> runs;
  const auto take_into = [&](GroundSums& ground) {
    return [&](RunFile& run, int index) {
      if (run.grid.n_rows > 0) out.grid = run.grid;
      add_run(ground, out.grid, run, inputs.rest_speed_m_s);
      const std::string file = where_of(inputs.members[index]);
      const std::vector<int> lines = lines_of(run, fences, file, site_file);
      runs.push_back(run_at_fences(run, index, fences, lines, code, settings, trn));
    };
  };
  const RunParts parts{.checkpoint = false};
  inputs.read(parts, take_into(out.ground_with));
  const std::size_t n_with = runs.size(), n_parts_with = inputs.parts().size();
  if (!without_files.empty())
    inputs.read(inputs.set_of(without_files, "without"), "runs_without", parts,
                take_into(out.ground_without), RunSettings::with_other_fences);
  for (std::size_t p = 0; p < inputs.parts().size(); ++p)
    add_part_speeds(p < n_parts_with ? out.ground_with : out.ground_without, inputs.parts()[p]);
  const auto split = [&](std::size_t first, std::size_t last) {
    const std::span members(inputs.members.begin() + first, inputs.members.begin() + last);
    return FenceRunGroup{{members.begin(), members.end()},
                         {runs.begin() + first, runs.begin() + last},
                         clusters_of(members)};
  };
  out.with = split(0, n_with);
  out.without = split(n_with, runs.size());
  for (const FenceRunGroup* group : {&out.with, &out.without}) check_one_kind(*group, fences);
  return out;
}

}  // namespace talus
