// Reads [water]: the height of water in the joints of blocks.
#include "setup/water_inputs_gdal.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <string>

#include "base/text.hpp"
#include "base/words.hpp"
#include "setup/site_shapes_gdal.hpp"
#include "setup/value_raster_gdal.hpp"

namespace talus {
namespace {

using std::size_t;

constexpr double water_density = 1000;  // [kg/m3]
constexpr const char* source_side = "source_side";

void check_given(const Site& site) {
  const WaterSettings& water = site.water;
  const Where where = where_of(site, "water");
  const int n_surfaces =
      !water.surface_m.empty() + !water.raster.empty() + !std::isnan(water.depth_m);
  if (n_surfaces > 1)
    throw InputError(
        where, "[water] gives the piezometric surface " + std::to_string(n_surfaces) + " times",
        "keep one of surface_m, raster and depth_m");
  if (n_surfaces == 0 && water.cracks.empty())
    throw InputError(where, "[water] does not say how high water is",
                     "give surface_m, raster or depth_m, or cracks and crack_fill_m");
  if (water.cracks.empty() != std::isnan(water.crack_fill_m))
    throw InputError(where,
                     water.cracks.empty() ? "crack_fill_m fills no joint set: cracks is not given"
                                          : "crack_fill_m of the cracks is not given",
                     "give both, or neither");
  if (moves_alone(site))
    throw InputError(where, "[water] is in the joints between blocks, and each block moves alone",
                     "leave [water] out, or move the blocks together: solver.blocks");
}

bool is_part_of(const std::string& set, const std::string& name) {
  return set == name || (set.starts_with(name + "_") &&
                         std::all_of(set.begin() + static_cast<std::ptrdiff_t>(name.size()) + 1,
                                     set.end(), [](char c) { return c >= '0' && c <= '9'; }));
}

// Sets `fill` of all sets that a key names.
void fill_sets(const Site& site, const std::vector<std::string>& sets, const char* key,
               const std::vector<std::string>& names, JointFill fill, JointWater& made) {
  for (const std::string& name : names) {
    bool is_known = name == source_side;
    if (is_known) made.of_side = fill;
    for (size_t k = 0; k < sets.size(); ++k)
      if (is_part_of(sets[k], name)) {
        if (made.of_set[k] != JointFill::surface && made.of_set[k] != fill)
          throw InputError(where_of(site, std::string("water.") + key),
                           "joint set " + name + " is among the cracks and drained",
                           "name it in one of the two");
        made.of_set[k] = fill;
        is_known = true;
      }
    if (is_known) continue;
    std::vector<std::string> known = sets;
    known.emplace_back(source_side);
    throw InputError(
        where_of(site, std::string("water.") + key),
        std::string(key) + " names " + name + ", which is not a joint set of the blocks",
        "they have " + list_of(known));
  }
}

// Elevations at the nodes of the ground of a level, or of the plane of three points, local axes.
std::vector<double> plane_at_nodes(const Site& site, const std::vector<Vec3>& points,
                                   const Trn& ground) {
  const Where where = where_of(site, "water.surface_m");
  if (points.size() == 2)
    throw InputError(where, "surface_m is a list of 2, expected one point, or three",
                     "one point is a level; three are a plane");
  for (const Vec3& point : points)
    if (std::isnan(point.z()))
      throw InputError(where, "a point of surface_m has no z", "give map x, y and elevation");
  Vec3 normal = Vec3::UnitZ();
  if (points.size() == 3) {
    normal = (points[1] - points[0]).cross(points[2] - points[0]);
    const double size = (points[1] - points[0]).norm() * (points[2] - points[0]).norm();
    if (!(std::abs(normal.z()) > 1e-6 * size))
      throw InputError(where, "the three points of surface_m are in a line, or upright",
                       "give points of a plane that is not upright, far apart in plan");
  }
  std::vector<double> z;
  for (int row = 0; row < ground.n_rows; ++row)
    for (int col = 0; col < ground.n_cols; ++col) {
      const Vec3 node = node_point(ground, row, col);
      const Vec2 from = node.head<2>() - points[0].head<2>();
      z.push_back(points[0].z() - normal.head<2>().dot(from) / normal.z());
    }
  return z;
}

}  // namespace

std::optional<JointWater> joint_water(InputLog& log, const Site& site, const Trn& ground,
                                      const std::vector<std::string>& sets) {
  const WaterSettings& water = site.water;
  const bool is_in_file =
      std::find(site.sections.begin(), site.sections.end(), "water") != site.sections.end();
  if (!is_in_file && water.surface_m.empty() && water.raster.empty() && std::isnan(water.depth_m) &&
      water.cracks.empty())
    return std::nullopt;
  check_given(site);
  JointWater made;
  made.unit_weight = water_density * site.solver.gravity_m_s2;
  made.of_set.assign(sets.size(), JointFill::surface);
  made.crack_fill = std::isnan(water.crack_fill_m) ? 0 : water.crack_fill_m;
  fill_sets(site, sets, "cracks", water.cracks, JointFill::crack, made);
  fill_sets(site, sets, "drained", water.drained, JointFill::drained, made);
  if (!water.surface_m.empty())
    made.surface = plane_at_nodes(
        site, local_points(log, site, ground, water.surface_m, "water", "surface_m"), ground);
  if (!water.raster.empty()) {
    made.surface = read_at_nodes(log, site, ground, "water.raster", water.raster, true);
    for (double& z : made.surface) z -= ground.origin.z();
  }
  made.depth = water.depth_m;
  return made;
}

void check_water_cover(InputLog& log, const Site& site, const Trn& ground, const JointWater& water,
                       const BlockSet& blocks) {
  if (site.water.raster.empty()) return;
  Trn known = ground;
  known.elevation = water.surface;
  const auto n_unknown = std::ranges::count_if(blocks.vertices, [&](const Vec3& at) {
    return !contains(known, at.x(), at.y()) || std::isnan(elevation_at(known, at.x(), at.y()));
  });
  const auto n = std::ssize(blocks.vertices);
  if (n_unknown == 0) return;
  const Where where{resolved(site, site.water.raster), 0, "water.raster"};
  if (n_unknown == n)
    throw InputError(where, "is unknown over the whole mass",
                     "give a raster that covers the source, or leave [water] out");
  log.doubts({doubt_on(where,
                       "is unknown at " +
                           percent(static_cast<double>(n_unknown) / static_cast<double>(n)) +
                           " of the corners of the mass: no water there",
                       "give a raster that covers the source, unless it is dry there")});
}

}  // namespace talus
