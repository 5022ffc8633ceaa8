// tools/stability/talus_stability.cpp
// Factor of safety of a mass by strength reduction. Page: docs/tools/talus-stability.md
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "base/sha256.hpp"
#include "base/text.hpp"
#include "base/words.hpp"
#include "io/footprints_gdal.hpp"
#include "io/geopackage_gdal.hpp"
#include "io/style.hpp"
#include "setup/section_state_gdal.hpp"
#include "setup/set_up_gdal.hpp"
#include "setup/site_crs_gdal.hpp"
#include "tools/frame/factor_chart.hpp"
#include "tools/frame/site_options.hpp"
#include "tools/frame/tool.hpp"
#include "tools/stability/findings.hpp"

namespace {

using namespace talus;  // NOLINT: a program of its own

struct Options {
  SetUpRequest request;
  std::string folder;
  double seismic = 0;
};

void declare(Tool& tool, Options& o) {
  tool.input("--trn", o.request.files.trn,
             "terrain that the blocks slide on (talus-trn, talus-blocks)")
      .required();
  tool.input("--blocks", o.request.files.blocks, "block set (talus-blocks)").required();
  tool.output_folder("-o,--out", o.folder,
                     "folder of stability.json, blocks.gpkg and, with [water], levels.svg");
  tool.option("--seismic", o.seismic,
              "pseudo-static coefficient: acceleration down the slope, of gravity")
      .between(0.0, 1.0);
  tool.footer(
      "Example:\n  talus-stability site.toml --trn bed.tif --blocks blocks.h5 -o stability");
}

// Horizontal, down the mean slope of the ground below the blocks.
Vec3 downhill(const Scene& scene) {
  Vec3 sum = Vec3::Zero();
  const Trn& trn = scene.ground.trn;
  for (int b = 0; b < n_blocks(scene); ++b) {
    const auto i = static_cast<std::size_t>(b);
    const Vec3& at = scene.blocks.rest[i].position;
    sum += scene.blocks.mass[i] * triangle_plane(trn, triangle_at(trn, at.x(), at.y())).normal;
  }
  sum.z() = 0;
  return sum.norm() > 0 ? Vec3(sum.normalized()) : Vec3(Vec3::Zero());
}

/// A site with water at the given height.
struct WaterStage {
  const Site& site;
  const Options& o;
  SetUp plan;  ///< of plan_scene()

  // At rest: without base motion, with the pseudo-static acceleration.
  [[nodiscard]] SetUp standing(InputLog& log, double rise) const {
    SetUp made = shaken(log, rise);
    made.scene.base = {};
    made.scene.gravity += o.seismic * made.scene.gravity.norm() * downhill(made.scene);
    return made;
  }
  [[nodiscard]] SetUp shaken(InputLog& log, double rise) const {
    SetUp made = plan;
    if (auto& water = made.inputs.parts.water) {
      for (double& z : water->surface) z += rise;
      water->depth -= rise;
      water->crack_fill = std::max(0.0, water->crack_fill + rise);
    }
    make_scene(site, o.request, log, made);
    return made;
  }
};

/// Search for the values of Findings.
struct Search {
  Tool& tool;
  const WaterStage& stage;
  Findings found;
  std::map<double, double> moved_share = {};  ///< with the strength as given, by rise

  [[nodiscard]] Stability stability(const Scene& scene) const {
    return find_stability(scene, {}, [this](const ReducedRun& run) {
      tool.detail("strength divided by " + text(run.factor, 5) + ": " + percent(run.moved_share) +
                  " of the mass moves");
      if (tool.interrupted()) throw Interrupted();
    });
  }

  double moved_at(double rise) {
    if (const auto known = moved_share.find(rise); known != moved_share.end()) return known->second;
    if (tool.interrupted()) throw Interrupted();
    InputLog deaf;
    return moved_share[rise] = run_reduced(stage.standing(deaf, rise).scene, 1, {}).moved_share;
  }

  // Where the group of `share` fails as the water rises: to 1 % of its range, at least 5 cm.
  [[nodiscard]] std::optional<double> fails_at(double share) {
    double holds = found.range.dry, fails = found.range.full;
    if (moved_at(holds) > share || moved_at(fails) <= share) return {};
    const double resolution = std::max(0.05, (fails - holds) / 100);
    while (fails - holds > resolution) {
      const double middle = (holds + fails) / 2;
      (moved_at(middle) > share ? fails : holds) = middle;
    }
    return (holds + fails) / 2;
  }

