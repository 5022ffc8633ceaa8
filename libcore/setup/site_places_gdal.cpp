// Places of a site file in the local coordinates of the terrain.
#include "setup/site_places_gdal.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.hpp"
#include "base/text.hpp"
#include "io/areas_gdal.hpp"
#include "io/polygons_gdal.hpp"
#include "scene/site_fence.hpp"
#include "setup/site_dams_gdal.hpp"
#include "setup/site_shapes_gdal.hpp"
#include "terrain/extent_text.hpp"

namespace talus {
namespace {

// The part of a segment, as shares of its length, that lies within `near` of another one.
std::pair<double, double> part_near(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d,
                                    double near) {
  const double length = (b - a).norm();
  const Vec2 along = (b - a) / length, across(-along.y(), along.x());
  const Vec2 from((c - a).dot(along), (c - a).dot(across));
  const Vec2 to((d - a).dot(along), (d - a).dot(across));
  double low = 0, high = 1;  // shares of c-d whose distance across is at most `near`
  const double rise = to.y() - from.y();
  if (rise == 0) {
    if (std::abs(from.y()) > near) return {0, 0};
  } else {
    const double one = (-near - from.y()) / rise, other = (near - from.y()) / rise;
    low = std::max(low, std::min(one, other));
    high = std::min(high, std::max(one, other));
    if (low >= high) return {0, 0};
  }
  const double x = from.x() + low * (to.x() - from.x()), y = from.x() + high * (to.x() - from.x());
  return {std::clamp(std::min(x, y) / length, 0.0, 1.0),
          std::clamp(std::max(x, y) / length, 0.0, 1.0)};
}

// Two fences that share a stretch of ground count and stop the same blocks twice there. Fences that
// cross, or meet at a corner, share less than two metres.
void check_share_no_ground(InputLog& log, const Site& site, const Trn& trn, const FenceLine& one,
                           const FenceLine& other) {
  constexpr double near = 0.1, shared_m = 2;
  const std::vector<Vec3>&p = one.line.points, &q = other.line.points;
  double length = 0;
  Vec2 at = Vec2::Zero();
  for (std::size_t i = 0; i + 1 < p.size(); ++i)
    for (std::size_t j = 0; j + 1 < q.size(); ++j) {
      const Vec2 a = p[i].head<2>(), b = p[i + 1].head<2>();
      const auto [from, to] = part_near(a, b, q[j].head<2>(), q[j + 1].head<2>(), near);
      if (length == 0 && to > from) at = a + from * (b - a) + trn.origin.head<2>();
      length += (to - from) * (b - a).norm();
    }
  if (length <= shared_m || lies_along(p, q) || lies_along(q, p)) return;
  const std::string finding = "lies on fence " + other.line.name + " along " + text(length, 3) +
                              " m, from " + text(at.x(), 9) + ", " + text(at.y(), 9) + " on";
  if (one.fence != other.fence && !(one.fence->active && other.fence->active))
    return log.warn("fence " + one.line.name + " " + finding + ": both count the same blocks");
  throw InputError({site.file, one.fence->line_number, "fence." + one.line.name},
                   finding + ": two fences would stand there",
                   "end one of them where the other one begins");
}

}  // namespace

std::vector<RecordLine> fence_lines(InputLog& log, const Site& site, const Trn& trn,
                                    const FenceSettings& fence) {
  const Where where = where_of_fence(site.file, fence);
  if (!fence.line.empty() && !fence.file.empty())
    throw InputError(where, "has both line and file", "say where the fence is, once");
  return lines_of_fence(fence, trn, local_shapes(log, site, trn, place_of(fence)).shapes, where);
}

namespace {

void check_on_terrain(InputLog& log, const Site& site, const Trn& trn, const ObjectSettings& object,
                      const RecordObject& made) {
  std::size_t n = 0, n_off = 0;
  for (const ObjectPart& part : made.parts)
    for (const Vec2& p : part.points) {
      ++n;
      n_off += std::isnan(elevation_at(trn, p.x(), p.y()));
    }
  if (n_off == 0) return;
  if (n_off < n) {
    log.warn("object." + object.name + ": " + std::to_string(n_off) + " of its " +
             std::to_string(n) + " points lie outside of the known terrain, where nothing comes");
    return;
  }
  const Vec2 place = made.parts[0].points[0] + trn.origin.head<2>();
  throw InputError(where_of_object(site, object),
                   "lies outside of the known terrain, at (" + text(place.x(), 10) + ", " +
                       text(place.y(), 10) + "); " + extent_text(trn),
                   "make the terrain larger, or check the order (x east, y north) and the "
                   "coordinate system of its points");
}

}  // namespace

std::vector<RecordObject> site_objects(InputLog& log, const Site& site, const Trn& trn) {
  std::vector<RecordObject> objects;
  const std::vector<RoofPiece> roofs = gallery_roofs(log, site, trn);
  for (const ObjectSettings& object : site.objects) {
    const SitePlace place = place_of(site, object);
    RecordObject made{object.name, object.kind, {}, 0};
    if (place.kind == VectorKind::lines) made.radius = object.width_m / 2;
    if (place.kind == VectorKind::points) made.radius = object.radius_m;
    for (const std::vector<Vec3>& shape : local_shapes(log, site, trn, place).shapes) {
      ObjectPart part;
      part.is_area = place.kind == VectorKind::areas;
      for (const Vec3& p : shape) part.points.push_back(p.head<2>());
      if (part.is_area) {
        if (part.points.size() > 3 && part.points.front() == part.points.back())
          part.points.pop_back();
        check_polygon(part.points, where_of_object(site, object));
      }
      made.parts.push_back(std::move(part));
    }
    check_on_terrain(log, site, trn, object, made);
    std::vector<std::vector<Vec2>> over;
    for (const RoofPiece& roof : roofs)
      if (gap_to(made, roof.ring) <= 0) over.push_back(roof.ring);
    made.roofs = std::move(over);
    objects.push_back(std::move(made));
  }
  return objects;
}

std::vector<std::vector<std::vector<Vec2>>> polygons_of(const RecordObject& object) {
  std::vector<std::vector<std::vector<Vec2>>> out;
  for (const ObjectPart& part : object.parts) {
    if (part.is_area)
      out.push_back({part.points});
    else
      for (auto& polygon : buffer_of(part.points, object.radius)) out.push_back(std::move(polygon));
  }
  return out;
}

void check_fences_apart(InputLog& log, const Site& site, const Trn& trn,
                        const std::vector<FenceLine>& lines) {
  for (const std::string& doubt : check_fences_apart(site.file, trn, lines)) log.warn(doubt);
  for (std::size_t later = 0; later < lines.size(); ++later)
    for (std::size_t earlier = 0; earlier < later; ++earlier)
      check_share_no_ground(log, site, trn, lines[later], lines[earlier]);
}

}  // namespace talus
