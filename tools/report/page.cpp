// Values for the template of the page (page.html), section by section.
#include "tools/report/page.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <utility>

#include "base/grouped_text.hpp"
#include "base/numbers.hpp"
#include "base/text.hpp"
#include "base/units.hpp"
#include "base/words.hpp"
#include "ensemble/clusters.hpp"
#include "post/moved.hpp"
#include "post/statistics.hpp"
#include "report/encode.hpp"
#include "report/page_template.hpp"
#include "report/provenance.hpp"
#include "sampling/sensitivity.hpp"
#include "site/soils.hpp"
#include "site/uncertainty.hpp"
#include "tools/frame/row_json.hpp"
#include "tools/report/pictures.hpp"

namespace talus {

Json value_at(const Json& json, std::initializer_list<const char*> keys) {
  const Json* here = &json;
  for (const char* key : keys) {
    if (!here->is_object() || !here->contains(key)) return nullptr;
    here = &(*here)[key];
  }
  return *here;
}

std::string remark_of(const ReportData& data) { return headline(data.faults); }

std::string fence_remark_of(const ReportData& data) {
  const Json remark = value_at(data.fence, {"tags", "REMARK"});
  return remark.is_string() ? remark.get<std::string>() : remark_of(data);
}

std::vector<std::string> hazard_maps_of(const Json& hazard) {
  std::vector<std::string> names;
  const Json layers = value_at(hazard, {"layers"});
  if (!layers.is_array()) return names;
  for (const Json& layer : layers)
    if (const Json file = value_at(layer, {"file"}); file.is_string())
      names.push_back(std::filesystem::path(file.get<std::string>()).stem().string());
  std::reverse(names.begin(), names.end());  // the class first
  return names;
}

namespace {

double number_or(const Json& value, double otherwise) {
  return value.is_number() ? value.get<double>() : otherwise;
}

// The entries of a list; none where it is something else.
Json list_or_none(const Json& value) { return value.is_array() ? value : Json::array(); }

std::string shown(const Texts& texts, double value, int digits = shown_digits) {
  return texts.number(grouped_text(value, digits));
}

// A table as the part "table" of the template shows it.
template <class Row>
Json table_of_rows(const Texts& texts, const std::vector<Field<Row>>& fields,
                   const std::vector<Row>& rows) {
  Json out = {{"heads", Json::array()}, {"rows", Json::array()}};
  const auto is_number = [](const Field<Row>& field) { return field.type != FieldType::text; };
  for (const Field<Row>& field : fields)
    out["heads"].push_back(
        {{"title", field.title}, {"unit", field.unit}, {"is_number", is_number(field)}});
  for (const Row& row : rows) {
    Json cells = Json::array();
    for (const Field<Row>& field : fields) {
      const Json value = json_of(field.get(row));
      cells.push_back(
          {{"is_number", is_number(field)},
           {"text", value.is_string() ? xml_escaped(texts.said(value.get<std::string>()))
                    : value.is_number()
                        ? shown(texts, value.get<double>(), value.is_number_integer() ? 9 : 3)
                        : "&ndash;"}});
    }
    out["rows"].push_back(std::move(cells));
  }
  return out;
}

// --- result --------------------------------------------------------------------------------------

// Runs of the run-out for which `holds`.
template <class Test>
int count_runs(const Json& runout, const Test& holds) {
  const Json runs = list_or_none(value_at(runout, {"runs"}));
  return static_cast<int>(std::count_if(runs.begin(), runs.end(), holds));
}

std::string runs_text(const Texts& texts, std::int64_t n) {
  return texts.counted(n, "words.run", "words.runs");
}

// "largest of 10 runs", "largest of the 17 runs that moved", "of one run"
std::string over_runs(const Texts& texts, const Json& runout, const std::string& which) {
  const int n_all = count_runs(runout, [](const Json&) { return true; });
  const int n = count_runs(runout, [](const Json& run) {
    return value_at(run, {"event", "L_path_m"}).is_number();
  });
  if (n_all == 1) return texts.of("result.of_one_run");
  return texts.of(n < n_all ? "result.of_moved_runs" : "result.of_runs",
                  {{"which", texts.of(which)}, {"runs", runs_text(texts, n)}});
}

// "; still moving at the end in 2 runs"
std::string unsettled(const Texts& texts, const Json& runout) {
  std::string out;
  for (const auto& [fate, words] : {std::pair{"moving", "result.still_moving"},
                                    std::pair{"left_domain", "result.left_terrain"}}) {
    const int n = count_runs(
        runout, [fate = fate](const Json& run) { return value_at(run, {"toe_fate"}) == fate; });
    if (n > 0) out += texts.of(words, {{"runs", runs_text(texts, n)}});
  }
  return out;
}

// "; p95 over the runs 95.2 m" where they are enough for one.
std::string extreme_percentile(const Texts& texts, const Json& runout, const char* result,
                               const char* percentile, const char* unit) {
  const Json spread = value_at(runout, {"spread_over_runs", result});
  if (number_or(value_at(spread, {"n"}), 0) < smallest_sample(0.95)) return "";
  return texts.of("result.percentile",
                  {{"percentile", percentile},
                   {"value", shown(texts, number_or(value_at(spread, {percentile}), 0)) + unit}});
}

// Tiles of faults, and of runs that are not events.
Json trouble_of(const ReportData& data) {
  const Texts& texts = data.texts;
  Json tiles = Json::array();
  const auto tile = [&](std::int64_t n, std::int64_t n_all, const std::string& what) {
    if (n > 0)
      tiles.push_back({{"kind", "bad"},
                       {"value", texts.of("words.n_of", {{"n", std::to_string(n)},
                                                         {"all", runs_text(texts, n_all)}})},
                       {"what", what}});
  };
  const auto n_failed = std::ssize(data.faults.failed);
  tile(n_failed, data.faults.n_runs,
       texts.of(n_failed == 1 ? "result.one_failed" : "result.several_failed"));
  const int n_all = count_runs(data.runout, [](const Json&) { return true; });
  const auto n_with = [&data](bool moved, bool event) {
    return count_runs(data.runout, [&](const Json& run) {
      return value_at(run, {"did_move"}) == Json(moved) &&
             (!moved || value_at(run, {"is_event"}) == Json(event));
    });
  };
  tile(n_with(false, false), n_all, texts.of("result.did_not_move", {{"metres", text(moved_m)}}));
  tile(n_with(true, false), n_all, texts.of("result.moved_little"));
  const Json chance = value_at(data.runout, {"event_probability"});
  if (n_with(false, false) + n_with(true, false) > 0 && chance.is_number())
    tiles.push_back({{"value", texts.number(percent(chance.get<double>()))},
                     {"what", texts.of("result.events")}});
  return tiles;
}

// Speed of any block, path of the centre of mass.
Json motion_of(const Json& runout) {
  double fastest = 0, path = 0;
  int n = 0;
  for (const Json& run : list_or_none(value_at(runout, {"runs"}))) {
    fastest = std::max(fastest, number_or(value_at(run, {"max_speed_m_s"}), 0));
    const Json length = value_at(run, {"centre_of_mass", "L_path_m"});
    if (!length.is_number()) continue;
    path += length.get<double>();
    ++n;
  }
  return {{"speed_m_s", fastest}, {"centre_m", n > 0 ? Json(path / n) : Json()}};
}

// The text that says how little of the mass moved; "" where it is enough.
std::string standing_of(const Json& runout) {
  if (!(number_or(value_at(runout, {"moved", "share_moved_1_m"}), 1) < least_moved)) return "";
  const bool any = number_or(value_at(runout, {"moved", "displacement_max_m"}), 0) > moved_m;
  return any ? "half_moved" : "nothing_moved";
}

void add_result(const ReportData& data, Json& out) {
  const Texts& texts = data.texts;
  const Json& r = data.runout;
  out["trouble"] = trouble_of(data);
  out["motion"] = motion_of(r);
  if (!data.runs.empty() && data.runs.front().info.independent)
    out["motion"]["centre_m"] = nullptr;  // of blocks that fall apart from one another
  out["standing"] = !data.runs.empty() && data.runs.front().info.independent ? "" : standing_of(r);
  out["repeats"] = data.repeats;
  out["over"] = {{"largest", over_runs(texts, r, "result.largest")},
                 {"smallest", over_runs(texts, r, "result.smallest")},
                 {"mean", over_runs(texts, r, "result.mean")},
                 {"fate", unsettled(texts, r)},
                 {"p95", extreme_percentile(texts, r, "L_path_m", "p95", " m")},
                 {"p05", extreme_percentile(texts, r, "reach_angle_path_deg", "p05", "&deg;")}};
  out["left_out"] = runs_text(texts, std::ssize(list_or_none(value_at(r, {"left_out_runs"}))));
  out["faults"] = Json::array();
  for (const RunFault& fault : data.faults.failed)
    out["faults"].push_back({{"name", fault.name}, {"words", fault.words}});
}

// --- run-out -------------------------------------------------------------------------------------

// Cells of the terrain that rocks of any run start in.
std::size_t n_release_cells(const ReportData& data) {
  std::set<std::pair<double, double>> cells;
  for (const RunFile& run : data.runs)
    for (const Pose& rest : run.blocks.rest) {
      const Vec2 at = (rest.position.head<2>() - data.bed.node0) / data.bed.cell_size;
      cells.emplace(std::floor(at.x()), std::floor(at.y()));
    }
  return cells.size();
}

// Of rocks one by one without values of one mass, and of many cells without values of one source.
void set_runout(const ReportData& data, Json& out) {
  out["runout"] = data.runout;
  out["many_cells"] = 0;
  if (!data.rocks_alone) return;
  const std::size_t n_cells = n_release_cells(data);
  if (n_cells >= least_clusters) out["many_cells"] = n_cells;
  const Json all = value_at(data.runout, {"spread_over_events"});
  if (!all.is_object()) return;
  Json spread = Json::object();
  for (const auto& [name, values] : all.items())
    if (name != "H_cm_over_L_cm") spread[name] = values;
  out["runout"]["spread_over_events"] = spread;
}

// Reference for H/L of the centre of mass: tan(phi) of the ground, as the runs had it.
std::string friction_of(const ReportData& data) {
  const Texts& texts = data.texts;
  std::map<std::string, std::pair<double, double>> grounds;  // least and most friction [deg]
  for (const RunFile& run : data.runs) {
    const Site site = parse_site(run.info.config, run.info.run_id);
    if (site.solver.friction == "weakening") continue;  // does not have one tangent
    for (const GroundSettings& ground : site.grounds) {
      auto& [low, high] =
          grounds.try_emplace(ground.name, ground.friction_deg, ground.friction_deg).first->second;
      low = std::min(low, ground.friction_deg);
      high = std::max(high, ground.friction_deg);
    }
  }
  const auto tangent = [&](double degrees) { return shown(texts, std::tan(degrees * degree)); };
  const auto range = [&texts](const std::string& low, const std::string& high) {
    return texts.of("words.range", {{"low", low}, {"high", high}});
  };
  std::string list;
  for (const auto& [name, friction] : grounds) {
    const auto& [low, high] = friction;
    list += (list.empty() ? "" : "; ") + xml_escaped(name) + ": " +
            (low == high ? texts.of("runout.tangent",
                                    {{"degrees", shown(texts, low, 4)}, {"tangent", tangent(low)}})
                         : texts.of("runout.tangents",
                                    {{"tangents", range(tangent(low), tangent(high))},
                                     {"degrees", range(shown(texts, low), shown(texts, high))}}));
  }
  return list;
}

// Of the run of the animation, the farthest one.
Json energy_line_of(const ReportData& data) {
  for (const Json& run : list_or_none(value_at(data.runout, {"runs"})))
    if (run.value("run_id", "") == data.shown.info.run_id) return value_at(run, {"energy_line"});
  return {};
}

// --- fences --------------------------------------------------------------------------------------

// "1 stopped, 56 did not reach it"
std::string verdict_counts(const Texts& texts, const Json& fence) {
  std::string out;
  const Json verdicts = value_at(fence, {"verdicts"});
  if (!verdicts.is_object()) return "";
  for (const auto& [name, verdict] : verdicts.items()) {
    const double n = number_or(value_at(verdict, {"n"}), 0);
    const std::string key = name == "not_reached" ? "fences.not_reached" : "passage." + name;
    if (n > 0)
      out += (out.empty() ? "" : ", ") + shown(texts, n, 9) + " " +
             (texts.has(key) ? texts.of(key) : xml_escaped(name));
  }
  return out;
}

// Fences of a report with further values for their part of the template.
Json fences_of(const Texts& texts, const Json& report) {
  Json fences = Json::array();
  for (Json fence : list_or_none(value_at(report, {"fences"}))) {
    if (!fence.is_object()) continue;
    const Json code = value_at(fence, {"design", "code"});
    const Json standing = value_at(fence, {"standing"});
    fence["code"] =
        code.is_string() ? std::filesystem::path(code.get<std::string>()).stem().string() : "";
    fence["verdict_counts"] = verdict_counts(texts, fence);
    fence["is_rigid"] = standing == Json(true) && !value_at(fence, {"capacity_kj"}).is_number();
    fence["has_kept"] = value_at(fence, {"kept_from_passing_m3"}).is_number();
    std::string guessed;
    for (const Json& name : list_or_none(value_at(fence, {"design", "from_memory"})))
      if (name.is_string())
        guessed += (guessed.empty() ? "" : ", ") + xml_escaped(name.get<std::string>());
    fence["from_memory"] = guessed;
    if (value_at(fence, {"design", "whole", "derivation"}).is_array())
      for (Json& step : fence["design"]["whole"]["derivation"]) {
        const Json symbol = value_at(step, {"symbol"});
        if (step.is_object()) step["is_needed"] = symbol == "E_req" || symbol == "h_req";
      }
    fences.push_back(std::move(fence));
  }
  return fences;
}

void add_fences(const ReportData& data, Json& out) {
  out["fence"] = {{"fences", fences_of(data.texts, data.fence)},
                  {"dams", list_or_none(value_at(data.fence, {"dams"}))}};
  out["case_fences"] = Json::array();
  for (const auto& [name, report] : data.case_fences)
    out["case_fences"].push_back({{"case", name}, {"fences", fences_of(data.texts, report)}});
  out["cases_alone"] =
      !data.case_fences.empty() && value_at(data.runout, {"cases_weighed"}) != Json(true);
}

// --- search, objects
// -------------------------------------------------------------------------------

Json searches_of(const ReportData& data) {
  constexpr std::size_t most_rows = 12;  // of the curve
  Json searches = list_or_none(value_at(data.search, {"searches"}));
  for (std::size_t s = 0; s < searches.size(); ++s) {
    Json& search = searches[s];
    const Json curve = list_or_none(value_at(search, {"curve"}));
    const std::size_t step = (curve.size() + most_rows - 1) / most_rows;
    Json rows = Json::array();
    for (std::size_t i = 0; i < curve.size(); ++i)
      if (i % step == 0 || i + 1 == curve.size()) {
        rows.push_back(curve[i]);
        rows.back()["option"] = i + 1;
      }
    search["curve"] = std::move(rows);
    search["is_fence"] = value_at(search, {"verdict"}) == "fence";
    search["map"] = proposal_map(data, list_or_none(value_at(search, {"proposals"})));
    const std::string& svg = s < data.search_svgs.size() ? data.search_svgs[s] : "";
    search["chart"] = svg.empty() ? "" : data_address("image/svg+xml", svg);
  }
  return searches;
}

// Observations, with a chart of the run-outs of each event.
Json observed_of(const ReportData& data) {
  Json calibrate = data.calibrate;
  for (Json& event : calibrate.is_object() ? calibrate["events"] : calibrate) {
    event["map"] = observed_map(data, event);
    if (event.contains("boulders"))
      event["boulders"]["chart"] = observed_chart(data.texts, event["boulders"]);
    if (!event.contains("outline")) continue;
    Json& outline = event["outline"];
    const Json low = value_at(outline, {"inside_share_lo"}),
               high = value_at(outline, {"inside_share_hi"});
    const auto shown_share = [&data](const Json& share) {
      return data.texts.number(percent(share.get<double>()));
    };
    outline["interval"] = low.is_number() && high.is_number()
                              ? " (" +
                                    data.texts.of("words.range", {{"low", shown_share(low)},
                                                                  {"high", shown_share(high)}}) +
                                    ")"
                              : "";
  }
  return calibrate;
}

// What stands against blocks, with its verdict: fences that are active, dams and galleries.
Json structures_of(const Json& fence) {
  Json rows = Json::array();
  for (const Json& one : list_or_none(value_at(fence, {"fences"})))
    if (value_at(one, {"standing"}) == Json(true))
      rows.push_back({{"name", value_at(one, {"name"})},
                      {"verdict", value_at(one, {"design", "whole", "verdict"})}});
  for (const Json& one : list_or_none(value_at(fence, {"dams"})))
    rows.push_back({{"name", value_at(one, {"name"})}, {"verdict", value_at(one, {"verdict"})}});
  return rows;
}

// "1 of 12 runs failed its numerical checks", of runs that a trace was made of; "" where none did.
std::string remark_of_runs(const Json& trace) {
  RunFaults faults;
  faults.failed.resize(list_or_none(value_at(trace, {"failed_runs"})).size());
  if (const Json n = value_at(trace, {"n_runs"}); n.is_number()) faults.n_runs = n.get<int>();
  return headline(faults);
}

Json measure_row(const std::string& variant, double cost, const MeasureResults& of) {
  return {{"variant", variant},
          {"remark", remark_of_runs(of.trace)},
          {"cost", number_or_null(cost)},
          {"structures", structures_of(of.fence)},
          {"classes", list_or_none(value_at(of.hazard, {"classes"}))}};
}

// The site as it is and its measures.
Json measures_of(const ReportData& data) {
  Json rows = Json::array();
  if (data.measures.empty()) return rows;
  rows.push_back(measure_row("", no_value, {"", data.fence, data.hazard, data.trace}));
  for (const MeasureResults& measure : data.measures)
    for (const VariantSettings& variant : data.site.variants)
      if (variant.name == measure.name)
        rows.push_back(measure_row(measure.name, variant.cost, measure));
  return rows;
}

// The same object by object, which any of them may lack.
Json measured_objects(const ReportData& data) {
  Json objects = Json::array();
  const auto object_in = [](const Json& trace, const std::string& name) {
    for (const Json& object : list_or_none(value_at(trace, {"objects"})))
      if (object.at("name") == name) return object;
    return Json();
  };
  const auto add = [](Json& rows, const std::string& variant, const Json& trace, Json object,
                      const Json& energy) {
    if (object.is_null()) return;
    object["variant"] = variant;
    object["remark"] = remark_of_runs(trace);
    object["energy_a_run_kj"] = energy;
    rows.push_back(std::move(object));
  };
  for (const ObjectSettings& settings : data.site.objects) {
    Json rows = Json::array(), energy_of_site;
    for (const MeasureResults& measure : data.measures) {
      const Json object = object_in(measure.trace, settings.name);
      const Json energy = value_at(object, {"compared", "energy_a_run_kj"});
      if (energy_of_site.is_null()) energy_of_site = value_at(energy, {"site"});
      add(rows, measure.name, measure.trace, object, value_at(energy, {"variant"}));
    }
    if (rows.empty()) continue;
    Json all = Json::array();
    add(all, "", data.trace, object_in(data.trace, settings.name), energy_of_site);
    for (Json& row : rows) all.push_back(std::move(row));
    objects.push_back({{"object", settings.name}, {"rows", std::move(all)}});
  }
  return objects;
}

// Of a page of a measure its name, its cost and what it changes at each object; null on others.
Json own_measure(const ReportData& data) {
  if (data.site.measures.empty()) return {};
  std::string names;
  double cost = no_value;
  for (const VariantSettings& variant : data.site.variants)
    for (const std::string& name : data.site.measures) {
      if (variant.name != name) continue;
      names += (names.empty() ? "" : " + ") + name;
      if (!std::isnan(variant.cost)) cost = variant.cost + (std::isnan(cost) ? 0 : cost);
    }
  Json objects = Json::array();
  for (const Json& object : list_or_none(value_at(data.trace, {"objects"}))) {
    Json rows = Json::array();
    for (const auto& [key, words] : {std::pair{"hits_a_run", "measures.hits"},
                                     {"energy_a_run_kj", "measures.energy"},
                                     {"frequency_per_a", "measures.frequency"},
                                     {"risk_per_a", "measures.individual_risk"}}) {
      Json row = value_at(object, {"compared", key});
      if (!row.is_object()) continue;
      row["what"] = data.texts.of(words);
      rows.push_back(std::move(row));
    }
    if (!rows.empty())
      objects.push_back({{"object", value_at(object, {"name"})}, {"rows", std::move(rows)}});
  }
  return {{"names", names}, {"cost", number_or_null(cost)}, {"objects", std::move(objects)}};
}

bool any_by_cells(const Json& trace) {
  const Json objects = list_or_none(value_at(trace, {"objects"}));
  return std::any_of(objects.begin(), objects.end(),
                     [](const Json& object) { return value_at(object, {"method"}) != "recorded"; });
}

// --- uncertainty ---------------------------------------------------------------------------------

// The runs with their drawn values; all are in runs.csv.
Json drawn_of(const Json& runout) {
  constexpr std::size_t most = 200;
  const Json runs = list_or_none(value_at(runout, {"runs"}));
  Json rows = Json::array(), names = Json::array();
  for (const Json& run : runs) {
    const Json drawn = value_at(run, {"drawn"});
    if (!drawn.is_object() || !drawn.contains("sample")) continue;
    if (names.empty())
      for (const auto& [name, value] : drawn.items()) names.push_back(name);
    if (rows.size() < most)
      rows.push_back({{"seed", value_at(run, {"seed"})},
                      {"length", value_at(run, {"event", "L_path_m"})},
                      {"drawn", drawn}});
  }
  if (rows.empty()) return {};
  std::sort(rows.begin(), rows.end(), [](const Json& a, const Json& b) {
    return number_or(a["seed"], 0) < number_or(b["seed"], 0);
  });
  const std::size_t n = rows.size();
  return {{"names", names},
          {"rows", std::move(rows)},
          {"n", n},
          {"all", runs.size()},
          {"more", runs.size() > n}};
}

// "L_path_m" in words.
std::string result_words(const Texts& texts, const std::string& result) {
  static const std::map<std::string, std::string> words = {
      {"L_path_m", "uncertainty.length"},
      {"reach_angle_path_deg", "uncertainty.angle"},
      {"L95_m", "uncertainty.length_95"},
      {"share_moved_1_m", "uncertainty.moved"}};
  if (const auto found = words.find(result); found != words.end()) return texts.of(found->second);
  return texts.of(
      result.starts_with("crossed.") ? "uncertainty.crossed" : "uncertainty.largest_energy",
      {{"line", xml_escaped(result.substr(result.find('.') + 1))}});
}

// A part a result, with its rows and pictures.
Json sensitivity_of(const Texts& texts, const Json& runout) {
  Json parts = Json::array();
  std::string before;
  for (const Json& row : list_or_none(value_at(runout, {"sensitivity"}))) {
    const std::string result = row.value("result", "");
    if (parts.empty() || result != before)
      parts.push_back({{"title", result_words(texts, result)},
                       {"rows", Json::array()},
                       {"is_enough", false},
                       {"needed", least_runs_for_sensitivity}});
    before = result;
    parts.back()["rows"].push_back(row);
    if (value_at(row, {"first_order"}).is_number()) parts.back()["is_enough"] = true;
  }
  for (Json& part : parts)
    for (const auto& [name, key, title] :
         {std::tuple{"shares", "first_order", "uncertainty.shares"},
          {"ranks", "rank_correlation", "uncertainty.ranks"}}) {
      std::vector<Bar> bars;
      for (const Json& row : part["rows"])
        if (const Json value = value_at(row, {key}); value.is_number())
          bars.push_back({row.value("quantity", ""), value.get<double>()});
      part[name] = bar_picture(bars, texts.of(title));
    }
  return parts;
}

void add_uncertainty(const ReportData& data, Json& out) {
  const UncertaintySettings& u = data.site.uncertainty;
  out["quantities"] = Json::array();
  for (const QuantitySettings& quantity : data.site.quantities)
    out["quantities"].push_back({{"name", quantity.name},
                                 {"drawn_from", text_of(data.site, quantity)},
                                 {"is_rock", is_rock(quantity)}});
  const bool cuts_masses = u.rock_masses > 0 && data.site.rockfalls.empty();
  out["is_drawn"] = !data.site.quantities.empty() || cuts_masses;
  out["rock_masses"] = u.rock_masses;
  out["terrain_rmse_m"] = u.terrain_rmse_m;
  out["drawn"] = drawn_of(data.runout);
  out["sensitivity"] = sensitivity_of(data.texts, data.runout);
}

// --- checks, assumptions, provenance -------------------------------------------------------------

void add_health(const ReportData& data, Json& out) {
  const Texts& texts = data.texts;
  const std::vector<RunHealth> runs = health_of(data.runs, data.run_names);
  const bool any_cut = std::any_of(runs.begin(), runs.end(), [](const RunHealth& run) {
    return std::any_of(run.whole.cuts.begin(), run.whole.cuts.end(), [](auto n) { return n > 0; });
  });
  Json failed = Json::array();
  for (std::size_t i = 0; i < data.runs.size(); ++i)
    if (const std::string& reason = data.runs[i].info.reason; !reason.empty())
      failed.push_back({{"name", data.run_names[i]}, {"words", reason}});
  out["all_pass"] = all_pass(data.runs, data.limits);
  out["health"] = {
      {"limits", table_of_rows(texts, limit_fields(), data.limits)},
      {"failed", std::move(failed)},
      {"counters", table_of_rows(texts, counter_fields(), runs)},
      {"cuts", table_of_rows(texts, cut_fields(), any_cut ? runs : std::vector<RunHealth>())},
      {"deep", table_of_rows(texts, deep_fields(), deep_of_runs(data.runs, data.run_names))}};
}

// The plane that a daylighting failure surface was found to be; null for other surfaces.
Json failure_plane(const Json& blocks) {
  const Json planes = value_at(blocks, {"cut", "failure_planes"});
  for (const Json& plane : list_or_none(value_at(planes, {"sets"})))
    if (value_at(plane, {"set"}) == value_at(planes, {"taken"})) return plane;
  return {};
}

// Appearance of the bodies of a section.
std::string shape_of(const Texts& texts, const BodySettings& placed) {
  if (placed.shape.empty()) return texts.of("assumed.meshes", {{"file", xml_escaped(placed.file)}});
  std::string size;
  for (const double edge : placed.size_m)
    size += (size.empty() ? ", " : " x ") + shown(texts, edge);
  if (!size.empty()) size += " m";
  if (placed.shape == "rock")
    return texts.of("assumed.rocks", {{"n", std::to_string(placed.n_points)}}) + size;
  if (placed.shape == "prism") return texts.of("assumed.prisms", {}) + size;
  if (placed.shape == "joint_cell") return texts.of("assumed.joint_cells", {});
  return xml_escaped(texts.said(placed.shape)) + size;
}

Json settings_of(const Site& site, bool defaults) {
  Json rows = Json::array();
  for (const EffectiveValue& value : effective_values(site))
    if (!value.value.empty() && (value.source == "default") == defaults)
      rows.push_back({{"key", value.section + "." + value.key}, {"value", value.value}});
  return {{"rows", std::move(rows)}};
}

void add_assumptions(const ReportData& data, Json& out) {
  out["runs_to_add"] = data.runs_to_add;
  out["failure_plane"] = failure_plane(data.blocks);
  out["soils"] = Json::array();
  out["placed"] = Json::array();
  for (const GroundSettings& ground : data.site.grounds)
    if (const Soil* soil = soil_named(ground.soil))
      out["soils"].push_back({{"key", "ground." + ground.name},
                              {"soil", soil->name},
                              {"mark", soil->mark},
                              {"source", soil->source}});
  if (std::any_of(data.runs.begin(), data.runs.end(), [](const RunFile& run) {
        return parse_site(run.info.config, run.info.run_id).solver.friction == "weakening";
      }))
    out["soils"].push_back({{"key", "solver.friction"},
                            {"soil", "weakening"},
                            {"mark", weakening().mark},
                            {"source", weakening().source}});
  const auto say_shape = [&](const BodySettings& body) {
    out["placed"].push_back({{"blocks", body.name}, {"shape", shape_of(data.texts, body)}});
  };
  for (const PlacedSettings& placed : data.site.blocks) say_shape(placed);
  for (const RockfallSettings& rocks : data.site.rockfalls) say_shape(rocks);
  out["settings"] = {{"given", settings_of(data.site, false)},
                     {"defaults", settings_of(data.site, true)}};
  out["plan"] = list_or_none(Json::parse_or_null(data.shown.info.plan));
}

// Doubts to be looked at, a kind together, as doubts_html() of other pages shows it.
Json doubt_rows(const ReportData& data) {
  Json rows = Json::array();
  for (const DoubtGroup& group : groups_of(data.doubts)) {
    const Doubt& doubt = *group.first;
    const bool is_open = doubt.state == DoubtState::in_doubt;
    rows.push_back({{"kind", doubt.state == DoubtState::refused ? "fail" : "warn"},
                    {"state", is_open ? "" : text(doubt.state)},
                    {"finding", sentence_on(group)},
                    {"hint", doubt.hint}});
  }
  return rows;
}

void add_provenance(const ReportData& data, Json& out) {
  const auto files = [](const std::vector<StepFile>& list) {
    Json rows = Json::array();
    for (const StepFile& file : list) rows.push_back({{"path", file.path}, {"sha", file.sha}});
    return rows;
  };
  out["steps"] = Json::array();
  for (const ProvenanceStep& step : provenance_steps(data.steps, data.site.file))
    out["steps"].push_back({{"command", step.command},
                            {"version", step.version},
                            {"run_id", step.run_id},
                            {"notes", step.notes},
                            {"read", files(step.read)},
                            {"wrote", files(step.wrote)}});
  out["n_steps"] = out["steps"].size();
}

// --- scripts -------------------------------------------------------------------------------------

// Within the quotation marks of a script.
std::string in_script(const std::string& words) {
  std::string out;
  for (const char c : words) {
    if (c == '\\' || c == '\'' || c == '`') out += '\\';
    out += c;
  }
  return out;
}

// A script with words in place of its {{keys}}.
std::string with_texts(const std::string& script, const Texts& texts) {
  std::string out;
  std::size_t done = 0;
  for (std::size_t at = script.find("{{"); at != std::string::npos; at = script.find("{{", done)) {
    const std::size_t end = script.find("}}", at);
    out +=
        script.substr(done, at - done) + in_script(texts.of(script.substr(at + 2, end - at - 2)));
    done = end + 2;
  }
  return out + script.substr(done);
}

Json files_of(const PageFiles& files, const Texts& texts) {
  return {
      {"style", files.style},
      {"viewer", with_texts(files.viewer, texts)},
      {"profile", with_texts(files.profile, texts)},
      {"maps", with_texts(files.maps, texts)},
      {"written", in_script(texts.of("page.file_written",
                                     {{"time",
                                       "${changed.getFullYear()}-${two(changed.getMonth() + "
                                       "1)}-${two(changed.getDate())} ${two(changed.getHours())}:"
                                       "${two(changed.getMinutes())}"}}))}};
}

// Of a run in the mean.
Json released_of(const Json& runout) {
  const double n = number_or(value_at(runout, {"n_runs"}), 0);
  if (!(n > 0)) return {};
  return {{"n", std::llround(number_or(value_at(runout, {"balance", "n_released"}), 0) / n)},
          {"volume_m3", number_or(value_at(runout, {"balance", "released_m3"}), 0) / n}};
}

// Of the blocks of all runs that left the known terrain; null where none did.
Json left_share_of(const Json& runout) {
  const double n = number_or(value_at(runout, {"balance", "n_left_domain"}), 0),
               all = number_or(value_at(runout, {"balance", "n_released"}), 0);
  return n > 0 && all > 0 ? Json(n / all) : Json();
}

Json data_of(const ReportData& data, const PageFiles& files) {
  const std::size_t n_runs = data.runs.size();
  const std::string remark = remark_of(data), fence_remark = fence_remark_of(data);
  Json classes = list_or_none(value_at(data.hazard, {"classes"}));
  std::reverse(classes.begin(), classes.end());  // the strongest first
  Json out = {
      {"site", {{"name", data.site.info.name}, {"description", data.site.info.description}}},
      {"version", data.version},
      {"run_id", data.run_id},
      {"crs", value_at(data.trn, {"grid", "crs"})},
      {"remark", remark},
      {"fence_remark", fence_remark},
      {"first_remark", remark.empty() ? fence_remark : remark},
      {"files", files_of(files, data.texts)},
      {"pictures", pictures_of(data)},
      {"scene", scene_of(data)},
      {"doubts", doubt_rows(data)},
      {"blocks", data.blocks},
      {"trn", data.trn},
      {"tin", data.tin},
      {"hazard", data.hazard},
      {"hazard_classes", classes},
      {"calibrate", observed_of(data)},
      {"trace", data.trace},
      {"stability", data.stability},
      {"measures", measures_of(data)},
      {"measured_objects", measured_objects(data)},
      {"own_measure", own_measure(data)},
      {"places", data.places},
      {"searches", searches_of(data)},
      {"objects_by_cells", any_by_cells(data.trace)},
      {"n_runs", n_runs},
      {"few_curves", n_runs < 3},
      {"has_cases", !list_or_none(value_at(data.runout, {"cases"})).empty()},
      {"has_lines", !data.sheet.places.lines.empty()},
      {"has_objects", !data.shown.objects.empty()},
      {"has_frames", !data.shown.reach},
      {"has_trails", !data.trails.empty()},
      {"shown", {{"name", data.shown_name}}},
      {"contour_m", data.sheet.ground.contour_interval},
      {"all_events", value_at(data.runout, {"n_events"}) == value_at(data.runout, {"n_runs"})},
      {"energy_line", energy_line_of(data)},
      {"friction", friction_of(data)},
      {"n_stems_shown", list_or_none(value_at(data.runout, {"trees", "stems"})).size()},
      {"released", released_of(data.runout)},
      {"left_share", left_share_of(data.runout)},
      {"rocks_alone", data.rocks_alone}};
  set_runout(data, out);
  add_result(data, out);
  add_fences(data, out);
  add_uncertainty(data, out);
  add_health(data, out);
  add_assumptions(data, out);
  add_provenance(data, out);
  return out;
}

}  // namespace

std::string report_page(const ReportData& data, const PageFiles& files) {
  return filled_page("page.html", files.page, data_of(data, files).dump(), data.texts);
}

}  // namespace talus
