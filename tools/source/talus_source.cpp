// tools/source/talus_source.cpp
// Planes and wedges of joint sets that a mass may leave on, before anything is cut. Page:
// docs/tools/talus-source.md
#include <cmath>
#include <optional>
#include <vector>

#include "base/grouped_text.hpp"
#include "base/text.hpp"
#include "base/units.hpp"
#include "base/words.hpp"
#include "blocks/limit_equilibrium.hpp"
#include "import/dem_gdal.hpp"
#include "setup/site_crs_gdal.hpp"
#include "setup/site_shapes_gdal.hpp"
#include "setup/sliding_sets.hpp"
#include "setup/source_cut_gdal.hpp"
#include "setup/water_inputs_gdal.hpp"
#include "tools/frame/failure_outlines.hpp"
#include "tools/frame/failure_plane_choice.hpp"
#include "tools/frame/site_options.hpp"
#include "tools/frame/tool.hpp"

namespace {

using namespace talus;  // NOLINT: a program of its own

const std::vector<double> shares_of_foot = {1, 0.95, 0.9, 0.75, 0.5};

struct Options {
  std::string trn, report, layers, assumed;
  int n_blocks = 50;
};

void declare(Tool& tool, Options& o) {
  tool.input("--trn", o.trn, "terrain before the slide (talus-trn)").required();
  tool.output("-o,--out", o.report, "slope, sets and planes (JSON)");
  tool.output("--layers", o.layers,
              "areas of the masses that could leave, by set and by share of the foot (GeoPackage)");
  tool.output("--assume-joints", o.assumed,
              "[source] and [joints.*] for a slope whose joints nobody has measured (TOML)");
  tool.option("--blocks", o.n_blocks, "blocks that the assumed sets should make")
      .between(1, 100000);
  tool.footer("Example:\n  talus-source site.toml --trn trn.tif -o source.json");
}

std::string section_of(const JointSet& set) {
  return "\n[joints." + set.name + "]\ndip_deg = " + text(std::round(set.dip / degree)) +
         "\ndip_direction_deg = " + text(std::round(set.dip_direction / degree)) +
         "\nspacing_m = " + text(set.mean_spacing) + "\n";
}

// The sections of the site file, and whether a plane of theirs daylights.
struct Assumed {
  bool daylights = false;
  std::string toml;
};

Assumed assume_joints(const BlocksWork& work, double friction, int n_blocks) {
  const std::vector<JointSet> sets =
      assumed_joint_sets(work.ground, work.area, friction, n_blocks, {work.site.file});
  const std::string slope =
      text(std::round(mean_slope(work.ground, work.area).dip / degree)) + " degrees";
  if (sets.empty())
    return {false,
            "# NO PLANE DAYLIGHTS here: the slope dips " + slope + ", friction is " +
                text(std::round(friction / degree)) +
                ", or the foot of the\n# polygon is too uneven. Below is a hollow with a step at "
                "its foot: most of what lies in\n# it will stay. Change the polygon or the "
                "friction, or give the surface by hand.\nfailure_surface = \"normal_depth\"\n"
                "depth_m = 5\n"};
  std::string toml =
      "# A plane of the joint set that dips out of the slope, laid so that it comes out of the\n"
      "# ground along the foot of the polygon. It is found anew when sets, polygon or friction "
      "change.\nfailure_surface = \"daylighting\"\n\n"
      "# Joint sets cut the mass into blocks: dip, dip direction and spacing from the field. "
      "These\n# are ASSUMED from the slope (it dips " +
      slope + "): the first between friction and slope.\n";
  for (const JointSet& set : sets) toml += section_of(set);
  return {true, toml};
}

// The planes of each set that offers one, by the share of the foot that they are to come out along.
Json shares_json(const BlocksWork& work) {
  Json rows = Json::array();
  for (const FailurePlane& plane : work.planes.planes) {
    if (!plane.why_not.empty()) continue;
    for (const PlaneAtShare& row : planes_by_share(work.ground, work.area, plane.attitude,
                                                   shares_of_foot, where_of_area(work))) {
      const Vec3 point = row.point + work.ground.origin;
      rows.push_back({{"set", plane.set},
                      {"free_share_of_foot", row.share},
                      {"volume_m3", row.volume},
                      {"mean_depth_m", row.mean_depth},
                      {"point_m", {point.x(), point.y(), point.z()}}});
    }
  }
  return rows;
}

// The outline of each plane at each share of the foot.
std::vector<OutlinedSurface> outlines_by_share(const BlocksWork& work) {
  std::vector<OutlinedSurface> surfaces;
  for (const FailurePlane& plane : work.planes.planes) {
    if (!plane.why_not.empty()) continue;
    for (const PlaneAtShare& row : planes_by_share(work.ground, work.area, plane.attitude,
                                                   shares_of_foot, where_of_area(work)))
      if (row.volume > 0) surfaces.push_back(outlined_plane(work, plane, row.point, row.share));
  }
  return surfaces;
}

// "bedding by the share of the foot: 100 % 41,000 m3, 95 % ..."
std::string shares_text(const Json& rows) {
  std::string lines, set;
  for (const Json& row : rows) {
    const bool is_new = row["set"] != set;
    set = row["set"].get<std::string>();
    lines += (is_new ? "\n" + set + " by the share of the foot that is free: " : ", ") +
             percent(row["free_share_of_foot"].get<double>()) + " " +
             grouped_text(row["volume_m3"].get<double>(), 3) + " m3";
  }
  return lines;
}

/// A mass that slides as one, whether friction holds it or not.
struct Sliding {
  std::string name;    ///< of the set, or of the two of a wedge
  double azimuth = 0;  ///< of the motion [rad]
  SourceOptions bed;
  double volume = 0;
  std::vector<Attitude> planes;
};

std::vector<Sliding> sliding_masses(Tool& tool, const BlocksWork& work) {
  std::vector<Sliding> masses;
  const SourceSettings& source = work.site.source;
  if (source.failure_surface == "plane") {
    const std::vector<double>& p = source.plane_point_m;
    SourceOptions given = plan_source(work.site, work.ground.origin);
    given.plane_point = local_points(tool, work.site, work.ground, {Vec3(p[0], p[1], p[2])},
                                     "source", "plane_point_m")[0];
    masses.push_back({"plane of [source]",
                      given.plane_dip_direction,
                      given,
                      find_source(work.ground, work.area, given, where_of_area(work)).volume,
                      {{given.plane_dip, given.plane_dip_direction}}});
  }
  for (const FailurePlane& plane : work.planes.planes)
    if (plane.volume > 0)
      masses.push_back({plane.set,
                        plane.attitude.dip_direction,
                        source_on_plane(plane.attitude, plane.point),
                        plane.volume,
                        {plane.attitude}});
  for (const FailureWedge& wedge : work.wedges)
    if (wedge.volume > 0)
      masses.push_back({pair_name(wedge),
                        wedge.line.trend,
                        source_on_wedge(wedge),
                        wedge.volume,
                        {wedge.first_plane, wedge.second_plane}});
  return masses;
}

// Factors of safety by formula, of each plane and wedge that comes out of the slope.
Json limit_equilibrium_json(Tool& tool, const BlocksWork& work) {
  std::vector<std::string> sets;
  for (const PlannedSet& planned : work.sets) sets.push_back(planned.set.name);
  const std::optional<JointWater> water = joint_water(tool, work.site, work.ground, sets);
  const MaterialSettings& rock =
      work.site.materials[material_index(work.site, work.site.source.material)];
  Json rows = Json::array();
  for (const Sliding& one : sliding_masses(tool, work)) {
    SlidingMass mass;
    mass.weight = rock.density_kg_m3 * work.site.solver.gravity_m_s2 * one.volume;
    for (const Attitude& plane : one.planes)
      mass.planes.push_back({pole(plane.dip, plane.dip_direction), std::tan(work.planes.friction)});
    rows.push_back({{"sets", one.name}, {"dry", number_or_null(sliding_factor(mass))}});
    if (water) {
      const SourceMass source = find_source(work.ground, work.area, one.bed, where_of_area(work));
      mass.water = water_on_mass(*water, work.ground, source.bed, work.area);
      rows.back()["wet"] = number_or_null(sliding_factor(mass));
    }
    rows.back()["critical_seismic_coefficient"] = critical_seismic(mass, one.azimuth);
  }
  return rows;
}

// "bedding by limit equilibrium: factor of safety 1.21 dry, 0.98 with the water of [water]"
std::string limit_equilibrium_text(const Json& rows) {
  std::string lines;
  for (const Json& row : rows) {
    const auto factor = [&](const char* key) {
      return row[key].is_null() ? "none" : text(row[key].get<double>(), 3);
    };
    lines += "\n" + row["sets"].get<std::string>() + " by limit equilibrium: factor of safety " +
             factor("dry") + " dry";
    if (row.contains("wet")) lines += ", " + factor("wet") + " with the water of [water]";
    const double seismic = row["critical_seismic_coefficient"].get<double>();
    if (seismic > 0) lines += "; holds up to a seismic coefficient of " + text(seismic, 2);
  }
  return lines;
}

std::string wanted_pair(const std::string& sliding_set) {
  const std::vector<std::string> names = names_joined(sliding_set);
  return names.size() == 2 ? names[0] + " + " + names[1] : "";
}

}  // namespace

