// Run-out as the JSON of talus-runout.
#include "tools/runout/json.hpp"

#include <algorithm>
#include <cmath>

#include "base/units.hpp"
#include "post/runout/runout_text.hpp"
#include "tools/frame/moved_json.hpp"

namespace talus {
namespace {

Json line_json(const ReachLine& line) {
  return {{"H_m", number_or_null(line.height)},
          {"L_path_m", number_or_null(line.path)},
          {"L_chord_m", number_or_null(line.chord)},
          {"reach_angle_path_deg", number_or_null(line.path_angle() / degree)},
          {"reach_angle_chord_deg", number_or_null(line.chord_angle() / degree)}};
}

Json energy_json(const EnergyShares& s) {
  if (!(s.put_in > 0)) return {};
  return {{"put_in_kj", s.put_in / 1e3},
          {"friction", s.friction},
          {"impact", s.impact},
          {"contact", s.contact},
          {"fence", s.fence},
          {"breakage", s.breakage},
          {"rolling", s.rolling},
          {"drag", s.drag},
          {"removed", s.removed},
          {"kinetic_left", s.kinetic},
          {"elastic_left", s.elastic},
          {"unaccounted", s.unaccounted}};
}

// Null where the number is nowhere finite.
Json spread(const std::vector<RunoutRun>& runs, const std::vector<int>& some,
            double (*value)(const RunoutRun&)) {
  const Spread s = spread_over(runs, some, value);
  if (s.n == 0) return {};
  return {{"n", s.n},     {"mean", s.mean}, {"min", s.smallest}, {"p05", s.p05},
          {"p50", s.p50}, {"p95", s.p95},   {"max", s.largest}};
}

// Of the mass without its few farthest blocks; null where nothing moved.
Json mass_json(const EventReach& event) {
  if (!event.moved.any()) return {};
  const MassReach& m = event.mass;
  return {{"moved_volume_m3", m.moved_volume},
          {"H95_m", m.height},
          {"L95_m", m.length},
          {"reach_angle_95_deg", number_or_null(m.angle() / degree)},
          {"blocks_beyond", m.n_beyond},
          {"share_beyond", m.beyond_share},
          {"toe_share", m.toe_share},
          {"outliers", m.n_outliers},
          {"share_left_source", m.left_share}};
}

Json spread_of(const std::vector<RunoutRun>& runs, const std::vector<int>& some) {
  return {
      {"H_m", spread(runs, some, [](const RunoutRun& r) { return r.event.event.height; })},
      {"L_path_m", spread(runs, some, [](const RunoutRun& r) { return r.event.event.path; })},
      {"L_chord_m", spread(runs, some, [](const RunoutRun& r) { return r.event.event.chord; })},
      {"reach_angle_path_deg",
       spread(runs, some, [](const RunoutRun& r) { return r.event.event.path_angle() / degree; })},
      {"reach_angle_chord_deg",
       spread(runs, some, [](const RunoutRun& r) { return r.event.event.chord_angle() / degree; })},
      {"L95_m", spread(runs, some, [](const RunoutRun& r) { return r.event.mass.length; })},
      {"H95_m", spread(runs, some, [](const RunoutRun& r) { return r.event.mass.height; })},
      {"reach_angle_95_deg",
       spread(runs, some, [](const RunoutRun& r) { return r.event.mass.angle() / degree; })},
      {"H_cm_over_L_cm", spread(runs, some, [](const RunoutRun& r) {
         return r.event.centre_of_mass.height / r.event.centre_of_mass.path;
       })}};
}

// Of the weight of all runs.
double share_of(const std::vector<RunoutRun>& runs, const std::vector<int>& some) {
  double of_some = 0, all = 0;
  for (const int i : some) of_some += runs[i].member.run_weight;
  for (const RunoutRun& run : runs) all += run.member.run_weight;
  return of_some / all;
}

Json drawn_json(const RunoutRun& run) {
  Json values = Json::object();
  for (const DrawnValue& value : run.drawn) values[value.name] = value.value;
  return values;
}

}  // namespace

Json balance_json(const Balance& b) {
  return {{"released_m3", b.released},  {"deposited_m3", b.deposited},
          {"moving_m3", b.moving},      {"left_domain_m3", b.left},
          {"n_released", b.n_released}, {"n_deposited", b.n_deposited},
          {"n_moving", b.n_moving},     {"n_left_domain", b.n_left}};
}

Json run_json(const RunoutRun& r, double friction_deg) {
  const EventReach& e = r.event;
  Json centre = line_json(e.centre_of_mass);
  centre["H_over_L"] = number_or_null(e.centre_of_mass.height / e.centre_of_mass.path);
  centre["atan_sum_mH_over_sum_mL_deg"] = number_or_null(e.sum_angle / degree);
  if (std::isfinite(friction_deg)) centre["tan_friction"] = std::tan(friction_deg * degree);
  double max_speed = 0;
  for (const BlockReach& b : e.blocks) max_speed = std::max(max_speed, b.max_speed);
  return {{"run_id", r.member.info.run_id},
          {"seed", r.member.info.seed},
          {"status", r.member.info.status},
          {"case", r.member.info.case_name},
          {"drawn", drawn_json(r)},
          {"did_move", e.moved.any()},
          {"is_event", e.moved.is_event()},
          {"run_weight", r.member.run_weight},
          {"moved", moved_json(e.moved)},
          {"event", line_json(e.event)},
          {"mass_95", mass_json(e)},
          {"toe_block", e.moved.any() ? Json(e.toe_block) : Json()},
          {"toe_fate", e.moved.any() ? Json(text(e.toe_fate)) : Json()},
          {"angle_monotone_along_path", e.moved.any() ? Json(e.profile.monotone) : Json()},
          {"energy_line", energy_line_text(e.profile)},
          {"missing_head_m", e.moved.any() ? Json(e.profile.missing_head) : Json()},
          {"smallest_angle_along_path_deg", number_or_null(e.profile.smallest / degree)},
          {"smallest_angle_at_m", number_or_null(e.profile.smallest_at)},
          {"centre_of_mass", centre},
          {"max_speed_m_s", max_speed},
          {"balance", balance_json(r.balance)},
          {"energy_shares", energy_json(r.energy)}};
}

void add_spreads(Json& to, const std::vector<RunoutRun>& runs, const std::vector<int>& some) {
  const std::vector<int> events = events_among(runs, some);
  to["n_events"] = events.size();
  to["event_probability"] = event_probability(runs, some);
  to["spread_over_runs"] = spread_of(runs, some);
  to["spread_over_events"] = spread_of(runs, events);
}

Json percentiles_json(const MobilityPercentiles& p) {
  return {{"share_left_source", number_or_null(p.left_share)},
          {"rockfalls", number_or_null(p.rockfalls)},
          {"rock_avalanches", number_or_null(p.rock_avalanches)},
          {"at_least", p.at_least}};
}

Json cases_json(const std::vector<RunoutRun>& runs, const std::vector<MobilityRelation>& relations,
                bool confined) {
  Json list = Json::array();
  for (const RunoutCase& one : cases_of(runs)) {
    const auto n_moved_runs = std::count_if(one.runs.begin(), one.runs.end(),
                                            [&](int i) { return runs[i].event.moved.any(); });
    list.push_back({{"case", one.name},
                    {"n_runs", one.runs.size()},
                    {"weight", share_of(runs, one.runs)},
                    {"n_runs_moved", n_moved_runs},
                    {"moved", moved_json(one.moved)},
                    {"percentiles", percentiles_json(percentiles_of(
                                        relations, mobility_events(runs, one.runs, confined)))}});
    add_spreads(list.back(), runs, one.runs);
  }
  return list;
}

Json mobility_json(const std::vector<MobilityRelation>& relations,
                   const std::vector<MobilityEvent>& events) {
  Json list = Json::array();
  for (const MobilityRelation& relation : relations) {
    Json rows = Json::array();
    for (const MobilityEvent& event : events) {
      const MobilityRow row = compare(relation, event);
      rows.push_back({{"run_id", event.name},
                      {"L_expected_m", number_or_null(row.length)},
                      {"L_on_lower_line_m", number_or_null(row.length_upper)},
                      {"L_over_expected", number_or_null(row.ratio)},
                      {"percentile", number_or_null(row.percentile)}});
    }
    list.push_back({{"relation", relation.id},
                    {"group", relation.group},
                    {"path", relation.path},
                    {"source", relation.source},
                    {"from_memory", relation.from_memory},
                    {"runs", rows}});
  }
  return list;
}

}  // namespace talus
