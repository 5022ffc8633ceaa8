// Finds the mass of [source] above its failure surface and cuts it into blocks by [joints.*].
#include "setup/source_cut_gdal.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "base/grouped_text.hpp"
#include "base/memory.hpp"
#include "base/read_file.hpp"
#include "base/text.hpp"
#include "base/units.hpp"
#include "base/words.hpp"
#include "blocks/base_level.hpp"
#include "blocks/daylight_envelope.hpp"
#include "blocks/failure_raster.hpp"
#include "setup/ground_class_inputs_gdal.hpp"
#include "setup/site_shapes_gdal.hpp"
#include "setup/sliding_sets.hpp"
#include "setup/value_raster_gdal.hpp"
#include "setup/vector_inputs_gdal.hpp"
#include "site/joint_list.hpp"

namespace talus {
namespace {

// --- the source --------------------------------------------------------------------------------

Area read_area(InputLog& log, const BlocksWork& work) {
  const SourceSettings& source = work.site.source;
  if (source.polygon.empty() == source.polygon_file.empty())
    throw InputError({work.site.file},
                     source.polygon.empty() ? "[source] has neither polygon nor polygon_file"
                                            : "[source] has both polygon and polygon_file",
                     "say where the source is, once");
  return without_repeated_corners({shapes_in_plan(log, work.site, work.ground, place_of(source))});
}

// Elevations of the failure surface at the nodes of the terrain.
std::vector<double> read_failure_raster(InputLog& log, const BlocksWork& work) {
  const std::string path = resolved(work.site, work.site.source.raster);
  const bool is_thickness = work.site.source.failure_surface == "thickness";
  std::vector<double> z = read_at_nodes(log, work.site, work.ground, "source.raster",
                                        work.site.source.raster, !is_thickness);
  if (is_thickness) {
    lower_by_thickness(work.ground, work.area, {path}, z);
    return z;
  }
  check_is_surface(work.ground, work.area, z, {path});
  for (double& value : z) value -= work.ground.origin.z();
  return z;
}

SourceOptions daylighting_surface(InputLog& log, BlocksWork& work) {
  find_planes(log, work);
  check_sliding_set(work.site, work.planes);
  if (work.planes.best >= 0) {
    const FailurePlane& plane = work.planes.planes[work.planes.best];
    return source_on_plane(plane.attitude, plane.point);
  }
  const std::vector<std::string> wanted = names_joined(work.site.source.sliding_set);
  find_wedges(work);
  if (wanted.size() != 1)
    work.wedge = best_wedge(work.wedges, wanted.empty() ? "" : wanted[0] + " + " + wanted[1]);
  if (work.wedge < 0) throw no_plane_daylights(work.site, work.planes, work.wedges);
  return source_on_wedge(work.wedges[work.wedge]);
}

// C of the cells at hand, from the keys of [source] on the curvature of its base level.
double base_level_curvature(InputLog& log, const BlocksWork& work) {
  const SourceSettings& source = work.site.source;
  const bool has_curvature = work.site.sources.count("source.slbl_curvature_m") > 0;
  const bool has_sag = !std::isnan(source.slbl_sag_m), has_scenario = !source.slbl_scenario.empty();
  if (has_curvature + has_sag + has_scenario > 1)
    throw InputError(where_of(work.site, "source.failure_surface"),
                     "two of slbl_curvature_m, slbl_sag_m and slbl_scenario are given",
                     "each of them says how curved the surface is: give one");
  if (!has_sag && !has_scenario) return source.slbl_curvature_m;
  const SourceProfile profile = source_profile(work.ground, work.area);
  double sag = source.slbl_sag_m;
  if (has_scenario)
    sag = largest_sag(profile.height) * (source.slbl_scenario == "max"     ? 1
                                         : source.slbl_scenario == "inter" ? 0.5
                                                                           : 0);
  const double curvature = curvature_of_sag(sag, profile.length, work.ground.cell_size);
  log.info("SLBL: sags by " + text(sag, 3) + " m on " + text(profile.length, 4) +
           " m (slbl_curvature_m = " + text(curvature, 4) + " on these cells)");
  return curvature;
}

const PlannedSet& set_named(const BlocksWork& work, const std::string& name) {
  for (const PlannedSet& planned : work.sets)
    if (planned.set.name == name) return planned;
  throw InputError(
      where_of(work.site, "source.daylight"),
      "there is no joint set " + name + "; there are: " +
          list_of(work.sets, [](const PlannedSet& planned) { return planned.set.name; }),
      "name a set, two (\"one + other\"), or a plunge in degrees");
}

// The direction that source.daylight names.
DaylightDirection daylight_direction(const BlocksWork& work) {
  const std::string& said = work.site.source.daylight;
  DaylightDirection direction;
  double widest = 0;
  for (const PlannedSet& planned : work.sets) widest = std::max(widest, planned.set.mean_spacing);
  direction.width = widest;
  double plunge = 0;
  if (parse_double(said, plunge)) {
    if (!(plunge >= 0 && plunge < 90))
      throw InputError(where_of(work.site, "source.daylight"),
                       "daylight is " + said + ", expected a plunge of 0 to below 90 degrees");
    direction.plunge = plunge * degree;
    direction.azimuth = mean_slope(work.ground, work.area).dip_direction;
    return direction;
  }
  const std::vector<std::string> names = names_joined(said);
  const JointSet& first = set_named(work, names[0]).set;
  if (names.size() == 1) {
    direction.azimuth = first.dip_direction;
    direction.plunge = first.dip;
    return direction;
  }
  const JointSet& second = set_named(work, names[1]).set;
  const Wedge wedge =
      wedge_of({first.dip, first.dip_direction}, {second.dip, second.dip_direction}, 0, 0);
  if (wedge.line.isZero())
    throw InputError(where_of(work.site, "source.daylight"),
                     "the sets " + said + " are parallel: they have no line");
  direction.azimuth = wedge.trend;
  direction.plunge = wedge.plunge;
  return direction;
}

// Leaves out the part that the mass would lean on.
void lift_to_daylight(InputLog& log, BlocksWork& work) {
  if (work.site.source.daylight.empty()) return;
  const DaylightDirection direction = daylight_direction(work);
  work.hollow_volume = work.mass.volume;
  Trn bed = lifted_to_daylight(work.ground, work.area, work.mass.bed, direction);
  work.mass =
      mass_over(work.ground, work.area, std::move(work.mass), std::move(bed), where_of_area(work));
  log.info("daylight: " + grouped_text(work.mass.volume, 3) + " of " +
           grouped_text(work.hollow_volume, 3) + " m3 can leave along " +
           work.site.source.daylight + "; the rest leans on the foot and is left out");
}

void find_mass(InputLog& log, BlocksWork& work) {
  SourceOptions options = plan_source(work.site, work.ground.origin);
  if (work.site.source.failure_surface == "daylighting") {
    options = daylighting_surface(log, work);
  } else if (options.kind == FailureSurface::plane) {
    const auto& p = work.site.source.plane_point_m;
    options.plane_point = local_points(log, work.site, work.ground, {Vec3(p[0], p[1], p[2])},
                                       "source", "plane_point_m")[0];
    work.at_foot =
        plane_at_foot(work.ground, work.area, {options.plane_dip, options.plane_dip_direction},
                      options.plane_point);
  }
  if (options.kind == FailureSurface::raster) options.raster = read_failure_raster(log, work);
  if (options.kind == FailureSurface::slbl)
    options.slbl_curvature = work.slbl_curvature = base_level_curvature(log, work);
  work.mass = find_source(work.ground, work.area, options, where_of_area(work));
  lift_to_daylight(log, work);
  if (work.mass.n_above_ground > 0)
    log.info("the failure surface lies above the ground at " +
             std::to_string(work.mass.n_above_ground) + " nodes inside the source: no mass there");
  if (work.mass.n_extended > 0)
    log.info("the failure raster has no data at " + counted(work.mass.n_extended, "node") +
             " beside the source: the depth of the nearest node that has is taken there");
  if (work.site.source.failure_surface == "plane" && work.site.source.daylight.empty() &&
      work.at_foot.free_share < 0.5)
    log.warn("the failure plane comes out of the ground along " + percent(work.at_foot.free_share) +
             " of the foot of the source only; on the rest the mass leans on a step of up to " +
             text(work.at_foot.largest_step, 2) + " m (talus-source lists planes that come out)");
}

// How much of the polygon the mass should cover. It ends before its outline where its failure plane
// comes out of the ground; by much, the polygon is not that of the mass.
double least_share_covered(const BlocksWork& work) {
  const std::string& surface = work.site.source.failure_surface;
  const bool comes_out = surface == "daylighting" || !work.site.source.daylight.empty() ||
                         (surface == "plane" && work.at_foot.free_share >= 0.5);
  return comes_out ? 0.75 : 0.97;
}

// Warnings of values that are most likely mistakes.
void warn_of_mass(InputLog& log, const BlocksWork& work, const MassMeasure& measure) {
  const SourceMass& mass = work.mass;
  if (mass.area < least_share_covered(work) * mass.polygon_area)
    log.warn("the mass covers " + percent(mass.area / mass.polygon_area) +
             " of the source polygon: elsewhere the failure surface does not lie below the "
             "ground; " +
             (work.site.source.failure_surface == "daylighting"
                  ? "is the polygon what is meant? Its outline may follow the mass"
                  : "check depth, plane or raster"));
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (size_t v = 0; v < measure.vertices.size(); v += 2)  // on the ground, below it, and so on
    low = std::min(low, measure.vertices[v].z()), high = std::max(high, measure.vertices[v].z());
  const double half_size = std::sqrt(mass.polygon_area) / 2;
  const std::string depth =
      "the mass is " + text(mass.mean_depth, 3) + " m deep on average, more than ";
  if (mass.mean_depth > high - low)
    log.warn(depth + "the relief of the ground over it, " + text(high - low, 3) +
             " m; check the failure surface and its units");
  else if (mass.mean_depth > half_size)
    log.warn(depth + "half the size of the source, " + text(half_size, 3) +
             " m; check the failure surface and its units");
}

// --- joints ------------------------------------------------------------------------------------

void check_expected(const MassMeasure& measure, BlocksWork& work) {
  std::vector<JointSet> sets;
  for (const PlannedSet& planned : work.sets) sets.push_back(planned.set);
  work.expected = expected_cells(sets, measure);
  const auto most = static_cast<double>(work.site.source.max_blocks);
  if (work.expected > most)
    throw InputError(where_of(work.site, "source.max_blocks"),
                     "the joints would cut " + text(work.mass.volume, 4) + " m3 into about " +
                         text(std::round(work.expected)) + " blocks, expected at most " +
                         text(most),
                     "widen the spacings, or set source.max_blocks to what your machine can take");
  constexpr double bytes_per_block = 6700;  // docs/tools/talus-blocks.md
  require_memory(bytes_per_block * work.expected, where_of(work.site, "source.max_blocks"),
                 text(std::round(work.expected)) + " blocks", "widen the spacings");
}

// Discs are drawn one by one, and each piece of rock asks those of the joints that cross it.
void check_discs(const BlocksWork& work, double radius) {
  constexpr double most = 1e7;
  double n = 0;
  for (const PlannedSet& planned : work.sets) n += expected_discs(planned.set, radius);
  if (n <= most) return;
  const auto most_of_all = std::max_element(
      work.sets.begin(), work.sets.end(), [radius](const PlannedSet& a, const PlannedSet& b) {
        return expected_discs(a.set, radius) < expected_discs(b.set, radius);
      });
  const JointSettings& section = work.site.joints[most_of_all->section];
  throw InputError(
      {work.site.file, section.line, "joints." + section.name},
      "the joints would be about " + text(n, 3) + " discs, expected at most " + text(most),
      "raise disc_diameter_m, or set persistence = 1: discs smaller than a joint "
      "cell part nothing");
}

// Of the ball around the mass, which the joints must cross.
void draw_all_joints(const MassMeasure& measure, double beside, BlocksWork& work) {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const Vec3& p : measure.vertices) low = low.cwiseMin(p), high = high.cwiseMax(p);
  const Vec3 centre = (low + high) / 2;
  const double radius = (high - low).norm() / 2;
  check_discs(work, radius);
  for (size_t s = 0; s < work.sets.size(); ++s) {
    const JointSet& set = work.sets[s].set;
    const double away = beside * set.mean_spacing;
    for (Joint& joint :
         draw_joints(set, static_cast<int>(s), centre + away * pole(set.dip, set.dip_direction),
                     radius + away, static_cast<std::uint64_t>(work.site.source.seed)))
      work.joints.push_back(std::move(joint));
  }
}

std::string why_in_one_piece(const BlocksWork& work) {
  if (work.sets.empty()) return "there are no [joints.*]";
  if (work.joints.empty()) return "no joint crosses it: the spacings are wider than the mass";
  const bool all_partial = std::none_of(work.joints.begin(), work.joints.end(),
                                        [](const Joint& j) { return j.is_through; });
  if (all_partial)
    return "no joint is persistent enough to part it; see persistence and disc_diameter_m";
  return "the joints that cross it leave no piece large enough to stand alone";
}

// Azimuths that are not taken as written.
void say_turn(InputLog& log, const JointNorth& north) {
  if (north.declination_deg == 0 && north.convergence_deg == 0) return;
  log.info("[joints]: azimuths turned by " + text(north.turn_deg(), 6) +
           " degrees to the map's north (declination " + text(north.declination_deg, 6) +
           ", convergence " + text(north.convergence_deg, 6) + ")");
}

// Each corner parts the mass along two walls, which is exact and not cheap.
void check_number_of_corners(const Area& area, const Where& where) {
  constexpr std::size_t most = 10000;
  std::size_t n = 0;
  for (const auto& ring : area.rings) n += ring.size();
  if (n > most)
    throw InputError(where,
                     "the source area has " + std::to_string(n) + " corners, expected at most " +
                         std::to_string(most),
                     "simplify the outline to what the joints can show");
}

}  // namespace

