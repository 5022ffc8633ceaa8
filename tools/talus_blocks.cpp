// tools/talus_blocks.cpp
// The blocks of a site: the source cut by its joints, or bodies from meshes and shapes. Page:
// docs/tools/talus-blocks.md
#include <cmath>
#include <filesystem>
#include <numbers>

#include "base/grouped_text.hpp"
#include "base/percentile.hpp"
#include "base/read_file.hpp"
#include "base/sha256.hpp"
#include "base/text.hpp"
#include "blocks/assemble.hpp"
#include "blocks/solid.hpp"
#include "blocks_placed.hpp"
#include "io/block_pictures.hpp"
#include "io/blocks_hdf5.hpp"
#include "io/crs_gdal.hpp"
#include "io/footprints_gdal.hpp"
#include "io/mesh.hpp"
#include "io/raster_gdal.hpp"
#include "io/vectors_gdal.hpp"
#include "scene/joint_plan.hpp"
#include "site_crs.hpp"
#include "site_options.hpp"
#include "terrain/trn_digest.hpp"
#include "tool.hpp"

namespace {

using namespace talus;  // NOLINT: a program of its own

constexpr double degree = std::numbers::pi / 180;

struct Options {
  std::string trn, out, report, footprints, obj_folder, trn_out, stereonet, size_curve;
  bool exact = false;
};

void declare(Tool& tool, Options& o) {
  tool.input("--trn", o.trn, "terrain before the slide (talus-trn)")->required();
  tool.output("-o,--out", o.out, "block set to write (HDF5)")->required();
  tool.app().add_flag("--exact", o.exact,
                      "keep blocks as they are cut, non-convex at the ground, as unions of convex "
                      "parts; default: convex inside their joint cell");
  tool.output("--trn-out", o.trn_out,
              "terrain lowered to the failure surface, the bed that the blocks lie on (GeoTIFF)");
  tool.output("--report", o.report, "volumes, sizes, shapes, joints (JSON)");
  tool.output("--footprints", o.footprints, "plan outlines of the blocks (GeoPackage)");
  tool.output("--stereonet", o.stereonet, "poles and mean planes of the joints (SVG)");
  tool.output("--size-curve", o.size_curve, "size distribution of the blocks (SVG)");
  tool.output_folder("--obj", o.obj_folder, "folder for one OBJ file a block, map coordinates");
  tool.footer(
      "Example:\n  talus-blocks site.toml --trn slope.tif -o blocks.h5 --trn-out bed.tif "
      "--footprints blocks.gpkg --report blocks.json");
}

// What the run works on, filled step by step.
struct Work {
  Site site;
  Trn ground;
  Area area;
  SourceMass mass;
  std::vector<PlannedSet> sets;
  std::vector<Joint> joints;
  AssembleOptions limits;
  AssembleReport cut;
  BlockSet blocks;
  double expected = 0;
  // A site of bodies from elsewhere may have [source] for max_blocks alone.
  [[nodiscard]] bool has_source() const {
    const bool is_given =
        std::find(site.sections.begin(), site.sections.end(), "source") != site.sections.end();
    const bool has_area = !site.source.polygon.empty() || !site.source.polygon_file.empty();
    return is_given && (has_area || site.blocks.empty() || !site.joints.empty());
  }
  // The source polygon may also only say where bodies are released from.
  [[nodiscard]] bool is_cut() const {
    return has_source() && (site.blocks.empty() || !site.joints.empty());
  }
};

// --- the source --------------------------------------------------------------------------------

Area read_area(Tool& tool, const Work& work) {
  const SourceSettings& source = work.site.source;
  if (source.polygon.empty() == source.polygon_file.empty())
    throw InputError({work.site.file},
                     source.polygon.empty() ? "[source] has neither polygon nor polygon_file"
                                            : "[source] has both polygon and polygon_file",
                     "say where the source is, once");
  Area area;
  const auto add_ring = [&](const std::vector<Vec3>& local) {
    area.rings.emplace_back();
    for (const Vec3& p : local) area.rings.back().emplace_back(p.head<2>());
  };
  if (!source.polygon.empty()) {
    add_ring(local_points({tool, work.site, work.ground}, source.polygon, "source.polygon"));
    return without_repeated_corners(area);
  }
  const std::string path = resolved(work.site, source.polygon_file);
  tool.read_also("source.polygon_file", path);
  const VectorShapes found =
      read_vectors({path, source.polygon_layer, "", VectorKind::areas}, work.ground.crs_wkt);
  if (!found.source_crs.empty())
    tool.info(path + ": reprojected from " + crs_name(found.source_crs));
  for (std::vector<Vec3> ring : found.shapes) {
    for (Vec3& p : ring) p -= work.ground.origin;
    add_ring(ring);
  }
  return without_repeated_corners(area);
}

Where where_of_area(const Work& work) {
  return work.site.source.polygon.empty()
             ? Where{resolved(work.site, work.site.source.polygon_file)}
             : where_of(work.site, "source.polygon");
}

// Elevations of the failure raster at the nodes of the terrain.
std::vector<double> read_failure_raster(Tool& tool, const Work& work) {
  const std::string path = resolved(work.site, work.site.source.raster);
  tool.read_also("source.raster", path);
  DemOptions options;
  options.crs_may_be_missing = true;
  const DemFile raster(path, options);
  if (!raster.crs_wkt().empty() && !work.ground.crs_wkt.empty() &&
      !same_crs(raster.crs_wkt(), work.ground.crs_wkt))
    throw InputError({path},
                     "the CRS is " + crs_name(raster.crs_wkt()) + ", that of the terrain is " +
                         crs_name(work.ground.crs_wkt),
                     "a raster is never reprojected silently: gdalwarp -t_srs");
  std::vector<double> z = read_dem(raster, frame_of(work.ground));
  for (double& value : z) value -= work.ground.origin.z();
  return z;
}

void find_mass(Tool& tool, Work& work) {
  SourceOptions options = plan_source(work.site, work.ground.origin);
  if (options.kind == FailureSurface::plane) {
    const auto& p = work.site.source.plane_point_m;
    options.plane_point = local_points({tool, work.site, work.ground}, {Vec3(p[0], p[1], p[2])},
                                       "source.plane_point_m")[0];
  }
  if (options.kind == FailureSurface::raster) options.raster = read_failure_raster(tool, work);
  work.mass = find_source(work.ground, work.area, options, where_of_area(work));
  if (work.mass.n_above_ground > 0)
    tool.info("the failure surface lies above the ground at " +
              std::to_string(work.mass.n_above_ground) + " nodes inside the source: no mass there");
}

// --- joints ------------------------------------------------------------------------------------

void plan_joints(Tool& tool, Work& work) {
  std::vector<std::vector<Vec3>> measured;
  for (const JointSettings& section : work.site.joints) {
    measured.emplace_back();
    if (section.measured_file.empty()) continue;
    const std::string path = resolved(work.site, section.measured_file);
    tool.read_also("joints." + section.name, path);
    measured.back() = parse_orientations(read_file(path), path);
  }
  work.sets = plan_joint_sets(work.site, measured);
  std::vector<JointSet> sets;
  for (const PlannedSet& planned : work.sets) sets.push_back(planned.set);
  work.expected = expected_cells(sets, measure_mass(work.ground, work.mass.bed));
  const auto most = static_cast<double>(work.site.source.max_blocks);
  if (work.expected > most)
    throw InputError(where_of(work.site, "source.max_blocks"),
                     "the joints would cut " + text(work.mass.volume, 4) + " m3 into about " +
                         text(std::round(work.expected)) + " blocks, expected at most " +
                         text(most),
                     "widen the spacings, or set source.max_blocks to what your machine can take");
}

// The ball around the mass, which the joints must cross.
void draw_all_joints(Work& work) {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const int node : work.mass.nodes) {
    const int r = node / work.ground.n_cols, c = node % work.ground.n_cols;
    for (int dr = -1; dr <= 1; ++dr)
      for (int dc = -1; dc <= 1; ++dc)
        for (const Trn* trn : {&work.ground, &work.mass.bed}) {
          const Vec3 p = node_point(*trn, r + dr, c + dc);
          low = low.cwiseMin(p), high = high.cwiseMax(p);
        }
  }
  const Vec3 centre = (low + high) / 2;
  for (size_t s = 0; s < work.sets.size(); ++s)
    for (Joint& joint :
         draw_joints(work.sets[s].set, static_cast<int>(s), centre, (high - low).norm() / 2,
                     static_cast<std::uint64_t>(work.site.source.seed)))
      work.joints.push_back(std::move(joint));
}

