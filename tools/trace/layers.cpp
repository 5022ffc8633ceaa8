// Objects, source cells and links as layers, rasters and rows.
#include "tools/trace/layers.hpp"

#include <array>
#include <cmath>

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

using Value = FieldValue;
constexpr FieldType words = FieldType::text, whole = FieldType::integer;

Value counted_value(double n) { return static_cast<std::int64_t>(n); }

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

struct ObjectRow {
  const RecordObject& object;
  const TracedObject& traced;
  const Recipe& recipe;
  [[nodiscard]] Value risk(double Rate::*bound) const {
    return traced.risk ? traced.risk->individual.*bound : std::nan("");
  }
  [[nodiscard]] std::string of_class(std::string RecipeClass::*field) const {
    return traced.risk ? recipe.classes[traced.risk->kind].*field : std::string();
  }
};
const std::vector<Field<ObjectRow>>& object_fields() {
  using Row = const ObjectRow&;
  static constexpr auto period = [](double rate) { return rate > 0 ? 1 / rate : std::nan(""); };
  static const std::vector<Field<ObjectRow>> fields = {
      {"object", "", "Object", [](Row r) -> Value { return r.object.name; }, words},
      {"kind", "", "Kind", [](Row r) -> Value { return r.object.kind; }, words},
      {"method", "", "How hits are known", [](Row r) -> Value { return r.traced.trace.method; },
       words},
      {"n_runs_hit", "", "Number of runs that hit it",
       [](Row r) -> Value { return r.traced.trace.n_runs_hit; }, whole},
      {"n_hits", "", "Number of hits", [](Row r) -> Value { return r.traced.trace.n_hits; }, whole},
      {"run_share", "", "Share of runs that hit it",
       [](Row r) -> Value { return r.traced.trace.run_share; }},
      {"run_share_lo", "", "Share of runs that hit it, lower bound",
       [](Row r) -> Value { return r.traced.trace.run_share_interval.low; }},
      {"run_share_hi", "", "Share of runs that hit it, upper bound",
       [](Row r) -> Value { return r.traced.trace.run_share_interval.high; }},
      {"hits_a_run", "", "Hits a run", [](Row r) -> Value { return r.traced.trace.hits_a_run; }},
      {"block_share", "", "Share of blocks that hit it",
       [](Row r) -> Value { return r.traced.trace.weight_share; }},
      {"volume_share", "", "Share of the volume that hits it",
       [](Row r) -> Value { return r.traced.trace.volume_share; }},
      {"ke_p50_kj", "kJ", "Kinetic energy, median",
       [](Row r) -> Value { return r.traced.trace.energy.p50; }},
      {"ke_p95_kj", "kJ", "Kinetic energy, 95th percentile",
       [](Row r) -> Value { return r.traced.trace.energy.p95; }},
      {"ke_p95_hi_kj", "kJ", "Kinetic energy, 95th percentile, upper bound",
       [](Row r) -> Value { return r.traced.trace.energy.p95_high; }},
      {"ke_max_kj", "kJ", "Kinetic energy, largest",
       [](Row r) -> Value { return r.traced.trace.energy.largest; }},
      {"top_height_p95_m", "m", "Height of the top, 95th percentile",
       [](Row r) -> Value { return r.traced.trace.top_height_p95; }},
      {"first_arrival_s", "s", "First arrival",
       [](Row r) -> Value { return r.traced.trace.first_arrival; }},
      {"deposited_m3_a_run", "m3", "Volume deposited on it a run",
       [](Row r) -> Value { return r.traced.trace.deposited_a_run; }},
      {"sources_50", "", "Source cells of half the hits",
       [](Row r) -> Value { return double(r.traced.trace.n_sources[0]); }},
      {"sources_90", "", "Source cells of 90 % of the hits",
       [](Row r) -> Value { return double(r.traced.trace.n_sources[1]); }},
      {"sources_100", "", "Source cells of all hits",
       [](Row r) -> Value { return double(r.traced.trace.n_sources[2]); }},
      {"frequency_per_a", "1/a", "Frequency", [](Row r) -> Value { return r.traced.rate; }},
      {"return_period_a", "a", "Return period",
       [](Row r) -> Value { return period(r.traced.rate); }},
      {"return_period_lo_a", "a", "Return period, lower bound",
       [](Row r) -> Value { return period(r.traced.rate_high); }},
      {"return_period_hi_a", "a", "Return period, upper bound",
       [](Row r) -> Value { return period(r.traced.rate_low); }},
      {"risk_per_a", "1/a", "Annual individual risk", [](Row r) { return r.risk(&Rate::value); }},
      {"risk_lo_per_a", "1/a", "Annual individual risk, lower bound",
       [](Row r) { return r.risk(&Rate::low); }},
      {"risk_hi_per_a", "1/a", "Annual individual risk, upper bound",
       [](Row r) { return r.risk(&Rate::high); }},
      {"deaths_per_a", "1/a", "Expected deaths",
       [](Row r) -> Value { return r.traced.risk ? r.traced.risk->deaths : std::nan(""); }},
      {"class", "", "Class of risk", [](Row r) -> Value { return r.of_class(&RecipeClass::name); },
       words},
      {"code", "", "Code",
       [](Row r) -> Value {
         return r.traced.risk ? r.recipe.classes[r.traced.risk->kind].code : 0;
       },
       whole},
      {"label", "", "Label", [](Row r) -> Value { return r.of_class(&RecipeClass::label); }, words},
      {"recipe", "", "Recipe",
       [](Row r) -> Value { return r.traced.risk ? r.recipe.name : std::string(); }, words}};
  return fields;
}