Where where_of_area(const BlocksWork& work) {
  return work.site.source.polygon.empty()
             ? Where{resolved(work.site, work.site.source.polygon_file)}
             : where_of(work.site, "source.polygon");
}

Area read_source_area(InputLog& log, const BlocksWork& work) {
  Area area = read_area(log, work);
  check_number_of_corners(area, where_of_area(work));
  check_area(area, work.ground.origin, where_of_area(work));
  return area;
}

void plan_sets(InputLog& log, BlocksWork& work) {
  std::vector<OrientationList> lists;
  for (const JointSettings& section : work.site.joints) {
    lists.emplace_back();
    if (section.measured_file.empty()) continue;
    const std::string path = resolved(work.site, section.measured_file);
    log.read_also("joints." + section.name, path);
    OrientationList& list = lists.back();
    list = read_orientations(read_file(path), path);
    log.info(path + ": " + counted(static_cast<std::int64_t>(list.poles.size()), "orientation") +
             " from " + list.taken_from +
             (list.is_computed ? "; computed from points, so no compass turns them" : ""));
    if (may_be_radians(list))
      log.doubts({doubt_on({path},
                           "all dips are below 1.58 and all directions below 6.29: are the angles "
                           "in radians? Expected degrees",
                           "57.3 times the radians are degrees")});
  }
  say_turn(log, work.site.joint_north);
  work.sets = plan_joint_sets(work.site, lists);
}

