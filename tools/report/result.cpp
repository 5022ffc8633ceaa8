#include "tools/report/result.hpp"

#include <algorithm>

#include "base/grouped_text.hpp"
#include "base/text.hpp"
#include "post/moved.hpp"
#include "post/statistics.hpp"
#include "report/html.hpp"
#include "tools/report/fences.hpp"
#include "tools/report/folder.hpp"
#include "tools/report/json.hpp"
#include "tools/report/runout.hpp"

namespace talus {
namespace {

double number_or(const Json& value, double otherwise) {
  return value.is_number() ? value.get<double>() : otherwise;
}

// Runs of the run-out for which `holds`.
template <class Test>
int count_runs(const Json& runout, const Test& holds) {
  const Json runs = value_at(runout, {"runs"});
  return runs.is_array() ? static_cast<int>(std::count_if(runs.begin(), runs.end(), holds)) : 0;
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
std::string extreme_percentile(const Texts& texts, const Json& spread, const char* percentile,
                               const char* unit) {
  if (number_or(value_at(spread, {"n"}), 0) < smallest_sample(0.95)) return "";
  return texts.of(
      "result.percentile",
      {{"percentile", percentile}, {"value", number_text(value_at(spread, {percentile})) + unit}});
}

std::string trouble_tiles(const ReportData& data) {
  std::string out;
  const Texts& texts = data.texts;
  const auto n_of = [&texts](std::size_t n, std::int64_t n_all) {
    return texts.of("words.n_of", {{"n", std::to_string(n)}, {"all", runs_text(texts, n_all)}});
  };
  const auto tile = [&](std::size_t n, const char* one, const char* several) {
    if (n > 0)
      out += html_fact(n_of(n, data.faults.n_runs), texts.of(n == 1 ? one : several), "bad");
  };
  tile(data.faults.failed.size(), "result.one_failed", "result.several_failed");
  const int n_all = count_runs(data.runout, [](const Json&) { return true; });
  const int n_still = count_runs(
      data.runout, [](const Json& run) { return value_at(run, {"did_move"}) == Json(false); });
  if (n_still > 0)
    out += html_fact(n_of(n_still, n_all),
                     texts.of("result.did_not_move", {{"metres", text(moved_m)}}), "bad");
  const int n_few = count_runs(data.runout, [](const Json& run) {
    return value_at(run, {"did_move"}) == Json(true) && value_at(run, {"is_event"}) == Json(false);
  });
  if (n_few > 0) out += html_fact(n_of(n_few, n_all), texts.of("result.moved_little"), "bad");
  const Json chance = value_at(data.runout, {"event_probability"});
  if (n_still + n_few > 0 && chance.is_number())
    out += html_fact(percent_text(chance), texts.of("result.events"));
  return out;
}

std::string moved_tile(const Texts& texts, const Json& moved) {
  return html_fact(
      percent_text(value_at(moved, {"share_moved_1_m"})),
      texts.of("result.moved", {{"far", percent_text(value_at(moved, {"share_moved_20_m"}))},
                                {"p50", number_text(value_at(moved, {"displacement_p50_m"}), 3)},
                                {"p90", number_text(value_at(moved, {"displacement_p90_m"}), 3)},
                                {"p95", number_text(value_at(moved, {"displacement_p95_m"}), 3)}}),
      "two");
}

std::string reach_tiles(const Texts& texts, const Json& r) {
  const auto of = [&r](const char* key, const char* what) {
    return value_at(r, {"spread_over_runs", key, what});
  };
  const Json length = value_at(r, {"spread_over_runs", "L_path_m"});
  const Json angle = value_at(r, {"spread_over_runs", "reach_angle_path_deg"});
  return html_fact(number_text(of("H_m", "max")) + " m",
                   texts.of("result.drop", {{"over", over_runs(texts, r, "result.largest")}})) +
         html_fact(number_text(of("L_path_m", "max")) + " m",
                   texts.of("result.length",
                            {{"over", over_runs(texts, r, "result.largest")},
                             {"percentile", extreme_percentile(texts, length, "p95", " m")},
                             {"fate", unsettled(texts, r)}})) +
         html_fact(
             number_text(of("L95_m", "max")) + " m",
             texts.of("result.length_95", {{"over", over_runs(texts, r, "result.largest")}})) +
         html_fact(number_text(of("reach_angle_path_deg", "min"), 3) + "&deg;",
                   texts.of("result.angle",
                            {{"over", over_runs(texts, r, "result.smallest")},
                             {"percentile", extreme_percentile(texts, angle, "p05", "&deg;")}}));
}

// Speed of any block, path of the centre of mass, area.
std::string motion_tiles(const Texts& texts, const Json& r) {
  double fastest = 0, path = 0;
  int n = 0;
  const Json runs = value_at(r, {"runs"});
  for (std::size_t i = 0; runs.is_array() && i < runs.size(); ++i) {
    fastest = std::max(fastest, number_or(value_at(runs[i], {"max_speed_m_s"}), 0));
    const Json length = value_at(runs[i], {"centre_of_mass", "L_path_m"});
    if (!length.is_number()) continue;
    path += length.get<double>();
    ++n;
  }
  return (n == 0 ? ""
                 : html_fact(
                       grouped_text(path / n, 3) + " m",
                       texts.of("result.centre", {{"over", over_runs(texts, r, "result.mean")}}))) +
         html_fact(text(fastest, 3) + " m/s", texts.of("result.speed")) +
         html_fact(number_text(value_at(r, {"swept_area_m2"})) + " m&sup2;",
                   texts.of("result.area"));
}

std::string fault_table(const Texts& texts, const RunFaults& faults) {
  std::vector<std::vector<std::string>> rows;
  for (const RunFault& fault : faults.failed)
    rows.push_back({xml_escaped(fault.name), texts.of("result.failed"), xml_escaped(fault.words)});
  return html_table(texts.list("result.fault_heads"), rows);
}

std::string health_verdict(const ReportData& data) {
  const Texts& texts = data.texts;
  const std::string wrong = headline(data.faults);
  if (!wrong.empty())
    return html_verdict("fail", texts.of("result.runs_failed", {{"wrong", xml_escaped(wrong)}})) +
           fault_table(texts, data.faults);
  return all_pass(data.runs, data.limits) ? html_verdict("pass", texts.of("result.checks_passed"))
                                          : html_verdict("fail", texts.of("result.limit_broken"));
}

// Runs of other seeds that are one and the same.
std::string repeats_verdict(const ReportData& data) {
  if (data.repeats.empty()) return "";
  return html_verdict("warn",
                      data.texts.of("result.repeats", {{"repeats", xml_escaped(data.repeats)}}));
}

std::string standing_mass(const Texts& texts, const Json& moved) {
  if (!(number_or(value_at(moved, {"share_moved_1_m"}), 1) < least_moved)) return "";
  if (!(number_or(value_at(moved, {"displacement_max_m"}), 0) > moved_m))
    return html_verdict("warn", texts.of("result.nothing_moved"));
  return html_verdict("warn", texts.of("result.half_moved"));
}

// Failed runs, few enough to be left out.
std::string left_out_verdict(const Texts& texts, const Json& runout) {
  const Json runs = value_at(runout, {"left_out_runs"});
  if (!runs.is_array() || runs.empty()) return "";
  std::vector<std::vector<std::string>> rows;
  for (const Json& run : runs)
    rows.push_back({word_text(value_at(run, {"run"})), number_text(value_at(run, {"seed"})),
                    word_text(value_at(run, {"reason"}))});
  return html_verdict("warn",
                      texts.of("result.left_out", {{"runs", runs_text(texts, std::ssize(runs))}})) +
         html_table(texts.list("result.left_out_heads"), rows);
}

// Runs that were wanted and gave no result: what is shown is of the rest.
std::string missing_verdict(const Texts& texts, const Json& runout) {
  const std::string n = word_text(value_at(runout, {"tags", "N_MISSING"}));
  if (n.empty()) return "";
  return html_verdict(
      "fail", texts.of("result.missing",
                       {{"n", n}, {"others", word_text(value_at(runout, {"tags", "N_RUNS"}))}}));
}

}  // namespace

std::string result_section(const ReportData& data) {
  const Json& r = data.runout;
  const Json moved = value_at(r, {"moved"});
  const Texts& texts = data.texts;
  const std::size_t n = data.runs.size();
  std::string out = "<div class=\"facts\">\n" + trouble_tiles(data) + moved_tile(texts, moved);
  out += reach_tiles(texts, r) + motion_tiles(texts, r);
  out += html_fact(std::to_string(n), texts.of(n == 1 ? "result.run" : "result.runs"));
  out += html_fact(number_text(value_at(data.blocks, {"n_blocks"})), texts.of("result.blocks"));
  out += html_fact(number_text(value_at(data.blocks, {"volume_m3"})) + " m&sup3;",
                   texts.of("result.volume"));
  out += "</div>\n";
  if (const std::string cases = case_table(texts, r); !cases.empty())
    out += "<h3>" + texts.of("result.by_case") + "</h3>\n" + cases;
  out += standing_mass(texts, moved) + health_verdict(data) + repeats_verdict(data);
  out += left_out_verdict(texts, data.runout) + missing_verdict(texts, data.runout);
  out += fence_verdicts(data);
  return html_section("result", texts.of("result.title"), out);
}

}  // namespace talus
