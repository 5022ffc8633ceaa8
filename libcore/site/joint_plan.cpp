// Joint sets, source options and limits of cutting, from the sections of the site file.
#include "site/joint_plan.hpp"

#include <algorithm>
#include <cmath>

#include "base/text.hpp"
#include "base/units.hpp"

namespace talus {
namespace {

// Clockwise seen from above. Without a turn bit by bit the same.
Vec3 turned(const Vec3& axis, double turn_deg) {
  if (turn_deg == 0) return axis;
  const double c = std::cos(turn_deg * degree), s = std::sin(turn_deg * degree);
  return {c * axis.x() + s * axis.y(), c * axis.y() - s * axis.x(), axis.z()};
}

double turned_azimuth(double azimuth_deg, double turn_deg) {
  if (turn_deg == 0) return azimuth_deg;
  const double rest = std::fmod(azimuth_deg + turn_deg, 360);
  return rest < 0 ? rest + 360 : rest;
}

[[noreturn]] void missing(const Site& site, const JointSettings& section, const std::string& key,
                          const std::string& hint) {
  throw InputError({site.file, section.line},
                   key + " of [joints." + section.name + "] is not given", hint);
}

void plan_spacing(const Site& site, const JointSettings& section, JointSet& set) {
  const std::string path = "joints." + section.name;
  if (section.spacing == "uniform") {
    set.spacing = Spacing::uniform;
    if (std::isnan(section.spacing_min_m) || std::isnan(section.spacing_max_m))
      missing(site, section, "spacing_min_m or spacing_max_m",
              "spacing = \"uniform\" has ends: add spacing_min_m and spacing_max_m");
    if (section.spacing_min_m > section.spacing_max_m)
      throw InputError(where_of(site, path + ".spacing_min_m"),
                       "spacing_min_m is " + text(section.spacing_min_m) +
                           ", expected at most spacing_max_m, " + text(section.spacing_max_m));
    set.spacing_a = section.spacing_min_m;
    set.spacing_b = section.spacing_max_m;
    set.mean_spacing = (section.spacing_min_m + section.spacing_max_m) / 2;
    return;
  }
  if (std::isnan(section.spacing_m))
    missing(site, section, "spacing_m", "the mean distance of joints along their normal [m]");
  set.mean_spacing = section.spacing_m;
  if (section.spacing == "exponential") set.spacing = Spacing::exponential;
  if (section.spacing != "lognormal") return;
  set.spacing = Spacing::lognormal;
  if (std::isnan(section.spacing_std_m))
    missing(site, section, "spacing_std_m",
            "spacing = \"lognormal\" has a scatter: add spacing_std_m");
  // Beyond it most joints lie closer than any rock is jointed, and a few gaps hold all of the mean.
  constexpr double most_means = 10;
  if (section.spacing_std_m > most_means * section.spacing_m)
    throw InputError(where_of(site, path + ".spacing_std_m"),
                     "spacing_std_m is " + text(section.spacing_std_m) + ", expected at most " +
                         text(most_means) + " times spacing_m, " +
                         text(most_means * section.spacing_m),
                     "measured spacings scatter by one to three times their mean");
  set.spacing_a = section.spacing_std_m;
}

JointSet plan_set(const Site& site, const JointSettings& section) {
  JointSet set;
  set.name = section.name;
  plan_spacing(site, section, set);
  set.fisher_k = section.fisher_k;
  set.persistence = section.persistence;
  set.disc_diameter =
      std::isnan(section.disc_diameter_m) ? 10 * set.mean_spacing : section.disc_diameter_m;
  set.offset = section.offset_m;
  return set;
}

// The sets of a section with measured orientations.
void plan_measured(const Site& site, int index, const std::vector<Vec3>& poles,
                   std::vector<PlannedSet>& sets) {
  const JointSettings& section = site.joints[index];
  std::vector<PoleGroup> groups;
  try {
    groups = group_poles(poles, static_cast<int>(section.n_sets));
  } catch (const InputError& error) {
    throw InputError({site.file, section.line}, error.what(), error.hint());
  }
  for (size_t g = 0; g < groups.size(); ++g) {
    PlannedSet planned{plan_set(site, section), index, {}};
    if (groups.size() > 1) planned.set.name += "_" + std::to_string(g + 1);
    const Attitude mean = attitude(groups[g].mean);
    planned.set.dip = mean.dip;
    planned.set.dip_direction = mean.dip_direction;
    const bool k_given = site.sources.count("joints." + section.name + ".fisher_k") > 0;
    if (!k_given) planned.set.fisher_k = std::isfinite(groups[g].fisher_k) ? groups[g].fisher_k : 0;
    for (const int i : groups[g].members) planned.measured_poles.push_back(poles[i]);
    sets.push_back(std::move(planned));
  }
}

// Names of sets tell their joints and faces apart; those of a measured section are made up.
void check_names(const Site& site, const std::vector<PlannedSet>& sets) {
  for (size_t i = 0; i < sets.size(); ++i)
    for (size_t j = 0; j < i; ++j)
      if (sets[i].set.name == sets[j].set.name)
        throw InputError({site.file, site.joints[sets[i].section].line},
                         "two joint sets are called " + sets[i].set.name +
                             ": one is made by [joints." + site.joints[sets[j].section].name + "]",
                         "rename a section; n_sets above 1 makes NAME_1, NAME_2 and so on");
}

}  // namespace

std::vector<PlannedSet> plan_joint_sets(const Site& site,
                                        const std::vector<OrientationList>& lists) {
  const double turn_deg = site.joint_north.turn_deg();
  std::vector<PlannedSet> sets;
  for (size_t i = 0; i < site.joints.size(); ++i) {
    const JointSettings& section = site.joints[i];
    const std::string path = "joints." + section.name;
    std::vector<Vec3> poles = i < lists.size() ? lists[i].poles : std::vector<Vec3>{};
    if (i < lists.size() && !lists[i].is_computed)
      for (Vec3& axis : poles) axis = turned(axis, turn_deg);
    for (const Vec3& pair : section.measured)
      poles.push_back(
          turned(checked_pole(pair.x(), pair.y(), where_of(site, path + ".measured")), turn_deg));
    const bool has_dip = !std::isnan(section.dip_deg) || !std::isnan(section.dip_direction_deg);
    if (!poles.empty()) {
      if (has_dip)
        throw InputError({site.file, section.line},
                         "[joints." + section.name + "] has measured orientations and a dip",
                         "give one of them");
      plan_measured(site, static_cast<int>(i), poles, sets);
      continue;
    }
    if (std::isnan(section.dip_deg)) missing(site, section, "dip_deg", "0 to 90 degrees");
    if (std::isnan(section.dip_direction_deg))
      missing(site, section, "dip_direction_deg", "azimuth of the steepest way down, 0 to 360");
    PlannedSet planned{plan_set(site, section), static_cast<int>(i), {}};
    planned.set.dip = section.dip_deg * degree;
    planned.set.dip_direction = turned_azimuth(section.dip_direction_deg, turn_deg) * degree;
    sets.push_back(std::move(planned));
  }
  constexpr std::size_t most = 30;
  if (sets.size() > most)
    throw InputError({site.file, site.joints.back().line},
                     "there are " + std::to_string(sets.size()) + " joint sets, expected at most " +
                         std::to_string(most),
                     "put orientations that belong together into one [joints.*], with fisher_k "
                     "for their scatter");
  check_names(site, sets);
  return sets;
}

SourceOptions plan_source(const Site& site, const Vec3& origin) {
  const SourceSettings& source = site.source;
  SourceOptions options;
  // All that lack at once: each would be a step more for the user.
  const auto need = [&](const std::vector<std::pair<bool, const char*>>& keys) {
    std::string missing;
    for (const auto& [is_given, key] : keys)
      if (!is_given) missing += (missing.empty() ? "" : ", ") + std::string(key);
    if (!missing.empty())
      throw InputError(where_of(site, "source.failure_surface"),
                       "failure_surface = \"" + source.failure_surface + "\" needs " + missing,
                       "add " + missing + (missing[0] == '[' ? "" : " to [source]"));
  };
  if (source.failure_surface == "plane") {
    options.kind = FailureSurface::plane;
    need({{!std::isnan(source.plane_dip_deg), "plane_dip_deg"},
          {!std::isnan(source.plane_dip_direction_deg), "plane_dip_direction_deg"},
          {source.plane_point_m.size() == 3, "plane_point_m"}});
    options.plane_dip = source.plane_dip_deg * degree;
    options.plane_dip_direction = source.plane_dip_direction_deg * degree;
    options.plane_point =
        Vec3(source.plane_point_m[0], source.plane_point_m[1], source.plane_point_m[2]) - origin;
  } else if (source.failure_surface == "daylighting") {
    options.kind = FailureSurface::plane;
    need({{!site.joints.empty(), "[joints.*]"}});
  } else if (source.failure_surface == "raster" || source.failure_surface == "thickness") {
    options.kind = FailureSurface::raster;
    need({{!source.raster.empty(), "raster"}});
  } else if (source.failure_surface == "slbl") {
    options.kind = FailureSurface::slbl;
    options.slbl_curvature = source.slbl_curvature_m;  // or by its sag, once the slope is known
    options.slbl_max_depth = std::isnan(source.slbl_max_depth_m) ? 0 : source.slbl_max_depth_m;
  } else {
    options.kind = source.failure_surface == "vertical_depth" ? FailureSurface::vertical_depth
                                                              : FailureSurface::normal_depth;
    need({{!std::isnan(source.depth_m), "depth_m"}});
    options.depth = source.depth_m;
  }
  return options;
}

AssembleOptions plan_limits(const Site& site, const std::vector<PlannedSet>& sets,
                            double mass_volume, double expected_cells) {
  AssembleOptions options;
  // Where the spacing of joints exceeds the size of the mass, the mass itself is the measure.
  double smallest = std::cbrt(mass_volume);
  for (const PlannedSet& planned : sets) smallest = std::min(smallest, planned.set.mean_spacing);
  const SourceSettings& source = site.source;
  options.min_volume = !std::isnan(source.min_block_volume_m3)
                           ? source.min_block_volume_m3
                           : 0.01 * mass_volume / expected_cells;
  options.min_thickness =
      !std::isnan(source.min_block_thickness_m) ? source.min_block_thickness_m : 0.05 * smallest;
  if (!std::isnan(source.min_block_edge_m)) options.min_edge = source.min_block_edge_m;
  options.max_aspect = source.max_block_aspect;
  options.max_convex_loss = source.max_convex_loss;
  options.material = material_index(site, source.material);
  return options;
}

int material_index(const Site& site, const std::string& name) {
  for (size_t m = 0; m < site.materials.size(); ++m)
    if (site.materials[m].name == name) return static_cast<int>(m);
  return 0;
}

}  // namespace talus
