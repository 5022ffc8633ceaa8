// tools/talus_runout.cpp
// How far runs came: deposit, paths, streamline, angle of reach, mobility. Page:
// docs/tools/talus-runout.md
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/text.hpp"
#include "io/geopackage_gdal.hpp"
#include "io/style.hpp"
#include "map_output.hpp"
#include "post/map_style.hpp"
#include "post/mobility.hpp"
#include "post/outline.hpp"
#include "post/runout.hpp"
#include "post/statistics.hpp"
#include "run_inputs.hpp"
#include "shipped_data.hpp"

namespace {

using namespace talus;  // NOLINT: a program of its own

constexpr double degrees = 180 / std::numbers::pi;

struct Options {
  std::string out, json, csv, svg, curves, thickness, mobility;
  double tolerance_m = 0.5, cell_size_m = 0, friction_deg = std::nan("");
  bool confined = false;
};

void declare(Tool& tool, Options& o) {
  tool.output("-o,--out", o.out, "deposit, paths, streamlines, envelope (GeoPackage)")->required();
  tool.json_output(o.json, "run-out of the event, runs and relations (JSON)");
  tool.output("--csv", o.csv, "one row a block (CSV)");
  tool.output("--curves", o.curves, "speed, energy and centre of mass over time (CSV)");
  tool.output("--svg", o.svg, "where the event lies among the mobility relations (SVG)");
  tool.output("--thickness", o.thickness, "mean thickness of the deposit (GeoTIFF)");
  tool.input("--mobility", o.mobility, "relations to compare with (CSV) [share/mobility.csv]");
  tool.option("--path-tolerance-m", o.tolerance_m,
              "no point of a block's way lies farther from its simplified path [m]")
      ->check(number_between(1e-6, 1e6));
  tool.option("--friction-deg", o.friction_deg,
              "angle of friction, shown beside H_cm/L_cm [deg]; nan: not shown")
      ->check(number_between(0, 89, true));
  tool.flag("--confined", o.confined, "the path is laterally confined (for the relations)");
  tool.footer("Example:\n  talus-runout run.h5 --trn slope.tif -o runout.gpkg --json runout.json");
}

/// What is kept of a run once it has been read.
struct RunResult {
  EventReach event;
  Balance balance;
  ReachLine centre;
  EnergyShares energy;
  std::vector<TimedPath> paths;               // simplified, of each block
  std::vector<std::vector<Vec2>> footprints;  // at the end
  std::vector<Vec3> end;                      // centroids
  std::vector<double> volume, mass, weight;
  std::vector<CurveRow> curves;
  std::vector<std::uint32_t> cells;  // that any block passed
  DepositSums deposit;
};

RunResult result_of(const RunFile& run, const Trn& trn, const Options& o, double rest_speed) {
  RunResult r;
  r.event = event_reach(run, trn, {o.tolerance_m, rest_speed});
  r.balance = balance_of(run, rest_speed);
  r.energy = energy_shares(run);
  for (int b = 0; b < n_blocks(run); ++b) {
    r.paths.push_back(simplified(block_path(run, b), o.tolerance_m));
    const Pose pose = last_pose(run, b);
    r.footprints.push_back(footprint(run, b, pose));
    r.end.push_back(pose.position);
    r.weight.push_back(weight_of(run, b));
  }
  r.volume = run.blocks.volume;
  r.mass = run.blocks.mass;
  r.curves = curves(run);
  for (const Passage& passage : run.passages)
    r.cells.push_back(static_cast<std::uint32_t>(passage.cell));
  std::sort(r.cells.begin(), r.cells.end());
  r.cells.erase(std::unique(r.cells.begin(), r.cells.end()), r.cells.end());
  const PassageGrid grid = run.grid.n_rows > 0 ? run.grid : passage_grid(trn, 0);
  add_deposit(r.deposit, grid, run, rest_speed);
  return r;
}

// --- layers of the GeoPackage --------------------------------------------------------------------

struct MapPlace {
  Vec3 origin;
  [[nodiscard]] Vec3 operator()(const Vec3& local) const { return local + origin; }
  [[nodiscard]] Vec2 operator()(const Vec2& local) const { return local + origin.head<2>(); }
};

using Runs = std::vector<std::pair<const RunMember*, const RunResult*>>;

FieldValue whole(std::int64_t value) { return value; }

VectorLayer deposit_layer_of(const Runs& runs, const MapPlace& map) {
  VectorLayer layer{"deposit",
                    "footprint of each block at the end of its run",
                    GeometryType::multi_polygon,
                    {{"run_id", FieldType::text},
                     {"block", FieldType::integer},
                     {"fate", FieldType::text},
                     {"volume_m3", FieldType::real},
                     {"mass_kg", FieldType::real},
                     {"z_m", FieldType::real},
                     {"drop_m", FieldType::real},
                     {"path_length_m", FieldType::real},
                     {"chord_length_m", FieldType::real},
                     {"reach_angle_path_deg", FieldType::real},
                     {"reach_angle_chord_deg", FieldType::real},
                     {"max_speed_m_s", FieldType::real},
                     {"max_energy_kj", FieldType::real}},
                    {},
                    vector_qml({SymbolKind::polygon,
                                "fate",
                                {{"deposited", "at rest", {166, 118, 29, 180}},
                                 {"moving", "still moving", {227, 26, 28, 180}},
                                 {"left_domain", "left the terrain", {120, 120, 120, 180}}},
                                0.15})};
  for (const auto& [member, r] : runs)
    for (const BlockReach& b : r->event.blocks) {
      VectorFeature f;
      f.polygons = {{{}}};
      for (const Vec2& p : r->footprints[b.block]) f.polygons[0][0].push_back(map(p));
      f.values = {member->info.run_id,
                  whole(b.block),
                  std::string(text(b.fate)),
                  r->volume[b.block],
                  r->mass[b.block],
                  map(r->end[b.block]).z(),
                  b.reach.height,
                  b.reach.path,
                  b.reach.chord,
                  b.reach.path_angle() * degrees,
                  b.reach.chord_angle() * degrees,
                  b.max_speed,
                  b.max_energy / 1e3};
      layer.features.push_back(std::move(f));
    }
  return layer;
}

VectorFeature line_feature(const std::vector<Vec3>& points, const std::vector<double>& measure,
                           const MapPlace& map) {
  VectorFeature f;
  for (const Vec3& p : points) f.points.push_back(map(p));
  f.measure = measure;
  if (f.points.size() == 1) {  // a line needs two points
    f.points.push_back(f.points[0]);
    f.measure.push_back(f.measure.empty() ? 0 : f.measure[0]);
  }
  return f;
}

VectorLayer path_layer(const Runs& runs, const MapPlace& map, double tolerance) {
  VectorLayer layer{
      "paths",
      "way of each block's centroid, M = time in s, simplified to " + text(tolerance) + " m",
      GeometryType::line_zm,
      {{"run_id", FieldType::text},
       {"block", FieldType::integer},
       {"path_length_m", FieldType::real},
       {"max_speed_m_s", FieldType::real},
       {"duration_s", FieldType::real}},
      {},
      vector_qml({SymbolKind::line, "", {{"", "", {31, 78, 121, 160}}}, 0.3})};
  for (const auto& [member, r] : runs)
    for (const BlockReach& b : r->event.blocks) {
      const TimedPath& path = r->paths[b.block];
      if (path.point.empty()) continue;
      VectorFeature f = line_feature(path.point, path.time, map);
      f.values = {member->info.run_id, whole(b.block), b.reach.path, b.max_speed,
                  path.time.back() - path.time.front()};
      layer.features.push_back(std::move(f));
    }
  return layer;
}

VectorLayer path_point_layer(const Runs& runs, const MapPlace& map) {
  VectorLayer layer{"path_points",
                    "points of the simplified ways",
                    GeometryType::point_z,
                    {{"run_id", FieldType::text},
                     {"block", FieldType::integer},
                     {"time_s", FieldType::real},
                     {"speed_m_s", FieldType::real}},
                    {},
                    vector_qml({SymbolKind::point, "", {{"", "", {31, 78, 121, 255}}}, 0.8})};
  for (const auto& [member, r] : runs)
    for (std::size_t b = 0; b < r->paths.size(); ++b)
      for (std::size_t i = 0; i < r->paths[b].point.size(); ++i) {
        VectorFeature f;
        f.points = {map(r->paths[b].point[i])};
        f.values = {member->info.run_id, whole(static_cast<std::int64_t>(b)), r->paths[b].time[i],
                    r->paths[b].speed[i]};
        layer.features.push_back(std::move(f));
      }
  return layer;
}

VectorLayer streamline_layer(const Runs& runs, const MapPlace& map) {
  VectorLayer layer{"streamline",
                    "from the top of the source to the toe of the deposit, M = horizontal "
                    "distance in m",
                    GeometryType::line_zm,
                    {{"run_id", FieldType::text},
                     {"H_m", FieldType::real},
                     {"L_path_m", FieldType::real},
                     {"L_chord_m", FieldType::real},
                     {"reach_angle_path_deg", FieldType::real},
                     {"reach_angle_chord_deg", FieldType::real},
                     {"angle_monotone_along_path", FieldType::integer},
                     {"smallest_angle_along_path_deg", FieldType::real}},
                    {},
                    vector_qml({SymbolKind::line, "", {{"", "", {200, 30, 30, 255}}}, 0.8})};
  for (const auto& [member, r] : runs) {
    const EventReach& e = r->event;
    if (e.streamline.empty()) continue;
    std::vector<double> distance{0};
    for (std::size_t i = 1; i < e.streamline.size(); ++i)
      distance.push_back(distance.back() +
                         (e.streamline[i] - e.streamline[i - 1]).head<2>().norm());
    VectorFeature f = line_feature(e.streamline, distance, map);
    f.values = {member->info.run_id,
                e.event.height,
                e.event.path,
                e.event.chord,
                e.event.path_angle() * degrees,
                e.event.chord_angle() * degrees,
                whole(e.profile.monotone ? 1 : 0),
                e.profile.smallest * degrees};
    layer.features.push_back(std::move(f));
  }
  return layer;
}

VectorLayer end_layer(const Runs& runs, const MapPlace& map) {
  VectorLayer layer{"reach_points",
                    "top of the source and toe of the deposit",
                    GeometryType::point_z,
                    {{"run_id", FieldType::text}, {"what", FieldType::text}},
                    {},
                    vector_qml({SymbolKind::point,
                                "what",
                                {{"top", "top of the source", {255, 255, 255, 255}},
                                 {"toe", "toe of the deposit", {200, 30, 30, 255}}},
                                2.4})};
  for (const auto& [member, r] : runs) {
    if (r->event.streamline.empty()) continue;
    for (const auto& [what, at] : {std::pair{"top", r->event.top}, {"toe", r->event.toe}}) {
      VectorFeature f;
      f.points = {map(at)};
      f.values = {member->info.run_id, std::string(what)};
      layer.features.push_back(std::move(f));
    }
  }
  return layer;
}

VectorLayer envelope_layer(const std::vector<std::uint32_t>& cells, const PassageGrid& grid,
                           const MapPlace& map, double& area) {
  area = static_cast<double>(cells.size()) * grid.cell_size * grid.cell_size;
  VectorLayer layer{"envelope",
                    "outline of all cells that any block of any run passed",
                    GeometryType::multi_polygon,
                    {{"area_m2", FieldType::real}, {"n_cells", FieldType::integer}},
                    {},
                    vector_qml({SymbolKind::polygon, "", {{"", "", {253, 141, 60, 60}}}, 0.4})};
  VectorFeature f;
  f.polygons = outline(grid, cells);
  if (f.polygons.empty()) return layer;
  for (auto& rings : f.polygons)
    for (auto& ring : rings)
      for (Vec2& p : ring) p = map(p);
  f.values = {area, whole(static_cast<std::int64_t>(cells.size()))};
  layer.features.push_back(std::move(f));
  return layer;
}

// --- tables -------------------------------------------------------------------------------------

std::string block_csv(const Runs& runs) {
  std::string out = csv_line({"run_id", "block", "fate", "volume_m3", "mass_kg", "drop_m",
                              "path_length_m", "chord_length_m", "reach_angle_path_deg",
                              "reach_angle_chord_deg", "max_speed_m_s", "max_energy_kj"});
  for (const auto& [member, r] : runs)
    for (const BlockReach& b : r->event.blocks)
      out += csv_line({member->info.run_id, std::to_string(b.block), text(b.fate),
                       text(r->volume[b.block], 9), text(r->mass[b.block], 9),
                       text(b.reach.height, 9), text(b.reach.path, 9), text(b.reach.chord, 9),
                       text(b.reach.path_angle() * degrees, 7),
                       text(b.reach.chord_angle() * degrees, 7), text(b.max_speed, 7),
                       text(b.max_energy / 1e3, 7)});
  return out;
}

std::string curve_csv(const Runs& runs, const MapPlace& map) {
  std::string out =
      csv_line({"run_id", "time_s", "x_m", "y_m", "z_m", "mean_speed_m_s", "max_speed_m_s",
                "front_m", "translational_energy_kj", "rotational_energy_kj"});
  for (const auto& [member, r] : runs)
    for (const CurveRow& row : r->curves) {
      const Vec3 at = map(row.centre_of_mass);
      out += csv_line({member->info.run_id, text(row.time, 9), text(at.x(), 11), text(at.y(), 11),
                       text(at.z(), 9), text(row.mean_speed, 7), text(row.max_speed, 7),
                       text(row.front, 7), text(row.translation / 1e3, 7),
                       text(row.rotation / 1e3, 7)});
    }
  return out;
}

Json line_json(const ReachLine& line) {
  return {{"H_m", number_or_null(line.height)},
          {"L_path_m", number_or_null(line.path)},
          {"L_chord_m", number_or_null(line.chord)},
          {"reach_angle_path_deg", number_or_null(line.path_angle() * degrees)},
          {"reach_angle_chord_deg", number_or_null(line.chord_angle() * degrees)}};
}

Json balance_json(const Balance& b) {
  return {{"released_m3", b.released},  {"deposited_m3", b.deposited},
          {"moving_m3", b.moving},      {"left_domain_m3", b.left},
          {"n_released", b.n_released}, {"n_deposited", b.n_deposited},
          {"n_moving", b.n_moving},     {"n_left_domain", b.n_left}};
}

Json energy_json(const EnergyShares& s) {
  if (!(s.put_in > 0)) return {};
  return {
      {"put_in_kj", s.put_in / 1e3}, {"friction", s.friction},    {"impact", s.impact},
      {"contact", s.contact},        {"fence", s.fence},          {"removed", s.removed},
      {"kinetic_left", s.kinetic},   {"elastic_left", s.elastic}, {"unaccounted", s.unaccounted}};
}

Json run_json(const RunMember& member, const RunResult& r, double friction_deg) {
  const EventReach& e = r.event;
  Json centre = line_json(e.centre_of_mass);
  centre["H_over_L"] = number_or_null(e.centre_of_mass.height / e.centre_of_mass.path);
  centre["atan_sum_mH_over_sum_mL_deg"] = number_or_null(e.sum_angle * degrees);
  if (std::isfinite(friction_deg)) centre["tan_friction"] = std::tan(friction_deg / degrees);
  double max_speed = 0;
  for (const BlockReach& b : e.blocks) max_speed = std::max(max_speed, b.max_speed);
  return {{"run_id", member.info.run_id},
          {"seed", member.info.seed},
          {"status", member.info.status},
          {"event", line_json(e.event)},
          {"toe_block", e.toe_block},
          {"toe_is_deposited", e.toe_deposited},
          {"angle_monotone_along_path", e.profile.monotone},
          {"missing_head_m", number_or_null(e.profile.missing_head)},
          {"smallest_angle_along_path_deg", number_or_null(e.profile.smallest * degrees)},
          {"smallest_angle_at_m", number_or_null(e.profile.smallest_at)},
          {"centre_of_mass", centre},
          {"max_speed_m_s", max_speed},
          {"balance", balance_json(r.balance)},
          {"energy_shares", energy_json(r.energy)}};
}

// Spread of one number over the runs.
Json spread(const Runs& runs, double (*value)(const RunResult&)) {
  std::vector<WeightedValue> values;
  double sum = 0;
  for (const auto& [member, r] : runs)
    if (const double v = value(*r); std::isfinite(v)) values.push_back({v, 1}), sum += v;
  if (values.empty()) return {};
  sort_values(values);
  return {{"n", values.size()},
          {"mean", sum / static_cast<double>(values.size())},
          {"min", values.front().value},
          {"p05", weighted_percentile(values, 0.05)},
          {"p50", weighted_percentile(values, 0.5)},
          {"p95", weighted_percentile(values, 0.95)},
          {"max", values.back().value}};
}

Json spread_json(const Runs& runs) {
  return {{"H_m", spread(runs, [](const RunResult& r) { return r.event.event.height; })},
          {"L_path_m", spread(runs, [](const RunResult& r) { return r.event.event.path; })},
          {"L_chord_m", spread(runs, [](const RunResult& r) { return r.event.event.chord; })},
          {"reach_angle_path_deg",
           spread(runs, [](const RunResult& r) { return r.event.event.path_angle() * degrees; })},
          {"reach_angle_chord_deg",
           spread(runs, [](const RunResult& r) { return r.event.event.chord_angle() * degrees; })},
          {"H_cm_over_L_cm", spread(runs, [](const RunResult& r) {
             return r.event.centre_of_mass.height / r.event.centre_of_mass.path;
           })}};
}

// The relations mostly use the chord or the axis of the path: L is the chord.
std::vector<MobilityEvent> events_of(const Runs& runs, bool confined) {
  std::vector<MobilityEvent> events;
  for (const auto& [member, r] : runs)
    events.push_back({member->info.run_id, r->balance.released, r->event.event.height,
                      r->event.event.chord, confined});
  return events;
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
                      {"exceedance_probability", number_or_null(row.exceedance)}});
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

