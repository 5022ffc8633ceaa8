// tools/fence/talus_fence.cpp
// Arrivals at fences, their verdicts and the changes by fences. Page: docs/tools/talus-fence.md
#include <cmath>

#include "post/fence/fence_fields.hpp"
#include "post/fence/fence_text.hpp"
#include "post/maps/map_style.hpp"
#include "tools/fence/inputs.hpp"
#include "tools/fence/json.hpp"
#include "tools/fence/layers.hpp"
#include "tools/frame/fault_json.hpp"
#include "tools/frame/map_output.hpp"
#include "tools/frame/run_inputs.hpp"
#include "tools/frame/site_options.hpp"
#include "tools/frame/tool.hpp"

namespace {

using namespace talus;  // NOLINT: a program of its own

struct Options {
  std::string out, json, csv, change, code = "uni";
  std::vector<std::string> without;
  FenceResultSettings result;
};

void declare(Tool& tool, Options& o) {
  DesignInput& design = o.result.design;
  design.block_volume = design.deflection = design.distance_to_object = std::nan("");
  tool.output("-o,--out", o.out, "fields, posts and arrivals (GeoPackage)").required();
  tool.json_output(o.json);
  tool.output("--csv", o.csv, "one row a block and fence: its verdict (CSV)");
  tool.inputs("--without", o.without,
              "runs, parts or their folder without the fence, to compare with");
  tool.output("--change", o.change,
              "deposit and speed with the fences minus those of --without (GeoTIFF; style and "
              "pages beside it)");
  tool.option("--code", o.code, "design code: uni, onr, or a data file (CSV)");
  tool.option("--consequence-class", design.consequence_class, "of ONR 24810").between(1, 3);
  tool.flag("--service-level", design.service_level, "UNI: check the service energy level (SEL)");
  tool.option("--design-block-m3", design.block_volume,
              "volume of the design block [m3]; nan: 95th percentile of the blocks that arrive")
      .positive();
  tool.option("--deflection-m", design.deflection, "largest deflection of the barrier [m]")
      .not_negative();
  tool.option("--object-distance-m", design.distance_to_object,
              "distance from the fence to the object behind it [m]")
      .positive();
  tool.option("--free-border-m", design.free_border, "f_min [m]; nan: that of the code")
      .not_negative();
  tool.option("--bulking", o.result.bulking, "volume of piled blocks over that of their rock")
      .between(1.0, 3.0);
  tool.footer(
      "Example:\n  talus-fence site.toml run_*.h5 --trn slope.tif -o fence.gpkg --json fence.json\n"
      "  talus-fence site.toml with.h5 --without without.h5 --trn slope.tif -o fence.gpkg");
}

// Warnings that a reader of the verdicts at fence i must know.
void warn_of(Tool& tool, const FenceCase& fence, std::size_t i, const FenceResult& result,
             const FenceRuns& runs) {
  const std::string name = "fence " + fence.line.name;
  const bool compared = n_runs(runs.without) > 0;
  if (compared && !stood(runs.with, i))
    tool.warn(name + " did not stand in the runs compared with --without");
  if (compared && stood(runs.without, i))
    tool.warn(name + " stood in the runs of --without as well");
  if (std::isnan(fence.fence.capacity))
    tool.warn(name + " has no capacity_kj: the design check leaves its energy open");
  if (const int n = n_unsettled(runs.with, i); n > 0)
    tool.warn(name + ": " + std::to_string(n) +
              " of the blocks that it stopped were still moving when their run ended; give "
              "talus-dda a longer [solver] duration_s");
  if (result.basis == DesignBasis::first_touches && result.at_basis.n > 0)
    tool.warn(name + ": " + basis_note(result, fence.settings.name, fell_one_by_one(runs.with)));
  if (result.design.verdict == DesignVerdict::too_few)
    tool.warn(name + ": too few arrivals for the percentiles of the code, " +
              std::to_string(result.at_basis.n) + " of " + std::to_string(result.design.n_needed) +
              "; the largest values stand in for them, and nothing is judged");
}

MapTags output_tags(Tool& tool, const RunInputs& inputs, const FenceRuns& runs,
                    const std::string& remark) {
  MapTags tags = tags_of(runs.with.members, inputs.left_out);
  tags.insert(tags.begin(), {{"RUN_ID", tool.run_id()}, {"RUN_SET", inputs.run_set()}});
  if (n_runs(runs.without) > 0)
    for (const auto& [name, value] : tags_of(runs.without.members))
      if (name == "N_RUNS" || name == "DENOMINATOR" || name == "HEALTH")
        tags.emplace_back(name + "_WITHOUT", value);
  if (!remark.empty()) tags.emplace_back("REMARK", remark);
  if (inputs.n_missing > 0) tags.emplace_back("N_MISSING", std::to_string(inputs.n_missing));
  return tags;
}

void write_change(Tool& tool, RunInputs& inputs, const std::string& path, const FenceRuns& runs,
                  const MapTags& tags, const std::string& remark) {
  const MapLayer layer = change_layer(runs.ground_with, runs.ground_without, runs.grid.cell_size);
  write_map(tool, map_frame(inputs, runs.grid, {"png,pdf"}, layer.cell), path, layer,
            change_style(layer,
                         {"Change of the deposit by the fences",
                          "Thickness with the fences minus without [m]"},
                         remark),
            tags);
}

void warn_of_dam(Tool& tool, const std::string& name, const DamResult& result) {
  if (result.n_moving > 0)
    tool.warn(name + ": " + std::to_string(result.n_moving) +
              " blocks that had not passed it still moved when their run ended; give talus-dda a "
              "longer [solver] duration_s");
  if (result.n_from_downhill > 0)
    tool.warn(name + ": " + std::to_string(result.n_from_downhill) +
              " blocks came to its crest from the side with the lower ground, which is taken as "
              "downhill; draw its line where the ground rises towards them");
}

void run_tool(Tool& tool, Options& o, SiteOptions& site_options, RunInputs& inputs) {
  const Site& site = site_options.load();
  const FenceCode code = read_fence_code(o.code);
  if (!o.change.empty() && o.without.empty())
    throw InputError({"", 0, "--change"}, "has nothing to compare with",
                     "give runs without the fences by --without");
  if (o.code != "uni" && o.code != "onr") tool.read_also("code", o.code);
  const Trn& trn = inputs.trn();
  const std::vector<FenceCase> fences = fence_cases(tool, site, trn);
  std::vector<FenceCase> lines = fences;
  const std::vector<DamCase> dams = dam_cases(tool, site, trn, lines);
  FenceRuns runs =
      read_fence_runs(inputs, o.without, lines, code.code, o.result.design.free_border, site.file);
  const bool compared = n_runs(runs.without) > 0;

  const ShareBasis basis = share_basis(runs.with.clusters, inputs.failed_share());
  std::vector<FenceResult> results;
  Json fence_list = Json::array();
  std::string summary;
  for (std::size_t i = 0; i < fences.size(); ++i) {
    results.push_back(fence_result(fences[i], i, runs, code.code, code.classes, o.result, trn));
    fence_list.push_back(fence_json(fences[i], i, results[i], runs.with, basis, code));
    if (compared) fence_list.back()["comparison"] = comparison_json(runs.with, runs.without, i);
    warn_of(tool, fences[i], i, results[i], runs);
    summary += (i > 0 ? "\n" : "") + fence_summary(fences[i], i, results[i], runs.with);
  }
  Json dam_list = Json::array();
  std::vector<DamResult> dam_results;
  for (const DamCase& dam : dams) {
    set_verdicts(runs.with, dam);
    dam_results.push_back(dam_result(dam, runs.with));
    dam_list.push_back(dam_json(dam, dam_results.back(), runs.with, lines[dam.crest].fence, basis));
    warn_of_dam(tool, lines[dam.crest].line.name, dam_results.back());
    summary += (summary.empty() ? "" : "\n") + dam_summary(dam, dam_results.back(), runs.with);
  }
  std::vector<Fence> crests;
  for (const DamCase& dam : dams) crests.push_back(lines[dam.crest].fence);
  lines.resize(fences.size() + dams.size());  // a row a block and measure
  inputs.warn_of_ends();
  const std::string remark = inputs.remark();
  const MapTags tags = output_tags(tool, inputs, runs, remark);
  if (!o.change.empty()) write_change(tool, inputs, o.change, runs, tags, remark);
  std::vector<VectorLayer> layers = fence_layers(fences, results, lines, runs.with, trn.origin);
  if (!dams.empty()) layers.push_back(dam_layer(dams, dam_results, crests, trn.origin));
  mark_layers(layers, remark);
  write_geopackage(tool.stage(o.out), trn.crs_wkt, layers, tags);
  if (!o.csv.empty()) tool.write_text(o.csv, verdict_csv(lines, runs.with));
  Json tag_list;
  for (const auto& [key, value] : tags) tag_list[key] = value;
  Json result = {
      {"run_id", tool.run_id()}, {"tags", tag_list}, {"fences", fence_list}, {"dams", dam_list}};
  add_faults(result, faults_of(inputs.members, inputs.left_out));
  if (compared)
    result["deposit_change"] = deposit_change_json(runs.ground_with, runs.ground_without);
  tool.result(result, summary);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  Tool tool("talus-fence", "What fences would meet, what they hold and what they change.");
  SiteOptions site(tool);
  site.take_inputs();
  site.take_additions(tool);
  RunInputs runs(tool);
  declare(tool, options);
  return tool.run(argc, argv, [&] { run_tool(tool, options, site, runs); });
}
