// tools/runout/talus_runout.cpp
// How far runs came: deposit, paths, streamline, angle of reach, mobility. Page:
// docs/tools/talus-runout.md
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/text.hpp"
#include "io/geopackage_gdal.hpp"
#include "post/maps/map_layers.hpp"
#include "post/maps/map_style.hpp"
#include "post/reduce.hpp"
#include "post/runout/mobility.hpp"
#include "post/runout/runout_sensitivity.hpp"
#include "post/runout/runout_text.hpp"
#include "setup/site_scene.hpp"
#include "site/uncertainty.hpp"
#include "tools/frame/command_line.hpp"
#include "tools/frame/fault_json.hpp"
#include "tools/frame/map_output.hpp"
#include "tools/frame/moved_json.hpp"
#include "tools/frame/row_json.hpp"
#include "tools/frame/run_inputs.hpp"
#include "tools/frame/shipped_data.hpp"
#include "tools/frame/tool.hpp"
#include "tools/runout/json.hpp"
#include "tools/runout/layers.hpp"
#include "tools/runout/trees.hpp"

namespace {

using namespace talus;  // NOLINT: a program of its own

struct Options {
  std::string out, json, tables, thickness, mobility;
  double tolerance_m = 0.5, friction_deg = std::nan("");
  bool confined = false;
};

void declare(Tool& tool, Options& o) {
  tool.output("-o,--out", o.out, "deposit, paths, streamlines, envelope (GeoPackage)").required();
  tool.json_output(o.json);
  tool.output_folder(
      "--tables", o.tables,
      "folder for runout.csv, a row a block; runs.csv, a row a run; sensitivity.csv, "
      "what results owe to each quantity that was drawn; curves.csv, speed, energy "
      "and centre of mass over time; runout.svg, where the event lies among the "
      "mobility relations");
  tool.output("--thickness", o.thickness, "mean thickness of the deposit (GeoTIFF)");
  tool.input("--mobility", o.mobility, "relations to compare with (CSV) [share/mobility.csv]");
  tool.option("--path-tolerance-m", o.tolerance_m,
              "no point of a block's path lies farther from its simplified path [m]")
      .check(number_between(1e-6, 1e6));
  tool.option("--friction-deg", o.friction_deg,
              "angle of friction, shown beside H_cm/L_cm [deg]; nan: not shown")
      .check(number_between(0, 89, true));
  tool.flag("--confined", o.confined, "the path is laterally confined (for the relations)");
  tool.footer("Example:\n  talus-runout run.h5 --trn slope.tif -o runout.gpkg --json runout.json");
}

// Cells that runs of a part passed; all of them, unless runs were left out.
void add_cells(RunoutSums& sums, const PartInput& part) {
  const bool is_whole = std::find(part.member.begin(), part.member.end(), -1) == part.member.end();
  if (is_whole) {
    for (const std::int32_t cell : part.file.cell) add_cell(sums, cell);
    return;
  }
  constexpr std::uint64_t most_rows = 1'000'000;
  for_each_strip(part.file, 1, {}, most_rows, [&](const auto& by_run) {
    for (std::size_t r = 0; r < by_run.size(); ++r)
      if (part.member[r] >= 0)
        for (const Passage& passage : by_run[r]) add_cell(sums, passage.cell);
  });
}

// Values that the run drew: its sample and rock mass, the keys of [uncertainty], and friction and
// restitution of the ground as they are in effect.
// Nothing of a run whose settings this version does not read.
std::vector<DrawnValue> drawn_by(const RunInfo& info) {
  Site site;
  try {
    site = parse_site(info.config, info.run_id);
  } catch (const InputError&) {
    return {};
  }
  std::vector<DrawnValue> values;
  if (site.uncertainty.sample > 0)
    values.push_back({"sample", static_cast<double>(site.uncertainty.sample)});
  if (const auto mass = static_cast<double>(rock_mass(site.uncertainty)); mass > 0)
    values.push_back({"rock_mass", mass});
  if (site.uncertainty.sample > 0)
    for (const DrawnKey& key : values_in_effect(site)) values.push_back({key.key, key.value});
  for (const GroundSettings& ground : drawn_grounds(site)) {
    values.push_back({"friction_deg." + ground.name, ground.friction_deg});
    if (site.solver.cor_scatter > 0) values.push_back({"cor." + ground.name, ground.cor});
  }
  return values;
}

RunoutRuns read_runs(RunInputs& inputs, const Options& o, const Trn& trn) {
  const ReachSettings settings{o.tolerance_m, inputs.rest_speed_m_s};
  inputs.path_tolerance_m = o.tolerance_m;
  RunoutSums sums;
  inputs.read({.checkpoint = false}, [&](RunFile& run, int index) {
    add_run(sums, run, inputs.members[index], run.grid.n_rows > 0 ? run.grid : passage_grid(trn, 0),
            trn, settings);
    sums.runs.back().drawn = drawn_by(run.info);
  });
  for (const PartInput& part : inputs.parts()) add_cells(sums, part);
  return add_up(std::move(sums));
}

// Paths and curves are those of the runs that have frames.
void warn_of_runs_without_frames(Tool& tool, const RunoutRuns& all) {
  const auto n = std::count_if(all.runs.begin(), all.runs.end(),
                               [](const RunoutRun& run) { return !run.has_frames; });
  if (n > 0)
    tool.warn(std::to_string(n) + " of " +
              counted(static_cast<std::int64_t>(all.runs.size()), "run") +
              " have no frames: paths, their points and the curves leave them out");
}

void write_thickness(Tool& tool, const Options& o, const RunoutRuns& all, RunInputs& inputs,
                     const MapTags& tags, const std::string& remark) {
  const ShareBasis basis = share_basis(clusters_of(inputs.members));
  MapLayer layer = make_layer(deposit_kind(), {{}, all.deposit, all.grid.cell_size, basis, {}});
  layer.bands.erase(layer.bands.begin(), layer.bands.begin() + 2);
  write_map(tool, map_frame(inputs, all.grid, {}, layer.cell), o.thickness, layer,
            map_style(layer, remark), tags);
}

// Where little moved, the reach of a few blocks must not look like that of the volume.
void warn_of_standing_mass(Tool& tool, const RunoutRuns& all) {
  if (const std::string words = standing_runs(all.runs); !words.empty())
    tool.warn(words + ": no run-out of these, and means are over the events alone");
  if (const std::string words = standing_mass_warning(all.moved);
      !words.empty() && n_moved(all.runs) > 0)
    tool.warn(words);
}

// Hits of trees by run, and whether any had a forest.
struct AllTrees {
  std::vector<RunTrees> runs;
  std::vector<std::string> run_ids;
  bool any = false;
};

AllTrees trees_of(const RunoutRuns& all) {
  AllTrees trees;
  for (const RunoutRun& run : all.runs) {
    trees.runs.push_back(run.trees);
    trees.run_ids.push_back(run.member.info.run_id);
    trees.any = trees.any || !run.trees.forests.empty();
  }
  return trees;
}

void run_tool(Tool& tool, Options& o, RunInputs& inputs) {
  const std::vector<MobilityRelation> relations = mobility_relations(
      o.mobility.empty() ? parse_csv(shipped_data("mobility.csv"), "share/mobility.csv")
                         : read_csv(o.mobility));
  const Trn& trn = inputs.trn();
  const RunoutRuns all = read_runs(inputs, o, trn);
  MapTags tags = tags_of(inputs.members, inputs.left_out);
  tags.insert(tags.begin(), {{"RUN_ID", tool.run_id()}, {"RUN_SET", inputs.run_set()}});
  const std::string remark = inputs.remark();
  if (!remark.empty()) tags.emplace_back("REMARK", remark);
  if (inputs.n_missing > 0) tags.emplace_back("N_MISSING", std::to_string(inputs.n_missing));
  inputs.warn_of_ends();
  warn_of_standing_mass(tool, all);
  warn_of_runs_without_frames(tool, all);

  const AllTrees trees = trees_of(all);
  std::vector<VectorLayer> layers = runout_layers(all, trn.origin, o.tolerance_m);
  if (trees.any)
    for (VectorLayer& layer : tree_layers(trees.runs, trees.run_ids, trn.origin))
      layers.push_back(std::move(layer));
  mark_layers(layers, remark);
  write_geopackage(tool.stage(o.out), trn.crs_wkt, layers, tags);
  const std::vector<MobilityEvent> events = mobility_events(all.runs, all_of(all.runs), o.confined);
  const std::vector<SensitivityRow> sensitivity = sensitivity_of(all.runs);
  if (!o.tables.empty()) {
    const auto write = [&](const char* name, const std::string& content) {
      tool.write_text((std::filesystem::path(o.tables) / name).string(), content);
    };
    write("runout.csv", block_csv(all.runs, trn.origin));
    write("runs.csv", run_csv(all.runs));
    write("sensitivity.csv", csv_of(sensitivity_fields(), sensitivity));
    write("curves.csv", curve_csv(all.runs, trn.origin));
    write("runout.svg", chart_file(mobility_chart(relations, events)));
  }
  if (!o.thickness.empty()) write_thickness(tool, o, all, inputs, tags, remark);

  Json runs = Json::array(), tag_list;
  for (const RunoutRun& r : all.runs) runs.push_back(run_json(r, o.friction_deg));
  for (const auto& [key, value] : tags) tag_list[key] = value;
  Json result = {{"run_id", tool.run_id()},
                 {"tags", tag_list},
                 {"n_runs", all.runs.size()},
                 {"n_runs_moved", n_moved(all.runs)},
                 {"moved", moved_json(all.moved)},
                 {"balance", balance_json(all.balance)},
                 {"swept_area_m2", swept_area(all)},
                 {"path_tolerance_m", o.tolerance_m},
                 {"cases", cases_json(all.runs, relations, o.confined)},
                 {"cases_weighed", !inputs.pools_unasked()},
                 {"runs", runs},
                 {"sensitivity", rows_json(sensitivity_fields(), sensitivity)},
                 {"percentiles", percentiles_json(percentiles_of(relations, events))},
                 {"mobility", mobility_json(relations, events)}};
  add_spreads(result, all.runs, all_of(all.runs));
  if (trees.any) result["trees"] = trees_json(summary_of(trees.runs), trn.origin);
  add_faults(result, faults_of(inputs.members, inputs.left_out));
  tool.result(result, runout_summary(all) + mobility_text(all.runs, relations, o.confined));
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  Tool tool("talus-runout", "How far runs came: deposit, paths, angle of reach, mobility.");
  RunInputs runs(tool, RunUse::evaluated_with_frames);
  declare(tool, options);
  return tool.run(argc, argv, [&] { run_tool(tool, options, runs); });
}
