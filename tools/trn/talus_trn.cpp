// tools/trn/talus_trn.cpp
// A TIN or a DEM to the terrain that blocks move on, and how good it is. Page:
// docs/tools/talus-trn.md
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/text.hpp"
#include "base/words.hpp"
#include "import/dem_gdal.hpp"
#include "import/import_inputs_gdal.hpp"
#include "import/tin_files_gdal.hpp"
#include "io/burnt_dams_gdal.hpp"
#include "io/crs_gdal.hpp"
#include "io/hillshade_gdal.hpp"
#include "io/judged_heights_gdal.hpp"
#include "io/tags_gdal.hpp"
#include "io/trn_digest.hpp"
#include "io/trn_file_gdal.hpp"
#include "setup/site_dams_gdal.hpp"
#include "setup/vector_inputs_gdal.hpp"
#include "terrain/elevation.hpp"
#include "terrain/grid_tin.hpp"
#include "terrain/ground_doubts.hpp"
#include "terrain/lone_levels.hpp"
#include "terrain/trn_quality.hpp"
#include "tools/frame/command_line.hpp"
#include "tools/frame/doubts.hpp"
#include "tools/frame/import_options.hpp"
#include "tools/frame/site_options.hpp"
#include "tools/frame/tool.hpp"

namespace {

using talus::DemFile;
using talus::GridFrame;
using talus::InputError;
using talus::Json;
using talus::MapWindow;
using talus::percent;
using talus::text;
using talus::Tool;
using talus::Trn;

constexpr double far = std::numeric_limits<double>::infinity();
constexpr MapWindow everywhere{-far, -far, far, far};

struct Options {
  std::string source, out, window_text, like, reference, report, hillshade;
  talus::CrsOptions crs;
  talus::LayerRef reference_points, faces;
  double cell_size_m = 0;
  MapWindow window = everywhere;
  talus::DoubtOptions doubts;
};

// --- command line ------------------------------------------------------------------------------

std::string parse_window(const std::string& words, MapWindow& window) {
  std::array<double, 4> number{};
  std::size_t begin = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t end = i < 3 ? words.find(',', begin) : words.size();
    if (end == std::string::npos ||
        !talus::parse_double(words.substr(begin, end - begin), number[i]))
      return words + " is not a window, expected XMIN,YMIN,XMAX,YMAX";
    begin = end + 1;
  }
  window = {number[0], number[1], number[2], number[3]};
  if (window.x_min < window.x_max && window.y_min < window.y_max) return {};
  return "the window " + words +
         " has no area, expected XMIN < XMAX and YMIN < YMAX "
         "(QGIS writes extents as xmin,xmax,ymin,ymax)";
}

void declare(Tool& tool, Options& o) {
  tool.input("source", o.source, "TIN (PLY, OBJ, LandXML, 3DFACE in DXF), or an elevation raster");
  tool.output("-o,--out", o.out, "terrain to write (GeoTIFF)").required();
  tool.option("--unit-m", o.faces.unit_m,
              "metres in one unit of a drawing of faces, in plan and height; 0: metres, or refused "
              "where it says another unit")
      .check(talus::check_positive);
  tool.option("--cell-size-m", o.cell_size_m,
              "distance of the nodes [m]; 0: the DEM's own, or near that of the TIN's points")
      .check(talus::check_positive);
  tool.option("--window", o.window_text, "part to take, map coordinates: XMIN,YMIN,XMAX,YMAX [m]")
      .check([&o](const std::string& words) { return parse_window(words, o.window); });
  tool.input("--like", o.like, "put the nodes on the cell centres of this raster");
  talus::declare_crs_options(tool, o.crs);
  tool.input("--reference", o.reference, "better known DEM to hold the terrain against");
  tool.input("--reference-points", o.reference_points.path,
             "points with a height to hold the terrain against (any vector source)");
  tool.option("--elevation-field", o.reference_points.elevation_field,
              "field with the elevation of --reference-points, or Z; empty: found by itself");
  tool.output("--report", o.report, "errors, slopes, coverage (JSON)");
  talus::declare_doubts(tool, o.doubts, "take ground that cannot be, and say so");
  tool.output("--hillshade", o.hillshade, "picture of the terrain (PNG)");
  tool.footer(
      "Example:\n  talus-trn slope.ply -o slope.tif --cell-size-m 5 --report slope.json\n"
      "  talus-trn dem.tif -o slope.tif --window 248400,351100,249200,351700\n"
      "  talus-trn dem.tif site.toml -o slope.tif   (with the dams of the site)");
}