std::string why_in_one_piece(const Work& work) {
  if (work.sets.empty()) return "there are no [joints.*]";
  if (work.joints.empty()) return "no joint crosses it: the spacings are wider than the mass";
  const bool all_partial = std::none_of(work.joints.begin(), work.joints.end(),
                                        [](const Joint& j) { return j.is_through; });
  if (all_partial)
    return "no joint is persistent enough to part it; see persistence and disc_diameter_m";
  return "the joints that cross it leave no piece large enough to stand alone";
}

void cut(Tool& tool, const Options& o, Work& work) {
  find_mass(tool, work);
  plan_joints(tool, work);
  draw_all_joints(work);
  work.limits = plan_limits(work.site, work.sets, work.mass.volume, work.expected);
  work.limits.exact = o.exact;
  for (const PlannedSet& planned : work.sets)
    work.blocks.joint_set_names.push_back(planned.set.name);
  const ProgressFunction progress = tool.progress();
  const CellComplex complex = cut_mass(work.ground, work.mass.bed, work.joints,
                                       [&](double share) { progress(0.5 * share); });
  work.cut = assemble_blocks(complex, work.joints, work.mass.bed, work.limits, work.blocks,
                             [&](double share) { progress(0.5 + 0.5 * share); });
  if (complex.n_uncut > 0)
    tool.warn(std::to_string(complex.n_uncut) + " cells could not be cut and stayed in one piece");
  if (work.cut.n_dropped > 0)
    tool.warn(std::to_string(work.cut.n_dropped) + " slivers without a neighbour were left out, " +
              text(work.cut.dropped_volume, 3) + " m3 in all");
  if (work.cut.n_below_limits > 0)
    tool.warn(std::to_string(work.cut.n_below_limits) +
              " blocks are below the limits for slivers after they were made convex");
  if (work.cut.n_short_edged > 0)
    tool.warn(std::to_string(work.cut.n_short_edged) +
              " blocks keep edges that are shorter than min_block_edge_m: without them they would "
              "lose too much of their volume");
  if (n_blocks(work.blocks) == 1)
    tool.warn("the mass stays in one piece: " + why_in_one_piece(work));
  if (n_blocks(work.blocks) == 0)
    throw InputError({work.site.file}, "no block is left",
                     "min_block_volume_m3 or min_block_thickness_m leave out all of the mass");
  const double error = std::abs(work.cut.cut_volume - work.mass.volume) / work.mass.volume;
  tool.check("volume_error", error, 1e-9, error <= 1e-9);
}