  // Dry, at quarters of the range, and as the site file says.
  void find_levels(const SetUp& given) {
    std::vector<double> rises{0};
    const double range = found.range.full - found.range.dry;
    for (int k = 0; k <= 4 && found.has_water; ++k) {
      const double rise = found.range.dry + k * range / 4;
      if (std::abs(rise) > range / 100) rises.push_back(rise);
    }
    std::sort(rises.begin(), rises.end());
    for (const double rise : rises) {
      InputLog deaf;
      if (rise == 0) found.given = found.levels.size();
      const SetUp level = rise == 0 ? given : stage.standing(deaf, rise);
      found.levels.push_back(
          {rise, stability(level.scene), factor_as_one_body(level.scene, level.blocks)});
    }
  }
};

// Each sample of [uncertainty.*] with the strength drawn.
void find_probability(Tool& tool, const Site& site, const Options& o, Findings& found) {
  found.n_samples = static_cast<int>(site.solver.n_runs);
  const ProgressFunction progress = tool.progress();
  for (int k = 1; k <= found.n_samples; ++k) {
    Site drawn = site;
    drawn.uncertainty.sample = k;
    apply_draws(drawn, DrawScope::all);
    InputLog deaf;
    const WaterStage stage{drawn, o, plan_scene(drawn, o.request, deaf)};
    const double share = run_reduced(stage.standing(deaf, 0).scene, 1, {}).moved_share;
    for (GroupFound* group : {&found.mass, &found.first}) group->n_failed += share > group->share;
    if (progress) progress(static_cast<double>(k) / found.n_samples);
  }
}

// The blocks that go first are visible.
void write_blocks_layer(Tool& tool, const Options& o, const SetUp& setup, const Stability& found) {
  VectorLayer layer = std::move(footprint_layers(setup.blocks, {})[0]);
  layer.name = "stability";
  layer.description = "blocks by the factor of safety at which they move";
  layer.fields.push_back({"factor", FieldType::real, "Factor of safety"});
  layer.fields.push_back({"goes", FieldType::text, "When it goes"});
  layer.qml = vector_qml({SymbolKind::polygon,
                          "goes",
                          {{"first", "goes first", {178, 24, 43, 200}},
                           {"with the mass", "goes with the mass", {244, 165, 66, 170}},
                           {"later", "stands longer", {150, 150, 150, 120}}},
                          0.2,
                          "round(\"factor\", 2)"});
  for (std::size_t b = 0; b < layer.features.size(); ++b) {
    const double factor = found.of_block[b];
    const bool moves = std::isfinite(factor);
    std::vector<FieldValue>& values = layer.features[b].values;
    values.emplace_back(moves ? factor : std::numeric_limits<double>::quiet_NaN());
    values.emplace_back(std::string(moves && factor <= found.first.moves  ? "first"
                                    : moves && factor <= found.mass.moves ? "with the mass"
                                                                          : "later"));
  }
  write_geopackage(tool.stage(o.folder + "/blocks.gpkg"), setup.inputs.crs_wkt, {layer},
                   {{"RUN_ID", tool.run_id()}});
}

void run_tool(Tool& tool, const Site& site, const Options& o) {
  check_site_crs(site);
  if (moves_alone(site))
    throw InputError({site.file}, "each block moves alone: there is no mass",
                     "cut it with [source], or set solver.blocks = \"together\"");
  const WaterStage stage{site, o, plan_scene(site, o.request, tool)};
  const SetUp setup = stage.standing(tool, 0);
  Search search{tool, stage, {}};
  Findings& found = search.found;
  found.seismic = o.seismic;
  if (const auto& water = stage.plan.inputs.parts.water) {
    found.measure = measure_of(site.water);
    found.range = water_range(*water, setup.scene);
    if (found.measure == WaterMeasure::below_surface) {
      found.at_given = site.water.depth_m;
      found.range.full = std::max(site.water.depth_m, found.range.dry);
    } else if (found.measure == WaterMeasure::in_cracks) {
      found.at_given = site.water.crack_fill_m;
    } else if (found.measure == WaterMeasure::above_foot) {
      found.at_given = -found.range.dry;
    }
    found.has_water = found.range.dry < found.range.full;
  }
  search.find_levels(setup);
  if (found.has_water)
    for (GroupFound* group : {&found.mass, &found.first})
      group->fails_at = search.fails_at(group->share);
  InputLog deaf;
  if (shakes(stage.plan.inputs.parts.base))
    found.shaken = search.stability(stage.shaken(deaf, 0).scene);
  if (!site.quantities.empty()) find_probability(tool, site, o, found);

  Json result = json_of(found);
  result["tool"] = "talus-stability";
  result["run_id"] = tool.run_id();
  result["blocks_sha256"] = sha256_of_file(o.request.files.blocks);
  result["sections"] =
      section_state(site, {"water", "joints", "material", "ground", "base_motion", "uncertainty"});
  write_blocks_layer(tool, o, setup, found.as_given());
  if (stage.plan.inputs.parts.water) {
    const std::string water = result["water"].is_string() ? result["water"].get<std::string>() : "";
    const Chart chart = factor_chart(result, {"Factor of safety", water, "factor", "mass",
                                              "blocks that go first", "fails below"});
    tool.write_text(o.folder + "/levels.svg", chart_file(chart));
  }
  tool.report(o.folder + "/stability.json", result);
  std::string summary;
  for (const std::string& sentence : sentences_of(found))
    summary += (summary.empty() ? "" : "\n") + sentence;
  tool.result(result, summary);
}

}  // namespace

int main(int argc, char** argv) {
  Options o;
  Tool tool("talus-stability",
            "Computes the factor of safety of a mass by reducing the strength of its joints.");
  SiteOptions site_options(tool);
  site_options.take_inputs();
  declare(tool, o);
  return tool.run(argc, argv, [&] { run_tool(tool, site_options.load(), o); });
}
