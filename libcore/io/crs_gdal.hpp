// libcore/io/crs_gdal.hpp: public
// Coordinate reference systems: names, parts and comparison of plans and heights.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/types.hpp"

class OGRSpatialReference;

namespace talus {

/// WKT2:2019; empty for a null or empty reference, one called undefined (GeoPackage), and a local
/// one in metres: it names no place (GeoTIFF makes one up, "unnamed", for a raster without a CRS).
[[nodiscard]] std::string wkt_of(const OGRSpatialReference* srs);

/// For GDAL, x east and y north. Throws InputError for a text that is not WKT of a system.
[[nodiscard]] OGRSpatialReference parsed_crs(const std::string& crs_wkt);

/// WKT2:2019 of a user's text: "EPSG:31287", a PROJ string, WKT, the name of a file. "none"
/// gives an empty text: local metres without a place on the map. Throws InputError that names
/// `option` when it is not understood.
[[nodiscard]] std::string crs_from_user(const std::string& user_text, const std::string& option);

/// "EPSG:31287 (MGI / Austria Lambert)", or the name alone, or "no CRS".
[[nodiscard]] std::string crs_name(const std::string& crs_wkt);

/// The name of the system in plan for a command: "EPSG:31287", also where a .prj leaves the code
/// out; the quoted WKT of one that has no code.
[[nodiscard]] std::string crs_code(const std::string& crs_wkt);

/// Metres in one unit of the plan; 1 for degrees.
[[nodiscard]] double length_unit_m(const std::string& crs_wkt);

/// Whether it is a local system, which has no place on the Earth.
[[nodiscard]] bool is_local(const std::string& crs_wkt);

/// Whether both describe the same system in plan, whatever system their heights are in; two empty
/// ones do.
[[nodiscard]] bool same_crs(const std::string& a, const std::string& b);

/// The part of a system that places points in plan.
[[nodiscard]] std::string horizontal_crs(const std::string& crs_wkt);

/// WKT of the system that heights are in ("EGM96 height"); empty when it is not said.
[[nodiscard]] std::string height_crs(const std::string& crs_wkt);

/// Metres in one unit of heights that are in `crs_wkt`, without other statements on them: that of
/// the system of heights, else a metre. Nothing where there is none and the plan is in another unit
/// (feet): its heights may be in either, and a plan that is reprojected alone would leave slopes
/// 3.28 times too steep.
[[nodiscard]] std::optional<double> height_unit_m(const std::string& crs_wkt);

/// Whether the heights may be compared: false when both say their system and it is not the same.
[[nodiscard]] bool same_heights(const std::string& a, const std::string& b);

/// "taken to have heights in EPSG:5773 (EGM96 height)" when one of the two says its system of
/// heights and the other does not; empty when there is nothing to assume.
[[nodiscard]] std::string assumed_heights(const std::string& a, const std::string& b);

/// The system `plan` with heights in the vertical system `vertical` (WKT).
[[nodiscard]] std::string with_heights(const std::string& plan, const std::string& vertical,
                                       const Where& where);

/// The system `plan` with the heights of `other`, where that names them: the system of data that
/// were reprojected in plan. Throws InputError when `plan` says another system of heights.
[[nodiscard]] std::string with_heights_of(const std::string& other, const std::string& plan,
                                          const Where& where);

/// Whether nothing is known of the datum but its ellipsoid ("+proj=tmerc +ellps=bessel"): then no
/// operation leads to another system.
[[nodiscard]] bool has_unknown_datum(const std::string& crs_wkt);

/// Whether points cannot be in the geographic system that their file names: a latitude above 90
/// degrees or a longitude above 360. A GeoJSON without `crs` says degrees whatever it holds. False
/// for other systems.
[[nodiscard]] bool is_beyond_degrees(const std::string& crs_wkt, const std::vector<Vec3>& points);

}  // namespace talus
