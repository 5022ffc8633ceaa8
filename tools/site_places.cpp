#include "site_places.hpp"

#include "base/error.hpp"
#include "io/crs_gdal.hpp"
#include "vector_inputs.hpp"

namespace talus {

std::vector<Vec3> local_points(Tool& tool, const Site& site, const Trn& ground,
                               std::vector<Vec3> points, const std::string& key) {
  const std::string& user_crs = site.info.crs;
  if (!user_crs.empty() && !points.empty() && !ground.crs_wkt.empty()) {
    const std::string crs = crs_from_user(user_crs, "site.crs");
    if (!crs.empty() && !same_crs(crs, ground.crs_wkt)) {
      if (!reproject(crs, ground.crs_wkt, points))
        throw InputError(
            where_of(site, key),
            "cannot be reprojected from " + crs_name(crs) + " to " + crs_name(ground.crs_wkt),
            "check crs of [site]: it is that of the coordinates in the site file");
      tool.info(key + ": reprojected from " + crs_name(crs));
    }
  }
  for (Vec3& p : points) p -= ground.origin;
  return points;
}

std::vector<RecordLine> fence_lines(Tool& tool, const Site& site, const Trn& trn,
                                    const FenceSettings& fence) {
  const Where where = where_of_fence(site.file, fence);
  if (!fence.line.empty() && !fence.line_file.empty())
    throw InputError(where, "has both line and line_file", "say where the fence is, once");
  std::vector<std::vector<Vec3>> found;
  if (!fence.line.empty())
    found.push_back(local_points(tool, site, trn, fence.line, "fence." + fence.name + ".line"));
  if (!fence.line_file.empty()) {
    const std::string path = resolved(site, fence.line_file);
    tool.read_also("fence." + fence.name, path);
    const std::string section = "fence." + fence.name;
    VectorShapes shapes = read_layer(
        tool, section, {path, fence.line_layer, "", VectorKind::lines, section + ".line_"},
        trn.crs_wkt);
    for (std::vector<Vec3>& line : shapes.shapes) {
      for (Vec3& point : line) point -= trn.origin;
      found.push_back(std::move(line));
    }
  }
  return lines_of_fence(fence, trn, found, where);
}

void check_fences_apart(Tool& tool, const Site& site, const Trn& trn,
                        const std::vector<FenceLine>& lines) {
  for (const std::string& doubt : check_fences_apart(site.file, trn, lines)) tool.warn(doubt);
}

}  // namespace talus
