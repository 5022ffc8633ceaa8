#include "tools/frame/site_places.hpp"

#include "base/error.hpp"
#include "io/crs_gdal.hpp"
#include "io/crs_operation_gdal.hpp"
#include "io/crs_place_gdal.hpp"
#include "tools/frame/vector_inputs.hpp"

namespace talus {
namespace {

// Map coordinates of the site file, in the CRS of the terrain.
void bring_to_ground(Tool& tool, const Site& site, const Trn& ground, const std::string& key,
                     std::vector<Vec3>& points) {
  const std::string said =
      site.info.crs.empty() ? std::string() : crs_from_user(site.info.crs, "site.crs");
  const std::string crs = said.empty() ? ground.crs_wkt : said;
  const Where where = where_of(site, key);
  Place place{crs, window_of(points), ground.crs_wkt};
  place.crs_said_in = said.empty() ? "the terrain" : "crs of [site]";
  for (const std::string& warning : check_place(place, where)) tool.warn(warning);
  if (same_crs(crs, ground.crs_wkt)) return;
  const CrsOperation operation = find_operation(crs, ground.crs_wkt, window_of(points), where);
  if (!carry_out(operation, points))
    throw InputError(
        where, "cannot be reprojected from " + crs_name(crs) + " to " + crs_name(ground.crs_wkt),
        "check crs of [site]: it is that of the coordinates in the site file");
  tool.info(key + ": " + sentence_on(operation));
  tool.record(key + ": " + sentence_on(operation));
  if (const std::string doubt = doubt_on(operation); !doubt.empty()) tool.warn(key + ": " + doubt);
}

}  // namespace

std::vector<Vec3> local_points(Tool& tool, const Site& site, const Trn& ground,
                               std::vector<Vec3> points, const std::string& key) {
  if (!points.empty() && !ground.crs_wkt.empty()) bring_to_ground(tool, site, ground, key, points);
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
    read_data(tool, "fence." + fence.name, path);
    const std::string section = "fence." + fence.name;
    VectorShapes shapes = read_layer(
        tool, section,
        {path, fence.line_layer, fence.line_where, VectorKind::lines, section + ".line_"},
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
