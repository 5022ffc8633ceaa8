#include "import/crs_said_gdal.hpp"

#include <cmath>

#include "base/error.hpp"
#include "import/crs_place_gdal.hpp"
#include "io/crs_gdal.hpp"

namespace talus {

std::string crs_said(const std::string& own, const CrsByUser& by_user, const MapWindow& extent,
                     const std::string& path, std::vector<std::string>& notes) {
  if (own.empty() && !by_user.is_given && !by_user.may_be_missing)
    throw InputError({path}, "there is no CRS, expected a projected one in metres",
                     way_to_name_crs);
  if (own.empty()) return by_user.crs;
  if (!by_user.is_given) return own;
  if (same_crs(own, by_user.crs) && same_heights(own, by_user.crs))
    return height_crs(own).empty() ? by_user.crs : own;
  const bool has_extent = std::isfinite(extent.x_min + extent.y_min + extent.x_max + extent.y_max);
  const std::string reason =
      has_extent ? reason_to_replace(own, by_user.crs, extent) : std::string();
  if (reason.empty())
    throw InputError({path}, "the CRS is " + crs_name(own) + ", not " + crs_name(by_user.crs),
                     by_user.way_out);
  notes.push_back(path + ": the CRS is " + crs_name(own) + ", " + reason + "; taken as " +
                  crs_name(by_user.crs));
  return by_user.crs;
}

void check_can_be_computed_in(const std::string& crs, const Vec3& place, const std::string& path) {
  if (crs.empty()) return;
  const CrsProblem problem = find_crs_problem(crs, place.head<2>());
  if (problem.finding.empty()) return;
  throw InputError(
      {path}, problem.finding,
      "--t-srs " + (problem.mend_to.empty() ? "EPSG:code" : problem.mend_to) + " reprojects");
}

}  // namespace talus
