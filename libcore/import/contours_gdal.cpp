#include "import/contours_gdal.hpp"

#include <ogr_spatialref.h>
#include <ogrsf_frmts.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/error.hpp"
#include "base/source_path.hpp"
#include "base/text.hpp"
#include "import/contour_heights_gdal.hpp"
#include "import/contour_layer_gdal.hpp"
#include "import/crs_operation_gdal.hpp"
#include "import/crs_place_gdal.hpp"
#include "import/drawing_unit_gdal.hpp"
#include "io/crs_gdal.hpp"
#include "io/errors_gdal.hpp"
#include "terrain/elevation.hpp"
#include "terrain/tin_mesh.hpp"

namespace talus {
namespace {

// What the sources of a map are read for.
constexpr LayerRole contours_role{LayerShape::line, "contours", "contours"};
constexpr LayerRole ground_points_role{LayerShape::point, "points", "contours"};
constexpr LayerRole breaklines_role{LayerShape::line, "breaklines", "breaklines"};
constexpr LayerRole spots_role{LayerShape::point, "spot heights", "spots"};
constexpr LayerRole boundary_role{LayerShape::polygon, "boundary", "boundary"};
constexpr LayerRole reference_role{LayerShape::point, "points", "reference"};

// --- reference systems ---------------------------------------------------------------------------

// Whether the user may say that contours are in another system than their file names; notes why.
bool may_be_given(const ContourSources& sources, const std::string& own,
                  const std::vector<Vec3>& points, ContourReading& reading) {
  if (same_crs(own, sources.crs) && same_heights(own, sources.crs)) return height_crs(own).empty();
  const std::string reason = reason_to_replace(own, sources.crs, window_of(points));
  if (reason.empty())
    throw InputError({sources.contours.path},
                     "the CRS is " + crs_name(own) + ", not " + crs_name(sources.crs),
                     "leave --crs away; --t-srs reprojects");
  reading.notes.push_back(sources.contours.path + ": the CRS is " + crs_name(own) + ", " + reason +
                          "; taken as " + crs_name(sources.crs));
  return true;
}

std::string crs_of_contours(const ContourSources& sources, const OpenLayer& source,
                            const std::vector<Vec3>& points, ContourReading& reading) {
  const std::string named = wkt_of(source.layer->GetSpatialRef());
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
  if (own.empty()) return sources.crs;
  return sources.crs_given && may_be_given(sources, own, points, reading) ? sources.crs : own;
}

void check_crs(const std::string& crs, const std::string& path, const Vec3& place) {
  if (crs.empty()) return;
  const CrsProblem problem = find_crs_problem(crs, place.head<2>());
  if (problem.finding.empty()) return;
  throw InputError(
      {path}, problem.finding,
      "--t-srs " + (problem.mend_to.empty() ? "EPSG:code" : problem.mend_to) + " reprojects");
}

// Whether the coordinates of a source can be in `crs`, to be used in `work_crs`.
void check_place_of(const LayerChoice& choice, const OpenLayer& source, const std::string& crs,
                    const std::string& work_crs, const std::vector<Vec3>& points,
                    ContourReading& reading) {
  if (crs.empty() || points.empty()) return;
  CrsExtent place{crs, window_of(points, crs), work_crs};
  place.has_crs_option = place.has_unit_option = std::string(source.role.input) == "contours";
  place.layer = source.layer->GetName();
  place.geometry_column = source.layer->GetGeometryColumn();
  for (const std::string& warning : check_place(place, {parse_source_path(choice.path).source}))
    reading.warnings.push_back(warning);
}

// --- units ---------------------------------------------------------------------------------------

// Metres in one unit of the coordinates as they stand in the source; 1 also where the CRS has the
// unit of the drawing, which takes care of it in plan.
double plan_unit_of(const LayerChoice& choice, const OpenLayer& source, const std::string& crs,
                    ContourReading& reading) {
  const std::string opened = source.dataset->GetDescription();
  if (const std::string doubt = doubt_on_unit(opened, choice.unit_m); !doubt.empty())
    reading.warnings.push_back(choice.path + ": " + doubt);
  const DrawingUnit unit = drawing_unit(opened);
  const std::string metres = unit.metres > 0 ? text(unit.metres) : "METRES";
  const std::string option = option_words(source.role, "--unit-m");
  return scale_of_drawing(opened, choice.unit_m, length_unit_m(crs), {choice.path},
                          option + metres + " scales plan and heights; " + option +
                              "1 if it is in metres whatever its header says");
}

void scale_plan(double unit_m, std::vector<Vec3>& points) {
  if (unit_m == 1) return;
  for (Vec3& point : points) point.head<2>() *= unit_m;
}

// What the user says of the unit of heights; 0: nothing.
double unit_by_user(const LayerChoice& choice, double elevation_unit_m) {
  return elevation_unit_m > 0 ? elevation_unit_m : choice.unit_m;
}

// Metres in one unit of the heights that were read: what the user says, or their system of heights.
double height_unit_of(const LayerChoice& choice, const OpenLayer& source, const std::string& crs,
                      double by_user_m, ContourReading& reading, LayerReading& taken) {
  const bool has_option = source.role.input != std::string(reference_role.input);
  const double plan_unit_m = length_unit_m(crs);
  const std::string way_out =
      has_option ? "--elevation-unit-m METRES: " + text(plan_unit_m, 12) +
                       " where they are in the unit of the plan, 1 where they are metres"
                 : "name the system of heights with the CRS in the file, e.g. NAVD88 in US survey "
                   "feet: ogr2ogr -a_srs " +
                       crs_code(crs) + "+6360 named.gpkg " + command_words(choice.path) +
                       "; in metres: " + crs_code(crs) + "+5703";
  taken.unit_m = by_user_m > 0 ? by_user_m : height_unit_m(crs, {choice.path}, way_out);
  if (by_user_m == 0 && taken.unit_m == 1 && is_in_feet(taken.elevation_from))
    throw InputError(
        where_of_layer(choice, source),
        "the " + taken.elevation_from + " is in feet by its name, expected metres",
        has_option ? "--elevation-unit-m 0.3048 (or 0.3048006096 for US survey feet)" : way_out);
  if (by_user_m == 0 && taken.unit_m != 1)
    reading.notes.push_back(choice.path + ": heights in " + crs_name(height_crs(crs)) +
                            ", taken to metres");
  return taken.unit_m;
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

// Heights stay as they are. What was done is noted.
void bring_to(const std::string& from, const std::string& to, const std::string& path,
              bool accept_ballpark, std::vector<Vec3>& points, ContourReading& reading) {
  const CrsOperation operation =
      find_operation(from, to, window_of(points, from), {path}, accept_ballpark);
  if (!carry_out(operation, points))
    throw InputError({path},
                     "cannot be reprojected from " + crs_name(from) + " to " + crs_name(to));
  reading.operations.push_back(path + ": " + sentence_on(operation));
  if (const std::string doubt = doubt_on(operation); !doubt.empty())
    reading.warnings.push_back(path + ": " + doubt);
}

// The CRS of an additional source, reprojected with a note.
void bring_to_map(const LayerChoice& choice, const OpenLayer& source, const std::string& map_crs,
                  bool accept_ballpark, std::vector<Vec3>& points, ContourReading& reading) {
  const std::string own = wkt_of(source.layer->GetSpatialRef());
  const bool no_degrees = is_beyond_degrees(own, points);
  if (no_degrees || own.empty() != map_crs.empty())
    reading.notes.push_back(choice.path + ": taken to be in the CRS of the map" +
                            (no_degrees ? ": its coordinates are no degrees" : ""));
  const bool is_in_map = no_degrees || own.empty() || map_crs.empty() || same_crs(own, map_crs);
  check_place_of(choice, source, is_in_map ? map_crs : own, map_crs, points, reading);
  if (!is_in_map) bring_to(own, map_crs, choice.path, accept_ballpark, points, reading);
}

// Takes heights to the system that is asked for; `map_crs` is the one that they are in.
void bring_heights_to(const ContourSources& sources, const std::string& path,
                      const std::string& map_crs, std::vector<Vec3>& points,
                      ContourReading& reading) {
  if (sources.t_vertical.empty() || points.empty()) return;
  const std::string from = sources.vertical_crs == ellipsoidal_heights
                               ? sources.vertical_crs
                               : stated_heights(map_crs, {path});
  if (same_system(from, sources.t_vertical)) return;
  const HeightOperation operation(map_crs, from, sources.t_vertical, window_of(points), {path});
  operation.apply(points);
  reading.operations.push_back(path + ": " + operation.sentence());
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
                        const ContourSources& sources, const std::string& map_crs,
                        ContourReading& reading, LayerReading& taken) {
  OpenLayer source = open_layer(choice, role);
  const std::string own_crs = wkt_of(source.layer->GetSpatialRef());
  const std::string& crs = own_crs.empty() ? map_crs : own_crs;
  const double plan_unit_m = plan_unit_of(choice, source, crs, reading);
  Polylines lines = read_measured_lines(choice, source, reading.notes, taken);
  const double unit_m = height_unit_of(
      choice, source, crs, unit_by_user(choice, sources.elevation_unit_m), reading, taken);
  scale_plan(plan_unit_m, lines.points);
  bring_to_map(choice, source, map_crs, sources.accept_ballpark, lines.points, reading);
  check_heights_alike(own_crs, map_crs, choice.path);
  const std::string assumed = assumed_heights(own_crs, map_crs);
  if (unit_m == 1 && !assumed.empty())
    reading.notes.push_back(choice.path + " and the map: both are " + assumed);
  scale_heights(unit_m, choice.path, lines.points);
  bring_heights_to(sources, choice.path, map_crs, lines.points, reading);
  return lines;
}

std::vector<BoundaryRing> read_boundary(const ContourSources& sources, const std::string& map_crs,
                                        ContourReading& reading) {
  const LayerChoice& choice = sources.boundary;
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
  reading.boundary = reading_of(choice, source);
  reading.notes.push_back(without_layer(choice.path) + ": layer " + source.name + ", " +
                          counted(n_polygons, "polygon"));
  add_remarks(reading.boundary, reading.notes);
  scale_plan(plan_unit_of(choice, source, map_crs, reading), points);
  bring_to_map(choice, source, map_crs, sources.accept_ballpark, points, reading);
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

// What the user says of heights whose file does not; a system of heights holds for its own unit.
std::string with_user_heights(const ContourSources& sources, const std::string& crs,
                              double unit_m) {
  if (unit_m != 1 && sources.vertical_crs.empty()) return horizontal_crs(crs);
  const std::string plan = unit_m != 1 ? horizontal_crs(crs) : crs;
  return sources.vertical_crs.empty()
             ? plan
             : with_stated_heights(plan, sources.vertical_crs, {sources.contours.path});
}

// Metres in one unit of the contours, or of the points that stand for them.
double plan_unit_of_map(const ContourSources& sources, const OpenLayer& source,
                        ContourReading& reading) {
  const std::string named = wkt_of(source.layer->GetSpatialRef());
  return plan_unit_of(sources.contours, source, named.empty() ? sources.crs : named, reading);
}

// Metres in one unit of the heights of the contours, or of the points that stand for them, which
// are in the system `named`. A system that the user names is in metres.
double height_unit_of_map(const ContourSources& sources, const OpenLayer& source,
                          const std::string& named, ContourReading& reading) {
  double by_user_m = unit_by_user(sources.contours, sources.elevation_unit_m);
  if (by_user_m == 0 && !sources.vertical_crs.empty() && height_crs(named).empty()) by_user_m = 1;
  return height_unit_of(sources.contours, source, named, by_user_m, reading, reading.contours);
}

// Points as they stand in the source to the system that is computed in, and to metres of height.
void take_to_map(const ContourSources& sources, const OpenLayer& source, std::vector<Vec3>& points,
                 ContourMap& map, ContourReading& reading) {
  scale_plan(plan_unit_of_map(sources, source, reading), points);
  const std::string named = crs_of_contours(sources, source, points, reading);
  if (named.empty() && !sources.t_srs.empty())
    throw InputError({map.source}, "local metres cannot be reprojected", "leave --t-srs away");
  const bool is_there = sources.t_srs.empty() || same_crs(named, sources.t_srs);
  if (is_there) check_crs(horizontal_crs(named), map.source, points.front());
  const double unit_m = height_unit_of_map(sources, source, named, reading);
  const std::string own = with_user_heights(sources, named, unit_m);
  map.crs_wkt = sources.t_srs.empty() ? own : with_heights_of(own, sources.t_srs, {map.source});
  check_place_of(sources.contours, source, own, map.crs_wkt, points, reading);
  if (!is_there) {
    bring_to(own, sources.t_srs, map.source, sources.accept_ballpark, points, reading);
    check_crs(map.crs_wkt, map.source, points.front());
  }
  scale_heights(unit_m, map.source, points);
  bring_heights_to(sources, map.source, map.crs_wkt, points, reading);
}

void read_contours_to(const ContourSources& sources, ContourMap& map, ContourReading& reading) {
  OpenLayer source = open_layer(sources.contours, contours_role);
  map.contours = read_contour_lines(sources, source, reading);
  add_remarks(reading.contours, reading.notes);
  take_to_map(sources, source, map.contours.points, map, reading);
}

// The boundary, the system of heights, the origin.
void finish_map(const ContourSources& sources, ContourMap& map, ContourReading& reading) {
  if (!sources.boundary.path.empty()) map.boundary = read_boundary(sources, map.crs_wkt, reading);
  if (!sources.t_vertical.empty())
    map.crs_wkt = with_heights(horizontal_crs(map.crs_wkt), sources.t_vertical, {map.source});
  make_relative(map);
  check_boundary(map, sources.boundary.path);
}

// Laser scans take a library that not every system has; text takes none.
void refuse_laser_scan(const std::string& path) {
  const std::string extension = lower(std::filesystem::path(path).extension().string());
  if (extension != ".las" && extension != ".laz" && extension != ".e57") return;
  throw InputError({path}, "is a laser scan, which is not read as it is",
                   "pdal translate " + command_words(path) +
                       " ground.csv -f filters.range "
                       "--filters.range.limits=\"Classification[2:2]\" "
                       "--writers.text.order=X,Y,Z --writers.text.keep_unspecified=false");
}

}  // namespace

ContourMap read_ground_points(const ContourSources& sources, ContourReading& reading) {
  ContourMap map;
  map.source = sources.contours.path;
  refuse_laser_scan(map.source);
  OpenLayer source = open_layer(sources.contours, ground_points_role);
  map.spots = read_measured_lines(sources.contours, source, reading.notes, reading.contours).points;
  reading.layer = source.name;
  reading.n_features = source.n_features;
  reading.elevation_from = reading.contours.elevation_from;
  take_to_map(sources, source, map.spots, map, reading);
  finish_map(sources, map, reading);
  return map;
}

ContourMap read_contours(const ContourSources& sources, ContourReading& reading) {
  ContourMap map;
  map.source = sources.contours.path;
  refuse_laser_scan(map.source);
  read_contours_to(sources, map, reading);
  const HeightRange heights = heights_of(map.contours);
  if (!sources.breaklines.path.empty()) {
    map.breaklines = read_measured(sources.breaklines, breaklines_role, sources, map.crs_wkt,
                                   reading, reading.breaklines);
    check_units(map.breaklines.points, heights, sources.breaklines.path);
  }
  if (!sources.spots.path.empty()) {
    map.spots =
        read_measured(sources.spots, spots_role, sources, map.crs_wkt, reading, reading.spots)
            .points;
    check_units(map.spots, heights, sources.spots.path);
  }
  finish_map(sources, map, reading);
  return map;
}

std::vector<Vec3> read_points(const LayerChoice& choice, const std::string& crs_wkt,
                              std::vector<std::string>& notes, LayerReading& taken) {
  ContourReading reading;
  const std::vector<Vec3> points =
      read_measured(choice, reference_role, {}, crs_wkt, reading, taken).points;
  for (const auto* sentences : {&reading.notes, &reading.operations, &reading.warnings})
    notes.insert(notes.end(), sentences->begin(), sentences->end());
  return points;
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
