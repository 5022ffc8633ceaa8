// Observations beside results, as layers and as JSON.
#include "tools/calibrate/layers.hpp"

#include <utility>

#include "io/style.hpp"
#include "post/observed/observed_fields.hpp"
#include "tools/frame/row_json.hpp"

namespace talus {
namespace {

template <class Row>
VectorLayer point_layer(const std::vector<Field<Row>>& fields, const std::vector<Row>& rows,
                        const Vec3& origin, VectorLayer layer) {
  layer.type = GeometryType::point;
  layer.fields = vector_fields(fields);
  for (const Row& row : rows) {
    VectorFeature& feature = layer.features.emplace_back();
    feature.points.emplace_back(row.point.place.x() + origin.x(), row.point.place.y() + origin.y(),
                                0);
    feature.values = values_of(fields, row);
  }
  return layer;
}

VectorLayer outline_layer(const std::vector<ObservedEvent>& events,
                          const std::vector<EventScore>& scores, const Vec3& origin) {
  VectorLayer layer{"observed_outlines",
                    "outlines of observed deposits",
                    GeometryType::multi_polygon,
                    vector_fields(outline_fields()),
                    {},
                    vector_qml({SymbolKind::polygon, "", {{"", "", {0, 0, 0, 255}, "no"}}, 0.5})};
  for (std::size_t e = 0; e < events.size(); ++e) {
    if (!scores[e].outline) continue;
    VectorFeature& feature = layer.features.emplace_back();
    int last = -1;  // polygon
    for (std::size_t r = 0; r < events[e].outline.rings.size(); ++r) {
      if (std::exchange(last, events[e].polygon[r]) != events[e].polygon[r])
        feature.polygons.emplace_back();
      std::vector<Vec2>& ring = feature.polygons.back().emplace_back(events[e].outline.rings[r]);
      for (Vec2& corner : ring) corner += origin.head<2>();
    }
    feature.values = values_of(outline_fields(), {scores[e].name, *scores[e].outline});
  }
  return layer;
}

Json json_of(const Compared& compared) {
  return {{"observed", number_or_null(compared.observed)},
          {"low", number_or_null(compared.interval.low)},
          {"high", number_or_null(compared.interval.high)},
          {"computed", number_or_null(compared.computed)}};
}

// Points with their places on the map.
template <class Row>
Json points_json(const std::vector<Field<Row>>& fields, const std::vector<Row>& rows,
                 const Vec3& origin) {
  Json list = Json::array();
  for (const Row& row : rows) {
    list.push_back(row_json(fields, row));
    list.back().update(
        {{"x_m", row.point.place.x() + origin.x()}, {"y_m", row.point.place.y() + origin.y()}});
  }
  return list;
}

Json interval_json(const Interval& interval) {
  return {number_or_null(interval.low), number_or_null(interval.high)};
}

Json boulders_json(const BoulderScore& score, const Vec3& origin) {
  Json levels = Json::array(), curve = Json::array();
  for (std::size_t k = 0; k < observed_levels.size(); ++k) {
    levels.push_back(json_of(score.levels[k]));
    levels.back().update(
        {{"p", observed_levels[k]}, {"needed", points_needed(observed_levels[k])}});
  }
  for (const double runout : score.computed_percentiles) curve.push_back(number_or_null(runout));
  const Vec2 start = score.axis.start + origin.head<2>();
  return {{"n", score.rows.size()},
          {"start_m", {start.x(), start.y()}},
          {"own_starts", score.axis.has_starts},
          {"along", {score.axis.along.x(), score.axis.along.y()}},
          {"mean_runout_m", json_of(score.mean)},
          {"runout_m", levels},
          {"across_m", json_of(score.across)},
          {"area_m", number_or_null(score.area)},
          {"noise_m", number_or_null(score.noise)},
          {"noise_high_m", number_or_null(score.noise_high)},
          {"told_apart", score.is_told_apart()},
          {"mean_percentile", number_or_null(score.mean_percentile)},
          {"by_chance", interval_json(score.by_chance)},
          {"in_reach", json_of(score.reached)},
          {"computed_runout_m", curve},
          {"points", points_json(boulder_fields(), score.rows, origin)}};
}

}  // namespace

std::vector<VectorLayer> observed_layers(const std::vector<ObservedEvent>& events,
                                         const std::vector<EventScore>& scores,
                                         const Vec3& origin) {
  std::vector<BoulderRow> boulders;
  std::vector<ScarRow> scars;
  bool any_outline = false;
  for (const EventScore& score : scores) {
    if (score.boulders)
      boulders.insert(boulders.end(), score.boulders->rows.begin(), score.boulders->rows.end());
    if (score.scars) scars.insert(scars.end(), score.scars->rows.begin(), score.scars->rows.end());
    any_outline = any_outline || score.outline;
  }
  std::vector<VectorLayer> layers;
  if (!boulders.empty())
    layers.push_back(
        point_layer(boulder_fields(), boulders, origin,
                    {"observed_boulders",
                     "observed boulders, and where their run-outs stand among the computed ones",
                     {},
                     {},
                     {},
                     vector_qml({SymbolKind::point,
                                 "in_reach",
                                 {{"1", "in the computed reach", {0, 0, 0, 255}},
                                  {"0", "beyond the computed reach", {200, 30, 30, 255}}},
                                 2.4})}));
  if (!scars.empty())
    layers.push_back(point_layer(
        scar_fields(), scars, origin,
        {"observed_scars",
         "observed scars, and where their heights stand among the computed ones",
         {},
         {},
         {},
         vector_qml(
             {SymbolKind::point, "", {{"", "", {27, 120, 55, 255}}}, 2.4, "\"height_m\""})}));
  if (any_outline) layers.push_back(outline_layer(events, scores, origin));
  return layers;
}

Json event_json(const ObservedEvent& event, const EventScore& score, const Vec3& origin) {
  Json out = {{"event", score.name}};
  if (score.boulders) out["boulders"] = boulders_json(*score.boulders, origin);
  if (score.scars)
    out["scars"] = {{"n", score.scars->rows.size()},
                    {"n_passed", score.scars->n_passed},
                    {"mean_percentile", number_or_null(score.scars->mean_percentile)},
                    {"by_chance", interval_json(score.scars->by_chance)},
                    {"points", points_json(scar_fields(), score.scars->rows, origin)}};
  if (score.outline) {
    out["outline"] = row_json(outline_fields(), OutlineRow{score.name, *score.outline});
    Json& rings = out["outline"]["rings_m"] = Json::array();
    for (const std::vector<Vec2>& ring : event.outline.rings) {
      rings.push_back(Json::array());
      for (const Vec2& corner : ring)
        rings.back().push_back({corner.x() + origin.x(), corner.y() + origin.y()});
    }
  }
  return out;
}

Json calibration_json(const Calibration& calibration, const std::vector<RunMember>& runs) {
  Json keys = Json::array(), judged = Json::array(), points = Json::array(), layers = Json::array();
  for (std::size_t k = 0; k < calibration.keys.size(); ++k) {
    const DrawnRange all = drawn_range(calibration, k, false),
                     set = drawn_range(calibration, k, true);
    keys.push_back({{"key", calibration.keys[k]},
                    {"low", number_or_null(all.low)},
                    {"high", number_or_null(all.high)},
                    {"set_low", number_or_null(set.low)},
                    {"set_high", number_or_null(set.high)}});
  }
  for (const JudgedRun& run : calibration.runs)
    judged.push_back({{"seed", runs[static_cast<std::size_t>(run.run)].info.seed},
                      {"implausibility", number_or_null(run.implausibility)},
                      {"worst", run.worst},
                      {"drawn", run.drawn}});
  for (const LeftOutPoint& point : calibration.points)
    points.push_back({{"layer", text(point.kind, point.event)},
                      {"point", point.point + 1},
                      {"n_plausible", point.n_plausible},
                      {"percentile", number_or_null(point.percentile)}});
  for (const LeftOutLayer& layer : calibration.layers)
    layers.push_back({{"layer", text(layer.kind, layer.event)},
                      {"n_plausible", layer.n_plausible},
                      {"n_contradicted", layer.n_contradicted}});
  const LeftOutCount count = left_out_count(calibration);
  return {{"n_runs", calibration.runs.size()},
          {"n_plausible", n_plausible(calibration)},
          {"most_implausible", most_implausible},
          {"keys", keys},
          {"left_out", {{"n", count.n}, {"n_within", count.n_within}}},
          {"left_out_layers", layers},
          {"left_out_points", points},
          {"runs", judged}};
}

}  // namespace talus
