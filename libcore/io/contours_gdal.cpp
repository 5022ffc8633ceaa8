#include "io/contours_gdal.hpp"

#include <ogr_spatialref.h>
#include <ogrsf_frmts.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/error.hpp"
#include "base/read_file.hpp"
#include "base/text.hpp"
#include "io/contour_heights_gdal.hpp"
#include "io/contour_layer_gdal.hpp"
#include "io/crs_gdal.hpp"
#include "io/errors_gdal.hpp"
#include "io/point_text.hpp"
#include "terrain/elevation.hpp"
#include "terrain/tin_mesh.hpp"

namespace talus {
namespace {

// What the sources of a map are read for.
constexpr LayerRole contours_role{LayerShape::line, "contours", "--"};
constexpr LayerRole ground_points_role{LayerShape::point, "points", "--"};
constexpr LayerRole breaklines_role{LayerShape::line, "breaklines", "--breaklines-"};
constexpr LayerRole spots_role{LayerShape::point, "spot heights", "--spots-"};
constexpr LayerRole boundary_role{LayerShape::polygon, "boundary", "--boundary-"};
constexpr LayerRole reference_role{LayerShape::point, "points", "--reference-points-"};

// --- reference systems ---------------------------------------------------------------------------

std::string crs_of_contours(const ContourSources& sources, const std::string& named,
                            const std::vector<Vec3>& points) {
  const bool no_degrees = is_beyond_degrees(named, points);
  const std::string own = no_degrees ? std::string() : named;
  const std::string& path = sources.contours.path;
  if (own.empty() && !sources.crs_given)
    throw InputError({path},
                     no_degrees ? "the CRS is " + crs_name(named) +
                                      " (a GeoJSON without crs says so), but the coordinates are "
                                      "no degrees"
                                : "there is no CRS, expected a projected one in metres",
                     "name it with --crs EPSG:code, or --crs none for local metres");
  if (!own.empty() && sources.crs_given &&
      !(same_crs(own, sources.crs) && same_heights(own, sources.crs)))
    throw InputError({path}, "the CRS is " + crs_name(own) + ", not " + crs_name(sources.crs),
                     "leave --crs away; --t-srs reprojects");
  const bool user_says_heights = sources.crs_given && height_crs(own).empty();
  return own.empty() || user_says_heights ? sources.crs : own;
}

void check_crs(const std::string& crs, const std::string& path, const Vec3& place) {
  if (crs.empty()) return;
  const CrsProblem problem = find_crs_problem(crs, place.head<2>());
  if (problem.finding.empty()) return;
  throw InputError({path}, problem.finding,
                   "--t-srs " + (problem.mend_to.empty() ? "EPSG:code" : problem.mend_to) +
                       " reprojects; elevations in feet need --elevation-unit-m 0.3048");
}

// The system that the heights are in is held to the same as that of the map, where both say it.
void check_heights_alike(const std::string& own, const std::string& map_crs,
                         const std::string& path) {
  if (same_heights(own, map_crs)) return;
  throw InputError({path},
                   "the heights are in " + crs_name(height_crs(own)) + ", those of the map in " +
                       crs_name(height_crs(map_crs)),
                   "bring them to one system first");
}

// Heights stay as they are.
void bring_to(const std::string& from, const std::string& to, const std::string& path,
              std::vector<Vec3>& points) {
  if (!reproject(from, to, points))
    throw InputError({path},
                     "cannot be reprojected from " + crs_name(from) + " to " + crs_name(to));
}

// The CRS of an additional source, reprojected with a note.
void bring_to_map(const LayerChoice& choice, const OpenLayer& source, const std::string& map_crs,
                  std::vector<Vec3>& points, std::vector<std::string>& notes) {
  const std::string own = wkt_of(source.layer->GetSpatialRef());
  const bool no_degrees = is_beyond_degrees(own, points);
  if (no_degrees || own.empty() != map_crs.empty())
    notes.push_back(choice.path + ": taken to be in the CRS of the map" +
                    (no_degrees ? ": its coordinates are no degrees" : ""));
  if (no_degrees || own.empty() || map_crs.empty() || same_crs(own, map_crs)) return;
  bring_to(own, map_crs, choice.path, points);
  notes.push_back(choice.path + ": reprojected from " + crs_name(own) + " to " + crs_name(map_crs));
}

// --- breaklines, spot heights, boundary ----------------------------------------------------------

// Heights in metres, whatever their unit was.
void scale_heights(double unit_m, const std::string& path, std::vector<Vec3>& points) {
  for (Vec3& point : points) {
    point.z() *= unit_m;
    if (std::abs(point.z()) > highest_elevation)
      throw InputError({path},
                       "the elevation at x " + text(point.x(), 10) + ", y " + text(point.y(), 10) +
                           " is " + text(point.z(), 10) + " m, expected at most " +
                           text(highest_elevation) + " m either way",
                       "feet need --elevation-unit-m 0.3048; choose another field where this one "
                       "holds no elevations");
  }
}

// Breaklines, or points as lines of one point, with their heights [m].
Polylines read_measured(const LayerChoice& choice, const LayerRole& role,
                        const std::string& map_crs, double unit_m,
                        std::vector<std::string>& notes) {
  OpenLayer source = open_layer(choice, role);
  Polylines lines = read_measured_lines(choice, source, unit_m, notes);
  bring_to_map(choice, source, map_crs, lines.points, notes);
  const std::string own_crs = wkt_of(source.layer->GetSpatialRef());
  check_heights_alike(own_crs, map_crs, choice.path);
  const std::string assumed = assumed_heights(own_crs, map_crs);
  if (!assumed.empty()) notes.push_back(choice.path + " and the map: both are " + assumed);
  scale_heights(unit_m, choice.path, lines.points);
  return lines;
}

std::vector<BoundaryRing> read_boundary(const LayerChoice& choice, const std::string& map_crs,
                                        std::vector<std::string>& notes) {
  OpenLayer source = open_layer(choice, boundary_role);
  std::vector<Vec3> points;
  std::vector<BoundaryRing> rings;
  std::vector<std::size_t> begin;
  int n_polygons = 0;
  for_each_part(choice, source, [&](const OGRGeometry& part, const OGRFeature& feature) {
    for (const OGRLinearRing* ring : *part.toPolygon()) {
      begin.push_back(points.size());
      rings.push_back({n_polygons, {}});
      for (int i = 0; i + 1 < ring->getNumPoints(); ++i) {
        points.emplace_back(ring->getX(i), ring->getY(i), 0);
        check_finite(points.back(), where_of_feature(choice, source, feature));
      }
    }
    ++n_polygons;
  });
  notes.push_back(choice.path + ": layer " + source.name + ", " + counted(n_polygons, "polygon"));
  bring_to_map(choice, source, map_crs, points, notes);
  begin.push_back(points.size());
  for (std::size_t r = 0; r < rings.size(); ++r)
    for (std::size_t i = begin[r]; i < begin[r + 1]; ++i)
      rings[r].points.push_back(points[i].head<2>());
  return rings;
}

// --- the whole map -------------------------------------------------------------------------------

// More than half of the heights far off the contours' range: they are in other units.
void check_units(const std::vector<Vec3>& points, const HeightRange& contours,
                 const std::string& path) {
  const double margin = contours.high - contours.low;
  const auto is_off = [&](const Vec3& p) {
    return p.z() < contours.low - margin || p.z() > contours.high + margin;
  };
  const auto n_off = std::count_if(points.begin(), points.end(), is_off);
  if (2 * n_off <= static_cast<std::ptrdiff_t>(points.size())) return;
  const Vec3& first = *std::find_if(points.begin(), points.end(), is_off);
  throw InputError({path},
                   std::to_string(n_off) + " of " + std::to_string(points.size()) +
                       " heights lie far from the contours, e.g. " + text(first.z(), 8) +
                       " m where contours go from " + text(contours.low, 8) + " to " +
                       text(contours.high, 8) + " m: mixed units?",
                   "convert them to the unit of the contours first");
}

void make_relative(ContourMap& map) {
  const std::vector<Vec3>& ground = map.contours.points.empty() ? map.spots : map.contours.points;
  Vec3 low = ground.front();
  for (const Vec3& p : ground) low = low.cwiseMin(p);
  map.origin = Vec3(std::floor(low.x() / 100) * 100, std::floor(low.y() / 100) * 100, 0);
  for (std::vector<Vec3>* points : {&map.contours.points, &map.breaklines.points, &map.spots})
    for (Vec3& p : *points) p -= map.origin;
  for (BoundaryRing& ring : map.boundary)
    for (Vec2& p : ring.points) p -= map.origin.head<2>();
}

// Points of a layer in `own_crs` to the CRS and the unit of the map.
void bring_to_metres(const ContourSources& sources, const std::string& own_crs,
                     std::vector<Vec3>& points, ContourMap& map) {
  map.crs_wkt = own_crs;
  if (!sources.t_srs.empty()) {
    if (own_crs.empty())
      throw InputError({map.source}, "local metres cannot be reprojected", "leave --t-srs away");
    map.crs_wkt = with_heights_of(own_crs, sources.t_srs, {map.source});
    bring_to(own_crs, sources.t_srs, map.source, points);
  }
  if (sources.elevation_unit_m != 1) map.crs_wkt = horizontal_crs(map.crs_wkt);
  check_crs(map.crs_wkt, map.source, points.front());
  scale_heights(sources.elevation_unit_m, map.source, points);
}

// Laser scans take a library that not every system has; text takes none.
void refuse_laser_scan(const std::string& path) {
  const std::string extension = lower(std::filesystem::path(path).extension().string());
  if (extension != ".las" && extension != ".laz" && extension != ".e57") return;
  throw InputError({path}, "is a laser scan, which is not read as it is",
                   "pdal translate " + path +
                       " ground.csv -f filters.range "
                       "--filters.range.limits=\"Classification[2:2]\" "
                       "--writers.text.order=X,Y,Z --writers.text.keep_unspecified=false");
}

// Points in coordinates and units of the source; the CRS that it names.
std::string read_raw_points(const ContourSources& sources, ContourReading& reading,
                            std::vector<Vec3>& points) {
  const std::string& path = sources.contours.path;
  if (is_point_text(path)) {
    PointText text = parse_points(read_file(path), path);
    points = std::move(text.points);
    reading.elevation_from = text.taken_from;
    reading.notes.push_back(path + ": " +
                            counted(static_cast<std::int64_t>(points.size()), "point") + " from " +
                            text.taken_from);
    return {};
  }
  OpenLayer source = open_layer(sources.contours, ground_points_role);
  points =
      read_measured_lines(sources.contours, source, sources.elevation_unit_m, reading.notes).points;
  reading.layer = source.name;
  reading.n_features = source.n_features;
  return wkt_of(source.layer->GetSpatialRef());
}

}  // namespace

ContourMap read_ground_points(const ContourSources& sources, ContourReading& reading) {
  ContourMap map;
  map.source = sources.contours.path;
  refuse_laser_scan(map.source);
  const std::string named = read_raw_points(sources, reading, map.spots);
  bring_to_metres(sources, crs_of_contours(sources, named, map.spots), map.spots, map);
  if (!sources.boundary.path.empty())
    map.boundary = read_boundary(sources.boundary, map.crs_wkt, reading.notes);
  make_relative(map);
  check_boundary(map, sources.boundary.path);
  return map;
}

ContourMap read_contours(const ContourSources& sources, ContourReading& reading) {
  ContourMap map;
  map.source = sources.contours.path;
  if (is_point_text(map.source))
    throw InputError({map.source}, "holds columns of text, expected contour lines",
                     "--points makes a TIN of points of the ground");
  OpenLayer source = open_layer(sources.contours, contours_role);
  map.contours = read_contour_lines(sources, source, reading);
  const std::string own_crs =
      crs_of_contours(sources, wkt_of(source.layer->GetSpatialRef()), map.contours.points);
  bring_to_metres(sources, own_crs, map.contours.points, map);
  const HeightRange heights = heights_of(map.contours);
  if (!sources.breaklines.path.empty()) {
    map.breaklines = read_measured(sources.breaklines, breaklines_role, map.crs_wkt,
                                   sources.elevation_unit_m, reading.notes);
    check_units(map.breaklines.points, heights, sources.breaklines.path);
  }
  if (!sources.spots.path.empty()) {
    map.spots = read_measured(sources.spots, spots_role, map.crs_wkt, sources.elevation_unit_m,
                              reading.notes)
                    .points;
    check_units(map.spots, heights, sources.spots.path);
  }
  if (!sources.boundary.path.empty())
    map.boundary = read_boundary(sources.boundary, map.crs_wkt, reading.notes);
  make_relative(map);
  check_boundary(map, sources.boundary.path);
  return map;
}

std::vector<Vec3> read_points(const LayerChoice& choice, const std::string& crs_wkt,
                              std::vector<std::string>& notes) {
  return read_measured(choice, reference_role, crs_wkt, 1, notes).points;
}

void write_points(const std::string& path, const std::string& layer, const std::string& crs_wkt,
                  const Vec3& origin, const std::vector<Vec3>& points) {
  register_gdal_drivers();
  const GdalErrors errors;
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GPKG");
  GDALDatasetUniquePtr dataset(driver->Create(path.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
  OGRSpatialReference crs;
  crs.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  if (!crs_wkt.empty()) crs.importFromWkt(crs_wkt.c_str());
  OGRLayer* out = dataset ? dataset->CreateLayer(layer.c_str(), crs_wkt.empty() ? nullptr : &crs,
                                                 wkbPoint25D, nullptr)
                          : nullptr;
  bool written = out != nullptr && dataset->StartTransaction() == OGRERR_NONE;
  for (std::size_t i = 0; written && i < points.size(); ++i) {
    OGRFeature feature(out->GetLayerDefn());
    const Vec3 place = points[i] + origin;
    OGRPoint point(place.x(), place.y(), place.z());
    feature.SetGeometry(&point);
    written = out->CreateFeature(&feature) == OGRERR_NONE;
  }
  written = written && dataset->CommitTransaction() == OGRERR_NONE;
  dataset.reset();
  if (!written || errors.failed())
    throw InputError({path}, "cannot be written: " + errors.failure());
}

}  // namespace talus
