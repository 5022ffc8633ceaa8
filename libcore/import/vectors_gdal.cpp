#include "import/vectors_gdal.hpp"

#include <ogrsf_frmts.h>

#include <cmath>
#include <memory>
#include <utility>

#include "base/error.hpp"
#include "base/source_path.hpp"
#include "base/text.hpp"
#include "geometry/plan2d.hpp"
#include "import/contour_layer_gdal.hpp"
#include "import/crs_operation_gdal.hpp"
#include "import/crs_place_gdal.hpp"
#include "import/drawing_unit_gdal.hpp"
#include "io/areas_gdal.hpp"
#include "io/crs_gdal.hpp"

namespace talus {
namespace {

LayerRole role_of(const VectorQuery& query) {
  switch (query.kind) {
    case VectorKind::points:
      return {LayerShape::point, "points"};
    case VectorKind::lines:
      return {LayerShape::line, "lines"};
    case VectorKind::areas:
      break;
  }
  return {LayerShape::polygon, "polygons"};
}

std::vector<Vec3> vertices_of(const OGRSimpleCurve& curve, bool is_ring) {
  std::vector<Vec3> vertices;
  for (int k = 0; k < curve.getNumPoints(); ++k)
    vertices.emplace_back(curve.getX(k), curve.getY(k), curve.Is3D() ? curve.getZ(k) : NAN);
  if (is_ring && vertices.size() > 1 && vertices.front().head<2>() == vertices.back().head<2>())
    vertices.pop_back();
  return vertices;
}

void check_finite(const std::vector<std::vector<Vec3>>& shapes, const Where& where) {
  for (const auto& shape : shapes)
    for (const Vec3& v : shape)
      if (!std::isfinite(v.x()) || !std::isfinite(v.y()))
        throw InputError(where, "a coordinate is not finite");
}

using Rings = std::vector<std::vector<Vec3>>;

// The outline and the holes.
Rings rings_of(const OGRPolygon& polygon) {
  Rings rings;
  for (const OGRLinearRing* ring : polygon) rings.push_back(vertices_of(*ring, true));
  return rings;
}

// What is read from a layer, polygons apart from the rest.
struct Parts {
  Rings shapes;
  std::vector<std::vector<std::string>> attributes;
  std::vector<std::unique_ptr<OGRPolygon>> polygons;
};

void add_part(const OGRGeometry& geometry, VectorKind kind, const Where& where, Parts& parts) {
  if (kind == VectorKind::points) {
    const OGRPoint* point = geometry.toPoint();
    parts.shapes.push_back({{point->getX(), point->getY(), point->Is3D() ? point->getZ() : NAN}});
  } else if (kind == VectorKind::lines) {
    parts.shapes.push_back(vertices_of(*geometry.toLineString(), false));
  } else {
    check_finite(rings_of(*geometry.toPolygon()), where);
    check_polygon(*geometry.toPolygon(), where);
    parts.polygons.emplace_back(geometry.toPolygon()->clone());
  }
}

// The attributes asked for, as text.
std::vector<std::string> attributes_of(const OGRFeature& feature, const VectorQuery& query) {
  std::vector<std::string> values;
  for (const std::string& name : query.fields) {
    const int index = feature.GetFieldIndex(name.c_str());
    values.emplace_back(index >= 0 && feature.IsFieldSetAndNotNull(index) != 0
                            ? feature.GetFieldAsString(index)
                            : "");
  }
  return values;
}

Parts read_parts(const VectorQuery& query, const LayerChoice& choice, OpenLayer& source) {
  Parts parts;
  for_each_part(choice, source, [&](const OGRGeometry& part, const OGRFeature& feature) {
    add_part(part, query.kind, where_of_feature(choice, source, feature), parts);
    if (query.kind == VectorKind::points) parts.attributes.push_back(attributes_of(feature, query));
  });
  return parts;
}

// Areas that GeoJSON cuts at 180 degrees meet there.
void bring_to_one_side(const std::string& own, Parts& parts) {
  if (parts.polygons.empty()) return;
  for (const auto& polygon : parts.polygons)
    for (const std::vector<Vec3>& ring : rings_of(*polygon))
      if (is_beyond_degrees(own, ring)) return;
  const auto near = on_one_side(own);
  const double first = parts.polygons.front()->getExteriorRing()->getX(0);
  for (const auto& polygon : parts.polygons)
    for (OGRLinearRing* ring : *polygon)
      for (int k = 0; k < ring->getNumPoints(); ++k)
        ring->setPoint(k, near(ring->getX(k), first), ring->getY(k));
}

// Makes the polygons rings; for each ring, whether it is a hole.
std::vector<bool> add_areas(Parts& parts, const Where& where, VectorShapes& found) {
  const Uniting uniting = unite_polygons(parts.polygons, where);
  found.n_united = uniting.n_united;
  found.n_made = uniting.n_made;
  std::vector<bool> is_hole;
  for (const auto& polygon : parts.polygons) {
    Rings rings = rings_of(*polygon);
    for (std::size_t r = 0; r < rings.size(); ++r) {
      is_hole.push_back(r > 0);
      found.shapes.push_back(std::move(rings[r]));
    }
  }
  return is_hole;
}

double area_of_ring(const std::vector<Vec3>& ring) {
  double twice = 0;
  for (std::size_t k = 1; k + 1 < ring.size(); ++k) {
    const Vec2 a = (ring[k] - ring[0]).head<2>(), b = (ring[k + 1] - ring[0]).head<2>();
    twice += cross(a, b);
  }
  return std::abs(twice) / 2;
}

std::vector<Vec3> all_points(const Rings& shapes) {
  std::vector<Vec3> points;
  for (const auto& shape : shapes) points.insert(points.end(), shape.begin(), shape.end());
  return points;
}

// Whether the coordinates can be in `crs`, to be used in `work_crs`.
void check_place_of(const std::string& crs, const std::string& work_crs, OGRLayer& layer,
                    const Where& where, VectorShapes& found) {
  if (crs.empty() || found.shapes.empty()) return;
  CrsExtent place{crs, window_of(all_points(found.shapes), crs), work_crs};
  place.layer = layer.GetName();
  place.geometry_column = layer.GetGeometryColumn();
  for (std::string& warning : check_place(place, {parse_source_path(where.file).source}))
    found.warnings.push_back(std::move(warning));
}

void take_to(const std::string& crs_wkt, const Where& where, VectorShapes& found) {
  std::vector<Vec3> points = all_points(found.shapes);
  const CrsOperation operation =
      find_operation(found.source_crs, crs_wkt, window_of(points, found.source_crs), where);
  if (!carry_out(operation, points))
    throw InputError(
        where,
        "cannot be reprojected from " + crs_name(found.source_crs) + " to " + crs_name(crs_wkt),
        "check the CRS of the file");
  auto next = points.begin();
  for (auto& shape : found.shapes)
    for (Vec3& point : shape) point = *next++;
  found.operation = sentence_on(operation);
  if (const std::string doubt = doubt_on(operation); !doubt.empty())
    found.warnings.push_back(where.file + ": " + doubt);
}

void refuse_no_degrees(const std::string& own, const Where& where, const Rings& shapes) {
  if (!is_beyond_degrees(own, all_points(shapes))) return;
  throw InputError(
      where,
      "the CRS is " + crs_name(own) +
          " (a GeoJSON without crs says so), but the coordinates are no degrees",
      "name the CRS in the file: ogr2ogr -a_srs EPSG:code named.gpkg " + command_words(where.file));
}

void check_unit(const OpenLayer& source, const std::string& crs, const Where& where) {
  if (!source.is_drawing) return;
  const std::string opened = source.dataset->GetDescription();
  const DrawingUnit unit = drawing_unit(opened);
  (void)scale_of_drawing(opened, 0, length_unit_m(crs), where,
                         "bring it to metres: ogr2ogr -f GPKG -nln metres metres.gpkg " +
                             command_words(parse_source_path(where.file).source) +
                             " -dialect sqlite -sql 'SELECT ScaleCoords(geometry, " +
                             (unit.metres > 0 ? text(unit.metres) : "METRES") +
                             ") AS geometry, * FROM \"" + source.layer->GetName() + "\"'");
}

}  // namespace

VectorShapes read_vectors(const VectorQuery& query, const std::string& crs_wkt) {
  LayerChoice choice;
  choice.path = query.path;
  OpenLayer source = open_layer(choice, role_of(query));
  Parts parts = read_parts(query, choice, source);
  const Where where = where_of_layer(choice, source);
  VectorShapes found;
  static_cast<LayerReading&>(found) = reading_of(choice, source);
  found.shapes = std::move(parts.shapes);
  found.attributes = std::move(parts.attributes);
  const std::string own = wkt_of(source.layer->GetSpatialRef());
  bring_to_one_side(own, parts);
  const std::vector<bool> is_hole = add_areas(parts, where, found);
  check_finite(found.shapes, where);
  check_unit(source, own.empty() ? crs_wkt : own, where);
  if (const std::string doubt = doubt_on_unit(source.dataset->GetDescription(), 0); !doubt.empty())
    found.warnings.push_back(query.path + ": " + doubt);
  const bool is_taken_on = !own.empty() && !crs_wkt.empty() && !same_crs(own, crs_wkt);
  if (is_taken_on) refuse_no_degrees(own, where, found.shapes);
  check_place_of(is_taken_on ? own : crs_wkt, crs_wkt, *source.layer, where, found);
  if (is_taken_on) {
    found.source_crs = own;
    take_to(crs_wkt, where, found);
    check_finite(found.shapes, where);
  }
  for (std::size_t r = 0; r < is_hole.size(); ++r)
    found.area_m2 += (is_hole[r] ? -1 : 1) * area_of_ring(found.shapes[r]);
  return found;
}

}  // namespace talus
