// Run-out as layers of the GeoPackage of talus-runout, with their styles.
#include "tools/runout/layers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/text.hpp"
#include "base/units.hpp"
#include "io/style.hpp"
#include "post/outline.hpp"
#include "post/runout/runout_fields.hpp"

namespace talus {
namespace {

struct MapPlace {
  Vec3 origin;
  [[nodiscard]] Vec3 operator()(const Vec3& local) const { return local + origin; }
  [[nodiscard]] Vec2 operator()(const Vec2& local) const { return local + origin.head<2>(); }
};

using Value = FieldValue;
using Run = const RunoutRun&;
constexpr FieldType words = FieldType::text, whole = FieldType::integer;
constexpr double kilo = 1e3;

VectorLayer deposit_layer_of(const std::vector<RunoutRun>& runs, const MapPlace& map) {
  VectorLayer layer{"deposit",
                    "footprint of each block at the end of its run",
                    GeometryType::multi_polygon,
                    vector_fields(block_fields()),
                    {},
                    vector_qml({SymbolKind::polygon,
                                "fate",
                                {{"deposited", "at rest", {166, 118, 29, 180}},
                                 {"moving", "still moving", {227, 26, 28, 180}},
                                 {"left_domain", "left the terrain", {120, 120, 120, 180}}},
                                0.15})};
  for (const RunoutRun& r : runs)
    for (const BlockReach& b : r.event.blocks) {
      VectorFeature f;
      f.polygons = {{{}}};
      for (const Vec2& p : r.footprints[b.block]) f.polygons[0][0].push_back(map(p));
      f.values = values_of(block_fields(), {r, b, map.origin});
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

// NaN where all are.
double largest(const std::vector<double>& values) {
  double most = std::numeric_limits<double>::quiet_NaN();
  for (const double value : values)
    if (!(value <= most) && !std::isnan(value)) most = value;
  return most;
}

std::int64_t n_impacts(const TimedPath& path) {
  return std::count(path.is_impact.begin(), path.is_impact.end(), true);
}

struct BlockPath {
  Run run;
  const BlockReach& block;
  const TimedPath& path;
};
const std::vector<Field<BlockPath>>& path_fields() {
  using Path = const BlockPath&;
  static const std::vector<Field<BlockPath>> fields = {
      {"run_id", "", "Run", [](Path p) -> Value { return p.run.member.info.run_id; }, words},
      {"block", "", "Block", [](Path p) -> Value { return p.block.block; }, whole},
      {"volume_m3", "m3", "Volume", [](Path p) -> Value { return p.run.volume[p.block.block]; }},
      {"mass_kg", "kg", "Mass", [](Path p) -> Value { return p.run.mass[p.block.block]; }},
      {"path_length_m", "m", "Length of the path in plan",
       [](Path p) -> Value { return p.block.reach.path; }},
      {"max_speed_m_s", "m/s", "Largest speed", [](Path p) -> Value { return p.block.max_speed; }},
      {"max_energy_kj", "kJ", "Largest kinetic energy, with spin",
       [](Path p) -> Value { return p.block.max_energy / kilo; }},
      {"max_height_m", "m", "Largest height of the centroid above the ground, in the frames",
       [](Path p) -> Value { return largest(p.path.height); }},
      {"max_spin_rad_s", "rad/s", "Largest spin, in the frames",
       [](Path p) -> Value { return largest(p.path.spin); }},
      {"n_impacts", "", "Number of impacts", [](Path p) -> Value { return n_impacts(p.path); },
       whole},
      {"duration_s", "s", "Duration",
       [](Path p) -> Value { return p.path.time.back() - p.path.time.front(); }}};
  return fields;
}

VectorLayer path_layer(const std::vector<RunoutRun>& runs, const MapPlace& map, double tolerance) {
  VectorLayer layer{
      "paths",
      "path of each block's centroid, M = time in s, simplified to " + text(tolerance) + " m",
      GeometryType::line_zm,
      vector_fields(path_fields()),
      {},
      vector_qml({SymbolKind::line, "", {{"", "", {31, 78, 121, 160}}}, 0.3})};
  for (const RunoutRun& r : runs)
    for (const BlockReach& b : r.event.blocks) {
      if (!r.has_frames) break;
      const TimedPath& path = r.paths[b.block];
      if (path.point.empty()) continue;
      VectorFeature f = line_feature(path.point, path.time, map);
      f.values = values_of(path_fields(), {r, b, path});
      layer.features.push_back(std::move(f));
    }
  return layer;
}

// The block that a point of a path is of.
struct PathOwner {
  Run run;
  std::size_t block;
};
const std::vector<Field<PathOwner>>& owner_fields() {
  using Owner = const PathOwner&;
  static const std::vector<Field<PathOwner>> fields = {
      {"run_id", "", "Run", [](Owner o) -> Value { return o.run.member.info.run_id; }, words},
      {"block", "", "Block", [](Owner o) -> Value { return static_cast<std::int64_t>(o.block); },
       whole},
      {"volume_m3", "m3", "Volume", [](Owner o) -> Value { return o.run.volume[o.block]; }},
      {"mass_kg", "kg", "Mass", [](Owner o) -> Value { return o.run.mass[o.block]; }}};
  return fields;
}

VectorLayer point_layer(const char* name, const char* what, const Colour& colour, bool of_impacts,
                        const std::vector<Field<PathPoint>>& fields,
                        const std::vector<RunoutRun>& runs, const MapPlace& map) {
  VectorLayer layer{name,
                    what,
                    GeometryType::point_z,
                    vector_fields(owner_fields()),
                    {},
                    vector_qml({SymbolKind::point, "", {{"", "", colour}}, 0.8})};
  for (VectorField& field : vector_fields(fields)) layer.fields.push_back(std::move(field));
  for (const RunoutRun& r : runs)
    for (std::size_t b = 0; b < r.paths.size(); ++b)
      for (std::size_t i = 0; i < r.paths[b].point.size(); ++i) {
        if (of_impacts && !r.paths[b].is_impact[i]) continue;
        VectorFeature f;
        f.points = {map(r.paths[b].point[i])};
        f.values = values_of(owner_fields(), {r, b});
        for (FieldValue& value : values_of(fields, {r.paths[b], i}))
          f.values.push_back(std::move(value));
        layer.features.push_back(std::move(f));
      }
  return layer;
}

VectorLayer streamline_layer(const std::vector<RunoutRun>& runs, const MapPlace& map) {
  VectorLayer layer{"streamline",
                    "from the top of the source to the toe of the deposit, M = horizontal "
                    "distance in m",
                    GeometryType::line_zm,
                    vector_fields(run_fields()),
                    {},
                    vector_qml({SymbolKind::line,
                                "",
                                {{"", "", {200, 30, 30, 255}}},
                                0.8,
                                "CASE WHEN \"L_path_m\" = maximum(\"L_path_m\") THEN 'L ' || "
                                "round(\"L_path_m\") || ' m, H ' || round(\"H_m\") || ' m' END"})};
  for (const RunoutRun& r : runs) {
    const EventReach& e = r.event;
    if (e.streamline.empty()) continue;
    std::vector<double> distance{0};
    for (std::size_t i = 1; i < e.streamline.size(); ++i)
      distance.push_back(distance.back() +
                         (e.streamline[i] - e.streamline[i - 1]).head<2>().norm());
    VectorFeature f = line_feature(e.streamline, distance, map);
    f.values = values_of(run_fields(), r);
    layer.features.push_back(std::move(f));
  }
  return layer;
}

struct ReachPoint {
  Run run;
  const char* what;
};
const std::vector<Field<ReachPoint>>& reach_point_fields() {
  using Point = const ReachPoint&;
  static const std::vector<Field<ReachPoint>> fields = {
      {"run_id", "", "Run", [](Point p) -> Value { return p.run.member.info.run_id; }, words},
      {"what", "", "Point", [](Point p) -> Value { return p.what; }, words}};
  return fields;
}

VectorLayer end_layer(const std::vector<RunoutRun>& runs, const MapPlace& map) {
  VectorLayer layer{"reach_points",
                    "top of the source and toe of the deposit",
                    GeometryType::point_z,
                    vector_fields(reach_point_fields()),
                    {},
                    vector_qml({SymbolKind::point,
                                "what",
                                {{"top", "top of the source", {255, 255, 255, 255}},
                                 {"toe", "toe of the deposit", {200, 30, 30, 255}}},
                                2.4})};
  for (const RunoutRun& r : runs) {
    if (r.event.streamline.empty()) continue;
    for (const auto& [what, at] : {std::pair{"top", r.event.top}, {"toe", r.event.toe}}) {
      VectorFeature f;
      f.points = {map(at)};
      f.values = values_of(reach_point_fields(), {r, what});
      layer.features.push_back(std::move(f));
    }
  }
  return layer;
}

VectorLayer run_layer(const std::vector<RunoutRun>& runs, const MapPlace& map) {
  VectorLayer layer{"runs",
                    "centre of mass at the end of each run, with how much of the mass moved",
                    GeometryType::point_z,
                    vector_fields(run_fields()),
                    {},
                    vector_qml({SymbolKind::point,
                                "status",
                                {{"done", "centre of mass", {31, 78, 121, 255}},
                                 {"failed", "run failed its checks", {200, 30, 30, 255}},
                                 {"running", "run not finished", {120, 120, 120, 255}}},
                                2})};
  for (const RunoutRun& r : runs) {
    VectorFeature f;
    f.points = {map(r.curves.empty() ? Vec3(Vec3::Zero()) : r.curves.back().centre_of_mass)};
    f.values = values_of(run_fields(), r);
    layer.features.push_back(std::move(f));
  }
  return layer;
}

const std::vector<Field<RunoutRuns>>& envelope_fields() {
  using All = const RunoutRuns&;
  static const std::vector<Field<RunoutRuns>> fields = {
      {"area_m2", "m2", "Area", [](All all) -> Value { return swept_area(all); }},
      {"n_cells", "", "Number of cells",
       [](All all) -> Value { return static_cast<std::int64_t>(all.cells.size()); }, whole}};
  return fields;
}

VectorLayer envelope_layer(const RunoutRuns& all, const MapPlace& map) {
  VectorLayer layer{"envelope",
                    "outline of all cells that any block of any run passed",
                    GeometryType::multi_polygon,
                    vector_fields(envelope_fields()),
                    {},
                    vector_qml({SymbolKind::polygon, "", {{"", "", {253, 141, 60, 60}}}, 0.4})};
  VectorFeature f;
  f.polygons = outline(all.grid, all.cells);
  if (f.polygons.empty()) return layer;
  for (auto& rings : f.polygons)
    for (auto& ring : rings)
      for (Vec2& p : ring) p = map(p);
  f.values = values_of(envelope_fields(), all);
  layer.features.push_back(std::move(f));
  return layer;
}

}  // namespace

std::vector<VectorLayer> runout_layers(const RunoutRuns& all, const Vec3& origin,
                                       double tolerance) {
  const MapPlace map{origin};
  return {envelope_layer(all, map),
          deposit_layer_of(all.runs, map),
          path_layer(all.runs, map, tolerance),
          point_layer("path_points", "points of the simplified paths", {31, 78, 121, 255}, false,
                      path_point_fields(), all.runs, map),
          point_layer("impacts", "impacts of the blocks, at the first frame after each",
                      {200, 30, 30, 255}, true, impact_fields(), all.runs, map),
          streamline_layer(all.runs, map),
          end_layer(all.runs, map),
          run_layer(all.runs, map)};
}

}  // namespace talus