// --- the whole ----------------------------------------------------------------------------------

struct Ordered {
  std::vector<RunResult> results;
  Runs runs;  // in the order of run ids
  Balance balance;
  std::vector<std::uint32_t> cells;
  DepositSums deposit;
  Released released;
  PassageGrid grid;
};

Ordered read_runs(RunInputs& inputs, const Options& o, const Trn& trn) {
  Ordered out;
  inputs.read({.crossings = false, .checkpoint = false}, [&](RunFile& run, int) {
    out.results.push_back(result_of(run, trn, o, inputs.rest_speed_m_s));
    out.grid = run.grid.n_rows > 0 ? run.grid : passage_grid(trn, 0);
  });
  for (std::size_t i = 0; i < out.results.size(); ++i) {
    const RunResult& r = out.results[i];
    out.runs.emplace_back(&inputs.members[i], &r);
    add(out.balance, r.balance);
    add(out.deposit, r.deposit);
    out.cells.insert(out.cells.end(), r.cells.begin(), r.cells.end());
    out.released.weight.push_back(inputs.members[i].weight);
    out.released.n_blocks.push_back(inputs.members[i].n_blocks);
  }
  std::sort(out.cells.begin(), out.cells.end());
  out.cells.erase(std::unique(out.cells.begin(), out.cells.end()), out.cells.end());
  return out;
}