// --- report ------------------------------------------------------------------------------------

Json as_json(const Attitude& a) {
  return {{"dip_deg", a.dip / degree}, {"dip_direction_deg", a.dip_direction / degree}};
}

std::vector<Vec3> poles_of(const Work& work, int set) {
  std::vector<Vec3> poles = work.sets[set].measured_poles;
  if (poles.empty())
    for (const Joint& joint : work.joints)
      if (joint.set == set) poles.push_back(joint.plane.normal);
  return poles;
}

Json joints_json(const Work& work) {
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

double quantile(const std::vector<double>& values, double share) {
  std::vector<WeightedValue> sorted;
  for (const double value : values) sorted.push_back({value});
  sort_values(sorted);
  return weighted_percentile(sorted, share);
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
    return Json{{"p10", quantile(values, 0.1)},
                {"p50", quantile(values, 0.5)},
                {"p90", quantile(values, 0.9)},
                {"largest", quantile(values, 1)}};
  };
  return {{"longest_to_middle", three(elongation)},
          {"middle_to_shortest", three(flatness)},
          {"hull_to_volume", three(hull_ratio)}};
}

Json cut_json(const Options& o, const Work& work) {
  const AssembleReport& cut = work.cut;
  Json rows = {{"exact", o.exact},
               {"failure_surface", work.site.source.failure_surface},
               {"prism_volume_m3", work.mass.volume},
               {"polygon_area_m2", work.mass.polygon_area},
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
  if (source.failure_surface == "slbl") {
    rows["slbl_curvature_m"] = source.slbl_curvature_m;
    if (!std::isnan(source.slbl_max_depth_m)) rows["slbl_max_depth_m"] = source.slbl_max_depth_m;
  }
  return rows;
}

Json report_on(Tool& tool, const Options& o, const Work& work) {
  const BlockSet& set = work.blocks;
  double total = 0, area = 0;
  for (const double volume : set.volume) total += volume;
  for (const double shared : set.pair_area) area += shared;
  Json report = {{"tool", "talus-blocks"},
                 {"site", work.site.info.name},
                 {"run_id", tool.run_id()},
                 {"n_blocks", n_blocks(set)},
                 {"n_convex_parts", n_parts(set)},
                 {"volume_m3", total},
                 {"sizes", sizes_json(set)},
                 {"shapes", shapes_json(set)},
                 {"n_pairs", set.pair_blocks.size()},
                 {"shared_area_m2", area}};
  if (work.is_cut()) {
    report["cut"] = cut_json(o, work);
    report["joints"] = joints_json(work);
  }
  return report;
}

std::string summary_of(const Json& report) {
  const auto number = [](const Json& value) { return grouped_text(value.get<double>(), 4); };
  const Json& sizes = report["sizes"];
  std::string lines = std::to_string(report["n_blocks"].get<int>()) + " blocks, " +
                      number(report["volume_m3"]) + " m3; V10 " + number(sizes["v10_m3"]) +
                      ", V50 " + number(sizes["v50_m3"]) + ", V90 " + number(sizes["v90_m3"]) +
                      ", largest " + number(sizes["largest_m3"]) + " m3; shortest edge " +
                      number(sizes["shortest_edge_m"]) + " m";
  if (!report.contains("cut")) return lines;
  const Json& cut = report["cut"];
  lines += "\nmass " + number(cut["prism_volume_m3"]) + " m3, " + number(cut["mean_depth_m"]) +
           " m deep on average (vertically), in " + std::to_string(cut["n_pieces"].get<int>()) +
           " pieces; " + std::to_string(cut["n_slivers_merged"].get<int>()) + " slivers (" +
           number(cut["slivers_merged_m3"]) + " m3) given to a neighbour";
  if (!cut["exact"].get<bool>())
    lines += "\nmade convex: volume " + text(100 * cut["convexified_change"].get<double>(), 3) +
             " %, " + std::to_string(cut["n_divided"].get<int>()) +
             " blocks as several convex parts, " + std::to_string(cut["n_kept_exact"].get<int>()) +
             " kept exact";
  return lines;
}

void record_metrics(Tool& tool, const Json& report) {
  tool.metric("n_blocks", report["n_blocks"].get<double>(), "1");
  tool.metric("volume_m3", report["volume_m3"].get<double>(), "m3");
  if (report.contains("cut"))
    tool.metric("convexified_change", report["cut"]["convexified_change"].get<double>(), "1");
}

// --- output ------------------------------------------------------------------------------------

// Mean upward normal of the ground over the source, for the stereonet.
Vec3 slope_normal(const Work& work) {
  Vec3 sum = Vec3::Zero();
  for (int t = 0; t < n_triangles(work.ground); ++t) {
    const auto p = triangle_corners(work.ground, t);
    const Vec3 middle = (p[0] + p[1] + p[2]) / 3;
    if (is_known(work.ground, t) && contains(work.area, Vec2(middle.x(), middle.y())))
      sum += triangle_plane(work.ground, t).normal;
  }
  return sum.squaredNorm() > 0 ? Vec3(sum.normalized()) : Vec3::Zero();
}

void write_pictures(Tool& tool, const Options& o, const Work& work) {
  if (!o.stereonet.empty()) {
    std::vector<NetSet> sets;
    for (int s = 0; s < static_cast<int>(work.sets.size()); ++s)
      sets.push_back({work.sets[s].set.name,
                      pole(work.sets[s].set.dip, work.sets[s].set.dip_direction),
                      poles_of(work, s)});
    tool.write_text(o.stereonet, stereonet_svg(sets, slope_normal(work)));
  }
  if (!o.size_curve.empty()) tool.write_text(o.size_curve, size_curve_svg(work.blocks.volume));
}

std::string obj_name(int block) {
  std::string number = std::to_string(block);
  number.insert(0, 6 - std::min<size_t>(6, number.size()), '0');
  return "block_" + number;
}

void write_objs(Tool& tool, const Options& o, const BlockSet& set) {
  const auto path = [&](int b) { return o.obj_folder + "/" + obj_name(b) + ".obj"; };
  for (int b = 0; b < n_blocks(set); ++b)
    tool.write_text(path(b), obj_text(block_surfaces(set, b), obj_name(b), set.origin));
  // Those of an earlier run with more blocks do not belong to these.
  if (!tool.overwrite()) return;
  int old = n_blocks(set);
  while (std::filesystem::remove(path(old))) ++old;
}

void write_all(Tool& tool, const Options& o, const Work& work, const Json& report) {
  write_blocks(tool.stage(o.out), work.blocks, {{"RUN_ID", tool.run_id()}});
  if (!o.trn_out.empty())
    write_trn(tool.stage(o.trn_out), work.is_cut() ? work.mass.bed : work.ground,
              {{{"RUN_ID", tool.run_id()}}, {}});
  if (!o.footprints.empty()) {
    std::vector<std::vector<Vec2>> rings = work.area.rings;
    for (auto& ring : rings)
      for (Vec2& p : ring) p += work.ground.origin.head<2>();
    write_footprints(tool.stage(o.footprints), work.blocks, rings, {{"RUN_ID", tool.run_id()}});
  }
  write_pictures(tool, o, work);
  if (!o.obj_folder.empty()) write_objs(tool, o, work.blocks);
  if (!o.report.empty()) tool.write_text(o.report, report.dump(2) + "\n");
}

std::string hash_of(const Options& o, const Work& work) {
  Sha256 hash;
  const auto add = [&hash](const std::string& words) { hash.add(words.c_str(), words.size() + 1); };
  add(sha256_of_file(o.trn));
  add(o.exact ? "exact" : "convex");
  for (const EffectiveValue& entry : effective_values(work.site))
    add(entry.section + "." + entry.key + "=" + entry.value);
  for (const Vec3& v : work.blocks.vertices) hash.add(v.data(), sizeof v);
  return hash.hex();
}

void check_ground(const Work& work, const std::string& path) {
  const Vec2 place = (work.ground.origin.head<2>() + work.ground.node0).eval();
  if (work.ground.crs_wkt.empty()) return;
  const CrsProblem problem = find_crs_problem(work.ground.crs_wkt, place);
  if (!problem.finding.empty())
    throw InputError(
        {path}, problem.finding,
        problem.mend_to.empty() ? "" : "reproject it: talus-trn --t-srs " + problem.mend_to);
}

}  // namespace

