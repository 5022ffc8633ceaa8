// Chooses the systems of coordinates and heights of a file, and the operations between them.
#include "import/systems_gdal.hpp"

#include <cmath>

#include "base/error.hpp"
#include "import/crs_place_gdal.hpp"
#include "io/crs_gdal.hpp"

namespace talus {

std::string crs_said(const FileInSystem& file, const SystemsByUser& said,
                     std::vector<std::string>& notes) {
  const auto& [path, own, extent, may_be_missing, is_reprojected] = file;
  if (own.empty() && !said.crs_given && !may_be_missing)
    throw InputError({path}, "there is no CRS, expected a projected one in metres",
                     way_to_name_crs);
  if (own.empty()) return said.crs;
  if (!said.crs_given) return own;
  if (same_crs(own, said.crs) && same_heights(own, said.crs))
    return height_crs(own).empty() ? said.crs : own;
  const bool has_extent = std::isfinite(extent.x_min + extent.y_min + extent.x_max + extent.y_max);
  const std::string reason = has_extent ? reason_to_replace(own, said.crs, extent) : std::string();
  if (reason.empty())
    throw InputError(
        {path}, "the CRS is " + crs_name(own) + ", not " + crs_name(said.crs),
        std::string("leave --crs away") + (is_reprojected ? "; --t-srs reprojects" : ""));
  notes.push_back(path + ": the CRS is " + crs_name(own) + ", " + reason + "; taken as " +
                  crs_name(said.crs));
  return said.crs;
}

std::string with_heights_said(const std::string& crs, const SystemsByUser& said,
                              const std::string& path) {
  return said.vertical_crs.empty() ? crs : with_stated_heights(crs, said.vertical_crs, {path});
}

CrsOperation plan_operation(const std::string& from, const std::string& to, const MapWindow& window,
                            const Where& where, bool accept_ballpark,
                            std::vector<std::string>& notes, std::vector<Doubt>& doubts) {
  CrsOperation operation = find_operation(from, to, window, where, accept_ballpark);
  notes.push_back(where.file + ": " + sentence_on(operation));
  if (const std::string found = doubt_on(operation); !found.empty())
    doubts.push_back(doubt_on({where.file}, found));
  return operation;
}

std::unique_ptr<HeightOperation> height_operation(const std::string& crs, const SystemsByUser& said,
                                                  const MapWindow& window,
                                                  const std::string& path) {
  if (said.t_vertical.empty()) return nullptr;
  const std::string from =
      said.vertical_crs == ellipsoidal_heights ? said.vertical_crs : stated_heights(crs, {path});
  if (same_system(from, said.t_vertical)) return nullptr;
  return std::make_unique<HeightOperation>(crs, from, said.t_vertical, window, Where{path});
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
