// tools/source/talus_source.cpp
// What the joint sets of a site offer a mass to leave on, before anything is cut. Page:
// docs/tools/talus-source.md
#include <cmath>
#include <numbers>
#include <vector>

#include "base/text.hpp"
#include "io/raster_gdal.hpp"
#include "tools/frame/failure_plane_choice.hpp"
#include "tools/frame/site_crs.hpp"
#include "tools/frame/site_options.hpp"
#include "tools/frame/source_cut.hpp"
#include "tools/frame/tool.hpp"

namespace {

using namespace talus;  // NOLINT: a program of its own

constexpr double degree = std::numbers::pi / 180;

struct Options {
  std::string trn, report, assumed;
  int n_blocks = 50;
};

void declare(Tool& tool, Options& o) {
  tool.input("--trn", o.trn, "terrain before the slide (talus-trn)")->required();
  tool.output("-o,--out", o.report, "slope, sets and planes (JSON)");
  tool.output("--assume-joints", o.assumed,
              "[source] and [joints.*] for a slope whose joints nobody has measured (TOML)");
  tool.option("--blocks", o.n_blocks, "blocks that the assumed sets should make")
      ->check(CLI::Range(1, 100000));
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

}  // namespace

int main(int argc, char** argv) {
  Options o;
  Tool tool("talus-source",
            "Says on which planes of its joint sets the mass of a source could leave, and why "
            "not on others.");
  SiteOptions site(tool);
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
    std::string words = planes_text(work.planes, work.ground.origin);
    if (work.planes.best < 0) words += "\nno set offers a plane: " + what_would_go(work.planes);
    Json report = {{"tool", "talus-source"},
                   {"site", work.site.info.name},
                   {"run_id", tool.run_id()},
                   {"failure_planes", planes_json(work.planes, work.ground.origin)}};
    if (!o.assumed.empty()) {
      const Assumed assumed = assume_joints(work, work.planes.friction, o.n_blocks);
      tool.write_text(o.assumed, assumed.toml);
      report["assumed_joints_daylight"] = assumed.daylights;
      words = assumed.daylights
                  ? "joint sets are assumed from the slope"
                  : "no plane daylights at the foot of the source: " + what_would_go(work.planes);
    }
    if (!o.report.empty()) tool.write_text(o.report, report.dump(2) + "\n");
    tool.result(report, words);
  });
}
