#include "site_places.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "base/text.hpp"
#include "dda/site_fence.hpp"
#include "io/crs_gdal.hpp"
#include "vector_inputs.hpp"

namespace talus {
namespace {

// Refuses, or warns of, a fence that lies on another one.
void check_apart(Tool& tool, const Site& site, const Trn& trn, const FenceLine& one,
                 const FenceLine& other) {
  const Vec2 place = one.line.points.front().head<2>() + trn.origin.head<2>();
  const std::string finding = "lies on fence " + other.line.name + " all along, from " +
                              text(place.x(), 9) + ", " + text(place.y(), 9) + " on";
  if (one.fence != other.fence && !(one.fence->active && other.fence->active)) {
    tool.warn("fence " + one.line.name + " " + finding + ": both count the same blocks");
    return;
  }
  throw InputError({site.file, one.fence->line_number, "fence." + one.line.name},
                   finding + ": the same fence would stand there twice",
                   one.fence == other.fence
                       ? "delete the repeated line in the file"
                       : "leave one of the two sections out, or set its active = false");
}

}  // namespace

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
  const Where where{site.file, fence.line_number, "fence." + fence.name};
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
        tool, section,
        {path, fence.line_layer, fence.line_where, VectorKind::lines, section + ".line_"},
        trn.crs_wkt);
    for (std::vector<Vec3>& line : shapes.shapes) {
      for (Vec3& point : line) point -= trn.origin;
      found.push_back(std::move(line));
    }
  }
  if (found.empty()) throw InputError(where, "has no line", "give line or line_file");
  std::vector<RecordLine> lines;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (fence.active) check_feet(fence, trn, found[i], where);
    std::vector<Vec2> corners;
    for (const Vec3& point : found[i]) corners.push_back(point.head<2>());
    lines.push_back(record_line(fence.name + (found.size() > 1 ? "." + std::to_string(i + 1) : ""),
                                posts_on_ground(trn, corners, fence.post_spacing_m, where)));
  }
  return lines;
}

void check_fences_apart(Tool& tool, const Site& site, const Trn& trn,
                        const std::vector<FenceLine>& lines) {
  for (std::size_t later = 0; later < lines.size(); ++later)
    for (std::size_t earlier = 0; earlier < later; ++earlier) {
      const RecordLine &one = lines[later].line, &other = lines[earlier].line;
      if (lies_along(one.points, other.points))
        check_apart(tool, site, trn, lines[later], lines[earlier]);
      else if (lies_along(other.points, one.points))
        check_apart(tool, site, trn, lines[earlier], lines[later]);
    }
}

}  // namespace talus