int main(int argc, char** argv) {
  Options o;
  Tool tool("talus-source",
            "Says on which planes of its joint sets the mass of a source could leave, and why "
            "not on others.");
  SiteOptions site(tool);
  site.take_inputs();
  declare(tool, o);
  return tool.run(argc, argv, [&] {
    BlocksWork work;
    work.site = site.load();
    check_site_crs(work.site);
    work.ground = read_trn(o.trn);
    if (!work.has_source())
      throw InputError({work.site.file}, "there is no [source] with a polygon",
                       "say where the mass is: polygon or polygon_file");
    work.area = read_source_area(tool, work);
    plan_sets(tool, work);
    find_planes(tool, work);
    check_sliding_set(work.site, work.planes);
    find_wedges(work);
    if (work.planes.best < 0 && names_joined(work.site.source.sliding_set).size() != 1)
      work.wedge = best_wedge(work.wedges, wanted_pair(work.site.source.sliding_set));
    const Json shares = shares_json(work), factors = limit_equilibrium_json(tool, work);
    std::string words = planes_text(work.planes, work.ground.origin) + shares_text(shares) +
                        wedges_text(work.wedges, work.planes.best < 0, work.wedge) +
                        limit_equilibrium_text(factors);
    if (work.planes.best < 0 && work.wedge < 0)
      words += "\nno set offers a plane: " + what_would_go(work.planes);
    Json report = {
        {"tool", "talus-source"},
        {"site", work.site.info.name},
        {"run_id", tool.run_id()},
        {"failure_planes", planes_json(work.planes, work.wedges, work.wedge, work.ground.origin)},
        {"by_share_of_foot", shares},
        {"limit_equilibrium", factors},
        {"outlines", Json::array()}};
    const std::vector<OutlinedSurface> surfaces = outlined_surfaces(work);
    for (const OutlinedSurface& surface : surfaces)
      report["outlines"].push_back(outline_json(surface, work.ground.origin));
    if (!o.layers.empty()) {
      VectorLayer by_share = outline_layer(outlines_by_share(work), work.ground.origin);
      by_share.name = "planes_by_share_of_foot";
      by_share.description = "the same planes, laid so that they come out along other shares";
      write_geopackage(tool.stage(o.layers), work.ground.crs_wkt,
                       {outline_layer(surfaces, work.ground.origin), by_share});
    }
    if (!o.assumed.empty()) {
      const Assumed assumed = assume_joints(work, work.planes.friction, o.n_blocks);
      tool.write_text(o.assumed, assumed.toml);
      report["assumed_joints_daylight"] = assumed.daylights;
      words = assumed.daylights
                  ? "joint sets are assumed from the slope"
                  : "no plane daylights at the foot of the source: " + what_would_go(work.planes);
    }
    tool.report(o.report, report);
    tool.result(report, words);
  });
}
