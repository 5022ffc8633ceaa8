#include "io/vectors_gdal.hpp"

#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <cmath>
#include <memory>
#include <utility>

#include "base/error.hpp"
#include "base/text.hpp"
#include "io/areas_gdal.hpp"
#include "io/contour_layer_gdal.hpp"
#include "io/crs_gdal.hpp"
#include "io/crs_operation_gdal.hpp"
#include "io/crs_place_gdal.hpp"
#include "io/drawing_unit_gdal.hpp"
#include "io/errors_gdal.hpp"

namespace talus {
namespace {

LayerRole role_of(const VectorQuery& query) {
  switch (query.kind) {
    case VectorKind::points:
      return {LayerShape::point, "points", query.options.c_str()};
    case VectorKind::lines:
      return {LayerShape::line, "lines", query.options.c_str()};
    case VectorKind::areas:
      break;
  }
  return {LayerShape::polygon, "polygons", query.options.c_str()};
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
  std::vector<std::unique_ptr<OGRPolygon>> polygons;
  int n_passed_over = 0;
};

// Adds the parts of one geometry; other kinds in a mixed layer are counted.
void add_parts(const OGRGeometry& geometry, VectorKind kind, const Where& where, Parts& parts) {
  const OGRwkbGeometryType type = wkbFlatten(geometry.getGeometryType());
  if (OGR_GT_IsSubClassOf(type, wkbGeometryCollection)) {
    for (const OGRGeometry* part : *geometry.toGeometryCollection())
      add_parts(*part, kind, where, parts);
  } else if (type == wkbPoint && kind == VectorKind::points) {
    const OGRPoint* point = geometry.toPoint();
    parts.shapes.push_back({{point->getX(), point->getY(), point->Is3D() ? point->getZ() : NAN}});
  } else if (type == wkbLineString && kind == VectorKind::lines) {
    parts.shapes.push_back(vertices_of(*geometry.toLineString(), false));
  } else if (type == wkbPolygon && kind == VectorKind::areas) {
    check_finite(rings_of(*geometry.toPolygon()), where);
    check_polygon(*geometry.toPolygon(), where);
    parts.polygons.emplace_back(geometry.toPolygon()->clone());
  } else {
    ++parts.n_passed_over;
  }
}

Parts read_parts(const VectorQuery& query, OpenLayer& source) {
  const LayerChoice choice{query.path, query.layer, ""};
  const Where where = where_of_layer(choice, source);
  const GdalErrors errors;
  if (!query.where.empty()) {
    const std::string filter =
        source.filter.empty() ? query.where : source.filter + " AND (" + query.where + ")";
    if (source.layer->SetAttributeFilter(filter.c_str()) != OGRERR_NONE)
      throw InputError(where,
                       "the filter \"" + query.where + "\" cannot be used: " + errors.failure());
  }
  Parts parts;
  int n_null = 0;
  source.layer->ResetReading();
  for (auto&& feature : *source.layer) {
    const OGRGeometry* geometry = feature->GetGeometryRef();
    if (!geometry || geometry->IsEmpty()) {
      ++n_null;
      continue;
    }
    const std::unique_ptr<OGRGeometry> straight(geometry->getLinearGeometry());
    add_parts(*straight, query.kind, where_of_feature(choice, source, *feature), parts);
  }
  if (errors.failed()) throw InputError(where, "reading failed: " + errors.failure());
  if (n_null > 0)
    throw InputError(where, std::to_string(n_null) + " features have no geometry",
                     "the file may be cut short; repair it first");
  if (parts.shapes.empty() && parts.polygons.empty())
    throw InputError(where, std::string("holds no ") + source.role.name);
  return parts;
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
    twice += a.x() * b.y() - a.y() * b.x();
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
  Place place{crs, window_of(all_points(found.shapes)), work_crs};
  place.layer = layer.GetName();
  place.geometry_column = layer.GetGeometryColumn();
  for (std::string& warning : check_place(place, {where.file}))
    found.warnings.push_back(std::move(warning));
}

void take_to(const std::string& crs_wkt, const Where& where, VectorShapes& found) {
  std::vector<Vec3> points = all_points(found.shapes);
  const CrsOperation operation =
      find_operation(found.source_crs, crs_wkt, window_of(points), where);
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
  throw InputError(where,
                   "the CRS is " + crs_name(own) +
                       " (a GeoJSON without crs says so), but the coordinates are no degrees",
                   "name the CRS in the file: ogr2ogr -a_srs EPSG:code named.gpkg " + where.file);
}

void check_unit(const OpenLayer& source, const std::string& crs, const Where& where) {
  if (!source.is_drawing) return;
  const std::string opened = source.dataset->GetDescription();
  const DrawingUnit unit = drawing_unit(opened);
  (void)scale_of_drawing(opened, 0, length_unit_m(crs), where,
                         "bring it to metres: ogr2ogr -f GPKG -nln metres metres.gpkg " +
                             where.file + " -dialect sqlite -sql 'SELECT ScaleCoords(geometry, " +
                             (unit.metres > 0 ? text(unit.metres) : "METRES") +
                             ") AS geometry, * FROM \"" + source.layer->GetName() + "\"'");
}

}  // namespace

VectorShapes read_vectors(const VectorQuery& query, const std::string& crs_wkt) {
  OpenLayer source = open_layer({query.path, query.layer, ""}, role_of(query));
  const Where where{query.path, 0, "layer " + source.name};
  Parts parts = read_parts(query, source);
  VectorShapes found;
  found.layer = source.name;
  found.n_passed_over = parts.n_passed_over;
  found.n_parts = static_cast<int>(parts.shapes.size() + parts.polygons.size());
  found.shapes = std::move(parts.shapes);
  const std::vector<bool> is_hole = add_areas(parts, where, found);
  check_finite(found.shapes, where);
  const std::string own = wkt_of(source.layer->GetSpatialRef());
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
