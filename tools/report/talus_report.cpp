// tools/report/talus_report.cpp
// The results of a site as one HTML file and as a QGIS project. Page: docs/tools/talus-report.md
#include <algorithm>
#include <array>
#include <filesystem>
#include <iterator>
#include <limits>
#include <memory>
#include <set>
#include <tuple>
#include <utility>

#include "base/file_paths.hpp"
#include "base/read_file.hpp"
#include "base/sha256.hpp"
#include "base/text.hpp"
#include "ensemble/ensemble.hpp"
#include "ensemble/made_with.hpp"
#include "import/dem_gdal.hpp"
#include "import/vectors_gdal.hpp"
#include "io/polygons_gdal.hpp"
#include "io/tags_gdal.hpp"
#include "post/maps/map_layers.hpp"
#include "record/part_file.hpp"
#include "report/map_cells_gdal.hpp"
#include "report/plan_view.hpp"
#include "report/qgis_template_gdal.hpp"
#include "report/styles_gdal.hpp"
#include "report/texts.hpp"
#include "report/zip.hpp"
#include "tools/frame/build_info.hpp"
#include "tools/frame/doubts_json.hpp"
#include "tools/frame/fault_json.hpp"
#include "tools/frame/shipped_data.hpp"
#include "tools/frame/site_options.hpp"
#include "tools/frame/tool.hpp"
#include "tools/frame/whole_runs.hpp"
#include "tools/report/data.hpp"
#include "tools/report/folder.hpp"
#include "tools/report/page.hpp"
#include "tools/report/project.hpp"

namespace {

using namespace talus;  // NOLINT: a program of its own
namespace fs = std::filesystem;

// Of the page; file texts.LANGUAGE.toml.
constexpr std::array shipped_languages = {"de", "fr", "it"};

struct Options {
  std::string dir, out, qgis, qgis_template, texts;
};

// --- runs ----------------------------------------------------------------------------------------

// Where a run is stored: in a file of its own, or in a part.
struct RunPlace {
  std::int64_t seed = 0;
  fs::path file;
  std::shared_ptr<const PartFile> part;  // null: a run file
  int run = 0;                           // of the part
  std::string run_id;
};

RunFile read_place(const RunPlace& place, bool whole) {
  if (place.part == nullptr)
    return read_run_file(place.file.string(), whole ? RunParts{true, false, true, true, false}
                                                    : RunParts{false, false, false, true, false});
  RunFile run = run_of(place.part->part, place.run);
  if (!whole) run.frames = {};
  return run;
}

std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  if (!fs::exists(folder)) return files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.ends_with(".h5") && name[0] != '.')  // staged ones are hidden
      files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<EnsembleMember> members_in(const std::string& runs) {
  try {
    return read_ensemble(runs).members;
  } catch (const InputError&) {  // parts replace runs that are gone
    return {};
  }
}

// The runs that were evaluated, of runs/ or else of parts/: RUNOUT.json names them, the rest is
// left from before. By seed and name.
std::vector<RunPlace> evaluated_runs(const ResultFolder& folder, const Json& runout) {
  const std::vector<std::string> listed = ids_of(runout);
  std::set<std::string> ids(listed.begin(), listed.end());
  const std::size_t n_wanted = ids.size();
  std::vector<RunPlace> found;
  for (const EnsembleMember& member : members_in(folder.path("runs").string()))
    if (ids.erase(member.run_id) > 0)
      found.push_back({member.seed, folder.path("runs") / member.file, nullptr, 0, member.run_id});
  if (!ids.empty())  // of an evaluation by hand
    for (const fs::path& file : files_in(folder.path("runs"))) {
      const RunInfo info = read_run_head(file.string()).info;
      if (ids.erase(info.run_id) > 0) found.push_back({info.seed, file, nullptr, 0, info.run_id});
    }
  for (const fs::path& file : files_in(folder.path("parts"))) {
    if (ids.empty()) break;
    const auto part = std::make_shared<const PartFile>(file.string());
    for (int r = 0; r < n_runs(part->part); ++r) {
      const RunInfo& info = part->part.runs[r].info;
      if (ids.erase(info.run_id) > 0)
        found.push_back({info.seed, part->part.name[r], part, r, info.run_id});
    }
  }
  if (!ids.empty())
    throw InputError({folder.path("runs").string()},
                     "holds " + std::to_string(found.size()) + " of the " +
                         std::to_string(n_wanted) +
                         " runs that runout.json is made from, those of parts/ counted",
                     "make the run-out again");
  std::sort(found.begin(), found.end(), [](const RunPlace& a, const RunPlace& b) {
    return std::tie(a.seed, a.file, a.run_id) < std::tie(b.seed, b.file, b.run_id);
  });
  return found;
}

