#include "site_places.hpp"

#include "base/error.hpp"
#include "io/crs_gdal.hpp"

namespace talus {

std::vector<Vec3> local_points(Tool& tool, const Site& site, const Trn& ground,
                               std::vector<Vec3> points, const std::string& key) {
  const std::string& user_crs = site.info.crs;
  if (!user_crs.empty() && !points.empty() && !ground.crs_wkt.empty()) {
    const std::string crs = crs_from_user(user_crs, "site.crs");
    if (!crs.empty() && !same_crs(crs, ground.crs_wkt)) {
      if (!reproject(crs, ground.crs_wkt, points))
        throw InputError(where_of(site, key), "cannot be reprojected from " + crs_name(crs) +
                                                  " to " + crs_name(ground.crs_wkt));
      tool.info(key + ": reprojected from " + crs_name(crs));
    }
  }
  for (Vec3& p : points) p -= ground.origin;
  return points;
}

}  // namespace talus