void write_thickness(Tool& tool, const Options& o, const Ordered& all, const Trn& trn,
                     const MapTags& tags, const std::string& remark) {
  MapLayer layer = deposit_layer(all.deposit, all.grid.cell_size, all.released);
  layer.bands.erase(layer.bands.begin(), layer.bands.begin() + 2);
  write_map(tool, map_frame(trn, all.grid, false, layer.cell), o.thickness, layer,
            map_style(layer, remark), tags);
}

// "101.4 to 103.3": smallest and largest of the runs.
template <class Value>
std::string range_of(const Runs& runs, int digits, const Value& value) {
  double low = value(*runs[0].second), high = low;
  for (const auto& run : runs) {
    low = std::min(low, value(*run.second));
    high = std::max(high, value(*run.second));
  }
  return text(low, digits) + " to " + text(high, digits);
}

std::string reach_of_runs(const Runs& runs) {
  const auto height = [](const RunResult& r) { return r.event.event.height; };
  const auto path = [](const RunResult& r) { return r.event.event.path; };
  const auto angle = [](const RunResult& r) { return r.event.event.path_angle() * degrees; };
  return "run-out of " + std::to_string(runs.size()) + " runs: H " + range_of(runs, 5, height) +
         " m, L " + range_of(runs, 5, path) + " m along the path, angle of reach " +
         range_of(runs, 4, angle) + " deg";
}