// --- the terrain ---------------------------------------------------------------------------------

/// The terrain and its system of heights.
struct Ground {
  Trn trn;
  bool was_judged = false;              // by the tool that wrote the source
  std::string accepted;                 // places, in words
  std::vector<std::string> operations;  // that took it to another system
};

std::string window_as_text(const MapWindow& w) {
  return text(w.x_min, 10) + "," + text(w.y_min, 10) + " to " + text(w.x_max, 10) + "," +
         text(w.y_max, 10);
}

// The part of a raster's lattice that is wanted, for a source in `crs_wkt`.
GridFrame frame_like(const Options& o, const std::string& crs_wkt) {
  talus::DemOptions lattice_options;
  lattice_options.crs_may_be_missing = true;
  const DemFile lattice(o.like, lattice_options);
  if (!lattice.crs_wkt().empty() && !talus::same_crs(lattice.crs_wkt(), crs_wkt))
    throw InputError({o.like},
                     "the CRS is " + talus::crs_name(lattice.crs_wkt()) + ", that of " + o.source +
                         " is " + talus::crs_name(crs_wkt),
                     "--like needs the same CRS");
  if (o.cell_size_m != 0 && !talus::is_own_cell_size(lattice.frame(), o.cell_size_m))
    throw InputError({o.like},
                     "the cells are " + text(lattice.frame().cell_size, 10) +
                         " m, --cell-size-m is " + text(o.cell_size_m),
                     "give one of --like and --cell-size-m");
  return talus::part_covering(lattice.frame(), o.window);
}

void check_order_of_window(const MapWindow& data, const Options& o) {
  const auto other = talus::other_order_within(o.window, data);
  if (!other) return;
  const std::string words = text(other->x_min, 12) + "," + text(other->y_min, 12) + "," +
                            text(other->x_max, 12) + "," + text(other->y_max, 12);
  throw InputError({o.source},
                   "--window " + o.window_text + " reaches beyond the data, " +
                       window_as_text(data) +
                       ", as XMIN,YMIN,XMAX,YMAX; in another order of "
                       "its numbers it lies in them",
                   "--window " + words + " (QGIS writes extents as xmin,xmax,ymin,ymax)");
}

void check_frame(const GridFrame& frame, const MapWindow& data, const Options& o) {
  check_order_of_window(data, o);
  const MapWindow common =
      talus::intersection(frame.empty() ? o.window : talus::extent(frame), data);
  if (common.x_min > common.x_max || common.y_min > common.y_max)
    throw InputError({o.source},
                     "the grid asked for lies outside of the data, " + window_as_text(data),
                     o.like.empty() ? "look at --window" : "look at --like and --window");
  talus::check_size(frame, o.source);
  if (frame.n_rows >= 2 && frame.n_cols >= 2) return;
  throw InputError({o.source},
                   "there is room for " + std::to_string(frame.n_cols) + " x " +
                       std::to_string(frame.n_rows) + " nodes, expected at least 2 x 2",
                   "choose a smaller cell or a larger window");
}

MapWindow grown(const MapWindow& w, double by) {
  return {w.x_min - by, w.y_min - by, w.x_max + by, w.y_max + by};
}

// `edges`: of the data.
void doubt_missing_part(Tool& tool, const Options& o, const MapWindow& edges,
                        const GridFrame& frame) {
  if (o.window_text.empty()) return;
  const double half = 0.5 * frame.cell_size;
  const MapWindow& asked = o.window;
  const MapWindow known =
      o.like.empty() ? edges : talus::intersection(edges, grown(talus::extent(frame), half));
  const MapWindow there = talus::intersection(asked, known);
  const double beyond = std::max({there.x_min - asked.x_min, there.y_min - asked.y_min,
                                  asked.x_max - there.x_max, asked.y_max - there.y_max});
  if (beyond < half) return;
  const auto area = [](const MapWindow& w) { return (w.x_max - w.x_min) * (w.y_max - w.y_min); };
  tool.doubts({talus::doubt_on(
      {o.source},
      "--window " + o.window_text + " reaches beyond what is there, " + window_as_text(known) +
          ": " + percent(1 - area(there) / area(asked)) + " of it is missing",
      "ask for the part that is there (window_m of a site), or add the data of the rest")});
}