// Runs that have files of their own, and of these those that keep their frames, if any does.
std::set<std::string> runs_with_frames(const std::vector<RunPlace>& places,
                                       const OutputSettings& output) {
  std::set<std::string> files, whole;
  for (const RunPlace& place : places) {
    if (place.part != nullptr) continue;
    files.insert(place.run_id);
    if (keeps_frames(output, place.seed)) whole.insert(place.run_id);
  }
  return whole.empty() ? files : whole;
}

// The run whose event came farthest along the path, of those with frames if any has; the first of
// them.
std::string farthest_run(const Json& runout, const std::vector<RunPlace>& places,
                         const OutputSettings& output) {
  const std::set<std::string> with_frames = runs_with_frames(places, output);
  std::string id;
  double farthest = -1;
  for (const Json& run : runout.at("runs")) {
    const std::string run_id = run.at("run_id").get<std::string>();
    if (!with_frames.empty() && with_frames.count(run_id) == 0) continue;
    const Json length = run.at("event").value("L_path_m", Json());
    if (!id.empty() && !(length.is_number() && length.get<double>() > farthest)) continue;
    id = run_id;
    farthest = length.is_number() ? length.get<double>() : -1;
  }
  return id;
}

void read_runs(Tool& tool, const ResultFolder& folder, const std::vector<RunPlace>& places,
               const ProgressFunction& progress, ReportData& data) {
  const std::string shown = farthest_run(data.runout, places, data.site.output);
  std::vector<RunMember> members;
  SettingsCheck settings;
  for (const RunPlace& place : places) {
    progress(0.5 * static_cast<double>(data.runs.size()) / static_cast<double>(places.size()));
    if (place.part == nullptr)
      tool.read_also("run", place.file.string());
    else
      ++data.n_in_parts;
    RunFile run = read_place(place, false);
    check_site_of(run, place.file.string(), data.site, folder);
    settings.add(place.file.string(), run.info);
    const std::string& of_case = run.info.case_name;
    data.run_names.push_back((of_case.empty() ? "" : of_case + "_") +
                             std::to_string(run.info.seed));
    if (run.info.run_id == shown) {
      data.shown = read_place(place, true);
      data.shown_name = data.run_names.back();
    }
    members.push_back(member_of(place.file.string(), run));
    if (place.part != nullptr) run.blocks.vertices.clear();
    data.runs.push_back(std::move(run));
  }
  for (const fs::path& file : files_in(folder.path("parts")))
    if (data.n_in_parts > 0) tool.read_also("part", file.string());
  data.faults = faults_of(members);
  data.repeats = repeats_text(members);
  for (const std::string& line : warnings_of(members)) data.doubts.push_back(doubt_on({}, line));
  if (const std::string words = talus::text(data.faults); !words.empty())
    tool.warn(words + ": every part of the report says so");
}

// --- registry ------------------------------------------------------------------------------------

// The run that wrote a file with this content, of those before row `before`; none: id 0.
RunRecord writer_of(const std::string& db, const std::string& sha256, std::int64_t before) {
  for (const std::int64_t id : runs_that_wrote(db, sha256))
    if (id < before) return read_run(db, std::to_string(id));
  return {};
}

// Runs in place of a part, which talus-reduce made of them and of other parts. The part goes to
// `parts`.
void add_runs(const std::string& db, const RunArtifact& file, std::int64_t before,
              std::vector<RunArtifact>& runs, std::vector<RunArtifact>& parts) {
  if (file.sha256.empty() || fs::path(file.path).filename() == ensemble_name) return;  // of a set
  const bool is_part = fs::exists(file.path) && is_part_file(file.path);
  const RunRecord record = is_part ? writer_of(db, file.sha256, before) : RunRecord{};
  if (record.id == 0) {
    runs.push_back(file);
    return;
  }
  parts.push_back({"part", file.path, file.sha256, file.n_bytes});
  for (RunArtifact input : record.inputs) {
    if (input.role != "run") continue;
    input.role = file.role;
    add_runs(db, input, record.id, runs, parts);
  }
}