VectorLayer object_layer(const TraceSums& sums, const std::vector<TracedObject>& objects,
                         const Vec2& origin, const Recipe& recipe) {
  VectorLayer layer{
      "objects",
      "endangered objects and what comes to them",
      GeometryType::multi_polygon,
      vector_fields(object_fields()),
      {},
      vector_qml(
          is_of_risk(recipe)
              ? class_style(recipe, 0.6, "\"object\"")
              : VectorStyle{
                    SymbolKind::polygon, "", {{"", "", {200, 30, 30, 120}}}, 0.6, "\"object\""})};
  for (std::size_t o = 0; o < objects.size(); ++o) {
    VectorFeature f;
    f.polygons = area_on_map(sums.objects[o], origin);
    f.values = values_of(object_fields(), {sums.objects[o], objects[o], recipe});
    layer.features.push_back(std::move(f));
  }
  return layer;
}

/// Of a table or a layer: the first one has the place, the second one the class.
struct LinkRow {
  const TraceSums& sums;
  const SourceLink& link;
  Vec2 origin;
  [[nodiscard]] const TraceSource& source() const { return sums.source.at(link.source); }
  [[nodiscard]] Vec2 place() const { return place_of_source(sums, link.source) + origin; }
};
const std::vector<Field<LinkRow>>& link_fields() {
  using Row = const LinkRow&;
  static const std::vector<Field<LinkRow>> fields = {
      {"object", "", "Object",
       [](Row r) -> Value { return r.sums.objects[static_cast<std::size_t>(r.link.object)].name; },
       words},
      {"source_cell", "", "Source cell", [](Row r) -> Value { return r.link.source; }, whole},
      {"x_m", "m", "Middle of the cell, x", [](Row r) -> Value { return r.place().x(); }},
      {"y_m", "m", "Middle of the cell, y", [](Row r) -> Value { return r.place().y(); }},
      {"n_released", "", "Number of blocks released in the cell",
       [](Row r) -> Value { return counted_value(r.source().n); }, whole},
      {"n_none", "", "Number of these that hit no object",
       [](Row r) -> Value { return counted_value(r.source().n_none); }, whole},
      {"n_hits", "", "Number of hits", [](Row r) -> Value { return r.link.n_hits; }, whole},
      {"p_hit", "", "Probability of a hit", [](Row r) -> Value { return r.link.p_hit; }},
      {"share_of_hits", "", "Share of the hits of the object",
       [](Row r) -> Value { return r.link.share_of_hits; }},
      {"ke_p95_kj", "kJ", "Kinetic energy, 95th percentile",
       [](Row r) -> Value { return r.link.energy_p95; }},
      {"p_class", "", "Probability of a hit, class",
       [](Row r) -> Value { return p_class(r.link.p_hit); }, words}};
  return fields;
}

VectorLayer source_cell_layer(const TraceSums& sums, const std::vector<SourceLink>& links,
                              const Vec2& origin) {
  VectorLayer layer{"source_cells",
                    "cells that blocks were released in, once for each object that they hit",
                    GeometryType::multi_polygon,
                    vector_fields(link_fields()),
                    {},
                    vector_qml(p_style(SymbolKind::polygon, 0.1))};
  for (const SourceLink& link : links) {
    VectorFeature f;
    f.polygons = square_of(sums, link.source, origin);
    f.values = values_of(link_fields(), {sums, link, origin});
    layer.features.push_back(std::move(f));
  }
  return layer;
}

VectorLayer link_layer(const TraceSums& sums, const std::vector<SourceLink>& links,
                       const Trn& trn) {
  VectorLayer layer{"links",
                    "from a source cell to the mean place of its hits of an object",
                    GeometryType::line_zm,
                    vector_fields(link_fields()),
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
    f.values = values_of(link_fields(), {sums, link, trn.origin.head<2>()});
    layer.features.push_back(std::move(f));
  }
  return layer;
}

}  // namespace

std::vector<VectorLayer> trace_layers(const TraceSums& sums,
                                      const std::vector<TracedObject>& objects,
                                      const std::vector<SourceLink>& links, const Trn& trn,
                                      const Recipe& recipe) {
  const Vec2 origin = trn.origin.head<2>();
  return {object_layer(sums, objects, origin, recipe), link_layer(sums, links, trn),
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
  std::string out = csv_row(names_of(link_fields()));
  for (const SourceLink& link : links)
    out += csv_row(values_of(link_fields(), {sums, link, origin.head<2>()}));
  return out;
}

}  // namespace talus
