// tools/tin/talus_tin.cpp
// Contour lines to a triangulated irregular network. Page: docs/tools/talus-tin.md
#if __has_include(<malloc.h>)
#include <malloc.h>
#endif

#include "base/memory.hpp"
#include "base/text.hpp"
#include "base/words.hpp"
#include "import/import_inputs_gdal.hpp"
#include "io/crs_gdal.hpp"
#include "io/geopackage_gdal.hpp"
#include "io/tin_ply.hpp"
#include "terrain/flat.hpp"
#include "terrain/outliers.hpp"
#include "terrain/point_tin.hpp"
#include "terrain/tin_mesh.hpp"
#include "tools/frame/command_line.hpp"
#include "tools/frame/import_options.hpp"
#include "tools/frame/tool.hpp"
#include "tools/tin/doubts.hpp"

namespace {

using talus::ContourMap;
using talus::InputError;
using talus::Json;
using talus::percent;
using talus::text;
using talus::Tool;
using talus::UsageError;

struct Options {
  talus::ImportOptions inputs;
  talus::InputsRequest request;
  std::string out, report, hold_out;
  std::string flat = "fill";
  double fill_spacing_m = 0;
  int hold_out_every = 0;
  talus::TinDoubtOptions doubts;
};

std::string check_every(const std::string& word) {
  double value = 0;
  if (talus::parse_double(word, value) && value >= 2 && value == static_cast<int>(value)) return {};
  return word + " is not a step, expected a whole number of 2 or more";
}

void declare(Tool& tool, Options& o) {
  tool.input("contours", o.inputs.contours.path,
             "contour lines (any vector source that GDAL reads)");
  talus::declare_import_options(tool, o.inputs);
  tool.output("-o,--out", o.out, "TIN to write (binary PLY)").required();
  tool.option("--flat", o.flat, "flat triangles on summits, ridges, valley floors: fill or keep")
      .one_of({"fill", "keep"});
  tool.option("--fill-spacing-m", o.fill_spacing_m,
              "distance of the points that mend flat triangles [m]; 0: from the map")
      .check(talus::check_not_negative);
  tool.option("--hold-out-every", o.hold_out_every,
              "hold back the contours at every K-th height, K >= 2; 0: none")
      .check(check_every);
  tool.output("--hold-out", o.hold_out, "points of the contours held back (GeoPackage)");
  tool.option("--tolerance-m", o.doubts.tolerance_m,
              "contours of different heights that meet are moved apart by at most this [m]; "
              "0: refused; not given: the accuracy that their bends show")
      .check(talus::check_not_negative);
  talus::declare_doubts(tool, o.doubts, "take heights that cannot be, and say so");
  tool.output("--report", o.report, "what was read, cleaned and mended (JSON)");
  tool.footer(
      "Example:\n  talus-tin contours.gpkg -o slope.tin.ply --report slope.tin.json\n"
      "  talus-tin map.dxf -o slope.tin.ply --crs EPSG:31287 --spots heights.gpkg");
}

// --- steps ---------------------------------------------------------------------------------------

void check_together(const Options& o) {
  if ((o.hold_out_every > 0) == !o.hold_out.empty()) return;
  throw UsageError({"", 0, o.hold_out.empty() ? "--hold-out-every" : "--hold-out"},
                   "--hold-out-every and --hold-out go together, only one is given");
}

ContourMap read_map(Tool& tool, Options& o, talus::ImportReading& reading) {
  ContourMap map = talus::import_map(o.request, reading);
  o.doubts.crs_wkt = map.crs_wkt;
  if (!o.inputs.of_points) talus::check_heights(map);
  tool.content_read("map", talus::map_digest(map));
  talus::say_reading(tool, reading);
  return map;
}

void write_points(const std::string& path, const ContourMap& map,
                  const std::vector<talus::Vec3>& points) {
  talus::VectorLayer layer;
  layer.name = "held_back";
  layer.description = "points of the contours held back";
  for (const talus::Vec3& point : points)
    layer.features.emplace_back().points = {point + map.origin};
  talus::write_geopackage(path, map.crs_wkt, {layer});
}

// Arrays of a large map each get pages of their own, which go back to the system with them; smaller
// ones stay for the next step. By default glibc keeps arrays of up to 32 MB, which then
// fragment the heap.
void keep_large_arrays_apart() {
#ifdef __GLIBC__
  mallopt(M_MMAP_THRESHOLD, 12 << 20);
  mallopt(M_TRIM_THRESHOLD, 128 << 20);
#endif
}

// Returns freed memory to the system, so that the next step does not add to it.
void give_memory_back() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

// Of a file that talus-import wrote, the file itself.
const std::string& file_of_boundary(const Options& o) {
  return o.inputs.boundary.path.empty() ? o.inputs.contours.path : o.inputs.boundary.path;
}

// Brings the mesh up to date, inside the boundary.
void refresh_inside(const ContourMap& map, talus::Triangulation& triangulation, const Options& o,
                    bool only_triangles, talus::TriangleMesh& mesh) {
  triangulation.refresh(mesh, only_triangles);
  talus::cut_to_rings(map.boundary, mesh);
  if (mesh.triangles.empty())
    throw InputError({file_of_boundary(o)}, "the boundary and the contours share no ground");
}

// The rim of a map has no triangles where its last contours end.
void doubt_missing_part(Tool& tool, const Options& o, const ContourMap& map, double covered_m2) {
  constexpr double share_of_rim = 0.05;
  const double asked_m2 = talus::area_of(map.boundary);
  if (!(covered_m2 < (1 - share_of_rim) * asked_m2)) return;
  tool.doubts({talus::doubt_on(
      {file_of_boundary(o)},
      "the boundary reaches beyond the data: " + percent(1 - covered_m2 / asked_m2) + " of its " +
          text(asked_m2 / 10'000, 3) + " ha is missing",
      "draw it around the part that is there, or add the data of the rest")});
}

Json cleaning_json(const talus::CleaningCounts& c) {
  return {{"duplicate_points", c.duplicate_points},
          {"duplicate_segments", c.duplicate_segments},
          {"touches_at_one_height", c.touches},
          {"crossings_at_one_height", c.crossings},
          {"lines_of_one_point", c.single_points},
          {"breaklines_and_spots_on_contours", c.breakline_meetings},
          {"breaklines_and_spots_apart", c.measured_apart}};
}

// One of two measured heights of a place is taken: a bridge, or a mistake.
void warn_of_measured(Tool& tool, const talus::CleaningCounts& c, const talus::Vec3& origin) {
  if (c.measured_apart == 0) return;
  talus::Doubt doubt;
  doubt.what = "meeting of breaklines and spot heights";
  doubt.at = {c.measured_apart_at + origin};
  doubt.value = c.measured_apart_m;
  doubt.found = "they meet at different heights in " +
                talus::counted(static_cast<std::int64_t>(c.measured_apart), "place") +
                ", by up to " + text(c.measured_apart_m, 3) + " m here: one of them is taken";
  doubt.hint = "leave out what crosses on a bridge";
  tool.doubts({doubt});
}

Json cleaning_json(const ContourMap& map, const talus::LayerReading& taken) {
  const std::vector<double> levels = talus::contour_levels(map);
  return {{"n_features", taken.n_features},
          {"n_lines", map.contours.n_lines()},
          {"n_points", map.contours.points.size()},
          {"n_heights", levels.size()},
          {"lowest_m", levels.front() + map.origin.z()},
          {"highest_m", levels.back() + map.origin.z()},
          {"interval_m", talus::contour_interval(map)},
          {"n_breaklines", map.breaklines.n_lines()},
          {"n_spots", map.spots.size()}};
}

// Adds points to the triangulation that mend its flat triangles; the changes go to `report`.
void mend(Tool& tool, const Options& o, const ContourMap& map,
          const std::vector<std::uint8_t>& flat, double interval,
          talus::Triangulation& triangulation, talus::TriangleMesh& mesh, Json& report) {
  const talus::MendingPoints mended =
      talus::mend_flat_triangles(mesh, flat, {interval, o.fill_spacing_m}, tool.progress());
  mesh.triangles = {};
  give_memory_back();
  triangulation.fix_edges(mended.border);
  triangulation.add(mended.points);
  refresh_inside(map, triangulation, o, true, mesh);
  report["spacing_m"] = mended.spacing;
  report["n_points_added"] = mended.points.size();
  report["largest_change_m"] = mended.largest_change;
  if (mended.n_unsolved > 0)
    tool.warn(std::to_string(mended.n_unsolved) + " places were left flat: nothing holds them");
}

// Triangulation takes several times the memory of the points; docs/tools/talus-tin.md.
void ask_for_memory(const ContourMap& map, std::size_t n_points) {
  constexpr double bytes_per_point = 210;
  talus::require_memory(bytes_per_point * static_cast<double>(n_points), {map.source},
                        "triangles of " + std::to_string(n_points) + " points",
                        "take a part of the map (--boundary), or simplify its lines");
}

// Of a file that talus-import wrote, all are layers of it.
talus::LineFeatures features_of(const Options& o, const ContourMap& map) {
  const auto file = [&map](const talus::LayerRef& ref) {
    return ref.path.empty() ? map.source : ref.path;
  };
  return {map.contours.feature, map.breaklines.feature, map.source, file(o.inputs.breaklines),
          file(o.inputs.spots)};
}

void judge_heights(Tool& tool, const Options& o, std::vector<talus::Doubt> doubts, Json& report) {
  const std::string accepted = talus::judge(tool, o.doubts, std::move(doubts));
  if (!accepted.empty()) report["accepted_places"] = accepted;
}

// Triangles of the cleaned lines, mended as asked for. Frees data that are no longer needed.
talus::TriangleMesh make_mesh(Tool& tool, const Options& o, ContourMap& map, Json& report) {
  ask_for_memory(map, map.contours.points.size() + map.breaklines.points.size() + map.spots.size());
  const double interval = talus::contour_interval(map);
  const talus::LineFeatures features = features_of(o, map);
  std::vector<talus::Doubt> doubts = talus::doubts_below_land(map, features, "spot height");
  talus::CleanLines clean = talus::clean_or_mend(tool, o.doubts, map, report);
  const int n_lines =
      map.contours.n_lines() + map.breaklines.n_lines() + static_cast<int>(map.spots.size());
  talus::forget_lines(map);
  report["cleaning"] = cleaning_json(clean.counts);
  warn_of_measured(tool, clean.counts, map.origin);
  const talus::MeasuredPoints measured{clean.n_contour_points,
                                       static_cast<int>(clean.points.size())};
  talus::Triangulation triangulation(std::move(clean.points), clean.segments, map.source);
  clean.segments = {};
  talus::TriangleMesh mesh;
  refresh_inside(map, triangulation, o, o.flat == "keep", mesh);
  const std::vector<talus::Doubt> off = talus::doubts_of(
      talus::find_outliers(mesh, {std::move(clean.line), measured.first, n_lines}, interval),
      features, map.origin);
  doubts.insert(doubts.end(), off.begin(), off.end());
  judge_heights(tool, o, std::move(doubts), report);
  const std::vector<std::uint8_t> flat = find_flat_triangles(mesh, measured);
  const talus::AreaShare before = area_of(mesh, flat);
  doubt_missing_part(tool, o, map, before.all_m2);
  report["flat"] = {{"mode", o.flat}, {"share_before", before.share()}};
  if (o.flat == "fill" && before.marked_m2 > 0)
    mend(tool, o, map, flat, interval, triangulation, mesh, report["flat"]);
  const talus::AreaShare after = area_of(mesh, find_flat_triangles(mesh, measured));
  report["flat"]["share_after"] = after.share();
  report["area_m2"] = after.all_m2;
  tool.metric("flat_share_before", before.share(), "1");
  tool.metric("flat_share_after", after.share(), "1");
  return mesh;
}

std::string summary_of(const Json& report) {
  const Json &contours = report["contours"], &tin = report["tin"], &flat = report["flat"];
  return std::to_string(contours["n_lines"].get<int>()) + " contours, " +
         std::to_string(contours["n_points"].get<std::size_t>()) + " points, every " +
         text(contours["interval_m"].get<double>(), 6) + " m from " +
         text(contours["lowest_m"].get<double>(), 8) + " to " +
         text(contours["highest_m"].get<double>(), 8) + " m\n" +
         std::to_string(tin["n_points"].get<std::size_t>()) + " points, " +
         std::to_string(tin["n_triangles"].get<std::size_t>()) + " triangles; flat " +
         percent(flat["share_before"].get<double>()) + " of the area, " +
         percent(flat["share_after"].get<double>()) +
         (flat["mode"] == "fill" ? " after mending" : " (kept)");
}

Json build(Tool& tool, Options& o, talus::Tin& tin) {
  talus::ImportReading reading;
  ContourMap map = read_map(tool, o, reading);
  Json report = {{"tool", "talus-tin"},
                 {"source", o.inputs.contours.path},
                 {"run_id", tool.run_id()},
                 {"layer", reading.layers.front().layer},
                 {"elevation_from", reading.layers.front().elevation_from},
                 {"crs", talus::crs_name(map.crs_wkt)},
                 {"contours", cleaning_json(map, reading.layers.front())},
                 {"layers_read", tool.layers_read()}};
  if (o.hold_out_every > 0) {
    const auto held_back = talus::hold_back_contours(o.hold_out_every, map);
    talus::check_heights(map);
    write_points(tool.stage(o.hold_out), map, held_back);
    report["held_back"] = {{"every", o.hold_out_every}, {"n_points", held_back.size()}};
  }
  tin = talus::to_tin(make_mesh(tool, o, map, report), map);
  tin.accepted_doubts = report.value("accepted_places", "");
  report["tin"] = {{"n_points", tin.points.size()}, {"n_triangles", tin.triangles.size()}};
  report["notes"] = reading.notes;
  report["operations"] = reading.operations;
  tool.metric("n_points", static_cast<double>(tin.points.size()), "1");
  return report;
}

// --- points --------------------------------------------------------------------------------------

void check_no_lines(const Options& o) {
  const bool has_lines = !o.inputs.breaklines.path.empty() || !o.inputs.spots.path.empty() ||
                         !o.inputs.labels.path.empty() || o.hold_out_every > 0 ||
                         !std::isnan(o.doubts.tolerance_m);
  if (!has_lines) return;
  throw UsageError(
      {"", 0, "--points"},
      "breaklines, spot heights, labels, --hold-out-every and --tolerance-m are for contours",
      "omit them, or --points");
}

Json build_of_points(Tool& tool, Options& o, talus::Tin& tin) {
  check_no_lines(o);
  talus::ImportReading reading;
  ContourMap map = read_map(tool, o, reading);
  ask_for_memory(map, map.spots.size());
  std::vector<talus::Doubt> doubts = talus::doubts_below_land(map, features_of(o, map), "point");
  talus::PointMesh found = talus::mesh_of_points(std::move(map.spots), map.source);
  for (const talus::PointDoubt& off : found.doubts)
    doubts.push_back(talus::height_doubt(map.source, "point", off.place + map.origin,
                                         off.low + map.origin.z(), off.high + map.origin.z(),
                                         off.is_impossible));
  Json report = {{"tool", "talus-tin"},
                 {"source", o.inputs.contours.path},
                 {"run_id", tool.run_id()},
                 {"layer", reading.layers.front().layer},
                 {"elevation_from", reading.layers.front().elevation_from},
                 {"crs", talus::crs_name(map.crs_wkt)},
                 {"points",
                  {{"n_read", found.n_read},
                   {"n_repeated", found.n_repeated},
                   {"repeated_differ_m", found.repeated_differ_m}}},
                 {"layers_read", tool.layers_read()}};
  judge_heights(tool, o, std::move(doubts), report);
  if (found.repeated_differ_m > talus::same_height_m)
    tool.warn("of points at one place the mean height is taken; they differ by up to " +
              text(found.repeated_differ_m, 2) + " m");
  talus::cut_to_rings(map.boundary, found.mesh);
  if (found.mesh.triangles.empty())
    throw InputError({file_of_boundary(o)}, "the boundary and the points share no ground");
  const std::vector<std::uint8_t> none_marked(found.mesh.triangles.size());
  doubt_missing_part(tool, o, map, area_of(found.mesh, none_marked).all_m2);
  const talus::EdgeLengths edges = talus::edge_lengths(found.mesh);
  report["points"]["median_edge_m"] = edges.median;
  report["points"]["longest_edge_m"] = edges.longest;
  if (edges.longest > 10 * edges.median)
    tool.warn("triangles span gaps of up to " + text(edges.longest, 4) + " m between points " +
              text(edges.median, 3) +
              " m apart: nothing is known of the ground there; --boundary cuts them off");
  tin = talus::to_tin(std::move(found.mesh), map);
  tin.accepted_doubts = report.value("accepted_places", "");
  report["tin"] = {{"n_points", tin.points.size()}, {"n_triangles", tin.triangles.size()}};
  report["notes"] = reading.notes;
  report["operations"] = reading.operations;
  tool.metric("n_points", static_cast<double>(tin.points.size()), "1");
  return report;
}

std::string summary_of_points(const Json& report) {
  const Json &points = report["points"], &tin = report["tin"];
  return std::to_string(points["n_read"].get<std::size_t>()) + " points of the ground, " +
         text(points["median_edge_m"].get<double>(), 3) + " m apart\n" +
         std::to_string(tin["n_points"].get<std::size_t>()) + " points, " +
         std::to_string(tin["n_triangles"].get<std::size_t>()) + " triangles";
}

}  // namespace

int main(int argc, char** argv) {
  keep_large_arrays_apart();
  Options o;
  Tool tool("talus-tin", "Makes a triangulated irregular network (TIN) from contour lines.");
  declare(tool, o);
  return tool.run(argc, argv, [&] {
    check_together(o);
    o.request = talus::request_of(tool, o.inputs);
    talus::Tin tin;
    const Json report = o.inputs.of_points ? build_of_points(tool, o, tin) : build(tool, o, tin);
    talus::write_tin(tool.stage(o.out), tin);
    tool.report(o.report, report);
    tool.result(report, o.inputs.of_points ? summary_of_points(report) : summary_of(report));
  });
}