// Inputs of a step, runs by name, numbers by their value: the same however they were spread
// over parts.
std::vector<RunArtifact> inputs_of(const std::string& db, const RunRecord& step) {
  std::vector<RunArtifact> files, runs, parts;
  for (const RunArtifact& file : step.inputs) {
    if (file.role == "run" || file.role == "without")
      add_runs(db, file, step.id, runs, parts);
    else
      files.push_back(file);
  }
  std::stable_sort(runs.begin(), runs.end(), [](const RunArtifact& a, const RunArtifact& b) {
    return std::tuple(a.path.size(), a.path) < std::tuple(b.path.size(), b.path);
  });
  files.insert(files.end(), runs.begin(), runs.end());
  files.insert(files.end(), parts.begin(), parts.end());
  return files;
}

// A step that was repeated on the same inputs and wrote the same is one step.
std::string what_it_did(const RunRecord& step) {
  std::string words = step.content_id;
  for (const RunArtifact& file : step.outputs) words += " " + file.sha256;
  return words;
}

// Depth first, so that each step comes after those whose outputs it reads.
void add_steps(const std::string& db, const std::string& sha256, std::int64_t before,
               std::set<std::string>& seen, std::vector<RunRecord>& steps) {
  if (sha256.empty()) return;
  RunRecord record = writer_of(db, sha256, before);
  if (record.id == 0 || !seen.insert(what_it_did(record)).second) return;
  record.inputs = inputs_of(db, record);
  for (const RunArtifact& input : record.inputs)
    if (input.role != "part") add_steps(db, input.sha256, record.id, seen, steps);
  steps.push_back(std::move(record));
}

void read_registry(const std::string& db, const ResultFolder& folder,
                   const std::vector<RunPlace>& places, const ProgressFunction& progress,
                   ReportData& data) {
  if (!fs::exists(db)) return;
  constexpr std::int64_t latest = std::numeric_limits<std::int64_t>::max();
  for (std::size_t i = 0; i < places.size(); ++i) {
    progress(0.5 + 0.4 * static_cast<double>(i) / static_cast<double>(places.size()));
    if (places[i].part != nullptr) continue;  // its file may be gone
    add_limits(writer_of(db, sha256_of_file(places[i].file.string()), latest).checks, data.limits);
  }
  std::set<std::string> seen;
  const std::string a_map = std::string("maps/") + map_layers().front().name + ".tif";
  for (const std::string& name : {std::string("runout.gpkg"), a_map, std::string("fence.gpkg")})
    if (folder.has(name))
      add_steps(db, sha256_of_file(folder.path(name).string()), latest, seen, data.steps);
}

// Files beside the main one of a tool that do not say which run they are of. One that the registry
// knows from other work, of which nothing was read for these results, is left out.
void leave_out_of_other_work(const std::string& db, ResultFolder& folder, ReportData& data) {
  if (data.steps.empty()) return;
  std::set<std::string> tools, read{sha256_of_file(folder.path("runout.json").string())};
  for (const RunRecord& step : data.steps) {
    tools.insert(step.tool);
    for (const RunArtifact& file : step.inputs) read.insert(file.sha256);
  }
  for (const char* name : {"tin.json", "trn.json", "blocks.json", "stereonet.svg", "sizes.svg",
                           "runout.svg", "curves.csv"}) {
    if (!folder.has(name)) continue;
    constexpr std::int64_t latest = std::numeric_limits<std::int64_t>::max();
    const RunRecord by = writer_of(db, sha256_of_file(folder.path(name).string()), latest);
    const auto is_read = [&read](const RunArtifact& file) { return read.contains(file.sha256); };
    if (by.id == 0 || !tools.contains(by.tool) ||
        std::any_of(by.outputs.begin(), by.outputs.end(), is_read))
      continue;
    // each run has blocks of its own
    const bool is_expected = by.tool == "talus-blocks" && data.site.uncertainty.rock_masses > 0;
    folder.leave_out(
        {name},
        is_expected ? "" : "of a run of " + by.tool + " that these results were not made from");
  }
  if (!folder.has("tin.json")) data.tin = nullptr;
  if (!folder.has("trn.json")) data.trn = nullptr;
  if (!folder.has("blocks.json")) data.blocks = nullptr;
  if (!folder.has("stereonet.svg")) data.stereonet_svg.clear();
  if (!folder.has("sizes.svg")) data.sizes_svg.clear();
  if (!folder.has("runout.svg")) data.mobility_svg.clear();
  if (!folder.has("curves.csv")) data.curves_csv.clear();
}

