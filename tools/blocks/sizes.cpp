// talus-blocks --sizes: design volumes from a list of blocks.
#include "tools/blocks/sizes.hpp"

#include <algorithm>
#include <cmath>

#include "base/csv.hpp"
#include "base/text.hpp"
#include "blocks/size_fit.hpp"
#include "tools/frame/command_line.hpp"
#include "tools/frame/tool.hpp"

namespace talus {
namespace {

constexpr int wanted_blocks = 65;  // Illeditsch and Preh
constexpr std::array<double, 3> periods_a = {30, 100, 300};

std::vector<double> edges_of(const std::string& path) {
  const CsvTable table = read_csv(path);
  const auto has = [&](const char* name) {
    return std::find(table.names.begin(), table.names.end(), name) != table.names.end();
  };
  if (!has("volume_m3") && !has("edge_m"))
    throw InputError({path}, "has neither a column volume_m3 nor one edge_m",
                     "give a line of names, then a line a block");
  std::vector<double> edges;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const double value = table.number(i, has("volume_m3") ? "volume_m3" : "edge_m");
    if (!(value > 0) || !std::isfinite(value))
      throw InputError({path, table.line[i]}, "has a size that is not above 0",
                       "leave out blocks that were not measured");
    edges.push_back(has("volume_m3") ? std::cbrt(value) : value);
  }
  const bool are_alike =
      std::all_of(edges.begin(), edges.end(), [&](double a) { return a == edges.front(); });
  if (edges.size() < 5 || are_alike)
    throw InputError({path},
                     are_alike ? "holds blocks of one size"
                               : "holds " + std::to_string(edges.size()) + " blocks",
                     "a law of sizes needs five different blocks at the very least, and " +
                         std::to_string(wanted_blocks) + " to be trusted");
  return edges;
}

// Sections that talus-hazard reads: each class represents the volumes between two design volumes.
std::string scenario_text(const std::array<double, 3>& volumes, const std::string& list) {
  std::string out = "# from the blocks of " + list + " by talus-blocks --sizes\n";
  for (std::size_t i = 0; i < periods_a.size(); ++i) {
    const double rate = 1 / periods_a[i] - (i + 1 < periods_a.size() ? 1 / periods_a[i + 1] : 0);
    out += "\n# " + text(volumes[i], 4) + " m3";
    out +=
        i + 1 < periods_a.size() ? ", up to " + text(volumes[i + 1], 4) + " m3\n" : " and above\n";
    out += "[hazard.class.V" + text(periods_a[i]) + "]\nfrequency_per_a = " + text(rate, 6) + "\n";
  }
  return out;
}

}  // namespace

void declare_sizes(Tool& tool, SizeOptions& o) {
  tool.input(
      "--sizes", o.list,
      "instead of cutting: list of blocks on the slope (CSV with volume_m3 or edge_m); gives "
      "V30, V100 and V300");
  tool.option("--anchor-volume-m3", o.anchor_volume_m3,
              "volume that a block had or exceeded once in --anchor-years [m3]")
      .check(number_between(1e-9, 1e9, true));
  tool.option("--anchor-years", o.anchor_years, "return period of that event [a]")
      .check(number_between(1e-3, 1e6, true));
  tool.output("--scenarios", o.scenarios,
              "sections [hazard.class.*] with frequencies for a site file (TOML), of --sizes");
}

void report_sizes(Tool& tool, const SizeOptions& o) {
  if (std::isnan(o.anchor_volume_m3) || std::isnan(o.anchor_years))
    throw UsageError({"", 0, "--sizes"}, "has no event that says how often blocks come",
                     "give --anchor-volume-m3 and --anchor-years");
  const std::vector<double> edges = edges_of(o.list);
  if (static_cast<int>(edges.size()) < wanted_blocks)
    tool.warn(std::to_string(edges.size()) + " blocks are fewer than the " +
              std::to_string(wanted_blocks) + " that a law of sizes should rest on");
  const SizeAnchor anchor{o.anchor_volume_m3, o.anchor_years};
  const std::vector<SizeFit> fits = fit_sizes(edges);
  Json laws = Json::array(), design = Json::array();
  for (const SizeFit& fit : fits) {
    Json volumes = Json::object();
    for (const double years : periods_a)
      volumes["V" + text(years) + "_m3"] = number_or_null(volume_of_years(fit, anchor, years));
    laws.push_back({{"law", text(fit.law)},
                    {"parameters", {fit.first, fit.second}},
                    {"aic", fit.aic},
                    {"ks_distance", fit.ks},
                    {"blocks_per_a", rate_of_all(fit, anchor)},
                    {"volumes", volumes}});
  }
  const SizeFit& best = fits.front();
  std::array<double, 3> volumes{};
  std::string summary = std::to_string(edges.size()) + " blocks, " + text(best.law) + ", " +
                        text(rate_of_all(best, anchor), 4) + " blocks a year";
  for (std::size_t i = 0; i < periods_a.size(); ++i) {
    volumes[i] = volume_of_years(best, anchor, periods_a[i]);
    const std::array<double, 2> bounds = volume_bounds(best.law, edges, anchor, periods_a[i]);
    design.push_back({{"years", periods_a[i]},
                      {"volume_m3", volumes[i]},
                      {"low_m3", bounds[0]},
                      {"high_m3", bounds[1]}});
    summary += "\nV" + text(periods_a[i]) + ": " + text(volumes[i], 4) + " m3 (90 % of resamples " +
               text(bounds[0], 3) + " - " + text(bounds[1], 3) + ")";
    if (volumes[i] == 0)
      tool.warn("no block comes as often as once in " + text(periods_a[i]) +
                " years by this anchor event");
  }
  if (!o.scenarios.empty()) tool.write_text(o.scenarios, scenario_text(volumes, o.list));
  tool.result({{"n_blocks", edges.size()},
               {"anchor", {{"volume_m3", anchor.volume}, {"years", anchor.years}}},
               {"law", text(best.law)},
               {"laws", laws},
               {"design", design}},
              summary);
}

}  // namespace talus
