// tools/blocks/talus_blocks.cpp
// The blocks of a site: the source cut by its joints, or bodies from meshes and shapes. Page:
// docs/tools/talus-blocks.md
#include <cmath>

#include "base/hash_random.hpp"
#include "base/sha256.hpp"
#include "base/text.hpp"
#include "import/crs_place_gdal.hpp"
#include "import/dem_gdal.hpp"
#include "io/crs_gdal.hpp"
#include "io/judged_heights_gdal.hpp"
#include "io/trn_digest.hpp"
#include "setup/site_crs_gdal.hpp"
#include "setup/source_cut_gdal.hpp"
#include "terrain/terrain_error.hpp"
#include "tools/blocks/json.hpp"
#include "tools/blocks/outputs.hpp"
#include "tools/blocks/placed.hpp"
#include "tools/blocks/rockfall.hpp"
#include "tools/blocks/sizes.hpp"
#include "tools/frame/command_line.hpp"
#include "tools/frame/site_options.hpp"
#include "tools/frame/tool.hpp"

namespace {

using namespace talus;  // NOLINT: a program of its own

struct Options {
  std::string trn;
  BlocksOutputs files;
  bool exact = false;
  SizeOptions sizes;
};

void declare(Tool& tool, Options& o) {
  tool.input("--trn", o.trn, "terrain before the slide (talus-trn)");
  tool.output("-o,--out", o.files.blocks, "block set to write (HDF5)");
  tool.flag("--exact", o.exact,
            "keep blocks as they are cut, non-convex at the ground, as unions of convex "
            "parts; default: convex inside their joint cell");
  tool.output("--trn-out", o.files.trn,
              "terrain lowered to the failure surface, the bed that the blocks lie on (GeoTIFF)");
  tool.output("--report", o.files.report, "volumes, sizes, shapes, joints (JSON)");
  tool.output("--footprints", o.files.footprints, "plan outlines of the blocks (GeoPackage)");
  tool.output("--stereonet", o.files.stereonet, "poles and mean planes of the joints (SVG)");
  tool.output("--size-curve", o.files.size_curve, "size distribution of the blocks (SVG)");
  declare_sizes(tool, o.sizes);
  tool.footer(
      "Examples:\n  talus-blocks site.toml --trn slope.tif -o blocks.h5 --trn-out bed.tif "
      "--footprints blocks.gpkg --report blocks.json\n"
      "  talus-blocks --sizes list.csv --anchor-volume-m3 1 --anchor-years 10");
}

std::string hash_of(const Options& o, const BlocksWork& work) {
  Sha256 hash;
  const auto add = [&hash](const std::string& words) { hash.add(words.c_str(), words.size() + 1); };
  add(sha256_of_file(o.trn));
  add(o.exact ? "exact" : "convex");
  for (const EffectiveValue& entry : effective_values(work.site))
    add(entry.section + "." + entry.key + "=" + entry.value);
  for (const Vec3& v : work.blocks.vertices) hash.add(v.data(), sizeof v);
  return hash.hex();
}

void check_ground(const BlocksWork& work, const std::string& path) {
  const Vec2 place = (work.ground.origin.head<2>() + work.ground.node0).eval();
  if (work.ground.crs_wkt.empty()) return;
  const CrsProblem problem = find_crs_problem(work.ground.crs_wkt, place);
  if (!problem.finding.empty())
    throw InputError(
        {path}, problem.finding,
        problem.mend_to.empty() ? "" : "reproject it: talus-trn --t-srs " + problem.mend_to);
}

// Of the rock mass that is cut: each has a ground of its own.
void add_terrain_error(Tool& tool, BlocksWork& work) {
  const UncertaintySettings& u = work.site.uncertainty;
  const std::int64_t mass = rock_mass(u);
  if (mass == 0 || u.terrain_rmse_m == 0) return;
  const double correlation =
      std::isnan(u.terrain_correlation_m) ? 10 * work.ground.cell_size : u.terrain_correlation_m;
  work.ground = with_error(
      work.ground, u.terrain_rmse_m, correlation,
      HashRandom({static_cast<std::uint64_t>(u.seed), HashRandom::word_of("terrain error"),
                  static_cast<std::uint64_t>(mass)})
          .next());
  tool.info("ground of rock mass " + std::to_string(mass) + ": its elevations are off by " +
            text(u.terrain_rmse_m) + " m (root of the mean square), alike over " +
            text(correlation) + " m");
}

// Checks the options that are needed unless a list of sizes is evaluated.
void check_given(const SiteOptions& site, const Options& o) {
  for (const auto& [name, value] :
       {std::pair{"site", site.file()}, {"--trn", o.trn}, {"--out", o.files.blocks}})
    if (value.empty())
      throw UsageError({"", 0, name}, "is not given",
                       "talus-blocks SITE.toml --trn TRN.tif -o BLOCKS.h5, or --sizes LIST.csv");
}

void record_metrics(Tool& tool, const Json& report) {
  tool.metric("n_blocks", report["n_blocks"].get<double>(), "1");
  tool.metric("volume_m3", report["volume_m3"].get<double>(), "m3");
  if (report.contains("cut"))
    tool.metric("convexified_change", report["cut"]["convexified_change"].get<double>(), "1");
}

}  // namespace

int main(int argc, char** argv) {
  Options o;
  Tool tool("talus-blocks",
            "Cuts the rock mass of a source into blocks by its joints, or takes blocks from "
            "meshes and shapes.");
  SiteOptions site(tool, DrawScope::rock, false);
  site.take_inputs();
  declare(tool, o);
  return tool.run(argc, argv, [&] {
    if (!o.sizes.list.empty()) return report_sizes(tool, o.sizes);
    check_given(site, o);
    BlocksWork work;
    work.site = site.load();
    check_site_crs(work.site);
    work.ground = read_trn(o.trn);
    work.accepted_doubts = accepted_doubts(o.trn);
    check_ground(work, o.trn);
    const std::string terrain_digest = trn_digest(work.ground);
    add_terrain_error(tool, work);
    work.blocks.origin = work.ground.origin;
    work.blocks.crs_wkt = work.ground.crs_wkt;
    for (const MaterialSettings& material : work.site.materials)
      work.blocks.material_names.push_back(material.name);
    if (!work.has_source() && work.site.blocks.empty() && work.site.rockfalls.empty())
      throw InputError({work.site.file}, "there is no [source], [blocks.*] or [rockfall.*]",
                       "say what moves: a source to be cut, blocks, or rocks one by one");
    if (work.has_source()) work.area = read_source_area(tool, work);
    if (work.is_cut()) {
      cut_source(tool, o.exact, work);
      tool.check("volume_error", volume_error(work), 1e-9, volume_error(work) <= 1e-9);
    }
    add_placed_blocks(tool, work.site, work.ground, work.blocks);
    add_rocks(tool, work.site, work.ground, work.blocks);
    work.blocks.content_hash = hash_of(o, work);
    work.blocks.ground_digests = {trn_digest(work.is_cut() ? work.mass.bed : work.ground),
                                  terrain_digest};
    Json report = blocks_json(work, tool.run_id());
    if (!tool.layers_read().empty()) report["layers_read"] = tool.layers_read();
    record_metrics(tool, report);
    write_outputs(tool, o.files, work, report);
    tool.result(report, blocks_summary(report));
  });
}
