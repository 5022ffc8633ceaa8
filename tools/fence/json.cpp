// Results at fences as the JSON of talus-fence.
#include "tools/fence/json.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/units.hpp"
#include "post/fence/fence_text.hpp"
#include "post/statistics.hpp"

namespace talus {
namespace {

Json quantity_json(const QuantitySummary& q, double scale) {
  Json json = {{"max", number_or_null(q.largest * scale)}};
  for (std::size_t k = 0; k < percentile_levels.size(); ++k) {
    const std::string name = percentile_levels[k].name;
    json[name] = number_or_null(q.percentile[k].value * scale);
    json[name + "_hi"] = number_or_null(q.percentile[k].upper * scale);
  }
  return json;
}

Json part_json(const FencePartSummary& p) {
  return {{"n", p.n},
          {"per_run", number_or_null(p.per_run)},
          {"n_eff", p.n_eff},
          {"energy_kj", quantity_json(p.energy, 1e-3)},
          {"translational_energy_kj", quantity_json(p.translation, 1e-3)},
          {"top_height_m", quantity_json(p.top, 1)},
          {"speed_m_s", quantity_json(p.speed, 1)},
          {"mean_angle_to_normal_deg", number_or_null(p.mean_angle / degree)},
          {"most_hits_in_a_run", p.most_in_a_run},
          {"runs_hit_twice", number_or_null(p.runs_hit_twice)},
          {"energy_in_one_second_kj", p.window_energy / 1e3},
          {"hits_in_that_second", p.window_hits}};
}

Json share_json(const VerdictShare& share) {
  return {{"n", share.n},
          {"share", number_or_null(share.share)},
          {"low", number_or_null(share.interval.low)},
          {"high", number_or_null(share.interval.high)}};
}

Json step_list(const std::vector<DesignStep>& steps) {
  Json list = Json::array();
  for (const DesignStep& step : steps)
    list.push_back({{"symbol", step.symbol},
                    {"name", step.name},
                    {"value", number_or_null(step.value)},
                    {"unit", step.unit},
                    {"source", step.source}});
  return list;
}

// `with_steps`: the derivation, which the fields would only repeat.
Json design_json(const DesignResult& r, bool with_steps) {
  const std::optional<bool> pass = passes(r);
  Json json = {{"enough_arrivals", r.n_arrivals > 0 && r.verdict != DesignVerdict::too_few},
               {"arrivals", r.n_arrivals},
               {"arrivals_needed", r.n_needed},
               {"design_energy_kj", number_or_null(r.design_energy / 1e3)},
               {"required_capacity_kj", number_or_null(r.required_capacity / 1e3)},
               {"smallest_class", r.smallest_class},
               {"largest_class_kj", number_or_null(r.largest_class / 1e3)},
               {"design_height_m", number_or_null(r.design_height)},
               {"free_border_m", number_or_null(r.free_border)},
               {"required_height_m", number_or_null(r.required_height)},
               {"energy_use", number_or_null(r.energy_use)},
               {"height_use", number_or_null(r.height_use)},
               {"required_distance_m", number_or_null(r.required_distance)},
               {"distance_use", number_or_null(r.distance_use)},
               {"governs", r.governs},
               {"verdict", text(r.verdict)},
               {"text", text(r)},
               {"pass", pass ? Json(*pass) : Json()}};
  if (with_steps) json["derivation"] = step_list(r.steps);
  return json;
}

const char* basis_name(DesignBasis basis) {
  constexpr std::array names = {"line that stops nothing", "line without the fence",
                                "first touches"};
  return names[static_cast<std::size_t>(basis)];
}

Json field_list(const Fence& fence, const FenceResult& result) {
  Json fields = Json::array();
  for (std::size_t f = 0; f < result.fields.size(); ++f) {
    Json json = part_json(result.fields[f].part);
    json["from_m"] = fence.chainage[f];
    json["to_m"] = fence.chainage[f + 1];
    json["storage_m3"] = result.fields[f].storage;
    json["design"] = design_json(result.fields[f].design, false);
    fields.push_back(json);
  }
  return fields;
}

Json post_list(const Fence& fence, const FenceResult& result) {
  Json posts = Json::array();
  for (std::size_t p = 0; p < result.posts.size(); ++p) {
    Json json = part_json(result.posts[p]);
    json["chainage_m"] = fence.chainage[p];
    posts.push_back(json);
  }
  return posts;
}

Json broken_list(const FenceRunGroup& group, std::size_t fence) {
  Json list = Json::array();
  for (int r = 0; r < n_runs(group); ++r)
    for (const PanelRow& panel : group.runs[r].at_fence[fence].broken) {
      list.push_back({{"run_id", group.members[r].info.run_id},
                      {"panel", panel.panel},
                      {"broken_at_s", panel.broken_at},
                      {"broken_by_block", panel.broken_by},
                      {"work_kj", panel.work / 1e3}});
      if (panel.rock >= 0) list.back()["rock"] = panel.rock;
    }
  return list;
}

Json ground_json(const FenceRunGroup& group, std::size_t fence) {
  const GroundBehind g = ground_behind(group, fence);
  return {{"n_runs", n_runs(group)},
          {"n_runs_moved", g.n_moved},
          {"blocks_behind_the_line", g.n},
          {"share_behind_the_line", number_or_null(g.share)},
          {"volume_behind_the_line_m3_per_run", g.volume},
          {"energy_at_the_line_kj_p50", number_or_null(g.energy_p50 / 1e3)},
          {"energy_at_the_line_kj_max", number_or_null(g.energy_largest / 1e3)},
          {"mean_L_path_m", number_or_null(g.path)},
          {"mean_reach_angle_path_deg", number_or_null(g.path_angle_deg)},
          {"mean_centre_of_mass_L_path_m", number_or_null(g.centre_of_mass_path)}};
}

// The radius is that of the sphere of the block's volume.
Json load_json(const LoadCase& of, const FenceRunGroup& group) {
  Json json = {{"name", of.name}};
  if (!of.load) return json;
  const RoofLoad& load = *of.load;
  json.update(
      {{"run_id", group.members[load.run].info.run_id},
       {"block", load.block},
       {"mass_kg", load.mass},
       {"volume_m3", load.volume},
       {"radius_m", std::cbrt(0.75 * load.volume / std::numbers::pi)},
       {"speed_m_s", load.speed},
       {"angle_to_roof_deg", std::asin(std::min(1.0, load.normal_speed / load.speed)) / degree},
       {"normal_speed_m_s", load.normal_speed},
       {"normal_energy_kj", load.normal_energy() / 1e3}});
  return json;
}

}  // namespace

Json fence_json(const FenceCase& fence_case, std::size_t index, const FenceResult& r,
                const FenceRunGroup& group, const ShareBasis& basis, const FenceCode& code) {
  const Fence& fence = fence_case.fence;
  Json shares;
  for (const Verdict v : verdicts)
    shares[text(v)] = share_json(verdict_share(group, index, v, basis));
  const auto n_touches =
      std::count_if(r.arrivals.begin(), r.arrivals.end(), [](auto& a) { return a.by_touch; });
  const double top_p95 = r.whole.top.percentile[place_of_p95].value;
  return {{"name", fence_case.line.name},
          {"length_m", length(fence)},
          {"height_m", fence.height},
          {"capacity_kj", number_or_null(fence.capacity / 1e3)},
          {"standing", stood(group, index)},
          {"free_border_m", r.design.free_border},
          {"height_left_m", number_or_null(fence.height - top_p95)},
          {"verdicts", shares},
          {"arrivals", {{"first_touches", n_touches}, {"crossings", r.whole.n - n_touches}}},
          {"whole", part_json(r.whole)},
          {"at_open_line", r.basis == DesignBasis::first_touches ? Json() : part_json(r.at_basis)},
          {"storage_m3", r.storage},
          {"retained_m3", r.retained},
          {"kept_from_passing_m3", number_or_null(r.kept)},
          {"stopped_but_moving", n_unsettled(group, index)},
          {"broken_panels", broken_list(group, index)},
          {"design",
           {{"code", code.code.file},
            {"sha256", code.sha256},
            {"from_memory", code.code.from_memory},
            {"basis", basis_name(r.basis)},
            {"basis_text", basis_text(r)},
            {"whole", design_json(r.design, true)}}},
          {"fields", field_list(fence, r)},
          {"posts", post_list(fence, r)},
          {"notes", fence_notes(fence_case, index, r, group, code.code)}};
}

Json dam_json(const DamCase& dam, const DamResult& r, const FenceRunGroup& group,
              const Fence& crest, const ShareBasis& basis) {
  Json shares;
  for (const Verdict v : {Verdict::stopped, Verdict::overtopped, Verdict::bypassed_left,
                          Verdict::bypassed_right, Verdict::not_reached})
    shares[text(v)] = share_json(verdict_share(group, dam.arrival, v, basis));
  const bool is_judged =
      r.verdict == DesignVerdict::meets || r.verdict == DesignVerdict::does_not_meet;
  Json json = {{"name", dam.name},
               {"kind", dam.is_gallery ? "gallery" : "dam"},
               {"length_m", length(crest)},
               {"height_m", dam.height},
               {"capacity_kj", number_or_null(dam.capacity / 1e3)},
               {"verdicts", shares},
               {"arriving", part_json(r.arriving)},
               {"passing", part_json(r.passing)},
               {"still_moving", r.n_moving},
               {"from_downhill", r.n_from_downhill},
               {"ended_downhill", r.n_ended_downhill},
               {"energy_use", number_or_null(r.energy_use)},
               {"verdict", text(r.verdict)},
               {"pass", is_judged ? Json(r.verdict == DesignVerdict::meets) : Json()},
               {"text", r.text}};
  if (!dam.is_gallery) return json;
  json["roof_hits"] = {{"blocks", r.n_loads}, {"hits", r.n_hits}};
  json["load_cases"] = Json::array();
  for (const LoadCase& of : r.load_cases) json["load_cases"].push_back(load_json(of, group));
  return json;
}

Json comparison_json(const FenceRunGroup& with, const FenceRunGroup& without, std::size_t index) {
  const Json a = ground_json(with, index), b = ground_json(without, index);
  Json change;
  for (const auto& [key, value] : a.items())
    if (!key.starts_with("n_runs") && value.is_number() && b[key].is_number())
      change[key] = value.get<double>() - b[key].get<double>();
  return {{"with", a}, {"without", b}, {"with_minus_without", change}};
}

Json deposit_change_json(const GroundSums& with, const GroundSums& without) {
  const DepositChange change = deposit_change(with, without);
  return {{"with_m3_per_run", change.with},
          {"without_m3_per_run", change.without},
          {"more_m3_per_run", change.more},
          {"less_m3_per_run", change.less}};
}

}  // namespace talus