// The bilinear facets of a coarse DEM stay what they are, however many cells each is cut into.
void doubt_cells_finer_than_dem(Tool& tool, const Options& o, double dem_cell_size,
                                const GridFrame& frame) {
  if (frame.cell_size > 0.5 * dem_cell_size) return;
  tool.doubts({talus::doubt_on(
      {o.source},
      "the nodes of the DEM are " + text(dem_cell_size, 4) + " m apart, those of the terrain " +
          text(frame.cell_size, 4) + " m: steps and gullies between the DEM's nodes are not there",
      o.like.empty() ? "omit --cell-size-m (of a site: cell_size_m), or get a finer DEM"
                     : "get a finer DEM")});
}

// A surface that folds over, or has a second layer, has two heights in one place; a terrain has
// one.
void judge_layers(Tool& tool, const Options& o, const std::string& finding, const talus::Vec3& at,
                  Ground& ground) {
  talus::Doubt doubt;
  doubt.where.file = o.source;
  doubt.what = "second layer";
  doubt.at = {at};
  doubt.found = finding;
  doubt.expected = "one height in each place";
  doubt.hint = "write the ground alone to the file; --accept-doubts takes one of the heights";
  doubt.state = talus::DoubtState::refused;
  ground.accepted = talus::judge(tool, o.doubts, {doubt});
}

void check_folds(Tool& tool, const Options& o, const talus::TinFile& file, Ground& ground) {
  if (file.tin.is_judged) return;
  const talus::FoldedEdges folded = talus::find_folded_edges(file.tin);
  if (folded.n == 0) return;
  judge_layers(tool, o,
               "the surface folds over or has two layers at " + talus::counted(folded.n, "edge"),
               folded.first + file.tin.origin, ground);
}

void check_two_heights(Tool& tool, const Options& o, const talus::TwoHeights& two,
                       const GridFrame& frame, Ground& ground) {
  if (two.n == 0 || !ground.accepted.empty()) return;
  judge_layers(tool, o,
               "the surface has two layers at " + talus::counted(two.n, "node") + ", here " +
                   text(std::min(two.z, two.other), 8) + " and " +
                   text(std::max(two.z, two.other), 8) + " m",
               {frame.x(two.col), frame.y(two.row), std::max(two.z, two.other)}, ground);
}

talus::LayerRef faces_of(const Options& o) {
  talus::LayerRef choice = o.faces;
  choice.path = o.source;
  return choice;
}

Ground ground_of_tin(Tool& tool, const Options& o) {
  if (!o.crs.t_srs.empty())
    throw InputError(
        {o.source}, "a TIN is not reprojected",
        "make the terrain without it, then of that: talus-trn TERRAIN.tif --t-srs " + o.crs.t_srs);
  if (!o.crs.t_vertical.empty())
    throw InputError(
        {o.source}, "the heights of a TIN stay as they are",
        "make the terrain without it, then of that: talus-trn TERRAIN.tif --t-vertical " +
            o.crs.t_vertical);
  talus::TinFile file = talus::read_tin_file(faces_of(o));
  for (const std::string& note : file.notes) tool.info(note);
  tool.doubts(file.doubts);
  if (!file.taken.file.empty()) tool.layer_read(talus::facts_on(file.taken, "source"));
  const talus::Tin& tin = file.tin;
  Ground ground;
  ground.was_judged = tin.is_judged;
  ground.accepted = tin.accepted_doubts;
  check_folds(tool, o, file, ground);
  const MapWindow data = talus::extent(tin);
  talus::ImportReading reading;
  const std::string crs =
      talus::crs_of_tin(tin, talus::systems_by_user(o.crs), faces_of(o), reading);
  for (const std::string& note : reading.notes) tool.info(note);
  tool.doubts(reading.doubts);
  const double natural_size = talus::natural_cell_size(tin);
  if (natural_size <= 0)
    throw InputError({o.source}, "no triangle has an area in plan, expected a surface");
  const double size = o.cell_size_m > 0 ? o.cell_size_m : natural_size;
  check_order_of_window(data, o);  // before a grid of the wrong window is made
  const MapWindow common = talus::intersection(o.window, data);
  GridFrame frame;
  if (!o.like.empty())
    frame = frame_like(o, crs);
  else if (common.x_min <= common.x_max && common.y_min <= common.y_max)
    frame = o.window.x_min > -far ? talus::frame_covering(o.window, size)
                                  : talus::frame_inside(data, size);
  check_frame(frame, data, o);
  doubt_missing_part(tool, o, data, frame);
  talus::TwoHeights two;
  ground.trn = talus::make_trn(
      frame, crs, talus::grid_tin(tin, frame, tool.progress(), tin.is_judged ? nullptr : &two));
  check_two_heights(tool, o, two, frame, ground);
  return ground;
}

