// libcore/io/crs_gdal.hpp
// Coordinate reference systems: which are fit for metres, and which one would mend one that is not.
#pragma once

#include <string>
#include <vector>

#include "base/types.hpp"

class OGRSpatialReference;

namespace talus {

/// WKT2:2019; empty for a null or empty reference, one called undefined (GeoPackage), and a local
/// one in metres: it names no place (GeoTIFF makes one up, "unnamed", for a raster without a CRS).
[[nodiscard]] std::string wkt_of(const OGRSpatialReference* srs);

/// WKT2:2019 of what a user writes: "EPSG:31287", a PROJ string, WKT, the name of a file. "none"
/// gives an empty text: local metres without a place on the map. Throws InputError that names
/// `option` when it is not understood.
[[nodiscard]] std::string crs_from_user(const std::string& user_text, const std::string& option);

/// "EPSG:31287 (MGI / Austria Lambert)", or the name alone, or "no CRS".
[[nodiscard]] std::string crs_name(const std::string& crs_wkt);

/// Whether both describe the same system; two empty ones do.
[[nodiscard]] bool same_crs(const std::string& a, const std::string& b);

/// Whether points cannot stand in the geographic system that their file names: a latitude above 90
/// degrees or a longitude above 360. A GeoJSON without `crs` says degrees whatever it holds. False
/// for other systems.
[[nodiscard]] bool is_beyond_degrees(const std::string& crs_wkt, const std::vector<Vec3>& points);

/// Takes points from one CRS to another, x (east, longitude) first; heights stay as they are. False
/// when a point cannot be taken there; `points` are then spoilt.
[[nodiscard]] bool reproject(const std::string& from, const std::string& to,
                             std::vector<Vec3>& points);

/// Why a CRS cannot be computed in, and what to reproject to.
struct CrsProblem {
  std::string finding;  ///< "the CRS is EPSG:4326 (WGS 84), in degrees, expected ..."; empty: none
  std::string mend_to;  ///< UTM zone of the place, "EPSG:32632"; empty when it cannot be told
};

/// Geographic, geocentric and Mercator systems, feet in plan or in height have a problem;
/// projected and local systems in metres have none. `place` is any point of the data in this CRS,
/// x (east, longitude) first.
[[nodiscard]] CrsProblem find_crs_problem(const std::string& crs_wkt, const Vec2& place);

}  // namespace talus