std::string reach_of_run(const std::string& run_id, const EventReach& reach) {
  const ReachLine& e = reach.event;
  const std::string out = "run-out of run " + run_id + ": H " + text(e.height, 5) + " m, L " +
                          text(e.path, 5) + " m along the path (" + text(e.chord, 5) +
                          " m straight), angle of reach " + text(e.path_angle() * degrees, 4) +
                          " deg (" + text(e.chord_angle() * degrees, 4) + " deg)";
  if (reach.profile.monotone) return out;
  return out + "\nenergy line: seen from the toe block's start the angle is smallest, " +
         text(reach.profile.smallest * degrees, 4) + " deg, at " +
         text(reach.profile.smallest_at, 4) +
         " m, not at the toe: a straight line from start to toe runs up to " +
         text(reach.profile.missing_head, 3) +
         " m below the ground, so an energy line of that angle stops short of the toe";
}

std::string summary_of(const Ordered& all) {
  std::string out = all.runs.size() > 1
                        ? reach_of_runs(all.runs)
                        : reach_of_run(all.runs[0].first->info.run_id, all.runs[0].second->event);
  out += "\nvolume: released " + text(all.balance.released, 6) + " m3 = deposited " +
         text(all.balance.deposited, 6) + " + moving " + text(all.balance.moving, 6) + " + left " +
         text(all.balance.left, 6);
  return out;
}

