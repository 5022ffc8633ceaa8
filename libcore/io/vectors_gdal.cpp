#include "io/vectors_gdal.hpp"

#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <cmath>
#include <memory>

#include "base/error.hpp"
#include "io/crs_gdal.hpp"
#include "io/errors_gdal.hpp"

namespace talus {
namespace {

const char* name_of(VectorKind kind) {
  switch (kind) {
    case VectorKind::points:
      return "points";
    case VectorKind::lines:
      return "lines";
    case VectorKind::areas:
      break;
  }
  return "polygons";
}

bool holds(OGRwkbGeometryType type, VectorKind kind) {
  const OGRwkbGeometryType flat = wkbFlatten(type);
  if (flat == wkbUnknown || flat == wkbGeometryCollection) return true;
  switch (kind) {
    case VectorKind::points:
      return flat == wkbPoint || flat == wkbMultiPoint;
    case VectorKind::lines:
      return flat == wkbLineString || flat == wkbMultiLineString || flat == wkbCompoundCurve ||
             flat == wkbMultiCurve;
    case VectorKind::areas:
      break;
  }
  return flat == wkbPolygon || flat == wkbMultiPolygon || flat == wkbCurvePolygon ||
         flat == wkbMultiSurface;
}

std::vector<Vec3> vertices_of(const OGRSimpleCurve& curve, bool is_ring) {
  std::vector<Vec3> vertices;
  for (int k = 0; k < curve.getNumPoints(); ++k)
    vertices.emplace_back(curve.getX(k), curve.getY(k), curve.Is3D() ? curve.getZ(k) : NAN);
  if (is_ring && vertices.size() > 1 && vertices.front().head<2>() == vertices.back().head<2>())
    vertices.pop_back();
  return vertices;
}

// Adds the parts of one geometry; other kinds in a mixed layer are passed over.
void add_shapes(const OGRGeometry& geometry, VectorKind kind,
                std::vector<std::vector<Vec3>>& shapes) {
  const OGRwkbGeometryType type = wkbFlatten(geometry.getGeometryType());
  if (OGR_GT_IsSubClassOf(type, wkbGeometryCollection)) {
    for (const OGRGeometry* part : *geometry.toGeometryCollection())
      add_shapes(*part, kind, shapes);
  } else if (type == wkbPoint && kind == VectorKind::points) {
    const OGRPoint* point = geometry.toPoint();
    shapes.push_back({{point->getX(), point->getY(), point->Is3D() ? point->getZ() : NAN}});
  } else if (type == wkbLineString && kind == VectorKind::lines) {
    shapes.push_back(vertices_of(*geometry.toLineString(), false));
  } else if (type == wkbPolygon && kind == VectorKind::areas) {
    for (const OGRLinearRing* ring : *geometry.toPolygon())
      shapes.push_back(vertices_of(*ring, true));
  }
}

OGRLayer* find_layer(GDALDataset& source, const VectorQuery& query) {
  std::string names;
  for (OGRLayer* layer : source.GetLayers()) {
    names += (names.empty() ? "" : ", ") + std::string(layer->GetName());
    if (query.layer.empty() ? holds(layer->GetGeomType(), query.kind)
                            : query.layer == layer->GetName())
      return layer;
  }
  const std::string wanted = query.layer.empty() ? std::string("no layer of ") + name_of(query.kind)
                                                 : "there is no layer " + query.layer;
  throw InputError({query.path}, wanted, names.empty() ? "" : "its layers: " + names);
}

void check_finite(const std::vector<std::vector<Vec3>>& shapes, const Where& where) {
  for (const auto& shape : shapes)
    for (const Vec3& v : shape)
      if (!std::isfinite(v.x()) || !std::isfinite(v.y()))
        throw InputError(where, "a coordinate is not finite");
}

void take_to(const std::string& crs_wkt, const Where& where, VectorShapes& found) {
  for (auto& shape : found.shapes) {
    if (is_beyond_degrees(found.source_crs, shape))
      throw InputError(
          where,
          "the CRS is " + crs_name(found.source_crs) +
              " (a GeoJSON without crs says so), but the coordinates are no degrees",
          "name the CRS in the file: ogr2ogr -a_srs EPSG:code named.gpkg " + where.file);
    if (!reproject(found.source_crs, crs_wkt, shape))
      throw InputError(
          where,
          "cannot be reprojected from " + crs_name(found.source_crs) + " to " + crs_name(crs_wkt),
          "check the CRS of the file");
  }
}

}  // namespace

VectorShapes read_vectors(const VectorQuery& query, const std::string& crs_wkt) {
  register_gdal_drivers();
  const GdalErrors errors;
  const std::unique_ptr<GDALDataset> source(
      GDALDataset::Open(query.path.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY));
  if (!source)
    throw InputError({query.path}, "cannot be read as vectors: " + errors.failure(),
                     "give a file that ogrinfo can open");
  OGRLayer* layer = find_layer(*source, query);
  VectorShapes found;
  found.layer = layer->GetName();
  const Where where{query.path, 0, "layer " + found.layer};
  if (!query.where.empty() && layer->SetAttributeFilter(query.where.c_str()) != OGRERR_NONE)
    throw InputError(where,
                     "the filter \"" + query.where + "\" cannot be used: " + errors.failure());
  int n_null = 0;
  for (auto&& feature : *layer) {
    const OGRGeometry* geometry = feature->GetGeometryRef();
    if (!geometry || geometry->IsEmpty()) {
      ++n_null;
      continue;
    }
    const std::unique_ptr<OGRGeometry> straight(geometry->getLinearGeometry());
    add_shapes(*straight, query.kind, found.shapes);
  }
  if (errors.failed()) throw InputError(where, "reading failed: " + errors.failure());
  if (n_null > 0)
    throw InputError(where, std::to_string(n_null) + " features have no geometry",
                     "the file may be cut short; repair it first");
  if (found.shapes.empty()) throw InputError(where, std::string("holds no ") + name_of(query.kind));
  check_finite(found.shapes, where);
  const std::string own = wkt_of(layer->GetSpatialRef());
  if (!own.empty() && !crs_wkt.empty() && !same_crs(own, crs_wkt)) {
    found.source_crs = own;
    take_to(crs_wkt, where, found);
    check_finite(found.shapes, where);
  }
  return found;
}

}  // namespace talus
