#include "tools/runout/layers.hpp"

#include "base/text.hpp"
#include "base/units.hpp"
#include "io/style.hpp"
#include "post/outline.hpp"

namespace talus {
namespace {

struct MapPlace {
  Vec3 origin;
  [[nodiscard]] Vec3 operator()(const Vec3& local) const { return local + origin; }
  [[nodiscard]] Vec2 operator()(const Vec2& local) const { return local + origin.head<2>(); }
};

FieldValue whole(std::int64_t value) { return value; }

VectorLayer deposit_layer_of(const std::vector<RunoutRun>& runs, const MapPlace& map) {
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
                     {"max_energy_kj", FieldType::real},
                     {"displacement_m", FieldType::real}},
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
      f.values = {r.member.info.run_id,
                  whole(b.block),
                  std::string(text(b.fate)),
                  r.volume[b.block],
                  r.mass[b.block],
                  map(r.end[b.block]).z(),
                  b.reach.height,
                  b.reach.path,
                  b.reach.chord,
                  b.reach.path_angle() / degree,
                  b.reach.chord_angle() / degree,
                  b.max_speed,
                  b.max_energy / 1e3,
                  r.displacement[b.block]};
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

VectorLayer path_layer(const std::vector<RunoutRun>& runs, const MapPlace& map, double tolerance) {
  VectorLayer layer{
      "paths",
      "path of each block's centroid, M = time in s, simplified to " + text(tolerance) + " m",
      GeometryType::line_zm,
      {{"run_id", FieldType::text},
       {"block", FieldType::integer},
       {"path_length_m", FieldType::real},
       {"max_speed_m_s", FieldType::real},
       {"duration_s", FieldType::real}},
      {},
      vector_qml({SymbolKind::line, "", {{"", "", {31, 78, 121, 160}}}, 0.3})};
  for (const RunoutRun& r : runs)
    for (const BlockReach& b : r.event.blocks) {
      if (!r.has_frames) break;
      const TimedPath& path = r.paths[b.block];
      if (path.point.empty()) continue;
      VectorFeature f = line_feature(path.point, path.time, map);
      f.values = {r.member.info.run_id, whole(b.block), b.reach.path, b.max_speed,
                  path.time.back() - path.time.front()};
      layer.features.push_back(std::move(f));
    }
  return layer;
}

VectorLayer path_point_layer(const std::vector<RunoutRun>& runs, const MapPlace& map) {
  VectorLayer layer{"path_points",
                    "points of the simplified paths",
                    GeometryType::point_z,
                    {{"run_id", FieldType::text},
                     {"block", FieldType::integer},
                     {"time_s", FieldType::real},
                     {"speed_m_s", FieldType::real}},
                    {},
                    vector_qml({SymbolKind::point, "", {{"", "", {31, 78, 121, 255}}}, 0.8})};
  for (const RunoutRun& r : runs)
    for (std::size_t b = 0; b < r.paths.size(); ++b)
      for (std::size_t i = 0; i < r.paths[b].point.size(); ++i) {
        VectorFeature f;
        f.points = {map(r.paths[b].point[i])};
        f.values = {r.member.info.run_id, whole(static_cast<std::int64_t>(b)), r.paths[b].time[i],
                    r.paths[b].speed[i]};
        layer.features.push_back(std::move(f));
      }
  return layer;
}

VectorLayer streamline_layer(const std::vector<RunoutRun>& runs, const MapPlace& map) {
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
    f.values = {r.member.info.run_id,
                e.event.height,
                e.event.path,
                e.event.chord,
                e.event.path_angle() / degree,
                e.event.chord_angle() / degree,
                whole(e.profile.monotone ? 1 : 0),
                e.profile.smallest / degree};
    layer.features.push_back(std::move(f));
  }
  return layer;
}

VectorLayer end_layer(const std::vector<RunoutRun>& runs, const MapPlace& map) {
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
  for (const RunoutRun& r : runs) {
    if (r.event.streamline.empty()) continue;
    for (const auto& [what, at] : {std::pair{"top", r.event.top}, {"toe", r.event.toe}}) {
      VectorFeature f;
      f.points = {map(at)};
      f.values = {r.member.info.run_id, std::string(what)};
      layer.features.push_back(std::move(f));
    }
  }
  return layer;
}

std::vector<VectorField> run_fields() {
  std::vector<VectorField> fields = {{"run_id", FieldType::text},
                                     {"seed", FieldType::integer},
                                     {"status", FieldType::text},
                                     {"moved", FieldType::integer}};
  for (const char* name :
       {"share_moved_1_m", "share_moved_20_m", "displacement_p50_m", "displacement_p90_m",
        "displacement_p95_m", "displacement_max_m", "H_m", "L_path_m", "L_chord_m",
        "reach_angle_path_deg", "reach_angle_chord_deg"})
    fields.push_back({name, FieldType::real});
  fields.push_back({"toe_fate", FieldType::text});
  for (const char* name : {"moved_volume_m3", "H95_m", "L95_m", "reach_angle_95_deg"})
    fields.push_back({name, FieldType::real});
  fields.push_back({"outliers", FieldType::integer});
  return fields;
}

std::vector<FieldValue> run_values(const RunoutRun& r) {
  const Moved& m = r.event.moved;
  const ReachLine& e = r.event.event;
  const MassReach& mass = r.event.mass;
  return {r.member.info.run_id,
          whole(r.member.info.seed),
          r.member.info.status,
          whole(m.any() ? 1 : 0),
          m.share,
          m.share_far,
          m.p50,
          m.p90,
          m.p95,
          m.largest,
          e.height,
          e.path,
          e.chord,
          e.path_angle() / degree,
          e.chord_angle() / degree,
          m.any() ? FieldValue(std::string(text(r.event.toe_fate))) : FieldValue(),
          mass.moved_volume,
          mass.height,
          mass.length,
          mass.angle() / degree,
          whole(mass.n_outliers)};
}

VectorLayer run_layer(const std::vector<RunoutRun>& runs, const MapPlace& map) {
  VectorLayer layer{"runs",
                    "centre of mass at the end of each run, with how much of the mass moved",
                    GeometryType::point_z,
                    run_fields(),
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
    f.values = run_values(r);
    layer.features.push_back(std::move(f));
  }
  return layer;
}

VectorLayer envelope_layer(const RunoutRuns& all, const MapPlace& map) {
  VectorLayer layer{"envelope",
                    "outline of all cells that any block of any run passed",
                    GeometryType::multi_polygon,
                    {{"area_m2", FieldType::real}, {"n_cells", FieldType::integer}},
                    {},
                    vector_qml({SymbolKind::polygon, "", {{"", "", {253, 141, 60, 60}}}, 0.4})};
  VectorFeature f;
  f.polygons = outline(all.grid, all.cells);
  if (f.polygons.empty()) return layer;
  for (auto& rings : f.polygons)
    for (auto& ring : rings)
      for (Vec2& p : ring) p = map(p);
  f.values = {swept_area(all), whole(static_cast<std::int64_t>(all.cells.size()))};
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
          path_point_layer(all.runs, map),
          streamline_layer(all.runs, map),
          end_layer(all.runs, map),
          run_layer(all.runs, map)};
}

}  // namespace talus
