// Results of a look at a site, as JSON and as lines for a terminal.
#include "tools/check/words.hpp"

#include <algorithm>
#include <cmath>

#include "base/grouped_text.hpp"
#include "base/text.hpp"
#include "base/units.hpp"
#include "base/words.hpp"
#include "run/runner.hpp"
#include "tools/frame/failure_plane_choice.hpp"

namespace talus {
namespace {

// Volumes by several methods are compared: a digit more.
std::string cubic(double volume) { return grouped_text(volume, 4) + " m3"; }
double azimuth_deg(double azimuth) { return std::fmod(azimuth / degree + 360, 360); }

Json share_json(const FaceShare& share) {
  return {{"mean", share.mean}, {"p10", share.p10}, {"p90", share.p90}};
}

Json kinematics_json(const Kinematics& kinematics) {
  Json sets = Json::array(), pairs = Json::array();
  for (const SetKinematics& set : kinematics.sets)
    sets.push_back({{"set", set.name},
                    {"slides", share_json(set.sliding)},
                    {"slides_within_20_deg", share_json(set.sliding_lateral)},
                    {"topples", share_json(set.toppling)}});
  for (const PairKinematics& pair : kinematics.pairs)
    pairs.push_back(
        {{"sets", kinematics.sets[pair.first].name + " + " + kinematics.sets[pair.second].name},
         {"plunge_deg", pair.wedge.plunge / degree},
         {"trend_deg", azimuth_deg(pair.wedge.trend)},
         {"factor_of_safety", number_or_null(pair.wedge.factor)},
         {"slides_on_both", pair.wedge.on_both},
         {"slides", share_json(pair.sliding)},
         {"columns_topple", share_json(pair.toppling)}});
  return {{"sets", sets}, {"pairs", pairs}};
}

Json source_json(const Look& look) {
  const BlocksWork& work = look.work;
  Json locks = Json::array();
  for (size_t k = 0; k < std::min<size_t>(10, look.peel.locks.size()); ++k)
    locks.push_back({{"block", look.peel.locks[k].block}, {"share", look.peel.locks[k].freed}});
  return {{"polygon_area_m2", area_of(work.area)},
          {"volume_of_blocks_m3", look.volume.cut},
          {"volume_of_prisms_m3", look.volume.prism},
          {"volume_at_nodes_m3", look.volume.nodes},
          {"mean_depth_m", look.mean_depth},
          {"largest_depth_m", look.measure.max_depth},
          {"relief_m", look.relief},
          {"width_m", look.width},
          {"slope_dip_deg", look.slope.dip / degree},
          {"slope_dip_direction_deg", azimuth_deg(look.slope.dip_direction)},
          {"friction_deg", work.planes.friction / degree},
          {"motion_deg", azimuth_deg(look.motion)},
          {"largest_step_at_foot_m", look.step},
          {"share_of_foot_with_a_step", look.step_share},
          {"low_step_m", look.low_step},
          {"share_over_rising_bed", look.rising_share},
          {"factor_of_safety", number_or_null(look.equilibrium.factor)},
          {"peel_off_share", look.peel.share},
          {"locked_share", look.peel.locked_share},
          {"locks", locks}};
}

// "sliding: slides on 80 % of the face (53 % within 20 degrees of its fall line)"
std::string set_text(const SetKinematics& set) {
  const auto with_spread = [](const FaceShare& share) {
    const std::string mean = percent(share.mean);
    return share.p10 == share.p90
               ? mean
               : mean + " (" + percent(share.p10) + " to " + percent(share.p90) + ")";
  };
  std::string words;
  if (set.sliding.mean > 0.005)
    words = "slides on " + with_spread(set.sliding) + " of the face, " +
            percent(set.sliding_lateral.mean) + " within 20 degrees of its fall line";
  if (set.toppling.mean > 0.005)
    words += (words.empty() ? "" : "; ") + ("topples on " + with_spread(set.toppling));
  return words.empty() ? "" : set.name + " " + words;
}

std::string kinematics_text(const Kinematics& kinematics) {
  std::string words;
  const auto add = [&](const std::string& part) {
    if (!part.empty()) words += (words.empty() ? "" : "; ") + part;
  };
  for (const SetKinematics& set : kinematics.sets) add(set_text(set));
  for (const PairKinematics& pair : kinematics.pairs)
    if (pair.sliding.mean > 0.005)
      add(kinematics.sets[pair.first].name + " + " + kinematics.sets[pair.second].name +
          " slide as a wedge on " + percent(pair.sliding.mean) + " of the face");
  return words.empty() ? "no set is free to slide or to topple out of the face" : words;
}

std::string source_text(const Look& look) {
  return "source: " + cubic(look.volume.cut) + " of blocks, " + cubic(look.volume.prism) +
         " by prisms, " + cubic(look.volume.nodes) + " by the mean depth at nodes; " +
         text(look.mean_depth, 3) + " m deep on average, " + text(look.measure.max_depth, 3) +
         " m at most\n" + counted(n_blocks(look.inputs.parts.blocks), "block") + "; slope dips " +
         text(std::round(look.slope.dip / degree)) + " degrees towards " +
         text(std::round(azimuth_deg(look.slope.dip_direction))) + ", friction of the ground " +
         text(std::round(10 * look.work.planes.friction / degree) / 10) + " degrees";
}

// As talus-stability said it.
std::string stability_text(const Look& look) {
  std::string words;
  if (look.stability.is_object())
    for (const Json& sentence : look.stability.at("words"))
      words += "\n  " + sentence.get<std::string>();
  return words;
}

std::string fences_text(const Look& look) {
  std::string words;
  for (const FenceLook& fence : look.fences)
    words += "\n" + std::string(fence.is_dam ? "" : "fence ") + fence.line.name + ": " +
             text(fence.line.chainage.back(), 4) + " m long, base at " +
             text(std::round(fence.low + look.inputs.origin.z())) + " to " +
             text(std::round(fence.high + look.inputs.origin.z())) + " m; " +
             std::to_string(fence.n_fall_lines) + " of " + std::to_string(look.slides.size()) +
             " fall lines come to it";
  return words;
}

std::string objects_text(const Look& look) {
  std::string words;
  for (const ObjectLook& object : look.objects)
    words += "\nobject " + object.object.name + ": " + text(std::round(object.distance)) +
             " m from the mass in plan; " + std::to_string(object.n_fall_lines) + " of " +
             std::to_string(look.slides.size()) + " fall lines come to it";
  return words;
}

std::string seconds_text(double seconds) {
  if (seconds < 90) return text(std::max(1.0, std::round(seconds))) + " s";
  if (seconds < 5400) return text(std::round(seconds / 60)) + " min";
  return text(std::round(seconds / 360) / 10) + " h";
}

}  // namespace

std::string motion_text(const Look& look) {
  std::string words;
  if (look.is_probed)
    words =
        "will it move: " + percent(look.probe.moved_share) +
        (moves_alone(look.work.site) ? " of the rocks move after " : " of the mass moves after ") +
        text(look.probe.time, 3) + " s of the engine: it " +
        text(outlook_of(look.probe.moved_share));
  else
    words = "will it move: no probe of the engine was made";
  words += stability_text(look);
  if (!look.is_cut) return words;
  words += "\n  one block at a time, without a push, " + percent(look.peel.share) +
           " can slide or fall off; " + percent(look.peel.locked_share) + " is locked";
  if (!look.peel.locks.empty())
    words += ": block " + std::to_string(look.peel.locks[0].block) + " alone holds " +
             percent(look.peel.locks[0].freed);
  if (look.step > look.low_step)
    words += "\n  at the foot it leans on a step of up to " + text(look.step, 2) +
             " m, higher than " + text(look.low_step, 2) + " m along " + percent(look.step_share);
  else
    words += look.step > 0.1 ? "\n  at the foot steps are low for the blocks: up to " +
                                   text(look.step, 2) + " m"
                             : "\n  at the foot nothing stands before it";
  if (look.rising_share > 0.005)
    words += "; " + percent(look.rising_share) + " lies over bed that rises against the motion";
  return words + "\n  kinematics of the face: " + kinematics_text(look.kinematics);
}

std::string time_text(const Look& look, std::int64_t n_runs, bool of_this_machine) {
  const Site& site = look.work.site;
  const double dt = time_step(site.solver), n = n_blocks(look.inputs.parts.blocks);
  std::string words = "duration: " + text(site.solver.duration_s, 4) +
                      " s; points that slide from the source ask for " +
                      text(std::ceil(look.travel_duration)) + " s\n";
  if (site.solver.law != "talus") return words + "time: not estimated for law paper";
  const bool may_stand =
      look.is_probed && look.probe.moved_share == 0 && site.solver.end_when_standing;
  const double duration =
      may_stand ? std::min(standing_after_s, site.solver.duration_s) : site.solver.duration_s;
  const double one =
      moves_alone(site) ? expected_cpu_s_alone(n)
      : of_this_machine && look.is_probed && look.probe.time > 0
          ? scaled_cpu_s(look.probe_cpu_s, look.probe.time, probe_step_s, duration, dt)
          : expected_cpu_s(n, duration, dt);
  if (may_stand) words += "a run in which nothing moves ends after 3 s\n";
  words += "time: a run takes about " + seconds_text(one) + " of one core (" +
           seconds_text(one / 2.5) + " to " + seconds_text(one * 2.5) + ")";
  if (n_runs > 1)
    words += ", " + std::to_string(n_runs) + " runs about " +
             seconds_text(one * static_cast<double>(n_runs)) + " divided by the cores";
  return words;
}

Json check_json(const Look& look, const std::string& run_id) {
  const Site& site = look.work.site;
  Json fences = Json::array();
  for (const FenceLook& fence : look.fences)
    fences.push_back({{"fence", fence.line.name},
                      {"stands", fence.stands},
                      {"length_m", fence.line.chainage.back()},
                      {"lowest_base_m", fence.low + look.inputs.origin.z()},
                      {"highest_base_m", fence.high + look.inputs.origin.z()},
                      {"fall_lines", fence.n_fall_lines}});
  Json objects = Json::array(), outlines = Json::array();
  for (const ObjectLook& object : look.objects)
    objects.push_back({{"object", object.object.name},
                       {"kind", object.object.kind},
                       {"distance_m", object.distance},
                       {"fall_lines", object.n_fall_lines}});
  for (const OutlinedSurface& surface : look.surfaces)
    outlines.push_back(outline_json(surface, look.inputs.origin));
  Json json = {{"tool", "talus-check"},
               {"site", site.info.name},
               {"run_id", run_id},
               {"n_blocks", n_blocks(look.inputs.parts.blocks)}};
  if (look.is_cut) {
    json["source"] = source_json(look);
    json["kinematics"] = kinematics_json(look.kinematics);
    json["kinematics_of_3x3_means"] = kinematics_json(look.smooth_kinematics);
    json["outlines"] = outlines;
    json["failure_planes"] =
        planes_json(look.work.planes, look.work.wedges, look.work.wedge, look.inputs.origin);
  }
  if (look.is_probed)
    json["probe"] = {{"time_s", look.probe.time},
                     {"moved_share", look.probe.moved_share},
                     {"outlook", text(outlook_of(look.probe.moved_share))},
                     {"fault", look.probe.fault.empty() ? Json() : Json(look.probe.fault)}};
  json["fall_lines"] = {{"n", look.slides.size()}, {"duration_asked_for_s", look.travel_duration}};
  if (look.stability.is_object()) json["stability"] = look.stability.at("groups");
  json["fences"] = fences;
  json["objects"] = objects;
  if (site.solver.law == "talus")
    json["expected_cpu_s"] = moves_alone(site)
                                 ? expected_cpu_s_alone(n_blocks(look.inputs.parts.blocks))
                                 : expected_cpu_s(n_blocks(look.inputs.parts.blocks),
                                                  site.solver.duration_s, time_step(site.solver));
  return json;
}

std::string check_text(const Look& look, const std::vector<Doubt>& doubts, std::int64_t n_runs) {
  std::string words =
      look.is_cut ? source_text(look) : counted(n_blocks(look.inputs.parts.blocks), "block");
  words += "\n" + motion_text(look) + fences_text(look) + objects_text(look) + "\n" +
           time_text(look, n_runs, true);
  return words + "\n" + counted(std::ssize(doubts), "doubt");
}

}  // namespace talus