int main(int argc, char** argv) {
  Options o;
  Tool tool("talus-blocks",
            "Cuts the rock mass of a source into blocks by its joints, or takes blocks from "
            "meshes and shapes.");
  SiteOptions site(tool);
  declare(tool, o);
  return tool.run(argc, argv, [&] {
    Work work;
    work.site = site.load();
    check_site_crs(work.site);
    work.ground = read_trn(o.trn);
    check_ground(work, o.trn);
    work.blocks.origin = work.ground.origin;
    work.blocks.crs_wkt = work.ground.crs_wkt;
    for (const MaterialSettings& material : work.site.materials)
      work.blocks.material_names.push_back(material.name);
    if (!work.has_source() && work.site.blocks.empty())
      throw InputError({work.site.file}, "there is neither [source] nor [blocks.*]",
                       "say what moves: a source to be cut, or blocks");
    if (work.has_source()) {
      work.area = read_area(tool, work);
      check_area(work.area, work.ground.origin, where_of_area(work));
    }
    if (work.is_cut()) cut(tool, o, work);
    add_placed_blocks({tool, work.site, work.ground, work.has_source() ? &work.area : nullptr},
                      work.blocks);
    work.blocks.content_hash = hash_of(o, work);
    work.blocks.ground_digests = {trn_digest(work.ground)};
    if (work.is_cut()) work.blocks.ground_digests = {trn_digest(work.mass.bed)};
    const Json report = report_on(tool, o, work);
    record_metrics(tool, report);
    write_all(tool, o, work, report);
    tool.result(report, summary_of(report));
  });
}