void find_planes(InputLog& log, BlocksWork& work) {
  std::vector<JointSet> sets;
  for (const PlannedSet& planned : work.sets) sets.push_back(planned.set);
  const double friction = friction_below(work.site, work.ground, work.area,
                                         ground_classes(log, work.site, work.ground));
  work.planes = find_failure_planes(work.ground, work.area, sets, friction,
                                    work.site.source.sliding_set, where_of_area(work));
}

void find_wedges(BlocksWork& work) {
  std::vector<JointSet> sets;
  for (const PlannedSet& planned : work.sets) sets.push_back(planned.set);
  work.wedges =
      find_failure_wedges(work.ground, work.area, sets, work.planes.friction, where_of_area(work));
}

void cut_by_joints(InputLog& log, bool exact, const MassMeasure& measure, double beside,
                   BlocksWork& work) {
  check_expected(measure, work);
  draw_all_joints(measure, beside, work);
  work.limits = plan_limits(work.site, work.sets, work.mass.volume, work.expected);
  work.limits.exact = exact;
  for (const PlannedSet& planned : work.sets)
    work.blocks.joint_set_names.push_back(planned.set.name);
  const ProgressFunction progress = log.progress();
  const CellComplex complex = cut_mass(work.ground, work.mass.bed, work.area, work.joints,
                                       [&](double share) { progress(0.5 * share); });
  work.cut = assemble_blocks(complex, work.joints, work.mass.bed, work.limits, work.blocks,
                             [&](double share) { progress(0.5 + 0.5 * share); });
  if (complex.n_uncut > 0)
    log.warn(std::to_string(complex.n_uncut) + " cells could not be cut and stayed in one piece");
}