// The extent of a mass that stays where it is must not look like a run-out.
void warn_of_standing_mass(Tool& tool, const Runs& runs) {
  constexpr double hardly = 0.01;  // of L
  const auto stands = [](const auto& run) {
    const EventReach& event = run.second->event;
    return !(event.centre_of_mass.path > hardly * event.event.path);
  };
  const auto n = std::count_if(runs.begin(), runs.end(), stands);
  if (n == 0) return;
  tool.warn(std::to_string(n) + " of " + std::to_string(runs.size()) +
            " runs: the centre of mass moved less than 1 % of L; H, L and the angle of reach are "
            "the extent of a mass that stands, no run-out");
}

void run_tool(Tool& tool, Options& o, RunInputs& inputs) {
  const std::vector<MobilityRelation> relations = mobility_relations(
      o.mobility.empty() ? parse_csv(shipped_data("mobility.csv"), "share/mobility.csv")
                         : read_csv(o.mobility));
  const Trn& trn = inputs.trn();
  const Ordered all = read_runs(inputs, o, trn);
  auto tags = tags_of(inputs.members);
  tags.insert(tags.begin(), {{"RUN_ID", tool.run_id()}, {"RUN_SET", inputs.run_set()}});
  const std::string remark = inputs.remark();
  if (!remark.empty()) tags.emplace_back("REMARK", remark);
  inputs.warn_of_ends();
  warn_of_standing_mass(tool, all.runs);

  const MapPlace map{trn.origin};
  double area = 0;
  const std::vector<VectorLayer> layers = {envelope_layer(all.cells, all.grid, map, area),
                                           deposit_layer_of(all.runs, map),
                                           path_layer(all.runs, map, o.tolerance_m),
                                           path_point_layer(all.runs, map),
                                           streamline_layer(all.runs, map),
                                           end_layer(all.runs, map)};
  write_geopackage(tool.stage(o.out), trn.crs_wkt, layers, tags);
  const std::vector<MobilityEvent> events = events_of(all.runs, o.confined);
  if (!o.csv.empty()) tool.write_text(o.csv, block_csv(all.runs));
  if (!o.curves.empty()) tool.write_text(o.curves, curve_csv(all.runs, map));
  if (!o.svg.empty()) tool.write_text(o.svg, mobility_svg(relations, events));
  if (!o.thickness.empty()) write_thickness(tool, o, all, trn, tags, remark);

  Json runs = Json::array(), tag_list;
  for (const auto& [member, r] : all.runs) runs.push_back(run_json(*member, *r, o.friction_deg));
  for (const auto& [key, value] : tags) tag_list[key] = value;
  tool.result({{"run_id", tool.run_id()},
               {"tags", tag_list},
               {"balance", balance_json(all.balance)},
               {"swept_area_m2", area},
               {"path_tolerance_m", o.tolerance_m},
               {"spread_over_runs", spread_json(all.runs)},
               {"runs", runs},
               {"mobility", mobility_json(relations, events)}},
              summary_of(all));
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  Tool tool("talus-runout", "How far runs came: deposit, paths, angle of reach, mobility.");
  RunInputs runs(tool);
  declare(tool, options);
  return tool.run(argc, argv, [&] { run_tool(tool, options, runs); });
}
