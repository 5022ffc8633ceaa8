// libcore/import/crs_place_gdal.hpp: public
// Whether coordinates fit their system: inside its area of use, with x to the east and y to the
// north, metres that are metres; and their likely reading where they do not.
// in:    a system, the extent of the data, the system of the computation
// out:   nothing; a warning; or InputError with the finding and a remedy
// refs:  Snyder (1987), Map projections (scale factors)
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/types.hpp"
#include "terrain/grid_frame.hpp"

namespace talus {

/// Longitudes and latitudes [degrees]; east < west where it spans the antimeridian.
struct DegreeWindow {
  bool known = false;  ///< false: the corners have no place on the Earth
  double west = 0, south = 0, east = 0, north = 0;
};

/// Where a window of the map lies, on the datum of its system.
[[nodiscard]] DegreeWindow degrees_of(const std::string& crs_wkt, const MapWindow& window);

/// Longitude and latitude [degrees] of a place on its own datum; nothing where the projection does
/// not reach.
[[nodiscard]] std::optional<Vec2> degrees_at(const std::string& crs_wkt, const Vec2& place);

/// UTM zone of a longitude and latitude [degrees] on the datum of a system, "EPSG:32632"; empty
/// near the poles.
[[nodiscard]] std::string utm_zone(const std::string& crs_wkt, const Vec2& longitude_latitude);

/// Why a CRS cannot be used for computing, and the system to reproject to.
struct CrsProblem {
  std::string finding;  ///< "the CRS is EPSG:4326 (WGS 84), in degrees, expected ..."; empty: none
  std::string mend_to;  ///< UTM zone of the place, "EPSG:32632"; empty when it cannot be told
  double height_unit_m = 1;  ///< not 1: the system is fit in plan, its heights are not in metres
};

/// Geographic and geocentric systems, feet in plan or in height have a problem; projected and local
/// systems in metres have none (check_place judges the metres). `place` is any point of
/// the data in this CRS, x (east, longitude) first.
[[nodiscard]] CrsProblem find_crs_problem(const std::string& crs_wkt, const Vec2& place);

/// Extent of the data, and the user's options to state their system.
struct CrsExtent {
  std::string crs_wkt;           ///< of the coordinates; empty: local, nothing is checked
  MapWindow extent;              ///< of the data; of a raster the outer edges of its cells
  std::string work_wkt{};        ///< system of the computation; empty: crs_wkt
  bool has_crs_option = false;   ///< the tool has --crs and --t-srs for this file
  bool has_unit_option = false;  ///< and --unit-m
  bool is_raster = false;
  std::string layer{}, geometry_column{};  ///< of a vector source, for commands
  std::string way_to_other_crs{};  ///< for data that are not reprojected; the code of the system
                                   ///< follows
  std::string crs_said_in{};  ///< source of the CRS of coordinates that are in no vector source or
                              ///< raster
};

/// Throws InputError at `where` when the coordinates lie far outside the area that their system, or
/// the one computed in, is made for, when x does not run to the east and y to the north, or when a
/// metre on the map is not within 1 % of one on the ground. The finding says which reading would
/// fit: x and y exchanged, degrees, feet, millimetres, zone numbers before the eastings ... In
/// doubt are places somewhat outside, and a grid north far from north.
void check_place(const CrsExtent& place, const Where& where, std::vector<Doubt>& doubts);

/// Why a user may give a file another system than it names: its coordinates cannot be in that one,
/// or that has no known datum and the other the same projection. Goes on "the CRS is EPSG:25832,
/// ..."; empty: no reason.
[[nodiscard]] std::string reason_to_replace(const std::string& own, const std::string& given,
                                            const MapWindow& extent);

/// x, or the longitude that is the same as x in `crs_wkt` and less than 180 degrees from `other`.
[[nodiscard]] std::function<double(double x, double other)> on_one_side(const std::string& crs_wkt);

/// The smallest window that holds the points, which are in `crs_wkt`: longitudes count modulo 360
/// degrees, so that it reaches beyond 180 degrees where the points lie on both sides.
[[nodiscard]] MapWindow window_of(const std::vector<Vec3>& points, const std::string& crs_wkt = {});

}  // namespace talus