// Inputs from outside of the folder that have changed by now: the results are of their former
// content. The site file was compared value by value, files that count by their content elsewhere.
void warn_of_changed_inputs(Tool& tool, const ResultFolder& folder,
                            const std::vector<RunRecord>& steps) {
  const std::string results = (fs::path(absolute_path(folder.path("").string())) / "").string();
  std::set<std::pair<std::string, std::string>> seen;
  for (const RunRecord& step : steps)
    for (const RunArtifact& file : step.inputs) {
      const bool is_result = file.path.starts_with(results) || file.role == "run" ||
                             file.role == "without" || file.role == "part";
      if (is_result || file.role == "site" || file.role == "by content" ||
          !fs::is_regular_file(file.path) || !seen.insert({file.path, file.sha256}).second)
        continue;
      if (sha256_of_file(file.path) != file.sha256)
        tool.warn(file.path + ": has changed since " + step.tool +
                  " read it: these results are of what it held; make them again");
    }
}

// --- the page ------------------------------------------------------------------------------------

// Of a raster that the folder has, with its style.
std::vector<MapPicture> picture_of(const ResultFolder& folder, const std::string& base,
                                   const MapSheet& sheet) {
  if (!folder.has(base + ".tif") || !folder.has(base + ".qml")) return {};
  const std::string qml = folder.text(base + ".qml");
  static_cast<void>(folder.text(base + ".tif"));  // named in the registry
  MapPicture picture{
      fs::path(base).filename().string(), qml,
      read_cell_picture(folder.path(base + ".tif").string(), qml, sheet.ground.view, sheet.origin)};
  if (picture.map.cells.value.empty()) return {};  // nothing of it is in view
  return {std::move(picture)};
}

// The pictures of a folder with maps, by name.
std::vector<MapPicture> pictures_in(const ResultFolder& folder, const std::string& maps,
                                    const MapSheet& sheet) {
  std::vector<MapPicture> pictures;
  if (!folder.has(maps)) return pictures;
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder.path(maps)))
    if (entry.path().extension() == ".tif" && entry.path().filename().string()[0] != '.' &&
        folder.has(maps + "/" + entry.path().filename().string()))
      names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  for (const std::string& name : names)
    for (MapPicture& picture : picture_of(folder, maps + "/" + name, sheet))
      pictures.push_back(std::move(picture));
  return pictures;
}

// Of several cases those that have a result of their own.
std::vector<std::string> cases_with(const ResultFolder& folder, const Json& runout,
                                    const std::string& before, const std::string& behind) {
  std::vector<std::string> names;
  const Json cases = runout.value("cases", Json::array());
  for (const Json& one : cases)
    if (cases.size() > 1 && folder.has(before + one.at("case").get<std::string>() + behind))
      names.push_back(one.at("case").get<std::string>());
  return names;
}

// The view of the pages of maps, or the extent of the shown run.
MapView view_of_maps(const ResultFolder& folder, const ReportData& data) {
  PlanWindow window = plan_window(data.shown, data.terrain);
  if (folder.has("maps/reach.tif"))
    if (const auto shown = cells_on_pages(folder.path("maps/reach.tif").string())) {
      const Vec2 origin = data.terrain.origin.head<2>();
      window = {shown->first - origin, shown->second - origin};
    }
  return view_of(layout_of(PageSize::a4), window.low, window.high);
}

// As talus-hazard hatches its page.
void hatch_class_map(const ResultFolder& folder, ReportData& data) {
  const std::string certain = "hazard/class_certain.tif";
  for (MapPicture& map : data.hazard_maps) {
    if (map.name != "class" || !folder.has(certain)) continue;
    for (const Json& row : data.hazard.at("classes"))
      if (row.value("hatched", false)) map.weak.push_back(row.at("code").get<int>());
    hatch_classes(map.map.cells, folder.path(certain).string(), map.weak, data.sheet.ground.view,
                  data.sheet.origin);
  }
}

