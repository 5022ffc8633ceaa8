// Files with the results of a site, and whether they belong to the present site file and runs.
#include "tools/report/folder.hpp"

#include <algorithm>
#include <map>
#include <sstream>

#include "base/read_file.hpp"
#include "base/sha256.hpp"
#include "ensemble/made_with.hpp"
#include "ensemble/run_set.hpp"
#include "io/tags_gdal.hpp"
#include "setup/section_state_gdal.hpp"
#include "site/stages.hpp"
#include "site/uncertainty.hpp"

namespace talus {
namespace fs = std::filesystem;

bool ResultFolder::has(const std::string& name) const {
  return left_out_.count(name) == 0 && fs::exists(path(name));
}

std::string ResultFolder::text(const std::string& name) const {
  if (!has(name)) return "";
  tool_.read_also("result", path(name).string());
  return read_file(path(name).string());
}

Json ResultFolder::json(const std::string& name) const { return parsed(name, text(name)); }

Json ResultFolder::glance(const std::string& name) const {
  return parsed(name, read_file(path(name).string()));
}

std::string ResultFolder::required(const std::string& name, const std::string& tool) const {
  if (!has(name))
    throw InputError({path(name).string()}, "there is no such file",
                     "run " + tool + " first, or make in the site's folder");
  return path(name).string();
}

void ResultFolder::leave_out(const std::vector<std::string>& names, const std::string& why) {
  std::string found;
  for (const std::string& name : names) {
    if (has(name)) found += (found.empty() ? "" : ", ") + name;
    left_out_.insert(name);
  }
  if (!found.empty() && !why.empty())
    tool_.warn(path_.string() + ": left out: " + found + ": " + why);
}

Json ResultFolder::parsed(const std::string& name, const std::string& content) const {
  if (content.empty()) return nullptr;
  Json json = Json::parse_or_null(content);
  if (!json.is_object())
    throw InputError({path(name).string()}, "is not a JSON object", "make it again");
  return json;
}

std::string text_at(const Json& json, const std::string& place) {
  const Json* at = &json;
  std::istringstream keys(place.substr(1));
  for (std::string key; std::getline(keys, key, '/'); at = &at->at(key))
    if (!at->contains(key)) return "";
  return at->is_string() ? at->get<std::string>() : "";
}

Json read_runout(const ResultFolder& folder) {
  Json runout = folder.json("runout.json");
  const auto is_run = [](const Json& run) {
    return run.is_object() && run.contains("run_id") && run["run_id"].is_string() &&
           run.contains("event") && run["event"].is_object();
  };
  const bool is_whole = runout.contains("runs") && runout["runs"].is_array() &&
                        !runout["runs"].empty() &&
                        std::all_of(runout["runs"].begin(), runout["runs"].end(), is_run);
  if (!is_whole)
    throw InputError({folder.path("runout.json").string()},
                     "does not name the runs that it is made from", "make the run-out again");
  return runout;
}

std::vector<std::string> ids_of(const Json& runout) {
  std::vector<std::string> ids;
  for (const Json& run : runout.at("runs")) ids.push_back(run["run_id"].get<std::string>());
  return ids;
}

// --- which files match ---------------------------------------------------------------------------

namespace {

// The run of a tool that made a file, and the digest of the runs that it evaluated; "" where the
// file does not say.
struct Origin {
  std::string run_id, run_set;
};

Origin origin_of(const ResultFolder& folder, const std::string& name) {
  if (!name.ends_with(".json")) {
    const std::string path = folder.path(name).string();
    return {tag_of(path, "RUN_ID"), tag_of(path, "RUN_SET")};
  }
  const Json json = folder.glance(name);
  return {text_at(json, "/tags/RUN_ID"), text_at(json, "/tags/RUN_SET")};
}

// A raster with its picture and style; another file alone.
std::vector<std::string> with_sidecars(const std::string& name) {
  if (!name.ends_with(".tif")) return {name};
  const std::string base = name.substr(0, name.size() - 4);
  return {name, base + ".png", base + ".qml"};
}

// Whether the file says that it was made with the present values of these sections.
bool is_of_sections(const ResultFolder& folder, const std::string& name, const Site& site,
                    const std::vector<std::string>& sections) {
  return text_at(folder.glance(name), "/sections") == section_state(site, sections);
}

std::string of_other_sections(const std::string& names) {
  return "made with other " + names + " than the site file has";
}

const char* const of_other_runs = "not of the runs that runout.json is of";

void leave_out_fences(ResultFolder& folder, const Site& site, const std::string& run_set) {
  std::string id;
  for (const char* name : {"fence.json", "fence.gpkg", "change.tif"}) {
    if (!folder.has(name)) continue;
    const Origin origin = origin_of(folder, name);
    std::string why;
    if (site.fences.empty() && site.dams.empty())
      why = "the site has no fences";
    else if (origin.run_set != run_set)
      why = of_other_runs;
    else if (!id.empty() && origin.run_id != id)
      why = "not of the run of talus-fence that fence.json is of";
    if (why.empty())
      id = origin.run_id;
    else
      folder.leave_out(with_sidecars(name), why);
  }
}

// Maps of a folder that are of other runs than these.
void leave_out_maps(ResultFolder& folder, const std::string& maps, const std::string& run_set) {
  if (!folder.has(maps)) return;
  std::set<std::string> others;
  for (const auto& entry : fs::directory_iterator(folder.path(maps))) {
    const std::string file = entry.path().filename().string();
    if (!file.ends_with(".tif") || file[0] == '.') continue;
    if (origin_of(folder, maps + "/" + file).run_set == run_set) continue;
    for (const std::string& name : with_sidecars(maps + "/" + file)) others.insert(name);
  }
  folder.leave_out({others.begin(), others.end()}, of_other_runs);
}

// The ids of the runs of each case.
std::map<std::string, std::vector<std::string>> ids_by_case(const Json& runout) {
  std::map<std::string, std::vector<std::string>> ids;
  for (const Json& run : runout.at("runs"))
    if (const std::string name = text_at(run, "/case"); !name.empty())
      ids[name].push_back(run["run_id"].get<std::string>());
  return ids;
}

// Classes and traces of other runs, or of a site file that no longer has them.
void leave_out_hazard(ResultFolder& folder, const Site& site, const std::string& run_set) {
  const auto check = [&](const char* json, const std::vector<std::string>& with, bool is_of_site,
                         const char* what, const std::vector<std::string>& sections,
                         const char* sections_named) {
    if (!folder.has(json)) return;
    std::vector<std::string> names{json};
    names.insert(names.end(), with.begin(), with.end());
    if (!is_of_site)
      folder.leave_out(names, std::string("the site has no ") + what);
    else if (origin_of(folder, json).run_set != run_set)
      folder.leave_out(names, of_other_runs);
    else if (!is_of_sections(folder, json, site, sections))
      folder.leave_out(names, of_other_sections(sections_named));
  };
  check("hazard.json", {"hazard/hazard.gpkg"}, true, "", {"hazard"}, "[hazard*]");
  check("calibrate.json", {"calibrate.gpkg"}, !site.observed.empty(), "observations", {"observed"},
        "[observed.*]");
  check("trace.json", {"trace.gpkg"}, !site.objects.empty(), "objects", {"object", "hazard"},
        "[object.*] or [hazard*]");
  check("fence_search.json", {"fence_search.gpkg"}, !site.fence_searches.empty(), "fence searches",
        {"object", "hazard", "fence_search"}, "[object.*], [hazard*] or [fence_search.*]");
}

void leave_out_places(ResultFolder& folder, const Site& site, const std::string& run_set) {
  if (!folder.has("places.json")) return;
  if (site.places.empty())
    folder.leave_out({"places.json"}, "the site has no places");
  else if (text_at(folder.glance("places.json"), "/run_set") != run_set)
    folder.leave_out({"places.json"}, of_other_runs);
  else if (!is_of_sections(folder, "places.json", site, {"place", "fence"}))
    folder.leave_out({"places.json"}, of_other_sections("[place.*] or [fence.*]"));
}

// The factor of safety is of blocks and sections, not of runs.
void leave_out_stability(ResultFolder& folder, const Site& site) {
  const char* const json = "stability/stability.json";
  if (!folder.has(json)) return;
  const std::vector<std::string> all{json, "stability/blocks.gpkg"};
  if (!folder.has("blocks.h5") || text_at(folder.glance(json), "/blocks_sha256") !=
                                      sha256_of_file(folder.path("blocks.h5").string()))
    folder.leave_out(all, "not of the blocks of blocks.h5");
  else if (!is_of_sections(folder, json, site,
                           {"water", "joints", "material", "ground", "base_motion", "uncertainty"}))
    folder.leave_out(all, "made with other water, strength or base motion than the site file has");
}

// Curves name their runs, all of one evaluation.
void leave_out_curves(ResultFolder& folder, const std::vector<std::string>& ids) {
  if (!folder.has("curves.csv")) return;
  std::istringstream lines(read_file(folder.path("curves.csv").string()));
  std::string line;
  std::getline(lines, line);  // names of the columns
  while (std::getline(lines, line)) {
    const std::string id = line.substr(0, line.find(','));
    if (std::find(ids.begin(), ids.end(), id) != ids.end()) continue;
    folder.leave_out({"curves.csv"}, of_other_runs);
    return;
  }
}

// The terrain's report names its inputs.
void leave_out_tin(ResultFolder& folder) {
  if (!folder.has("trn.json")) return;
  const std::string source = text_at(folder.glance("trn.json"), "/source");
  if (!source.empty() && !source.ends_with(".ply"))
    folder.leave_out({"tin.json"}, "the terrain is made from " + source);
}

}  // namespace

void leave_out_others(ResultFolder& folder, const Site& site, const Json& runout) {
  const std::string run_set = run_set_id(ids_of(runout));
  leave_out_fences(folder, site, run_set);
  leave_out_maps(folder, "maps", run_set);
  for (const auto& [name, ids] : ids_by_case(runout)) {
    const std::string of_case = run_set_id(ids), fence = "fences/" + name + "/fence.json";
    leave_out_maps(folder, "maps/" + name, of_case);
    if (folder.has(fence) && (site.fences.empty() || origin_of(folder, fence).run_set != of_case))
      folder.leave_out({fence}, site.fences.empty() ? "the site has no fences" : of_other_runs);
  }
  leave_out_hazard(folder, site, run_set);
  leave_out_places(folder, site, run_set);
  leave_out_stability(folder, site);
  leave_out_tin(folder);
  leave_out_curves(folder, ids_of(runout));
  if (folder.has("runout.gpkg") &&
      origin_of(folder, "runout.gpkg").run_id != text_at(runout, "/run_id"))
    folder.leave_out({"runout.gpkg"}, "not of the run of talus-runout that runout.json is of");
}

namespace {

// Whether the report's content on the site depends on the value.
bool is_shown(const EffectiveValue& value, const ResultFolder& folder) {
  return stage_reads("run", value) || stage_reads("blocks", value) || stage_reads("trn", value) ||
         (folder.has("tin.json") && (stage_reads("import", value) || stage_reads("tin", value)));
}

}  // namespace

void check_site_of(const RunFile& run, const std::string& path, const Site& site,
                   const ResultFolder& folder) {
  const auto counts = [&](const std::string&, const EffectiveValue& old,
                          const EffectiveValue& now) {
    if (!is_shown(old.key.empty() ? now : old, folder) || old.key == "sample") return false;
    if (is_of_command_line(old) || is_of_command_line(now) || is_drawn(old)) return false;
    // a section that is gone, or a key that the program did not know yet
    return !(old.key.empty() && now.source == "default") &&
           !(now.key.empty() && old.source == "default");
  };
  const std::vector<SettingDifference> list =
      differences(made_with(run.info.config, ""), made_with(print_config(site), ""), counts);
  if (!list.empty())
    throw InputError({path},
                     "was computed with other settings than the site file has: " + text(list),
                     "give the site file that the runs were made with, or make them again");
}

std::string ground_of(const RunInfo& run, const ResultFolder& folder) {
  const Site site = run.terrain_digest.empty() ? Site{} : parse_site(run.config, run.run_id);
  const std::string own = "rock/bed_" + std::to_string(rock_mass(site.uncertainty)) + ".tif";
  for (const std::string& name : {own, std::string("bed.tif"), std::string("trn.tif")})
    if (folder.has(name) &&
        (run.trn_sha256.empty() || sha256_of_file(folder.path(name).string()) == run.trn_sha256))
      return folder.path(name).string();
  throw InputError({folder.path("bed.tif").string()}, "is not the terrain of the runs",
                   "make the runs again");
}

}  // namespace talus
