#include "tools/trace/layers.hpp"

#include <array>
#include <cmath>

#include "base/csv.hpp"
#include "base/file_paths.hpp"
#include "base/text.hpp"
#include "post/hazard/hazard_maps.hpp"
#include "post/maps/ramp.hpp"
#include "setup/site_places_gdal.hpp"

namespace talus {
namespace {

using Polygons = std::vector<std::vector<std::vector<Vec2>>>;

void move(Polygons& polygons, const Vec2& by) {
  for (auto& rings : polygons)
    for (auto& ring : rings)
      for (Vec2& p : ring) p += by;
}

Polygons area_on_map(const RecordObject& object, const Vec2& origin) {
  Polygons out = polygons_of(object);
  move(out, origin);
  return out;
}

Polygons square_of(const TraceSums& sums, std::uint32_t source, const Vec2& origin) {
  const Vec2 at = place_of_source(sums, source) + origin;
  const double h = sums.sources.cell_size / 2;
  return {{{at + Vec2(-h, -h), at + Vec2(h, -h), at + Vec2(h, h), at + Vec2(-h, h)}}};
}

FieldValue whole(double value) { return static_cast<std::int64_t>(value); }

// Classes of p_hit that source cells and links are drawn in.
constexpr std::array<double, 4> p_limits = {0.01, 0.1, 0.5, 1};

std::string p_class(double p) {
  for (std::size_t i = 0; i < p_limits.size(); ++i)
    if (p <= p_limits[i]) return std::to_string(i + 1);
  return std::to_string(p_limits.size());
}

VectorStyle p_style(SymbolKind kind, double size_mm) {
  VectorStyle style{kind, "p_class", {}, size_mm};
  double low = 0;
  for (std::size_t i = 0; i < p_limits.size(); ++i) {
    style.classes.push_back(
        {std::to_string(i + 1), "hits with probability " + text(low) + " - " + text(p_limits[i]),
         ramp_colour(Ramp::probability, (static_cast<double>(i) + 0.5) / p_limits.size())});
    low = p_limits[i];
  }
  return style;
}

VectorLayer object_layer(const TraceSums& sums, const std::vector<TracedObject>& objects,
                         const Vec2& origin) {
  VectorLayer layer{
      "objects",
      "endangered objects and what comes to them",
      GeometryType::multi_polygon,
      {{"object", FieldType::text},
       {"kind", FieldType::text},
       {"method", FieldType::text},
       {"n_runs_hit", FieldType::integer},
       {"n_hits", FieldType::integer}},
      {},
      vector_qml({SymbolKind::polygon, "", {{"", "", {200, 30, 30, 120}}}, 0.6, "\"object\""})};
  for (const char* name :
       {"run_share",          "run_share_lo",    "run_share_hi",       "hits_a_run",
        "block_share",        "volume_share",    "ke_p50_kj",          "ke_p95_kj",
        "ke_p95_hi_kj",       "ke_max_kj",       "top_height_p95_m",   "first_arrival_s",
        "deposited_m3_a_run", "sources_50",      "sources_90",         "sources_100",
        "frequency_per_a",    "return_period_a", "return_period_lo_a", "return_period_hi_a"})
    layer.fields.push_back({name, FieldType::real});
  for (std::size_t o = 0; o < objects.size(); ++o) {
    const ObjectTrace& t = objects[o].trace;
    const RecordObject& object = sums.objects[o];
    VectorFeature f;
    f.polygons = area_on_map(object, origin);
    const auto period = [](double rate) { return rate > 0 ? 1 / rate : std::nan(""); };
    f.values = {object.name,
                object.kind,
                t.method,
                whole(t.n_runs_hit),
                whole(t.n_hits),
                t.run_share,
                t.run_share_interval.low,
                t.run_share_interval.high,
                t.hits_a_run,
                t.weight_share,
                t.volume_share,
                t.energy.p50,
                t.energy.p95,
                t.energy.p95_high,
                t.energy.largest,
                t.top_height_p95,
                t.first_arrival,
                t.deposited_a_run,
                static_cast<double>(t.n_sources[0]),
                static_cast<double>(t.n_sources[1]),
                static_cast<double>(t.n_sources[2]),
                objects[o].rate,
                period(objects[o].rate),
                period(objects[o].rate_high),
                period(objects[o].rate_low)};
    layer.features.push_back(std::move(f));
  }
  return layer;
}

VectorLayer source_cell_layer(const TraceSums& sums, const std::vector<SourceLink>& links,
                              const Vec2& origin) {
  VectorLayer layer{"source_cells",
                    "cells that blocks were released in, once for each object that they hit",
                    GeometryType::multi_polygon,
                    {{"object", FieldType::text},
                     {"source_cell", FieldType::integer},
                     {"n_released", FieldType::integer},
                     {"n_none", FieldType::integer},
                     {"n_hits", FieldType::integer},
                     {"p_hit", FieldType::real},
                     {"share_of_hits", FieldType::real},
                     {"ke_p95_kj", FieldType::real},
                     {"p_class", FieldType::text}},
                    {},
                    vector_qml(p_style(SymbolKind::polygon, 0.1))};
  for (const SourceLink& link : links) {
    const TraceSource& source = sums.source.at(link.source);
    VectorFeature f;
    f.polygons = square_of(sums, link.source, origin);
    f.values = {sums.objects[static_cast<std::size_t>(link.object)].name,
                whole(link.source),
                whole(source.n),
                whole(source.n_none),
                whole(link.n_hits),
                link.p_hit,
                link.share_of_hits,
                link.energy_p95,
                p_class(link.p_hit)};
    layer.features.push_back(std::move(f));
  }
  return layer;
}

VectorLayer link_layer(const TraceSums& sums, const std::vector<SourceLink>& links,
                       const Trn& trn) {
  VectorLayer layer{"links",
                    "from a source cell to the mean place of its hits of an object",
                    GeometryType::line_zm,
                    {{"object", FieldType::text},
                     {"source_cell", FieldType::integer},
                     {"n_hits", FieldType::integer},
                     {"p_hit", FieldType::real},
                     {"share_of_hits", FieldType::real},
                     {"ke_p95_kj", FieldType::real},
                     {"p_class", FieldType::text}},
                    {},
                    vector_qml(p_style(SymbolKind::line, 0.3))};
  const auto on_ground = [&trn](const Vec2& at) {
    const double z = elevation_at(trn, at.x(), at.y());
    Vec3 point = trn.origin;
    point.head<2>() += at;
    if (!std::isnan(z)) point.z() += z;
    return point;
  };
  for (const SourceLink& link : links) {
    VectorFeature f;
    f.points = {on_ground(place_of_source(sums, link.source)), on_ground(link.place)};
    f.measure = {0, (f.points[1] - f.points[0]).head<2>().norm()};
    f.values = {sums.objects[static_cast<std::size_t>(link.object)].name,
                whole(link.source),
                whole(link.n_hits),
                link.p_hit,
                link.share_of_hits,
                link.energy_p95,
                p_class(link.p_hit)};
    layer.features.push_back(std::move(f));
  }
  return layer;
}

}  // namespace

std::vector<VectorLayer> trace_layers(const TraceSums& sums,
                                      const std::vector<TracedObject>& objects,
                                      const std::vector<SourceLink>& links, const Trn& trn) {
  const Vec2 origin = trn.origin.head<2>();
  return {object_layer(sums, objects, origin), link_layer(sums, links, trn),
          source_cell_layer(sums, links, origin)};
}

MapLayer source_layer(const TraceSums& sums, int object, const std::vector<SourceLink>& links) {
  MapLayer layer{
      "source_" + file_word(sums.objects[static_cast<std::size_t>(object)].name), {}, {}};
  std::map<std::uint32_t, std::size_t> place;
  MapBand released{"n_released", "1", "blocks released in the cell, all runs", false, {}};
  for (const auto& [cell, source] : sums.source) {
    place[cell] = layer.cell.size();
    layer.cell.push_back(cell);
    released.value.push_back(static_cast<float>(source.n));
  }
  const std::string name = sums.objects[static_cast<std::size_t>(object)].name;
  MapBand p{"p_hit", "1", "share of the blocks released in the cell that hit " + name, false,
            std::vector<float>(layer.cell.size(), 0)};
  MapBand share{"share_of_hits", "1", "share of the hits of " + name + " that come from the cell",
                false, std::vector<float>(layer.cell.size(), 0)};
  for (const SourceLink& link : links) {
    if (link.object != object) continue;
    p.value[place[link.source]] = static_cast<float>(link.p_hit);
    share.value[place[link.source]] = static_cast<float>(link.share_of_hits);
  }
  layer.bands = {std::move(p), std::move(share), std::move(released)};
  return layer;
}

RasterStyle source_style(const std::string& object, const std::string& remark) {
  RasterStyle style;
  style.title = "hits " + object + " [1]";
  style.heading = "Where blocks that hit " + object + " come from";
  style.legend = "Share of the blocks released in the cell that hit " + object;
  style.remark = remark;
  style.classes = stepped_classes({0, 0.01, 0.05, 0.1, 0.2, 0.5}, "", false, Ramp::probability);
  style.classes[0] = {0, {190, 190, 190, 255}, "0"};
  return style;
}

std::string link_csv(const TraceSums& sums, const std::vector<SourceLink>& links,
                     const Vec3& origin) {
  std::string out = csv_line({"object", "source_cell", "x_m", "y_m", "n_released", "n_none",
                              "n_hits", "p_hit", "share_of_hits", "ke_p95_kj"});
  for (const SourceLink& link : links) {
    const Vec2 at = place_of_source(sums, link.source) + origin.head<2>();
    const TraceSource& source = sums.source.at(link.source);
    out += csv_line({sums.objects[static_cast<std::size_t>(link.object)].name,
                     std::to_string(link.source), text(at.x(), 12), text(at.y(), 12),
                     text(source.n), text(source.n_none), std::to_string(link.n_hits),
                     text(link.p_hit, 6), text(link.share_of_hits, 6), text(link.energy_p95, 6)});
  }
  return out;
}

}  // namespace talus