void say(Tool& tool, const talus::DemReading& reading) {
  for (const std::string& note : reading.notes) {
    tool.info(note);
    tool.record(note);
  }
  tool.doubts(reading.doubts);
}

bool has_node_below_land(const Trn& trn) {
  return std::any_of(trn.elevation.begin(), trn.elevation.end(),
                     [&trn](double z) { return z + trn.origin.z() < talus::lowest_land; });
}

Ground ground_of_dem(Tool& tool, const Options& o) {
  talus::DemOptions options;
  static_cast<talus::SystemsByUser&>(options) = talus::systems_by_user(o.crs);
  options.accepts_doubts = o.doubts.accept;
  options.window = o.window;
  if (o.faces.unit_m != 0)
    throw talus::UsageError({"", 0, o.source}, "--unit-m is for faces (DXF, OBJ, LandXML)",
                            "omit it");
  const DemFile dem(o.source, options);
  say(tool, dem.reading());
  Ground ground;
  ground.operations = dem.reading().notes;
  const GridFrame frame = o.like.empty() ? talus::frame_on_dem(dem.frame(), o.cell_size_m, o.window)
                                         : frame_like(o, dem.crs_wkt());
  const MapWindow nodes = talus::extent(dem.frame());
  check_frame(frame, nodes, o);
  doubt_missing_part(tool, o, grown(nodes, 0.5 * dem.frame().cell_size), frame);
  doubt_cells_finer_than_dem(tool, o, dem.frame().cell_size, frame);
  if (o.cell_size_m != 0 && frame.cell_size != o.cell_size_m)
    tool.info("the nodes are the DEM's own, " + text(frame.cell_size, 12) + " m apart");
  ground.trn = talus::make_trn(frame, dem.crs_wkt(), talus::read_dem(dem, frame, tool.progress()));
  ground.accepted = talus::accepted_doubts(o.source);
  // asked where it matters alone: it may take a look at all heights
  ground.was_judged = has_node_below_land(ground.trn) && dem.accepts_doubts();
  return ground;
}

// --- how good it is ------------------------------------------------------------------------------

// The reference's heights must be in the terrain's system, where both say it; where one does not,
// that is said.
void check_heights_alike(Tool& tool, const std::string& path, const std::string& crs,
                         const Trn& trn) {
  const std::string assumed = talus::assumed_heights(crs, trn.crs_wkt);
  if (!assumed.empty()) tool.info(path + " and the terrain: both are " + assumed);
  if (talus::same_heights(crs, trn.crs_wkt)) return;
  throw InputError({path},
                   "the heights are in " + talus::crs_name(talus::height_crs(crs)) +
                       ", those of the terrain in " +
                       talus::crs_name(talus::height_crs(trn.crs_wkt)),
                   "bring both to one system of heights first");
}