void read_maps(const ResultFolder& folder, ReportData& data) {
  MapSheet& sheet = data.sheet;
  sheet.ground = map_ground(data.terrain, layout_of(PageSize::a4), view_of_maps(folder, data));
  sheet.origin = data.terrain.origin.head<2>();
  add_places(sheet.places, data.shown);
  sheet.places.source =
      rim_of(sheet.places.source, source_gap(data.rocks_alone, sheet.ground.view.scale));
  data.maps = pictures_in(folder, "maps", sheet);
  for (const std::string& name : cases_with(folder, data.runout, "maps/", "/reach.tif"))
    data.case_maps.emplace_back(name, pictures_in(folder, "maps/" + name, sheet));
  for (const std::string& name : hazard_maps_of(data.hazard))
    for (MapPicture& picture : picture_of(folder, "hazard/" + name, sheet))
      data.hazard_maps.push_back(std::move(picture));
  hatch_class_map(folder, data);
  for (MapPicture& map : data.hazard_maps)
    for (auto& [code, label] : map.map.labels) label = data.texts.said(label);
  data.change_map = picture_of(folder, "change", sheet);
}

// The paths of all blocks of all runs, as talus-runout writes them; none for runs without frames.
std::vector<std::vector<Vec3>> trails_in(const ResultFolder& folder, const Vec3& origin) {
  const std::string path = folder.path("runout.gpkg").string();
  const std::vector<StyledLayer> layers = styled_layers(path);
  if (std::none_of(layers.begin(), layers.end(), [](const StyledLayer& layer) {
        return layer.name == "paths" && !layer.is_empty;
      }))
    return {};
  std::vector<std::vector<Vec3>> trails =
      read_vectors({path + "|layername=paths", VectorKind::lines}, "").shapes;
  for (std::vector<Vec3>& trail : trails)
    for (Vec3& p : trail) p -= origin;
  return trails;
}

// The words of the page: English ones, and those of a shipped language or of a file in place of
// them.
Texts page_texts(Tool& tool, const std::string& language_or_file) {
  Texts texts = parse_texts(shipped_data("texts.toml"), "texts.toml");
  const auto& shipped = shipped_languages;
  if (language_or_file.empty() || language_or_file == "en") return texts;
  if (std::find(shipped.begin(), shipped.end(), language_or_file) != shipped.end()) {
    const std::string name = "texts." + language_or_file + ".toml";
    static_cast<void>(texts.replace_by(parse_texts(shipped_data(name), name)));
    return texts;
  }
  tool.read_also("texts", language_or_file);
  const std::vector<std::string> missing =
      texts.replace_by(parse_texts(read_file(language_or_file), language_or_file));
  if (missing.empty()) return texts;
  std::string first;
  for (std::size_t i = 0; i < std::min<std::size_t>(missing.size(), 3); ++i)
    first += (first.empty() ? "" : ", ") + missing[i];
  tool.warn(language_or_file + ": lacks " + counted(std::ssize(missing), "text") +
            " of the page (" + first + (missing.size() > 3 ? ", ..." : "") +
            "): there the shipped ones stand");
  return texts;
}

