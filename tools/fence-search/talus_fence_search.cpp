// tools/fence-search/talus_fence_search.cpp
// Where a fence protects an object best. Page: docs/tools/talus-fence-search.md
#include <cmath>
#include <filesystem>
#include <map>

#include "base/text.hpp"
#include "base/units.hpp"
#include "setup/section_state_gdal.hpp"
#include "tools/fence-search/output.hpp"
#include "tools/frame/command_line.hpp"
#include "tools/frame/fault_json.hpp"
#include "tools/frame/map_output.hpp"
#include "tools/frame/site_options.hpp"
#include "tools/frame/tool.hpp"

namespace {

using namespace talus;  // NOLINT: a program of its own
namespace fs = std::filesystem;

struct Options {
  std::string out, json, charts, proposals, only;
  std::vector<std::string> verified;
  int n_proposals = 3;
  bool no_refine = false;
};

void declare(Tool& tool, Options& o) {
  tool.output("-o,--out", o.out, "candidates, front and proposals (GeoPackage)").required();
  tool.json_output(o.json);
  tool.output_folder("--charts", o.charts, "folder for a chart a search: cost and what is left");
  tool.output_folder("--proposals", o.proposals,
                     "folder for the proposals, as sections for talus-dda --add");
  tool.option("--search", o.only, "this [fence_search.*] alone");
  tool.option("--n-proposals", o.n_proposals, "fences that are proposed, each search")
      .between(1, 10);
  tool.flag("--no-refine", o.no_refine, "leave fences on their candidate lines");
  tool.list("--verified", o.verified,
            "NAME=FOLDER or NAME=RUN.h5: runs with other seeds in which proposal NAME stood");
  tool.footer(
      "Example:\n  talus-fence-search site.toml run_*.h5 --trn bed.tif -o search.gpkg --proposals "
      "proposals\n  talus-dda site.toml --add proposals/house-1.toml --seed 101 ...\n  "
      "talus-fence-search site.toml run_*.h5 --trn bed.tif -o search.gpkg --verified "
      "house-1=verify/house-1");
}

/// Runs of --verified by proposal.
using Verified = std::map<std::string, std::vector<std::string>>;

Verified verified_files(Tool& tool, const std::vector<std::string>& given) {
  Verified out;
  for (const std::string& words : given) {
    const std::size_t sign = words.find('=');
    if (sign == std::string::npos || sign == 0 || sign + 1 == words.size())
      throw UsageError({"", 0, "--verified"}, "is " + words + ", expected NAME=FOLDER or NAME=FILE",
                       "e.g. --verified house-1=verify/house-1");
    const std::string name = words.substr(0, sign), path = words.substr(sign + 1);
    tool.leave_out_of_run_id({"verified." + name});
    tool.read_also("verified." + name, path);
    out[name].push_back(path);
  }
  return out;
}

RefineLimits refine_limits(const SearchCase& search) {
  RefineLimits limits;
  limits.line_slope = std::tan(search.settings->max_line_slope_deg * degree);
  limits.ground_slope = std::tan(search.settings->max_ground_slope_deg * degree);
  limits.nearest = search.settings->between_m[0];
  limits.object = &search.object;
  return limits;
}

std::vector<Proposal> placed_proposals(const SearchCase& search, const FenceSearchResult& result,
                                       int most) {
  std::vector<Proposal> out;
  for (const FenceOption& option : result.proposals) {
    if (static_cast<int>(out.size()) == most) break;
    Proposal proposal;
    proposal.option = option;
    for (const OptionPart& part : option.parts)
      proposal.fences.push_back(fence_on(search.lines[part.placed.line], part.placed));
    out.push_back(std::move(proposal));
  }
  return out;
}

// Frames of the runs near the single fences, all runs; none where a run has no frames or its blocks
// broke, since pieces would count beside the block that they are part of.
struct NearPaths {
  std::vector<std::vector<BlockPath>> of_search;
  std::string why_not;
};
NearPaths paths_near(RunInputs& runs, const std::vector<SearchCase>& cases,
                     const std::vector<SearchAnswer>& answers) {
  std::vector<Corridor> corridors(cases.size());
  for (std::size_t s = 0; s < cases.size(); ++s)
    for (const Proposal& proposal : answers[s].proposals) {
      if (proposal.fences.size() != 1) continue;
      std::vector<Vec2> line;
      for (const Vec3& post : proposal.fences[0].post) line.push_back(post.head<2>());
      corridors[s].lines.push_back(std::move(line));
    }
  NearPaths near;
  near.of_search.resize(cases.size());
  int first_block = 0;
  const RunParts wanted{.passages = false,
                        .crossings = false,
                        .health = false,
                        .checkpoint = false,
                        .objects = false,
                        .words = false,
                        .trees = false};
  runs.read_again(wanted, [&](RunFile& run, int index) {
    if (run.reach || n_frames(run.frames) <= 2)
      near.why_not = "some runs have no frames";
    else if (!run.breaks.empty())
      near.why_not = "blocks broke in some runs";
    for (std::size_t s = 0; near.why_not.empty() && s < cases.size(); ++s)
      if (!corridors[s].lines.empty())
        add_paths(near.of_search[s], run, index, first_block, cases[s].on_object[index],
                  corridors[s]);
    first_block += n_blocks(run);
  });
  return near;
}

void refine_all(Tool& tool, RunInputs& runs, const std::vector<SearchCase>& cases,
                std::vector<SearchAnswer>& answers) {
  bool any = false;
  for (const SearchAnswer& answer : answers)
    for (const Proposal& proposal : answer.proposals) any = any || proposal.fences.size() == 1;
  if (!any) return;
  const NearPaths near = paths_near(runs, cases, answers);
  const std::vector<std::vector<BlockPath>>& paths = near.of_search;
  if (!near.why_not.empty()) {
    tool.warn(near.why_not + ": fences are not refined, and stand on candidate lines");
    return;
  }
  for (std::size_t s = 0; s < cases.size(); ++s) {
    const SearchCase& search = cases[s];
    for (Proposal& proposal : answers[s].proposals) {
      if (proposal.fences.size() != 1) continue;
      const int side = search.lines[proposal.option.parts[0].placed.line].side;
      const RefinedFence refined =
          refine(search.runs, paths[s], proposal.fences[0], side, search.code, search.what,
                 runs.trn(), refine_limits(search));
      if (refined.n_moves == 0 || !refined.option.faults.empty() ||
          !(refined.option.cost < proposal.option.cost))
        continue;
      const int line = proposal.option.parts[0].placed.line;
      const PlacedFence& size = refined.option.parts[0].placed;
      proposal.fences[0] = refined.line.fence;
      proposal.fences[0].height = size.height;
      proposal.fences[0].capacity = size.capacity;
      proposal.option = refined.option;
      proposal.option.parts[0].placed.line = line;
      proposal.n_moves = refined.n_moves;
    }
    std::stable_sort(
        answers[s].proposals.begin(), answers[s].proposals.end(),
        [](const Proposal& a, const Proposal& b) { return a.option.cost < b.option.cost; });
  }
}

void name_proposals(const SearchCase& search, SearchAnswer& answer) {
  int number = 0;
  for (Proposal& proposal : answer.proposals) {
    proposal.name = search.settings->name + "-" + std::to_string(++number);
    for (std::size_t f = 0; f < proposal.fences.size(); ++f)
      proposal.fences[f].name =
          proposal.name +
          (proposal.fences.size() > 1 ? std::string(1, static_cast<char>('a' + f)) : std::string());
  }
}

void verify_all(RunInputs& runs, Verified files, const std::vector<SearchCase>& cases,
                std::vector<SearchAnswer>& answers) {
  for (std::size_t s = 0; s < cases.size(); ++s)
    for (int p = 0; p < static_cast<int>(answers[s].proposals.size()); ++p) {
      Proposal& proposal = answers[s].proposals[p];
      const auto found = files.find(proposal.name);
      if (found == files.end()) continue;
      proposal.verified =
          read_verified(runs, proposal.name, found->second, proposal.fences, cases[s]);
      files.erase(found);
      const std::string comparison = comparison_of(proposal);
      if (answers[s].best < 0 && !comparison.empty() && comparison != "worse than predicted")
        answers[s].best = p;
    }
  if (files.empty()) return;
  throw InputError({"", 0, "--verified"},
                   "names " + files.begin()->first + ", which is not a proposal of these runs",
                   "runs, settings and prices decide which proposals there are: verify again what "
                   "is proposed now");
}

void write_proposals(Tool& tool, const std::string& folder,
                     const std::vector<SearchAnswer>& answers, const Vec3& origin) {
  for (const SearchAnswer& answer : answers)
    for (const Proposal& proposal : answer.proposals)
      tool.write_text((fs::path(folder) / (proposal.name + ".toml")).string(),
                      proposal_toml(proposal, origin));
}

void warn_of(Tool& tool, const SearchCase& search, const SearchAnswer& answer) {
  for (const Proposal& proposal : answer.proposals)
    for (const OptionPart& part : proposal.option.parts)
      if (!part.demand.is_bounded) {
        tool.warn(proposal.name + ": " + std::to_string(part.demand.n) +
                  " hits are too few for the percentiles of the code: the largest values stand in "
                  "for them");
        return;
      }
  if (std::isnan(run_share_interval(search.runs.basis, 0.0).high))
    tool.warn("fence_search." + search.settings->name + ": too few runs for any interval");
}

void run_tool(Tool& tool, Options& o, SiteOptions& site_options, RunInputs& runs) {
  const Site& site = site_options.load();
  const Verified files = verified_files(tool, o.verified);
  const Trn& trn = runs.trn();
  std::vector<SearchCase> cases = search_cases(tool, site, o.only, trn);
  read_search_runs(tool, runs, site, cases);
  const std::vector<RunMember> members = runs.members;  // without those that verify
  std::vector<SearchAnswer> answers;
  for (const SearchCase& search : cases) {
    SearchAnswer answer;
    answer.result = search_fences(search.runs, search.lines, search.code, search.what, trn);
    answer.proposals = placed_proposals(search, answer.result, o.n_proposals);
    answers.push_back(std::move(answer));
  }
  if (!o.no_refine) refine_all(tool, runs, cases, answers);
  for (std::size_t s = 0; s < cases.size(); ++s) name_proposals(cases[s], answers[s]);
  verify_all(runs, files, cases, answers);
  MapTags tags = tags_of(members, runs.left_out);
  std::vector<std::string> ids;
  for (const RunMember& member : members) ids.push_back(member.info.run_id);
  tags.insert(tags.begin(), {{"RUN_ID", tool.run_id()}, {"RUN_SET", run_set_id(std::move(ids))}});
  const std::string remark = runs.remark();
  if (!remark.empty()) tags.emplace_back("REMARK", remark);
  std::vector<VectorLayer> layers = search_layers(cases, answers, trn.origin);
  mark_layers(layers, remark);
  write_geopackage(tool.stage(o.out), trn.crs_wkt, layers, tags);
  if (!o.proposals.empty()) write_proposals(tool, o.proposals, answers, trn.origin);
  Json list = Json::array();
  std::string summary;
  for (std::size_t s = 0; s < cases.size(); ++s) {
    warn_of(tool, cases[s], answers[s]);
    list.push_back(search_json(cases[s], answers[s], trn.origin));
    summary += (s > 0 ? "\n" : "") + answer_text(cases[s], answers[s]);
    if (!o.charts.empty())
      tool.write_text(
          (fs::path(o.charts) / ("fence_search_" + cases[s].settings->name + ".svg")).string(),
          search_chart(cases[s], answers[s]));
  }
  Json result = {{"run_id", tool.run_id()},
                 {"tags", Json::object()},
                 {"sections", section_state(site, {"object", "hazard", "fence_search"})},
                 {"searches", list}};
  for (const auto& [key, value] : tags) result["tags"][key] = value;
  add_faults(result, faults_of(members, runs.left_out));
  tool.result(result, summary);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  Tool tool("talus-fence-search", "Where a fence protects an object best, and what it leaves.");
  SiteOptions site(tool);
  site.take_inputs();
  RunInputs runs(tool, RunUse::evaluated_with_frames);
  declare(tool, options);
  return tool.run(argc, argv, [&] { run_tool(tool, options, site, runs); });
}
