// tools/hazard/talus_hazard.cpp
// Frequencies, return periods and hazard classes from runs. Page: docs/tools/talus-hazard.md
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/memory.hpp"
#include "base/text.hpp"
#include "post/hazard/risk.hpp"
#include "setup/section_state_gdal.hpp"
#include "tools/frame/build_info.hpp"
#include "tools/frame/command_line.hpp"
#include "tools/frame/fault_json.hpp"
#include "tools/frame/filing_keys.hpp"
#include "tools/frame/hazard_recipe.hpp"
#include "tools/frame/map_output.hpp"
#include "tools/frame/tool.hpp"
#include "tools/hazard/filing.hpp"
#include "tools/hazard/inputs.hpp"
#include "tools/hazard/layers.hpp"

namespace {

using namespace talus;  // NOLINT: a program of its own
namespace fs = std::filesystem;

struct Options {
  std::string folder, json;
  PageOptions pages;
  const Tool* tool = nullptr;

  // Rows that may be held: a list that grows holds up to three times its content.
  [[nodiscard]] std::uint64_t most_rows() const {
    constexpr double usual_mb = 600;
    const double memory_mb = tool->memory_mb() > 0 ? tool->memory_mb() : usual_mb;
    return static_cast<std::uint64_t>(memory_mb * 1e6 / (3 * sizeof(EventRow)));
  }
};

void declare(Tool& tool, Options& o) {
  tool.output_folder("-o,--out", o.folder, "folder for the maps").required();
  add_pages_option(tool, o.pages);
  tool.json_output(o.json);
  o.tool = &tool;
  tool.footer(
      "Example:\n  talus-hazard site.toml run_1.h5 run_2.h5 --trn bed.tif -o hazard --pages png\n"
      "  talus-hazard site.toml runs --trn bed.tif -o hazard");
}

std::string short_hash(const std::string& sha256) { return sha256.substr(0, 12); }

std::string recipe_words(const Recipe& recipe) {
  const std::string split = recipe.side == 0 ? ", split a" : ", split b";
  return "recipe: " + recipe.name + ", " + recipe.edition + (recipe.has_sides ? split : "") +
         ", mark " + mark_words(recipe) + ", sha256 " + short_hash(recipe.sha256);
}

std::string frequency_words(const HazardSources& sources) {
  std::string out;
  for (const HazardRuns& runs : sources.classes)
    out += (out.empty() ? "" : "; ") + runs.kind.name + ": " + rate_words(runs.kind);
  return out;
}

std::string elsewhere_words(double rate) {
  if (!(rate > 0)) return "of places that no run reached these runs say nothing";
  return "places that no run reached: an event at most once in " + text(1 / rate, 3) +
         " years (95 %)";
}

std::string run_words(const HazardRuns& runs) {
  return counted(runs.n, "run") + (runs.basis.clusters.kind == Clusters::Kind::run
                                       ? ""
                                       : " (intervals over " + text(runs.basis.clusters) + ")");
}

std::string run_words(const HazardSources& sources) {
  std::string out;
  for (const HazardRuns& runs : sources.classes)
    out += (out.empty() ? "" : ", ") + counted(runs.n, "run") + " of class " + runs.kind.name;
  return out;
}

bool is_of_rocks(const HazardSources& sources) {
  return std::any_of(sources.classes.begin(), sources.classes.end(),
                     [](const HazardRuns& runs) { return runs.kind.of_rocks; });
}

// What a rock may hit, of which its frequency is.
std::string width_words(const Recipe& recipe, double cell_size) {
  if (recipe.width > 0)
    return "rocks one by one hit what is " + text(recipe.width, 3) + " m wide across their paths";
  return "rocks one by one hit cells of " + text(cell_size, 3) + " m, larger ones more often";
}

// Notes of every map below its picture, and in its tags.
std::vector<std::string> notes_of(const Site& site, const HazardSources& sources,
                                  double cell_size) {
  std::vector<std::string> notes{site.info.name + "; talus " + build_version};
  for (const HazardRuns& runs : sources.classes)
    notes.push_back("class " + runs.kind.name + ": " + run_words(runs) +
                    (sources.has_frequencies ? ", " + rate_words(runs.kind) : ""));
  if (is_of_rocks(sources)) notes.push_back(width_words(sources.recipe, cell_size));
  if (!sources.has_frequencies) return notes;
  notes.push_back(elsewhere_words(largest_rate_elsewhere(sources.classes)));
  notes.push_back(recipe_words(sources.recipe));
  return notes;
}

MapTags tags_of(Tool& tool, RunInputs& runs, const HazardSources& sources,
                const std::string& remark) {
  MapTags tags = talus::tags_of(runs.members, runs.left_out);
  std::vector<std::string> ids;
  for (const RunMember& member : runs.members) ids.push_back(member.info.run_id);
  tags.insert(tags.begin(), {{"RUN_ID", tool.run_id()}, {"RUN_SET", run_set_id(std::move(ids))}});
  if (!remark.empty()) tags.emplace_back("REMARK", remark);
  if (runs.n_missing > 0) tags.emplace_back("N_MISSING", std::to_string(runs.n_missing));
  if (is_of_rocks(sources))
    tags.emplace_back("WIDTH_HIT", sources.recipe.width > 0
                                       ? text(sources.recipe.width, 3) + " m across the path"
                                       : "a cell");
  if (!sources.has_frequencies) {
    tags.emplace_back("FREQUENCIES", "none are given");
    return tags;
  }
  const Recipe& recipe = sources.recipe;
  tags.emplace_back("RECIPE", recipe.name);
  tags.emplace_back("RECIPE_EDITION", recipe.edition);
  tags.emplace_back("RECIPE_SOURCE", source_words(recipe));
  tags.emplace_back("RECIPE_MARK", mark_words(recipe));
  tags.emplace_back("RECIPE_SHA256", recipe.sha256);
  if (recipe.has_sides) tags.emplace_back("SPLIT", recipe.side == 0 ? "a" : "b");
  tags.emplace_back("MODE", is_localized(sources) ? "localized" : "diffuse");
  tags.emplace_back("FREQUENCIES", frequency_words(sources));
  const double elsewhere = largest_rate_elsewhere(sources.classes);
  if (!std::isnan(elsewhere))
    tags.emplace_back("FREQUENCY_UPPER_BOUND_ELSEWHERE", text(elsewhere, 6) + " 1/a");
  return tags;
}

const MapLayer* layer_named(const std::vector<MapLayer>& layers, const std::string& name) {
  const auto at = std::find_if(layers.begin(), layers.end(),
                               [&](const MapLayer& layer) { return layer.name == name; });
  return at == layers.end() ? nullptr : &*at;
}

Json class_areas(const MapLayer& layer, const MapLayer& certainty, const Recipe& recipe,
                 double cell_size) {
  Json out = Json::array();
  for (const RecipeClass& c : recipe.classes) {
    double n = 0, n_certain = 0;
    for (std::size_t i = 0; i < layer.cell.size(); ++i)
      if (layer.bands[0].value[i] == static_cast<float>(c.code)) {
        ++n;
        n_certain += certainty.bands[0].value[i] == 1 ? 1 : 0;
      }
    const double area = cell_size * cell_size;
    out.push_back({{"class", c.name},
                   {"code", c.code},
                   {"label", c.label},
                   {"hatched", c.is_hatched},
                   {"area_m2", n * area},
                   {"certain_area_m2", n_certain * area}});
  }
  return out;
}

Json rate_json(const HazardClass& kind) {
  Json out = {{"class", kind.name}, {"event", kind.of_rocks ? "rock" : "run"}};
  if (kind.kind == FrequencyKind::of_failure) {
    out["failure_probability"] = kind.probability;
    out["in_years"] = kind.years;
    return out;
  }
  if (kind.kind == FrequencyKind::of_weights) out["by_weights"] = true;
  out["frequency_per_a"] = kind.frequency.value;
  out["low_per_a"] = kind.frequency.low;
  out["high_per_a"] = kind.frequency.high;
  return out;
}

// What a class needs more of for narrower bounds; all kinds where classes differ.
std::string units_of(const HazardSources& sources) {
  using Kind = Clusters::Kind;
  const auto kind_of = [](const HazardRuns& runs) { return runs.basis.clusters.kind; };
  const Kind first = kind_of(sources.classes.front());
  for (const HazardRuns& runs : sources.classes)
    if (kind_of(runs) != first) return "runs, rock masses or release cells";
  if (first == Kind::run) return "runs";
  return first == Kind::rock_mass ? "rock masses" : "release cells";
}

// The longest return period of the recipe that places which no run reached may still have.
void warn_of_elsewhere(Tool& tool, const HazardSources& sources) {
  const double rate = largest_rate_elsewhere(sources.classes);
  const std::vector<double>& periods = sources.recipe.return_periods;
  if (std::isnan(rate)) {
    tool.warn("a class has fewer than 10 " + units_of(sources) +
              ": its rates have no bounds, and no class is certain");
    return;
  }
  if (periods.empty() || rate * periods.back() < 1) return;
  tool.warn("places that no run reached may be reached once in " + text(1 / rate, 3) +
            " years, which is within the " + period_name(periods.back()) +
            " years of the recipe; more " + units_of(sources) + " are needed to call them free");
}

// Remark, tags and notes of all files of a result.
struct Marks {
  std::string remark;
  MapTags tags;
  std::vector<std::string> notes;
};

// The maps of all layers; their entries in the result.
Json write_layers(Tool& tool, const Options& o, const MapFrame& frame, const Recipe& recipe,
                  const std::vector<MapLayer>& layers, const Marks& marks) {
  const MapLayer* const certainty = layer_named(layers, certainty_layer);
  Json written = Json::array();
  for (const MapLayer& layer : layers) {
    const std::string path = (fs::path(o.folder) / (layer.name + ".tif")).string();
    const std::string shown =
        write_map(tool, frame, path, layer, hazard_style(layer, recipe, marks.remark, marks.notes),
                  marks.tags, layer.name == "class" ? certainty : nullptr);
    Json bands = Json::array();
    for (const MapBand& band : layer.bands) bands.push_back(band.name);
    written.push_back({{"file", path}, {"shown_band", shown}, {"bands", bands}});
  }
  return written;
}

std::string area_lines(const Json& classes) {
  std::string lines;
  for (const Json& area : classes)
    lines += "\n" + area["class"].get<std::string>() + " (" + area["label"].get<std::string>() +
             "): " + text(area["area_m2"].get<double>() / 1e4, 4) + " ha, " +
             text(area["certain_area_m2"].get<double>() / 1e4, 4) + " ha of it certain";
  return lines;
}

// Polygons and areas of the classes, and what is filed; the lines of the summary.
std::string write_classes(Tool& tool, const Options& o, const Site& site, const Vec3& origin,
                          const HazardSources& sources, const std::vector<MapLayer>& layers,
                          const MapFrame& frame, const Marks& marks, Json& result) {
  const MapLayer& of_class = *layer_named(layers, "class");
  const MapLayer& certainty = *layer_named(layers, certainty_layer);
  std::vector<VectorLayer> polygons =
      hazard_polygons(of_class, certainty, frame.grid, origin, sources.recipe, marks.notes);
  mark_layers(polygons, marks.remark);
  write_geopackage(tool.stage((fs::path(o.folder) / "hazard.gpkg").string()), frame.crs_wkt,
                   polygons, marks.tags);
  result["classes"] = class_areas(of_class, certainty, sources.recipe, frame.grid.cell_size);
  Json rates = Json::array();
  for (const HazardRuns& of : sources.classes) rates.push_back(rate_json(of.kind));
  result["frequencies"] = rates;
  result["rate_elsewhere_per_a"] = number_or_null(largest_rate_elsewhere(sources.classes));
  const std::string areas = area_lines(result["classes"]);
  if (!is_filed(site)) return areas;
  const std::string path = (fs::path(o.folder) / "filing.gpkg").string();
  Filing filing = filing_of(site, sources, layers, frame.grid, frame.known, origin, path);
  mark_layers(filing.layers, marks.remark);
  write_geopackage(tool.stage(path), frame.crs_wkt, filing.layers, marks.tags);
  result["filing"] = filing.result;
  return areas + filing.words;
}

std::string no_classes_words(const Site& site, const HazardSources& sources) {
  if (sources.has_frequencies)
    return "recipe " + sources.recipe.name +
           " is of risk: cells have no class, objects have one (talus-trace)";
  return "no frequency is given: classes, return periods and frequencies are not written; give "
         "[hazard.class.NAME] frequency_per_a, events with observed_a, or failure_probability "
         "with in_years in " +
         site.file;
}

void run_tool(Tool& tool, Options& o, SiteOptions& site_options, RunInputs& runs) {
  limit_memory(0);  // --memory-mb is for rows alone; the rest needs the free memory
  const Site& site = site_options.load();
  const std::vector<HazardClass> classes = hazard_classes(site);
  const Recipe recipe = read_recipe(tool, site);
  check_exposure(site, recipe, classes);
  const Trn& trn = runs.trn();
  check_filing(site, recipe, trn.crs_wkt);
  HazardInputs inputs = read_hazard_inputs(runs, classes, recipe, o.most_rows());
  const std::vector<MapLayer> layers = read_hazard_layers(runs, inputs, o.most_rows());
  const HazardSources& sources = inputs.sources;
  if (inputs.n_rows == 0) tool.warn("no block passed any cell: the maps are empty");
  runs.warn_of_ends();
  if (sources.has_frequencies)
    warn_of_elsewhere(tool, sources);
  else
    tool.warn(no_classes_words(site, sources));
  const std::string remark = runs.remark();
  const PassageGrid& grid = inputs.map.grid;
  const Marks marks{remark, tags_of(tool, runs, sources, remark),
                    notes_of(site, sources, grid.cell_size)};
  const MapFrame frame = map_frame(runs, grid, o.pages, layers[0].cell);
  Json result = {{"run_id", tool.run_id()},
                 {"tags", Json::object()},
                 {"sections", section_state(site, {"hazard"})},
                 {"n_runs", runs.members.size()},
                 {"n_cells_touched", layers[0].cell.size()},
                 {"cell_size_m", grid.cell_size},
                 {"layers", write_layers(tool, o, frame, recipe, layers, marks)}};
  for (const auto& [key, value] : marks.tags) result["tags"][key] = value;
  std::string summary =
      std::to_string(layers.size()) + " maps of " + run_words(sources) + " in " + o.folder;
  result["notes"] = marks.notes;
  if (layer_named(layers, "class")) {
    summary += write_classes(tool, o, site, trn.origin, sources, layers, frame, marks, result);
  } else {
    result["classes"] = nullptr;
    result["why_no_classes"] = no_classes_words(site, sources);
    if (sources.has_frequencies) summary += "\n" + no_classes_words(site, sources);
  }
  add_faults(result, faults_of(runs.members, runs.left_out));
  tool.metric("passages", static_cast<double>(inputs.n_rows), "1");
  tool.result(result, summary);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  Tool tool("talus-hazard", "Frequencies, return periods and hazard classes from runs.");
  SiteOptions site(tool);
  RunInputs runs(tool);
  declare(tool, options);
  return tool.run(argc, argv, [&] { run_tool(tool, options, site, runs); });
}
