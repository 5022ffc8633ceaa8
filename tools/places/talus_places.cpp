// tools/places/talus_places.cpp
// How surely runs say that blocks reach the places of a site. Page: docs/tools/talus-places.md
#include <algorithm>
#include <cmath>

#include "base/text.hpp"
#include "base/words.hpp"
#include "post/fence/fence_runs.hpp"
#include "post/places.hpp"
#include "setup/section_state_gdal.hpp"
#include "setup/site_places_gdal.hpp"
#include "setup/site_shapes_gdal.hpp"
#include "tools/frame/fault_json.hpp"
#include "tools/frame/run_inputs.hpp"
#include "tools/frame/site_options.hpp"

namespace {

using namespace talus;  // NOLINT: a program of its own

std::vector<Place> places_of(Tool& tool, const Site& site, const Trn& trn,
                             const PassageGrid& grid) {
  std::vector<Place> places;
  for (const PlaceSettings& settings : site.places) {
    Place place{settings.name, settings.half_width, {}, settings.fence};
    if (settings.fence.empty()) {
      place.cells = cells_touched(grid, shapes_in_plan(tool, site, trn, place_of(settings)));
      if (std::find(place.cells.begin(), place.cells.end(), 1) == place.cells.end())
        throw InputError({site.file, settings.line},
                         "[place." + settings.name + "] lies outside of the terrain",
                         "its corners are map coordinates, as those of [source]");
    }
    places.push_back(std::move(place));
  }
  return places;
}

// The lines of the fence that a place names, as the site file has them; none for another place.
std::vector<FenceCase> lines_of(Tool& tool, const Site& site, const Trn& trn, const Place& place) {
  std::vector<FenceCase> lines;
  for (const FenceSettings& fence : site.fences) {
    if (place.line.empty() || fence.name != place.line) continue;
    for (const RecordLine& line : fence_lines(tool, site, trn, fence))
      lines.push_back({fence, line, {}});
  }
  return lines;
}

// Results of the runs at the places.
struct Reached {
  std::vector<Place> places;
  std::vector<std::vector<FenceCase>> lines;  // by place
  ShareBasis basis;
  std::vector<std::vector<BlockWeight>> blocks;  // by place, that reach it
};

void add_run(Reached& all, const RunFile& run, const std::vector<Passage>& passages, int at) {
  for (std::size_t p = 0; p < all.places.size(); ++p)
    add_reaching(all.blocks[p], all.places[p], run, at, passages);
}

Reached read_all(Tool& tool, const Site& site, RunInputs& inputs) {
  Reached all;
  const RunParts parts{.checkpoint = false,
                       .objects = false,
                       .only_last_frame = true,
                       .only_faults = true,
                       .words = false,
                       .trees = false};
  inputs.read(parts, [&](RunFile& run, int index) {
    if (run.grid.n_rows == 0)
      throw InputError({where_of(inputs.members[index])}, "holds no passages",
                       "set [output] passages = true and run talus-dda again");
    if (index == 0) {
      all.places = places_of(tool, site, inputs.trn(), run.grid);
      all.blocks.resize(all.places.size());
      for (const Place& place : all.places)
        all.lines.push_back(lines_of(tool, site, inputs.trn(), place));
    }
    for (const std::vector<FenceCase>& lines : all.lines)
      for (const FenceCase& line : lines)
        static_cast<void>(find_line(run, line, where_of(inputs.members[index]), site.file));
    if (inputs.members[index].part.empty()) add_run(all, run, run.passages, index);
  });
  inputs.read_parts([&](const RunFile& run, const std::vector<Passage>& passages, int index) {
    add_run(all, run, passages, index);
  });
  for (std::vector<BlockWeight>& blocks : all.blocks)
    std::stable_sort(blocks.begin(), blocks.end(),
                     [](const BlockWeight& a, const BlockWeight& b) { return a.run < b.run; });
  all.basis = share_basis(clusters_of(inputs.members), inputs.failed_share());
  return all;
}

Json place_json(const Place& place, const PlaceReach& reach) {
  return {{"place", place.name},
          {"share_of_blocks", reach.share},
          {"share_low", number_or_null(reach.interval.low)},
          {"share_high", number_or_null(reach.interval.high)},
          {"share_of_runs", reach.share_of_runs},
          {"share_of_runs_low", number_or_null(reach.interval_of_runs.low)},
          {"share_of_runs_high", number_or_null(reach.interval_of_runs.high)},
          {"half_width", number_or_null(reach.half_width)},
          {"wanted_half_width", place.half_width},
          {"runs_to_add", reach.to_add.n},
          {"more_runs_help", reach.to_add.help}};
}

// "road: 12.5 % of the blocks (9.8 % to 15.9 %), in 38 of 50 runs; half width 0.031, wanted 0.05"
std::string line_of(const Place& place, const PlaceReach& reach, int n_runs) {
  std::string words = place.name + ": " + percent(reach.share) + " of the blocks";
  if (std::isfinite(reach.half_width))
    words += " (" + percent(reach.interval.low) + " to " + percent(reach.interval.high) + ")";
  words += ", in " + std::to_string(reach.n_runs_hit) + " of " + counted(n_runs, "run");
  words += std::isfinite(reach.half_width)
               ? "; half width " + text(reach.half_width, 2) + ", wanted " + text(place.half_width)
               : "; too few for an interval";
  if (!reach.to_add.help) return words + ": more runs do not help";
  return reach.to_add.n == 0 ? words : words + ": add " + counted(reach.to_add.n, "run");
}

void run_tool(Tool& tool, const Site& site, RunInputs& inputs) {
  if (site.places.empty())
    throw InputError({site.file}, "names no place", "add [place.NAME] with a polygon or a fence");
  const Reached all = read_all(tool, site, inputs);
  const int n_runs = static_cast<int>(inputs.members.size());
  Json list = Json::array();
  std::string summary;
  int most = 0;
  bool help = true;
  for (std::size_t p = 0; p < all.places.size(); ++p) {
    const PlaceReach reach = place_reach(all.places[p], all.basis, all.blocks[p]);
    most = std::max(most, reach.to_add.n);
    help = help && reach.to_add.help;
    list.push_back(place_json(all.places[p], reach));
    summary += line_of(all.places[p], reach, n_runs) + "\n";
  }
  static_cast<void>(inputs.remark());
  const Clusters& clusters = all.basis.clusters;
  if (!help)
    tool.warn(
        clusters.kind == Clusters::Kind::release_cell
            ? text(clusters) +
                  " differ too much among themselves for the half width that is "
                  "wanted: release rocks from more cells (release_spacing_m, up "
                  "to the cells of the terrain), or want a larger half_width"
            : "runs of one rock mass count as one, and too few masses give no interval: raise "
              "rock_masses to 10 or more");
  summary += "intervals are made over " + text(clusters) + ": ";
  summary += !help       ? "more runs do not help"
             : most == 0 ? "all places are known as surely as wanted, by " + counted(n_runs, "run")
                         : "add " + counted(most, "run") + " to " + std::to_string(n_runs);
  Json result = {{"run_id", tool.run_id()},
                 {"run_set", inputs.run_set()},
                 {"sections", section_state(site, {"place", "fence"})},
                 {"n_runs", n_runs},
                 {"intervals_over", text(clusters)},
                 {"runs_to_add", most},
                 {"more_runs_help", help},
                 {"places", list}};
  add_faults(result, faults_of(inputs.members, inputs.left_out));
  tool.result(result, summary);
}

}  // namespace

int main(int argc, char** argv) {
  std::string json;
  Tool tool("talus-places", "How surely runs say that blocks reach the places of a site.");
  SiteOptions site(tool);
  site.take_inputs();
  RunInputs runs(tool);
  tool.json_output(json);
  tool.footer("Example:\n  talus-places site.toml run_*.h5 --trn bed.tif --json places.json");
  return tool.run(argc, argv, [&] { run_tool(tool, site.load(), runs); });
}
