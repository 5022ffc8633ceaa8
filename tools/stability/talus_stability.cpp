// tools/stability/talus_stability.cpp
// Factor of safety of a mass by strength reduction. Page: docs/tools/talus-stability.md
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/text.hpp"
#include "base/words.hpp"
#include "draw/chart.hpp"
#include "io/footprints_gdal.hpp"
#include "io/geopackage_gdal.hpp"
#include "post/statistics.hpp"
#include "run/stability.hpp"
#include "setup/set_up_gdal.hpp"
#include "setup/site_crs_gdal.hpp"
#include "tools/frame/site_options.hpp"
#include "tools/frame/tool.hpp"

namespace {

using namespace talus;  // NOLINT: a program of its own

struct Options {
  SetUpRequest request;
  std::string folder, levels;
  double seismic = 0;
};

void declare(Tool& tool, Options& o) {
  tool.input("--trn", o.request.files.trn,
             "terrain that the blocks slide on (talus-trn, talus-blocks)")
      .required();
  tool.input("--blocks", o.request.files.blocks, "block set (talus-blocks)").required();
  tool.output_folder("-o,--out", o.folder, "folder of stability.json, blocks.gpkg and levels.svg");
  tool.option("--levels", o.levels,
              "factors also with the water of [water] so many metres higher, e.g. -2,2");
  tool.option("--seismic", o.seismic,
              "pseudo-static coefficient: acceleration down the slope, of gravity")
      .between(0.0, 1.0);
  tool.footer(
      "Example:\n  talus-stability site.toml --trn bed.tif --blocks blocks.h5 -o stability "
      "--levels=-4,-2,2");
}

// 0, and what --levels has besides.
std::vector<double> rises_of(const Options& o) {
  std::vector<double> rises{0};
  for (std::size_t from = 0; from < o.levels.size();) {
    const std::size_t to = std::min(o.levels.find(',', from), o.levels.size());
    double rise = 0;
    if (!parse_double(o.levels.substr(from, to - from), rise))
      throw InputError({"", 0, "--levels"}, "is " + o.levels + ", expected metres and commas",
                       "e.g. --levels=-2,2");
    if (rise != 0) rises.push_back(rise);
    from = to + 1;
  }
  return rises;
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

// The scene of a site with its water higher by `rise`, as it stands: no base motion.
SetUp standing(const Site& site, const Options& o, double rise, InputLog& log) {
  SetUp setup = plan_scene(site, o.request, log);
  auto& water = setup.inputs.parts.water;
  if (rise != 0 && !water)
    throw InputError({site.file}, "--levels moves the water of [water], and there is none",
                     "give [water] depth_m, or leave --levels out");
  if (water) {
    for (double& z : water->surface) z += rise;
    water->depth -= rise;
    water->crack_fill = std::max(0.0, water->crack_fill + rise);
  }
  make_scene(site, o.request, log, setup);
  setup.scene.base = {};
  setup.scene.gravity += o.seismic * setup.scene.gravity.norm() * downhill(setup.scene);
  return setup;
}

Json factor_json(const SafetyFactor& factor) {
  const auto number = [](double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); };
  return {{"factor", number(factor.holds > 0 ? factor.value() : 0)},
          {"holds", factor.holds},
          {"moves", number(factor.moves)}};
}

std::string text_of(const SafetyFactor& factor) {
  if (factor.holds == 0) return "below " + text(factor.moves, 3);
  if (!std::isfinite(factor.moves)) return "above " + text(factor.holds, 3);
  return text(factor.value(), 3);
}

// Blocks that move at the factor of the first.
std::vector<int> first_blocks(const Stability& found) {
  std::vector<int> blocks;
  for (std::size_t b = 0; b < found.of_block.size(); ++b)
    if (std::isfinite(found.first.moves) && found.of_block[b] <= found.first.moves)
      blocks.push_back(static_cast<int>(b));
  return blocks;
}

std::string summary_of(const Stability& found, double rise) {
  const std::vector<int> first = first_blocks(found);
  std::string words = "factor of safety of the mass " + text_of(found.mass) +
                      ", of the blocks that go first " + text_of(found.first);
  if (rise != 0)
    words = "water " + text(std::abs(rise), 3) + (rise > 0 ? " m higher: " : " m lower: ") + words;
  if (first.empty()) return words;
  constexpr std::size_t most_named = 8;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < std::min(first.size(), most_named); ++i)
    names.push_back(std::to_string(first[i]));
  return words + " (" + counted(static_cast<std::int64_t>(first.size()), "block") + ": " +
         list_of(names) + (first.size() > most_named ? " ..." : "") + ")";
}

void write_blocks_layer(Tool& tool, const Options& o, const SetUp& setup, const Stability& found) {
  std::vector<VectorLayer> layers = footprint_layers(setup.blocks, {});
  layers[0].fields.push_back({"factor", FieldType::real, "Factor of safety"});
  for (std::size_t b = 0; b < layers[0].features.size(); ++b) {
    const double factor = found.of_block[b];
    layers[0].features[b].values.emplace_back(
        std::isfinite(factor) ? factor : std::numeric_limits<double>::quiet_NaN());
  }
  write_geopackage(tool.stage(o.folder + "/blocks.gpkg"), setup.inputs.crs_wkt, layers,
                   {{"RUN_ID", tool.run_id()}});
}