// A reference DEM node by node, in strips.
talus::ErrorStatistics errors_against_dem(Tool& tool, const Trn& trn, const std::string& path) {
  talus::DemOptions options;
  options.crs_may_be_missing = true;
  const DemFile dem(path, options);
  if (!dem.crs_wkt().empty() && !talus::same_crs(dem.crs_wkt(), trn.crs_wkt))
    throw InputError({path},
                     "the CRS is " + talus::crs_name(dem.crs_wkt()) + ", that of the terrain is " +
                         talus::crs_name(trn.crs_wkt),
                     "a DEM is never reprojected silently: talus-trn " + path +
                         " -o reference.tif --t-srs " + talus::crs_code(trn.crs_wkt));
  check_heights_alike(tool, path, dem.crs_wkt(), trn);
  const GridFrame all = talus::part_covering(dem.frame(), talus::extent(talus::frame_of(trn)));
  talus::ErrorCollector errors;
  for (int row = 0; row < all.n_rows; row += 256) {
    const GridFrame strip{
        std::min(256, all.n_rows - row), all.n_cols, all.cell_size, {all.x(0), all.y(row)}};
    const std::vector<double> truth = talus::read_dem(dem, strip);
    for (int r = 0; r < strip.n_rows; ++r)
      for (int c = 0; c < strip.n_cols; ++c) {
        const double z =
            truth[static_cast<std::size_t>(r) * static_cast<std::size_t>(strip.n_cols) +
                  static_cast<std::size_t>(c)];
        if (!std::isnan(z))
          errors.add(trn, strip.x(c) - trn.origin.x(), strip.y(r) - trn.origin.y(), z);
      }
  }
  return errors.statistics();
}

talus::ErrorStatistics errors_against_points(Tool& tool, const Trn& trn,
                                             const talus::LayerRef& choice,
                                             std::vector<std::string>& notes) {
  talus::ImportReading reading;
  const std::vector<talus::Vec3> truth =
      talus::import_reference_points(choice, trn.crs_wkt, reading);
  talus::say_reading(tool, reading);
  notes = reading.notes;
  notes.insert(notes.end(), reading.operations.begin(), reading.operations.end());
  talus::ErrorCollector errors;
  for (const talus::Vec3& point : truth)
    errors.add(trn, point.x() - trn.origin.x(), point.y() - trn.origin.y(), point.z());
  return errors.statistics();
}

double share(std::int64_t part, std::int64_t whole) {
  return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : 0;
}

Json as_json(const talus::ErrorStatistics& e, const Trn& trn, const std::string& path) {
  return {{"file", path},
          {"n", e.n},
          {"covered_share", share(e.n, e.n + e.n_uncovered)},
          {"rmse_m", e.rmse},
          {"mae_m", e.mae},
          {"mean_m", e.mean},
          {"p95_m", e.p95},
          {"largest_m", e.largest},
          {"largest_at", {e.largest_at.x() + trn.origin.x(), e.largest_at.y() + trn.origin.y()}}};
}

Json as_json(const talus::SlopeStatistics& s) {
  Json histogram = Json::array();
  for (std::size_t bin = 0; bin < s.n_in_bin.size(); ++bin)
    histogram.push_back({{"from_deg", static_cast<int>(bin) * s.bin_deg},
                         {"to_deg", static_cast<int>(bin + 1) * s.bin_deg},
                         {"share", share(s.n_in_bin[bin], s.n_triangles)}});
  return {{"mean_deg", s.mean_deg},
          {"largest_deg", s.largest_deg},
          {"flat_share", share(s.n_flat, s.n_triangles)},
          {"cells_steeper_than_70_deg", s.n_cells_steep},
          {"share_steeper_than_70_deg", share(s.n_cells_steep, s.n_cells)},
          {"histogram", histogram}};
}

Json as_json(const Trn& trn, const talus::SlopeStatistics& s) {
  const GridFrame frame = talus::frame_of(trn);
  const MapWindow window = talus::extent(frame);
  double low = far, high = -far;
  for (const double z : trn.elevation) {
    low = z < low ? z : low;
    high = z > high ? z : high;
  }
  return {{"n_rows", trn.n_rows},
          {"n_cols", trn.n_cols},
          {"cell_size_m", trn.cell_size},
          {"window", {window.x_min, window.y_min, window.x_max, window.y_max}},
          {"crs", talus::crs_name(trn.crs_wkt)},
          {"lowest_m", low},
          {"highest_m", high},
          {"covered_share", share(s.n_nodes_known, talus::feature_counts(trn).vertices)},
          {"n_triangles", s.n_triangles}};
}