void cut_source(InputLog& log, bool exact, BlocksWork& work) {
  plan_sets(log, work);
  find_mass(log, work);
  const MassMeasure measure = measure_mass(work.ground, work.mass.bed, work.area);
  warn_of_mass(log, work, measure);
  cut_by_joints(log, exact, measure, 0, work);
  if (work.cut.n_dropped > 0)
    log.warn("left out, since they have no neighbour: " + counted(work.cut.n_dropped, "sliver") +
             ", " + text(work.cut.dropped_volume, 3) + " m3 in all");
  if (work.cut.n_below_limits > 0)
    log.warn("below the limits for slivers after they were made convex: " +
             counted(work.cut.n_below_limits, "block"));
  if (work.cut.n_short_edged > 0)
    log.warn(counted(work.cut.n_short_edged, "block") +
             " with edges of convex parts that are shorter than min_block_edge_m, between the "
             "parts or outside: without them too much of the volume would be lost");
  if (n_blocks(work.blocks) == 1)
    log.warn("the mass stays in one piece: " + why_in_one_piece(work));
  if (n_blocks(work.blocks) == 0)
    throw InputError({work.site.file}, "no block is left",
                     "min_block_volume_m3 or min_block_thickness_m leave out all of the mass");
}

double volume_error(const BlocksWork& work) {
  return std::abs(work.cut.cut_volume - work.mass.volume) / work.mass.volume;
}

}  // namespace talus
