#include "io/points_gdal.hpp"

#include <ogrsf_frmts.h>

#include <cmath>
#include <memory>

#include "base/error.hpp"
#include "io/crs_gdal.hpp"
#include "io/errors_gdal.hpp"

namespace talus {
namespace {

void add_point(const OGRPoint& point, const Where& where, std::vector<Vec3>& points) {
  if (!point.Is3D()) throw InputError(where, "the point has no height (2-D), expected x, y, z");
  const Vec3 place(point.getX(), point.getY(), point.getZ());
  if (!place.allFinite()) throw InputError(where, "a coordinate is not finite");
  points.push_back(place);
}

void add_geometry(const OGRGeometry* geometry, const Where& where, std::vector<Vec3>& points) {
  const OGRwkbGeometryType type = geometry ? wkbFlatten(geometry->getGeometryType()) : wkbUnknown;
  if (type == wkbPoint) {
    add_point(*geometry->toPoint(), where, points);
  } else if (type == wkbMultiPoint) {
    for (const OGRPoint* point : geometry->toMultiPoint()) add_point(*point, where, points);
  } else {
    throw InputError(where, std::string("the geometry is ") +
                                (geometry ? geometry->getGeometryName() : "missing") +
                                ", expected points");
  }
}

}  // namespace

MapPoints read_points(const std::string& path, const std::string& crs_wkt) {
  register_gdal_drivers();
  const GdalErrors errors;
  const std::unique_ptr<GDALDataset> source(GDALDataset::Open(path.c_str(), GDAL_OF_VECTOR));
  if (!source) throw InputError({path}, "cannot be opened as a vector source: " + errors.failure());
  if (source->GetLayerCount() < 1) throw InputError({path}, "there is no layer, expected points");
  OGRLayer& layer = *source->GetLayer(0);
  const std::string item = std::string("layer ") + layer.GetName();
  MapPoints result;
  for (const OGRFeatureUniquePtr& feature : layer)
    add_geometry(feature->GetGeometryRef(),
                 {path, 0, item + ", feature " + std::to_string(feature->GetFID())}, result.points);
  if (errors.failed()) throw InputError({path, 0, item}, "reading failed: " + errors.failure());
  if (result.points.empty()) throw InputError({path, 0, item}, "the layer is empty");
  const std::string own = wkt_of(layer.GetSpatialRef());
  if (own.empty() || crs_wkt.empty() || same_crs(own, crs_wkt)) return result;
  if (!reproject(own, crs_wkt, result.points))
    throw InputError({path, 0, item},
                     "cannot be reprojected from " + crs_name(own) + " to " + crs_name(crs_wkt));
  result.source_crs = own;
  return result;
}

}  // namespace talus