std::string summary_of(const Json& report) {
  const Json &grid = report["grid"], &slope = report["slope"];
  std::string lines = std::to_string(grid["n_cols"].get<int>()) + " x " +
                      std::to_string(grid["n_rows"].get<int>()) + " nodes, " +
                      text(grid["cell_size_m"].get<double>(), 10) + " m apart, " +
                      percent(grid["covered_share"].get<double>()) + " known, " +
                      text(grid["lowest_m"].get<double>(), 6) + " to " +
                      text(grid["highest_m"].get<double>(), 6) + " m\nslope " +
                      text(slope["mean_deg"].get<double>(), 3) + " degrees on average, up to " +
                      text(slope["largest_deg"].get<double>(), 3) + "; flat " +
                      percent(slope["flat_share"].get<double>()) + "; steeper than 70 degrees " +
                      percent(slope["share_steeper_than_70_deg"].get<double>());
  for (const char* name : {"reference", "reference_points"}) {
    if (!report.contains(name)) continue;
    const Json& e = report[name];
    // to the micrometre: less is rounding
    const auto metres = [&](const char* key) {
      return text(0.0 + std::round(1e6 * e[key].get<double>()) / 1e6, 4) + " m";
    };
    lines += "\nagainst " + e["file"].get<std::string>() + ": RMSE " + metres("rmse_m") + ", MAE " +
             metres("mae_m") + ", 95 % within " + metres("p95_m") + ", largest " +
             metres("largest_m") + " at " + text(e["largest_at"][0].get<double>(), 9) + "," +
             text(e["largest_at"][1].get<double>(), 9) + "; covers " +
             percent(e["covered_share"].get<double>());
  }
  return lines;
}

void add_errors(Tool& tool, const talus::ErrorStatistics& errors, const std::string& name,
                const std::string& path, const Trn& trn, Json& report) {
  if (errors.n == 0)
    throw InputError({path}, "no place in common with known ground of the terrain");
  report[name] = as_json(errors, trn, path);
  tool.metric(name + "_rmse_m", errors.rmse, "m");
  tool.metric(name + "_largest_m", errors.largest, "m");
}

// --- doubts --------------------------------------------------------------------------------------

// Reports heights that neighbours contradict; refuses heights that are not land, unless the tool
// that wrote the source has judged it.
void judge_ground(Tool& tool, const Options& o, Ground& ground) {
  std::vector<talus::Doubt> doubts = talus::find_ground_doubts(ground.trn, o.source);
  if (o.doubts.accept)
    for (talus::Doubt& doubt : doubts)
      if (doubt.what == talus::level_area) doubt.state = talus::DoubtState::accepted;
  if (!o.doubts.accept && ground.was_judged) talus::accept(doubts);
  const std::string places = talus::judge(tool, o.doubts, std::move(doubts));
  if (o.doubts.accept && !places.empty())
    ground.accepted += (ground.accepted.empty() ? "" : "; ") + places;
}

Json report_on(Tool& tool, const Options& o, Ground& ground) {
  const Trn& trn = ground.trn;
  const talus::SlopeStatistics slopes = talus::slope_statistics(trn);
  Json report = {{"tool", "talus-trn"},
                 {"source", o.source},
                 {"run_id", tool.run_id()},
                 {"grid", as_json(trn, slopes)},
                 {"slope", as_json(slopes)}};
  judge_ground(tool, o, ground);
  if (!ground.accepted.empty()) report["accepted_places"] = ground.accepted;
  if (!ground.operations.empty()) report["operations"] = ground.operations;
  if (!o.reference.empty())
    add_errors(tool, errors_against_dem(tool, trn, o.reference), "reference", o.reference, trn,
               report);
  std::vector<std::string> notes;
  if (!o.reference_points.path.empty())
    add_errors(tool, errors_against_points(tool, trn, o.reference_points, notes),
               "reference_points", o.reference_points.path, trn, report);
  if (!notes.empty()) report["notes"] = notes;
  tool.metric("covered_share", report["grid"]["covered_share"].get<double>(), "1");
  if (slopes.n_cells_steep > 0)
    tool.warn(std::to_string(slopes.n_cells_steep) +
              " cells are steeper than 70 degrees, where a height field is a poor model");
  return report;
}

