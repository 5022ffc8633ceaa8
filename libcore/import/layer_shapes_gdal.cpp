// Tells which geometries are lines, points or areas.
#include "import/layer_shapes_gdal.hpp"

#include <ogr_geometry.h>

#include <cmath>

namespace talus {

const char* singular(LayerShape shape) {
  switch (shape) {
    case LayerShape::line:
      return "line";
    case LayerShape::point:
      return "point";
    case LayerShape::face:
      return "face";
    default:
      return "polygon";
  }
}

std::string plural(LayerShape shape) { return std::string(singular(shape)) + "s"; }

bool is_face(const OGRGeometry& geometry) {
  return fits(geometry.getGeometryType(), LayerShape::face);
}

bool fits(int ogr_type, LayerShape shape) {
  const auto type = static_cast<OGRwkbGeometryType>(ogr_type);
  const OGRwkbGeometryType flat = OGR_GT_GetLinear(wkbFlatten(type));
  switch (shape) {
    case LayerShape::line:
      return flat == wkbLineString || flat == wkbMultiLineString;
    case LayerShape::point:
      return flat == wkbPoint || flat == wkbMultiPoint;
    case LayerShape::face:
      return OGR_GT_HasZ(type) != 0 && (flat == wkbPolygon || flat == wkbTriangle ||
                                        flat == wkbPolyhedralSurface || flat == wkbTIN);
    default:  // GDAL calls surfaces of faces linear polygons, too
      return (flat == wkbPolygon || flat == wkbMultiPolygon) &&
             OGR_GT_IsSubClassOf(wkbFlatten(type), wkbPolyhedralSurface) == 0;
  }
}

bool is_closed(const OGRLineString& line) {
  const int n = line.getNumPoints();
  if (n < 4) return false;
  OGREnvelope box;
  line.getEnvelope(&box);
  const double gap = std::hypot(line.getX(n - 1) - line.getX(0), line.getY(n - 1) - line.getY(0));
  return gap <= 1e-6 * std::hypot(box.MaxX - box.MinX, box.MaxY - box.MinY);
}

}  // namespace talus
