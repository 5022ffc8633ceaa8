// Properties of blocks as JSON and in words: volumes, sizes, shapes, the cut and its joints.
#include "tools/blocks/json.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/grouped_text.hpp"
#include "base/percentile.hpp"
#include "base/text.hpp"
#include "base/units.hpp"
#include "base/words.hpp"
#include "blocks/solid.hpp"
#include "io/block_pictures.hpp"
#include "tools/frame/failure_plane_choice.hpp"

namespace talus {
namespace {

Json as_json(const Attitude& a) {
  return {{"dip_deg", a.dip / degree}, {"dip_direction_deg", a.dip_direction / degree}};
}

Json joints_json(const BlocksWork& work) {
  Json rows = Json::array();
  for (int s = 0; s < static_cast<int>(work.sets.size()); ++s) {
    const JointSet& set = work.sets[s].set;
    const auto n = std::count_if(work.joints.begin(), work.joints.end(),
                                 [s](const Joint& joint) { return joint.set == s; });
    double area = 0;
    for (size_t p = 0; p < work.blocks.pair_area.size(); ++p)
      if (work.blocks.pair_joint_set[p] == s) area += work.blocks.pair_area[p];
    Json row = {{"name", set.name}};
    row.update(as_json(Attitude{set.dip, set.dip_direction}));
    row["mean_spacing_m"] = set.mean_spacing;
    row["fisher_k"] = set.fisher_k;
    row["persistence"] = set.persistence;
    row["n_measured"] = work.sets[s].measured_poles.size();
    row["n_joints"] = n;
    row["shared_area_m2"] = area;
    rows.push_back(std::move(row));
  }
  return rows;
}

Json sizes_json(const BlockSet& set) {
  std::vector<double> volumes = set.volume;
  std::sort(volumes.begin(), volumes.end());
  double shortest = std::numeric_limits<double>::infinity();
  for (int b = 0; b < n_blocks(set); ++b)
    shortest = std::min(shortest, shortest_edge(block_shell(set, b)));
  return {{"v10_m3", volume_quantile(volumes, 0.1)},
          {"v50_m3", volume_quantile(volumes, 0.5)},
          {"v90_m3", volume_quantile(volumes, 0.9)},
          {"smallest_m3", volumes.front()},
          {"largest_m3", volumes.back()},
          {"shortest_edge_m", shortest}};
}

Json shapes_json(const BlockSet& set) {
  std::vector<double> elongation, flatness, hull_ratio;
  for (int b = 0; b < n_blocks(set); ++b) {
    const Vec3 size = extents({set.volume[b], set.centroid[b], set.second_moment[b]});
    elongation.push_back(size.x() / size.y());
    flatness.push_back(size.y() / size.z());
    const bool is_convex_block = set.convex_part_begin[b + 1] - set.convex_part_begin[b] == 1;
    hull_ratio.push_back(
        is_convex_block ? 1
                        : moments(convex_hull(block_shell(set, b).vertices, face_terrain)).volume /
                              set.volume[b]);
  }
  const auto three = [](const std::vector<double>& values) {
    return Json{{"p10", percentile(values, 0.1)},
                {"p50", percentile(values, 0.5)},
                {"p90", percentile(values, 0.9)},
                {"largest", percentile(values, 1)}};
  };
  return {{"longest_to_middle", three(elongation)},
          {"middle_to_shortest", three(flatness)},
          {"hull_to_volume", three(hull_ratio)}};
}

Json cut_json(const BlocksWork& work) {
  const AssembleReport& cut = work.cut;
  Json rows = {{"exact", work.limits.exact},
               {"failure_surface", work.site.source.failure_surface},
               {"prism_volume_m3", work.mass.volume},
               {"polygon_area_m2", work.mass.polygon_area},
               {"mass_area_m2", work.mass.area},
               {"mass_area_share", work.mass.area / work.mass.polygon_area},
               {"mean_depth_m", work.mass.mean_depth},
               {"largest_depth_m", work.mass.max_depth},
               {"expected_blocks", work.expected},
               {"n_cells", cut.n_cells},
               {"n_pieces", cut.n_pieces},
               {"cut_volume_m3", cut.cut_volume},
               {"volume_error", (cut.cut_volume - work.mass.volume) / work.mass.volume},
               {"block_volume_m3", cut.block_volume},
               {"n_slivers_merged", cut.n_merged},
               {"slivers_merged_m3", cut.merged_volume},
               {"n_slivers_left_out", cut.n_dropped},
               {"slivers_left_out_m3", cut.dropped_volume},
               {"sliver_limits",
                {{"volume_m3", work.limits.min_volume},
                 {"thickness_m", work.limits.min_thickness},
                 {"aspect", work.limits.max_aspect}}},
               {"n_rings_parted", cut.n_rings_parted},
               {"n_divided", cut.n_divided},
               {"n_kept_exact", cut.n_kept_exact},
               {"n_below_limits", cut.n_below_limits},
               {"n_short_edged", cut.n_short_edged},
               {"convexified_lost_m3", cut.lost},
               {"convexified_gained_m3", cut.gained},
               {"convexified_change",
                (cut.block_volume + cut.dropped_volume - cut.cut_volume) / cut.cut_volume}};
  const SourceSettings& source = work.site.source;
  if (source.failure_surface == "daylighting")
    rows["failure_planes"] = planes_json(work.planes, work.wedges, work.wedge, work.ground.origin);
  if (source.failure_surface == "plane") {
    rows["free_share_of_foot"] = work.at_foot.free_share;
    rows["largest_step_at_foot_m"] = work.at_foot.largest_step;
  }
  if (!source.daylight.empty()) {
    rows["daylight"] = source.daylight;
    rows["hollow_volume_m3"] = work.hollow_volume;
    rows["leans_on_the_foot_m3"] = work.hollow_volume - work.mass.volume;
  }
  if (source.failure_surface == "slbl") {
    rows["slbl_curvature_m"] = work.slbl_curvature;
    if (!std::isnan(source.slbl_max_depth_m)) rows["slbl_max_depth_m"] = source.slbl_max_depth_m;
  }
  return rows;
}

}  // namespace

Json blocks_json(const BlocksWork& work, const std::string& run_id) {
  const BlockSet& set = work.blocks;
  double total = 0, area = 0;
  for (const double volume : set.volume) total += volume;
  for (const double shared : set.pair_area) area += shared;
  Json report = {{"tool", "talus-blocks"},
                 {"site", work.site.info.name},
                 {"run_id", run_id},
                 {"n_blocks", n_blocks(set)},
                 {"n_convex_parts", n_parts(set)},
                 {"volume_m3", total},
                 {"sizes", sizes_json(set)},
                 {"shapes", shapes_json(set)},
                 {"n_pairs", set.pair_blocks.size()},
                 {"shared_area_m2", area}};
  if (!work.accepted_doubts.empty()) report["accepted_places"] = work.accepted_doubts;
  if (work.is_cut()) {
    report["cut"] = cut_json(work);
    report["joints"] = joints_json(work);
  }
  return report;
}

std::string blocks_summary(const Json& report) {
  const auto number = [](const Json& value) { return grouped_text(value.get<double>()); };
  const Json& sizes = report["sizes"];
  std::string lines = counted(report["n_blocks"].get<int>(), "block") + ", " +
                      number(report["volume_m3"]) + " m3; V10 " + number(sizes["v10_m3"]) +
                      ", V50 " + number(sizes["v50_m3"]) + ", V90 " + number(sizes["v90_m3"]) +
                      ", largest " + number(sizes["largest_m3"]) + " m3; shortest edge " +
                      number(sizes["shortest_edge_m"]) + " m";
  if (!report.contains("cut")) return lines;
  const Json& cut = report["cut"];
  if (cut.contains("failure_planes")) lines += "\n" + best_plane_text(cut["failure_planes"]);
  lines += "\nmass " + number(cut["prism_volume_m3"]) + " m3, " + number(cut["mean_depth_m"]) +
           " m deep on average (vertically), in " + counted(cut["n_pieces"].get<int>(), "piece") +
           "; " + counted(cut["n_slivers_merged"].get<int>(), "sliver") + " (" +
           number(cut["slivers_merged_m3"]) + " m3) given to a neighbour";
  lines += "\nthe mass covers " + number(cut["mass_area_m2"]) + " m2, " +
           percent(cut["mass_area_share"].get<double>()) + " of the polygon of " +
           number(cut["polygon_area_m2"]) + " m2";
  if (!cut["exact"].get<bool>())
    lines += "\nmade convex: volume " + percent(cut["convexified_change"].get<double>()) + ", " +
             counted(cut["n_divided"].get<int>(), "block") + " as several convex parts, " +
             std::to_string(cut["n_kept_exact"].get<int>()) + " kept exact";
  return lines;
}

}  // namespace talus