// --- dams ----------------------------------------------------------------------------------------

Json as_json(const talus::Earthwork& work) {
  return {{"fill_m3", work.fill}, {"cut_m3", work.cut}};
}

Json as_json(const talus::BuiltDam& built, const Trn& trn) {
  Json points = Json::array();
  for (const talus::Vec3& p : built.dam.crest) {
    const talus::Vec3 at = p + trn.origin;
    points.push_back({at.x(), at.y(), at.z()});
  }
  const bool is_gallery = built.dam.shape.is_gallery;
  Json json = {{"name", built.name},
               {"kind", is_gallery ? "gallery" : "dam"},
               {"crest", points},
               {"least_height_m", built.dam.least_height},
               {"most_height_m", built.dam.most_height},
               {"in_cells", as_json(built.burn.in_cells)},
               {"crest_loss_m", built.burn.crest_loss},
               {"n_nodes", built.burn.nodes.size()}};
  if (!is_gallery) json["designed"] = as_json(built.burn.designed);
  return json;
}

// Dams would stand on the dams that a terrain file has in its ground.
void check_has_no_dams(const talus::Site& site, const std::string& source) {
  const bool builds = std::any_of(site.dams.begin(), site.dams.end(),
                                  [](const talus::DamSettings& dam) { return dam.active; });
  if (builds && !talus::is_tin_file(source) && !talus::tag_of(source, talus::dams_tag).empty())
    throw InputError({source}, "has dams in its ground, on which those of the site would be built",
                     "give the elevation model or the contours that it was made from");
}

// After the doubts of the ground itself. Returns a sentence each.
std::string add_dams(Tool& tool, const talus::Site& site, const std::string& source, Trn& trn,
                     Json& report) {
  check_has_no_dams(site, source);
  std::string sentences;
  Json list = Json::array();
  for (const talus::BuiltDam& built : talus::build_dams(tool, site, trn)) {
    sentences += "\n" + sentence_on(built);
    list.push_back(as_json(built, trn));
    if (built.dam.shape.is_gallery) continue;  // it is not filled
    tool.metric("dam_" + built.name + "_fill_m3", built.burn.designed.fill, "m3");
    tool.metric("dam_" + built.name + "_cut_m3", built.burn.designed.cut, "m3");
  }
  if (!list.empty()) report["dams"] = list;
  return sentences;
}

}  // namespace

int main(int argc, char** argv) {
  Options o;
  Tool tool("talus-trn", "Makes the terrain of nodes (TRN) from a TIN or an elevation raster.");
  declare(tool, o);
  talus::SiteOptions site(tool, {}, false);
  site.take_inputs();
  return tool.run(argc, argv, [&] {
    if (!talus::is_tin_file(o.source)) talus::read_members(tool, "source", o.source);
    talus::read_members(tool, "like", o.like);
    talus::read_members(tool, "reference", o.reference);
    talus::read_members(tool, "reference-points", o.reference_points.path);
    Ground ground = talus::is_tin_file(o.source) ? ground_of_tin(tool, o) : ground_of_dem(tool, o);
    talus::check_trn(ground.trn, o.source);
    o.doubts.crs_wkt = ground.trn.crs_wkt;
    tool.content_read("terrain", talus::trn_digest(ground.trn));
    Json report = report_on(tool, o, ground);
    const std::string dams =
        site.file().empty() ? "" : add_dams(tool, site.load(), o.source, ground.trn, report);
    talus::write_trn(tool.stage(o.out), ground.trn, {{{"RUN_ID", tool.run_id()}}, ground.accepted});
    if (!o.hillshade.empty()) talus::write_hillshade(tool.stage(o.hillshade), ground.trn);
    tool.report(o.report, report);
    tool.result(report, summary_of(report) + dams);
  });
}
