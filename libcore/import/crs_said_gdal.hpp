// libcore/import/crs_said_gdal.hpp: public
// The system of what a file holds: the one that it names, or the one that the user says. One rule
// for layers, elevation models and TINs.
#pragma once

#include <string>
#include <vector>

#include "terrain/grid_frame.hpp"

namespace talus {

inline constexpr const char* way_to_name_crs =
    "name it with --crs EPSG:code, or --crs none for local metres";

/// What the user says of the system of a file.
struct CrsByUser {
  bool is_given = false;
  bool may_be_missing = false;  ///< no CRS and none given means local metres
  std::string crs;              ///< WKT; empty: local metres
  const char* way_out = "leave --crs away; --t-srs reprojects";  ///< where the file has another one
};

/// WKT; empty for local metres. The user's system takes the place of one that is missing, that says
/// no heights, or that cannot be true for what lies in `extent`; a note says why. Throws InputError
/// where there is none, or the file has another one.
[[nodiscard]] std::string crs_said(const std::string& own, const CrsByUser& by_user,
                                   const MapWindow& extent, const std::string& path,
                                   std::vector<std::string>& notes);

/// Throws InputError, with the option that reprojects, where a system cannot be computed in.
void check_can_be_computed_in(const std::string& crs, const Vec3& place, const std::string& path);

}  // namespace talus