struct AtLevel {
  double rise = 0;
  Stability found;
};

void write_chart(Tool& tool, const Options& o, std::vector<AtLevel> rows) {
  std::sort(rows.begin(), rows.end(),
            [](const AtLevel& a, const AtLevel& b) { return a.rise < b.rise; });
  Chart chart;
  chart.title = "Factor of safety";
  chart.x_label = "water higher by [m]";
  chart.y_label = "factor";
  chart.series = {{"mass", "#1f5fa8", {}, {}}, {"first blocks", "#c2491d", {}, {}}};
  for (ChartSeries& series : chart.series) series.marker = 3;
  const auto value = [](const SafetyFactor& factor) {
    return std::isfinite(factor.moves) && factor.holds > 0
               ? factor.value()
               : std::numeric_limits<double>::quiet_NaN();
  };
  for (const AtLevel& row : rows) {
    for (ChartSeries& series : chart.series) series.x.push_back(row.rise);
    chart.series[0].y.push_back(value(row.found.mass));
    chart.series[1].y.push_back(value(row.found.first));
  }
  tool.write_text(o.folder + "/levels.svg", chart_file(chart));
}

// Share of the samples of [uncertainty.*] in which half of the mass moves with the strength drawn.
Json probability_json(Tool& tool, const Site& site, const Options& o) {
  int n_failed = 0;
  const auto n = static_cast<int>(site.solver.n_runs);
  const ProgressFunction progress = tool.progress();
  for (int k = 1; k <= n; ++k) {
    Site drawn = site;
    drawn.uncertainty.sample = k;
    apply_draws(drawn, DrawScope::all);
    InputLog deaf;
    const SetUp setup = standing(drawn, o, 0, deaf);
    n_failed += run_reduced(setup.scene, 1, {}).moved_share > 0.5;
    if (progress) progress(static_cast<double>(k) / n);
  }
  const double share = static_cast<double>(n_failed) / n;
  const Interval interval = wilson_interval(share, n);
  return {{"samples", n},
          {"failed", n_failed},
          {"probability", share},
          {"low", interval.low},
          {"high", interval.high}};
}

}  // namespace

int main(int argc, char** argv) {
  Options o;
  Tool tool("talus-stability",
            "Computes the factor of safety of a mass by reducing the strength of its joints.");
  SiteOptions site_options(tool);
  site_options.take_inputs();
  declare(tool, o);
  return tool.run(argc, argv, [&] {
    const Site& site = site_options.load();
    check_site_crs(site);
    if (moves_alone(site))
      throw InputError({site.file}, "each block moves alone: there is no mass",
                       "cut it with [source], or set solver.blocks = \"together\"");
    const SetUp setup = standing(site, o, 0, tool);
    std::vector<AtLevel> rows;
    for (const double rise : rises_of(o)) rows.push_back({rise, {}});
    std::string summary;
    Json levels = Json::array();
    for (AtLevel& row : rows) {
      InputLog deaf;
      row.found =
          find_stability(row.rise == 0 ? setup.scene : standing(site, o, row.rise, deaf).scene, {},
                         [&](const ReducedRun& run) {
                           tool.detail("strength divided by " + text(run.factor, 5) + ": " +
                                       percent(run.moved_share) + " of the mass moves");
                           if (tool.interrupted()) throw Interrupted();
                         });
      summary += (summary.empty() ? "" : "\n") + summary_of(row.found, row.rise);
      levels.push_back({{"water_higher_m", row.rise},
                        {"mass", factor_json(row.found.mass)},
                        {"first", factor_json(row.found.first)},
                        {"first_blocks", first_blocks(row.found)}});
    }
    Json result = {{"seismic_coefficient", o.seismic}, {"levels", levels}};
    if (!site.quantities.empty()) {
      result["drawn"] = probability_json(tool, site, o);
      const Json& drawn = result["drawn"];
      summary += "\nprobability of failure with the drawn values " +
                 percent(drawn["probability"].get<double>()) + " (" +
                 percent(drawn["low"].get<double>()) + " to " +
                 percent(drawn["high"].get<double>()) + ", " +
                 std::to_string(drawn["samples"].get<int>()) + " samples)";
    }
    Json blocks = Json::array();
    for (std::size_t b = 0; b < rows[0].found.of_block.size(); ++b) {
      const double factor = rows[0].found.of_block[b];
      blocks.push_back(std::isfinite(factor) ? Json(factor) : Json(nullptr));
    }
    result["factor_of_block"] = blocks;
    write_blocks_layer(tool, o, setup, rows[0].found);
    if (rows.size() > 1) write_chart(tool, o, rows);
    tool.report(o.folder + "/stability.json", result);
    tool.result(result, summary);
  });
}
