// Outlines in plan of the mass that could leave on each plane and wedge.
#include "tools/frame/failure_outlines.hpp"

#include <cmath>
#include <utility>

#include "base/grouped_text.hpp"
#include "base/text.hpp"
#include "base/units.hpp"
#include "base/words.hpp"
#include "blocks/mass_outline.hpp"
#include "io/polygons_gdal.hpp"
#include "io/style.hpp"

namespace talus {
namespace {

constexpr double joined_within_m = 1e-4;

Vec2 middle_of(const std::vector<Vec2>& ring) {
  Vec2 sum = Vec2::Zero();
  for (const Vec2& p : ring) sum += p;
  return sum / static_cast<double>(ring.size());
}

void outline(const BlocksWork& work, const std::vector<PlaneThrough>& planes,
             OutlinedSurface& surface) {
  const std::vector<MassPiece> pieces = mass_above(work.ground, work.area, planes);
  std::vector<std::vector<Vec2>> rings;
  double all = 0;
  for (const MassPiece& piece : pieces) {
    rings.push_back(piece.outline);
    all += piece.volume;
  }
  for (auto& polygon : union_of(rings, joined_within_m)) {
    double volume = 0;
    for (const MassPiece& piece : pieces)
      if (contains(Area{polygon}, middle_of(piece.outline))) volume += piece.volume;
    if (volume >= least_part * all) {
      surface.volume += volume;
      surface.polygons.push_back(std::move(polygon));
    } else {
      ++surface.n_left_out;
      surface.volume_left_out += volume;
    }
  }
}

OutlinedSurface outlined_wedge(const BlocksWork& work, const FailureWedge& wedge) {
  OutlinedSurface surface;
  surface.is_wedge = true;
  surface.sets = pair_name(wedge);
  surface.fall = {wedge.line.plunge, wedge.line.trend};
  surface.free_share = wedge.free_share;
  outline(work, {{wedge.first_plane, wedge.first_point}, {wedge.second_plane, wedge.second_point}},
          surface);
  return surface;
}

}  // namespace

OutlinedSurface outlined_plane(const BlocksWork& work, const FailurePlane& plane, const Vec3& point,
                               double free_share) {
  OutlinedSurface surface;
  surface.sets = plane.set;
  surface.fall = plane.attitude;
  surface.free_share = free_share;
  outline(work, {{plane.attitude, point}}, surface);
  return surface;
}

std::vector<OutlinedSurface> outlined_surfaces(const BlocksWork& work) {
  std::vector<OutlinedSurface> surfaces;
  for (std::size_t i = 0; i < work.planes.planes.size(); ++i) {
    const FailurePlane& plane = work.planes.planes[i];
    if (!plane.why_not.empty()) continue;
    surfaces.push_back(outlined_plane(work, plane, plane.point, plane.foot.free_share));
    surfaces.back().is_taken = static_cast<int>(i) == work.planes.best && work.wedge < 0;
  }
  for (std::size_t i = 0; i < work.wedges.size(); ++i) {
    if (!work.wedges[i].why_not.empty()) continue;
    surfaces.push_back(outlined_wedge(work, work.wedges[i]));
    surfaces.back().is_taken = static_cast<int>(i) == work.wedge;
  }
  std::erase_if(surfaces, [](const OutlinedSurface& surface) { return surface.polygons.empty(); });
  return surfaces;
}

std::string title_of(const OutlinedSurface& surface) {
  std::string words = surface.sets + ", " + grouped_text(surface.volume, 3) + " m3, free along " +
                      percent(surface.free_share) + " of the foot";
  if (surface.n_left_out > 0)
    words += "; without " + counted(surface.n_left_out, "part") + " of " +
             grouped_text(surface.volume_left_out, 2) + " m3 in all";
  return words;
}

Json outline_json(const OutlinedSurface& surface, const Vec3& origin) {
  Json polygons = Json::array();
  for (const auto& polygon : surface.polygons) {
    Json rings = Json::array();
    for (const auto& ring : polygon) {
      Json points = Json::array();
      for (std::size_t k = 0; k <= ring.size(); ++k) {  // closed, as GeoJSON wants it
        const Vec2 p = ring[k % ring.size()] + origin.head<2>();
        points.push_back({std::round(p.x() * 1000) / 1000, std::round(p.y() * 1000) / 1000});
      }
      rings.push_back(std::move(points));
    }
    polygons.push_back(std::move(rings));
  }
  return {{"sets", surface.sets},
          {"kind", surface.is_wedge ? "wedge" : "plane"},
          {"free_share_of_foot", surface.free_share},
          {"outlined_m3", surface.volume},
          {"parts_left_out", surface.n_left_out},
          {"left_out_m3", surface.volume_left_out},
          {"polygons", polygons}};
}

namespace {

const std::vector<Field<OutlinedSurface>>& surface_fields() {
  using Value = FieldValue;
  using Row = const OutlinedSurface&;
  static const std::vector<Field<OutlinedSurface>> fields = {
      {"sets", "", "Joint sets", [](Row r) -> Value { return r.sets; }, FieldType::text},
      {"kind", "", "Kind", [](Row r) -> Value { return r.is_wedge ? "wedge" : "plane"; },
       FieldType::text},
      {"dip_deg", "deg", "Dip", [](Row r) -> Value { return r.fall.dip / degree; }},
      {"dip_direction_deg", "deg", "Dip direction",
       [](Row r) -> Value { return std::fmod(r.fall.dip_direction / degree + 360, 360); }},
      {"free_share_of_foot", "", "Share of the foot that is free",
       [](Row r) -> Value { return r.free_share; }},
      {"volume_m3", "m3", "Volume", [](Row r) -> Value { return r.volume; }},
      {"left_out_m3", "m3", "Volume of parts left out",
       [](Row r) -> Value { return r.volume_left_out; }},
      {"taken", "", "Whether it is taken", [](Row r) -> Value { return r.is_taken ? 1 : 0; },
       FieldType::integer}};
  return fields;
}

}  // namespace

VectorLayer outline_layer(const std::vector<OutlinedSurface>& surfaces, const Vec3& origin) {
  VectorLayer layer{"failure_surfaces",
                    "areas of the masses that could leave on planes and wedges of the joint sets",
                    GeometryType::multi_polygon,
                    vector_fields(surface_fields()),
                    {},
                    vector_qml({SymbolKind::polygon, "", {{"", "", {122, 40, 160, 60}}}, 0.6})};
  for (const OutlinedSurface& surface : surfaces) {
    VectorFeature feature;
    feature.polygons = surface.polygons;
    for (auto& polygon : feature.polygons)
      for (auto& ring : polygon)
        for (Vec2& p : ring) p += origin.head<2>();
    feature.values = values_of(surface_fields(), surface);
    layer.features.push_back(std::move(feature));
  }
  return layer;
}

}  // namespace talus
