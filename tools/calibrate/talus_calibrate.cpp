// tools/calibrate/talus_calibrate.cpp
// Runs beside observations, and the values that these do not contradict. Page:
// docs/tools/talus-calibrate.md
#include <algorithm>

#include "setup/observed_inputs_gdal.hpp"
#include "setup/section_state_gdal.hpp"
#include "tools/calibrate/layers.hpp"
#include "tools/frame/fault_json.hpp"
#include "tools/frame/run_inputs.hpp"
#include "tools/frame/site_options.hpp"

namespace {

using namespace talus;  // NOLINT: a program of its own

struct Options {
  std::string out, json, propose;
};

const RunParts wanted{.crossings = false,
                      .checkpoint = false,
                      .objects = false,
                      .only_last_frame = true,
                      .only_faults = true,
                      .trees = false};

// Values that a run drew; none where this version does not read its settings.
std::vector<DrawnKey> drawn_by(const RunInfo& info) {
  try {
    const Site site = parse_site(info.config, info.run_id);
    if (site.uncertainty.sample > 0) return values_in_effect(site);
  } catch (const InputError&) {
  }
  return {};
}

Computed read_all(RunInputs& runs, const std::vector<ObservedEvent>& events,
                  std::vector<std::vector<DrawnKey>>& drawn) {
  Computed computed;
  runs.read(wanted, [&](RunFile& run, int index) {
    const RunMember& member = runs.members[static_cast<std::size_t>(index)];
    if (run.grid.n_rows == 0)
      throw InputError({where_of(member)}, "holds no passages",
                       "set [output] passages = true and run talus-dda again");
    drawn.push_back(drawn_by(run.info));
    add_blocks(computed, run, index, RunInputs::rest_speed_m_s);
    if (member.part.empty()) add_passages(computed, events, run, index, run.passages);
  });
  runs.read_parts([&](const RunFile& run, const std::vector<Passage>& passages, int index) {
    add_passages(computed, events, run, index, passages);
  });
  computed.is_event_a_run =
      std::any_of(runs.members.begin(), runs.members.end(),
                  [](const RunMember& run) { return !run.info.independent || run.draws_for_all; });
  finish(computed);
  return computed;
}

void run_tool(Tool& tool, const Options& o, const Site& site, RunInputs& runs) {
  const Trn& trn = runs.trn();
  const std::vector<ObservedEvent> events = observed_events(tool, site, trn);
  if (events.empty())
    throw InputError({site.file}, "has no section [observed.*]",
                     "add one with boulders_file, scars_file or outline_file");
  std::vector<std::vector<DrawnKey>> drawn;
  const Computed computed = read_all(runs, events, drawn);
  const ShareBasis basis = share_basis(clusters_of(runs.members), runs.failed_share());
  std::vector<EventScore> scores;
  std::string summary;
  Json list = Json::array();
  for (std::size_t e = 0; e < events.size(); ++e) {
    scores.push_back(score_of(events[e], static_cast<int>(e), computed, basis));
    list.push_back(event_json(events[e], scores.back(), trn.origin));
    summary += (e == 0 ? "" : "\n") + text(scores.back());
  }
  std::vector<std::pair<std::string, std::string>> tags = tags_of(runs.members, runs.left_out);
  tags.insert(tags.begin(), {{"RUN_ID", tool.run_id()}, {"RUN_SET", runs.run_set()}});
  const std::string remark = runs.remark();
  if (!remark.empty()) tags.emplace_back("REMARK", remark);
  std::vector<VectorLayer> layers = observed_layers(events, scores, trn.origin);
  mark_layers(layers, remark);
  write_geopackage(tool.stage(o.out), trn.crs_wkt, layers, tags);
  Json tag_list;
  for (const auto& [key, value] : tags) tag_list[key] = value;
  Json result = {{"run_id", tool.run_id()},
                 {"tags", tag_list},
                 {"sections", section_state(site, {"observed"})},
                 {"n_blocks", computed.blocks.size()},
                 {"left_share", number_or_null(computed.left_share)},
                 {"events", list}};
  const Calibration found = calibrate(events, computed, drawn);
  if (!found.keys.empty()) {
    result["calibration"] = calibration_json(found, runs.members);
    summary += "\n" + text(found);
  }
  if (!o.propose.empty()) tool.write_text(o.propose, section_text(found));
  add_faults(result, faults_of(runs.members, runs.left_out));
  tool.result(result, summary);
}

}  // namespace

int main(int argc, char** argv) {
  Options o;
  Tool tool("talus-calibrate", "Runs beside what was observed: boulders, scars, outlines.");
  SiteOptions site(tool);
  site.take_inputs();
  RunInputs runs(tool);
  tool.output("-o,--out", o.out, "observations, each with its place among the runs (GeoPackage)")
      .required();
  tool.output(
      "--propose", o.propose,
      "sets of values that the observations do not contradict, as a section [uncertainty.*] "
      "(TOML)");
  tool.json_output(o.json);
  tool.footer(
      "Example:\n  talus-calibrate site.toml out/runs --trn out/bed.tif -o calibrate.gpkg --json "
      "calibrate.json");
  return tool.run(argc, argv, [&] { run_tool(tool, o, site.load(), runs); });
}