ReportData read_data(Tool& tool, const Site& site, const std::string& texts, ResultFolder& folder,
                     const ProgressFunction& progress) {
  ReportData data(site, page_texts(tool, texts));
  data.version = build_version;
  data.terrain = read_trn(folder.required("trn.tif", "talus-trn"));
  folder.required("runout.json", "talus-runout");
  data.runout = read_runout(folder);
  leave_out_others(folder, site, data.runout);
  data.tin = folder.json("tin.json");
  data.trn = folder.json("trn.json");
  data.blocks = folder.json("blocks.json");
  data.fence = folder.json("fence.json");
  if (folder.has("places.json")) data.places = folder.json("places.json");
  data.calibrate = folder.json("calibrate.json");
  data.hazard = folder.json("hazard.json");
  data.trace = folder.json("trace.json");
  data.stability = folder.json("stability/stability.json");
  for (const VariantSettings& variant : site.variants) {
    const std::string of = "variant/" + variant.name + "/";
    if (!is_alternative(variant) && folder.has(of + "runout.json"))
      data.measures.push_back({variant.name, folder.json(of + "fence.json"),
                               folder.json(of + "hazard.json"), folder.json(of + "trace.json")});
  }
  data.search = folder.json("fence_search.json");
  if (data.search.is_object() && data.search.contains("searches"))
    for (const Json& search : data.search["searches"]) {
      const std::string file = "search/charts/fence_search_" + text_at(search, "/name") + ".svg";
      data.search_svgs.push_back(folder.has(file) ? folder.text(file) : "");
    }
  if (folder.has("runout.gpkg")) data.trails = trails_in(folder, data.terrain.origin);
  data.mobility_svg = folder.text("runout.svg");
  data.stereonet_svg = folder.text("stereonet.svg");
  data.sizes_svg = folder.text("sizes.svg");
  data.curves_csv = folder.text("curves.csv");
  for (const std::string& name : cases_with(folder, data.runout, "fences/", "/fence.json"))
    data.case_fences.emplace_back(name, folder.json("fences/" + name + "/fence.json"));
  if (folder.has("maps/reach.tif"))
    data.runs_to_add = tag_of(folder.path("maps/reach.tif").string(), "RUNS_TO_ADD");
  const std::vector<RunPlace> places = evaluated_runs(folder, data.runout);
  read_runs(tool, folder, places, progress, data);
  data.rocks_alone = !data.runs.empty() && data.runs.front().info.independent;
  if (data.rocks_alone) data.texts.speak_of_rocks();
  data.bed = read_trn(ground_of(data.shown.info, folder));
  read_maps(folder, data);
  read_registry(tool.registry(), folder, places, progress, data);
  leave_out_of_other_work(tool.registry(), folder, data);
  warn_of_changed_inputs(tool, folder, data.steps);
  std::vector<Doubt> of_runs = std::exchange(data.doubts, {});
  for (const Json& report :
       {folder.json("import.json"), data.tin, data.trn, data.blocks, folder.json("check.json")})
    std::ranges::move(doubts_of(report), std::back_inserter(data.doubts));
  std::ranges::move(of_runs, std::back_inserter(data.doubts));
  data.run_id = tool.run_id();
  return data;
}

// The layout and settings of the project, an office's in place of the shipped ones.
QgisTemplate qgis_template(const Options& o) {
  if (o.qgis_template.empty()) return {"project.qgs", shipped_data("project.qgs")};
  return read_qgis_template(o.qgis_template);
}

void run_tool(Tool& tool, const Options& o, const Site& site) {
  ResultFolder folder(tool, o.dir);
  const ProgressFunction progress = tool.progress();
  const ReportData data = read_data(tool, site, o.texts, folder, progress);
  progress(0.9);
  std::string qgs;
  if (!o.qgis.empty()) qgs = qgis_project_xml(project_of(data, o.qgis, folder), qgis_template(o));
  tool.write_text(o.out, report_page(data, {shipped_data("page.html"), shipped_data("report.css"),
                                            shipped_data("viewer.js"), shipped_data("profile.js"),
                                            shipped_data("maps.js")}));
  if (!o.qgis.empty())
    tool.write_text(o.qgis, zip_archive({{fs::path(o.qgis).stem().string() + ".qgs", qgs}}));
  Json result = {{"run_id", data.run_id},
                 {"report", o.out},
                 {"qgis", o.qgis},
                 {"n_runs", data.runs.size()},
                 {"n_maps", data.maps.size()},
                 {"n_steps", data.steps.size()}};
  add_faults(result, data.faults);
  tool.result(result, "report of " + counted(static_cast<std::int64_t>(data.runs.size()), "run") +
                          " in " + o.out + (o.qgis.empty() ? "" : ", QGIS project in " + o.qgis));
}

}  // namespace

int main(int argc, char** argv) {
  Options o;
  Tool tool("talus-report", "The results of a site as one HTML file and as a QGIS project.");
  SiteOptions site(tool);
  tool.option("--dir", o.dir, "folder with the results of the site").required();
  tool.output("-o,--out", o.out, "report to write (HTML, one file)").required();
  const ToolOption qgis =
      tool.output("--qgis", o.qgis, "project to write (QGZ), with paths relative to it");
  tool.input("--qgis-template", o.qgis_template,
             "project (QGS or QGZ) saved by QGIS 3.22 or later, whose layouts and settings the "
             "project takes in place of the shipped ones: share/talus/report/project.qgs")
      .needs(qgis);
  tool.option("--texts", o.texts,
              "language of the page (en, de, fr, it), or a file (TOML) with words in place "
              "of those shipped, all or some: share/talus/report/texts.toml has all");
  tool.footer(
      "Example:\n  talus-report site.toml --dir out -o out/report.html --qgis out/site.qgz");
  return tool.run(argc, argv, [&] { run_tool(tool, o, site.load()); });
}
