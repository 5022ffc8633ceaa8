// tools/trace/talus_trace.cpp
// Which source hits which object. Page: docs/tools/talus-trace.md
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <optional>

#include "base/file_paths.hpp"
#include "base/grouped_text.hpp"
#include "base/numbers.hpp"
#include "base/text.hpp"
#include "base/words.hpp"
#include "post/hazard/hazard_rates.hpp"
#include "post/paired.hpp"
#include "post/reduce.hpp"
#include "setup/section_state_gdal.hpp"
#include "setup/site_places_gdal.hpp"
#include "tools/frame/command_line.hpp"
#include "tools/frame/fault_json.hpp"
#include "tools/frame/hazard_recipe.hpp"
#include "tools/frame/map_output.hpp"
#include "tools/frame/object_files.hpp"
#include "tools/frame/site_options.hpp"
#include "tools/frame/tool.hpp"
#include "tools/trace/layers.hpp"

namespace {

using namespace talus;  // NOLINT: a program of its own
namespace fs = std::filesystem;

struct Options {
  std::string out, csv, json, rasters;
  std::vector<std::string> compared;
  double source_cell_m = no_value;
  bool by_cells = false;
  PageOptions pages;
};

void declare(Tool& tool, Options& o) {
  tool.output("-o,--out", o.out, "objects, source cells and links (GeoPackage)").required();
  tool.output("--csv", o.csv, "one row a source cell and object (CSV)");
  tool.json_output(o.json);
  tool.output_folder("--rasters", o.rasters, "folder for a raster of source cells an object");
  add_pages_option(tool, o.pages);
  tool.option("--source-cell-m", o.source_cell_m,
              "cells that blocks are put together by where they were released [m]; nan: the "
              "terrain's")
      .check(number_between(1e-3, 1e6, true));
  tool.inputs("--compare", o.compared,
              "runs of the same seeds, or their folder: what the others have more at each object");
  tool.flag("--by-cells", o.by_cells,
            "count passages of cells also where runs watched the objects themselves");
  tool.footer(
      "Example:\n  talus-trace site.toml run_1.h5 run_2.h5 --trn bed.tif -o trace.gpkg --csv "
      "links.csv --rasters sources");
}

/// Data that are read, class by class.
struct Traced {
  TraceSums sums;
  std::vector<HazardRuns> classes;
};

const RunParts wanted{.crossings = false,
                      .checkpoint = false,
                      .only_last_frame = true,
                      .only_faults = true,
                      .words = false,
                      .trees = false};

// Whether cells are needed for objects that the run did not watch; then it must have them.
bool needs_cells(const RunFile& run, const TraceSums& sums, const Options& o,
                 const RunMember& member) {
  for (const RecordObject& object : sums.objects) {
    if (!o.by_cells && watched_as(run, object) >= 0) continue;
    if (run.grid.n_rows > 0) return true;
    throw InputError({where_of(member)},
                     "did not watch object " + object.name + ", and holds no passages",
                     "run talus-dda again with the site file as it is, or with [output] passages "
                     "= true");
  }
  return false;
}

// Hits by cells of the runs of parts from `first_part` on; `first_run`: the member that sums begin
// with.
void add_hits_of_parts(const RunInputs& runs, std::size_t first_part, int first_run,
                       const ObjectCells& cells, const Options& o, TraceSums& sums) {
  constexpr std::uint64_t most_rows = 1'000'000;
  for (std::size_t p = first_part; p < runs.parts().size(); ++p) {
    const PartInput& part = runs.parts()[p];
    std::vector<CellHits> hits(part.member.size());
    for_each_strip(part.file, 1, {}, most_rows, [&](const auto& by_run) {
      for (std::size_t r = 0; r < by_run.size(); ++r)
        if (part.member[r] >= 0) add_cell_hits(hits[r], cells, by_run[r], part.file.part.grid);
    });
    for (std::size_t r = 0; r < hits.size(); ++r)
      if (part.member[r] >= 0)
        add_hits(sums, run_of(part.file.part, static_cast<int>(r)), part.member[r] - first_run,
                 hits[r], o.by_cells);
  }
}

// Adds the runs of a set to sums that begin with the member `first_run`. Returns whether cells were
// asked that centroids alone had passed.
bool add_set(RunInputs& runs, const RunSet& set, const std::string& role, RunSettings settings,
             int first_run, const Options& o, TraceSums& sums) {
  const std::size_t first_part = runs.parts().size();
  ObjectCells cells;
  bool by_centroid = false;
  runs.read(
      set, role, wanted,
      [&](RunFile& run, int index) {
        const bool needs = needs_cells(run, sums, o, runs.members[static_cast<std::size_t>(index)]);
        if (needs && cells.empty()) cells = object_cells(run.grid, as_watched(run, sums.objects));
        by_centroid = by_centroid || (needs && run.passages_by_centroid);
        add_run(sums, run, runs.rest_speed_m_s, o.by_cells);
        if (needs) {
          CellHits hits;
          add_cell_hits(hits, cells, run.passages, run.grid);
          add_hits(sums, run, index - first_run, hits, o.by_cells);
        }
      },
      settings);
  if (!cells.empty()) add_hits_of_parts(runs, first_part, first_run, cells, o, sums);
  return by_centroid;
}

Traced trace(Tool& tool, const Site& site, RunInputs& runs, const Options& o,
             const std::vector<HazardClass>& classes) {
  const Trn& trn = runs.trn();
  Traced out;
  out.sums.objects = site_objects(tool, site, trn);
  if (out.sums.objects.empty())
    throw InputError({site.file}, "has no section [object.*]",
                     "add one with its polygon, line or position_m, or a file with them");
  out.sums.sources = passage_grid(trn, o.source_cell_m);
  bool by_centroid = false;
  for (const RunSet& set : runs.of_classes(classes)) {
    const HazardClass kind = class_at(classes, out.classes.size());
    const int first = static_cast<int>(runs.members.size());
    by_centroid |=
        add_set(runs, set, "class." + kind.name, RunSettings::of_their_own, 0, o, out.sums);
    out.classes.push_back(hazard_runs(kind, runs.members, first, runs.last_failed_share()));
  }
  finish(out.sums);
  if (by_centroid)
    tool.warn(
        "cells were passed by centroids alone (--passages-by centroid): blocks that touch an "
        "object with their side may be missed");
  return out;
}

// --- compared with the site as it is -----------------------------------------------------------

struct Compared {
  const Site& site;  // its exposure is that of its own objects, as are its frequency and its recipe
  Recipe recipe;
  TraceSums sums;
  RunPairs pairs;
  std::optional<HazardRuns> kind;  // the one class, where its rates can be compared
};

const ObjectSettings* object_named(const Site& site, const std::string& name) {
  const auto at = std::find_if(site.objects.begin(), site.objects.end(),
                               [&name](const ObjectSettings& of) { return of.name == name; });
  return at == site.objects.end() ? nullptr : &*at;
}

// The objects of a measure as the site has them, which may have been elsewhere; one that it lacks
// as the measure has it.
std::vector<RecordObject> objects_as_they_are(Tool& tool, const Site& site, const Trn& trn,
                                              std::vector<RecordObject> objects) {
  for (const RecordObject& known : site_objects(tool, site, trn))
    for (RecordObject& object : objects)
      if (object.name == known.name) object = known;
  return objects;
}

// The runs of --compare, which are of the same seeds, by the site without --variant.
Compared compared_with(Tool& tool, RunInputs& runs, const Traced& traced, const Options& o,
                       const Site& measure, const Site& site) {
  const TraceSums& sums = traced.sums;
  Compared out{site, read_recipe(tool, site), {}, {}, {}};
  out.sums.objects = sums.objects;
  out.sums.sources = sums.sources;
  const std::vector<std::string> evaluated = {"object", "hazard"};
  const std::string state = section_state(site, evaluated);
  if (state != section_state(measure, evaluated))
    out.sums.objects = objects_as_they_are(tool, site, runs.trn(), sums.objects);
  tool.content_read("site_compared", state);
  RunSet set = runs.set_of(o.compared, "compare");
  weigh_as_classes(set, traced.classes.size());
  const std::vector<RunMember> variant = runs.members;
  const auto n = static_cast<int>(variant.size());
  static_cast<void>(
      add_set(runs, set, "runs_compared", RunSettings::on_another_ground, n, o, out.sums));
  finish(out.sums);
  out.pairs = pairs_of(std::span(runs.members).subspan(variant.size()), variant);
  if (out.pairs.n_runs == 0)
    throw InputError({o.compared[0]}, "has no run of the same seed as " + where_of(variant[0]),
                     "compute both with the same RUNS and SEED");
  const std::vector<HazardClass> classes = hazard_classes(site);
  if (classes.size() != 1 || hazard_classes(measure).size() != 1 || !adds_up(traced.classes[0]))
    return out;
  HazardRuns kind = hazard_runs(classes[0], runs.members, n, runs.last_failed_share());
  kind.first = 0;  // as out.sums counts its runs
  if (adds_up(kind) && kind.n == out.pairs.n_runs && traced.classes[0].n == out.pairs.n_runs)
    out.kind = std::move(kind);
  return out;
}

Json json_of(const PairedDifference& d) {
  return {{"site", d.site},
          {"variant", d.variant},
          {"difference", d.value},
          {"interval", {number_or_null(d.interval.low), number_or_null(d.interval.high)}}};
}

// Hits of an object as events, with the intensity that the recipe's breaks divide.
std::vector<EventRow> event_rows_at(const TraceSums& sums, const Recipe& recipe, int object) {
  std::vector<EventRow> rows;
  for (const TraceHit& hit : hits_of(sums, object)) {
    const auto energy = static_cast<float>(hit.energy / 1e3);
    const bool by_volume = recipe.by == IntensityBy::block_volume;
    rows.push_back({0, hit.run, hit.block, energy,
                    by_volume ? static_cast<float>(hit.volume) : energy, hit.weight});
  }
  sort_events(rows);
  return rows;
}

Json compared_json(const Compared& compared, const Traced& traced, const Site& measure,
                   const Recipe& recipe, int object) {
  const auto amounts = [object](const TraceSums& of, bool energy) {
    std::vector<BlockWeight> out;
    for (const TraceHit& hit : hits_of(of, object))
      out.push_back({hit.run, hit.block, hit.run_weight * (energy ? hit.energy / 1e3 : 1)});
    return out;
  };
  const auto difference = [&](bool energy) {
    return json_of(paired_difference(compared.pairs, amounts(compared.sums, energy),
                                     amounts(traced.sums, energy)));
  };
  Json out = {{"n_runs", compared.pairs.n_runs},
              {"n_pairs", compared.pairs.n_pairs},
              {"hits_a_run", difference(false)},
              {"energy_a_run_kj", difference(true)}};
  if (!compared.kind) return out;
  using Value = std::function<double(float)>;
  const auto rates = [&](const Value& of_site, const Value& of_measure, const AmountCurve& curve) {
    return json_of(paired_difference(
        compared.pairs,
        rate_amounts(*compared.kind, event_rows_at(compared.sums, compared.recipe, object),
                     of_site),
        rate_amounts(traced.classes[0], event_rows_at(traced.sums, recipe, object), of_measure),
        curve));
  };
  const Value once = [](float) { return 1.0; };
  out["frequency_per_a"] = rates(once, once, {});
  const ObjectSettings& now = measure.objects[static_cast<std::size_t>(object)];
  const ObjectSettings* before = object_named(compared.site, now.name);
  if (before && is_of_risk(recipe) && is_of_risk(compared.recipe))
    out["risk_per_a"] =
        rates([&](float intensity) { return death_by(compared.recipe, *before, intensity); },
              [&](float intensity) { return death_by(recipe, now, intensity); }, risk_curve);
  return out;
}

// Events a year at an object, as talus-hazard counts them; by a recipe of risk the risk for
// those who are there, by the intensity at the first touch.
void put_rate(const Traced& traced, const Site& site, const Recipe& recipe, int object,
              TracedObject& to) {
  HazardRates at(traced.classes);
  const std::vector<Rate> rates =
      at.above(event_rows_at(traced.sums, recipe, object), recipe.breaks);
  to.rate = rates[0].value;
  to.rate_low = rates[0].low;
  to.rate_high = rates[0].high;
  if (is_of_risk(recipe))
    to.risk = risk_of(recipe, site.objects[static_cast<std::size_t>(object)], rates);
}

Json sources_json(const Traced& traced, int object, const std::vector<SourceLink>& links,
                  const Vec3& origin) {
  constexpr std::size_t most = 5;
  Json out = Json::array();
  for (const SourceLink& link : links) {
    if (link.object != object || out.size() == most) continue;
    const Vec2 at = place_of_source(traced.sums, link.source) + origin.head<2>();
    out.push_back({{"source_cell", link.source},
                   {"x_m", at.x()},
                   {"y_m", at.y()},
                   {"n_hits", link.n_hits},
                   {"p_hit", link.p_hit},
                   {"share_of_hits", link.share_of_hits},
                   {"ke_p95_kj", number_or_null(link.energy_p95)}});
  }
  return out;
}

Json risk_json(const ObjectRisk& risk, const RecipeClass& of) {
  return {{"individual_per_a",
           {risk.individual.value, number_or_null(risk.individual.low),
            number_or_null(risk.individual.high)}},
          {"deaths_per_a", risk.deaths},
          {"class", of.name},
          {"code", of.code},
          {"label", of.label},
          {"certain", risk.is_certain}};
}

Json object_json(const RecordObject& object, const TracedObject& traced, const Recipe& recipe,
                 bool has_rate) {
  const ObjectTrace& t = traced.trace;
  Json out = {
      {"name", object.name},
      {"kind", object.kind},
      {"method", t.method},
      {"n_runs_hit", t.n_runs_hit},
      {"n_hits", t.n_hits},
      {"run_share", t.run_share},
      {"run_share_interval",
       {number_or_null(t.run_share_interval.low), number_or_null(t.run_share_interval.high)}},
      {"hits_a_run", t.hits_a_run},
      {"block_share", t.weight_share},
      {"block_share_interval",
       {number_or_null(t.weight_share_interval.low), number_or_null(t.weight_share_interval.high)}},
      {"volume_share", t.volume_share},
      {"ke_p50_kj", number_or_null(t.energy.p50)},
      {"ke_p95_kj", number_or_null(t.energy.p95)},
      {"ke_p95_hi_kj", number_or_null(t.energy.p95_high)},
      {"ke_max_kj", number_or_null(t.energy.largest)},
      {"top_height_p95_m", number_or_null(t.top_height_p95)},
      {"first_arrival_s", number_or_null(t.first_arrival)},
      {"deposited_m3_a_run", t.deposited_a_run},
      {"n_sources_50_90_100", t.n_sources}};
  if (has_rate)
    out["frequency_per_a"] = {number_or_null(traced.rate), number_or_null(traced.rate_low),
                              number_or_null(traced.rate_high)};
  if (traced.risk) out["risk"] = risk_json(*traced.risk, recipe.classes[traced.risk->kind]);
  return out;
}

// Sums that must agree, and do.
Json conservation(const Traced& traced, const std::vector<SourceLink>& links) {
  const TraceSums& sums = traced.sums;
  Json objects = Json::array();
  for (std::size_t o = 0; o < sums.objects.size(); ++o) {
    double share = 0;
    int n = 0;
    for (const SourceLink& link : links)
      if (link.object == static_cast<int>(o)) {
        share += link.share_of_hits;
        n += link.n_hits;
      }
    objects.push_back(
        {{"object", sums.objects[o].name}, {"hits_from_sources", n}, {"sum_of_shares", share}});
  }
  double n_released = 0, n_none = 0;
  for (const auto& [cell, source] : sums.source) {
    n_released += source.n;
    n_none += source.n_none;
  }
  return {{"objects", objects},
          {"n_released", n_released},
          {"n_hit_none", n_none},
          {"n_hits_and_none", static_cast<double>(sums.hits.size()) + n_none}};
}

std::string summary_of(const std::string& name, const TracedObject& o, const Recipe& recipe,
                       bool has_rate, int n, bool rocks_alone) {
  const ObjectTrace& t = o.trace;
  const Interval& interval = rocks_alone ? t.weight_share_interval : t.run_share_interval;
  std::string out = name + ": ";
  out += rocks_alone ? "hit by " + percent(t.weight_share) + " of the rocks"
                     : "hit in " + std::to_string(t.n_runs_hit) + " of " + counted(n, "run");
  if (!std::isnan(interval.high))
    out += " (95 %: " + text(interval.low, 3) + " - " + text(interval.high, 3) + ")";
  if (has_rate && o.rate > 0) out += ", once in " + text(1 / o.rate, 3) + " years";
  if (o.risk) {
    const Rate& risk = o.risk->individual;
    out += ", annual individual risk " + text(risk.value, 2);
    if (!std::isnan(risk.high)) out += " (" + text(risk.low, 2) + " - " + text(risk.high, 2) + ")";
    out += ": " + recipe.classes[o.risk->kind].label;
    if (!o.risk->is_certain) out += " (another class at a bound)";
  }
  if (t.n_hits == 0) return out;
  out += ", " + counted(t.n_hits, "block") + ", up to " + grouped_text(t.energy.largest, 3) + " kJ";
  return out + "; half of them from " + std::to_string(t.n_sources[0]) + " of " +
         std::to_string(t.n_sources[2]) + " source cells";
}

MapTags tags_of(Tool& tool, const std::vector<RunMember>& members,
                const std::vector<RunMember>& left_out, const Recipe& recipe,
                const std::string& remark) {
  MapTags tags = talus::tags_of(members, left_out);
  std::vector<std::string> ids;
  for (const RunMember& member : members) ids.push_back(member.info.run_id);
  tags.insert(tags.begin(), {{"RUN_ID", tool.run_id()}, {"RUN_SET", run_set_id(std::move(ids))}});
  if (!remark.empty()) tags.emplace_back("REMARK", remark);
  if (is_of_risk(recipe)) {
    tags.emplace_back("RECIPE", recipe.name + ", " + recipe.edition);
    tags.emplace_back("RECIPE_SOURCE", source_words(recipe));
    tags.emplace_back("RECIPE_SHA256", recipe.sha256);
  }
  return tags;
}

void warn_of_method(Tool& tool, const RecordObject& of, const std::string& method) {
  if (method == "recorded") return;
  tool.warn("object " + of.name + " was not watched by " +
            (method == "both" ? "some of the runs" : "the runs") +
            ": its hits are counted by the cells that it lies in, none too few and some too many, "
            "with the largest energy over these cells");
}

// One map per object, of the sources that reach it. Its page shows that object alone: a thousand
// others would hide its sources, and be drawn a thousand times.
void write_source_maps(Tool& tool, const Options& o, RunInputs& runs, const TraceSums& sums,
                       const std::vector<SourceLink>& links, const std::string& remark,
                       const MapTags& tags) {
  std::vector<std::uint32_t> touched;
  for (const auto& [cell, source] : sums.source) touched.push_back(cell);
  MapFrame frame = map_frame(runs, sums.sources, o.pages, touched);
  for (int i = 0; i < static_cast<int>(sums.objects.size()); ++i) {
    const RecordObject& object = sums.objects[static_cast<std::size_t>(i)];
    const MapLayer layer = source_layer(sums, i, links);
    frame.places.objects = {object};
    write_map(tool, frame, (fs::path(o.rasters) / (layer.name + ".tif")).string(), layer,
              source_style(object.name, remark), tags);
  }
}

void run_tool(Tool& tool, Options& o, SiteOptions& site_options, RunInputs& runs) {
  const Site& site = site_options.load();
  if (!o.rasters.empty()) check_object_files(site);
  const std::vector<HazardClass> classes = hazard_classes(site);
  const Recipe recipe = read_recipe(tool, site);
  check_exposure(site, recipe, classes);
  if (const std::string words = unused_exposure(site, recipe); !words.empty()) tool.warn(words);
  const Traced traced = trace(tool, site, runs, o, classes);
  const TraceSums& sums = traced.sums;
  const Trn& trn = runs.trn();
  runs.warn_of_ends();
  const std::string remark = runs.remark();
  const std::vector<RunMember> members = runs.members, left_out = runs.left_out;
  std::optional<Compared> compared;
  if (!o.compared.empty())
    compared.emplace(compared_with(tool, runs, traced, o, site, site_options.as_it_is()));
  const std::vector<SourceLink> links = source_links(sums);
  const ShareBasis basis = share_basis(clusters_of(members), runs.failed_share());
  std::vector<TracedObject> objects;
  Json list = Json::array();
  std::string summary;
  const bool rocks_alone = !members.empty() && members.front().info.independent;
  for (int i = 0; i < static_cast<int>(sums.objects.size()); ++i) {
    TracedObject object{object_trace(sums, i, basis, links), no_value, no_value, no_value, {}};
    if (!classes.empty()) put_rate(traced, site, recipe, i, object);
    const RecordObject& of = sums.objects[static_cast<std::size_t>(i)];
    warn_of_method(tool, of, object.trace.method);
    list.push_back(object_json(of, object, recipe, !classes.empty()));
    list.back()["sources"] = sources_json(traced, i, links, trn.origin);
    if (compared) list.back()["compared"] = compared_json(*compared, traced, site, recipe, i);
    summary += (i > 0 ? "\n" : "") +
               summary_of(of.name, object, recipe, !classes.empty(), sums.n_runs, rocks_alone);
    objects.push_back(std::move(object));
  }
  const MapTags tags = tags_of(tool, members, left_out, recipe, remark);
  std::vector<VectorLayer> layers = trace_layers(sums, objects, links, trn, recipe);
  mark_layers(layers, remark);
  write_geopackage(tool.stage(o.out), trn.crs_wkt, layers, tags);
  if (!o.csv.empty()) tool.write_text(o.csv, link_csv(sums, links, trn.origin));
  if (!o.rasters.empty()) write_source_maps(tool, o, runs, sums, links, remark, tags);
  Json result = {{"run_id", tool.run_id()},
                 {"tags", Json::object()},
                 {"sections", section_state(site, {"object", "hazard"})},
                 {"n_runs", sums.n_runs},
                 {"source_cell_m", sums.sources.cell_size},
                 {"n_source_cells", sums.source.size()},
                 {"objects", list},
                 {"conservation", conservation(traced, links)}};
  for (const auto& [key, value] : tags) result["tags"][key] = value;
  add_faults(result, faults_of(members, left_out));
  tool.result(result, summary);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  Tool tool("talus-trace", "Which source hits which object, how often and how hard.");
  SiteOptions site(tool);
  site.take_inputs();
  RunInputs runs(tool);
  declare(tool, options);
  return tool.run(argc, argv, [&] { run_tool(tool, options, site, runs); });
}
